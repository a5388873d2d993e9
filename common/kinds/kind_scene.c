/* Programs that describe a scene: `lighting` draws its views, marks and labels go on top. */
#include "base/memory.h"
#include "images/label.h"
#include "kinds/scene_views.h"

#include <stdio.h>
#include <stdlib.h>

static void describe(const Example *example, Usage *usage)
{
    const SceneExample *scene = example_scene(example);
    usage->shadows = SHADOWS_DEFAULT;
    usage->shadows.way = scene->shadows ? SHADOWS_ON : SHADOWS_OFF;
    usage->resize = scene->size;
    usage->operand = scene->operand;
    usage->names = scene->operand ? "FILE" : NULL;
}

static bool open_scene(Renderer *renderer, const ShaderLoader *loader, Message *message)
{
    SceneState *state = renderer->state = memory_new(1, sizeof *state);
    const bool marks = example_scene(renderer->example)->annotate && !loader->print;
    return lighting_open(&state->lighting, loader, message) &&
           (!marks || overlay_open(&state->overlay, loader, message));
}

static void forget_scene(Renderer *renderer)
{
    SceneState *state = scene_state(renderer);
    scene_forget_choices(state);
    scene_forget_exact(renderer);
    lighting_forget(state->lighting, NULL);
}

static void close_scene(Renderer *renderer)
{
    SceneState *state = scene_state(renderer);
    if (!state)
        return;
    scene_forget_choices(state);
    scene_forget_exact(renderer);
    lighting_close(state->lighting);
    solid_meshes_close(&state->meshes);
    overlay_close(&state->overlay);
    free(state);
}

/* Drawing */

/* What a frame is drawn with; `marks`: of the annotations, in pictures for people. */
typedef struct FrameTask {
    Renderer *renderer;
    const DrawRequest *request;
    double seconds;
    bool marks;
} FrameTask;

/* The annotations, with the overlay opened by who needs it first; and the normals. */
static bool draw_marks(const FrameTask *task, int number, const Scene *scene, double aspect,
                       Message *message)
{
    static const double POINT_SIZE = 10;
    const Renderer *renderer = task->renderer;
    const int side = renderer->canvas->supersample; /* of a pixel of the picture */
    Overlay *overlay = &scene_state(renderer)->overlay;
    const SceneExample *example = example_scene(renderer->example);
    Annotations marks = {.lines = {.size = side},
                         .points = {.points = true, .size = side * POINT_SIZE}};
    if (example->annotate)
        example->annotate(task->seconds, number, scene, &marks);
    if (task->request->normals)
        overlay_add_normals(&marks.lines, scene);
    const bool done =
        (overlay->buffer || overlay_open(overlay, &task->request->shaders, message)) &&
        overlay_draw(overlay, &marks.lines, scene, aspect, message) &&
        overlay_draw(overlay, &marks.points, scene, aspect, message);
    overlay_list_close(&marks.lines);
    overlay_list_close(&marks.points);
    return done;
}

static bool draw_view(const FrameTask *task, int number, double aspect, Message *message)
{
    const SceneState *state = scene_state(task->renderer);
    const bool marks = task->marks && (state->overlay.buffer || task->request->normals);
    SceneView view;
    const bool done =
        scene_view_open(&view, task->renderer, task->request, task->seconds, number, message) &&
        lighting_show(
            state->lighting,
            &(LightingFrame){&view.scene, view.made.parts, aspect, task->request->full, number},
            message) &&
        (!marks || draw_marks(task, number, &view.scene, aspect, message));
    scene_view_close(&view);
    return done;
}

static Vec3 background(const Example *example, double seconds)
{
    Scene scene = {.object_count = 0};
    example_scene(example)->make(seconds, 0, &scene);
    return scene.background;
}

static bool draw_frame(const FrameTask *task, Message *message)
{
    Renderer *renderer = task->renderer;
    const DrawRequest *request = task->request;
    const Canvas *canvas = renderer->canvas;
    lighting_use_shadows(scene_state(renderer)->lighting, &request->shadows);
    if (!scene_choose(renderer, request, task->seconds, message))
        return false;
    /* The exact picture has a background, and alpha says what the objects cover. */
    if (task->marks)
        renderer_clear(renderer, request, background(renderer->example, task->seconds));
    else
        canvas_clear(canvas, background(renderer->example, task->seconds), 0);
    for (int view = 0; view < scene_view_count(renderer); view++) {
        int place[4];
        if (!scene_view_place(renderer, view, place))
            continue;
        canvas_view(canvas, place[0], place[1], place[2], place[3]);
        if (!draw_view(task, view, (double)place[2] / place[3], message))
            return false;
    }
    return true;
}

static bool draw(Renderer *renderer, const DrawRequest *request, double seconds, Message *message)
{
    const FrameTask task = {renderer, request, seconds, true};
    return draw_frame(&task, message);
}

