#include "app/viewer.h"

#include "app/arguments.h"
#include "app/command.h"
#include "app/live.h"
#include "app/stage.h"
#include "app/viewer_panel.h"
#include "base/clock.h"
#include "base/output.h"
#include "scene/scene_example.h"
#include "window/window.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double DEGREES_PER_PIXEL = 0.4, NEARER_PER_NOTCH = 0.9;
static const double NEAREST = 0.1, FARTHEST = 10; /* factors of the example's distance */

typedef struct Viewer {
    const Example *example;
    Canvas *canvas;
    Window *window;
    const Options *first; /* at the start; restored by r */
    ParameterValue first_values[OPTIONS_MAX_PARAMETERS];
    Options options; /* current */
    bool paused, full_screen, left;
    WindowInput input;
    double last; /* when the last frame began */
    /* Since the title was last updated: */
    double title_time;
    int frames;
    const char *state; /* in the title */
    ViewerPanel panel;
    bool panel_had_pointer; /* in the previous frame: a press may precede the pointer's current
                               position */
    Live live;
    Message broken;  /* error of the shaders on disk */
    Message unmade;  /* why stage_renew failed */
    Picture picture; /* read back, to be saved or retouched */
    Message trouble; /* why drawing failed */
} Viewer;

/* The first unused file of a numbered name. */
static bool free_path(const char *pattern, char path[PATH_MAX], Message *message)
{
    for (int i = 1; i < FRAMES_MAX; i++) {
        if (!output_numbered(pattern, i, path, PATH_MAX, message))
            return false;
        if (access(path, F_OK) != 0)
            return true;
    }
    return message_set(message, "%s: all names are taken", pattern);
}

/* Where to save a picture: --output's file is replaced; otherwise a new one. */
static bool save_path(const Viewer *viewer, char path[PATH_MAX], Message *message)
{
    const Options *options = viewer->first;
    char pattern[160];
    if (options->output_given && output_numbered(options->output, 0, path, PATH_MAX, NULL))
        return free_path(options->output, path, message);
    if (options->output_given) {
        snprintf(path, PATH_MAX, "%s", options->output);
        return true;
    }
    snprintf(pattern, sizeof pattern, "%s%%04d.png", viewer->example->name);
    return free_path(pattern, path, message);
}

/* Reports what was saved and the command that draws it. */
static void report_saved(Viewer *viewer)
{
    char notice[PATH_MAX + 16], command[VIEWER_COMMAND_SIZE];
    const char *path = viewer->picture.path;
    Options saved = viewer->options;
    saved.output = path;
    saved.output_given = true;
    const bool written =
        command_write(viewer->example, &saved, viewer->panel.defaults, command, sizeof command);
    fprintf(stderr, "%s: saved %s%s%s\n", viewer->example->name, path,
            written ? "; the same without a window: " : "", written ? command : "");
    snprintf(notice, sizeof notice, "saved %s", path);
    viewer_panel_notice(&viewer->panel, notice);
}

static bool is_made(const Viewer *viewer)
{
    return viewer->live.stage.example && !viewer->unmade.text[0];
}

/* As the headless program writes it. */
static bool write_picture(Viewer *viewer, Message *message)
{
    const Options *options = &viewer->options;
    Picture *picture = &viewer->picture;
    if (!viewer->example->diagram || !drawing_format(picture->path))
        return stage_picture(&viewer->live.stage, options, options->seconds, picture, message) &&
               picture_write(picture, message);
    Drawing drawing;
    const bool done = stage_drawing(viewer->example, options->seconds, options->width,
                                    options->height, &drawing, message) &&
                      drawing_write(&drawing, picture->path, drawing_format(picture->path),
                                    options->alpha, message);
    drawing_end(&drawing);
    return done;
}

static void save(Viewer *viewer)
{
    Message message = {0};
    if (!is_made(viewer))
        message_set(&message, "s: there is no picture to save until the error is corrected");
    else if (save_path(viewer, viewer->picture.path, &message) && write_picture(viewer, &message)) {
        report_saved(viewer);
        return;
    }
    options_fail(viewer->example->name, &message, EXIT_FAILED);
    viewer_panel_notice(&viewer->panel, message.text);
}

