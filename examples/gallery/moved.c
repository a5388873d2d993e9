/*
 * Each pixel that changed is looked at as the driver may draw it: the triangles in which its middle
 * is or may be, as positions are resolved to a part of a pixel, and that nothing hides. For each of
 * them the shaders' colour has a range that is proved (proof.h), with all roundings that the driver
 * may make and all places where the pixel's samples may be. What is beyond these ranges is a
 * change of the program.
 */
#include "gallery/moved.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* A triangle that a pixel may show. */
typedef struct Candidate {
    ProofTriangle triangle;
    double center[2], half; /* of the second and third corner's shares */
    double depth, change;   /* how much that is within the pixel's reach */
    bool sure;              /* not beside its sides */
} Candidate;

typedef struct Place {
    int at; /* in the picture */
    Candidate *candidates;
    int count, room;
    bool drawn, over; /* in a draw's viewport; under a line or point */
} Place;

typedef struct Judge {
    const MovedQuestion *question;
    double
        reach; /* how far from its middle a pixel may be asked for, in the framebuffer's pixels */
    double slack; /* what rounding to bytes adds, in steps */
    Place *places;
    int count, room;
    int *numbers; /* of the picture's pixels: their place, or -1 */
} Judge;

static const unsigned char *byte_of(const Image *image, int at)
{
    return (const unsigned char *)image->pixels + 4 * (size_t)at;
}

static double change_of(const MovedQuestion *question, int at, int channel)
{
    return byte_of(question->now, at)[channel] - byte_of(question->before, at)[channel];
}

/* Coverage */

/* A corner's weight over w is linear on the screen: at (X, Y) of the viewport, -1 to 1, it is
 * (X, Y, 1) times the product of the other two (raster_find.c). */
typedef struct Sides {
    double side[3][3], area, z[3], w[3];
    const int *viewport;
} Sides;

static void open_sides(const Judge *judge, const ProofTriangle *triangle, Sides *sides)
{
    const Proof *proof = judge->question->proof;
    double p[3][PROOF_PLACE];
    for (int i = 0; i < 3; i++) {
        proof_vertex(proof, triangle->draw, triangle->corners[i], p[i]);
        sides->z[i] = p[i][2];
        sides->w[i] = p[i][3];
    }
    sides->area = 0;
    for (int i = 0; i < 3; i++) {
        const double *a = p[(i + 1) % 3], *b = p[(i + 2) % 3];
        sides->side[i][0] = a[1] * b[3] - a[3] * b[1];
        sides->side[i][1] = a[3] * b[0] - a[0] * b[3];
        sides->side[i][2] = a[0] * b[1] - a[1] * b[0];
        sides->area += p[i][3] * sides->side[i][2] / 3 + p[i][0] * sides->side[i][0] / 3 +
                       p[i][1] * sides->side[i][1] / 3;
    }
    sides->viewport = proof->capture.draws[triangle->draw].viewport;
}

/* The corners' shares and the depth at a place of the framebuffer; how far it is within the
 * triangle, in pixels. */
static double share_at(const Sides *sides, const double at[2], double shares[3], double *depth)
{
    const int *v = sides->viewport;
    const double x = 2 * (at[0] - v[0]) / v[2] - 1, y = 2 * (at[1] - v[1]) / v[3] - 1;
    double inside = INFINITY, sum = 0, z = 0, w = 0;
    for (int i = 0; i < 3; i++) {
        const double *side = sides->side[i];
        shares[i] = (side[0] * x + side[1] * y + side[2]) / sides->area;
        const double slope = hypot(side[0] * 2 / v[2], side[1] * 2 / v[3]) / fabs(sides->area);
        inside = fmin(inside, shares[i] / slope);
        sum += shares[i];
    }
    for (int i = 0; i < 3; i++) {
        shares[i] /= sum;
        z += shares[i] * sides->z[i];
        w += shares[i] * sides->w[i];
    }
    *depth = (z / w + 1) / 2;
    return sum > 0 ? inside : -(double)INFINITY;
}

