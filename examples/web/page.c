#include "web/page.h"

#include "web/page_state.h"

#include "app/command.h"
#include "base/json_writer.h"
#include "base/text.h"
#include "scene/scene_example.h"
#include "web/all_examples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Larger pictures would hold the page up, or its memory. */
enum { MAX_SIDE = 4096 };

/* The common options that a page has; the others are of files, processes or a terminal. */
static const char *const SHOWN[] = {
    "size",        "time",     "angle",   "orbit",        "samples",       "precision",
    "alpha",       "full",     "clamp",   "linear-light", "terms",         "light-at",
    "light-color", "lighting", "shadows", "shadow-bias",  "shadow-filter", "show-clipped",
    "clamp-dots",  "normals",  NULL};
/* What a program has itself, but no page: files, unless its module reads them. */
static const char *const ABSENT[] = {
#ifndef PAGE_FILES
    "model", "up",
#endif
    NULL};

PageState page;

static ParameterValue defaults[COUNT][OPTIONS_MAX_PARAMETERS];

static bool is_shown(const Parameter *option, bool own)
{
    return own ? text_among(option->name, ABSENT) < 0 : text_among(option->name, SHOWN) >= 0;
}

/* Saved before the first command line is read; restored before each. */
static void restore_defaults(int number)
{
    static bool saved;
    for (int i = 0; i < COUNT && !saved; i++) {
        const Parameter *own = ALL[i]->parameters;
        for (int k = 0; own && own[k].name; k++)
            defaults[i][k] = parameter_save(&own[k]);
    }
    saved = true;
    const Parameter *own = ALL[number]->parameters;
    for (int k = 0; own && own[k].name; k++)
        parameter_restore(&own[k], defaults[number][k]);
}

/* Texts. */

FILE *page_text_begin(void)
{
    static size_t size;
    free(page.text);
    page.text = NULL;
    return open_memstream(&page.text, &size);
}

const char *page_text_end(FILE *file)
{
    const bool whole = file && fclose(file) == 0;
    return whole && page.text ? page.text : "";
}

static void put_option(JsonWriter *json, const Parameter *option, bool own)
{
    static const char *const KINDS[] = {"number", "whole", "choice", "switch",
                                        "flag",   "color", "text"};
    char value[PARAMETER_TEXT_SIZE], range[PARAMETER_RANGE_SIZE];
    const char *const *choices = parameter_choices(option);
    json_write_object(json, NULL);
    json_write_text(json, "name", option->name);
    json_write_text(json, "help", option->help);
    json_write_text(json, "kind", KINDS[option->kind]);
    json_write_text(json, "value", parameter_text(option, value));
    json_write_text(json, "standard", option->standard ? option->standard : "");
    json_write_text(json, "placeholder", parameter_placeholder(option));
    if (option->kind == PARAMETER_NUMBER || option->kind == PARAMETER_WHOLE ||
        option->kind == PARAMETER_COLOR)
        json_write_text(json, "range", parameter_range(option, range));
    if (isfinite(option->min) && isfinite(option->max) && option->min < option->max) {
        json_write_number(json, "min", option->min);
        json_write_number(json, "max", option->max);
    }
    json_write_flag(json, "own", own);
    json_write_list(json, "choices");
    for (int i = 0; choices && choices[i]; i++)
        json_write_text(json, NULL, choices[i]);
    json_write_end(json);
    json_write_end(json);
}

static void put_program(JsonWriter *json, const Example *example)
{
    Parameter table[OPTIONS_MAX];
    const Usage usage = options_usage(example);
    Options options = options_default(&usage);
    const int common = options_table(&usage, &options, OPTIONS_TO_SHOW, table);
    json_write_object(json, NULL);
    json_write_text(json, "name", example->name);
    json_write_text(json, "summary", example->summary);
    json_write_flag(json, "scene", example_scene(example) != NULL);
    json_write_list(json, "tries");
    for (int i = 0; i < 4 && example->tries[i]; i++) {
        json_write_object(json, NULL);
        json_write_text(json, "arguments", example->tries[i]);
        json_write_text(json, "looks", example->looks[i] ? example->looks[i] : "");
        json_write_end(json);
    }
    json_write_end(json);
    json_write_list(json, "options");
    for (int i = 0; table[i].name; i++)
        if (is_shown(&table[i], i >= common))
            put_option(json, &table[i], i >= common);
    json_write_end(json);
    json_write_list(json, "absent");
    for (int i = common; table[i].name; i++)
        if (!is_shown(&table[i], true))
            json_write_text(json, NULL, table[i].name);
    json_write_end(json);
    json_write_end(json);
}

