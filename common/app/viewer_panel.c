#include "app/viewer_panel.h"

#include "app/command.h"
#include "app/explain.h"
#include "base/clock.h"
#include "scene/scene_example.h"

/* See stage.h. */
#pragma weak explain_effects

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double NOTICE_SECONDS = 3, EFFECTS_SECONDS = 0.25, ERROR_SECONDS = 0.5;

static const PanelHelp HELP[] = {
    {"drag", "turns the camera"},
    {"scroll", "comes nearer, goes away"},
    {"space", "stops time, lets it go on"},
    {"left, right", "a picture back, forward"},
    {"up, down", "a second forward, back"},
    {"s", "saves the picture"},
    {"r", "starts again"},
    {"f", "the whole screen, and back"},
    {"p", "the panel"},
    {"h", "this help"},
    {"escape", "leaves"},
    {NULL, NULL},
};

void viewer_panel_open(ViewerPanel *panel, const Example *example, Window *window,
                       const Options *options, const ParameterValue *defaults)
{
    Message message = {0};
    *panel = (ViewerPanel){.example = example, .window = window, .text = 1, .stale = true};
    memcpy(panel->defaults, defaults, sizeof panel->defaults);
    if (!panel_open(&panel->panel, &message) ||
        !panel_draw_open(&panel->draw, &options->shaders, &message) ||
        (example->scene && !error_worker_open(&panel->error_worker, &message))) {
        options_fail(example->name, &message, 0);
        panel_close(panel->panel);
        panel->panel = NULL;
    }
}

static const char *get_clipboard(void *window)
{
    return window_clipboard(window);
}

static void set_clipboard(void *window, const char *text)
{
    window_set_clipboard(window, text);
}

static bool same_picture(const Options *a, const Options *b)
{
    return a->seconds == b->seconds && a->width == b->width && a->height == b->height &&
           a->orbit.azimuth == b->orbit.azimuth && a->orbit.elevation == b->orbit.elevation &&
           a->orbit.distance == b->orbit.distance;
}

/* Lists the effects that the scene calls for, a few times per second. */
static void update_effects(ViewerPanel *panel, Stage *stage, const Options *options)
{
    const double now = clock_now();
    size_t size = 0;
    const bool known = panel->effects && panel->effects_time > 0;
    panel->effects_wanted =
        panel->example->scene && !(known && same_picture(&panel->effects_options, options));
    if (!panel->effects_wanted || (known && now - panel->effects_time < EFFECTS_SECONDS))
        return;
    panel->effects_wanted = false;
    free(panel->effects);
    panel->effects = NULL;
    FILE *file = open_memstream(&panel->effects, &size);
    if (!file)
        return;
    explain_effects(stage, options, file);
    fclose(file);
    panel->effects_time = now;
    panel->effects_options = *options;
}

static bool busy(ViewerPanel *panel)
{
    return panel->error_worker && error_worker_busy(panel->error_worker);
}

static bool may_start(ViewerPanel *panel)
{
    return !busy(panel) && clock_now() - panel->error_time >= ERROR_SECONDS;
}

/* Starts computing the error of a picture that has changed: at once after a change of a parameter,
 * twice per second as time passes. */
static void update_error(ViewerPanel *panel, Stage *stage, const Options *options)
{
    ErrorPicture picture;
    panel->error_wanted =
        panel->example->scene && (panel->stale || !same_picture(&panel->error_options, options));
    if (!panel->error_wanted || (!panel->stale && !may_start(panel)))
        return;
    panel->error_wanted = false;
    if (panel->stale)
        error_worker_cancel(panel->error_worker);
    /* If this fails, drawing the frame fails too and reports why. */
    if (!stage_error_picture(stage, options, options->seconds, &picture, NULL))
        return;
    error_worker_start(panel->error_worker, &picture);
    panel->error_options = *options;
    panel->error_time = clock_now();
    panel->stale = false;
}

static PanelError known_error(ViewerPanel *panel)
{
    ErrorResult result;
    if (!panel->error_worker)
        return (PanelError){.known = false};
    error_worker_result(panel->error_worker, &result);
    panel->computing = result.computing;
    return (PanelError){.known = result.known,
                        .computing = result.computing,
                        .rms = result.known ? error_sum_rms(&result.error.interior) : 0,
                        .maximum = result.error.interior.maximum,
                        .seconds = result.seconds};
}