/* Columns and rows of the picture, row 0 at the top, in which the triangle may be seen. */
static void find_box(const Judge *judge, const ProofTriangle *triangle, const Sides *sides,
                     int box[4])
{
    const MovedQuestion *question = judge->question;
    const int *v = sides->viewport, scale = question->scale, height = question->now->height;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-(double)INFINITY, -(double)INFINITY};
    for (int i = 0; i < 3; i++) {
        double p[PROOF_PLACE];
        proof_vertex(question->proof, triangle->draw, triangle->corners[i], p);
        for (int k = 0; k < 2; k++) {
            const bool behind = !(p[3] > 1e-6);
            const double at = behind ? 0 : fmin(fmax(p[k] / p[3], -1), 1);
            low[k] = fmin(low[k], behind ? -1 : at);
            high[k] = fmax(high[k], behind ? 1 : at);
        }
    }
    for (int k = 0; k < 2; k++) {
        low[k] = floor((v[k] + (low[k] + 1) / 2 * v[2 + k]) / scale) - 1;
        high[k] = ceil((v[k] + (high[k] + 1) / 2 * v[2 + k]) / scale) + 1;
    }
    box[0] = (int)fmax(low[0], 0);
    box[1] = (int)fmin(high[0], question->now->width - 1);
    box[2] = (int)fmax(height - 1 - high[1], 0);
    box[3] = (int)fmin(height - 1 - low[1], height - 1);
}

static void middle_of(const MovedQuestion *question, int at, double middle[2])
{
    const int width = question->now->width, scale = question->scale;
    middle[0] = (at % width + .5) * scale;
    middle[1] = (question->now->height - at / width - .5) * scale;
}

static bool is_in(const int rectangle[4], const double at[2])
{
    return at[0] > rectangle[0] && at[0] < rectangle[0] + rectangle[2] && at[1] > rectangle[1] &&
           at[1] < rectangle[1] + rectangle[3];
}

static void try_pixel(const Judge *judge, const ProofTriangle *triangle, const Sides *sides,
                      Place *place)
{
    const CaptureDraw *draw = &judge->question->proof->capture.draws[triangle->draw];
    double middle[2], shares[3], depth, half = 0, change = 0;
    middle_of(judge->question, place->at, middle);
    const double inside = share_at(sides, middle, shares, &depth);
    if (!(inside > -judge->reach) || !is_in(draw->viewport, middle) ||
        (draw->scissors && !is_in(draw->scissor, middle)))
        return;
    for (int i = 0; i < 4; i++) { /* shares are farthest at the corners of what is reached */
        double other[3], beside;
        const double at[2] = {middle[0] + (i % 2 ? judge->reach : -judge->reach),
                              middle[1] + (i / 2 ? judge->reach : -judge->reach)};
        share_at(sides, at, other, &beside);
        for (int k = 1; k < 3; k++)
            half = fmax(half, fabs(other[k] - shares[k]));
        change = fmax(change, fabs(beside - depth));
    }
    Candidate *made = memory_add(&place->candidates, &place->count, &place->room, sizeof *made);
    *made = (Candidate){.triangle = *triangle,
                        .center = {shares[1], shares[2]},
                        .half = half,
                        .depth = draw->tests_depth ? depth : -1 - triangle->draw,
                        .change = change + 1e-6,
                        .sure = inside > judge->reach};
}

static void find_candidates(const Judge *judge)
{
    const int width = judge->question->now->width;
    for (ProofTriangle triangle = {.number = -1}; proof_next(judge->question->proof, &triangle);) {
        Sides sides;
        int box[4];
        open_sides(judge, &triangle, &sides);
        find_box(judge, &triangle, &sides, box);
        for (int row = box[2]; row <= box[3]; row++)
            for (int column = box[0]; column <= box[1]; column++) {
                const int number = judge->numbers[row * width + column];
                if (number >= 0)
                    try_pixel(judge, &triangle, &sides, &judge->places[number]);
            }
    }
}

/* Lines and points, which are not judged: a pixel within their width and this is one of theirs. */
static const double BESIDE = 1;

