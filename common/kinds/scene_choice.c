/* --error: which qualities a program's views are drawn with, and for which moments one choice is
 * made. */
#include "kinds/scene_views.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/output_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void scene_forget_choices(SceneState *state)
{
    for (int i = 0; i < state->choice_count; i++)
        cheapest_quality_close(&state->choices[i]);
    free(state->choices);
    state->choices = NULL;
    state->choice_count = 0;
}

/* The moments for which one choice is made of a view; the first is at moment.seconds. */
typedef struct Moments {
    ViewMoment moment;
    int count;
    double step;
    SceneCopy kept; /* of the last moment asked for */
} Moments;

static bool scene_at(void *data, int number, Scene *scene, Message *message)
{
    Moments *moments = data;
    ViewMoment moment = moments->moment;
    moment.seconds += number * moments->step;
    scene_copy_close(&moments->kept);
    return scene_view_make(&moment, &moments->kept, scene, message);
}

/* Of an animation up to 17 of its pictures, fewer if they are large; in a window, where time goes
 * on, four of a turn; else the one. */
static Moments moments_of(ViewMoment moment)
{
    enum { MAX = 17, WINDOW = 4, MIN = 3 };
    static const double PIXELS = 3e7, TURN = 360 / DEGREES_PER_SECOND;
    const DrawRequest *request = moment.request;
    const Canvas *canvas = moment.renderer->canvas;
    const double pixels = (double)canvas->width * canvas->height;
    Moments made = {.moment = moment, .count = 1};
    if (request->endless) {
        made.count = WINDOW;
        made.step = TURN / WINDOW;
    } else if (request->frames > 1) {
        const double most = fmax(MIN, fmin(MAX, PIXELS / pixels));
        made.count = request->frames < most ? request->frames : (int)most;
        made.moment.seconds = request->seconds;
        made.step = (request->frames - 1) / request->fps / (made.count - 1);
    }
    return made;
}

/* What is named stays as it is. */
static unsigned fixed_axes(const DrawRequest *request)
{
    const bool lights = request->terms.left_out || request->terms.lights_left_out;
    return request->fixed | (lights ? 1U << AXIS_LIGHTS : 0);
}

/* Seconds; NAN if it cannot be drawn. */
static double time_frame(const ViewMoment *moment, const Scene *scene,
                         const ObjectQuality *qualities, double aspect, int view)
{
    SceneState *state = scene_state(moment->renderer);
    QualityParts made;
    bool done = quality_parts_open(&made, scene, qualities, &state->meshes, NULL);
    canvas_clear(moment->renderer->canvas, scene->background, 1);
    glFinish();
    const double start = clock_now();
    const LightingFrame frame = {&made.scene, made.parts, aspect, moment->request->full, view};
    done = done && lighting_show(state->lighting, &frame, NULL);
    glFinish();
    const double seconds = clock_now() - start;
    quality_parts_close(&made);
    return done ? seconds : NAN;
}

/* The time to draw a view with these qualities over that of the plain ones: the median of frames
 * drawn in turn, so that what else runs disturbs both. NAN if it cannot be drawn. */
static double measure(const ViewMoment *moment, const Scene *scene, const CheapestQuality *choice,
                      double aspect)
{
    enum { ROUNDS = 9 };
    double ratios[ROUNDS];
    bool done = true;
    ObjectQuality *plain = memory_new((size_t)choice->count + 1, sizeof *plain);
    for (int i = 0; i < choice->count; i++)
        plain[i] = object_quality_plain(scene);
    for (int round = 0; round <= ROUNDS && done; round++) { /* the first compiles */
        const double usual = time_frame(moment, scene, plain, aspect, 0);
        const double chosen = time_frame(moment, scene, choice->objects, aspect, 1);
        done = isfinite(usual) && isfinite(chosen);
        if (round > 0)
            ratios[round - 1] = chosen / usual;
    }
    free(plain);
    return done ? clock_median(ratios, ROUNDS) : NAN;
}

