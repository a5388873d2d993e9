/* A scene's draws, captured and made ready for pieces (proof_piece.c). */
#include "base/memory.h"
#include "study/arithmetic/proof_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

double proof_float_error(double magnitude)
{
    int exponent;
    frexp(magnitude, &exponent);
    return ldexp(1, exponent - 25);
}

/* A uniform is rounded to a float, unless it was meant to be short: of 2^12 numbers one is by
 * chance. */
static double uniform_error(double value)
{
    int exponent;
    const double part = frexp(value, &exponent) * 0x1p12;
    return part == rint(part) ? 0 : proof_float_error(value);
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

static Output output_of(GlslBoundRun *run, int at)
{
    const GlslBound bound = glsl_bound(run, at);
    Output made = {
        bound.middle, run->stopped ? (double)INFINITY : bound.error, bound.slack, {{0, 0}}};
    memcpy(made.slope, bound.slope, sizeof made.slope);
    return made;
}

static void run_vertex(ProofDraw *made, const CaptureDraw *draw, unsigned vertex, Output *handed)
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
    for (int i = 0; i < made->stages.link_count; i++)
        for (int k = 0; k < made->stages.links[i].count; k++)
            handed[PROOF_PLACE + made->stages.links[i].at + k] =
                output_of(run, made->stages.links[i].vertex + k);
    for (int k = 0; k < PROOF_PLACE; k++)
        if (glsl_find(run->code, k < 4 ? "gl_Position" : "gl_PointSize", &found))
            handed[k] = output_of(run, found.first + (k < 4 ? k : 0));
}

static size_t stride_of(const ProofDraw *draw)
{
    return (size_t)draw->stages.handed + PROOF_PLACE;
}

const Output *proof_output(const Proof *proof, int draw, unsigned vertex)
{
    ProofDraw *made = &proof->draws[draw];
    Output *handed = made->vertices + vertex * stride_of(made);
    if (made->moments[vertex] != made->moment) {
        run_vertex(made, &proof->capture.draws[draw], vertex, handed);
        made->moments[vertex] = made->moment;
    }
    return handed;
}

static void open_vertices(ProofDraw *made, const CaptureDraw *draw)
{
    unsigned most = 0;
    for (int i = 0; i < draw->vertex_count; i++)
        most = draw->vertices[i] > most ? draw->vertices[i] : most;
    made->moments = memory_new((size_t)most + 1, sizeof *made->moments);
    made->vertices = memory_new(((size_t)most + 1) * stride_of(made), sizeof *made->vertices);
    made->moment = 1;
}

static bool is_colored(const CaptureDraw *draw)
{
    return draw->colors[0] && draw->sources[0] && draw->sources[1];
}

bool proof_is_drawn(const Proof *proof, int draw)
{
    return proof->capture.draws[draw].mode == GL_TRIANGLES &&
           is_colored(&proof->capture.draws[draw]);
}

static bool open_draws(Proof *proof, Message *message)
{
    const Capture *capture = &proof->capture;
    proof->draws = memory_new((size_t)proof->draw_count + 1, sizeof *proof->draws);
    for (int i = 0; i < proof->draw_count; i++) {
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
        proof_find_fits(proof, i);
        open_vertices(made, draw);
    }
    return true;
}

bool proof_open(Proof *proof, const Scene *scene, const ProofDriver *driver, bool shadows,
                const ProofCameras *cameras, Message *message)
{
    *proof = (Proof){.driver = *driver, .moves = cameras != NULL};
    if (cameras)
        proof->cameras = *cameras;
    if (proof_capture(proof, scene, shadows, message) && open_draws(proof, message))
        return true;
    proof_close(proof);
    return false;
}

bool proof_of_capture(Proof *proof, Message *message)
{
    proof->draw_count = proof->capture.draw_count;
    if (open_draws(proof, message))
        return true;
    proof_close(proof);
    return false;
}

void proof_close(Proof *proof)
{
    for (int i = 0; proof->draws && i < proof->draw_count; i++) {
        ProofDraw *draw = &proof->draws[i];
        for (int k = 0; k < 2; k++)
            if (draw->runs[k])
                glsl_bound_close(draw->runs[k]);
        stages_close(&draw->stages);
        free(draw->vertices);
        free(draw->moments);
        free(draw->fits);
    }
    free(proof->draws);
    capture_close(&proof->capture);
    *proof = (Proof){.draws = NULL};
}
