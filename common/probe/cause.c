/*
 * Each assignment is left out in turn, as if what it assigns were 0: what a pixel loses by that is
 * the assignment's share of it. Shares and changes of all pixels are vectors, and of the shares
 * that one is the cause whose angle to the change is the smallest: a highlight that is gone looks
 * like the highlight. Pixels that have not changed take part, so that what is everywhere is not
 * taken for what has changed here.
 */
#include "probe/cause.h"

#include "base/memory.h"
#include "base/text.h"
#include "core/shader_source.h"
#include "probe/raster.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Share {
    bool asked;
    int stage, node, symbol, turn; /* of a vertex all turns of a loop are one */
    const GlslTree *tree;
    const char *source;
    double both, own; /* products with the change, and with itself */
    int left;         /* turns until it is left out */
} Share;

typedef struct Shares {
    const Capture *capture;
    const char *const *asked;
    Raster *raster;
    Share *list;
    int count, room;
    double change; /* squared, of all pixels */
} Shares;

static void leave_out(GlslRun *run, const GlslEvent *event, void *observer)
{
    Share *share = observer;
    if (event->node == share->node && (share->stage == 0 || share->left-- == 0))
        memset(run->registers + event->first, 0, sizeof(double) * (size_t)event->count);
}

/* Of a file's text that stands alone its first line says the name: "// LightedCube: ...". */
static void find_place(const Share *share, char place[PLACE_TEXT + 8])
{
    const GlslPlace at = share->tree->nodes[share->node].place;
    static const char COMMENT[] = "// ";
    char name[PLACE_TEXT];
    int line_length = 0, length = 0;
    place_name(share->source, at, name);
    snprintf(place, PLACE_TEXT + 8, "%s", name);
    const char *first = shader_find_line(share->source, at.file, 1, &line_length);
    if (strncmp(name, "line ", 5) != 0 || !first || strncmp(first, COMMENT, strlen(COMMENT)) != 0)
        return;
    first += strlen(COMMENT);
    while (text_is_word(first[length]))
        length++;
    if (length > 0 && length <= 80 && first[length] == ':')
        snprintf(place, PLACE_TEXT + 8, "%.*s.%s:%d", length, first, share->stage ? "frag" : "vert",
                 at.line % SHADER_LINES_OF_FILE);
}

static bool is_asked(const Shares *shares, const Share *share)
{
    char place[PLACE_TEXT + 8];
    bool found = !shares->asked;
    find_place(share, place);
    for (int i = 0; !found && shares->asked[i]; i++)
        found = strcmp(shares->asked[i], place) == 0;
    return found;
}

static int number_of(Shares *shares, const Share *wanted)
{
    for (int i = 0; i < shares->count; i++) {
        const Share *known = &shares->list[i];
        if (known->node == wanted->node && known->turn == wanted->turn &&
            known->source == wanted->source)
            return i;
    }
    Share *made = memory_add(&shares->list, &shares->count, &shares->room, sizeof *made);
    *made = *wanted;
    made->asked = is_asked(shares, wanted);
    return shares->count - 1;
}

/* The assignments that a stage executes, as numbers of shares. */
static int list_events(Shares *shares, const GlslRun *run, const char *source, int stage,
                       int **numbers)
{
    int count = 0;
    *numbers = memory_new((size_t)run->event_count + 1, sizeof **numbers);
    for (int i = 0; i < run->event_count; i++) {
        const GlslEvent *event = &run->events[i];
        Share share = {.stage = stage,
                       .node = event->node,
                       .symbol = event->symbol,
                       .tree = run->code->tree,
                       .source = source};
        if (!event->symbol)
            continue;
        for (int k = 0; k < i; k++)
            share.turn += run->events[k].node == share.node;
        if (stage == 1 || share.turn == 0)
            (*numbers)[count++] = number_of(shares, &share);
    }
    return count;
}

static double clamped(double a)
{
    return fmin(fmax(a, 0), 1);
}

static void add_pixel(Shares *shares, const RasterPixel *pixel, int stage, const double change[3])
{
    double whole[4], without[4];
    int *numbers;
    Raster *raster = shares->raster;
    const GlslRun *run = raster_run(raster, pixel, &GLSL_EXACT, INT_MAX, whole);
    if (stage == 0) /* all corners' vertices execute the same, but where they branch */
        run = raster_vertex(raster, pixel->draw, pixel->corners[0], &GLSL_EXACT);
    const int count = list_events(shares, run, shares->capture->draws[pixel->draw].sources[stage],
                                  stage, &numbers);
    for (int i = 0; i < count; i++) {
        Share *share = &shares->list[numbers[i]];
        if (!share->asked)
            continue;
        share->left = share->turn;
        raster_observe(raster, stage, leave_out, share);
        raster_run(raster, pixel, &GLSL_EXACT, INT_MAX, without);
        for (int k = 0; k < 3; k++) {
            const double lost = clamped(whole[k]) - clamped(without[k]);
            share->both += lost * change[k];
            share->own += lost * lost;
        }
    }
    raster_observe(raster, stage, NULL, NULL);
    free(numbers);
}

static void tell(const Shares *shares, Cause *found)
{
    const Share *best = NULL;
    for (int i = 0; i < shares->count; i++) {
        const Share *share = &shares->list[i];
        const double alike = fabs(share->both) / sqrt(fmax(share->own * shares->change, 1e-30));
        if (alike > 1.001 * found->alike + 1e-6) { /* of equals the first */
            best = share;
            found->alike = alike;
        }
    }
    if (!best)
        return;
    const GlslNode *node = &best->tree->nodes[best->node];
    snprintf(found->name, sizeof found->name, "%s", best->tree->symbols[best->symbol].name);
    find_place(best, found->place);
    place_line(best->source, node->place, found->line);
    found->stage = best->stage;
    found->turn = best->turn;
    for (int i = 0; i < shares->count; i++)
        found->turns +=
            shares->list[i].node == best->node && shares->list[i].source == best->source;
}

bool cause_find(const Capture *capture, const CausePixel *pixels, int count,
                const char *const *asked, Cause *found, Message *message)
{
    Shares shares = {.capture = capture, .asked = asked};
    *found = (Cause){.turn = 0};
    if (!raster_open(&shares.raster, capture, &GLSL_EXACT, message))
        return false;
    for (int i = 0; i < count; i++) {
        RasterPixel pixel;
        raster_find(shares.raster, pixels[i].column, pixels[i].row, &pixel);
        for (int stage = 1; stage >= 0 && pixel.draw >= 0; stage--)
            add_pixel(&shares, &pixel, stage, pixels[i].change);
        for (int k = 0; k < 3; k++)
            shares.change += pixels[i].change[k] * pixels[i].change[k];
    }
    tell(&shares, found);
    raster_close(shares.raster);
    free(shares.list);
    return true;
}
