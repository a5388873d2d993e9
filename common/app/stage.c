#include "app/stage.h"

#include "app/command.h"
#include "base/clock.h"
#include "base/parse.h"
#include "images/label.h"
#include "scene/scene_example.h"
#include "window/backends.h"
#include "window/window.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Nothing is half-written: the thread that called Xlib is the one that writes files. Not exit():
 * drivers would contact the display. */
static void end_without_display(const char *program)
{
    fflush(stdout);
    fprintf(stderr,
            "%s: window: the connection to the display was lost; leave out --window to draw "
            "without one\n",
            program);
    _exit(EXIT_FAILED);
}

static void describe_canvas(const Canvas *canvas, const CanvasOptions *wanted)
{
    fprintf(stderr, "backend: %s, %s\nrenderer: %s, %s\n", canvas->backend->name, canvas->platform,
            canvas->renderer, canvas->version);
    fprintf(stderr, "canvas: %dx%d, RGBA %d %d %d %d, depth %d", canvas->width, canvas->height,
            canvas->red_bits, canvas->green_bits, canvas->blue_bits, canvas->alpha_bits,
            canvas->depth_bits);
    if (wanted->real && !canvas->real)
        fprintf(stderr, ", not float: the driver cannot draw to it");
    if (canvas->samples)
        fprintf(stderr, "; %d samples for each pixel, resolved by the driver", canvas->samples);
    else if (canvas->supersample > 1)
        fprintf(stderr, "; %dx%d supersampling, averaged here", canvas->supersample,
                canvas->supersample);
    fprintf(stderr, "\n");
}

bool stage_open_canvas(Canvas *canvas, const Options *options, const char *output, Message *message)
{
    const double start = clock_now();
    char format[16];
    Message why = {0};
    CanvasOptions wanted = options->canvas;
    wanted.width = options->width;
    wanted.height = options->height;
    wanted.lost = end_without_display;
    wanted.supersampled = options_have_shadows(options);
    if (!wanted.backend) /* canvas_open does not know the window */
        wanted.backend = backend_default(message);
    if (!wanted.backend || !image_format(output, format, message))
        return false;
    wanted.real = image_format_is_float(format);
    if (!canvas_open(canvas, &wanted, &why)) {
        const bool window = strncmp(why.text, "window: ", 8) == 0;
        return message_set(message, "%s%s", why.text,
                           window ? "; leave out --window to draw to a file, which needs none"
                                  : "");
    }
    if (options->verbose) {
        describe_canvas(canvas, &wanted);
        fprintf(stderr, "precision of fragment shaders: %s\nopening took %.1f ms\n",
                options->shaders.precision ? options->shaders.precision : "as in the files",
                1e3 * (clock_now() - start));
    }
    return true;
}

/* Prints shaders on standard output and, with --verbose, compile times on standard error. */
static ShaderLoader loader_of(const Options *options)
{
    ShaderLoader loader = options->shaders;
    loader.printed = stdout;
    loader.advise = true;
    loader.log = options->verbose ? stderr : NULL;
    return loader;
}

static void forget_choices(Stage *stage)
{
    for (int i = 0; i < stage->choice_count; i++)
        cheapest_quality_close(&stage->choices[i]);
    free(stage->choices);
    stage->choices = NULL;
    stage->choice_count = 0;
}

bool stage_open(Stage *stage, const Example *example, const Canvas *canvas, const Options *options,
                Message *message)
{
    const double start = clock_now();
    ShaderLoader loader = loader_of(options);
    const SceneExample *scene = example->scene;
    *stage = (Stage){.example = example, .canvas = canvas};
    loader.warning = &stage->warning;
    if ((example->init && !example->init(&loader, message)) ||
        (scene && !lighting_open(&stage->lighting, &loader, message)) ||
        (scene && scene->annotate && !loader.print &&
         !overlay_open(&stage->overlay, &loader, message))) {
        stage_close(stage);
        return false;
    }
    if (options->verbose)
        fprintf(stderr, "%s: init took %.1f ms\n", example->name, 1e3 * (clock_now() - start));
    return true;
}

