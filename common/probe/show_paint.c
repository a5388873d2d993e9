/*
 * Colours for values. A number has a place on a scale from the least to the largest, an error on a
 * logarithmic one, because errors of neighbours may differ a thousandfold; vectors are directions
 * if all have about length 1, else places if most have a negative component, else colours. What is
 * out of order has a colour that no direction and no place of the scale has.
 */
#include "probe/show.h"

#include "base/memory.h"
#include "probe/origin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double SHOW_LEAST = 0.01;

static const unsigned char NEGATIVE_COLOR[3] = {0, 128, 255}, CLIPPED_COLOR[3] = {255, 0, 255},
                           UNDEFINED_COLOR[3] = {255, 128, 0}, SMALL[3] = {64, 64, 64},
                           OTHER[3] = {160, 160, 160}, WHITE[3] = {255, 255, 255};

/* Lengths of directions: interpolated normals of a coarse mesh are shorter than 1. */
static const double DIRECTION = 0.125;

/* What is out of order with a pixel. */
enum { UNDEFINED = 1, NEGATIVE = 2, CLIPPED = 4 };

typedef enum Form { NUMBERS, ERRORS, DIRECTIONS, PLACES, COLORS } Form;

/* What there is of a value. */
typedef struct Range {
    Form form;
    long shown, half, faults[CLIPPED + 1]; /* pixels; half: with an error over half a step */
    double least, most;                    /* of numbers that are not negative */
    double largest;                        /* component, without its sign */
} Range;

static double largest_of(const ShowPixel *pixel)
{
    double largest = 0;
    for (int k = 0; k < pixel->count; k++)
        largest = fmax(largest, fabs((double)pixel->values[k]));
    return largest;
}

static int faults_of(const ShowPixel *pixel)
{
    int faults = 0;
    for (int k = 0; k < pixel->count; k++)
        faults |= !isfinite(pixel->values[k]) ? UNDEFINED
                  : pixel->values[k] < 0      ? NEGATIVE
                  : pixel->values[k] > 1      ? CLIPPED
                                              : 0;
    return faults;
}

static bool is_direction(const ShowPixel *pixel)
{
    double sum = 0;
    for (int k = 0; k < pixel->count; k++)
        sum += (double)pixel->values[k] * (double)pixel->values[k];
    return pixel->count == 3 && fabs(sqrt(sum) - 1) <= DIRECTION;
}

static Range range_of(const Show *show)
{
    Range range = {.least = INFINITY};
    long directions = 0;
    int components = 0;
    for (int i = 0; i < show->width * show->height; i++) {
        const ShowPixel *pixel = &show->pixels[i];
        const int faults = faults_of(pixel);
        range.shown += pixel->count > 0;
        for (int fault = UNDEFINED; fault <= CLIPPED; fault *= 2)
            range.faults[fault] += (faults & fault) != 0;
        if (!pixel->count || faults & UNDEFINED)
            continue;
        components = pixel->count > components ? pixel->count : components;
        directions += is_direction(pixel);
        range.half += largest_of(pixel) > 0.5;
        range.largest = fmax(range.largest, largest_of(pixel));
        for (int k = 0; k < pixel->count; k++) {
            const double value = (double)pixel->values[k];
            range.least = value >= 0 ? fmin(range.least, value) : range.least;
            range.most = fmax(range.most, value);
        }
    }
    range.least = fmin(range.least, range.most);
    range.form = show->kind == SHOW_ERROR                                            ? ERRORS
                 : components < 2                                                    ? NUMBERS
                 : directions && directions == range.shown - range.faults[UNDEFINED] ? DIRECTIONS
                 : 2 * range.faults[NEGATIVE] > range.shown                          ? PLACES
                                                                                     : COLORS;
    return range;
}

/* On the scale. */
static void paint_number(const Range *range, double value, unsigned char color[3])
{
    if (range->form == NUMBERS)
        image_viridis(
            range->most > range->least ? (value - range->least) / (range->most - range->least) : 1,
            color);
    else if (value < SHOW_LEAST)
        memcpy(color, SMALL, 3);
    else
        image_viridis(log(value / SHOW_LEAST) / log(fmax(range->largest / SHOW_LEAST, 2)), color);
}

