/* The panel over the picture. What costs time is found a few times per second, and only while the
 * panel is open: effects and commands here, errors by a worker in the background.
 */
#include "app/viewer_state.h"

#include "app/command.h"
#include "base/clock.h"
#include "base/output_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double NOTICE_SECONDS = 3, EFFECTS_SECONDS = 0.25, ERROR_SECONDS = 0.5;

static const PanelHelp HELP[] = {
    {"page down, up", "the next lesson, the one before"}, /* of pages alone */
    {"drag", "turns the camera"},
    {"click", "explains the pixel"},
    {"scroll", "zooms"},
    {"space", "pauses, resumes"},
    {"left, right", "a picture back, forward"},
    {"up, down", "a second forward, back"},
    {"s", "saves the picture"},
    {"b", "before and after"},
    {"r", "starts again"},
    {"f", "the whole screen, and back"},
    {"p", "the panel"},
    {"[, ]", "roll the camera"},
    {"+, -", "larger, smaller letters"},
    {"h", "this help"},
    {"escape", "leaves"},
    {NULL, NULL},
};

static const PanelHelp *help_of(const ViewerPanel *panel)
{
    return example_kind(panel->example)->turn_page ? HELP : HELP + 1;
}

/* The common options that change a picture that is shown, from the table of all. */
static void choose_options(ViewerPanel *panel, const Canvas *canvas, Options *options)
{
    static const char *const NAMES[] = {"samples",  "precision",    "clamp",      "linear-light",
                                        "lighting", "show-clipped", "clamp-dots", "normals"};
    const Usage usage = options_usage(panel->example);
    Options usual = options_default(&usage);
    Parameter all[OPTIONS_MAX], of_usual[OPTIONS_MAX];
    int count = 0;
    const int common = options_table(&usage, options, OPTIONS_TO_SHOW, all);
    options_table(&usage, &usual, OPTIONS_TO_SHOW, of_usual);
    for (size_t k = 0; k < sizeof NAMES / sizeof NAMES[0]; k++)
        for (int i = 0; i < common; i++) {
            if (strcmp(all[i].name, NAMES[k]) != 0)
                continue;
            panel->options[count] = all[i];
            panel->option_defaults[count++] = parameter_save(&of_usual[i]);
            if (all[i].value == &options->canvas.samples)
                panel->options[count - 1].max = canvas_max_samples(canvas);
        }
    panel->options[count].name = NULL;
}