void stage_warn(const Stage *stage)
{
    if (stage->warning.text[0])
        options_warn(stage->example->name, &stage->warning);
}

void stage_close(Stage *stage)
{
    GLint attributes = 0;
    if (!stage->example)
        return;
    const bool diagram = stage->example->diagram;
    if (stage->example->finish)
        stage->example->finish();
    forget_choices(stage);
    lighting_close(stage->lighting);
    solid_meshes_close(&stage->meshes);
    overlay_close(&stage->overlay);
    *stage = (Stage){.example = NULL};
    if (diagram) /* perhaps without a context */
        return;
    glUseProgram(0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &attributes);
    for (GLint i = 0; i < attributes; i++)
        glDisableVertexAttribArray((GLuint)i);
}

bool stage_renew(Stage *stage, const Options *options, Message *message)
{
    ShaderLoader loader = loader_of(options);
    if (stage->example->diagram)
        return true;
    stage->warning = (Message){0};
    loader.warning = &stage->warning;
    stage->example->finish();
    forget_choices(stage);
    if (stage->lighting)
        lighting_forget(stage->lighting, NULL);
    return stage->example->init(&loader, message);
}

/* Views */

static int view_layout(const Stage *stage, int *columns, int *rows)
{
    *columns = *rows = 1;
    if (stage->example->scene && stage->example->scene->layout)
        stage->example->scene->layout(columns, rows);
    return *columns * *rows;
}

int stage_view_count(const Stage *stage)
{
    int columns, rows;
    return view_layout(stage, &columns, &rows);
}

/* As stage_view_place, in a picture of this size. */
static bool view_place(const Stage *stage, int view, int width, int height, int place[4])
{
    int columns, rows;
    view_layout(stage, &columns, &rows);
    const int column = view % columns, row = view / columns;
    place[2] = width / columns; /* all are equal; what is left over stays empty */
    place[3] = height / rows;
    place[0] = column * place[2];
    place[1] = row * place[3];
    return place[2] > 0 && place[3] > 0;
}

bool stage_view_place(const Stage *stage, int view, int place[4])
{
    return view_place(stage, view, stage->canvas->width, stage->canvas->height, place);
}

/* Of a view in the picture that the program makes without --size. */
static double designed_aspect(const Stage *stage)
{
    const Usage usage = options_usage(stage->example);
    int width, height, columns, rows;
    options_size(&usage, &width, &height);
    view_layout(stage, &columns, &rows);
    return (double)width * rows / ((double)height * columns);
}

/* `kept` has the lights and objects of --terms, --light-at and --light-color; closed by the caller,
 * whatever is returned. */
static bool make_scene(const Stage *stage, const Options *options, double seconds, int number,
                       SceneCopy *kept, Scene *scene, Message *message)
{
    char orbit[96];
    stage->example->scene->make(seconds, number, scene);
    orbit_move(options->orbit, &scene->camera.eye, scene->camera.center, &scene->camera.up);
    scene->clamp_vertex |= options->clamp_vertex;
    scene->linear |= options->linear;
    scene->show_clipped |= options->show_clipped;
    scene->camera.aspect = designed_aspect(stage);
    if (!scene_check(scene, message))
        return false;
    if (orbit_text(options->orbit, orbit))
        scene_fit_depth(scene);
    const SceneTerms *terms = &options->terms;
    const bool shadows = options_have_shadows(options);
    const bool own = stage->example->scene->shadows;
    if (!terms->left_out && !terms->lights_left_out && !terms->unlit && !options->places.placed &&
        !options->tints.tinted && shadows == own)
        return true;
    if (!scene_copy_open(kept, scene, false, message))
        return false;
    scene_place_lights(kept, &options->places);
    scene_tint_lights(kept, &options->tints);
    scene_keep_terms(kept, *terms);
    for (int i = 0; i < scene->light_count && shadows != own; i++)
        kept->lights[i].shadows = shadows;
    *scene = kept->scene;
    return scene_check(scene, message);
}

