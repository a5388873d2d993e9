/*
 * precision: what a driver really computes.
 *
 * Measures the floating-point numbers of vertex and fragment shaders, the errors of their functions
 * against the truth, and what happens between vertices and pixels; and says how far pictures can be
 * off because of that.
 */
#include "app/doctor.h"
#include "app/options.h"
#include "base/output.h"
#include "base/output_text.h"
#include "study/arithmetic/arithmetic.h"
#include "study/report/report_gnuplot.h"
#include "study/results/table.h"

#include <stdlib.h>

static bool json, markdown;
static int inputs;

static bool read_inputs(const Parameter *parameter, const char *text, Message *message)
{
    enum { MIN = 17, MAX = 32 };
    int value;
    if (!parse_whole(text, 0, MAX, &value) || (value > 0 && value < MIN))
        return message_set(message, "--%s %s: must be %d to %d, or 0", parameter->name, text, MIN,
                           MAX);
    *(int *)parameter->value = value;
    return true;
}

static const ParameterCodec INPUTS = {"17..32", read_inputs, NULL};

static const Parameter parameters[] = {
    {"inputs", "inputs of each function, as a power of two; 0: 24, or fewer on a slow driver",
     PARAMETER_WHOLE, .value = &inputs, .min = 0, .max = 32, .codec = &INPUTS},
    {"json", "print JSON, which DIR gets too, instead of text", PARAMETER_FLAG, .value = &json},
    {"markdown", "print tables as Markdown, with processor, driver and compiler", PARAMETER_FLAG,
     .value = &markdown},
    {.name = NULL},
};

static bool write_json(const Arithmetics *found, const Forecast *forecast, const char *folder,
                       Message *message)
{
    char path[PATH_MAX];
    OutputText written;
    output_text_open(&written);
    arithmetic_json(found, forecast, written.file);
    char *text = output_text_close(&written);
    snprintf(path, sizeof path, "%s/precision.json", folder);
    const bool done = output_write(path, text, written.size, message);
    if (done && json)
        fwrite(text, 1, written.size, stdout);
    free(text);
    return done;
}

static bool report(const Arithmetics *found, const Options *options, Message *message)
{
    Forecast forecast;
    Message plot = {0};
    char driver[300];
    if (!forecast_make(found, options->height, &forecast, message) ||
        !write_json(found, &forecast, options->output, message))
        return false;
    if (!arithmetic_plot(found, options->output, &plot)) {
        /* An earlier run's show other numbers. */
        gnuplot_forget(options->output, "precision", NULL);
        fprintf(stderr, "precision: no plot: %s\n", plot.text);
    }
    if (json)
        return true;
    if (markdown) {
        snprintf(driver, sizeof driver, "%s; %s", found->renderer, found->version);
        table_machine(driver, stdout);
    }
    arithmetic_text(found, &forecast, markdown, stdout);
    if (!markdown)
        printf("\nwrote %s/precision.json%s\n", options->output,
               plot.text[0] ? "" : ", precision.png and precision.svg");
    return true;
}

static bool measure(const Options *options, Message *message)
{
    static Arithmetics found;
    Meter meter;
    if (!meter_open(&meter, options->canvas.backend, message))
        return false;
    if (options->verbose)
        fprintf(stderr, "renderer: %s\n", meter.canvas.renderer);
    const bool done = output_folder(options->output, message) &&
                      arithmetic_measure(&meter, inputs ? 1L << inputs : 0, &found, message);
    if (done) { /* for --doctor of all programs */
        char line[ARITHMETIC_LINE];
        arithmetic_line(&found, line);
        doctor_keep(&meter.canvas, line);
    }
    if (done && options->verbose)
        fprintf(stderr, "measured in %.1f s\n", found.seconds);
    const bool reported = done && report(&found, options, message);
    meter_close(&meter);
    return reported;
}

static const Usage usage = {
    .name = "precision",
    .summary = "what this driver really computes: its floats, its functions, its varyings",
    .details =
        "Nothing is taken from names or from what the driver says of itself: shaders compute,\n"
        "results are compared with the truth. A unit is one in the last place of the exact\n"
        "result, of dot, reflect, + and mix of the largest term. The last table is what these\n"
        "errors can add up to in pictures of --size's height.\n"
        "\nTry:  precision\n"
        "      precision --json\n"
        "      GALLIUM_OVERRIDE_CPU_CAPS=sse4.1 precision   # without 16-bit floats\n",
    .study = true,
    .parameters = parameters,
};

int main(int argc, char *argv[])
{
    Options options;
    int code;
    Message message = {0};
    if (!options_begin(&options, &usage, argc, argv, &code))
        return code;
    if (json && markdown) {
        message_set(&message, "--json and --markdown: one of them");
        return options_fail(usage.name, &message, EXIT_USAGE);
    }
    if (!measure(&options, &message))
        return options_fail(usage.name, &message, EXIT_FAILED);
    return options_finish(usage.name, 0);
}
