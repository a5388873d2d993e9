/* Mistakes are told by their pictures: a suspect is drawn by wrong_program in the submission's own
 * scenes, and stays if its pictures are the submission's. Several hundred suspects, and thousands
 * of pairs, are first drawn as pictures of 32 x 32 pixels, 256 to a sheet, which rules out nearly
 * all; the rest is drawn in full, the worst scenes first. A match has to explain: to be far nearer
 * to the submission than either is to the right picture, because what changes next to nothing
 * matches everything. The value of a wrong number is where the distance is least, found by steps
 * that become smaller. */
#include "labs/diagnosis/suspects.h"

#include <math.h>
#include <string.h>

/* Small pictures: TILES x TILES of TILE x TILE pixels are read at once. */
enum { FIT_SCENES = 3 };
enum { TILE = 32, TILES = 16, SHEET = TILE * TILES, COARSE = 12 };

/* In steps of 1/255. Rounding makes equal programs differ by 1, by 2 if a power of a cosine
 * amplifies it; lab 7's two right exponents add 1. */
static const double TOLERANCE = 3, SMALL_TOLERANCE = 4;

/* Of the squares of the differences from right, those that a suspect may leave; and what rounding
 * makes of them. */
static const double EXPLAINED = 0.03, ROUNDING = 0.002;

/* Squares below which pictures are the same: 25 pixels that are 3 steps apart; 6 if a suspect draws
 * the very same. */
static const double FAR = 100, FAR_IF_EQUAL = 25;

/* The share of pixels that may differ, all beside edges. */
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

static bool draw_suspect(Lineup *lineup, const LabScene *lab_scene, const LabSceneBuffers *buffers,
                         const Choices *choices, Image *image, Message *message)
{
    if (!canvas_resize(lineup->canvas, lab_scene->width, lab_scene->height, message))
        return false;
    canvas_clear(lineup->canvas, lab_scene->scene.background, 1);
    wrong_program_draw(&lineup->wrong, lineup->pictures->lab, lab_scene, buffers, choices);
    return canvas_read(lineup->canvas, image, message);
}

static double compare_all(const Lineup *lineup, const Image *a, const Image *b)
{
    return compare_drawn(a, b, TOLERANCE, a->width * a->height, lineup->soft).squares;
}

static void sort_pictures(Lineup *lineup)
{
    const LabPictures *pictures = lineup->pictures;
    double rms[LAB_PICTURES_MAX];
    for (int i = 0; i < pictures->count; i++) {
        const ErrorSum error = lab_pictures_error(pictures, i, pictures->truth);
        rms[i] = error.pixels ? error_sum_rms(&error) : 0;
        int k = i;
        for (; k > 0 && rms[lineup->order[k - 1]] < rms[i]; k--)
            lineup->order[k] = lineup->order[k - 1];
        lineup->order[k] = i;
    }
}

/* The right program's pictures, with the stage or exponent that the submission is nearest to. */
static bool draw_right(Lineup *lineup, Message *message)
{
    const LabPictures *pictures = lineup->pictures;
    lineup->right_choices = (Choices){.value = 1};
    if (pictures->lab->either)
        lineup->right_choices.of[SLOT_STAGE] = pictures->truth == 1 ? STAGE_OTHER : 0;
    else if (pictures->lab->fitted)
        lineup->right_choices.of[SLOT_FIT] = pictures->truth == 1 ? FIT_FOUR : FIT_LEAST_SQUARES;
    for (int i = 0; i < pictures->count; i++) {
        const LabPicture *picture = &pictures->items[i];
        if (!image_open(&lineup->right[i], picture->lab_scene.width, picture->lab_scene.height,
                        IMAGE_BYTE, message) ||
            !draw_suspect(lineup, &picture->lab_scene, &lineup->buffers[i], &lineup->right_choices,
                          &lineup->right[i], message))
            return false;
        lineup->wrong_by += compare_all(lineup, &picture->image, &lineup->right[i]);
    }
    return true;
}