/* --error */

/* A view at the moments for which one choice is made. */
typedef struct Moments {
    const Stage *stage;
    const Options *options;
    int view, count;
    double first, step;
    SceneCopy kept; /* of the last moment asked for */
} Moments;

static bool scene_at(void *data, int number, Scene *scene, Message *message)
{
    Moments *moments = data;
    scene_copy_close(&moments->kept);
    return make_scene(moments->stage, moments->options, moments->first + number * moments->step,
                      moments->view, &moments->kept, scene, message);
}

/* Of an animation up to 17 of its pictures, fewer if they are large; in a window, where time goes
 * on, four of a turn; else the one. */
static Moments moments_of(const Stage *stage, const Options *options, double seconds, int view)
{
    enum { MAX = 17, WINDOW = 4, MIN = 3 };
    static const double PIXELS = 3e7, TURN = 360 / DEGREES_PER_SECOND;
    const double pixels = (double)stage->canvas->width * stage->canvas->height;
    Moments made = {.stage = stage, .options = options, .view = view, .count = 1, .first = seconds};
    if (options_in_window(options)) {
        made.count = WINDOW;
        made.step = TURN / WINDOW;
    } else if (options->frames > 1) {
        const double most = fmax(MIN, fmin(MAX, PIXELS / pixels));
        made.count = options->frames < most ? options->frames : (int)most;
        made.first = options->seconds;
        made.step = (options->frames - 1) / options->fps / (made.count - 1);
    }
    return made;
}

/* Options that are named stay as they are. */
static unsigned kept_axes(const Stage *stage, const Options *options)
{
    static const struct {
        const char *name;
        QualityAxis axis;
    } all[] = {{"interpolation", AXIS_INTERPOLATION},
               {"divisions", AXIS_DIVISIONS},
               {"slices", AXIS_DIVISIONS},
               {"stacks", AXIS_DIVISIONS},
               {"normals", AXIS_NORMALS},
               {"viewer", AXIS_VIEWER},
               {"fixed-light", AXIS_LIGHTS},
               {"fixed-kind", AXIS_LIGHTS},
               {"turning-light", AXIS_LIGHTS},
               {"turning-kind", AXIS_LIGHTS},
               {"viewpoint", AXIS_LIGHTS},
               {"red", AXIS_LIGHTS},
               {"green", AXIS_LIGHTS},
               {"blue", AXIS_LIGHTS}};
    const Parameter *own = example_parameters(stage->example);
    unsigned kept = 0;
    for (int i = 0; own && own[i].name && i < OPTIONS_MAX_PARAMETERS; i++)
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            if (options->own_given[i] && strcmp(own[i].name, all[k].name) == 0)
                kept |= 1U << all[k].axis;
    if (options->terms.left_out || options->terms.lights_left_out)
        kept |= 1U << AXIS_LIGHTS;
    return kept;
}

static bool draw_parts(const Stage *stage, const QualityParts *made, double aspect, bool full,
                       Message *message)
{
    return lighting_draw_parts(stage->lighting, &made->scene, made->parts, aspect, full, message);
}

/* The time to draw a view with these qualities over that of the plain ones: the median of frames
 * drawn in turn, so that what else runs disturbs both. NAN if it cannot be drawn. */
static double measure(Stage *stage, const Options *options, const Scene *scene,
                      const CheapestQuality *choice, double aspect)
{
    enum { ROUNDS = 9 };
    double times[2], ratios[ROUNDS];
    ObjectQuality *plain = calloc((size_t)choice->count + 1, sizeof *plain);
    bool done = plain != NULL;
    for (int i = 0; done && i < choice->count; i++)
        plain[i] = object_quality_plain(scene);
    for (int round = 0; round <= ROUNDS && done; round++) { /* the first compiles */
        for (int k = 0; k < 2 && done; k++) {
            QualityParts made;
            done =
                quality_parts_open(&made, scene, k ? choice->objects : plain, &stage->meshes, NULL);
            canvas_clear(stage->canvas, scene->background, 1);
            glFinish();
            const double start = clock_now();
            done = done && draw_parts(stage, &made, aspect, options->full, NULL);
            glFinish();
            times[k] = clock_now() - start;
            quality_parts_close(&made);
        }
        if (round > 0)
            ratios[round - 1] = times[1] / times[0];
    }
    free(plain);
    return done ? clock_median(ratios, ROUNDS) : NAN;
}

