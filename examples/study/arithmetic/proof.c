/*
 * The scene's shaders, as the driver gets them, run over pieces of its triangles with the errors
 * that its operations were measured to have (glsl/glsl_bound.h): the vertex shader at each vertex,
 * then the fragment shader, whose varyings are what the vertices have between them, as far off as
 * the farthest of the three and as interpolation was measured. What of the result can differ, after
 * clamping, is the bound.
 */
#include "study/arithmetic/proof.h"

#include "base/memory.h"
#include "core/shader_source.h"
#include "lighting/lighting.h"
#include "probe/stages.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A number of a vertex. */
typedef struct Output {
    double value, error;
} Output;

typedef struct ProofDraw {
    Stages stages;
    GlslBoundRun *runs[2];
    GlslErrors errors[2];
    Output *vertices;    /* by number, what each hands over */
    double (*places)[4]; /* clip coordinates */
} ProofDraw;

/* Measured errors as those of operations. */
static void set_errors(GlslErrors *errors, int precision, const Arithmetic *of)
{
    static const Function functions[GLSL_UNITS] = {
        [GLSL_UNITS_SUM] = FUNCTION_ADD,         [GLSL_UNITS_PRODUCT] = FUNCTION_MULTIPLY,
        [GLSL_UNITS_QUOTIENT] = FUNCTION_DIVIDE, [GLSL_UNITS_SQRT] = FUNCTION_SQRT,
        [GLSL_UNITS_EXP2] = FUNCTION_EXP2,       [GLSL_UNITS_INVERSE_SQRT] = FUNCTION_INVERSESQRT,
        [GLSL_UNITS_LOG2] = FUNCTION_LOG2,       [GLSL_UNITS_SIN] = FUNCTION_SIN,
        [GLSL_UNITS_COS] = FUNCTION_COS,
    };
    const Format *format = &of->format;
    errors->numbers.of[precision].bits = format->bits;
    errors->numbers.of[precision].least = format->min_exponent;
    errors->numbers.of[precision].most = format->max_exponent;
    errors->numbers.of[precision].denormals = format->denormals && format->denormal_inputs;
    for (int i = 0; i < GLSL_UNITS; i++) {
        const Accuracy *accuracy = &of->accuracies[functions[i]];
        const bool known = i != GLSL_UNITS_OTHER && !accuracy->wrong;
        errors->units[precision][i] = known ? accuracy->largest : (double)INFINITY;
    }
    for (int i = 0; i < 16; i++)
        errors->pow[precision][i] = (double)of->accuracies[FUNCTION_POW].absolute[i];
}

static GlslErrors errors_of(const ProofDriver *driver, int stage)
{
    GlslErrors errors = {.numbers = GLSL_EXACT};
    const bool narrow = stage && driver->fragment->format.bits < driver->vertex->format.bits;
    const Arithmetic *of = stage ? driver->fragment : driver->vertex;
    set_errors(&errors, GLSL_LOWP, of);
    set_errors(&errors, GLSL_MEDIUMP, of);
    set_errors(&errors, GLSL_HIGHP, narrow ? driver->vertex : of);
    return errors;
}

/* A uniform is rounded to a float, unless it was meant to be short: of 2^12 numbers one is by
 * chance. */
static double uniform_error(double value)
{
    int exponent;
    const double part = frexp(value, &exponent) * 0x1p12;
    return part == rint(part) ? 0 : ldexp(1, exponent - 25);
}

static void set_uniforms(GlslBoundRun *run, const CaptureDraw *draw)
{
    for (int i = 0; i < draw->uniform_count; i++) {
        const CaptureUniform *uniform = &draw->uniforms[i];
        for (int k = 0; k < uniform->length; k++) {
            GlslVariable found;
            const bool used = stages_uniform(run->code, uniform, k, &found);
            for (int j = 0; used && j < uniform->numbers && j < found.count; j++) {
                const double value = (double)uniform->values[k * uniform->numbers + j];
                run->inputs[found.first + j] =
                    (GlslInput){.middle = value, .error = uniform_error(value)};
            }
        }
    }
}

static void run_vertex(ProofDraw *made, const CaptureDraw *draw, unsigned vertex)
{
    GlslBoundRun *run = made->runs[0];
    GlslVariable found;
    for (int i = 0; i < draw->attribute_count; i++) {
        float value[4];
        capture_attribute(&draw->attributes[i], vertex, value);
        if (glsl_find(run->code, draw->attributes[i].name, &found))
            for (int k = 0; k < found.count && k < 4; k++)
                run->inputs[found.first + k] = (GlslInput){.middle = (double)value[k]};
    }
    glsl_bound_run(run);
    Output *handed = made->vertices + vertex * (size_t)made->stages.handed;
    for (int i = 0; i < made->stages.link_count; i++)
        for (int k = 0; k < made->stages.links[i].count; k++) {
            const GlslBound bound = glsl_bound(run, made->stages.links[i].vertex + k);
            handed[made->stages.links[i].at + k] =
                (Output){(bound.exact.low + bound.exact.high) / 2,
                         run->stopped ? (double)INFINITY : bound.error};
        }
    for (int k = 0; k < 4 && glsl_find(run->code, "gl_Position", &found); k++) {
        const GlslRange exact = glsl_bound(run, found.first + k).exact;
        made->places[vertex][k] = (exact.low + exact.high) / 2;
    }
}