static void cover(const Judge *judge, const double a[2], const double b[2], double reach)
{
    const double way[2] = {b[0] - a[0], b[1] - a[1]};
    const double square = fmax(way[0] * way[0] + way[1] * way[1], 1e-9);
    for (int i = 0; i < judge->count; i++) {
        double at[2];
        middle_of(judge->question, judge->places[i].at, at);
        const double along = ((at[0] - a[0]) * way[0] + (at[1] - a[1]) * way[1]) / square;
        const double share = fmin(fmax(along, 0), 1);
        judge->places[i].over |=
            hypot(at[0] - a[0] - share * way[0], at[1] - a[1] - share * way[1]) < reach;
    }
}

static void find_lines(const Judge *judge, int number)
{
    const CaptureDraw *draw = &judge->question->proof->capture.draws[number];
    const int *v = draw->viewport, step = draw->mode == GL_LINES ? 2 : 1;
    for (int i = 0; i < draw->vertex_count; i += step) {
        double ends[2][2], width = fmax((double)draw->line_width, 1);
        for (int k = 0; k < 2; k++) {
            const int next = draw->mode == GL_POINTS ? i : (i + k) % draw->vertex_count;
            double p[PROOF_PLACE];
            proof_vertex(judge->question->proof, number, draw->vertices[next], p);
            if (draw->mode == GL_POINTS)
                width = sqrt(2) * p[4]; /* a square's diagonal */
            for (int j = 0; j < 2; j++)
                ends[k][j] = v[j] + (p[j] / fmax(p[3], 1e-6) + 1) / 2 * v[2 + j];
        }
        const double reach = judge->reach + (width / 2 + BESIDE) * judge->question->scale;
        cover(judge, ends[0], ends[1], reach);
    }
}

static void find_draws(const Judge *judge)
{
    const Capture *capture = &judge->question->proof->capture;
    for (int i = 0; i < capture->draw_count; i++) {
        const CaptureDraw *draw = &capture->draws[i];
        if (draw->colors[0] && draw->mode < GL_TRIANGLES)
            find_lines(judge, i);
        for (int k = 0; k < judge->count; k++) {
            double middle[2];
            middle_of(judge->question, judge->places[k].at, middle);
            judge->places[k].drawn |= is_in(draw->viewport, middle);
        }
    }
}

/* Colours */

/* Whether both of a pixel's colours are in the ranges, in steps. */
static bool holds(const Judge *judge, int at, const double low[3], const double high[3])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            const Image *image = k ? judge->question->now : judge->question->before;
            const double value = byte_of(image, at)[i];
            if (value < low[i] - judge->slack || value > high[i] + judge->slack)
                return false;
        }
    return true;
}

/* The nearest that is there at all samples; NULL: none is. */
static const Candidate *nearest_of(const Place *place)
{
    const Candidate *nearest = NULL;
    for (int i = 0; i < place->count; i++) {
        const Candidate *at = &place->candidates[i];
        if (at->sure && (!nearest || at->depth + at->change < nearest->depth + nearest->change))
            nearest = at;
    }
    return nearest;
}

static MovedKind kind_of(const Judge *judge, const Place *place)
{
    const Candidate *nearest = nearest_of(place);
    double low[3], high[3];
    bool within = false, any = place->over;
    if (!place->drawn)
        return MOVED_UNKNOWN;
    for (int i = 0; i < 3; i++) {
        const double clear = (double)judge->question->proof->capture.clear_color[i];
        low[i] = nearest ? INFINITY : 255 * clear;
        high[i] = nearest ? -(double)INFINITY : 255 * clear;
    }
    for (int k = 0; k < place->count; k++) {
        const Candidate *at = &place->candidates[k];
        GlslRange range[3];
        double least[3], most[3];
        if (nearest && at->depth - at->change > nearest->depth + nearest->change)
            continue;
        const ProofBox box = {{at->center[0], at->center[1]}, {at->half, at->half}};
        if (!proof_color(judge->question->proof, &at->triangle, &box, range)) {
            any = true;
            continue;
        }
        for (int i = 0; i < 3; i++) {
            least[i] = 255 * fmin(fmax(range[i].low, 0), 1);
            most[i] = 255 * fmin(fmax(range[i].high, 0), 1);
            low[i] = fmin(low[i], least[i]);
            high[i] = fmax(high[i], most[i]);
        }
        within |= holds(judge, place->at, least, most);
    }
    return within                                      ? MOVED_ROUNDING
           : any || holds(judge, place->at, low, high) ? MOVED_EDGE
                                                       : MOVED_WRONG;
}