/* Views without objects have no exact picture of their own. */
static bool add_views(Renderer *renderer, const DrawRequest *request, ErrorPicture *picture,
                      Message *message)
{
    bool done = true;
    for (int number = 0; number < scene_view_count(renderer) && done; number++) {
        SceneView view;
        int place[4];
        if (!scene_view_place(renderer, number, place))
            continue;
        done = scene_view_open(&view, renderer, request, picture->seconds, number, message) &&
               (view.asked.object_count == 0 ||
                error_picture_add(picture, place, &view.asked, view.made.parts ? &view.scene : NULL,
                                  message));
        scene_view_close(&view);
    }
    return done;
}

bool scene_error_picture(Renderer *renderer, const DrawRequest *request, double seconds,
                         ErrorPicture *picture, Message *message)
{
    const Canvas *canvas = renderer->canvas;
    DrawRequest quiet = *request;
    const FrameTask task = {renderer, &quiet, seconds, false};
    quiet.verbose = false;
    if (!error_picture_open(picture, canvas->width, canvas->height,
                            canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, scene_view_count(renderer),
                            message))
        return false;
    picture->seconds = seconds;
    picture->simplified = quiet.cheap;
    if (draw_frame(&task, message) && canvas_read(canvas, &picture->image, message) &&
        add_views(renderer, &quiet, picture, message))
        return true;
    error_picture_close(picture);
    return false;
}

/* The finished picture */

/* Of many frames those that needed another program. */
static void report(const Renderer *renderer)
{
    SceneState *state = scene_state(renderer);
    const LightingCounts counts = lighting_counts(state->lighting);
    if (counts.programs == state->reported)
        return;
    state->reported = counts.programs;
    fprintf(stderr, "programs so far: %d, compiled and linked in %.1f ms\n", counts.programs,
            1e3 * counts.compile_seconds);
}

/* Whether an option of all scenes changes what a view computes. */
static bool is_changed(const SceneExample *scene, const DrawRequest *request)
{
    const SceneTerms *terms = &request->terms;
    return terms->left_out || terms->lights_left_out || terms->unlit || request->full ||
           request->cheap || request->clamp_vertex || request->signed_dots || request->linear ||
           request->show_clipped || request->tints.tinted ||
           (request->shadows.way != SHADOWS_OFF) != scene->shadows;
}

/* All captions in one size, or none where one does not fit. */
static bool label_views(const Renderer *renderer, const DrawRequest *request, Image *image,
                        Message *message)
{
    const SceneExample *scene = example_scene(renderer->example);
    const bool plain = scene->plain_label && is_changed(scene, request);
    const int count = scene_view_count(renderer);
    int size = 12;
    for (int i = 0; i < 2 * count; i++) { /* measured, then drawn */
        const char *text = plain ? scene->plain_label(i % count) : scene->label(i % count);
        int place[4];
        if (!text || !scene_view_place(renderer, i % count, place))
            continue;
        if (!(i < count ? image_caption_size(place, text, &size, message)
                        : size == 0 || image_caption(image, place, size, text, message)))
            return false;
    }
    return true;
}

static bool retouches(const Example *example)
{
    const SceneExample *scene = example_scene(example);
    return scene->retouch || scene->label;
}

static bool retouch(Renderer *renderer, const DrawRequest *request, Image *image, Message *message)
{
    const SceneExample *scene = example_scene(renderer->example);
    if (scene->retouch)
        scene->retouch(image);
    return !scene->label || label_views(renderer, request, image, message);
}

/* The first view, as it is asked for. */
static bool save(const Example *example, const DrawRequest *request, const char *path,
                 Message *message)
{
    static const ShaderLoader none = {.only_texts = true};
    const Renderer renderer = {.example = example};
    const ViewMoment moment = {&renderer, request, request->seconds, 0};
    SceneCopy kept = {.lights = NULL};
    Scene scene;
    int columns, rows;
    const int views = scene_view_grid(example_scene(example), &columns, &rows);
    const bool done = example->init(&none, message) &&
                      scene_view_make(&moment, &kept, &scene, message) &&
                      scene_save(&scene, path, message);
    if (done && views > 1)
        message_set(message, "%s has the first of the %d views", path, views);
    scene_copy_close(&kept);
    example->finish();
    return done;
}

const ExampleKind SCENE_KIND = {
    .compiles_late = true,
    .program = PROGRAM_ONE,
    .options = SCENE_OPTIONS,
    .describe = describe,
    .check = scene_check_names,
    .find_ineffective = ineffective_scene_options,
    .open = open_scene,
    .forget = forget_scene,
    .close = close_scene,
    .draw = draw,
    .report = report,
    .retouches = retouches,
    .retouch = retouch,
    .save = save,
    .explain = explain_programs,
    .exact = scene_exact_pixel,
    .panel = &SCENE_PANEL,
};