/* Within the command line's limits, so that every time can be drawn again. */
static void pass_time(Viewer *viewer, double seconds)
{
    const double now = viewer->options.seconds + seconds;
    viewer->options.seconds = fmin(fmax(now, -OPTIONS_MAX_SECONDS), OPTIONS_MAX_SECONDS);
}

static void step(Viewer *viewer, double seconds)
{
    viewer->paused = true;
    pass_time(viewer, seconds);
}

/* Rebuilds what the example made of its parameters. If that fails (a missing model file), reports
 * it once, and there is no picture until they change. */
static void renew(Viewer *viewer)
{
    const Message before = viewer->unmade;
    viewer->panel.stale = true;
    viewer->unmade = (Message){0};
    if (!viewer->live.stage.example ||
        stage_renew(&viewer->live.stage, &viewer->options, &viewer->unmade) ||
        strcmp(viewer->unmade.text, before.text) == 0)
        return;
    options_fail(viewer->example->name, &viewer->unmade, EXIT_FAILED);
}

static void reset(Viewer *viewer)
{
    const Parameter *parameters = example_parameters(viewer->example);
    viewer->options.seconds = viewer->first->seconds;
    viewer->options.orbit = viewer->first->orbit;
    viewer->options.terms = viewer->first->terms;
    viewer->options.linear = viewer->first->linear;
    viewer->options.clamp_vertex = viewer->first->clamp_vertex;
    viewer->options.show_clipped = viewer->first->show_clipped;
    viewer->paused = false;
    for (int i = 0; parameters && parameters[i].name; i++)
        parameter_restore(&parameters[i], viewer->first_values[i]);
    renew(viewer);
}

/* Starts again with the arguments of a try, which blanks separate. A given time is held. */
static void try_arguments(Viewer *viewer, const char *arguments)
{
    enum { MAX_WORDS = 32 };
    const Usage usage = options_usage(viewer->example);
    char text[256], *words[MAX_WORDS + 2] = {text}, *place = NULL;
    Parameter table[OPTIONS_MAX];
    const Parameter *answer;
    Message message = {0};
    int count = 1;
    reset(viewer);
    snprintf(text, sizeof text, "%s", arguments);
    for (char *word = strtok_r(text, " ", &place); word && count <= MAX_WORDS;
         word = strtok_r(NULL, " ", &place))
        words[count++] = word;
    const double seconds = viewer->options.seconds;
    options_table(&usage, &viewer->options, OPTIONS_TO_READ, table);
    if (!arguments_read(table, count, words, &answer, &message))
        viewer_panel_notice(&viewer->panel, message.text);
    viewer->paused = viewer->options.seconds != seconds;
    renew(viewer);
}

static void type(Viewer *viewer, unsigned character)
{
    switch (character < 128 ? tolower((int)character) : 0) {
    case ' ':
        viewer->paused = !viewer->paused;
        break;
    case 's':
        save(viewer);
        break;
    case 'r':
        reset(viewer);
        break;
    case 'f':
        viewer->full_screen = !viewer->full_screen;
        window_full_screen(viewer->window, viewer->full_screen);
        break;
    case 'p':
        viewer_panel_toggle(&viewer->panel);
        break;
    case 'h':
        viewer_panel_toggle_help(&viewer->panel);
        break;
    default:
        break;
    }
}

static void use_keys(Viewer *viewer)
{
    const WindowInput *input = &viewer->input;
    if (viewer->panel.result.wants_keys)
        return;
    if (input->typed_count)
        viewer_panel_notice(&viewer->panel, NULL); /* it has been seen */
    for (int i = 0; i < input->typed_count; i++)
        type(viewer, input->typed[i]);
    const int frames = input->pressed[WINDOW_KEY_RIGHT] - input->pressed[WINDOW_KEY_LEFT];
    const int seconds = input->pressed[WINDOW_KEY_UP] - input->pressed[WINDOW_KEY_DOWN];
    if (frames || seconds)
        step(viewer, frames / viewer->options.fps + seconds);
    viewer->left |= input->pressed[WINDOW_KEY_ESCAPE] > 0;
}

