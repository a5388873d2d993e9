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

static void save(Viewer *viewer)
{
    Message message = {0};
    if (save_path(viewer, viewer->picture.path, &message) &&
        stage_picture(viewer->example, viewer->canvas, &viewer->options, viewer->options.seconds,
                      &viewer->picture, &message) &&
        picture_write(&viewer->picture, &message)) {
        say_saved(viewer);
        return;
    }
    options_fail(viewer->example->name, &message, EXIT_FAILED);
    viewer_panel_notice(&viewer->panel, message.text);
}

static void step(Viewer *viewer, double seconds)
{
    viewer->paused = true;
    viewer->options.seconds += seconds;
}

/* What the example made of its parameters is made again. */
static bool renew(Viewer *viewer, Message *message)
{
    return !viewer->live.on_stage || stage_renew(viewer->example, &viewer->options, message);
}

static bool reset(Viewer *viewer, Message *message)
{
    const Parameter *parameters = viewer->example->parameters;
    viewer->options.seconds = viewer->first->seconds;
    viewer->options.orbit = viewer->first->orbit;
    viewer->paused = false;
    for (int i = 0; parameters && parameters[i].name; i++)
        parameter_restore(&parameters[i], viewer->first_values[i]);
    return renew(viewer, message);
}

static bool type(Viewer *viewer, unsigned character, Message *message)
{
    switch (character < 128 ? tolower((int)character) : 0) {
    case ' ':
        viewer->paused = !viewer->paused;
        return true;
    case 's':
        save(viewer);
        return true;
    case 'r':
        return reset(viewer, message);
    case 'f':
        viewer->full_screen = !viewer->full_screen;
        window_full_screen(viewer->window, viewer->full_screen);
        return true;
    case 'p':
        viewer_panel_toggle(&viewer->panel);
        return true;
    case 'h':
        viewer_panel_toggle_help(&viewer->panel);
        return true;
    default:
        return true;
    }
}

static bool use_keys(Viewer *viewer, Message *message)
{
    const WindowInput *input = &viewer->input;
    if (viewer->panel.result.wants_keys)
        return true;
    if (input->typed_count)
        viewer_panel_notice(&viewer->panel, NULL); /* it has been read */
    for (int i = 0; i < input->typed_count; i++)
        if (!type(viewer, input->typed[i], message))
            return false;
    const int frames = input->pressed[WINDOW_KEY_RIGHT] - input->pressed[WINDOW_KEY_LEFT];
    const int seconds = input->pressed[WINDOW_KEY_UP] - input->pressed[WINDOW_KEY_DOWN];
    if (frames || seconds)
        step(viewer, frames / viewer->options.fps + seconds);
    viewer->left |= input->pressed[WINDOW_KEY_ESCAPE] > 0;
    return true;
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
        const double distance = orbit->distance > 0 ? orbit->distance : 1;
        orbit->distance = distance * pow(NEARER_PER_NOTCH, input->scroll);
        orbit->distance = fmin(fmax(orbit->distance, NEAREST), FARTHEST);
    }
}

/* Draws the moment as a headless program does, and copies it to the window. Trouble with the
 * picture is no end: the moment, the size or the values may change. */
static bool show_picture(Viewer *viewer, Message *message)
{
    const Example *example = viewer->example;
    const WindowInput *input = &viewer->input;
    const double seconds = viewer->options.seconds;
    const bool retouched = example->retouch || example->label;
    Message *trouble = &viewer->trouble;
    *trouble = (Message){0};
    if (viewer->picture.image.type == IMAGE_BYTE && retouched)
        return !stage_picture(example, viewer->canvas, &viewer->options, seconds, &viewer->picture,
                              trouble) ||
               canvas_present_image(&viewer->picture.image, input->width, input->height, message);
    /* A program that this moment needs may not compile though those before it did. */
    if (!stage_draw(example, viewer->canvas, &viewer->options, seconds, trouble) &&
        live_revert(&viewer->live, trouble)) {
        viewer->broken = *trouble;
        *trouble = (Message){0};
        stage_draw(example, viewer->canvas, &viewer->options, seconds, trouble);
    }
    canvas_present(viewer->canvas, input->width, input->height);
    return true;
}

static void show_nothing(const Viewer *viewer)
{
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, viewer->input.width, viewer->input.height);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

static bool show(Viewer *viewer, Message *message)
{
    const WindowInput *input = &viewer->input;
    const double start = progress_now();
    if (!viewer->live.on_stage)
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
    const char *state = states[viewer->broken.text[0]    ? 3
                               : viewer->trouble.text[0] ? 2
                                                         : viewer->paused];
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
        return true;
    case LIVE_LOADED:
        if (viewer->live.changed[0])
            viewer_panel_notice(&viewer->panel, "shaders loaded");
        viewer->broken = (Message){0};
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
    const Message *trouble = viewer->broken.text[0] ? &viewer->broken : &viewer->trouble;
    return viewer_panel_frame(panel, &viewer->input, elapsed, viewer->canvas, &viewer->options,
                              viewer->live.on_stage, trouble, message) &&
           (!panel->result.changed || renew(viewer, message));
}

/* One turn of the loop. */
static bool frame(Viewer *viewer, double wait, Message *message)
{
    WindowInput *input = &viewer->input;
    window_input(viewer->window, wait, input);
    const double now = progress_now(), elapsed = now - viewer->last;
    viewer->last = now;
    if (!viewer->paused)
        viewer->options.seconds += elapsed;
    if (input->width > 0 && input->height > 0) {
        if (!canvas_resize(viewer->canvas, input->width, input->height, message))
            return false;
        viewer->options.width = input->width;
        viewer->options.height = input->height;
    }
    if (!load(viewer, message) || !use_panel(viewer, elapsed, message))
        return false;
    use_pointer(viewer);
    if (!use_keys(viewer, message))
        return false;
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
