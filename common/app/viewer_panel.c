#include "app/viewer_panel.h"

#include "app/command.h"
#include "app/explain.h"
#include "base/clock.h"
#include "scene/scene_example.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* See stage.h. */
#pragma weak explain_effects

static const double NOTICE_SECONDS = 3, EFFECTS_SECONDS = 0.25, ERROR_SECONDS = 0.5;

static const PanelHelp HELP[] = {
    {"page down, up", "the next lesson, the one before"}, /* of pages alone */
    {"drag", "turns the camera"},
    {"scroll", "comes nearer, goes away"},
    {"space", "stops time, lets it go on"},
    {"left, right", "a picture back, forward"},
    {"up, down", "a second forward, back"},
    {"s", "saves the picture"},
    {"r", "starts again"},
    {"f", "the whole screen, and back"},
    {"p", "the panel"},
    {"+, -", "larger, smaller letters"},
    {"h", "this help"},
    {"escape", "leaves"},
    {NULL, NULL},
};

static const PanelHelp *help_of(const ViewerPanel *panel)
{
    return panel->example->page ? HELP : HELP + 1;
}

/* The common options that change a picture that is shown, from the table of all. */
static void choose_options(ViewerPanel *panel, const Canvas *canvas, Options *options)
{
    static const char *const NAMES[] = {"samples",      "precision", "clamp",
                                        "linear-light", "lighting",  "show-clipped"};
    const Usage usage = options_usage(panel->example);
    Options usual = options_default(&usage);
    Parameter all[OPTIONS_MAX], of_usual[OPTIONS_MAX];
    int count = 0;
    const int common = options_table(&usage, options, OPTIONS_TO_SHOW, all);
    options_table(&usage, &usual, OPTIONS_TO_SHOW, of_usual);
    for (size_t k = 0; k < sizeof NAMES / sizeof NAMES[0]; k++) {
        for (int i = 0; i < common; i++) {
            if (strcmp(all[i].name, NAMES[k]) != 0)
                continue;
            panel->options[count] = all[i];
            panel->option_defaults[count++] = parameter_save(&of_usual[i]);
            if (all[i].value == &options->canvas.samples)
                panel->options[count - 1].max = canvas_max_samples(canvas);
        }
    }
    panel->options[count].name = NULL;
}

void viewer_panel_open(ViewerPanel *panel, const Example *example, const Canvas *canvas,
                       Options *options, const ParameterValue *defaults)
{
    Message message = {0};
    *panel =
        (ViewerPanel){.example = example, .window = window_of(canvas), .text = 1, .stale = true};
    memcpy(panel->defaults, defaults, sizeof panel->defaults);
    choose_options(panel, canvas, options);
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

static PanelErrorPart part_of(const ErrorSum *sum)
{
    return (PanelErrorPart){.rms = error_sum_rms(sum), .maximum = sum->maximum};
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
                        .of_computing = part_of(&result.of_computing),
                        .of_mesh = part_of(&result.error.interior),
                        .at_edges = part_of(&result.error.edges),
                        .seconds = result.seconds,
                        .mapped = panel->mapped,
                        .colors = PICTURE_ERROR_COLORS};
}

