/* Whether a command line's options go together, as far as that needs neither driver nor files. */
#include "app/options.h"

#include "base/output.h"
#include "base/text.h"
#include "images/animation.h"

#include <string.h>
#include <strings.h>
#include <unistd.h>

static const char *const VECTORS[] = {"svg", "pdf"};

static bool draws_vectors(const Usage *usage)
{
    return usage->kind && usage->kind->vector_format;
}

/* Standard output: one picture, or a stream of them. */
static bool check_stream(Options *options, Message *message)
{
    options->numbered = false;
    if (options->watch)
        return message_set(message, "--output -: standard output takes one picture, and --watch "
                                    "draws many; name a file");
    const char *format = options->format;
    if (format && (strcmp(format, VECTORS[0]) == 0 || strcmp(format, VECTORS[1]) == 0))
        options->vector = format;
    else if (format && strcmp(format, "png") != 0)
        options->animation = format;
    if (options->frames > 1 && !options->animation)
        return message_set(message,
                           "--output -: standard output takes one picture as %s, not %d; "
                           "--format y4m or rgb takes them all",
                           options->vector ? options->vector : "PNG", options->frames);
    return !isatty(STDOUT_FILENO) ||
           message_set(message, "--output -: standard output is a terminal; send it to a file or a "
                                "pipe");
}

/* Whether the pictures go to one file that is an animation, or each to its own. */
static bool find_animation(Options *options, Message *message)
{
    char first[PATH_MAX];
    const char *output = options->output;
    const char *animation =
        options_in_window(options) ? NULL : animation_format(output, options->frames);
    /* Neither one picture nor an animation needs a number. */
    if (options->numbered && (options->frames == 1 || animation))
        options->numbered = output_numbered(output, 0, first, sizeof first, NULL);
    if (!options->numbered)
        options->animation = animation;
    else if (animation_format(output, 1))
        return message_set(message, "%s: a .%s holds all the pictures; leave the number out",
                           output, animation_format(output, 1));
    return !options->numbered || output_numbered(output, 0, first, sizeof first, message);
}

/* Names every format that the program writes, or the one that was probably meant. */
static bool unknown_format(const char *path, const char *format, const Usage *usage,
                           Message *message)
{
    enum { MAX = 64 };
    const char *names[MAX + 3];
    const int pictures = image_format_names(names, MAX);
    int count = pictures + animation_format_names(names + pictures, MAX - pictures);
    const int drawings = count;
    for (int i = 0; i < 2 && draws_vectors(usage); i++)
        names[count++] = VECTORS[i];
    names[count] = NULL;
    const char *nearest = text_nearest(format, names);
    message_set(message, "%s: unknown picture format .%s; ", path, format);
    if (nearest)
        return message_add(message, "did you mean .%s?", nearest);
    for (int i = 0; i < count; i++)
        message_add(message, "%s.%s",
                    i == 0          ? "pictures: "
                    : i == pictures ? "; animations: "
                    : i == drawings ? "; drawings: "
                                    : ", ",
                    names[i]);
    return false;
}

static bool find_format(const char *path, const Usage *usage, char format[16], Message *message)
{
    format[0] = '\0';
    return image_format(path, format, NULL) ||
           (format[0] ? unknown_format(path, format, usage, message)
                      : image_format(path, format, message));
}

static bool check_file(Options *options, const Usage *usage, Message *message)
{
    char format[16];
    const char *output = options->output;
    if (options->format)
        return message_set(message,
                           "--format %s: applies to standard output, -o -; the extension names the "
                           "format of a file",
                           options->format);
    if (output[strlen(output) - 1] == '/')
        return message_set(message, "%s: is a folder; name a file in it", output);
    if (!find_animation(options, message))
        return false;
    if (draws_vectors(usage))
        options->vector = usage->kind->vector_format(output);
    if (options->animation || options->vector)
        return true;
    return find_format(output, usage, format, message) &&
           (!options->alpha || image_format_has_alpha(format) ||
            message_set(message, "%s: .%s has no alpha channel; leave out --alpha, or name a .png",
                        output, format));
}

