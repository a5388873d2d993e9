/*
 * The scene's shaders, as the driver gets them, run over pieces of its triangles with the errors
 * that its operations were measured to have (glsl/glsl_bound.h): the vertex shader at each vertex,
 * then the fragment shader, whose varyings are what the vertices have between them, as far off as
 * the farthest of the three and as interpolation was measured. What of the result can differ, after
 * clamping, is the bound.
 */
#include "core/shader_source.h"
#include "study/arithmetic/proof_state.h"

#include <math.h>
#include <string.h>

void proof_vertex(const Proof *proof, int draw, unsigned vertex, double place[PROOF_PLACE])
{
    const Output *handed = proof_output(proof, draw, vertex);
    for (int k = 0; k < PROOF_PLACE; k++)
        place[k] = handed[k].value;
}

/* The range of a corner's number, or of its difference from another's. */
static GlslRange apart(const Output *a, const Output *b, const ProofBox *box)
{
    const double middle = a->value - (b ? b->value : 0);
    double reach = a->slack + (b ? b->slack : 0);
    for (int k = 2; k < GLSL_WAYS; k++)
        if (box->half[k] > 0)
            reach +=
                box->half[k] * magnitude(b ? range_minus(a->slope[k], b->slope[k]) : a->slope[k]);
    return (GlslRange){middle - reach, middle + reach};
}

/* What the corners have of a number. */
static void set_number(const Output *const corners[3], int at, const ProofBox *box,
                       RasterNumber number)
{
    for (int i = 0; i < 3; i++)
        number[i] = apart(corners[i] + at, i ? corners[0] + at : NULL, box);
}

/* All but what raster_triangle finds. */
static void set_place(const ProofDraw *draw, const ProofBox *box, RasterTriangle *place)
{
    for (int k = 0; k < 3; k++)
        set_number(draw->corners, k + k / 2, box, place->place[k]);
    place->area = raster_determinant(place->place[0], place->place[1], place->place[2]);
}

/* Whether it is not drawn, from any camera of a box; `front`: false and true where it may be. */
static bool is_culled(const CaptureDraw *draw, GlslRange area, bool front[2])
{
    const bool left = draw->front_face == GL_CCW;
    front[left] = area.high > 0;
    front[!left] = area.low <= 0;
    if (draw->culls && draw->cull_face != GL_BACK)
        front[1] = false;
    if (draw->culls && draw->cull_face != GL_FRONT)
        front[0] = false;
    return !front[0] && !front[1];
}

/* Sets a draw to the corners of a triangle as they are from the cameras of a box. */
static void set_corners(const Proof *proof, const ProofTriangle *triangle, const ProofBox *box)
{
    ProofDraw *draw = &proof->draws[triangle->draw];
    if (proof->moves && memcmp(&draw->box, box, sizeof *box) != 0) {
        const bool same = memcmp(draw->box.center + 2, box->center + 2, 3 * sizeof(double)) == 0 &&
                          memcmp(draw->box.half + 2, box->half + 2, 3 * sizeof(double)) == 0;
        draw->box = *box;
        draw->moment += !same;
        memcpy(draw->runs[0]->radius + 2, box->half + 2, 3 * sizeof(double));
        if (!same)
            proof_set_fits(proof, triangle->draw, box);
    }
    for (int i = 0; i < 3; i++)
        draw->corners[i] = proof_output(proof, triangle->draw, triangle->corners[i]);
}

bool proof_next(const Proof *proof, ProofTriangle *triangle)
{
    static const ProofBox still = {{0}, {0}};
    for (;; triangle->draw++, triangle->number = -1) {
        if (triangle->draw >= proof->draw_count)
            return false;
        const CaptureDraw *draw = &proof->capture.draws[triangle->draw];
        if (!proof_is_drawn(proof, triangle->draw))
            continue;
        while (3 * ++triangle->number + 2 < draw->vertex_count) {
            bool front[2];
            RasterTriangle place;
            for (int i = 0; i < 3; i++)
                triangle->corners[i] = draw->vertices[3 * triangle->number + i];
            if (proof->moves)
                return true;
            set_corners(proof, triangle, &still);
            set_place(&proof->draws[triangle->draw], &still, &place);
            if (!is_culled(draw, place.area, front))
                return true;
        }
    }
}

