#include "stage.h"

#include "animation.h"
#include "efficient.h"
#include "lighting.h"
#include "model.h"
#include "operations.h"
#include "panel.h"
#include "parse.h"
#include "progress.h"

#include <stdio.h>
#include <stdlib.h>

bool stage_open(Canvas *canvas, const Options *options, const char *output, Message *message)
{
    const double start = progress_now();
    char format[16];
    CanvasOptions wanted = options->canvas;
    wanted.width = options->width;
    wanted.height = options->height;
    if (!image_format(output, format, message))
        return false;
    wanted.real = image_format_is_float(format);
    if (!canvas_open(canvas, &wanted, message))
        return false;
    if (!options->verbose)
        return true;
    fprintf(stderr, "backend: %s, %s\nrenderer: %s, %s\n", canvas->backend->name, canvas->platform,
            canvas->renderer, canvas->version);
    fprintf(stderr, "canvas: %dx%d, RGBA %d %d %d %d, depth %d", canvas->width, canvas->height,
            canvas->red_bits, canvas->green_bits, canvas->blue_bits, canvas->alpha_bits,
            canvas->depth_bits);
    if (wanted.real && !canvas->real)
        fprintf(stderr, ", not float: the driver cannot draw to it");
    if (canvas->samples)
        fprintf(stderr, "; %d samples for each pixel, resolved by the driver", canvas->samples);
    else if (canvas->supersample > 1)
        fprintf(stderr, "; %dx%d supersampling, averaged here", canvas->supersample,
                canvas->supersample);
    fprintf(stderr, "\nprecision of fragment shaders: %s\nopening took %.1f ms\n",
            options->shaders.precision ? options->shaders.precision : "as they say",
            1e3 * (progress_now() - start));
    return true;
}

/* What draws the example on the stage, if that is a scene. */
static struct {
    Lighting
        *lightings[2];    /* as the options say; in mediump, where the table of settings says so */
    Efficient *efficient; /* with --error */
    SolidMeshes meshes;   /* of the settings */
    Marks marks;
} on_stage;

static bool open_lightings(const Options *options, Message *message)
{
    ShaderLoader loader = options->shaders;
    if (!lighting_open(&on_stage.lightings[PRECISION_HIGHP], &loader, message))
        return false;
    if (!options->cheap)
        return true;
    loader.precision = "mediump"; /* --precision does not go with --error */
    on_stage.efficient = malloc(sizeof *on_stage.efficient);
    if (!on_stage.efficient)
        return message_set(message, "not enough memory");
    return efficient_read(on_stage.efficient, message) &&
           lighting_open(&on_stage.lightings[PRECISION_MEDIUMP], &loader, message);
}

bool stage_enter(const Example *example, const Options *options, Message *message)
{
    const double start = progress_now();
    const bool done = example->init(&options->shaders, message) &&
                      (!example->scene || open_lightings(options, message)) &&
                      (!example->annotate || options->shaders.print ||
                       marks_open(&on_stage.marks, &options->shaders, message));
    if (!done) {
        stage_leave(example);
        return false;
    }
    if (options->verbose)
        fprintf(stderr, "%s: init took %.1f ms\n", example->name, 1e3 * (progress_now() - start));
    return true;
}

void stage_leave(const Example *example)
{
    GLint attributes = 0;
    example->finish();
    for (int i = 0; i < 2; i++) {
        lighting_close(on_stage.lightings[i]);
        on_stage.lightings[i] = NULL;
    }
    free(on_stage.efficient);
    on_stage.efficient = NULL;
    solid_meshes_close(&on_stage.meshes);
    marks_close(&on_stage.marks);
    glUseProgram(0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &attributes);
    for (GLint i = 0; i < attributes; i++)
        glDisableVertexAttribArray((GLuint)i);
}

/* How the views lie; the number of views. */
static int view_layout(const Example *example, int *columns, int *rows)
{
    *columns = *rows = 1;
    if (example->layout)
        example->layout(columns, rows);
    return *columns * *rows;
}

static int view_count(const Example *example)
{
    int columns, rows;
    return view_layout(example, &columns, &rows);
}

/* The part of the picture that a view has: x, y, width, height, in pixels from the upper left. */
static void view_place(const Example *example, int view, int width, int height, int place[4])
{
    int columns, rows;
    view_layout(example, &columns, &rows);
    const int column = view % columns, row = view / columns;
    place[0] = column * width / columns;
    place[1] = row * height / rows;
    place[2] = (column + 1) * width / columns - place[0];
    place[3] = (row + 1) * height / rows - place[1];
}

