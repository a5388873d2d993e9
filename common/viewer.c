#include "viewer.h"

#include "command.h"
#include "live.h"
#include "output.h"
#include "progress.h"
#include "stage.h"
#include "viewer_panel.h"
#include "window.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double DEGREES_PER_PIXEL = 0.4, NEARER_PER_NOTCH = 0.9;
static const double NEAREST = 0.1, FARTHEST = 10; /* times the distance that the example has */

typedef struct Viewer {
    const Example *example;
    Canvas *canvas;
    Window *window;
    const Options *first; /* what it began with, and r goes back to */
    ParameterValue first_values[OPTIONS_MOST_PARAMETERS];
    Options options; /* as things are now */
    bool paused, full_screen, left;
    WindowInput input;
    double last; /* when the last frame began */
    /* Frames since the title was last changed. */
    double title_time;
    int frames;
    const char *state; /* that it says */
    ViewerPanel panel;
    bool panel_had_pointer; /* in the frame before: a press may be older than where it is now */
    Live live;
    Message broken;  /* what is wrong with the shaders on disk */
    Message unmade;  /* why the example could not be made of its parameters */
    Picture picture; /* read back, to be saved or to be shown with what is added on the CPU */
    Message trouble; /* why there is no picture of this moment */
} Viewer;

/* The first file of a numbered name that is not there yet. */
static bool free_path(const char *pattern, char path[PATH_MAX], Message *message)
{
    for (int i = 1; i < FRAMES_MOST; i++) {
        if (!output_numbered(pattern, i, path, PATH_MAX, message))
            return false;
        if (access(path, F_OK) != 0)
            return true;
    }
    return message_set(message, "%s: all names are taken", pattern);
}

/* Where a picture is saved: a file that --output names is replaced, any other is a new one. */
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

/* Says what was saved, and how to draw it again. */
static void say_saved(Viewer *viewer)
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

/* Whether the example is there to be drawn. */
static bool is_made(const Viewer *viewer)
{
    return viewer->live.on_stage && !viewer->unmade.text[0];
}

static void save(Viewer *viewer)
{
    Message message = {0};
    if (!is_made(viewer))
        message_set(&message, "s: there is no picture to save until the error is mended");
    else if (save_path(viewer, viewer->picture.path, &message) &&
             stage_picture(viewer->example, viewer->canvas, &viewer->options,
                           viewer->options.seconds, &viewer->picture, &message) &&
             picture_write(&viewer->picture, &message)) {
        say_saved(viewer);
        return;
    }
    options_fail(viewer->example->name, &message, EXIT_FAILED);
    viewer_panel_notice(&viewer->panel, message.text);
}

/* Within what the command line takes, so that every moment can be drawn again. */
static void pass_time(Viewer *viewer, double seconds)
{
    const double now = viewer->options.seconds + seconds;
    viewer->options.seconds = fmin(fmax(now, -OPTIONS_MOST_SECONDS), OPTIONS_MOST_SECONDS);
}

static void step(Viewer *viewer, double seconds)
{
    viewer->paused = true;
    pass_time(viewer, seconds);
}

/* What the example made of its parameters is made again. Where it cannot be (a model's file is
 * gone), there is no picture until they change, which is said once. */
static void renew(Viewer *viewer)
{
    const Message before = viewer->unmade;
    viewer->panel.stale = true;
    viewer->unmade = (Message){0};
    if (!viewer->live.on_stage || stage_renew(viewer->example, &viewer->options, &viewer->unmade) ||
        strcmp(viewer->unmade.text, before.text) == 0)
        return;
    options_fail(viewer->example->name, &viewer->unmade, EXIT_FAILED);
}

static void reset(Viewer *viewer)
{
    const Parameter *parameters = viewer->example->parameters;
    viewer->options.seconds = viewer->first->seconds;
    viewer->options.orbit = viewer->first->orbit;
    viewer->paused = false;
    for (int i = 0; parameters && parameters[i].name; i++)
        parameter_restore(&parameters[i], viewer->first_values[i]);
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
        viewer_panel_notice(&viewer->panel, NULL); /* it has been read */
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
        /* --orbit may have begun beyond these limits. */
        const double least = fmin(NEAREST, distance), most = fmax(FARTHEST, distance);
        orbit->distance = distance * pow(NEARER_PER_NOTCH, input->scroll);
        orbit->distance = fmin(fmax(orbit->distance, least), most);
    }
}

