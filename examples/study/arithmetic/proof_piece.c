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

void proof_vertex(const Proof *proof, int draw, unsigned vertex, double place[4])
{
    const Output *handed = proof_output(proof, draw, vertex);
    for (int k = 0; k < PROOF_PLACE; k++)
        place[k] = handed[k].value;
}

/* Pixels of a unit of x / w or y / w. */
static double pixels_of(const Proof *proof, const ProofTriangle *triangle, int k)
{
    const int *viewport = proof->capture.draws[triangle->draw].viewport;
    return (proof->driver.height ? proof->driver.height : viewport[2 + k]) / 2.0;
}

static GlslRange range_minus(GlslRange a, GlslRange b)
{
    return range_sum(a, (GlslRange){-b.high, -b.low});
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

/* The determinant of x, y and w of the corners: positive, if it is seen counterclockwise. */
static GlslRange area_of(const ProofDraw *draw, const ProofBox *box)
{
    static const int XYW[3] = {0, 1, 3};
    GlslRange rows[3][3], area = {0, 0};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            rows[i][k] =
                apart(&draw->corners[i][XYW[k]], i ? &draw->corners[0][XYW[k]] : NULL, box);
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        area = range_sum(
            area, range_product(rows[0][k], range_minus(range_product(rows[1][u], rows[2][v]),
                                                        range_product(rows[1][v], rows[2][u]))));
    }
    return area;
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
            for (int i = 0; i < 3; i++)
                triangle->corners[i] = draw->vertices[3 * triangle->number + i];
            if (proof->moves)
                return true;
            set_corners(proof, triangle, &still);
            if (!is_culled(draw, area_of(&proof->draws[triangle->draw], &still), front))
                return true;
        }
    }
}

/* How the shares of the corners change from a pixel to the next, by the derivative of x / w and
 * y / w at a place; zeroed, if it is behind the eye or seen from the side. */
static void find_pixel(const Proof *proof, const ProofTriangle *triangle, const double at[2],
                       double pixel[2][2])
{
    const Output *const *corners = proof->draws[triangle->draw].corners;
    double p[3], change[3][2], slope[2][2];
    for (int k = 0; k < 3; k++) {
        const int of = k == 2 ? 3 : k;
        const double first = corners[0][of].value;
        change[k][0] = corners[1][of].value - first;
        change[k][1] = corners[2][of].value - first;
        p[k] = first + at[0] * change[k][0] + at[1] * change[k][1];
    }
    memset(pixel, 0, 4 * sizeof pixel[0][0]);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 2; i++)
            slope[k][i] = (change[k][i] * p[2] - p[k] * change[2][i]) / (p[2] * p[2]) *
                          pixels_of(proof, triangle, k);
    const double area = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
    if (!(p[2] > 0) || !(fabs(area) > 0))
        return;
    pixel[0][0] = slope[1][1] / area;
    pixel[0][1] = -slope[1][0] / area;
    pixel[1][0] = -slope[0][1] / area;
    pixel[1][1] = slope[0][0] / area;
}

/* Pieces */

static void set(GlslBoundRun *run, const char *name, int at, GlslInput input)
{
    GlslVariable found;
    if (glsl_find(run->code, name, &found) && at < found.count)
        run->inputs[found.first + at] = input;
}

/* How much lower a triangle is on the screen than those of a few pixels that were measured, at
 * least 1: the error of an interpolated number's slope grows so. */
static double flatness(const Proof *proof, const ProofTriangle *triangle, GlslRange area,
                       const ProofBox *box)
{
    static const double MEASURED = 5 /* of an equilateral one with sides of 6 pixels */, MOST = 1e3;
    const Output *const *corners = proof->draws[triangle->draw].corners;
    double longest = 0, least = fmax(fmax(area.low, -area.high), 0);
    GlslRange w[3];
    for (int i = 0; i < 3; i++) {
        w[i] = apart(&corners[i][3], NULL, box);
        if (!(w[i].low > 1e-6))
            return MOST;
        least /= w[i].high;
    }
    for (int i = 0; i < 3; i++) {
        const Output *a = corners[i], *b = corners[(i + 1) % 3];
        double side[2];
        for (int k = 0; k < 2; k++) { /* b / w - a / w of their w */
            const GlslRange change =
                range_minus(range_product(apart(&b[k], &a[k], box), w[i]),
                            range_product(apart(&a[k], NULL, box), apart(&b[3], &a[3], box)));
            side[k] =
                magnitude(change) / (w[i].low * w[(i + 1) % 3].low) * pixels_of(proof, triangle, k);
        }
        longest = fmax(longest, hypot(side[0], side[1]));
    }
    least *= pixels_of(proof, triangle, 0) * pixels_of(proof, triangle, 1);
    return fmin(fmax(MEASURED * longest / fmax(least, 1e-6), 1), MOST);
}

/* A varying's number: linear, with the corners' error and the interpolation's. */
static GlslInput interpolated(const Proof *proof, const Output *const corners[3],
                              const ProofBox *box, double flat)
{
    const Raster *raster = proof->driver.raster;
    const Format *format = &proof->driver.vertex->format;
    const double a = corners[0]->value, s = corners[1]->value - a, t = corners[2]->value - a;
    GlslInput made = {.middle = a + box->center[0] * s + box->center[1] * t,
                      .slope = {{s, s}, {t, t}}};
    double most = 1e-30, range = 0;
    for (int i = 0; i < 3; i++) {
        const Output *corner = corners[i];
        made.error = fmax(made.error, corner->error);
        made.slack = fmax(made.slack, corner->slack);
        most = fmax(most, magnitude(apart(corner, NULL, box)));
        range = fmax(range, magnitude(apart(corner, corners[(i + 1) % 3], box)));
        for (int k = 2; k < GLSL_WAYS; k++)
            made.slope[k] = i ? hull(made.slope[k], corner->slope[k]) : corner->slope[k];
    }
    made.error += fmax(raster->flat, raster->perspective) * format_ulp(format, most) +
                  flat * raster->small * format_unit(format) * range;
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

/* False: nothing is drawn there. */
static bool set_inputs(const Proof *proof, const ProofTriangle *triangle, const ProofBox *box)
{
    ProofDraw *draw = &proof->draws[triangle->draw];
    GlslBoundRun *run = draw->runs[1];
    static const GlslRange any = {-(double)INFINITY, (double)INFINITY};
    bool front[2];
    set_corners(proof, triangle, box);
    const GlslRange area = area_of(draw, box);
    if (is_culled(&proof->capture.draws[triangle->draw], area, front))
        return false;
    const double flat = flatness(proof, triangle, area, box);
    for (int i = 0; i < draw->stages.link_count; i++)
        for (int k = 0; k < draw->stages.links[i].count; k++) {
            const StageLink *link = &draw->stages.links[i];
            const Output *corners[3];
            for (int c = 0; c < 3; c++)
                corners[c] = draw->corners[c] + PROOF_PLACE + link->at + k;
            run->inputs[link->fragment + k] = interpolated(proof, corners, box, flat);
        }
    set(run, "gl_FrontFacing", 0,
        (GlslInput){.middle = front[1], .slack = front[0] && front[1] ? (double)INFINITY : 0});
    for (int k = 0; k < 4; k++) /* only masks are looked up there */
        set(run, "gl_FragCoord", k, (GlslInput){.middle = .5, .slope = {any, any}});
    find_pixel(proof, triangle, box->center, run->pixel);
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
