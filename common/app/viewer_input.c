/* What keys and the pointer do: pictures are saved, the camera and lights are moved, time is
 * stepped through. */
#include "app/viewer_state.h"

#include "app/arguments.h"
#include "app/command.h"
#include "app/picture_texts.h"
#include "base/output.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double DEGREES_PER_PIXEL = 0.4, ROLL_DEGREES = 5, NEARER_PER_NOTCH = 0.9;
/* What moves by hand or by the clock is rounded to these parts, so that the command which draws the
 * picture is short: milliseconds, tenths of a degree, thousandths of the distance. */
static const double PARTS_OF_SECOND = 1000, PARTS_OF_DEGREE = 10, PARTS_OF_DISTANCE = 1000;
static const double NEAREST = 0.1, FARTHEST = 10; /* factors of the example's distance */

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
    if (!viewer_read_picture(viewer, message))
        return false;
    picture_texts_set(viewer->example, viewer->canvas, options, options->seconds, picture);
    return picture_write(picture, message);
}

static void save(Viewer *viewer)
{
    Message message = {0};
    if (!viewer_is_made(viewer))
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

void viewer_pass_time(Viewer *viewer, double seconds)
{
    const double now = viewer->seconds + seconds;
    viewer->seconds = fmin(fmax(now, -OPTIONS_MAX_SECONDS), OPTIONS_MAX_SECONDS);
    viewer->options.seconds = rounded(viewer->seconds, PARTS_OF_SECOND);
}

static void step(Viewer *viewer, double seconds)
{
    viewer->paused = true;
    viewer_pass_time(viewer, seconds);
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

void viewer_try(Viewer *viewer, const char *arguments)
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
    viewer_renew(viewer);
}

static void move_light(Viewer *viewer)
{
    const Handle *held = &viewer->held;
    LightPlaces *places = &viewer->options.places;
    const PanelKind *panel = example_kind(viewer->example)->panel;
    Vec3 at;
    if (!viewer_is_made(viewer) || !panel)
        return;
    if (panel->drag(&viewer->reload.renderer, viewer_request(viewer), held, &at)) {
        places->placed |= 1U << held->light;
        places->at[held->light] = at;
        viewer_panel_renew(&viewer->panel);
    }
    if (viewer->options.cheap)
        viewer_renew(viewer);
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
    case 'b':
        viewer_before_toggle(viewer);
        break;
    case 'r':
        put_back(viewer);
        viewer_renew(viewer);
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
    case '[':
    case ']': {
        double *roll = &viewer->options.orbit.roll;
        *roll = fmod(*roll + (character == '[' ? ROLL_DEGREES : -ROLL_DEGREES), 360);
        break;
    }
    case '+':
    case '=':
    case '-':
        viewer_panel_letters(&viewer->panel, character == '-' ? -1 : 1);
        break;
    default:
        break;
    }
}

static void press(Viewer *viewer, WindowKey key)
{
    const ExampleKind *kind = example_kind(viewer->example);
    const bool forward = key == WINDOW_KEY_RIGHT || key == WINDOW_KEY_UP;
    switch (key) {
    case WINDOW_KEY_LEFT:
    case WINDOW_KEY_RIGHT:
        step(viewer, (forward ? 1 : -1) / viewer->options.fps);
        break;
    case WINDOW_KEY_UP:
    case WINDOW_KEY_DOWN:
        step(viewer, forward ? 1 : -1);
        break;
    case WINDOW_KEY_PAGE_UP:
    case WINDOW_KEY_PAGE_DOWN:
        if (kind->turn_page &&
            kind->turn_page(viewer->example, key == WINDOW_KEY_PAGE_DOWN ? 1 : -1))
            viewer_renew(viewer);
        break;
    case WINDOW_KEY_ESCAPE:
        viewer->left = true;
        break;
    default:
        break;
    }
}

/* In order, of which a slow frame has many. */
void viewer_use_keys(Viewer *viewer)
{
    const WindowInput *input = &viewer->input;
    if (viewer->panel.result.wants_keys)
        return;
    for (int i = 0; i < input->typed_count; i++) {
        if (input->typed[i] >= WINDOW_TYPED_KEY) {
            press(viewer, input->typed[i] - WINDOW_TYPED_KEY);
            continue;
        }
        viewer_panel_notice(&viewer->panel, NULL); /* it has been seen */
        type(viewer, input->typed[i]);
    }
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
        viewer->clicks = !handle;
        viewer->dragged[0] = viewer->dragged[1] = 0;
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

/* Turns the camera, or is a click if the pointer moves less than a hand does unwillingly. */
static void use_drag(Viewer *viewer)
{
    static const double UNWILLING = 3;
    const WindowInput *input = &viewer->input;
    Orbit *orbit = &viewer->options.orbit;
    double *dragged = viewer->dragged;
    const double degrees = DEGREES_PER_PIXEL / input->scale;
    dragged[0] += input->drag_x;
    dragged[1] += input->drag_y;
    viewer->clicks &= hypot(dragged[0], dragged[1]) < UNWILLING * input->scale;
    if (viewer->clicks && !input->buttons[0])
        viewer_pixel_click(viewer, input->press_x, input->press_y);
    viewer->clicks &= input->buttons[0];
    if (viewer->clicks || (dragged[0] == 0 && dragged[1] == 0))
        return;
    orbit->azimuth = rounded(fmod(orbit->azimuth - degrees * dragged[0], 360), PARTS_OF_DEGREE);
    orbit->elevation = rounded(orbit->elevation + degrees * dragged[1], PARTS_OF_DEGREE);
    orbit->elevation = fmin(fmax(orbit->elevation, -90), 90);
    dragged[0] = dragged[1] = 0;
}

void viewer_use_pointer(Viewer *viewer)
{
    const WindowInput *input = &viewer->input;
    Orbit *orbit = &viewer->options.orbit;
    if (viewer->panel.result.wants_pointer || viewer->panel_had_pointer) {
        viewer->pressed = input->buttons[0];
        viewer->clicks = false;
        return;
    }
    if (use_handles(viewer))
        return;
    use_drag(viewer);
    if (input->scroll != 0) {
        const double distance = orbit_distance(*orbit);
        /* --orbit may start beyond these limits. */
        const double min = fmin(NEAREST, distance), max = fmax(FARTHEST, distance);
        orbit->distance =
            rounded(distance * pow(NEARER_PER_NOTCH, input->scroll), PARTS_OF_DISTANCE);
        orbit->distance = fmin(fmax(orbit->distance, min), max);
    }
}