const char *page_programs(void)
{
    JsonWriter json = {.file = page_text_begin()};
    if (json.file)
        json_write_list(&json, NULL);
    for (int i = 0; json.file && i < COUNT; i++) {
        restore_defaults(i);
        put_program(&json, ALL[i]);
    }
    if (json.file)
        json_write_end(&json);
    page.example = NULL; /* its options are the defaults now */
    return page_text_end(json.file);
}

const char *page_message(void)
{
    return page.message.text[0] ? page.message.text : page.renderer.warning.text;
}

/* Options. */

/* Only whole names, so that a link means the same when there are more options. */
static bool check_argument(const Example *example, const char *argument, Message *message)
{
    const Usage usage = options_usage(example);
    Options options = options_default(&usage);
    Parameter table[OPTIONS_MAX];
    char name[64];
    const int common = options_table(&usage, &options, OPTIONS_TO_READ, table);
    if (strncmp(argument, "--", 2) != 0)
        return message_set(message, "%.80s: not an option", argument);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(argument + 2, "="), argument + 2);
    for (int i = 0; table[i].name; i++)
        if (strcmp(table[i].name, name) == 0)
            return (i < common ? text_among(name, SHOWN) >= 0 : text_among(name, ABSENT) < 0) ||
                   message_set(message, "--%s: not in the browser; the command has it", name);
    return message_set(message, "--%s: %s has no such option", name, example->name);
}

/* Reads the arguments of `lines`, whose newlines become zeros. */
static bool read_options(int number, char *lines, Options *options, Message *message)
{
    enum { MAX = 2 * OPTIONS_MAX };
    const Example *example = ALL[number];
    const Usage usage = options_usage(example);
    char *argv[MAX + 1] = {NULL};
    int argc = 0;
    for (char *line = lines; line && argc < MAX; argc++) {
        argv[argc] = line;
        line = strchr(line, '\n');
        if (line)
            *line++ = '\0';
        if (argc > 0 && !check_argument(example, argv[argc], message))
            return false;
    }
    restore_defaults(number);
    if (options_read(options, &usage, argc, argv, message) != OPTIONS_RUN)
        return false;
    return (options->width <= MAX_SIDE && options->height <= MAX_SIDE) ||
           message_set(message, "--size %dx%d: a page draws up to %dx%d; the command draws more",
                       options->width, options->height, MAX_SIDE, MAX_SIDE);
}

const char *page_values(void)
{
    Parameter table[OPTIONS_MAX];
    char value[PARAMETER_TEXT_SIZE];
    FILE *file = page_text_begin();
    if (!file || !page.example)
        return page_text_end(file);
    const Usage usage = options_usage(page.example);
    const int common = options_table(&usage, &page.options, OPTIONS_TO_SHOW, table);
    JsonWriter json = {.file = file};
    json_write_object(&json, NULL);
    for (int i = 0; table[i].name; i++)
        if (is_shown(&table[i], i >= common))
            json_write_text(&json, table[i].name, parameter_text(&table[i], value));
    json_write_end(&json);
    return page_text_end(file);
}

static int find_example(const char *lines)
{
    const size_t length = strcspn(lines, "\n");
    for (int i = 0; i < COUNT; i++)
        if (strlen(ALL[i]->name) == length && strncmp(ALL[i]->name, lines, length) == 0)
            return i;
    return -1;
}

/* The canvas. */