static void tell(Stage *stage, const Options *options, Moments *moments,
                 const CheapestQuality *choice, const int place[4])
{
    Scene scene;
    char text[1024];
    if (!options->verbose || choice->count == 0 || !scene_at(moments, 0, &scene, NULL))
        return;
    cheapest_quality_text(choice, &scene, text, sizeof text);
    /* Compiling says lines of its own. */
    const double ratio = measure(stage, options, &scene, choice, (double)place[2] / place[3]);
    fprintf(stderr,
            "view %d: %s; error %.2f of %g allowed inside objects, edges apart (plain: %.2f)",
            moments->view, text, choice->error, options->error, choice->plain_error);
    if (moments->count > 1)
        fprintf(stderr, ", at %d moments, and %.2f in reserve", moments->count, choice->margin);
    fprintf(stderr, "; %.2f of the plain time%s\n", ratio,
            choice->cached ? "; from the cache" : "");
}

static bool choose(Stage *stage, const Options *options, double seconds, int view,
                   const int place[4], Message *message)
{
    Moments moments = moments_of(stage, options, seconds, view);
    CheapestQuality *choice = &stage->choices[view];
    const CheapestQualityTask task = {.canvas = stage->canvas,
                                      .place = {place[0], place[1], place[2], place[3]},
                                      .lighting = stage->lighting,
                                      .full = options->full,
                                      .meshes = &stage->meshes,
                                      .error = options->error,
                                      .kept = kept_axes(stage, options),
                                      .moments = moments.count,
                                      .scene = scene_at,
                                      .data = &moments,
                                      .moving = options_in_window(options) ||
                                                options->frames > moments.count};
    const bool done = cheapest_quality_find(choice, &task, message);
    if (done)
        tell(stage, options, &moments, choice, place);
    scene_copy_close(&moments.kept);
    /* Many more meshes were tried than are drawn. */
    lighting_forget(stage->lighting, NULL);
    solid_meshes_close(&stage->meshes);
    return done;
}

/* In one line, the view that is farthest from the error allowed. */
static void tell_unreached(const Stage *stage, const Options *options)
{
    int worst = 0;
    for (int view = 1; view < stage->choice_count; view++)
        if (stage->choices[view].error > stage->choices[worst].error)
            worst = view;
    if (stage->choices[worst].error <= options->error)
        return;
    fprintf(stderr, "%s: --error %g cannot be kept: the least is %.2f, inside objects",
            stage->example->name, options->error, stage->choices[worst].error);
    if (stage->choice_count > 1)
        fprintf(stderr, " of view %d", worst);
    fprintf(stderr, "; drawn so\n");
}

/* Chooses for all views, unless that was done. */
static bool choose_all(Stage *stage, const Options *options, double seconds, Message *message)
{
    const int count = stage_view_count(stage);
    const int width = stage->canvas->width, height = stage->canvas->height;
    const bool at_any = options->frames > 1 || options_in_window(options);
    if (!options->cheap ||
        (stage->choices && stage->choice_count == count && stage->choice_width == width &&
         stage->choice_height == height && (at_any || stage->choice_seconds == seconds)))
        return true;
    forget_choices(stage);
    stage->choices = calloc((size_t)count, sizeof *stage->choices);
    if (!stage->choices)
        return message_set(message, "not enough memory");
    stage->choice_count = count;
    stage->choice_width = width;
    stage->choice_height = height;
    stage->choice_seconds = seconds;
    for (int view = 0; view < count; view++) {
        int place[4];
        if (view_place(stage, view, width, height, place) &&
            !choose(stage, options, seconds, view, place, message)) {
            forget_choices(stage);
            return false;
        }
    }
    tell_unreached(stage, options);
    return true;
}