void viewer_panel_open(ViewerPanel *panel, const Example *example, const Canvas *canvas,
                       Options *options, const ParameterValue *defaults)
{
    Message message = {0};
    *panel = (ViewerPanel){.example = example,
                           .kind = example_kind(example)->panel,
                           .window = window_of(canvas),
                           .text = 1,
                           .stale = true};
    memcpy(panel->defaults, defaults, sizeof panel->defaults);
    choose_options(panel, canvas, options);
    if (!panel_open(&panel->panel, &message) ||
        !panel_draw_open(&panel->draw, &options->shaders, &message) ||
        (panel->kind && !panel->kind->open(&panel->worker, &message))) {
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

static bool same_picture(const DrawRequest *a, const DrawRequest *b)
{
    return a->seconds == b->seconds && a->orbit.azimuth == b->orbit.azimuth &&
           a->orbit.elevation == b->orbit.elevation && a->orbit.distance == b->orbit.distance &&
           a->orbit.roll == b->orbit.roll;
}

bool viewer_panel_other(const PanelPicture *picture, const Renderer *renderer,
                        const DrawRequest *request)
{
    const Canvas *canvas = renderer->canvas;
    return picture->width != canvas->width || picture->height != canvas->height ||
           !same_picture(&picture->request, request);
}

PanelPicture viewer_panel_picture(const Renderer *renderer, const DrawRequest *request)
{
    return (PanelPicture){
        .request = *request, .width = renderer->canvas->width, .height = renderer->canvas->height};
}

static void close_effects(ViewerPanel *panel)
{
    for (int i = 0; i < panel->objects.count; i++) {
        free(panel->objects.all[i].row);
        free(panel->objects.all[i].effects);
        free(panel->objects.all[i].same);
    }
    free(panel->objects.all);
    free(panel->effects);
    panel->objects = (PanelObjects){0};
}

/* Lists the effects that the scene calls for, a few times per second. */
static void update_effects(ViewerPanel *panel, Renderer *renderer, const DrawRequest *request)
{
    const double now = clock_now();
    OutputText text;
    const bool known = panel->effects && panel->effects_time > 0;
    panel->effects_wanted = !known || viewer_panel_other(&panel->effects_of, renderer, request);
    if (!panel->effects_wanted || (known && now - panel->effects_time < EFFECTS_SECONDS))
        return;
    panel->effects_wanted = false;
    close_effects(panel);
    output_text_open(&text);
    panel->kind->write_effects(renderer, request, text.file, &panel->objects);
    panel->effects = output_text_close(&text);
    panel->effects_time = now;
    panel->effects_of = viewer_panel_picture(renderer, request);
}

static bool busy(const ViewerPanel *panel)
{
    return panel->worker && panel->kind->busy(panel->worker);
}

static bool may_start(const ViewerPanel *panel)
{
    return !busy(panel) && clock_now() - panel->error_time >= ERROR_SECONDS;
}

/* Starts computing the error of a picture that has changed: at once after a change of a parameter,
 * twice per second as time passes. */
static void update_error(ViewerPanel *panel, Renderer *renderer, const DrawRequest *request)
{
    panel->error_wanted = panel->stale || viewer_panel_other(&panel->error_of, renderer, request);
    if (!panel->error_wanted || (!panel->stale && !may_start(panel)))
        return;
    panel->error_wanted = false;
    if (panel->stale)
        panel->kind->cancel(panel->worker);
    if (!panel->kind->start(panel->worker, renderer, request))
        return;
    panel->error_of = viewer_panel_picture(renderer, request);
    panel->error_time = clock_now();
    panel->stale = false;
}

static PanelError known_error(ViewerPanel *panel)
{
    if (!panel->worker)
        return (PanelError){.known = false};
    PanelError error = panel->kind->error(panel->worker);
    panel->computing = error.computing;
    error.mapped = panel->mapped;
    return error;
}

const Image *viewer_panel_map(ViewerPanel *panel, int width, int height)
{
    if (!panel->mapped || panel->view != PANEL_OPEN || !panel->worker)
        return NULL;
    panel->kind->map(panel->worker, &panel->map, &panel->map_number);
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

const Handle *viewer_panel_find_handle(const ViewerPanel *panel, double x, double y, double reach)
{
    return panel->handle_count
               ? panel->kind->find_handle(panel->handles, panel->handle_count, x, y, reach)
               : NULL;
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

/* What the panel shows of the picture. */
static void update(ViewerPanel *panel, Renderer *renderer, const Options *options)
{
    const DrawRequest request = options_request(options, panel->example);
    if (panel->kind) {
        update_error(panel, renderer, &request);
        update_effects(panel, renderer, &request);
        panel->handle_count = panel->kind->handles(renderer, &request, panel->handles);
        /* The lights as the example has them, and their colors as the options do. */
        Light lights[SCENE_MAX_PLACED];
        const int count = panel->kind->lights(renderer, &request, lights);
        for (int i = 0; i < count; i++)
            add_light(panel, i, &lights[i], &request.tints);
        panel->lights[2 * count].name = NULL;
    }
    command_write(panel->example, options, panel->defaults, panel->command, sizeof panel->command);
}

static PanelContent content_of(ViewerPanel *panel, const ViewerPanelInput *input,
                               const PanelMark *marks)
{
    const Message *trouble = input->trouble;
    const Example *example = panel->example;
    return (PanelContent){.name = example->name,
                          .view = panel->view,
                          .parameters = example->parameters,
                          .defaults = panel->defaults,
                          .options = panel->options,
                          .option_defaults = panel->option_defaults,
                          .lights = panel->lights,
                          .light_defaults = panel->light_defaults,
                          .marks = panel->handle_count ? marks : NULL,
                          .mark_count = panel->handle_count,
                          .tries = example->tries,
                          .looks = example->looks,
                          .milliseconds = 1e3 * panel->seconds,
                          .frames_per_second = panel->rate,
                          .error = known_error(panel),
                          .pixel = input->pixel,
                          .effects = panel->effects,
                          .objects = panel->objects,
                          .command = panel->command[0] ? panel->command : NULL,
                          .help = panel->help ? help_of(panel) : NULL,
                          .errors = trouble->text[0] ? trouble->text : NULL,
                          .notice = panel->noticed ? panel->notice : NULL};
}

bool viewer_panel_frame(ViewerPanel *panel, const ViewerPanelInput *input, Message *message)
{
    PanelMark marks[HANDLES_MAX];
    panel->handle_count = 0;
    panel->result = (PanelResult){.view = panel->view, .mapped = panel->mapped};
    if (!panel->panel)
        return true;
    panel->troubled = input->trouble->text[0] != '\0';
    if (panel->view == PANEL_OPEN && input->renderer && !panel->troubled)
        update(panel, input->renderer, input->options);
    WindowInput own = *input->window;
    own.scale = scale_of(panel, input->window);
    panel->noticed = has_notice(panel);
    /* The handles in the window. */
    int place[4];
    viewer_panel_place(panel, input->window, place);
    for (int i = 0; i < panel->handle_count; i++) {
        const Handle *handle = &panel->handles[i];
        marks[i] = (PanelMark){.number = handle->light,
                               .x = handle->x,
                               .y = handle->y + place[1],
                               .held = input->held && handle->light == input->held->light &&
                                       handle->view == input->held->view};
    }
    const PanelInput in = {.window = &own,
                           .seconds = input->seconds,
                           .clipboard = panel->window,
                           .get_clipboard = get_clipboard,
                           .set_clipboard = set_clipboard};
    const PanelContent content = content_of(panel, input, marks);
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
    panel->renewals++;
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
    if (panel->worker)
        panel->kind->close(panel->worker);
    panel_draw_close(&panel->draw);
    panel_close(panel->panel);
    close_effects(panel);
    image_close(&panel->map);
    *panel = (ViewerPanel){0};
}