/* The scene of a view, as the example and the options want it, and what draws it. */
typedef struct View {
    Scene asked, scene; /* before and after --error */
    SettingScene made;
    Lighting *lighting;
} View;

/* Draws as the cheapest setting does that is exact enough for scenes of this class. */
static bool choose_setting(View *view, int number, const Options *options, Message *message)
{
    const SceneClass class = scene_class(&view->scene);
    const EfficientRow *row = efficient_choose(on_stage.efficient, class, options->error, message);
    if (!row ||
        !setting_scene_open(&view->made, &view->scene, &row->setting, &on_stage.meshes, message))
        return false;
    view->scene = view->made.scene;
    view->lighting = on_stage.lightings[row->setting.choice[AXIS_PRECISION]];
    if (options->verbose) {
        char text[SETTING_TEXT_SIZE];
        setting_text(&row->setting, text);
        fprintf(stderr, "view %d: class %s: %s; error at most %.2f steps of 1/255 in %s\n", number,
                SCENE_CLASS_NAMES[class], text, row->maximum, on_stage.efficient->path);
    }
    return true;
}

/* What is to be seen, however it is drawn. */
static bool view_scene(Scene *scene, const Example *example, const Options *options, double seconds,
                       int number, Message *message)
{
    *scene = (Scene){.object_count = 0};
    example->scene(seconds, number, scene);
    Camera *camera = &scene->camera;
    orbit_move(options->orbit, &camera->eye, camera->center, &camera->up);
    scene->clamp_vertex |= options->clamp_vertex;
    scene->linear |= options->linear;
    scene->show_clipped |= options->show_clipped;
    return scene_check(scene, message);
}

static bool view_open(View *view, const Example *example, const Options *options, double seconds,
                      int number, Message *message)
{
    *view = (View){.lighting = on_stage.lightings[PRECISION_HIGHP]};
    if (!view_scene(&view->asked, example, options, seconds, number, message))
        return false;
    view->scene = view->asked;
    return !options->cheap || choose_setting(view, number, options, message);
}

static void view_close(View *view)
{
    setting_scene_close(&view->made);
}

static bool draw_marks(const Example *example, double seconds, int number, const Scene *scene,
                       double aspect, Message *message)
{
    static const double POINT_SIZE = 10;
    Annotations annotations = {{.count = 0}, {.count = 0}};
    example->annotate(seconds, number, scene, &annotations);
    const bool done =
        marks_draw(&on_stage.marks, &annotations.lines, GL_LINES, 1, scene, aspect, message) &&
        marks_draw(&on_stage.marks, &annotations.points, GL_POINTS, POINT_SIZE, scene, aspect,
                   message);
    marks_list_close(&annotations.lines);
    marks_list_close(&annotations.points);
    return done;
}

static bool draw_view(const Example *example, const Options *options, double seconds, int number,
                      double aspect, bool bare, Message *message)
{
    View view;
    const bool done = view_open(&view, example, options, seconds, number, message) &&
                      lighting_draw(view.lighting, &view.scene, aspect, options->full, message) &&
                      (bare || !example->annotate || !on_stage.marks.buffer ||
                       draw_marks(example, seconds, number, &view.scene, aspect, message));
    view_close(&view);
    return done;
}

/* The colour behind everything. */
static Vec3 background(const Example *example, double seconds)
{
    Scene scene = {.object_count = 0};
    if (!example->scene)
        return (Vec3){(double)example->clear_color[0], (double)example->clear_color[1],
                      (double)example->clear_color[2]};
    example->scene(seconds, 0, &scene);
    return scene.background;
}

/* `bare`: without marks. */
static bool draw(const Example *example, const Canvas *canvas, const Options *options,
                 double seconds, bool bare, Message *message)
{
    if (options->alpha)
        canvas_clear(canvas, (Vec3){0, 0, 0}, 0);
    else
        canvas_clear(canvas, background(example, seconds), 1);
    if (!example->scene) {
        const Frame frame = {.seconds = seconds,
                             .aspect = (double)canvas->width / canvas->height,
                             .orbit = options->orbit};
        if (example->draw(&frame))
            return true;
        return message_set(message, "no matrix can be made for time %g s at %dx%d", seconds,
                           canvas->width, canvas->height);
    }
    for (int view = 0; view < view_count(example); view++) {
        int place[4];
        view_place(example, view, canvas->width, canvas->height, place);
        if (place[2] < 1 || place[3] < 1)
            continue; /* less than a pixel */
        canvas_view(canvas, place[0], place[1], place[2], place[3]);
        if (!draw_view(example, options, seconds, view, (double)place[2] / place[3], bare, message))
            return false;
    }
    return true;
}