bool stage_view_open(StageView *view, Stage *stage, const Options *options, double seconds,
                     int number, Message *message)
{
    *view = (StageView){.asked = {.object_count = 0}};
    if (!choose_all(stage, options, seconds, message) ||
        !make_scene(stage, options, seconds, number, &view->kept, &view->asked, message))
        return false;
    view->scene = view->asked;
    if (!options->cheap || stage->choices[number].count != view->asked.object_count)
        return true;
    if (!quality_parts_open(&view->made, &view->asked, stage->choices[number].objects,
                            &stage->meshes, message))
        return false;
    view->scene = view->made.scene;
    return true;
}

void stage_view_close(StageView *view)
{
    quality_parts_close(&view->made);
    scene_copy_close(&view->kept);
}

const Scene *stage_view_part(const StageView *view, int *object)
{
    if (!view->made.parts)
        return &view->scene;
    const Scene *part = &view->made.parts[*object];
    *object = 0;
    return part;
}

/* Drawing */

static bool draw_marks(Stage *stage, double seconds, int number, const Scene *scene, double aspect,
                       Message *message)
{
    static const double POINT_SIZE = 10;
    const int side = stage->canvas->supersample; /* of a pixel of the picture */
    Overlay *overlay = &stage->overlay;
    Annotations marks = {{.count = 0}, {.count = 0}};
    stage->example->scene->annotate(seconds, number, scene, &marks);
    const bool done =
        overlay_draw(overlay, &marks.lines, GL_LINES, side, scene, aspect, message) &&
        overlay_draw(overlay, &marks.points, GL_POINTS, side * POINT_SIZE, scene, aspect, message);
    overlay_list_close(&marks.lines);
    overlay_list_close(&marks.points);
    return done;
}

static bool draw_view(Stage *stage, const Options *options, double seconds, int number,
                      double aspect, bool marks, Message *message)
{
    StageView view;
    const bool done =
        stage_view_open(&view, stage, options, seconds, number, message) &&
        (view.made.parts
             ? draw_parts(stage, &view.made, aspect, options->full, message)
             : lighting_draw(stage->lighting, &view.scene, aspect, options->full, message)) &&
        (!marks || !stage->overlay.buffer ||
         draw_marks(stage, seconds, number, &view.scene, aspect, message));
    stage_view_close(&view);
    return done;
}

static Vec3 background(const Example *example, double seconds)
{
    Scene scene = {.object_count = 0};
    if (!example->scene)
        return vec3_from_float(example->clear_color);
    example->scene->make(seconds, 0, &scene);
    return scene.background;
}

static Frame frame_of(const Stage *stage, const Options *options, double seconds)
{
    return (Frame){.seconds = seconds,
                   .aspect = (double)stage->canvas->width / stage->canvas->height,
                   .orbit = options->orbit};
}

static bool draw_example(const Stage *stage, const Options *options, double seconds,
                         Message *message)
{
    const Frame frame = frame_of(stage, options, seconds);
    if (!isfinite(seconds))
        return message_set(message, "time %g s: must be finite", seconds);
    if (stage->example->try_draw)
        return stage->example->try_draw(&frame, message);
    stage->example->draw(&frame);
    return true;
}

static bool draw_frame(Stage *stage, const Options *options, double seconds, bool marks,
                       Message *message)
{
    const Canvas *canvas = stage->canvas;
    int place[4];
    if (stage->example->scene)
        lighting_use_shadows(stage->lighting, &options->shadows);
    if (stage->example->scene && !choose_all(stage, options, seconds, message))
        return false;
    /* The exact picture has a background, and alpha says what the objects cover. */
    canvas_clear(canvas,
                 options->alpha && marks ? (Vec3){0, 0, 0} : background(stage->example, seconds),
                 options->alpha || !marks ? 0 : 1);
    if (!stage->example->scene)
        return draw_example(stage, options, seconds, message);
    for (int view = 0; view < stage_view_count(stage); view++) {
        if (!view_place(stage, view, canvas->width, canvas->height, place))
            continue;
        canvas_view(canvas, place[0], place[1], place[2], place[3]);
        if (!draw_view(stage, options, seconds, view, (double)place[2] / place[3], marks, message))
            return false;
    }
    return true;
}