static bool has_notice(const ViewerPanel *panel)
{
    return panel->notice[0] && clock_now() - panel->notice_time < NOTICE_SECONDS;
}

bool viewer_panel_due(ViewerPanel *panel)
{
    const bool open = panel->view == PANEL_OPEN;
    return panel->panel &&
           (has_notice(panel) != panel->noticed || (open && panel->computing != busy(panel)) ||
            (open && panel->error_wanted && may_start(panel)) ||
            (open && panel->effects_wanted &&
             clock_now() - panel->effects_time >= EFFECTS_SECONDS));
}

/* With the letters' size, by which the panel grows. */
static double scale_of(const ViewerPanel *panel, const WindowInput *input)
{
    return input->scale * panel->text;
}

void viewer_panel_margins(const ViewerPanel *panel, const WindowInput *input, int margins[2])
{
    panel_margins(panel->panel ? panel->view : PANEL_HIDDEN, scale_of(panel, input), margins);
}

void viewer_panel_room(const ViewerPanel *panel, const WindowInput *input, int room[2])
{
    panel_room(panel->panel ? panel->view : PANEL_HIDDEN, scale_of(panel, input), input->width,
               input->height, room);
}

bool viewer_panel_frame(ViewerPanel *panel, const WindowInput *input, double seconds, Stage *stage,
                        const Options *options, const Message *trouble, Message *message)
{
    panel->result = (PanelResult){.view = panel->view};
    if (!panel->panel)
        return true;
    if (panel->view == PANEL_OPEN && stage && !trouble->text[0]) {
        update_error(panel, stage, options);
        update_effects(panel, stage, options);
        command_write(panel->example, options, panel->defaults, panel->command,
                      sizeof panel->command);
    }
    WindowInput own = *input;
    own.scale = scale_of(panel, input);
    panel->noticed = has_notice(panel);
    const PanelInput in = {.window = &own,
                           .seconds = seconds,
                           .clipboard = panel->window,
                           .get_clipboard = get_clipboard,
                           .set_clipboard = set_clipboard};
    const PanelContent content = {.name = panel->example->name,
                                  .view = panel->view,
                                  .parameters = example_parameters(panel->example),
                                  .defaults = panel->defaults,
                                  .tries = panel->example->tries,
                                  .milliseconds = 1e3 * panel->seconds,
                                  .frames_per_second = panel->rate,
                                  .error = known_error(panel),
                                  .effects = panel->effects,
                                  .command = panel->command[0] ? panel->command : NULL,
                                  .help = panel->help ? HELP : NULL,
                                  .errors = trouble->text[0] ? trouble->text : NULL,
                                  .notice = panel->noticed ? panel->notice : NULL};
    if (!panel_frame(panel->panel, &in, &content, &panel->result, message))
        return false;
    panel->view = panel->result.view;
    return true;
}

bool viewer_panel_draw(ViewerPanel *panel, int width, int height, Message *message)
{
    return !panel->panel ||
           panel_draw(&panel->draw, &panel->result.drawing, width, height, message);
}

void viewer_panel_measured(ViewerPanel *panel, double seconds)
{
    static const double SHARE = 0.1; /* of the newest frame */
    panel->seconds = panel->seconds > 0 ? (1 - SHARE) * panel->seconds + SHARE * seconds : seconds;
}

void viewer_panel_renew(ViewerPanel *panel)
{
    panel->stale = true;
    panel->effects_time = 0;
}

void viewer_panel_notice(ViewerPanel *panel, const char *text)
{
    snprintf(panel->notice, sizeof panel->notice, "%s", text ? text : "");
    panel->notice_time = clock_now();
}

void viewer_panel_toggle(ViewerPanel *panel)
{
    panel->view = panel_next_view(panel->view);
    panel->stale = true;
}

void viewer_panel_toggle_help(ViewerPanel *panel)
{
    panel->help = !panel->help;
    for (const PanelHelp *help = HELP; !panel->panel && help->key; help++)
        fprintf(stderr, "%-12s %s\n", help->key, help->action);
}

void viewer_panel_close(ViewerPanel *panel)
{
    if (panel->error_worker)
        error_worker_close(panel->error_worker);
    panel_draw_close(&panel->draw);
    panel_close(panel->panel);
    free(panel->effects);
    *panel = (ViewerPanel){0};
}