bool stage_draw(const Example *example, const Canvas *canvas, const Options *options,
                double seconds, Message *message)
{
    return draw(example, canvas, options, seconds, false, message);
}

/* Gives a picture to appraise its views; those without objects are not drawn, but made of others.
 */
static bool add_views(const Example *example, const Options *options, AppraisePicture *picture,
                      Message *message)
{
    bool done = true;
    for (int number = 0; number < view_count(example) && done; number++) {
        View view;
        int place[4];
        view_place(example, number, picture->image.width, picture->image.height, place);
        if (place[2] < 1 || place[3] < 1)
            continue;
        done = view_open(&view, example, options, picture->seconds, number, message) &&
               (view.asked.object_count == 0 ||
                appraise_picture_add(picture, place, &view.asked,
                                     options->cheap ? &view.scene : NULL, message));
        view_close(&view);
    }
    return done;
}

bool stage_appraise(const Example *example, const Canvas *canvas, const Options *options,
                    double seconds, AppraisePicture *picture, Message *message)
{
    Options bare = *options;
    bare.alpha = bare.verbose = false; /* the exact picture has a background */
    if (!appraise_picture_open(picture, canvas->width, canvas->height,
                               canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, view_count(example),
                               message))
        return false;
    picture->seconds = seconds;
    if (draw(example, canvas, &bare, seconds, true, message) &&
        canvas_read(canvas, &picture->image, message) &&
        add_views(example, &bare, picture, message))
        return true;
    appraise_picture_close(picture);
    return false;
}

/* On all programs so far. */
static LightingCounts spent(void)
{
    LightingCounts sum = {.programs = 0};
    for (int i = 0; i < 2 && on_stage.lightings[i]; i++) {
        const LightingCounts counts = lighting_counts(on_stage.lightings[i]);
        sum.programs += counts.programs;
        sum.compile_seconds += counts.compile_seconds;
    }
    return sum;
}

/* What an object's program computes, and beside it the full one; or why that is not known. */
static void explain_operations(const Lighting *lighting, const Scene *scene, const Object *object)
{
    static const char *const names[] = {"operations", "in the full program"};
    Message message = {0};
    for (int full = 0; full < 2 && !message.text[0]; full++) {
        ShaderSource sources[2];
        Operations vertex, fragment;
        if (lighting_sources(lighting, scene, object, full, sources, &message) &&
            operations_count(sources[SHADER_VERTEX].text, SHADER_VERTEX, &vertex, &message) &&
            operations_count(sources[SHADER_FRAGMENT].text, SHADER_FRAGMENT, &fragment, &message))
            printf("%s: %d per vertex (%d special), %d per fragment (%d special)\n", names[full],
                   vertex.arithmetic + vertex.special, vertex.special,
                   fragment.arithmetic + fragment.special, fragment.special);
        shader_source_close(&sources[SHADER_VERTEX]);
        shader_source_close(&sources[SHADER_FRAGMENT]);
    }
    if (message.text[0])
        printf("%s\n", message.text);
}

bool stage_renew(const Example *example, const Options *options, Message *message)
{
    example->finish();
    for (int i = 0; i < 2; i++)
        if (on_stage.lightings[i])
            lighting_forget(on_stage.lightings[i], NULL);
    return example->init(&options->shaders, message);
}

static void write_effects(const Example *example, int view, const Scene *scene, int object,
                          FILE *file)
{
    fprintf(file, "# %s, view %d, object %d\n", example->name, view, object);
    effects_explain(scene, &scene->objects[object], file);
}

void stage_effects(const Example *example, const Options *options, FILE *file)
{
    for (int number = 0; number < view_count(example); number++) {
        View view;
        if (view_open(&view, example, options, options->seconds, number, NULL))
            for (int i = 0; i < view.scene.object_count; i++)
                write_effects(example, number, &view.scene, i, file);
        view_close(&view);
    }
}

static bool explain_view(const Example *example, const Options *options, int number,
                         Message *message)
{
    View view;
    bool done = view_open(&view, example, options, options->seconds, number, message);
    for (int i = 0; i < view.scene.object_count && done; i++) {
        const Object *object = &view.scene.objects[i];
        write_effects(example, number, &view.scene, i, stdout);
        const int programs = lighting_counts(view.lighting).programs;
        done = lighting_program(view.lighting, &view.scene, object, options->full, message) != 0;
        if (done && lighting_counts(view.lighting).programs > programs)
            explain_operations(view.lighting, &view.scene, object);
        else if (done)
            printf("its program is one of those above\n");
        printf("\n");
    }
    view_close(&view);
    return done;
}