static double slope_of(const RasterTriangle *triangle, const RasterNumber number, int way)
{
    const RasterNumber *at = triangle->place;
    const GlslRange slope =
        way ? raster_determinant(at[0], number, at[2]) : raster_determinant(number, at[1], at[2]);
    return (slope.low + slope.high) / (triangle->area.low + triangle->area.high);
}

/* How the shares of the corners change from a pixel to the next, at a place; zeroed, if it is
 * behind the eye or seen from the side. */
static void find_pixel(const RasterTriangle *triangle, const double half[2], const double at[2],
                       double pixel[2][2])
{
    static const RasterNumber one = {{1, 1}},
                              shares[2] = {{{0, 0}, {1, 1}}, {{0, 0}, {0, 0}, {1, 1}}};
    const GlslRange *of = triangle->place[2];
    const double w = of[0].low + at[0] * of[1].low + at[1] * of[2].low;
    for (int i = 0; i < 4; i++) {
        const int way = i / 2, k = i % 2;
        const double change =
            slope_of(triangle, shares[k], way) - at[k] * slope_of(triangle, one, way);
        pixel[way][k] = w > 0 && isfinite(change) ? w * change / half[way] : 0;
    }
}

/* Pieces */

static void set(GlslBoundRun *run, const char *name, int at, GlslInput input)
{
    GlslVariable found;
    if (glsl_find(run->code, name, &found) && at < found.count)
        run->inputs[found.first + at] = input;
}

/* A varying's number: linear, with the corners' error and the interpolation's. */
static GlslInput interpolated(const Proof *proof, const ProofDraw *draw, int at,
                              const ProofBox *box, const RasterTriangle *place)
{
    RasterNumber number;
    set_number(draw->corners, at, box, number);
    const double a = draw->corners[0][at].value, s = draw->corners[1][at].value - a;
    const double t = draw->corners[2][at].value - a;
    GlslInput made = {.middle = a + box->center[0] * s + box->center[1] * t,
                      .slope = {{s, s}, {t, t}}};
    for (int i = 0; i < 3; i++) {
        const Output *corner = &draw->corners[i][at];
        made.error = fmax(made.error, corner->error);
        made.slack = fmax(made.slack, corner->slack);
        for (int k = 2; k < GLSL_WAYS; k++)
            made.slope[k] = i ? hull(made.slope[k], corner->slope[k]) : corner->slope[k];
    }
    made.error += proof->driver.raster->units * raster_units(place, number) *
                  format_unit(&proof->driver.vertex->format);
    return made;
}

/* In how many directions the inputs change most: the first of a triangle's two, or a camera's. */
static int widest_of(const ProofDraw *draw, const ProofBox *box)
{
    double widths[GLSL_WAYS] = {0};
    int widest = 0;
    for (int i = 0; i < draw->stages.link_count; i++)
        for (int k = 0; k < draw->stages.links[i].count * GLSL_WAYS; k++) {
            const GlslInput *input =
                &draw->runs[1]->inputs[draw->stages.links[i].fragment + k / GLSL_WAYS];
            const int way = k % GLSL_WAYS;
            if (box->half[way] > 0)
                widths[way < 2 ? 0 : way] += box->half[way] * magnitude(input->slope[way]);
        }
    for (int k = 2; k < GLSL_WAYS; k++)
        if (widths[k] > widths[widest])
            widest = k;
    return widest;
}

/* In which a result does; `otherwise`: where that is not known. */
static int widest_of_result(const GlslBound *bound, const ProofBox *box, int otherwise)
{
    double widths[GLSL_WAYS] = {0};
    int widest = 0;
    for (int k = 0; k < GLSL_WAYS; k++)
        if (box->half[k] > 0)
            widths[k < 2 ? 0 : k] += box->half[k] * magnitude(bound->slope[k]);
    for (int k = 2; k < GLSL_WAYS; k++)
        if (widths[k] > widths[widest])
            widest = k;
    return widths[widest] > 0 ? widest : otherwise;
}