static void use_pointer(Viewer *viewer)
{
    const WindowInput *input = &viewer->input;
    Orbit *orbit = &viewer->options.orbit;
    if (viewer->panel.result.wants_pointer || viewer->panel_had_pointer)
        return;
    const double degrees = DEGREES_PER_PIXEL / input->scale;
    orbit->azimuth = fmod(orbit->azimuth - degrees * input->drag_x, 360);
    orbit->elevation += degrees * input->drag_y;
    orbit->elevation = fmin(fmax(orbit->elevation, -90), 90);
    if (input->scroll != 0) {
        const double distance = orbit_distance(*orbit);
        /* --orbit may start beyond these limits. */
        const double min = fmin(NEAREST, distance), max = fmax(FARTHEST, distance);
        orbit->distance = distance * pow(NEARER_PER_NOTCH, input->scroll);
        orbit->distance = fmin(fmax(orbit->distance, min), max);
    }
}

/* Retouching, labels and diagrams need the picture on the CPU. */
static bool is_retouched(const Viewer *viewer)
{
    const SceneExample *scene = viewer->example->scene;
    return viewer->example->diagram ||
           (viewer->picture.image.type == IMAGE_BYTE && scene && (scene->retouch || scene->label));
}

/* As a headless program draws it. */
static bool draw_moment(Viewer *viewer)
{
    const Options *options = &viewer->options;
    viewer->trouble = (Message){0};
    if (is_retouched(viewer))
        return stage_picture(&viewer->live.stage, options, options->seconds, &viewer->picture,
                             &viewer->trouble);
    return stage_draw(&viewer->live.stage, options, options->seconds, &viewer->trouble);
}

static void show_nothing(const Viewer *viewer)
{
    canvas_clear(viewer->canvas, (Vec3){0, 0, 0}, 1);
    canvas_present(viewer->canvas, viewer->input.width, viewer->input.height);
}

/* Draws and copies to the window. An error in drawing does not end the viewer: the time, the size
 * or the parameters may change. */
static bool show_picture(Viewer *viewer, Message *message)
{
    const WindowInput *input = &viewer->input;
    const bool had_trouble = viewer->trouble.text[0];
    bool drawn = draw_moment(viewer);
    /* A program that is first needed now may not compile although earlier ones did. */
    if (!drawn && live_revert(&viewer->live, &viewer->trouble)) {
        viewer->broken = viewer->trouble;
        options_fail(viewer->example->name, &viewer->broken, EXIT_FAILED);
        drawn = draw_moment(viewer);
    }
    if (!drawn) {
        if (!had_trouble)
            options_fail(viewer->example->name, &viewer->trouble, EXIT_FAILED);
        show_nothing(viewer);
        return true;
    }
    if (is_retouched(viewer))
        return canvas_present_image(&viewer->picture.image, input->width, input->height, message);
    canvas_present(viewer->canvas, input->width, input->height);
    return true;
}

static bool show(Viewer *viewer, Message *message)
{
    const WindowInput *input = &viewer->input;
    const double start = clock_now();
    if (!is_made(viewer))
        show_nothing(viewer);
    else if (!show_picture(viewer, message))
        return false;
    if (viewer->panel.view == PANEL_OPEN)
        glFinish(); /* to measure the time of the picture */
    viewer_panel_measured(&viewer->panel, clock_now() - start);
    return canvas_check(viewer->canvas, message) &&
           viewer_panel_draw(&viewer->panel, input->width, input->height, message);
}

/* Name, rate and state: twice per second, and at once when the state changes. */
static void update_title(Viewer *viewer)
{
    enum { SIZE = 200 };
    static const char *const states[] = {"", ", paused", ", no picture", ", broken shader"};
    char title[SIZE];
    const double now = clock_now(), elapsed = now - viewer->title_time;
    const bool trouble = viewer->unmade.text[0] || viewer->trouble.text[0];
    const char *state = states[viewer->broken.text[0] ? 3 : trouble ? 2 : viewer->paused];
    viewer->frames++;
    if (elapsed >= 0.5) {
        viewer->panel.rate = viewer->frames / elapsed;
        viewer->title_time = now;
        viewer->frames = 0;
    } else if (state == viewer->state) {
        return;
    }
    const double rate = viewer->panel.rate > 0 ? viewer->panel.rate : viewer->frames / elapsed;
    viewer->state = state;
    snprintf(title, SIZE, "%s, %.0f frames per second%s", viewer->example->name, rate, state);
    window_title(viewer->window, title);
}

