#include "viewer_panel.h"

#include "command.h"
#include "progress.h"
#include "stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double NOTICE_SECONDS = 3, EFFECTS_SECONDS = 0.25, APPRAISE_SECONDS = 0.5;

static const PanelHelp HELP[] = {
    {"drag", "turns the camera"},
    {"scroll", "comes nearer, goes away"},
    {"space", "stops time, lets it go on"},
    {"left, right", "a picture back, forward"},
    {"up, down", "a second forward, back"},
    {"s", "saves the picture"},
    {"r", "begins anew"},
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
    *panel = (ViewerPanel){.example = example, .window = window, .stale = true};
    memcpy(panel->defaults, defaults, sizeof panel->defaults);
    if (!panel_open(&panel->panel, &message) ||
        !panel_draw_open(&panel->draw, &options->shaders, &message) ||
        (example->scene && !appraise_open(&panel->appraise, &message))) {
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

/* Which effects the scene calls for, now and then. */
static void explain(ViewerPanel *panel, const Options *options)
{
    const double now = progress_now();
    size_t size = 0;
    if (!panel->example->scene || (panel->effects && now - panel->effects_time < EFFECTS_SECONDS))
        return;
    free(panel->effects);
    panel->effects = NULL;
    FILE *file = open_memstream(&panel->effects, &size);
    if (!file)
        return;
    stage_effects(panel->example, options, file);
    fclose(file);
    panel->effects_time = now;
}

static bool same_picture(const Options *a, const Options *b)
{
    return a->seconds == b->seconds && a->width == b->width && a->height == b->height &&
           a->orbit.azimuth == b->orbit.azimuth && a->orbit.elevation == b->orbit.elevation &&
           a->orbit.distance == b->orbit.distance;
}

/* Has the error computed of a picture that is another one by now: at once where somebody has
 * changed a parameter, and twice a second as time goes on. */
static void appraise(ViewerPanel *panel, const Canvas *canvas, const Options *options)
{
    AppraisePicture picture;
    const double now = progress_now();
    if (!panel->example->scene || (!panel->stale && same_picture(&panel->appraised, options)))
        return;
    if (!panel->stale &&
        (appraise_busy(panel->appraise) || now - panel->appraised_time < APPRAISE_SECONDS))
        return;
    if (panel->stale)
        appraise_cancel(panel->appraise);
    /* Where it cannot be drawn the frame itself says why. */
    if (!stage_appraise(panel->example, canvas, options, options->seconds, &picture, NULL))
        return;
    appraise_start(panel->appraise, &picture);
    panel->appraised = *options;
    panel->appraised_time = now;
    panel->stale = false;
}

static PanelError known_error(const ViewerPanel *panel)
{
    AppraiseResult result;
    if (!panel->appraise)
        return (PanelError){.known = false};
    appraise_result(panel->appraise, &result);
    return (PanelError){.known = result.known,
                        .computing = result.computing,
                        .rms = result.known ? error_sum_rms(&result.error.interior) : 0,
                        .maximum = result.error.interior.maximum,
                        .seconds = result.seconds};
}

bool viewer_panel_frame(ViewerPanel *panel, const WindowInput *input, double seconds,
                        const Canvas *canvas, const Options *options, bool on_stage,
                        const Message *trouble, Message *message)
{
    panel->result = (PanelResult){.view = panel->view};
    if (!panel->panel)
        return true;
    if (panel->view == PANEL_OPEN && on_stage && !trouble->text[0]) {
        appraise(panel, canvas, options);
        explain(panel, options);
        command_write(panel->example, options, panel->defaults, panel->command,
                      sizeof panel->command);
    }
    const bool notice = panel->notice[0] && progress_now() - panel->notice_time < NOTICE_SECONDS;
    const PanelInput in = {.window = input,
                           .seconds = seconds,
                           .clipboard = panel->window,
                           .get_clipboard = get_clipboard,
                           .set_clipboard = set_clipboard};
    const PanelContent content = {.name = panel->example->name,
                                  .view = panel->view,
                                  .parameters = panel->example->parameters,
                                  .defaults = panel->defaults,
                                  .milliseconds = 1e3 * panel->seconds,
                                  .frames_per_second = panel->rate,
                                  .error = known_error(panel),
                                  .effects = panel->effects,
                                  .command = panel->command[0] ? panel->command : NULL,
                                  .help = panel->help ? HELP : NULL,
                                  .errors = trouble->text[0] ? trouble->text : NULL,
                                  .notice = notice ? panel->notice : NULL};
    if (!panel_frame(panel->panel, &in, &content, &panel->result, message))
        return false;
    panel->view = panel->result.view;
    if (panel->result.changed) {
        panel->stale = true;
        panel->effects_time = 0;
    }
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

void viewer_panel_notice(ViewerPanel *panel, const char *text)
{
    snprintf(panel->notice, sizeof panel->notice, "%s", text ? text : "");
    panel->notice_time = progress_now();
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
    appraise_close(panel->appraise);
    panel_draw_close(&panel->draw);
    panel_close(panel->panel);
    free(panel->effects);
    *panel = (ViewerPanel){0};
}