bool stage_draw(Stage *stage, const Options *options, double seconds, Message *message)
{
    return draw_frame(stage, options, seconds, true, message);
}

/* Views without objects have no exact picture of their own. */
static bool add_views(Stage *stage, const Options *options, ErrorPicture *picture, Message *message)
{
    bool done = true;
    for (int number = 0; number < stage_view_count(stage) && done; number++) {
        StageView view;
        int place[4];
        if (!view_place(stage, number, picture->image.width, picture->image.height, place))
            continue;
        done = stage_view_open(&view, stage, options, picture->seconds, number, message) &&
               (view.asked.object_count == 0 ||
                error_picture_add(picture, place, &view.asked, view.made.parts ? &view.scene : NULL,
                                  message));
        stage_view_close(&view);
    }
    return done;
}

bool stage_error_picture(Stage *stage, const Options *options, double seconds,
                         ErrorPicture *picture, Message *message)
{
    const Canvas *canvas = stage->canvas;
    Options plain = *options;
    plain.verbose = false;
    if (!error_picture_open(picture, canvas->width, canvas->height,
                            canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, stage_view_count(stage),
                            message))
        return false;
    picture->seconds = seconds;
    picture->simplified = plain.cheap;
    if (draw_frame(stage, &plain, seconds, false, message) &&
        canvas_read(canvas, &picture->image, message) && add_views(stage, &plain, picture, message))
        return true;
    error_picture_close(picture);
    return false;
}

/* Pictures */

/* Whether an option of all scenes changes what a view computes. */
static bool is_changed(const Example *example, const Options *options)
{
    const SceneTerms *terms = &options->terms;
    return terms->left_out || terms->lights_left_out || terms->unlit || options->full ||
           options->cheap || options->clamp_vertex || options->linear || options->show_clipped ||
           options->tints.tinted || options_have_shadows(options) != example->scene->shadows;
}

/* All captions in one size, or none where one does not fit. */
static bool label_views(const Stage *stage, const Options *options, Image *image, Message *message)
{
    const SceneExample *scene = stage->example->scene;
    const bool plain = scene->plain_label && is_changed(stage->example, options);
    const int count = stage_view_count(stage);
    int size = 12;
    for (int i = 0; i < 2 * count; i++) { /* measured, then drawn */
        const char *text = plain ? scene->plain_label(i % count) : scene->label(i % count);
        int place[4];
        if (!text || !view_place(stage, i % count, image->width, image->height, place))
            continue;
        if (!(i < count ? image_caption_size(place, text, &size, message)
                        : size == 0 || image_caption(image, place, size, text, message)))
            return false;
    }
    return true;
}

/* Averaging samples of an object and of the transparent black background has multiplied the colour
 * by alpha. */
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

/* The command that makes the same file again, of the program's own name: where this one went does
 * not change what is in it. */
static void write_command(const Stage *stage, const Options *options, double seconds,
                          Picture *picture)
{
    char format[16], output[96];
    const char *folder = getenv("LIGHTING_SHADERS");
    Options own = *options;
    own.width = stage->canvas->width;
    own.height = stage->canvas->height;
    own.seconds = seconds;
    own.frames = 1;
    own.fps = OPTIONS_FPS;
    own.numbered = false;
    own.format = NULL;
    own.start = NULL;
    own.canvas.backend = stage->canvas->backend;
    own.output_given = image_format(picture->path, format, NULL) && strcmp(format, "png") != 0;
    if (own.output_given)
        snprintf(output, sizeof output, "%s.%s", stage->example->name, format);
    own.output = output;
    if (!own.shaders.folder && folder && folder[0])
        own.shaders.folder = folder;
    command_write(stage->example, &own, options->defaults, picture->command,
                  sizeof picture->command);
}