bool lineup_open(Lineup *lineup, const LabPictures *pictures, const Painter *painter, bool moved,
                 Canvas *canvas, Message *message)
{
    *lineup = (Lineup){.pictures = pictures, .painter = painter, .moved = moved, .canvas = canvas};
    const CanvasOptions sheet = {.width = SHEET, .height = SHEET};
    if (!wrong_program_open(&lineup->wrong, pictures->lab, message) ||
        !canvas_open_beside(&lineup->sheet, canvas, &sheet, message))
        return false;
    for (int i = 0; i < pictures->count; i++) {
        const SubmissionGeometry geometry = lab_pictures_geometry(pictures, i);
        if (!lab_scene_buffers_open(&lineup->buffers[i], &pictures->items[i].lab_scene, &geometry,
                                    message))
            return false;
    }
    if (pictures->lab->budget && !mesh_sphere(&lineup->coarse, 1, COARSE, COARSE, message))
        return false;
    sort_pictures(lineup);
    return draw_right(lineup, message);
}

void lineup_close(Lineup *lineup)
{
    if (!lineup)
        return;
    for (int i = 0; i < LAB_PICTURES_MAX; i++)
        lab_scene_buffers_close(&lineup->buffers[i]), image_close(&lineup->right[i]);
    mesh_close(&lineup->coarse);
    image_close(&lineup->image);
    image_close(&lineup->drawn);
    canvas_close(&lineup->sheet);
    wrong_program_close(&lineup->wrong);
}

/* Small pictures. */

static void cut_tile(const Image *sheet, int number, Image *tile)
{
    for (int y = 0; y < TILE; y++) {
        const int row = TILE * (number / TILES) + y, column = TILE * (number % TILES);
        memcpy((unsigned char *)tile->pixels + 4 * TILE * (size_t)y,
               (const unsigned char *)sheet->pixels + 4 * ((size_t)row * SHEET + (size_t)column),
               4 * TILE);
    }
}

/* Keeps the suspects of one sheet whose tile is like the submission's. */
static int keep_like(bool soft, const Image *sheet, const Image *wanted, const Suspect *tried,
                     int count, Suspect *kept)
{
    int kept_count = 0;
    unsigned char pixels[4 * TILE * TILE];
    Image tile = {TILE, TILE, IMAGE_BYTE, pixels};
    for (int i = 0; i < count; i++) {
        cut_tile(sheet, i, &tile);
        const Likeness like = compare_drawn(wanted, &tile, SMALL_TOLERANCE, TILE * TILE, soft);
        if (like.differing <= 2 + SMALL_MATCH * like.pixels)
            kept[kept_count++] = tried[i];
    }
    return kept_count;
}

static bool screen_picture(Lineup *lineup, int picture, Image *sheet, Suspect *suspects, int *count,
                           Message *message)
{
    LabScene lab_scene = lineup->pictures->items[picture].lab_scene;
    SubmissionGeometry geometry = lab_pictures_geometry(lineup->pictures, picture);
    int kept = 0;
    Image wanted;
    LabSceneBuffers buffers = {.buffers = {{0}}};
    lab_scene.width = lab_scene.height = TILE;
    if (lineup->pictures->lab->budget)
        geometry.mesh = &lineup->coarse;
    if (!image_open(&wanted, TILE, TILE, IMAGE_BYTE, message))
        return false;
    bool done =
        lab_scene_buffers_open(&buffers, &lab_scene, &geometry, message) &&
        painter_draw(lineup->painter, &lab_scene, &geometry, lineup->canvas, &wanted, message);
    for (int from = 0; from < *count && done; from += TILES * TILES) {
        const int part = *count - from < TILES * TILES ? *count - from : TILES * TILES;
        canvas_clear(&lineup->sheet, lab_scene.scene.background, 1);
        for (int i = 0; i < part; i++) {
            canvas_view(&lineup->sheet, TILE * (i % TILES), TILE * (i / TILES), TILE, TILE);
            wrong_program_draw(&lineup->wrong, lineup->pictures->lab, &lab_scene, &buffers,
                               &suspects[from + i].choices);
        }
        canvas_begin(&lineup->sheet);
        done = canvas_read(&lineup->sheet, sheet, message);
        if (done)
            kept += keep_like(lineup->soft, sheet, &wanted, suspects + from, part, suspects + kept);
    }
    lab_scene_buffers_close(&buffers);
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
    for (int k = 0; k < 2 && k < lineup->pictures->count && done; k++)
        done = screen_picture(lineup, lineup->order[k], &sheet, suspects, count, message);
    image_close(&sheet);
    return done;
}

