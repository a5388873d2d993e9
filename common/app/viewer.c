/* --window: a loop of frames. Time passes unless it is paused; input changes options, and the
 * picture is drawn from these as a headless program draws it, so that a saved command makes the
 * same one. Nothing is drawn while nothing changes.
 */
#include "app/viewer.h"

#include "app/viewer_state.h"
#include "base/clock.h"
#include "window/window.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SETTLE = 3 }; /* frames until the panel shows all that follows from an event */

bool viewer_is_made(const Viewer *viewer)
{
    return viewer->reload.renderer.example && !viewer->unmade.text[0];
}

const DrawRequest *viewer_request(Viewer *viewer)
{
    viewer->request = options_request(&viewer->options, viewer->example);
    return &viewer->request;
}

bool viewer_read_picture(Viewer *viewer, Message *message)
{
    return renderer_picture(&viewer->reload.renderer, viewer_request(viewer),
                            viewer->options.seconds, &viewer->picture.image, message);
}

void viewer_renew(Viewer *viewer)
{
    const Message before = viewer->unmade;
    viewer_panel_renew(&viewer->panel);
    viewer->unmade = (Message){0};
    if (!viewer->reload.renderer.example)
        shader_reload_renew(&viewer->reload);
    if (!viewer->reload.renderer.example ||
        renderer_renew(&viewer->reload.renderer, viewer_request(viewer), &viewer->unmade) ||
        strcmp(viewer->unmade.text, before.text) == 0)
        return;
    options_fail(viewer->example->name, &viewer->unmade, EXIT_FAILED);
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

/* As a headless program draws it. */
static bool draw_moment(Viewer *viewer)
{
    viewer->trouble = (Message){0};
    if (renderer_finishes_on_cpu(viewer->example, viewer->picture.image.type))
        return viewer_read_picture(viewer, &viewer->trouble);
    return renderer_draw(&viewer->reload.renderer, viewer_request(viewer), viewer->options.seconds,
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
    const Image *shown = viewer_pixel_image(viewer);
    image = shown ? shown : map ? map : image;
    if (image)
        done = canvas_present_image(image, image->width, from_below, message);
    else
        canvas_present(viewer->canvas, from_below);
    done = done && viewer_before_present(viewer, from_below, message);
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
    if (!(viewer_is_made(viewer) ? show_picture(viewer, message) : show_nothing(viewer, message)))
        return false;
    if (viewer->panel.view == PANEL_OPEN)
        glFinish(); /* to measure the time of the picture */
    viewer_panel_measured(&viewer->panel, clock_now() - start);
    if (!canvas_check(viewer->canvas, message) ||
        !viewer_panel_draw(&viewer->panel, input->width, input->height, message))
        return false;
    viewer_pixel_point(viewer); /* binds the canvas */
    return true;
}

/* Name, state, and while time runs the rate: twice per second, and at once when the state changes.
 */
static void update_title(Viewer *viewer)
{
    enum { SIZE = 200 + PIXEL_LINE };
    static const char *const states[] = {"", ", paused", ", no picture", ", broken shader"};
    char title[SIZE], rate[40] = "";
    const char *line = viewer->panel.view == PANEL_OPEN ? "" : viewer->pixel.line;
    const double now = clock_now(), elapsed = now - viewer->title_time;
    const bool trouble = viewer->unmade.text[0] || viewer->trouble.text[0];
    const char *state = states[viewer->broken.text[0] ? 3 : trouble ? 2 : viewer->paused];
    const bool same = state == viewer->state && viewer->title_paused == viewer->paused &&
                      strcmp(line, viewer->title_line) == 0;
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
    snprintf(title, SIZE, "%s%s%s%s%s", viewer->example->name, line[0] ? ", " : "", line, rate,
             state);
    snprintf(viewer->title_line, sizeof viewer->title_line, "%s", line);
    window_title(viewer->window, title);
}

static bool load(Viewer *viewer, Message *message)
{
    Message *warning = &viewer->reload.renderer.warning, error = {0};
    viewer_request(viewer);
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
        if (viewer->reload.gone && !warning->text[0])
            message_set(warning, "%s is gone", viewer->reload.changed);
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
                                    .renderer =
                                        viewer_is_made(viewer) ? &viewer->reload.renderer : NULL,
                                    .options = &viewer->options,
                                    .trouble = trouble,
                                    .held = viewer->holding ? &viewer->held : NULL,
                                    .pixel = viewer_pixel_content(viewer)};
    if (!viewer_panel_frame(panel, &input, message))
        return false;
    if (viewer_panel_tint(panel, &viewer->options.tints)) {
        viewer_panel_renew(panel);
        if (viewer->options.cheap)
            viewer_renew(viewer);
    }
    if (panel->result.tried)
        viewer_try(viewer, panel->result.tried);
    else if (panel->result.changed || panel->result.options)
        viewer_renew(viewer);
    viewer_panel_letters(panel, panel->result.larger);
    viewer_pixel_choose(viewer, &panel->result);
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
        viewer_pass_time(viewer, elapsed);
    if (!load(viewer, message))
        return false;
    if (input->touched || viewer_panel_due(&viewer->panel) || viewer_pixel_due(viewer))
        viewer->due = SETTLE;
    if (viewer->paused && viewer->due == 0) {
        viewer->title_time = now;
        viewer->frames = 0;
        return true;
    }
    viewer->due -= viewer->due > 0;
    if (!use_size(viewer, message) || !use_panel(viewer, elapsed, message))
        return false;
    viewer_use_pointer(viewer);
    viewer_use_keys(viewer);
    if (!apply_options(viewer, message))
        return false;
    viewer->left |= input->closed;
    if (viewer->left || input->width == 0 || input->height == 0)
        return true;
    viewer_pixel_update(viewer);
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
    shader_reload_open(&viewer.reload, example, canvas, &viewer.request);
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
    viewer_pixel_close(&viewer.pixel);
    viewer_panel_close(&viewer.panel);
    image_close(&viewer.picture.image);
    image_close(&viewer.before);
    shader_reload_close(&viewer.reload);
    return done;
}