/* What is added to a picture on the CPU takes it there and back. */
static bool is_retouched(const Viewer *viewer)
{
    return viewer->picture.image.type == IMAGE_BYTE &&
           (viewer->example->retouch || viewer->example->label);
}

/* Draws the moment as a headless program does. */
static bool draw(Viewer *viewer)
{
    const Options *options = &viewer->options;
    viewer->trouble = (Message){0};
    if (is_retouched(viewer))
        return stage_picture(viewer->example, viewer->canvas, options, options->seconds,
                             &viewer->picture, &viewer->trouble);
    return stage_draw(viewer->example, viewer->canvas, options, options->seconds, &viewer->trouble);
}

static void show_nothing(const Viewer *viewer)
{
    canvas_clear(viewer->canvas, (Vec3){0, 0, 0}, 1);
    canvas_present(viewer->canvas, viewer->input.width, viewer->input.height);
}

/* Draws, and copies to the window. Trouble with the picture is no end: the moment, the size or the
 * values may change. */
static bool show_picture(Viewer *viewer, Message *message)
{
    const WindowInput *input = &viewer->input;
    const bool had_trouble = viewer->trouble.text[0];
    bool drawn = draw(viewer);
    /* A program that this moment needs may not compile though those before it did. */
    if (!drawn && live_revert(&viewer->live, &viewer->trouble)) {
        viewer->broken = viewer->trouble;
        options_fail(viewer->example->name, &viewer->broken, EXIT_FAILED);
        drawn = draw(viewer);
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
    const double start = progress_now();
    if (!is_made(viewer))
        show_nothing(viewer);
    else if (!show_picture(viewer, message))
        return false;
    if (viewer->panel.view == PANEL_OPEN)
        glFinish(); /* else only the driver knows what the picture took */
    viewer_panel_measured(&viewer->panel, progress_now() - start);
    return canvas_check(viewer->canvas, message) &&
           viewer_panel_draw(&viewer->panel, input->width, input->height, message);
}

/* Name, rate and state: twice a second, and at once where the state is another one. */
static void update_title(Viewer *viewer)
{
    enum { SIZE = 200 };
    static const char *const states[] = {"", ", paused", ", no picture", ", broken shader"};
    char title[SIZE];
    const double now = progress_now(), elapsed = now - viewer->title_time;
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

/* Where the screen does not make the program wait, this does: nobody sees more pictures. */
static double spare_time(const Viewer *viewer)
{
    const double period = 1 / window_refresh_rate(viewer->window);
    return fmax(0, viewer->last + 0.95 * period - progress_now());
}

/* Loads shaders that have changed. */
static bool load(Viewer *viewer, Message *message)
{
    Message error = {0};
    switch (live_poll(&viewer->live, 0, &error)) {
    case LIVE_FAILED:
        return message_set(message, "%s", error.text);
    case LIVE_BROKEN:
        options_fail(viewer->example->name, &error, EXIT_FAILED);
        viewer->broken = error;
        viewer->unmade = (Message){0}; /* what is on the stage, if anything, is new */
        return true;
    case LIVE_LOADED:
        if (viewer->live.changed[0])
            viewer_panel_notice(&viewer->panel, "shaders loaded");
        viewer->broken = viewer->unmade = (Message){0};
        viewer->panel.stale = true;
        return true;
    case LIVE_UNCHANGED:
        break;
    }
    return true;
}

/* The panel, and what was done in it. */
static bool use_panel(Viewer *viewer, double elapsed, Message *message)
{
    ViewerPanel *panel = &viewer->panel;
    viewer->panel_had_pointer = panel->result.wants_pointer;
    const Message *trouble = viewer->broken.text[0]   ? &viewer->broken
                             : viewer->unmade.text[0] ? &viewer->unmade
                                                      : &viewer->trouble;
    if (!viewer_panel_frame(panel, &viewer->input, elapsed, viewer->canvas, &viewer->options,
                            is_made(viewer), trouble, message))
        return false;
    if (panel->result.changed)
        renew(viewer);
    return true;
}

/* One turn of the loop. */
static bool frame(Viewer *viewer, double wait, Message *message)
{
    WindowInput *input = &viewer->input;
    window_input(viewer->window, wait, input);
    const double now = progress_now(), elapsed = now - viewer->last;
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
    const Parameter *parameters = example->parameters;
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
    viewer.last = viewer.title_time = progress_now();
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