static void run_vertices(ProofDraw *made, const CaptureDraw *draw)
{
    unsigned most = 0;
    for (int i = 0; i < draw->vertex_count; i++)
        most = draw->vertices[i] > most ? draw->vertices[i] : most;
    bool *done = memory_new((size_t)most + 1, sizeof *done);
    made->places = memory_new((size_t)most + 1, sizeof *made->places);
    made->vertices =
        memory_new(((size_t)most + 1) * (size_t)made->stages.handed + 1, sizeof *made->vertices);
    for (int i = 0; i < draw->vertex_count; i++) {
        const unsigned vertex = draw->vertices[i];
        if (!done[vertex])
            run_vertex(made, draw, vertex);
        done[vertex] = true;
    }
    free(done);
}

static bool is_colored(const CaptureDraw *draw)
{
    return draw->colors[0] && draw->sources[0] && draw->sources[1];
}

static bool is_seen(const CaptureDraw *draw)
{
    return draw->mode == GL_TRIANGLES && is_colored(draw);
}

bool proof_is_drawn(const Proof *proof, int draw)
{
    return is_seen(&proof->capture.draws[draw]);
}

static bool open_draws(Proof *proof, Message *message)
{
    const Capture *capture = &proof->capture;
    proof->draws = memory_new((size_t)capture->draw_count + 1, sizeof *proof->draws);
    for (int i = 0; i < capture->draw_count; i++) {
        ProofDraw *made = &proof->draws[i];
        const CaptureDraw *draw = &capture->draws[i];
        if (!is_colored(draw))
            continue;
        if (!stages_open(&made->stages, draw, message))
            return false;
        for (int k = 0; k < 2; k++) {
            made->errors[k] = errors_of(&proof->driver, k);
            made->runs[k] = glsl_bound_open(made->stages.codes[k], &made->errors[k]);
            set_uniforms(made->runs[k], draw);
        }
        run_vertices(made, draw);
    }
    return true;
}

bool proof_open(Proof *proof, const Scene *scene, const ProofDriver *driver, bool shadows,
                Message *message)
{
    const bool narrow = driver->fragment->format.bits < driver->vertex->format.bits;
    const ShaderLoader loader = {.precision = narrow ? "mediump" : "highp"};
    const ShadowSettings none = {.way = SHADOWS_OFF};
    Lighting *lighting = NULL;
    GLint framebuffer = 0;
    *proof = (Proof){.driver = *driver};
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer);
    capture_begin(&proof->capture, &(Canvas){.framebuffer = (GLuint)framebuffer});
    bool done = lighting_open(&lighting, &loader, message);
    if (done && !shadows)
        lighting_use_shadows(lighting, &none);
    done = done && lighting_show(lighting, &(LightingFrame){.scene = scene, .aspect = 1}, message);
    capture_end(&proof->capture);
    lighting_close(lighting);
    if (done)
        return proof_of_capture(proof, message);
    proof_close(proof);
    return false;
}

bool proof_of_capture(Proof *proof, Message *message)
{
    if (open_draws(proof, message))
        return true;
    proof_close(proof);
    return false;
}

void proof_close(Proof *proof)
{
    for (int i = 0; proof->draws && i < proof->capture.draw_count; i++) {
        ProofDraw *draw = &proof->draws[i];
        for (int k = 0; k < 2; k++)
            if (draw->runs[k])
                glsl_bound_close(draw->runs[k]);
        stages_close(&draw->stages);
        free(draw->vertices);
        free(draw->places);
    }
    free(proof->draws);
    capture_close(&proof->capture);
    *proof = (Proof){.draws = NULL};
}

/* Triangles */

const double *proof_vertex(const Proof *proof, int draw, unsigned vertex)
{
    return proof->draws[draw].places[vertex];
}

static double place(const Proof *proof, const ProofTriangle *triangle, int corner, int k)
{
    return proof_vertex(proof, triangle->draw, triangle->corners[corner])[k];
}

/* Pixels of a unit of x / w or y / w. */
static double pixels_of(const Proof *proof, const ProofTriangle *triangle, int k)
{
    const int *viewport = proof->capture.draws[triangle->draw].viewport;
    return (proof->driver.height ? proof->driver.height : viewport[2 + k]) / 2.0;
}

/* The determinant of x, y and w of the corners. */
static double area_of(const Proof *proof, const ProofTriangle *triangle)
{
    double(*const places)[4] = proof->draws[triangle->draw].places;
    const double *a = places[triangle->corners[0]], *b = places[triangle->corners[1]];
    const double *c = places[triangle->corners[2]];
    return a[0] * (b[1] * c[3] - b[3] * c[1]) + a[1] * (b[3] * c[0] - b[0] * c[3]) +
           a[3] * (b[0] * c[1] - b[1] * c[0]);
}