static void describe_picture(const Stage *stage, const Options *options, double seconds,
                             Picture *picture)
{
    char number[32];
    const Canvas *canvas = stage->canvas;
    picture->compress = options->compress;
    picture->alpha = options->alpha;
    snprintf(picture->title, sizeof picture->title, "%s", stage->example->name);
    parse_number_text(seconds, number);
    snprintf(picture->moment, sizeof picture->moment, "%s s", number);
    if (stage->example->diagram)
        snprintf(picture->driver, sizeof picture->driver, "cairo");
    else
        snprintf(picture->driver, sizeof picture->driver, "%s, %s; %s", canvas->backend->name,
                 canvas->platform, canvas->renderer);
    write_command(stage, options, seconds, picture);
}

bool stage_picture_part(const Stage *stage, const Options *options, double seconds,
                        char driver[STAGE_DRIVER_SIZE], Picture *picture, Message *message)
{
    char wanted[sizeof picture->command];
    write_command(stage, options, seconds, picture);
    memcpy(wanted, picture->command, sizeof wanted);
    if (!picture_read(picture, message))
        return false;
    if (strcmp(picture->command, wanted) != 0)
        return message_set(message, "%s: is not of this command but of: %s; draw its part again",
                           picture->path, picture->command);
    if (driver[0] && strcmp(picture->driver, driver) != 0)
        return message_set(message,
                           "%s: was drawn by %s, and the one before it by %s; draw all parts with "
                           "the same (--deterministic, for different processors)",
                           picture->path, picture->driver, driver);
    snprintf(driver, STAGE_DRIVER_SIZE, "%s", picture->driver);
    return true;
}

bool stage_drawing(const Example *example, double seconds, int width, int height, Drawing *drawing,
                   Message *message)
{
    if (drawing_begin(drawing, width, height, message) &&
        example->diagram->compose(seconds, drawing, message))
        return true;
    drawing_end(drawing);
    return false;
}

static bool paint_diagram(const Stage *stage, const Options *options, double seconds, Image *image,
                          Message *message)
{
    Drawing drawing;
    const bool done =
        stage_drawing(stage->example, seconds, image->width, image->height, &drawing, message) &&
        drawing_paint(&drawing, image, options->alpha, message);
    drawing_end(&drawing);
    return done;
}

bool stage_picture(Stage *stage, const Options *options, double seconds, Picture *picture,
                   Message *message)
{
    const Canvas *canvas = stage->canvas;
    const SceneExample *scene = stage->example->scene;
    Image *image = &picture->image;
    if (image->width != canvas->width || image->height != canvas->height) {
        const ImageType type = image->type;
        image_close(image);
        if (!image_open(image, canvas->width, canvas->height, type, message))
            return false;
    }
    if (stage->example->diagram) {
        describe_picture(stage, options, seconds, picture);
        return paint_diagram(stage, options, seconds, image, message);
    }
    if (stage->example->page) {
        const Frame frame = frame_of(stage, options, seconds);
        describe_picture(stage, options, seconds, picture);
        return stage->example->page->paint(&frame, canvas, image, message);
    }
    if (!stage_draw(stage, options, seconds, message) || !canvas_read(canvas, image, message))
        return false;
    const bool averaged = canvas->samples || canvas->supersample > 1;
    if (options->alpha && averaged)
        divide_by_alpha(image);
    if (options->verbose && scene) {
        const LightingCounts counts = lighting_counts(stage->lighting);
        fprintf(stderr, "programs so far: %d, compiled and linked in %.1f ms\n", counts.programs,
                1e3 * counts.compile_seconds);
    }
    if (scene && image->type == IMAGE_BYTE) {
        if (scene->retouch)
            scene->retouch(image);
        if (scene->label && !label_views(stage, options, image, message))
            return false;
    }
    describe_picture(stage, options, seconds, picture);
    return true;
}
