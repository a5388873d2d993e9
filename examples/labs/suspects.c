#include "suspects.h"

#include <string.h>

/* The small pictures, and how many are drawn before they are read. */
enum { TILE = 32, TILES = 16, SHEET = TILE * TILES, COARSE = 12 };

/* Two programs that compute the same draw the same but for rounding: 1 step, 2 where a power of a
 * cosine enlarges it; lab 7 allows two exponents, which adds 1. */
static const double TOLERANCE = 3, SMALL_TOLERANCE = 4;

/* The share of the pixels that may differ, all of them beside edges: a match, and nearly one. */
static const double MATCH = 0.004, NEAR = 0.015, SMALL_MATCH = 0.1;

static bool fit_images(Lineup *lineup, int width, int height, Message *message)
{
    if (lineup->image.width == width && lineup->image.height == height)
        return true;
    image_close(&lineup->image);
    image_close(&lineup->drawn);
    return image_open(&lineup->image, width, height, IMAGE_BYTE, message) &&
           image_open(&lineup->drawn, width, height, IMAGE_BYTE, message);
}

/* What a suspect draws of a whole scene. */
static bool draw_whole(Lineup *lineup, const Probe *probe, const ProbeBuffers *buffers,
                       const Choices *choices, Image *image, Message *message)
{
    if (!canvas_resize(lineup->canvas, probe->width, probe->height, message))
        return false;
    canvas_clear(lineup->canvas, probe->scene.background, 1);
    wrong_program_draw(&lineup->wrong, lineup->shots->lab, probe, buffers, choices);
    return canvas_read(lineup->canvas, image, message);
}

/* Scenes by their error. */
static void sort_shots(Lineup *lineup)
{
    const Shots *shots = lineup->shots;
    double rms[SHOTS_MOST];
    for (int i = 0; i < shots->count; i++) {
        const ErrorSum error = shots_error(shots, i, shots->truth);
        rms[i] = error.pixels ? error_sum_rms(&error) : 0;
        int k = i;
        for (; k > 0 && rms[lineup->order[k - 1]] < rms[i]; k--)
            lineup->order[k] = lineup->order[k - 1];
        lineup->order[k] = i;
    }
}

/* Whether the submission covers other pixels than the right program, before a background that is no
 * colour of either: by more than rounding moves at edges. */
static bool find_outline(Lineup *lineup, Message *message)
{
    const Choices right = {{0}};
    const Vec3 green = {0, 1, 0};
    for (int k = 0; k < lineup->shots->count && !lineup->moved; k++) {
        const int i = lineup->order[k];
        Probe probe = lineup->shots->shots[i].probe; /* its scene's arrays are the original's */
        const SubmissionGeometry geometry = shots_geometry(lineup->shots, i);
        probe.scene.background = green;
        if (!fit_images(lineup, probe.width, probe.height, message) ||
            !painter_draw(lineup->painter, &probe, &geometry, lineup->canvas, &lineup->image,
                          message) ||
            !draw_whole(lineup, &probe, &lineup->buffers[i], &right, &lineup->drawn, message))
            return false;
        const unsigned char *a = lineup->image.pixels, *b = lineup->drawn.pixels;
        int apart = 0;
        for (int p = 0; p < probe.width * probe.height; p++) {
            const bool first = a[4 * p] == 0 && a[4 * p + 1] == 255 && a[4 * p + 2] == 0;
            const bool second = b[4 * p] == 0 && b[4 * p + 1] == 255 && b[4 * p + 2] == 0;
            apart += first != second;
        }
        lineup->moved = apart > 6;
    }
    return true;
}

bool lineup_open(Lineup *lineup, const Shots *shots, const Painter *painter, Canvas *canvas,
                 Message *message)
{
    *lineup = (Lineup){.shots = shots, .painter = painter, .canvas = canvas};
    const CanvasOptions sheet = {.width = SHEET, .height = SHEET};
    if (!wrong_program_open(&lineup->wrong, message) ||
        !canvas_open_beside(&lineup->sheet, canvas, &sheet, message))
        return false;
    for (int i = 0; i < shots->count; i++) {
        const SubmissionGeometry geometry = shots_geometry(shots, i);
        if (!probe_buffers_open(&lineup->buffers[i], &shots->shots[i].probe, &geometry, message))
            return false;
    }
    if (shots->lab->budget && !mesh_sphere(&lineup->coarse, 1, COARSE, COARSE, message))
        return false;
    sort_shots(lineup);
    return find_outline(lineup, message);
}

void lineup_close(Lineup *lineup)
{
    if (!lineup)
        return;
    for (int i = 0; i < SHOTS_MOST; i++)
        probe_buffers_close(&lineup->buffers[i]);
    mesh_close(&lineup->coarse);
    image_close(&lineup->image);
    image_close(&lineup->drawn);
    canvas_close(&lineup->sheet);
    wrong_program_close(&lineup->wrong);
}

/* Small pictures. */

/* The scene at the size of a tile. */
static Probe small_probe(const Lineup *lineup, int shot)
{
    Probe probe = lineup->shots->shots[shot].probe;
    probe.width = probe.height = TILE;
    return probe;
}

static void view_tile(const Lineup *lineup, int number)
{
    canvas_view(&lineup->sheet, TILE * (number % TILES), TILE * (number / TILES), TILE, TILE);
}

