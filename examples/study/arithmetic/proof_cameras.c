/*
 * Uniforms from a range of cameras. What a camera that turns about a point makes of directions and
 * points of the world are sums of products of sines and cosines of its two angles, and of its
 * distance. A draw is captured from as many cameras as there are unknown factors, at the corners
 * of a triangle in either angle, far from each other, where roundings of uniforms are magnified
 * least; and from some of the range, where a uniform that is no such sum, as a half vector, is
 * found, of which nothing is known.
 */
#include "base/memory.h"
#include "lighting/lighting.h"
#include "study/arithmetic/proof_state.h"

#include <math.h>
#include <string.h>

/* By number: in the middle of the range; those of which sums are made; at both ends. */
enum { TURNED = 1, TURNS = 9, FAR = TURNED + TURNS, CHECKED, CAMERAS = CHECKED + 2 };

static const double RADIANS = 0.017453292519943295;

static void find_camera(const Proof *proof, int number, double at[3])
{
    const double share = number ? number - CHECKED : .5;
    for (int k = 0; k < 3; k++) {
        const double low = proof->cameras.low[k], high = proof->cameras.high[k];
        const double turned[3] = {120 * ((number - TURNED) / 3), 120 * ((number - TURNED) % 3), 1};
        const double far[3] = {0, 0, 2};
        at[k] = number == FAR                      ? far[k]
                : number >= TURNED && number < FAR ? turned[k]
                                                   : low + share * (high - low);
    }
}

/* With the programs of the middle, which at the ends have to be the same. */
static bool draw_from(Proof *proof, LightingPlan *plan, const Scene *scene, int number,
                      Message *message)
{
    const Capture *capture = &proof->capture;
    Scene moved = *scene;
    double at[3] = {0, 0, 1};
    if (proof->moves)
        find_camera(proof, number, at);
    orbit_move((Orbit){at[0], at[1], at[2], 0}, &moved.camera.eye, moved.camera.center,
               &moved.camera.up);
    const LightingFrame frame = {.scene = &moved, .aspect = 1};
    if (((number == 0 || number >= CHECKED) &&
         !lighting_plan(plan, plan->lighting, &frame, message)) ||
        !lighting_draw(plan, &frame, message))
        return false;
    if (number == 0)
        proof->draw_count = capture->draw_count;
    bool same = capture->draw_count == (number + 1) * proof->draw_count;
    for (int i = 0; i < proof->draw_count && same; i++)
        for (int k = 0; k < 2; k++)
            same &= strcmp(capture->draws[i].sources[k],
                           capture->draws[number * proof->draw_count + i].sources[k]) == 0;
    return same || message_set(message,
                               "--cameras: --orbit %g,%g,%g calls for other programs or shadows "
                               "than the middle of the ranges; make them smaller",
                               at[0], at[1], at[2]);
}

bool proof_capture(Proof *proof, const Scene *scene, bool shadows, Message *message)
{
    const ProofDriver *driver = &proof->driver;
    const bool narrow = driver->fragment->format.bits < driver->vertex->format.bits;
    const ShaderLoader loader = {.precision = narrow ? "mediump" : "highp"};
    const ShadowSettings none = {.way = SHADOWS_OFF};
    Lighting *lighting = NULL;
    GLint framebuffer = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer);
    capture_begin(&proof->capture, &(Canvas){.framebuffer = (GLuint)framebuffer});
    bool done = lighting_open(&lighting, &loader, message);
    LightingPlan plan = {.lighting = lighting};
    if (done && !shadows)
        lighting_use_shadows(lighting, &none);
    for (int i = 0; i < (proof->moves ? CAMERAS : 1) && done; i++)
        done = draw_from(proof, &plan, scene, i, message);
    capture_end(&proof->capture);
    lighting_plan_close(&plan);
    lighting_close(lighting);
    return done;
}

static GlslRange point(double a)
{
    return (GlslRange){a, a};
}

/* What a sum can be for cosines and sines of the two angles in these ranges. */
static GlslRange sum_of(const double parts[TURNS], GlslRange turned[2][3])
{
    GlslRange sum = {0, 0};
    for (int i = 0; i < TURNS; i++)
        if (parts[i] != 0)
            sum = range_sum(sum, range_product(point(parts[i]),
                                               range_product(turned[0][i / 3], turned[1][i % 3])));
    return sum;
}

/* {1, cos, sin} of angles that are up to `half` less or more. */
static void find_turns(const double angles[2], const double half[2], GlslRange turned[2][3])
{
    for (int k = 0; k < 2; k++) {
        const double of[3] = {1, cos(angles[k]), sin(angles[k])};
        for (int i = 0; i < 3; i++)
            turned[k][i] = (GlslRange){fmax(of[i] - (i ? half[k] : 0), -1),
                                       fmin(of[i] + (i ? half[k] : 0), 1)};
    }
}