static void tell(Moments *moments, const CheapestQuality *choice, const int place[4])
{
    const ViewMoment *moment = &moments->moment;
    Scene scene;
    if (!moment->request->verbose || choice->count == 0 || !scene_at(moments, 0, &scene, NULL))
        return;
    /* Compiling says lines of its own. */
    const double ratio = measure(moment, &scene, choice, (double)place[2] / place[3]);
    fprintf(stderr, "view %d: ", moment->view);
    cheapest_quality_write(choice, &scene, moment->request->error, stderr);
    fprintf(stderr, "; %.2f of the plain time%s\n", ratio,
            choice->cached ? "; from the cache" : "");
}

static bool choose(ViewMoment moment, CheapestQuality *choice, Message *message)
{
    SceneState *state = scene_state(moment.renderer);
    const DrawRequest *request = moment.request;
    Moments moments = moments_of(moment);
    CheapestQualityTask task = {.canvas = moment.renderer->canvas,
                                .lighting = state->lighting,
                                .full = request->full,
                                .meshes = &state->meshes,
                                .error = request->error,
                                .kept = fixed_axes(request),
                                .moments = moments.count,
                                .scene = scene_at,
                                .data = &moments,
                                .moving = request->endless || request->frames > moments.count};
    if (!scene_view_place(moment.renderer, moment.view, task.place))
        return true;
    const bool done = cheapest_quality_find(choice, &task, message);
    if (done)
        tell(&moments, choice, task.place);
    scene_copy_close(&moments.kept);
    /* Many more meshes were tried than are drawn. */
    lighting_forget(state->lighting, NULL);
    solid_meshes_close(&state->meshes);
    return done;
}

void scene_explain_choice(const Renderer *renderer, const DrawRequest *request,
                          const SceneView *view, int number, FILE *file)
{
    const CheapestQuality *choice =
        request->cheap ? &scene_state(renderer)->choices[number] : &(CheapestQuality){.count = 0};
    OutputText line;
    if (choice->count == 0)
        return;
    output_text_open(&line);
    fprintf(line.file, "view %d, --error: ", number);
    cheapest_quality_write(choice, &view->asked, request->error, line.file);
    output_text_wrap(&line, file, 2, 100);
    fprintf(file, "\n\n");
}

/* In one line, the view that is farthest from the error allowed. */
static void tell_unreached(const Renderer *renderer, const DrawRequest *request)
{
    const SceneState *state = scene_state(renderer);
    int worst = 0;
    for (int view = 1; view < state->choice_count; view++)
        if (state->choices[view].error > state->choices[worst].error)
            worst = view;
    if (state->choices[worst].error <= request->error)
        return;
    fprintf(stderr, "%s: --error %g is unreachable: the best is %.2f, inside objects",
            renderer->example->name, request->error, state->choices[worst].error);
    if (state->choice_count > 1)
        fprintf(stderr, " of view %d", worst);
    fprintf(stderr, "; drawing that\n");
}

bool scene_choose(Renderer *renderer, const DrawRequest *request, double seconds, Message *message)
{
    SceneState *state = scene_state(renderer);
    const int count = scene_view_count(renderer);
    const int width = renderer->canvas->width, height = renderer->canvas->height;
    const bool at_any = request->frames > 1 || request->endless;
    if (!request->cheap ||
        (state->choices && state->choice_count == count && state->choice_width == width &&
         state->choice_height == height && (at_any || state->choice_seconds == seconds)))
        return true;
    scene_forget_choices(state);
    state->choices = memory_new((size_t)count, sizeof *state->choices);
    state->choice_count = count;
    state->choice_width = width;
    state->choice_height = height;
    state->choice_seconds = seconds;
    for (int view = 0; view < count; view++) {
        const ViewMoment moment = {renderer, request, seconds, view};
        if (!choose(moment, &state->choices[view], message)) {
            scene_forget_choices(state);
            return false;
        }
    }
    tell_unreached(renderer, request);
    return true;
}