static bool same_text(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* The canvas has another size or other samples, in the same context. */
static bool fit_canvas(const Options *options, Message *message)
{
    if (!page.canvas.backend)
        return options_open_canvas(&page.canvas, options, "x.png", message);
    return canvas_resize(&page.canvas, options->width, options->height, message) &&
           canvas_set_samples(&page.canvas, options->canvas.samples, options_have_shadows(options),
                              message);
}

static bool open_renderer(const Example *example, bool keeps, Message *message)
{
    const DrawRequest request = options_request(&page.options, example);
    if (keeps)
        return renderer_renew(&page.renderer, &request, message);
    renderer_close(&page.renderer);
    shader_files_close(&page.files);
    return renderer_open(&page.renderer, example, &page.canvas, &request, message);
}

/* Runs the example's init and finish: what it has open is closed before. */
static bool check_terms(const Example *example, const Options *options, Message *message)
{
    const DrawRequest request = options_request(options, example);
    if (page.renderer.example == example && example->finish)
        example->finish();
    return !example_kind(example)->check ||
           example_kind(example)->check(example, &request, message);
}

int page_open(const char *lines)
{
    Options options;
    char *copy = strdup(lines);
    page.message = (Message){0};
    const int number = find_example(lines);
    if (number < 0)
        message_set(&page.message, "%.*s: no such program", (int)strcspn(lines, "\n"), lines);
    /* The parameters change now: what was open cannot be drawn any more. */
    page.example = NULL;
    if (!copy || number < 0 || !read_options(number, copy, &options, &page.message) ||
        !check_terms(ALL[number], &options, &page.message)) {
        free(copy);
        return EXIT_USAGE;
    }
    const bool keeps = page.renderer.example == ALL[number] && !page.replaced &&
                       same_text(options.shaders.precision, page.options.shaders.precision);
    options.shaders.folder = page.folder[0] ? page.folder : NULL;
    options.shaders.files = &page.files;
    options.defaults = defaults[number];
    page.options = options;
    free(page.lines);
    page.lines = copy;
    page.replaced = false;
    if (!fit_canvas(&options, &page.message)) {
        page_close();
        return EXIT_FAILED;
    }
    if (!open_renderer(ALL[number], keeps, &page.message)) {
        renderer_close(&page.renderer);
        return EXIT_FAILED;
    }
    page.example = ALL[number];
    return 0;
}

void page_close(void)
{
    renderer_close(&page.renderer);
    canvas_close(&page.canvas);
    shader_files_close(&page.files);
    page.example = NULL;
}

/* Pictures. */

int page_draw(double seconds, double azimuth, double elevation, double distance, double roll)
{
    page.message = (Message){0};
    if (!page.example)
        return message_set(&page.message, "no program is open");
    page.options.seconds = seconds;
    page.options.orbit = (Orbit){azimuth, elevation, distance, roll};
    page.image.type = IMAGE_BYTE;
    const DrawRequest request = options_request(&page.options, page.example);
    if (!renderer_picture(&page.renderer, &request, seconds, &page.image, &page.message))
        return 0;
    /* What is left of a broken uniform or shader is the next picture's. */
    return 1;
}

const unsigned char *page_pixels(void)
{
    return page.image.pixels;
}

int page_width(void)
{
    return page.image.width;
}

int page_height(void)
{
    return page.image.height;
}

const char *page_command(void)
{
    char command[4096], start[128];
    FILE *file = page_text_begin();
    Options own = page.options;
    if (!file || !page.example)
        return page_text_end(file);
    snprintf(start, sizeof start, "examples/run %s", page.example->name);
    own.start = start;
    own.shaders.folder = own.shaders.folder ? "mine" : NULL;
    command_write(page.example, &own, own.defaults, command, sizeof command);
    fputs(command, file);
    return page_text_end(file);
}

int page_explain(int receipts)
{
    page.message = (Message){0};
    if (!page.example)
        return 0;
    DrawRequest request = options_request(&page.options, page.example);
    request.verbose = receipts;
    const bool done = renderer_explain(&page.renderer, &request, &page.message);
    fflush(stdout);
    return done;
}

/* Shaders. */

/* Below the folder of all shaders, or of those that replace them. */
static const char *shader_name(const char *path)
{
    const char *found = strstr(path, "/shaders/");
    return found ? found + strlen("/shaders/") : path;
}

const char *page_shaders(void)
{
    JsonWriter json = {.file = page_text_begin()};
    if (!json.file)
        return "";
    json_write_list(&json, NULL);
    for (int i = 0; i < page.files.count; i++) {
        const ShaderFile *shader = &page.files.files[i];
        if (!shader->text || strstr(shader->path, "overlay."))
            continue;
        json_write_object(&json, NULL);
        json_write_text(&json, "name", shader_name(shader->path));
        json_write_text(&json, "text", shader->text);
        json_write_end(&json);
    }
    json_write_end(&json);
    return page_text_end(json.file);
}

static bool make_folders(char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0700);
        *slash = '/';
    }
    return true;
}

int page_replace(const char *name, const char *text, int size)
{
    char path[256];
    page.message = (Message){0};
    if (!name[0]) {
        page.replaced = true;
        page.folder[0] = '\0';
        return 1;
    }
    if (name[0] == '/' || strstr(name, "..") || size > SHADER_FILE_MAX ||
        snprintf(path, sizeof path, "/tmp/shaders/%s", name) >= (int)sizeof path)
        return message_set(&page.message, "%.80s: has %d bytes; at most %d are read", name, size,
                           SHADER_FILE_MAX);
    make_folders(path);
    FILE *file = fopen(path, "w");
    const bool written = file && fwrite(text, 1, (size_t)size, file) == (size_t)size;
    if ((file && fclose(file) != 0) || !written)
        return message_set(&page.message, "%s: cannot be kept", name);
    page.replaced = true;
    snprintf(page.folder, sizeof page.folder, "/tmp/shaders");
    return 1;
}
