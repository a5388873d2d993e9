#include "app/viewer.h"

#include "app/arguments.h"
#include "app/command.h"
#include "app/picture_texts.h"
#include "app/shader_reload.h"
#include "app/viewer_panel.h"
#include "base/clock.h"
#include "base/output.h"
#include "window/window.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double DEGREES_PER_PIXEL = 0.4, NEARER_PER_NOTCH = 0.9;
/* What moves by hand or by the clock is rounded to these parts, so that the command which draws the
 * picture is short: milliseconds, tenths of a degree, thousandths of the distance. */
static const double PARTS_OF_SECOND = 1000, PARTS_OF_DEGREE = 10, PARTS_OF_DISTANCE = 1000;
enum { SETTLE = 3 }; /* frames until the panel shows all that follows from an event */

static const double NEAREST = 0.1, FARTHEST = 10; /* factors of the example's distance */

typedef struct Viewer {
    const Example *example;
    Canvas *canvas;
    Window *window;
    Options first; /* at the start; restored by r */
    ParameterValue first_values[OPTIONS_MAX_PARAMETERS];
    Options options;       /* current */
    double seconds;        /* options.seconds before it was rounded */
    const char *precision; /* that are in use */
    int samples;
    bool paused, full_screen, left;
    WindowInput input;
    double last; /* when the last frame began */
    int due;     /* frames to draw although time stands still: something has changed */
    int drawn, drawn_paused;
    int margins[PANEL_MARGINS]; /* that the panel has in the window's size */
    int place[4];               /* the picture's in the window: x, y, width, height */
    int plain[2], asked[2]; /* the window's size without the panel, and the one asked for with it */
    /* Since the title was last updated: */
    double title_time;
    int frames;
    const char *state; /* in the title */
    bool title_paused;
    ViewerPanel panel;
    bool panel_had_pointer; /* in the previous frame: a press may precede the pointer's current
                               position */
    bool pressed, holding;  /* in the previous frame: the left button; a light, by its handle */
    Handle held;            /* where it has been dragged */
    ShaderReload reload;
    DrawRequest request; /* of the options: see current */
    Message broken;      /* error of the shaders on disk */
    Message unmade;      /* why renderer_renew failed */
    Picture picture;     /* read back, to be saved or retouched */
    Message trouble;     /* why drawing failed */
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
    const Options *options = &viewer->first;
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
    return viewer->reload.renderer.example && !viewer->unmade.text[0];
}

/* As the options are now. */
static const DrawRequest *current(Viewer *viewer)
{
    viewer->request = options_request(&viewer->options, viewer->example);
    return &viewer->request;
}

static bool read_picture(Viewer *viewer, Message *message)
{
    return renderer_picture(&viewer->reload.renderer, current(viewer), viewer->options.seconds,
                            &viewer->picture.image, message);
}