/* False: nothing is drawn there. */
static bool set_inputs(const Proof *proof, const ProofTriangle *triangle, const ProofBox *box)
{
    ProofDraw *draw = &proof->draws[triangle->draw];
    GlslBoundRun *run = draw->runs[1];
    static const GlslRange any = {-(double)INFINITY, (double)INFINITY};
    RasterTriangle place;
    bool front[2];
    set_corners(proof, triangle, box);
    set_place(draw, box, &place);
    if (is_culled(&proof->capture.draws[triangle->draw], place.area, front))
        return false;
    const int *viewport = proof->capture.draws[triangle->draw].viewport;
    const double high = (proof->driver.height ? proof->driver.height : viewport[3]) / 2.0;
    const double half[2] = {high / viewport[3] * viewport[2], high};
    raster_triangle(&place, half, proof->driver.raster->subpixel_bits);
    if (!proof->moves && ldexp(place.height, proof->driver.raster->subpixel_bits) < 2)
        return false;
    for (int i = 0; i < draw->stages.link_count; i++)
        for (int k = 0; k < draw->stages.links[i].count; k++) {
            const StageLink *link = &draw->stages.links[i];
            run->inputs[link->fragment + k] =
                interpolated(proof, draw, PROOF_PLACE + link->at + k, box, &place);
        }
    set(run, "gl_FrontFacing", 0,
        (GlslInput){.middle = front[1], .slack = front[0] && front[1] ? (double)INFINITY : 0});
    for (int k = 0; k < 4; k++) /* only masks are looked up there */
        set(run, "gl_FragCoord", k, (GlslInput){.middle = .5, .slope = {any, any}});
    find_pixel(&place, half, box->center, run->pixel);
    memcpy(run->radius, box->half, sizeof run->radius);
    return true;
}

static double clamped(double a)
{
    return a > 0 ? fmin(a, 1) : 0;
}

ProofBound proof_piece(const Proof *proof, const ProofTriangle *triangle, const ProofBox *box)
{
    const ProofDraw *draw = &proof->draws[triangle->draw];
    GlslBoundRun *run = draw->runs[1];
    ProofBound worst = {.bounded = true};
    GlslVariable color;
    if (!set_inputs(proof, triangle, box))
        return worst;
    worst.widest = widest_of(draw, box);
    const bool ran = glsl_bound_run(run);
    if (run->discarded || !glsl_find(run->code, "gl_FragColor", &color))
        return worst;
    for (int i = 0; i < 3; i++) {
        const GlslBound bound = glsl_bound(run, color.first + i);
        const double above = clamped(bound.driver.high) - clamped(bound.exact.low);
        const double below = clamped(bound.exact.high) - clamped(bound.driver.low);
        const double error = ran ? fmin(bound.error, fmax(fmax(above, below), 0)) : 1;
        if (255 * error <= worst.steps)
            continue;
        const int node = ran ? bound.node : run->node;
        worst.steps = 255 * error;
        worst.bounded = ran && isfinite(bound.error);
        worst.node = node;
        worst.widest = widest_of_result(&bound, box, worst.widest);
        worst.share = bound.error > 0 ? 255 * error * bound.share / bound.error : 0;
    }
    return worst;
}

bool proof_color(const Proof *proof, const ProofTriangle *triangle, const ProofBox *box,
                 GlslRange channels[3])
{
    GlslBoundRun *run = proof->draws[triangle->draw].runs[1];
    GlslVariable color;
    if (!set_inputs(proof, triangle, box) || !glsl_bound_run(run) || run->edges || run->discarded ||
        !glsl_find(run->code, "gl_FragColor", &color))
        return false;
    for (int i = 0; i < 3; i++) {
        const GlslBound bound = glsl_bound(run, color.first + i);
        channels[i].low = fmax(bound.driver.low, bound.exact.low - bound.error);
        channels[i].high = fmin(bound.driver.high, bound.exact.high + bound.error);
        if (!(channels[i].low <= channels[i].high))
            return false;
    }
    return true;
}

void proof_text(const Proof *proof, int draw, const ProofBound *bound, char *text, size_t size)
{
    const GlslTree *tree = proof->draws[draw].stages.trees[1];
    char expression[40];
    if (!bound->node) {
        snprintf(text, size, "the varyings and uniforms");
        return;
    }
    glsl_expression_text(tree, bound->node, expression, sizeof expression);
    snprintf(text, size, "line %d: %s", tree->nodes[bound->node].place.line % SHADER_LINES_OF_FILE,
             expression);
}