bool proof_next(const Proof *proof, ProofTriangle *triangle)
{
    for (;; triangle->draw++, triangle->number = -1) {
        if (triangle->draw >= proof->capture.draw_count)
            return false;
        const CaptureDraw *draw = &proof->capture.draws[triangle->draw];
        if (!is_seen(draw))
            continue;
        while (3 * ++triangle->number + 2 < draw->vertex_count) {
            for (int i = 0; i < 3; i++)
                triangle->corners[i] = draw->vertices[3 * triangle->number + i];
            triangle->front = (area_of(proof, triangle) > 0) == (draw->front_face == GL_CCW);
            if (!draw->culls || (draw->cull_face == GL_BACK && triangle->front) ||
                (draw->cull_face == GL_FRONT && !triangle->front))
                return true;
        }
    }
}

/* How the shares of the corners change from a pixel to the next, by the derivative of x / w and
 * y / w at a place; zeroed, if it is behind the eye or seen from the side. */
static void find_pixel(const Proof *proof, const ProofTriangle *triangle, const double at[2],
                       double pixel[2][2])
{
    double p[3], change[3][2], slope[2][2];
    for (int k = 0; k < 3; k++) {
        const int of = k == 2 ? 3 : k;
        const double first = place(proof, triangle, 0, of);
        change[k][0] = place(proof, triangle, 1, of) - first;
        change[k][1] = place(proof, triangle, 2, of) - first;
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
static double flatness(const Proof *proof, const ProofTriangle *triangle)
{
    static const double MEASURED = 5; /* of an equilateral one with sides of 6 pixels */
    double at[3][2], longest = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            at[i][k] = place(proof, triangle, i, k) / fmax(place(proof, triangle, i, 3), 1e-6) *
                       pixels_of(proof, triangle, k);
    for (int i = 0; i < 3; i++)
        longest =
            fmax(longest, hypot(at[(i + 1) % 3][0] - at[i][0], at[(i + 1) % 3][1] - at[i][1]));
    const double area = fabs((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                             (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]));
    return fmin(fmax(MEASURED * longest / fmax(area, 1e-6), 1), 1e3);
}

/* A varying's number: linear, with the corners' error and the interpolation's. */
static GlslInput interpolated(const Proof *proof, const Output *const corners[3],
                              const double at[2], double flat)
{
    const Raster *raster = proof->driver.raster;
    const Format *format = &proof->driver.vertex->format;
    const double a = corners[0]->value, s = corners[1]->value - a, t = corners[2]->value - a;
    const double most = fmax(fabs(a), fmax(fabs(a + s), fabs(a + t)));
    const double range = fmax(fmax(fabs(s), fabs(t)), fabs(s - t));
    const double error = fmax(corners[0]->error, fmax(corners[1]->error, corners[2]->error));
    return (GlslInput){.middle = a + at[0] * s + at[1] * t,
                       .error = error +
                                fmax(raster->flat, raster->perspective) *
                                    format_ulp(format, fmax(most, 1e-30)) +
                                flat * raster->small * format_unit(format) * range,
                       .slope = {{s, s}, {t, t}}};
}

static void set_inputs(const Proof *proof, const ProofTriangle *triangle, const double at[2])
{
    ProofDraw *draw = &proof->draws[triangle->draw];
    GlslBoundRun *run = draw->runs[1];
    static const GlslRange any = {-(double)INFINITY, (double)INFINITY};
    const double flat = flatness(proof, triangle);
    for (int i = 0; i < draw->stages.link_count; i++)
        for (int k = 0; k < draw->stages.links[i].count; k++) {
            const StageLink *link = &draw->stages.links[i];
            const Output *corners[3];
            for (int c = 0; c < 3; c++)
                corners[c] = draw->vertices + triangle->corners[c] * (size_t)draw->stages.handed +
                             link->at + k;
            run->inputs[link->fragment + k] = interpolated(proof, corners, at, flat);
        }
    set(run, "gl_FrontFacing", 0, (GlslInput){.middle = triangle->front});
    for (int k = 0; k < 4; k++) /* only masks are looked up there */
        set(run, "gl_FragCoord", k, (GlslInput){.middle = .5, .slope = {any, any}});
    find_pixel(proof, triangle, at, run->pixel);
}

static double clamped(double a)
{
    return a > 0 ? fmin(a, 1) : 0;
}

ProofBound proof_piece(const Proof *proof, const ProofTriangle *triangle, const double center[2],
                       double half)
{
    const ProofDraw *draw = &proof->draws[triangle->draw];
    GlslBoundRun *run = draw->runs[1];
    ProofBound worst = {.bounded = true};
    GlslVariable color;
    set_inputs(proof, triangle, center);
    run->radius = half;
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

bool proof_color(const Proof *proof, const ProofTriangle *triangle, const double center[2],
                 double half, GlslRange channels[3])
{
    GlslBoundRun *run = proof->draws[triangle->draw].runs[1];
    GlslVariable color;
    set_inputs(proof, triangle, center);
    run->radius = half;
    if (!glsl_bound_run(run) || run->edges || run->discarded ||
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