/* As the headless program writes it. */
static bool write_picture(Viewer *viewer, Message *message)
{
    const Options *options = &viewer->options;
    const ExampleKind *kind = example_kind(viewer->example);
    Picture *picture = &viewer->picture;
    const char *vector = kind->vector_format ? kind->vector_format(picture->path) : NULL;
    if (vector) {
        const VectorFile file = {picture->path, vector, options->width, options->height,
                                 options->alpha};
        return kind->write_vector(viewer->example, options->seconds, &file, message);
    }
    if (!read_picture(viewer, message))
        return false;
    picture_texts_set(viewer->example, viewer->canvas, options, options->seconds, picture);
    return picture_write(picture, message);
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

/* Zero without a sign, so that it is not written as -0. */
static double rounded(double value, double parts)
{
    return round(value * parts) / parts + 0.0;
}

/* Within the command line's limits, so that every time can be drawn again. */
static void pass_time(Viewer *viewer, double seconds)
{
    const double now = viewer->seconds + seconds;
    viewer->seconds = fmin(fmax(now, -OPTIONS_MAX_SECONDS), OPTIONS_MAX_SECONDS);
    viewer->options.seconds = rounded(viewer->seconds, PARTS_OF_SECOND);
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
    viewer_panel_renew(&viewer->panel);
    viewer->unmade = (Message){0};
    if (!viewer->reload.renderer.example ||
        renderer_renew(&viewer->reload.renderer, current(viewer), &viewer->unmade) ||
        strcmp(viewer->unmade.text, before.text) == 0)
        return;
    options_fail(viewer->example->name, &viewer->unmade, EXIT_FAILED);
}

/* All as at the start, but for the size, which the window has. What depends on it is to be renewed.
 */
static void put_back(Viewer *viewer)
{
    const Parameter *parameters = viewer->example->parameters;
    const int width = viewer->options.width, height = viewer->options.height;
    viewer->options = viewer->first;
    viewer->options.width = width;
    viewer->options.height = height;
    viewer->seconds = viewer->first.seconds;
    viewer->paused = false;
    for (int i = 0; parameters && parameters[i].name; i++)
        parameter_restore(&parameters[i], viewer->first_values[i]);
}

/* After a change of options that are not read for each frame. */
static bool apply_options(Viewer *viewer, Message *message)
{
    const char *precision = viewer->options.shaders.precision;
    const int samples = viewer->options.canvas.samples;
    if (precision != viewer->precision)
        shader_reload_renew(&viewer->reload);
    viewer->precision = precision;
    const bool same = samples == viewer->samples;
    viewer->samples = samples;
    return same || canvas_set_samples(viewer->canvas, samples,
                                      options_have_shadows(&viewer->options), message);
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
    put_back(viewer);
    snprintf(text, sizeof text, "%s", arguments);
    for (char *word = strtok_r(text, " ", &place); word && count <= MAX_WORDS;
         word = strtok_r(NULL, " ", &place))
        words[count++] = word;
    const double seconds = viewer->options.seconds;
    options_table(&usage, &viewer->options, OPTIONS_TO_READ, table);
    if (!arguments_read(table, count, words, &answer, &message))
        viewer_panel_notice(&viewer->panel, message.text);
    viewer->paused = viewer->options.seconds != seconds;
    viewer->seconds = viewer->options.seconds;
    renew(viewer);
}

static void move_light(Viewer *viewer)
{
    const Handle *held = &viewer->held;
    LightPlaces *places = &viewer->options.places;
    const PanelKind *panel = example_kind(viewer->example)->panel;
    Vec3 at;
    if (!is_made(viewer) || !panel)
        return;
    if (panel->drag(&viewer->reload.renderer, current(viewer), held, &at)) {
        places->placed |= 1U << held->light;
        places->at[held->light] = at;
        viewer_panel_renew(&viewer->panel);
    }
    if (viewer->options.cheap)
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
        put_back(viewer);
        renew(viewer);
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
    case '+':
    case '=':
    case '-':
        viewer_panel_letters(&viewer->panel, character == '-' ? -1 : 1);
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
    const ExampleKind *kind = example_kind(viewer->example);
    if (kind->turn_page && kind->turn_page(viewer->example, input->pressed[WINDOW_KEY_PAGE_DOWN] -
                                                                input->pressed[WINDOW_KEY_PAGE_UP]))
        renew(viewer);
    viewer->left |= input->pressed[WINDOW_KEY_ESCAPE] > 0;
}

/* Takes the light at whose point the left button went down, and moves it until the button goes up.
 * False: the pointer has no light. */
static bool use_handles(Viewer *viewer)
{
    static const double REACH = 11;
    const WindowInput *input = &viewer->input;
    if (input->buttons[0] && !viewer->pressed) {
        const Handle *handle =
            viewer_panel_find_handle(&viewer->panel, input->press_x,
                                     input->press_y - viewer->place[1], REACH * input->scale);
        viewer->holding = handle != NULL;
        if (handle)
            viewer->held = *handle;
    }
    viewer->pressed = input->buttons[0];
    if (!viewer->holding)
        return false;
    viewer->held.x += input->drag_x;
    viewer->held.y += input->drag_y;
    if (input->drag_x != 0 || input->drag_y != 0)
        move_light(viewer);
    viewer->holding = viewer->pressed;
    return true;
}

static void use_pointer(Viewer *viewer)
{
    const WindowInput *input = &viewer->input;
    Orbit *orbit = &viewer->options.orbit;
    if (viewer->panel.result.wants_pointer || viewer->panel_had_pointer) {
        viewer->pressed = input->buttons[0];
        return;
    }
    if (use_handles(viewer))
        return;
    const double degrees = DEGREES_PER_PIXEL / input->scale;
    if (input->drag_x != 0 || input->drag_y != 0) {
        orbit->azimuth =
            rounded(fmod(orbit->azimuth - degrees * input->drag_x, 360), PARTS_OF_DEGREE);
        orbit->elevation = rounded(orbit->elevation + degrees * input->drag_y, PARTS_OF_DEGREE);
        orbit->elevation = fmin(fmax(orbit->elevation, -90), 90);
    }
    if (input->scroll != 0) {
        const double distance = orbit_distance(*orbit);
        /* --orbit may start beyond these limits. */
        const double min = fmin(NEAREST, distance), max = fmax(FARTHEST, distance);
        orbit->distance =
            rounded(distance * pow(NEARER_PER_NOTCH, input->scroll), PARTS_OF_DISTANCE);
        orbit->distance = fmin(fmax(orbit->distance, min), max);
    }
}

/* As a headless program draws it. */
static bool draw_moment(Viewer *viewer)
{
    viewer->trouble = (Message){0};
    if (renderer_finishes_on_cpu(viewer->example, viewer->picture.image.type))
        return read_picture(viewer, &viewer->trouble);
    return renderer_draw(&viewer->reload.renderer, current(viewer), viewer->options.seconds,
                         &viewer->trouble);
}

/* Copies what was drawn to its place in the window, and clears what the panel lies on. */
static bool present(Viewer *viewer, const Image *image, Message *message)
{
    const int width = viewer->input.width, height = viewer->input.height;
    const int *place = viewer->place, below = height - place[1] - place[3];
    const Image *map = viewer_panel_map(&viewer->panel, place[2], place[3]);
    const int from_below[4] = {place[0], below, place[2], place[3]};
    const int around[3][4] = {{place[2], 0, width - place[2], height},
                              {0, 0, width, below},
                              {0, below + place[3], width, place[1]}};
    bool done = true;
    image = map ? map : image;
    if (image)
        done = canvas_present_image(image, from_below, message);
    else
        canvas_present(viewer->canvas, from_below);
    glEnable(GL_SCISSOR_TEST);
    glClearColor(0, 0, 0, 1);
    for (int i = 0; i < 3; i++) {
        glScissor(around[i][0], around[i][1], around[i][2], around[i][3]);
        if (around[i][2] > 0 && around[i][3] > 0)
            glClear(GL_COLOR_BUFFER_BIT);
    }
    glDisable(GL_SCISSOR_TEST);
    return done;
}

static bool show_nothing(Viewer *viewer, Message *message)
{
    canvas_clear(viewer->canvas, (Vec3){0, 0, 0}, 1);
    return present(viewer, NULL, message);
}

/* Draws and copies to the window. An error in drawing does not end the viewer: the time, the size
 * or the parameters may change. */
static bool show_picture(Viewer *viewer, Message *message)
{
    const bool had_trouble = viewer->trouble.text[0];
    bool drawn = draw_moment(viewer);
    /* A program that is first needed now may not compile although earlier ones did. */
    if (!drawn && shader_reload_revert(&viewer->reload, &viewer->trouble)) {
        viewer->broken = viewer->trouble;
        options_fail(viewer->example->name, &viewer->broken, EXIT_FAILED);
        drawn = draw_moment(viewer);
    }
    if (!drawn) {
        if (!had_trouble)
            options_fail(viewer->example->name, &viewer->trouble, EXIT_FAILED);
        return show_nothing(viewer, message);
    }
    const Image *image = &viewer->picture.image;
    return present(viewer, renderer_finishes_on_cpu(viewer->example, image->type) ? image : NULL,
                   message);
}

static bool show(Viewer *viewer, Message *message)
{
    const WindowInput *input = &viewer->input;
    const double start = clock_now();
    if (!(is_made(viewer) ? show_picture(viewer, message) : show_nothing(viewer, message)))
        return false;
    if (viewer->panel.view == PANEL_OPEN)
        glFinish(); /* to measure the time of the picture */
    viewer_panel_measured(&viewer->panel, clock_now() - start);
    return canvas_check(viewer->canvas, message) &&
           viewer_panel_draw(&viewer->panel, input->width, input->height, message);
}

/* Name, state, and while time runs the rate: twice per second, and at once when the state changes.
 */
static void update_title(Viewer *viewer)
{
    enum { SIZE = 200 };
    static const char *const states[] = {"", ", paused", ", no picture", ", broken shader"};
    char title[SIZE], rate[40] = "";
    const double now = clock_now(), elapsed = now - viewer->title_time;
    const bool trouble = viewer->unmade.text[0] || viewer->trouble.text[0];
    const char *state = states[viewer->broken.text[0] ? 3 : trouble ? 2 : viewer->paused];
    const bool same = state == viewer->state && viewer->title_paused == viewer->paused;
    viewer->frames++;
    if (same && (viewer->paused || elapsed < 0.5))
        return;
    viewer->panel.rate = viewer->paused ? 0 : viewer->frames / elapsed;
    viewer->title_time = now;
    viewer->frames = 0;
    viewer->state = state;
    viewer->title_paused = viewer->paused;
    if (!viewer->paused)
        snprintf(rate, sizeof rate, ", %.0f frames per second", viewer->panel.rate);
    snprintf(title, SIZE, "%s%s%s", viewer->example->name, rate, state);
    window_title(viewer->window, title);
}

static bool load(Viewer *viewer, Message *message)
{
    const Message *warning = &viewer->reload.renderer.warning;
    Message error = {0};
    current(viewer);
    switch (shader_reload_poll(&viewer->reload, 0, &error)) {
    case RELOAD_FAILED:
        return message_set(message, "%s", error.text);
    case RELOAD_BROKEN:
        viewer->due = SETTLE;
        options_fail(viewer->example->name, &error, EXIT_FAILED);
        viewer->broken = error;
        viewer->unmade = (Message){0}; /* it was opened again */
        return true;
    case RELOAD_LOADED:
        viewer->due = SETTLE;
        if (warning->text[0])
            options_warn(viewer->example->name, warning);
        if (viewer->reload.changed[0] || warning->text[0])
            viewer_panel_notice(&viewer->panel,
                                warning->text[0] ? warning->text : "shaders loaded");
        viewer->broken = viewer->unmade = (Message){0};
        viewer_panel_renew(&viewer->panel);
        return true;
    case RELOAD_UNCHANGED:
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
    const ViewerPanelInput input = {.window = &viewer->input,
                                    .seconds = elapsed,
                                    .renderer = is_made(viewer) ? &viewer->reload.renderer : NULL,
                                    .options = &viewer->options,
                                    .trouble = trouble,
                                    .held = viewer->holding ? &viewer->held : NULL};
    if (!viewer_panel_frame(panel, &input, message))
        return false;
    if (viewer_panel_tint(panel, &viewer->options.tints)) {
        viewer_panel_renew(panel);
        if (viewer->options.cheap)
            renew(viewer);
    }
    if (panel->result.tried)
        try_arguments(viewer, panel->result.tried);
    else if (panel->result.changed || panel->result.options)
        renew(viewer);
    viewer_panel_letters(panel, panel->result.larger);
    return true;
}

/* The size of the picture: what the panel leaves of the window. */
static bool use_size(Viewer *viewer, Message *message)
{
    const WindowInput *input = &viewer->input;
    if (input->width <= 0 || input->height <= 0)
        return true;
    viewer_panel_place(&viewer->panel, input, viewer->place);
    viewer->options.width = viewer->place[2];
    viewer->options.height = viewer->place[3];
    return canvas_resize(viewer->canvas, viewer->place[2], viewer->place[3], message);
}

/* When the panel comes, goes or changes its width, so does the window, and the picture keeps its
 * size, as far as there is room on the screen. */
static void make_room(Viewer *viewer)
{
    const WindowInput *input = &viewer->input;
    const int *before = viewer->margins, window[2] = {input->width, input->height};
    int now[PANEL_MARGINS], size[2];
    viewer_panel_margins(&viewer->panel, input, now);
    const int all[2] = {now[PANEL_RIGHT], now[PANEL_ABOVE] + now[PANEL_BELOW]};
    const int had[2] = {before[PANEL_RIGHT], before[PANEL_ABOVE] + before[PANEL_BELOW]};
    if (memcmp(now, before, sizeof now) == 0)
        return;
    if (had[0] == 0 && had[1] == 0)
        memcpy(viewer->plain, window, sizeof window);
    const bool back = all[0] == 0 && all[1] == 0 && viewer->asked[0] == window[0] &&
                      viewer->asked[1] == window[1];
    for (int i = 0; i < 2; i++)
        size[i] = back ? viewer->plain[i] : window[i] + all[i] - had[i];
    memcpy(viewer->margins, now, sizeof now);
    if (!viewer->full_screen)
        window_resize(viewer->window, &size[0], &size[1]);
    memcpy(viewer->asked, size, sizeof size);
}

static bool frame(Viewer *viewer, double wait, Message *message)
{
    WindowInput *input = &viewer->input;
    window_input(viewer->window, wait, input);
    const double now = clock_now(), elapsed = now - viewer->last;
    viewer->last = now;
    if (!viewer->paused)
        pass_time(viewer, elapsed);
    if (!load(viewer, message))
        return false;
    if (input->touched || viewer_panel_due(&viewer->panel))
        viewer->due = SETTLE;
    if (viewer->paused && viewer->due == 0) {
        viewer->title_time = now;
        viewer->frames = 0;
        return true;
    }
    viewer->due -= viewer->due > 0;
    if (!use_size(viewer, message) || !use_panel(viewer, elapsed, message))
        return false;
    use_pointer(viewer);
    use_keys(viewer);
    if (!apply_options(viewer, message))
        return false;
    viewer->left |= input->closed;
    if (viewer->left || input->width == 0 || input->height == 0)
        return true;
    if (!show(viewer, message))
        return false;
    window_swap(viewer->window);
    viewer->drawn++;
    viewer->drawn_paused += viewer->paused;
    make_room(viewer);
    update_title(viewer);
    return window_check(viewer->window, message);
}

/* Until the next frame, unless there is an event: the rest of the screen's period, because faster
 * is useless, where swapping does not wait. While time stands still, until the next look at the
 * shader files. */
static double wait_time(const Viewer *viewer)
{
    static const double HIDDEN = 0.1, LOOK = 0.05;
    const double period = 1 / window_refresh_rate(viewer->window);
    if (viewer->input.width == 0 || viewer->input.height == 0)
        return HIDDEN;
    if (viewer->paused && viewer->due == 0)
        return LOOK;
    return fmax(0, viewer->last + 0.95 * period - clock_now());
}

bool viewer_run(const Example *example, Canvas *canvas, const Options *options,
                const ParameterValue *defaults, Message *message)
{
    const Parameter *parameters = example->parameters;
    Viewer viewer = {.example = example,
                     .canvas = canvas,
                     .window = window_of(canvas),
                     .options = *options,
                     .seconds = options->seconds,
                     .picture.image.type = canvas->real ? IMAGE_FLOAT : IMAGE_BYTE};
    for (int i = 0; parameters && parameters[i].name; i++)
        viewer.first_values[i] = parameter_save(&parameters[i]);
    if (!shader_reload_open(&viewer.reload, example, canvas, &viewer.request, message))
        return false;
    viewer.options.shaders.files = viewer.request.shaders.files;
    viewer.first = viewer.options;
    viewer.precision = options->shaders.precision;
    viewer.samples = options->canvas.samples;
    viewer_panel_open(&viewer.panel, example, canvas, &viewer.options, defaults);
    viewer_panel_notice(&viewer.panel, example_kind(example)->turn_page
                                           ? "page down: the next   p: panel   h: help"
                                           : "p: panel   h: help");
    window_show(viewer.window);
    viewer.last = viewer.title_time = clock_now();
    bool done = frame(&viewer, 0, message);
    while (done && !viewer.left)
        done = frame(&viewer, wait_time(&viewer), message);
    if (options->verbose)
        fprintf(stderr, "window: %d frames drawn, %d of them while time stood still\n",
                viewer.drawn, viewer.drawn_paused);
    viewer_panel_close(&viewer.panel);
    image_close(&viewer.picture.image);
    shader_reload_close(&viewer.reload);
    return done;
}