/* Of a camera in degrees. */
static void find_camera_turns(const double at[3], GlslRange turned[2][3])
{
    find_turns((double[]){at[0] * RADIANS, at[1] * RADIANS}, (double[]){0, 0}, turned);
}

static void find_fit(const Proof *proof, ProofFit *fit, const double values[CAMERAS], double noise)
{
    double most = fabs(values[FAR]), away = 0, at[3];
    GlslRange turned[2][3];
    for (int i = 0; i < TURNS; i++) {
        find_camera(proof, TURNED + i, at);
        find_camera_turns(at, turned);
        for (int k = 0; k < TURNS; k++)
            fit->parts[k] += turned[0][k / 3].low * turned[1][k % 3].low * (k / 3 ? 2 : 1) *
                             (k % 3 ? 2 : 1) / 9 * values[TURNED + i];
        most = fmax(most, fabs(values[TURNED + i]));
    }
    fit->far = values[FAR] - values[TURNED];
    /* Each value is rounded; what they make of that between the three angles is at most 25/9. */
    away = fmax(fabs(proof->cameras.low[2] - 1), fabs(proof->cameras.high[2] - 1));
    fit->slack = (3 + 2 * away) * proof_float_error(most) + noise;
    fit->known = true;
    for (int i = 0; i < CAMERAS; i = i ? i + 1 : CHECKED) {
        find_camera(proof, i, at);
        find_camera_turns(at, turned);
        const double sum = sum_of(fit->parts, turned).low + (at[2] - 1) * fit->far;
        fit->known &= fabs(sum - values[i]) <= fit->slack + proof_float_error(fabs(sum)) + noise;
    }
}

/* The numbers of one uniform's element in a stage. */
static void find_element(const Proof *proof, int draw, const CaptureUniform *of, int first,
                         ProofFit fit)
{
    ProofDraw *made = &proof->draws[draw];
    const ptrdiff_t uniform = of - proof->capture.draws[draw].uniforms;
    double values[CAMERAS], group = 0;
    for (int j = 0; j < of->numbers; j++)
        group = fmax(group, fabs((double)of->values[first + j]));
    for (int j = 0; j < of->numbers; j++, fit.at++) {
        bool same = true;
        for (int i = 0; i < CAMERAS; i++) {
            const CaptureDraw *from = &proof->capture.draws[draw + i * proof->draw_count];
            values[i] = (double)from->uniforms[uniform].values[first + j];
            same &= values[i] == values[0];
        }
        if (same)
            continue;
        ProofFit *added =
            memory_add(&made->fits, &made->fit_count, &made->fit_room, sizeof *made->fits);
        *added = fit;
        find_fit(proof, added, values, 1e-14 * group);
    }
}

void proof_find_fits(const Proof *proof, int draw)
{
    const CaptureDraw *of = &proof->capture.draws[draw];
    GlslVariable found;
    for (int i = 0; i < of->uniform_count && proof->moves; i++)
        for (int k = 0; k < of->uniforms[i].length; k++)
            for (int stage = 0; stage < 2; stage++)
                if (stages_uniform(proof->draws[draw].stages.codes[stage], &of->uniforms[i], k,
                                   &found))
                    find_element(proof, draw, &of->uniforms[i], k * of->uniforms[i].numbers,
                                 (ProofFit){.stage = stage, .at = found.first});
}

void proof_set_fits(const Proof *proof, int draw, const ProofBox *box)
{
    const double *half = box->half;
    GlslRange turned[2][3], rates[2][2][3];
    find_turns(box->center + 2, half + 2, turned);
    for (int k = 0; k < 2; k++) { /* by one of the angles */
        memcpy(rates[k], turned, sizeof turned);
        rates[k][k][0] = point(0);
        rates[k][k][1] = (GlslRange){-turned[k][2].high, -turned[k][2].low};
        rates[k][k][2] = turned[k][1];
    }
    find_turns(box->center + 2, (double[]){0, 0}, turned);
    for (int i = 0; i < proof->draws[draw].fit_count; i++) {
        const ProofFit *fit = &proof->draws[draw].fits[i];
        GlslInput input = {.slack = fit->known ? fit->slack : (double)INFINITY};
        if (fit->known) {
            input.middle = sum_of(fit->parts, turned).low + (box->center[4] - 1) * fit->far;
            double reach = fabs(input.middle) + fit->slack + half[4] * fabs(fit->far);
            for (int k = 0; k < 2; k++) {
                input.slope[2 + k] = sum_of(fit->parts, rates[k]);
                reach += half[2 + k] * magnitude(input.slope[2 + k]);
            }
            input.slope[4] = point(fit->far);
            input.error = proof_float_error(reach);
        }
        proof->draws[draw].runs[fit->stage]->inputs[fit->at] = input;
    }
}