static void paint_pixel(const Range *range, const ShowPixel *pixel, unsigned char color[3])
{
    const int faults = faults_of(pixel);
    const double scale = range->form == DIRECTIONS ? 1 : range->largest;
    if (faults & UNDEFINED)
        memcpy(color, UNDEFINED_COLOR, 3);
    else if (faults & NEGATIVE && (range->form == NUMBERS || range->form == COLORS))
        memcpy(color, NEGATIVE_COLOR, 3);
    else if (faults & CLIPPED && range->form == COLORS)
        memcpy(color, CLIPPED_COLOR, 3);
    else if (range->form <= ERRORS)
        paint_number(range, largest_of(pixel), color);
    else
        for (int k = 0; k < 3 && k < pixel->count; k++) {
            const double value = (double)pixel->values[k];
            color[k] =
                (unsigned char)(origin_step(range->form == COLORS ? value
                                                                  : 0.5 + 0.5 * value / scale) +
                                0.5);
        }
}

static void put_count(FILE *legend, long count, const char *what)
{
    if (count)
        fprintf(legend, "; %s: %ld pixels", what, count);
}

static void put_legend(const Range *range, FILE *legend)
{
    if (range->form == NUMBERS)
        fprintf(legend, "from %.6g, dark violet, to %.6g, yellow", range->least, range->most);
    else if (range->form == ERRORS)
        fprintf(legend,
                "from %g, dark violet, to %.3g steps of 1/255, yellow, on a logarithmic scale; "
                "less, in dark grey; at most %.3g, over half a step: %ld of %ld pixels",
                SHOW_LEAST, fmax(range->largest, 2 * SHOW_LEAST), range->largest, range->half,
                range->shown);
    else if (range->form == DIRECTIONS)
        fprintf(legend, "directions, each component c as 0.5 + 0.5 c");
    else if (range->form == PLACES)
        fprintf(legend, "each component c as 0.5 + 0.5 c / %.6g", range->largest);
    else
        fprintf(legend, "as a colour, from %.6g to %.6g", range->least, range->most);
    if (range->form == NUMBERS || range->form == COLORS)
        put_count(legend, range->faults[NEGATIVE], "negative, in azure");
    if (range->form == COLORS)
        put_count(legend, range->faults[CLIPPED], "over 1, in magenta");
    put_count(legend, range->faults[UNDEFINED],
              range->form == ERRORS ? "undefined, in orange" : "no number, in orange");
    fprintf(legend, "; black: no triangle%s\n", range->shown ? "" : ": nothing here computes it");
}

/* Blame */

/* A line, the same in all programs that have it. */
typedef struct Line {
    char name[PLACE_TEXT], text[PLACE_TEXT];
    int draw; /* that blames it first */
    GlslPlace place;
    long pixels;
} Line;

static void describe(const Show *show, const ShowPixel *pixel, Line *line)
{
    const char *source = show->capture->draws[pixel->draw].sources[1];
    *line = (Line){.draw = pixel->draw, .place = pixel->place};
    if (pixel->place.line > 0) {
        place_name(source, pixel->place, line->name);
        place_line(source, pixel->place, line->text);
    } else {
        snprintf(line->name, sizeof line->name, "the vertex shader");
    }
}

/* The number of the line that a pixel blames, which is added if it is new. */
static int line_of(const Show *show, const ShowPixel *pixel, Line **lines, int *count, int *room)
{
    Line line;
    const char *source = show->capture->draws[pixel->draw].sources[1];
    for (int i = 0; i < *count; i++) {
        const Line *known = &(*lines)[i];
        if (known->place.line == pixel->place.line && known->place.file == pixel->place.file &&
            show->capture->draws[known->draw].sources[1] == source)
            return i;
    }
    describe(show, pixel, &line);
    for (int i = 0; i < *count; i++)
        if (strcmp((*lines)[i].name, line.name) == 0 && strcmp((*lines)[i].text, line.text) == 0)
            return i;
    *(Line *)memory_add(lines, count, room, sizeof line) = line;
    return *count - 1;
}

static int more_pixels(const void *a, const void *b)
{
    const long x = ((const Line *)a)->pixels, y = ((const Line *)b)->pixels;
    return (x < y) - (x > y);
}

/* Colours of which those who see fewer can tell the first seven apart, too (Okabe and Ito, Color
 * universal design, 2008). */