/* Time to wait if swapping does not: faster than the screen is useless. */
static double spare_time(const Viewer *viewer)
{
    const double period = 1 / window_refresh_rate(viewer->window);
    return fmax(0, viewer->last + 0.95 * period - clock_now());
}

static bool load(Viewer *viewer, Message *message)
{
    Message error = {0};
    switch (live_poll(&viewer->live, 0, &error)) {
    case LIVE_FAILED:
        return message_set(message, "%s", error.text);
    case LIVE_BROKEN:
        options_fail(viewer->example->name, &error, EXIT_FAILED);
        viewer->broken = error;
        viewer->unmade = (Message){0}; /* the stage was opened again */
        return true;
    case LIVE_LOADED:
        stage_warn(&viewer->live.stage);
        if (viewer->live.changed[0] || viewer->live.stage.warning.text[0])
            viewer_panel_notice(&viewer->panel, viewer->live.stage.warning.text[0]
                                                    ? viewer->live.stage.warning.text
                                                    : "shaders loaded");
        viewer->broken = viewer->unmade = (Message){0};
        viewer->panel.stale = true;
        return true;
    case LIVE_UNCHANGED:
        break;
    }
    return true;
}

static bool use_panel(Viewer *viewer, double elapsed, Message *message)
{
    ViewerPanel *panel = &viewer->panel;
    viewer->panel_had_pointer = panel->result.wants_pointer;
    const Message *trouble = viewer->broken.text[0]   ? &viewer->broken
                             : viewer->unmade.text[0] ? &viewer->unmade
                                                      : &viewer->trouble;
    if (!viewer_panel_frame(panel, &viewer->input, elapsed,
                            is_made(viewer) ? &viewer->live.stage : NULL, &viewer->options, trouble,
                            message))
        return false;
    if (panel->result.tried)
        try_arguments(viewer, panel->result.tried);
    else if (panel->result.changed)
        renew(viewer);
    return true;
}

static bool frame(Viewer *viewer, double wait, Message *message)
{
    WindowInput *input = &viewer->input;
    window_input(viewer->window, wait, input);
    const double now = clock_now(), elapsed = now - viewer->last;
    viewer->last = now;
    if (!viewer->paused)
        pass_time(viewer, elapsed);
    if (input->width > 0 && input->height > 0) {
        if (!canvas_resize(viewer->canvas, input->width, input->height, message))
            return false;
        viewer->options.width = input->width;
        viewer->options.height = input->height;
    }
    if (!load(viewer, message) || !use_panel(viewer, elapsed, message))
        return false;
    use_pointer(viewer);
    use_keys(viewer);
    viewer->left |= input->closed;
    if (viewer->left || input->width == 0 || input->height == 0)
        return true;
    if (!show(viewer, message))
        return false;
    window_swap(viewer->window);
    update_title(viewer);
    return window_check(viewer->window, message);
}

bool viewer_run(const Example *example, Canvas *canvas, const Options *options,
                const ParameterValue *defaults, Message *message)
{
    static const double HIDDEN = 0.1;
    const Parameter *parameters = example_parameters(example);
    Viewer viewer = {.example = example,
                     .canvas = canvas,
                     .window = window_of(canvas),
                     .first = options,
                     .options = *options,
                     .picture.image.type = canvas->real ? IMAGE_FLOAT : IMAGE_BYTE};
    for (int i = 0; parameters && parameters[i].name; i++)
        viewer.first_values[i] = parameter_save(&parameters[i]);
    if (!live_open(&viewer.live, example, canvas, &viewer.options, message))
        return false;
    viewer_panel_open(&viewer.panel, example, viewer.window, options, defaults);
    viewer_panel_notice(&viewer.panel, "p: panel   h: help");
    window_show(viewer.window);
    viewer.last = viewer.title_time = clock_now();
    bool done = frame(&viewer, 0, message);
    while (done && !viewer.left) {
        const bool hidden = viewer.input.width == 0 || viewer.input.height == 0;
        done = frame(&viewer, hidden ? HIDDEN : spare_time(&viewer), message);
    }
    viewer_panel_close(&viewer.panel);
    image_close(&viewer.picture.image);
    live_close(&viewer.live);
    return done;
}
