/* Reads a command line, and resolves it into what is asked of what draws. */
#include "app/options.h"

#include "app/arguments.h"
#include "base/version.h"
#include "images/image_file.h"
#include "window/backends.h"

#include <stdio.h>

bool options_in_window(const Options *options)
{
    const CanvasBackend *given = options->canvas.backend;
    const CanvasBackend *backend = given ? given : backend_default(NULL);
    return backend && backend->presents;
}

bool options_have_shadows(const Options *options)
{
    return options->shadows.way != SHADOWS_OFF;
}

Usage options_usage(const Example *example)
{
    const ExampleKind *kind = example_kind(example);
    Usage usage = {.name = example->name,
                   .summary = example->summary,
                   .kind = kind,
                   .width = example->width,
                   .height = example->height,
                   .tries = example->tries,
                   .looks = example->looks,
                   .parameters = example->parameters};
    if (kind->describe)
        kind->describe(example, &usage);
    return usage;
}

DrawRequest options_request(const Options *options, const Example *example)
{
    const Parameter *own = example->parameters;
    DrawRequest request = {.shaders = options->shaders,
                           .verbose = options->verbose,
                           .alpha = options->alpha,
                           .orbit = options->orbit,
                           .seconds = options->seconds,
                           .fps = options->fps,
                           .frames = options->frames,
                           .endless = options_in_window(options),
                           .full = options->full,
                           .clamp_vertex = options->clamp_vertex,
                           .signed_dots = options->signed_dots,
                           .linear = options->linear,
                           .show_clipped = options->show_clipped,
                           .normals = options->normals,
                           .terms = options->terms,
                           .shadows = options->shadows,
                           .places = options->places,
                           .tints = options->tints,
                           .cheap = options->cheap,
                           .error = options->error};
    for (int i = 0; own && own[i].name && i < OPTIONS_MAX_PARAMETERS; i++)
        request.fixed |= options->own_given[i] ? own[i].fixes : 0;
    return request;
}

void options_size(const Usage *usage, int *width, int *height)
{
    *width = usage->width ? usage->width : OPTIONS_SIDE;
    *height = usage->height ? usage->height : OPTIONS_SIDE;
    if (usage->resize)
        usage->resize(width, height);
}

Options options_default(const Usage *usage)
{
    Options options = {.frames = 1, .fps = OPTIONS_FPS, .compress = IMAGE_COMPRESS_DEFAULT};
    options_size(usage, &options.width, &options.height);
    options.seconds = usage->seconds;
    options.canvas.samples = usage->gallery ? 4 : 0;
    options.shadows = usage->shadows;
    snprintf(options.default_output, sizeof options.default_output, "%s%s", usage->name,
             usage->gallery || usage->study ? "" : ".png");
    return options;
}

/* Prints --help, or the form of --generate; with the defaults, whatever was given. */
static void print_about(const Usage *usage, const char *form)
{
    Options options = options_default(usage);
    Parameter table[OPTIONS_MAX];
    const int common = options_table(usage, &options, OPTIONS_TO_SHOW, table);
    if (form) {
        help_generate(form, usage, table);
        return;
    }
    table[common].name = NULL;
    help_print(usage, table);
}

/* The first name as the value of the option that is for it. */
static void take_operand(Options *options, const Usage *usage)
{
    for (int i = 0; usage->operand && options->names[0] && usage->parameters[i].name; i++)
        if (usage->parameters[i].value == usage->operand) {
            *usage->operand = *options->names++;
            options->own_given[i] = true;
            return;
        }
}

OptionsResult options_read(Options *options, const Usage *usage, int argc, char *argv[],
                           Message *message)
{
    Parameter all[OPTIONS_MAX];
    const Parameter *answer;
    *options = options_default(usage);
    options_table(usage, options, OPTIONS_TO_READ, all);
    if (!arguments_read(all, argc, argv, &answer, message))
        return OPTIONS_BAD;
    if (answer && answer->letter == 'h')
        print_about(usage, NULL);
    else if (answer)
        printf("%s (lighting) %s\n", usage->name, VERSION);
    else if (options->generate)
        print_about(usage, options->generate);
    if (answer || options->generate)
        return OPTIONS_ANSWERED;
    if (!options->size_given)
        options_size(usage, &options->width, &options->height);
    options->names = argv + (argc > 0);
    take_operand(options, usage);
    if (options_in_window(options)) /* by LIGHTING_BACKEND too, which core reads without windows */
        options->canvas.backend = backend_find("window", NULL);
    if (options->frames > 1)
        snprintf(options->default_output, sizeof options->default_output, "%s%%04d.png",
                 usage->name);
    if (!options->output_given)
        options->output = options->default_output;
    return options_check(options, usage, message) ? OPTIONS_RUN : OPTIONS_BAD;
}