/* Whole pictures. */

/* 0: no match; 1: nearly; 2: a match. Adds to *squares. */
static int grade(bool soft, const Image *a, const Image *b, double *squares)
{
    const int max = (int)(NEAR * a->width * a->height) + 1;
    const Likeness like = compare_drawn(a, b, TOLERANCE, max, soft);
    *squares += like.squares;
    if (like.differing > max || like.differing > 1 + NEAR * like.pixels)
        return 0;
    return like.differing <= 1 + MATCH * like.pixels ? 2 : 1;
}

/* Whether the suspect explains what is wrong: its pictures are far nearer to the submission's than
 * either is to the right ones. */
static bool explains(const Lineup *lineup, const Suspect *suspect)
{
    const double far = fmin(lineup->wrong_by, suspect->own);
    /* In lab 10 a coarse mesh is wrong by as much. */
    const bool equal = suspect->apart <= ROUNDING * far && !lineup->pictures->lab->budget;
    return suspect->apart <= EXPLAINED * far && far >= (equal ? FAR_IF_EQUAL : FAR);
}

void lineup_nearest(const Lineup *lineup, Suspect *suspects, int *count)
{
    int kept = 0;
    double nearest = HUGE_VAL;
    for (int i = 0; i < *count; i++)
        if (explains(lineup, &suspects[i]) && suspects[i].apart < nearest)
            nearest = suspects[i].apart;
    for (int i = 0; i < *count; i++)
        if (explains(lineup, &suspects[i]) &&
            suspects[i].apart <= 4 * nearest + ROUNDING * lineup->wrong_by)
            suspects[kept++] = suspects[i];
    *count = kept;
}

bool lineup_verify(Lineup *lineup, Suspect *suspects, int *count, bool *near, Message *message)
{
    const LabPictures *pictures = lineup->pictures;
    int kept = 0;
    *near = false;
    for (int i = 0; i < *count; i++) {
        int worst = 2;
        Suspect suspect = suspects[i];
        suspect.apart = suspect.own = 0;
        for (int k = 0; k < pictures->count && worst > 0; k++) {
            const int number = lineup->order[k];
            const LabPicture *picture = &pictures->items[number];
            if (!fit_images(lineup, picture->lab_scene.width, picture->lab_scene.height, message) ||
                !draw_suspect(lineup, &picture->lab_scene, &lineup->buffers[number],
                              &suspect.choices, &lineup->drawn, message))
                return false;
            const int found = grade(lineup->soft, &picture->image, &lineup->drawn, &suspect.apart);
            worst = found < worst ? found : worst;
            suspect.own += compare_all(lineup, &lineup->right[number], &lineup->drawn);
        }
        if (worst == 2)
            suspects[kept++] = suspect;
        *near |= worst == 1;
    }
    *count = kept;
    lineup_nearest(lineup, suspects, count);
    return true;
}

bool lineup_confront(Lineup *lineup, const LabScene *lab_scene, Suspect *suspects, int *count,
                     Message *message)
{
    const SubmissionGeometry geometry = {
        .mesh = lineup->pictures->mesh.vertices ? &lineup->pictures->mesh : NULL,
        .cull = lineup->pictures->geometry.cull};
    LabSceneBuffers buffers;
    Image right = {0};
    int kept = 0;
    if (!fit_images(lineup, lab_scene->width, lab_scene->height, message) ||
        !painter_draw(lineup->painter, lab_scene, &geometry, lineup->canvas, &lineup->image,
                      message) ||
        !lab_scene_buffers_open(&buffers, lab_scene, &geometry, message))
        return false;
    bool done = image_open(&right, lab_scene->width, lab_scene->height, IMAGE_BYTE, message) &&
                draw_suspect(lineup, lab_scene, &buffers, &lineup->right_choices, &right, message);
    if (done)
        lineup->wrong_by += compare_all(lineup, &lineup->image, &right);
    for (int i = 0; i < *count && done; i++) {
        Suspect suspect = suspects[i];
        done = draw_suspect(lineup, lab_scene, &buffers, &suspect.choices, &lineup->drawn, message);
        const bool matches =
            done && grade(lineup->soft, &lineup->image, &lineup->drawn, &suspect.apart) == 2;
        suspect.own += done ? compare_all(lineup, &right, &lineup->drawn) : 0;
        if (matches)
            suspects[kept++] = suspect;
    }
    image_close(&right);
    lab_scene_buffers_close(&buffers);
    *count = kept;
    lineup_nearest(lineup, suspects, count);
    return done;
}