/* Parts are of several pictures in files. */
static bool check_parts(const Options *options, Message *message)
{
    const bool films = options->frames > 1 && strcmp(options->output, "-") != 0 &&
                       !options->watch && !options_in_window(options);
    if (options->part.count && !films)
        return message_set(message,
                           "--part %d/%d: is one of several pictures that go to files; give "
                           "--frames and a file, as in -n 90 -o turn.gif",
                           options->part.number, options->part.count);
    return !options->merge || (films && options->animation) ||
           message_set(message, "--merge: puts an animation together; give the command of its "
                                "parts, as in -n 90 -o turn.gif");
}

/* Any other name would be read as another format. */
static bool check_saved(const char *path, Message *message)
{
    const char *dot = path ? strrchr(path, '.') : NULL;
    return !dot || strchr(dot, '/') || strcasecmp(dot, ".gltf") == 0 ||
           message_set(message, "--save-scene %s: a scene is written as text; name a .gltf", path);
}

bool options_check(Options *options, const Usage *usage, Message *message)
{
    const bool window = options_in_window(options), stream = strcmp(options->output, "-") == 0;
    const char *silent = options->explain ? "--explain" : "--print-shader";
    if (usage->operand && !*usage->operand && !options->doctor)
        return message_set(message, "no file is named; %s %s -o PICTURE.png", usage->name,
                           usage->names);
    if (!usage->gallery && (!usage->names || usage->operand) && options->names[0])
        return message_set(message, "%s: not an option; --help lists them, -o %s",
                           options->names[0],
                           usage->study ? "DIR names the folder" : "FILE names the picture");
    if (options->part.count && options->merge)
        return message_set(message, "--part and --merge: one of them");
    if (!check_saved(options->save_scene, message))
        return false;
    if (options->doctor)
        return true;
    if (options->shaders.print || options->explain)
        return !options->watch ||
               message_set(message, "--watch and %s: one of them; %s draws nothing", silent,
                           silent);
    if (usage->gallery || usage->study)
        return !stream || message_set(message, "--output -: a %s is a folder, not one picture",
                                      usage->gallery ? "gallery" : "study");
    if (window && options->numbered)
        return message_set(message,
                           "--frames: a window's animation has no end; leave out --window to "
                           "draw pictures to files");
    if (window && stream)
        return message_set(message,
                           "--output -: in a window each press of s saves a picture; name a "
                           "file");
    if (options->format && strcmp(options->format, "json") == 0 && !options->probe.asked)
        return message_set(message, "--format json: is of --probe");
    if (options->probe.asked &&
        (options->probe.column >= options->width || options->probe.row >= options->height))
        return message_set(message, "--probe %d,%d: the picture has %dx%d pixels, counted from 0,0",
                           options->probe.column, options->probe.row, options->width,
                           options->height);
    if (options->probe.asked)
        return !options->show || message_set(message, "--probe and --show: one of them");
    const char *one = options->show ? "show" : "arithmetic";
    const char *of = options->show ? options->show : options->arithmetic;
    if (of && (window || options->numbered || options->watch))
        return message_set(message,
                           "--%s %s: makes one picture; leave out --frames, --window "
                           "and --watch",
                           one, of);
    if (!(stream ? check_stream(options, message) : check_file(options, usage, message)) ||
        !check_parts(options, message))
        return false;
    if (of && options->animation)
        return message_set(message, "--%s %s: makes one picture; name a .png", one, of);
    const AnimationOptions animation = {.format = options->animation,
                                        .width = options->width,
                                        .height = options->height,
                                        .fps = options->fps,
                                        .alpha = options->alpha};
    return !options->animation || animation_check(&animation, message);
}