static void cut_tile(const Image *sheet, int number, Image *tile)
{
    for (int y = 0; y < TILE; y++) {
        const int row = TILE * (number / TILES) + y, column = TILE * (number % TILES);
        memcpy((unsigned char *)tile->pixels + 4 * TILE * (size_t)y,
               (const unsigned char *)sheet->pixels + 4 * ((size_t)row * SHEET + (size_t)column),
               4 * TILE);
    }
}

/* Keeps those of one sheet that are like the submission's tile. */
static int keep_like(const Image *sheet, const Image *wanted, Suspect *suspects, int from,
                     int count, int kept)
{
    unsigned char pixels[4 * TILE * TILE];
    Image tile = {TILE, TILE, IMAGE_BYTE, pixels};
    for (int i = 0; i < count; i++) {
        cut_tile(sheet, i, &tile);
        const Likeness like = compare_drawn(wanted, &tile, SMALL_TOLERANCE, TILE * TILE);
        if (like.differing <= 2 + SMALL_MATCH * like.pixels)
            suspects[kept++] = suspects[from + i];
    }
    return kept;
}

static bool screen_shot(Lineup *lineup, int shot, Image *sheet, Suspect *suspects, int *count,
                        Message *message)
{
    const Probe probe = small_probe(lineup, shot);
    SubmissionGeometry geometry = shots_geometry(lineup->shots, shot);
    int kept = 0;
    Image wanted;
    ProbeBuffers buffers = {.buffers = {{0}}};
    if (lineup->shots->lab->budget)
        geometry.mesh = &lineup->coarse;
    if (!image_open(&wanted, TILE, TILE, IMAGE_BYTE, message))
        return false;
    bool done = probe_buffers_open(&buffers, &probe, &geometry, message) &&
                painter_draw(lineup->painter, &probe, &geometry, lineup->canvas, &wanted, message);
    for (int from = 0; from < *count && done; from += TILES * TILES) {
        const int part = *count - from < TILES * TILES ? *count - from : TILES * TILES;
        canvas_clear(&lineup->sheet, probe.scene.background, 1);
        for (int i = 0; i < part; i++) {
            view_tile(lineup, i);
            wrong_program_draw(&lineup->wrong, lineup->shots->lab, &probe, &buffers,
                               &suspects[from + i].choices);
        }
        canvas_begin(&lineup->sheet);
        done = canvas_read(&lineup->sheet, sheet, message);
        if (done)
            kept = keep_like(sheet, &wanted, suspects, from, part, kept);
    }
    probe_buffers_close(&buffers);
    image_close(&wanted);
    *count = kept;
    return done;
}

bool lineup_screen(Lineup *lineup, Suspect *suspects, int *count, Message *message)
{
    Image sheet;
    if (!image_open(&sheet, SHEET, SHEET, IMAGE_BYTE, message))
        return false;
    bool done = true;
    for (int k = 0; k < 2 && k < lineup->shots->count && done; k++)
        done = screen_shot(lineup, lineup->order[k], &sheet, suspects, count, message);
    image_close(&sheet);
    return done;
}

/* Whole pictures. */

/* 0: no match; 1: nearly; 2: a match. */
static int grade(const Image *a, const Image *b)
{
    const int most = (int)(NEAR * a->width * a->height) + 1;
    const Likeness like = compare_drawn(a, b, TOLERANCE, most);
    if (like.differing > most || like.differing > 1 + NEAR * like.pixels)
        return 0;
    return like.differing <= 1 + MATCH * like.pixels ? 2 : 1;
}

bool lineup_verify(Lineup *lineup, Suspect *suspects, int *count, bool *near, Message *message)
{
    const Shots *shots = lineup->shots;
    int kept = 0;
    *near = false;
    for (int i = 0; i < *count; i++) {
        int worst = 2;
        for (int k = 0; k < shots->count && worst > 0; k++) {
            const int number = lineup->order[k];
            const Shot *shot = &shots->shots[number];
            if (!fit_images(lineup, shot->probe.width, shot->probe.height, message) ||
                !draw_whole(lineup, &shot->probe, &lineup->buffers[number], &suspects[i].choices,
                            &lineup->drawn, message))
                return false;
            const int found = grade(&shot->image, &lineup->drawn);
            worst = found < worst ? found : worst;
        }
        if (worst == 2)
            suspects[kept++] = suspects[i];
        *near |= worst == 1;
    }
    *count = kept;
    return true;
}

bool lineup_confront(Lineup *lineup, const Probe *probe, Suspect *suspects, int *count,
                     Message *message)
{
    const SubmissionGeometry geometry = {.mesh = lineup->shots->mesh.vertices ? &lineup->shots->mesh
                                                                              : NULL,
                                         .cull = lineup->shots->geometry.cull};
    ProbeBuffers buffers;
    int kept = 0;
    if (!fit_images(lineup, probe->width, probe->height, message) ||
        !painter_draw(lineup->painter, probe, &geometry, lineup->canvas, &lineup->image, message) ||
        !probe_buffers_open(&buffers, probe, &geometry, message))
        return false;
    bool done = true;
    for (int i = 0; i < *count && done; i++) {
        done = draw_whole(lineup, probe, &buffers, &suspects[i].choices, &lineup->drawn, message);
        if (done && grade(&lineup->image, &lineup->drawn) == 2)
            suspects[kept++] = suspects[i];
    }
    probe_buffers_close(&buffers);
    *count = kept;
    return done;
}