/* Numbers. */

/* Squares of all differences. Unlike compare_all, which calls steep highlights a pixel apart the
 * same, it has one minimum. */
static double distance(const Image *a, const Image *b)
{
    const unsigned char *p = a->pixels, *q = b->pixels;
    double sum = 0;
    for (size_t i = 0; i < 4 * (size_t)a->width * (size_t)a->height; i++) {
        const double d = (double)p[i] - q[i];
        sum += i % 4 < 3 && fabs(d) > 1 ? (fabs(d) - 1) * (fabs(d) - 1) : 0;
    }
    return sum;
}

/* How far the suspect with this value is in the worst scenes; HUGE_VAL: cannot be drawn. */
static double distance_with(Lineup *lineup, Suspect *suspect, double value, int scenes)
{
    const LabPictures *pictures = lineup->pictures;
    double sum = 0;
    suspect->choices.value = value;
    for (int k = 0; k < scenes && k < pictures->count; k++) {
        const int number = lineup->order[k];
        const LabPicture *picture = &pictures->items[number];
        if (!fit_images(lineup, picture->lab_scene.width, picture->lab_scene.height, NULL) ||
            !draw_suspect(lineup, &picture->lab_scene, &lineup->buffers[number], &suspect->choices,
                          &lineup->drawn, NULL))
            return HUGE_VAL;
        sum += distance(&picture->image, &lineup->drawn);
    }
    return sum;
}

/* Numbers that are added: the value; factors: their power of two. */
static double number_at(const Suspect *suspect, double x)
{
    const Factor factor = suspect->choices.factor;
    const bool added = factor == FACTOR_PLUS_LIGHT || factor == FACTOR_PLUS_COLOR ||
                       factor == FACTOR_PLUS_EXPONENT;
    return added ? x : exp2(x);
}

/* The golden section of low to high, which ends early far from any match. */
static double refine(Lineup *lineup, Suspect *suspect, double low, double high, double hopeless)
{
    enum { REFINED = 14, ENOUGH = 5 };
    const double golden = (sqrt(5) - 1) / 2;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = distance_with(lineup, suspect, number_at(suspect, a), FIT_SCENES);
    double at_b = distance_with(lineup, suspect, number_at(suspect, b), FIT_SCENES);
    for (int i = 0; i < REFINED && (i < ENOUGH || fmin(at_a, at_b) < hopeless); i++) {
        if (at_a < at_b) {
            high = b, b = a, at_b = at_a;
            a = high - golden * (high - low);
            at_a = distance_with(lineup, suspect, number_at(suspect, a), FIT_SCENES);
        } else {
            low = a, a = b, at_a = at_b;
            b = low + golden * (high - low);
            at_b = distance_with(lineup, suspect, number_at(suspect, b), FIT_SCENES);
        }
    }
    return (low + high) / 2;
}

bool lineup_fit(Lineup *lineup, Suspect *suspect)
{
    enum { STEPS = 18 };
    const double first = number_at(suspect, -9) < 0 ? -0.9 : -9, step = -first / 9;
    double best = HUGE_VAL, at = 0, wrong = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double x = first + step * i;
        const double found = distance_with(lineup, suspect, number_at(suspect, x), FIT_SCENES);
        if (found < best)
            best = found, at = x;
    }
    for (int k = 0; k < FIT_SCENES && k < lineup->pictures->count; k++) {
        const int number = lineup->order[k];
        wrong += distance(&lineup->pictures->items[number].image, &lineup->right[number]);
    }
    bool one = true; /* in a picture that is all white or black, many numbers look alike */
    for (int side = -1; side <= 1; side += 2)
        one &= distance_with(lineup, suspect, number_at(suspect, at + side * step), FIT_SCENES) >
               LINEUP_EXACT * wrong;
    suspect->choices.value =
        number_at(suspect, refine(lineup, suspect, at - step, at + step, 0.3 * wrong));
    return one;
}