static const struct {
    const char *name;
    unsigned char color[3];
} PALETTE[] = {{"orange", {230, 159, 0}},
               {"sky blue", {86, 180, 233}},
               {"bluish green", {0, 158, 115}},
               {"yellow", {240, 228, 66}},
               {"blue", {0, 114, 178}},
               {"vermilion", {213, 94, 0}},
               {"reddish purple", {204, 121, 167}},
               {"brown", {130, 70, 20}},
               {"lime", {170, 230, 80}},
               {"violet", {110, 60, 190}},
               {"pink", {255, 190, 210}},
               {"dark green", {0, 80, 40}}};
enum { PALETTE_COLORS = sizeof PALETTE / sizeof PALETTE[0] };

static void paint_blame(const Show *show, Image *picture, FILE *legend)
{
    Line *lines = NULL;
    int count = 0, room = 0;
    long without[2] = {0}; /* a line: undefined, and small */
    const int pixels = show->width * show->height;
    for (int i = 0; i < pixels; i++) {
        if (show->pixels[i].count && show->pixels[i].place.line < 0)
            without[show->pixels[i].place.line + 2]++;
        else if (show->pixels[i].count) {
            const int line = line_of(show, &show->pixels[i], &lines, &count, &room);
            lines[line].pixels++;
        }
    }
    if (count)
        qsort(lines, (size_t)count, sizeof *lines, more_pixels);
    for (int i = 0; i < pixels; i++) {
        const ShowPixel *pixel = &show->pixels[i];
        unsigned char *color = (unsigned char *)picture->pixels + 4 * (size_t)i;
        if (pixel->count && pixel->place.line < 0)
            memcpy(color, pixel->place.line == -1 ? SMALL : WHITE, 3);
        else if (pixel->count) {
            const int line = line_of(show, pixel, &lines, &count, &room);
            memcpy(color, line < PALETTE_COLORS ? PALETTE[line].color : OTHER, 3);
        }
    }
    fprintf(legend, "the line in which most of a pixel's error by rounding is born\n");
    for (int i = 0; i < count; i++)
        fprintf(legend, "%8ld pixels, %s: %s%s%s\n", lines[i].pixels,
                i < PALETTE_COLORS ? PALETTE[i].name : "light grey, as all further", lines[i].name,
                lines[i].text[0] ? ": " : "", lines[i].text);
    fprintf(legend, "%8ld pixels, dark grey: off by less than a hundredth of a step\n", without[1]);
    if (without[0])
        fprintf(legend, "%8ld pixels, white: the colour is undefined\n", without[0]);
    free(lines);
}

/* NVIDIA cuts a colour to 12 bits, and rounds the half of a step down. */
static double byte_of(double channel, int bits)
{
    return bits ? ceil(origin_step(ldexp(floor(ldexp(channel, bits)), -bits)) - 0.5)
                : rint(origin_step(channel));
}

/* As a framebuffer of bytes keeps them, over the background. */
static void paint_colors(const Show *show, Image *picture)
{
    unsigned char *bytes = picture->pixels;
    for (size_t i = 0; i < (size_t)show->width * (size_t)show->height; i++, bytes += 4) {
        const ShowPixel *pixel = &show->pixels[i];
        for (int k = 0; k < 3; k++)
            bytes[k] = (unsigned char)byte_of(
                (double)(pixel->count ? pixel->values[k] : show->capture->clear_color[k]),
                show->color_bits);
        bytes[3] = 255;
    }
}

void show_paint(const Show *show, Image *picture, FILE *legend)
{
    if (show->stopped)
        fprintf(legend, "a loop does not end: give it a number of turns\n");
    if (show->kind == SHOW_COLOR) {
        paint_colors(show, picture);
        return;
    }
    const Range range = range_of(show);
    unsigned char *bytes = picture->pixels;
    const size_t count = (size_t)show->width * (size_t)show->height;
    for (size_t i = 0; i < count; i++, bytes += 4) {
        memcpy(bytes, (unsigned char[4]){0, 0, 0, 255}, 4);
        if (show->kind != SHOW_BLAME && show->pixels[i].count)
            paint_pixel(&range, &show->pixels[i], bytes);
    }
    fprintf(legend, "%s: ", show->what);
    if (show->kind == SHOW_BLAME)
        paint_blame(show, picture, legend);
    else
        put_legend(&range, legend);
}