const Image *viewer_panel_map(ViewerPanel *panel, int width, int height)
{
    ErrorResult result;
    if (!panel->mapped || panel->view != PANEL_OPEN || !panel->error_worker)
        return NULL;
    error_worker_result(panel->error_worker, &result);
    if (result.known && result.number != panel->map_number &&
        error_worker_map(panel->error_worker, &panel->map))
        panel->map_number = result.number;
    return panel->map.width == width && panel->map.height == height ? &panel->map : NULL;
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

void viewer_panel_margins(const ViewerPanel *panel, const WindowInput *input,
                          int margins[PANEL_MARGINS])
{
    panel_margins(panel->panel ? panel->view : PANEL_HIDDEN, panel->troubled,
                  scale_of(panel, input), margins);
}

void viewer_panel_place(const ViewerPanel *panel, const WindowInput *input, int place[4])
{
    panel_place(panel->panel ? panel->view : PANEL_HIDDEN, panel->troubled, scale_of(panel, input),
                input->width, input->height, place);
}

static void find_handles(ViewerPanel *panel, Stage *stage, const Options *options)
{
    for (int view = 0; panel->example->scene && view < stage_view_count(stage); view++) {
        StageView shown;
        int place[4];
        if (!stage_view_place(stage, view, place))
            continue;
        if (stage_view_open(&shown, stage, options, options->seconds, view, NULL))
            panel->handle_count =
                handles_add(panel->handles, panel->handle_count, &shown.asked, view, place);
        stage_view_close(&shown);
    }
}

static void add_light(ViewerPanel *panel, int number, const Light *light, const LightTints *tints)
{
    static const char *const words[] = {"diffuse", "specular"};
    const bool tinted = tints->tinted >> number & 1;
    const Vec3 plain[] = {light->diffuse, light->specular};
    const Vec3 own[] = {tints->diffuse[number], tints->specular[number]};
    for (int k = 0; k < 2; k++) {
        const int row = 2 * number + k;
        snprintf(panel->light_names[row], sizeof panel->light_names[row], "light %d %s", number,
                 words[k]);
        panel->light_values[row] = tinted ? own[k] : plain[k];
        panel->light_defaults[row].color = plain[k];
        panel->lights[row] = (Parameter){.name = panel->light_names[row],
                                         .help = "of this light: --light-color",
                                         .kind = PARAMETER_COLOR,
                                         .value = &panel->light_values[row],
                                         .max = 1};
    }
    panel->lights[2 * number + 2].name = NULL;
}

/* The lights of all views as the example has them, and their colors as the options do. */
static void find_lights(ViewerPanel *panel, Stage *stage, const Options *options)
{
    Options plain = *options;
    int count = 0;
    plain.terms = (SceneTerms){.left_out = 0};
    plain.tints = (LightTints){.tinted = 0};
    plain.cheap = false;
    for (int view = 0; panel->example->scene && view < stage_view_count(stage); view++) {
        StageView shown;
        if (stage_view_open(&shown, stage, &plain, options->seconds, view, NULL))
            for (; count < shown.asked.light_count && count < SCENE_MAX_PLACED; count++)
                add_light(panel, count, &shown.asked.lights[count], &options->tints);
        stage_view_close(&shown);
    }
    panel->lights[2 * count].name = NULL;
}

bool viewer_panel_tint(const ViewerPanel *panel, LightTints *tints)
{
    for (int i = 0; i < SCENE_MAX_PLACED; i++) {
        const Vec3 *own = &panel->light_values[2 * i];
        const ParameterValue *plain = &panel->light_defaults[2 * i];
        if (!(panel->result.lights >> 2 * i & 3))
            continue;
        tints->diffuse[i] = own[0];
        tints->specular[i] = own[1];
        tints->tinted |= 1U << i;
        if (memcmp(&own[0], &plain[0].color, sizeof(Vec3)) == 0 &&
            memcmp(&own[1], &plain[1].color, sizeof(Vec3)) == 0)
            tints->tinted &= ~(1U << i);
    }
    return panel->result.lights != 0;
}

/* The handles in the window. */
static void mark(const ViewerPanel *panel, const WindowInput *input, const Handle *held,
                 PanelMark marks[HANDLES_MAX])
{
    int place[4];
    viewer_panel_place(panel, input, place);
    for (int i = 0; i < panel->handle_count; i++) {
        const Handle *handle = &panel->handles[i];
        marks[i] =
            (PanelMark){.number = handle->light,
                        .x = handle->x,
                        .y = handle->y + place[1],
                        .held = held && handle->light == held->light && handle->view == held->view};
    }
}

bool viewer_panel_frame(ViewerPanel *panel, const WindowInput *input, double seconds, Stage *stage,
                        const Options *options, const Message *trouble, const Handle *held,
                        Message *message)
{
    PanelMark marks[HANDLES_MAX];
    panel->handle_count = 0;
    panel->result = (PanelResult){.view = panel->view, .mapped = panel->mapped};
    if (!panel->panel)
        return true;
    panel->troubled = trouble->text[0] != '\0';
    if (panel->view == PANEL_OPEN && stage && !trouble->text[0]) {
        update_error(panel, stage, options);
        update_effects(panel, stage, options);
        find_handles(panel, stage, options);
        find_lights(panel, stage, options);
        command_write(panel->example, options, panel->defaults, panel->command,
                      sizeof panel->command);
    }
    WindowInput own = *input;
    own.scale = scale_of(panel, input);
    panel->noticed = has_notice(panel);
    mark(panel, input, held, marks);
    const PanelInput in = {.window = &own,
                           .seconds = seconds,
                           .clipboard = panel->window,
                           .get_clipboard = get_clipboard,
                           .set_clipboard = set_clipboard};
    const PanelContent content = {.name = panel->example->name,
                                  .view = panel->view,
                                  .parameters = example_parameters(panel->example),
                                  .defaults = panel->defaults,
                                  .options = panel->options,
                                  .option_defaults = panel->option_defaults,
                                  .lights = panel->lights,
                                  .light_defaults = panel->light_defaults,
                                  .marks = panel->handle_count ? marks : NULL,
                                  .mark_count = panel->handle_count,
                                  .tries = panel->example->tries,
                                  .looks = panel->example->looks,
                                  .milliseconds = 1e3 * panel->seconds,
                                  .frames_per_second = panel->rate,
                                  .error = known_error(panel),
                                  .effects = panel->effects,
                                  .command = panel->command[0] ? panel->command : NULL,
                                  .help = panel->help ? help_of(panel) : NULL,
                                  .errors = trouble->text[0] ? trouble->text : NULL,
                                  .notice = panel->noticed ? panel->notice : NULL};
    if (!panel_frame(panel->panel, &in, &content, &panel->result, message))
        return false;
    panel->view = panel->result.view;
    panel->mapped = panel->result.mapped;
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

void viewer_panel_letters(ViewerPanel *panel, int larger)
{
    static const double STEP = 1.15, SMALLEST = 0.7, LARGEST = 2.5;
    panel->text = fmin(fmax(panel->text * pow(STEP, larger), SMALLEST), LARGEST);
    if (fabs(panel->text - 1) < STEP / 100)
        panel->text = 1;
}

void viewer_panel_toggle_help(ViewerPanel *panel)
{
    panel->help = !panel->help;
    for (const PanelHelp *help = help_of(panel); !panel->panel && help->key; help++)
        fprintf(stderr, "%-14s %s\n", help->key, help->action);
}

void viewer_panel_close(ViewerPanel *panel)
{
    if (panel->error_worker)
        error_worker_close(panel->error_worker);
    panel_draw_close(&panel->draw);
    panel_close(panel->panel);
    free(panel->effects);
    image_close(&panel->map);
    *panel = (ViewerPanel){0};
}