/* What of the shaders looks like the change: some of the pixels that are wrong are asked for, and
 * as many that have not changed. */
static bool find_cause(const Judge *judge, Moved *moved, Message *message)
{
    enum { SAMPLES = 60 };
    const MovedQuestion *question = judge->question;
    const int size = question->now->width * question->now->height;
    CausePixel pixels[2 * SAMPLES];
    int count = 0;
    for (int wrong = 0; wrong < 2; wrong++) {
        const MovedKind kind = wrong ? MOVED_WRONG : MOVED_NOT;
        const int step = 1 + moved->counts[kind] / SAMPLES;
        for (int i = 0, seen = 0; i < size; i++) {
            double middle[2];
            if (moved->kinds[i] != (char)kind || seen++ % step)
                continue;
            CausePixel *pixel = &pixels[count++];
            middle_of(question, i, middle);
            *pixel = (CausePixel){.column = (int)middle[0], .row = (int)middle[1]};
            for (int k = 0; k < 3 && wrong; k++)
                pixel->change[k] = change_of(question, i, k) / 255;
        }
    }
    return cause_find(&question->proof->capture, pixels, count, question->asked, &moved->cause,
                      message);
}

/* All */

static bool check_draws(const Capture *capture, Message *message)
{
    for (int i = 0; i < capture->draw_count; i++) {
        const CaptureDraw *draw = &capture->draws[i];
        const bool strips = draw->mode > GL_TRIANGLES;
        if (draw->colors[0] && draw->mode >= GL_TRIANGLES &&
            (strips || draw->blends || draw->tests_stencil))
            return message_set(message, "it is drawn with %s",
                               strips         ? "strips"
                               : draw->blends ? "blending"
                                              : "a stencil");
    }
    return capture->draw_count > 0 || message_set(message, "no shader draws it");
}

static void find_places(Judge *judge, Moved *moved)
{
    const MovedQuestion *question = judge->question;
    const int size = question->now->width * question->now->height;
    judge->numbers = memory_new((size_t)size, sizeof *judge->numbers);
    for (int i = 0; i < size; i++) {
        double most = 0;
        for (int k = 0; k < 3; k++)
            most = fmax(most, fabs(change_of(question, i, k)));
        judge->numbers[i] = most > 0 ? judge->count : -1;
        moved->most = fmax(moved->most, most);
        if (most > 0)
            *(Place *)memory_add(&judge->places, &judge->count, &judge->room, sizeof(Place)) =
                (Place){.at = i};
    }
    moved->counts[MOVED_NOT] = size - judge->count;
}

bool moved_judge(Moved *moved, const MovedQuestion *question, Message *message)
{
    const Raster *raster = question->proof->driver.raster;
    const double apart = ldexp(1, -raster->subpixel_bits);
    Judge judge = {.question = question,
                   .reach = apart + (question->samples ? question->scale / 2. : 0),
                   .slack = (question->samples ? 2 : 1) * fmax(raster->bytes, .5)};
    *moved = (Moved){.most = 0};
    if (!check_draws(&question->proof->capture, message))
        return false;
    moved->kinds = memory_new((size_t)question->now->width * (size_t)question->now->height, 1);
    find_places(&judge, moved);
    find_draws(&judge);
    find_candidates(&judge);
    for (int i = 0; i < judge.count; i++) {
        const MovedKind kind = kind_of(&judge, &judge.places[i]);
        moved->kinds[judge.places[i].at] = (char)kind;
        moved->counts[kind]++;
        free(judge.places[i].candidates);
    }
    const bool done = !moved->counts[MOVED_WRONG] || find_cause(&judge, moved, message);
    free(judge.places);
    free(judge.numbers);
    return done;
}