bool stage_explain(const Example *example, const Options *options, Message *message)
{
    if (!example->scene)
        return message_set(message, "--explain: this program's shaders are written by hand");
    for (int number = 0; number < view_count(example); number++)
        if (!explain_view(example, options, number, message))
            return false;
    const LightingCounts counts = spent();
    printf("# %d programs, compiled and linked in %.1f ms\n", counts.programs,
           1e3 * counts.compile_seconds);
    return true;
}

/* Each view's text, at its foot. */
static bool label_views(const Example *example, Image *image, Message *message)
{
    enum { SIZE = 12, FOOT = 6 };
    for (int view = 0; view < view_count(example); view++) {
        const char *text = example->label(view);
        int place[4];
        view_place(example, view, image->width, image->height, place);
        if (text && place[3] > 4 * SIZE &&
            !image_label(image, place[0] + place[2] / 2, place[1] + place[3] - FOOT, SIZE, text,
                         message))
            return false;
    }
    return true;
}

/* Where samples of an object and of the transparent background, which is black, were averaged, the
 * colour is that of the object times its share, which alpha tells. */
static void divide_by_alpha(Image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        float *real = (float *)image->pixels + 4 * i;
        unsigned char *byte = (unsigned char *)image->pixels + 4 * i;
        for (int c = 0; c < 3; c++) {
            if (image->type == IMAGE_FLOAT && real[3] > 0 && real[3] < 1) {
                real[c] /= real[3];
            } else if (image->type == IMAGE_BYTE && byte[3] > 0 && byte[3] < 255) {
                const int color = (255 * byte[c] + byte[3] / 2) / byte[3];
                byte[c] = (unsigned char)(color < 255 ? color : 255);
            }
        }
    }
}

bool stage_picture(const Example *example, const Canvas *canvas, const Options *options,
                   double seconds, Picture *picture, Message *message)
{
    char number[32], orbit[96];
    Image *image = &picture->image;
    if (image->width != canvas->width || image->height != canvas->height) {
        const ImageType type = image->type;
        image_close(image);
        if (!image_open(image, canvas->width, canvas->height, type, message))
            return false;
    }
    if (!stage_draw(example, canvas, options, seconds, message) ||
        !canvas_read(canvas, image, message))
        return false;
    const bool averaged = canvas->samples || canvas->supersample > 1;
    if (options->alpha && averaged)
        divide_by_alpha(image);
    if (options->verbose && example->scene) {
        const LightingCounts counts = spent();
        fprintf(stderr, "%d programs so far, compiled and linked in %.1f ms\n", counts.programs,
                1e3 * counts.compile_seconds);
    }
    if (picture->image.type == IMAGE_BYTE) {
        if (example->retouch)
            example->retouch(&picture->image);
        if (example->label && !label_views(example, &picture->image, message))
            return false;
    }
    picture->compress = options->compress;
    picture->alpha = options->alpha;
    snprintf(picture->title, sizeof picture->title, "%s", example->name);
    parse_number_text(seconds, number);
    snprintf(picture->moment, sizeof picture->moment, "%s s", number);
    const bool moved = orbit_text(options->orbit, orbit);
    snprintf(picture->settings, sizeof picture->settings,
             "--size %dx%d --samples %d%s%s%s%s%s; backend %s, %s; %s", canvas->width,
             canvas->height, options->canvas.samples, moved ? " --orbit " : "", orbit,
             options->shaders.precision ? " --precision " : "",
             options->shaders.precision ? options->shaders.precision : "",
             options->alpha ? " --alpha" : "", canvas->backend->name, canvas->platform,
             canvas->renderer);
    return true;
}

int stage_doctor(void)
{
    const CanvasBackend *usual = canvas_default_backend(NULL), *works = NULL;
    for (int i = 0; CANVAS_BACKENDS[i]; i++) {
        printf("%s: %s\n", CANVAS_BACKENDS[i]->name, CANVAS_BACKENDS[i]->summary);
        if (CANVAS_BACKENDS[i]->doctor() && (!works || CANVAS_BACKENDS[i] == usual))
            works = CANVAS_BACKENDS[i];
    }
    printf("pictures:\n");
    image_doctor();
    printf("animations:\n");
    animation_doctor();
    printf("models:\n");
    model_doctor();
    printf("the panel of windows:\n");
    panel_doctor();
    if (works && works == usual)
        printf("This machine can draw.\n");
    else if (works)
        printf("This machine can draw with --backend %s.\n", works->name);
    else
        printf("This machine cannot draw yet.\n");
    return works ? 0 : EXIT_FAILED;
}
