#include "app/options.h"

#include "app/arguments.h"
#include "base/output.h"
#include "base/process.h"
#include "base/text.h"
#include "base/version.h"
#include "images/animation.h"
#include "images/drawing.h"
#include "scene/scene_example.h"
#include "window/backends.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Options whose value is not of a ParameterKind. */

static bool read_size(const Parameter *parameter, const char *text, Message *message)
{
    Options *options = parameter->value;
    return parse_size(text, &options->width, &options->height) ||
           message_set(message, "--size %s: must be WIDTHxHEIGHT, each 1 to %d, as in 400x400",
                       text, PARSE_SIZE_MAX);
}

static bool write_size(const Parameter *parameter, char *text, size_t size)
{
    const Options *options = parameter->value;
    return snprintf(text, size, "%dx%d", options->width, options->height) < (int)size;
}

static bool read_angle(const Parameter *parameter, const char *text, Message *message)
{
    double *seconds = parameter->value;
    if (!parse_number(text, -3e10, 3e10, seconds))
        return message_set(message, "--angle %s: must be degrees, -30 billion to 30 billion", text);
    *seconds /= DEGREES_PER_SECOND;
    return true;
}

static bool read_orbit(const Parameter *parameter, const char *text, Message *message)
{
    static const double min[] = {-36000, -90, 0.01}, max[] = {36000, 90, 100};
    double values[3] = {0, 0, 1};
    if (parse_numbers(text, min, max, values) < 2)
        return message_set(message,
                           "--orbit %s: must be AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,DISTANCE: "
                           "degrees, -90 to 90 for the elevation, and a factor of 0.01 to 100",
                           text);
    *(Orbit *)parameter->value = (Orbit){values[0], values[1], values[2]};
    return true;
}

static bool write_orbit(const Parameter *parameter, char *text, size_t size)
{
    return size >= 96 && orbit_text(*(const Orbit *)parameter->value, text);
}

static bool read_backend(const Parameter *parameter, const char *text, Message *message)
{
    const CanvasBackend **backend = parameter->value;
    Message why = {0};
    *backend = backend_find(text, &why);
    return *backend || message_set(message, "--backend %s", why.text);
}

static bool write_backend(const Parameter *parameter, char *text, size_t size)
{
    const CanvasBackend *given = *(const CanvasBackend *const *)parameter->value;
    const CanvasBackend *backend = given ? given : backend_default(NULL);
    return backend && snprintf(text, size, "%s", backend->name) < (int)size;
}

bool options_read_part(const Parameter *parameter, const char *text, Message *message)
{
    return parse_part(text, parameter->value) ||
           message_set(message, "--part %s: must be I/N, 1/N to N/N, as in 3/8", text);
}

static bool read_window(const Parameter *parameter, const char *text, Message *message)
{
    (void)text;
    return read_backend(parameter, "window", message);
}

static bool read_print(const Parameter *parameter, const char *text, Message *message)
{
    int *print = parameter->value;
    *print = !text                       ? SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT
             : strcmp(text, "vert") == 0 ? SHADER_PRINT_VERTEX
             : strcmp(text, "frag") == 0 ? SHADER_PRINT_FRAGMENT
                                         : 0;
    return *print ||
           message_set(message, "--print-shader %s: must be vert or frag, or nothing for both",
                       text);
}

const char *const OPTIONS_TERM_NAMES[4] = {"ambient", "diffuse", "specular", "emission"};

static bool unknown_term(const char *text, const char *word, Message *message)
{
    const char *names[5] = {NULL};
    for (int k = 0; k < 4; k++)
        names[k] = OPTIONS_TERM_NAMES[k];
    const char *nearest = text_nearest(word, names);
    message_set(message, "--terms %s: ", text);
    return nearest
               ? message_add(message, "%s: did you mean %s?", word, nearest)
               : message_add(message, "must be some of ambient, diffuse, specular and emission, "
                                      "and numbers of lights, 0 to 31, between commas");
}

/* The terms by name and the lights by number; all terms, or lights, if none is named. */
static bool read_terms(const Parameter *parameter, const char *text, Message *message)
{
    SceneTerms *terms = parameter->value;
    unsigned named = 0;
    uint32_t lights = 0;
    const char *word = text;
    for (size_t length = 1; length > 0; word += length + (word[length] == ',')) {
        char copy[16];
        int k = 0, light;
        length = strcspn(word, ",");
        snprintf(copy, sizeof copy, "%.*s", (int)length, word);
        while (k < 4 && strcmp(copy, OPTIONS_TERM_NAMES[k]) != 0)
            k++;
        const bool whole = length < sizeof copy;
        if (whole && k < 4)
            named |= 1U << k;
        else if (whole && parse_whole(copy, 0, 31, &light))
            lights |= (uint32_t)1 << light;
        else
            return unknown_term(text, whole && length ? copy : "", message);
        if (!word[length])
            break;
    }
    terms->left_out = named ? TERM_ALL & ~named : 0;
    terms->lights_left_out = lights ? ~lights : 0;
    return true;
}

static bool write_terms(const Parameter *parameter, char *text, size_t size)
{
    const SceneTerms *terms = parameter->value;
    size_t length = 0;
    for (int k = 0; k < 4 && length < size; k++)
        if (!(terms->left_out >> k & 1))
            length += (size_t)snprintf(text + length, size - length, "%s%s", length ? "," : "",
                                       OPTIONS_TERM_NAMES[k]);
    for (int k = 0; k < 32 && terms->lights_left_out && length < size; k++)
        if (!(terms->lights_left_out >> k & 1))
            length += (size_t)snprintf(text + length, size - length, ",%d", k);
    return length < size;
}

/* LIGHT,X,Y,Z for each light, between slashes. */
static bool read_places(const Parameter *parameter, const char *text, Message *message)
{
    static const double min[] = {-1e6, -1e6, -1e6}, max[] = {1e6, 1e6, 1e6};
    LightPlaces places = {.placed = 0};
    for (const char *word = text; word; word = strchr(word, '/') ? strchr(word, '/') + 1 : NULL) {
        char copy[128], *comma;
        double at[3];
        int light;
        snprintf(copy, sizeof copy, "%.*s", (int)strcspn(word, "/"), word);
        comma = strchr(copy, ',');
        if (comma)
            *comma = '\0';
        if (!comma || !parse_whole(copy, 0, SCENE_MAX_PLACED - 1, &light) ||
            parse_numbers(comma + 1, min, max, at) != 3)
            return message_set(message,
                               "--light-at %s: must be LIGHT,X,Y,Z, with LIGHT from 0 to %d, as in "
                               "0,1,2,-3.5; a / begins another light",
                               text, SCENE_MAX_PLACED - 1);
        places.placed |= 1U << light;
        places.at[light] = (Vec3){at[0], at[1], at[2]};
    }
    *(LightPlaces *)parameter->value = places;
    return true;
}

static bool write_places(const Parameter *parameter, char *text, size_t size)
{
    const LightPlaces *places = parameter->value;
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; i < SCENE_MAX_PLACED && length < size; i++) {
        char x[32], y[32], z[32];
        if (!(places->placed >> i & 1))
            continue;
        parse_number_text(places->at[i].x, x);
        parse_number_text(places->at[i].y, y);
        parse_number_text(places->at[i].z, z);
        length += (size_t)snprintf(text + length, size - length, "%s%d,%s,%s,%s", length ? "/" : "",
                                   i, x, y, z);
    }
    return places->placed && length < size;
}

/* LIGHT,R,G,B or LIGHT,R,G,B,R,G,B for each light, between slashes. */
static bool read_tint(const char *text, LightTints *tints)
{
    static const double LARGEST = 10;
    char copy[256], *place = NULL;
    double values[6];
    int light, count = 0;
    if (snprintf(copy, sizeof copy, "%s", text) >= (int)sizeof copy || strstr(text, ",,") ||
        text[0] == ',' || (text[0] && text[strlen(text) - 1] == ','))
        return false;
    const char *word = strtok_r(copy, ",", &place);
    if (!word || !parse_whole(word, 0, SCENE_MAX_PLACED - 1, &light))
        return false;
    while ((word = strtok_r(NULL, ",", &place)) && count < 6)
        if (!parse_number(word, 0, LARGEST, &values[count++]))
            return false;
    if (word || (count != 3 && count != 6))
        return false;
    const double *specular = values + count - 3;
    tints->tinted |= 1U << light;
    tints->diffuse[light] = (Vec3){values[0], values[1], values[2]};
    tints->specular[light] = (Vec3){specular[0], specular[1], specular[2]};
    return true;
}

static bool read_tints(const Parameter *parameter, const char *text, Message *message)
{
    LightTints tints = {.tinted = 0};
    for (const char *word = text; word; word = strchr(word, '/') ? strchr(word, '/') + 1 : NULL) {
        char copy[256];
        snprintf(copy, sizeof copy, "%.*s", (int)strcspn(word, "/"), word);
        if (!read_tint(copy, &tints))
            return message_set(message,
                               "--light-color %s: must be LIGHT,R,G,B, with LIGHT from 0 to %d "
                               "and R, G and B from 0 to 10, as in 0,1,0.5,0; three more numbers "
                               "are the specular colour, and a / begins another light",
                               text, SCENE_MAX_PLACED - 1);
    }
    *(LightTints *)parameter->value = tints;
    return true;
}

static size_t put_color(char *text, size_t size, Vec3 color)
{
    char r[32], g[32], b[32];
    parse_number_text(color.x, r);
    parse_number_text(color.y, g);
    parse_number_text(color.z, b);
    return (size_t)snprintf(text, size, ",%s,%s,%s", r, g, b);
}

static bool write_tints(const Parameter *parameter, char *text, size_t size)
{
    const LightTints *tints = parameter->value;
    size_t length = 0;
    text[0] = '\0';
    for (int i = 0; i < SCENE_MAX_PLACED && length < size; i++) {
        const Vec3 *diffuse = &tints->diffuse[i], *specular = &tints->specular[i];
        if (!(tints->tinted >> i & 1))
            continue;
        length += (size_t)snprintf(text + length, size - length, "%s%d", length ? "/" : "", i);
        if (length < size)
            length += put_color(text + length, size - length, *diffuse);
        if (length < size && memcmp(diffuse, specular, sizeof *diffuse) != 0)
            length += put_color(text + length, size - length, *specular);
    }
    return tints->tinted && length < size;
}

/* A way, and the size of maps. */
static bool read_shadows(const Parameter *parameter, const char *text, Message *message)
{
    ShadowSettings *settings = parameter->value;
    Parameter way = *parameter;
    way.read = NULL;
    if (strncmp(text, "map:", 4) != 0)
        return parameter_read(&way, text, message);
    settings->way = SHADOWS_MAP;
    return parse_whole(text + 4, SHADOW_MAP_MIN, SHADOW_MAP_MAX, &settings->map_size) ||
           message_set(message, "--shadows %s: a map has %d to %d texels each way, as in map:512",
                       text, SHADOW_MAP_MIN, SHADOW_MAP_MAX);
}

static bool write_shadows(const Parameter *parameter, char *text, size_t size)
{
    const ShadowSettings *settings = parameter->value;
    if (settings->way == SHADOWS_MAP && settings->map_size != SHADOWS_DEFAULT.map_size)
        return snprintf(text, size, "map:%d", settings->map_size) < (int)size;
    return snprintf(text, size, "%s", SHADOW_NAMES[settings->way]) < (int)size;
}

static bool read_bias(const Parameter *parameter, const char *text, Message *message)
{
    enum { MAX = 1000 };
    static const double min[] = {0, 0, 0}, max[] = {MAX, MAX, MAX};
    double values[3];
    if (parse_numbers(text, min, max, values) != 3)
        return message_set(message,
                           "--shadow-bias %s: must be CONSTANT,SLOPE,NORMAL in texels of a map, "
                           "each 0 to %d",
                           text, MAX);
    *(Vec3 *)parameter->value = (Vec3){values[0], values[1], values[2]};
    return true;
}

static bool write_bias(const Parameter *parameter, char *text, size_t size)
{
    const Vec3 *bias = parameter->value;
    char x[32], y[32], z[32];
    parse_number_text(bias->x, x);
    parse_number_text(bias->y, y);
    parse_number_text(bias->z, z);
    return snprintf(text, size, "%s,%s,%s", x, y, z) < (int)size;
}

/* A diagram is painted by cairo. */
static bool read_refused_diagram(const Parameter *parameter, const char *text, Message *message)
{
    (void)text;
    return message_set(message,
                       "--%s: a diagram is drawn without OpenGL: it has no camera, no shaders and "
                       "no samples, and its edges are smooth already",
                       parameter->name);
}

/* A gallery draws every program once. */
static bool read_refused(const Parameter *parameter, const char *text, Message *message)
{
    (void)text;
    return message_set(message, "--%s: a gallery has one picture of each program", parameter->name);
}

/* Which programs have an option. */
enum {
    ONE = 1, /* draws one example */
    GALLERY = 2,
    STUDY = 4,
    SCENE = 8,    /* draws one example that is a scene */
    REFUSED = 16, /* by a gallery, with a message */
    ASIDE = 32,   /* does not change the picture or its destination, or as another option does */
    DIAGRAM = 64, /* draws one example that is a diagram; others of ONE are refused */
    GL_FILM = ONE | REFUSED,
    FILM = GL_FILM | DIAGRAM,
    GL_DRAWS = ONE | GALLERY,
    DRAWS = GL_DRAWS | DIAGRAM,
    GL_ALL = GL_DRAWS | STUDY,
    ALL = GL_ALL | DIAGRAM,
};

#define FLAG(field) PARAMETER_FLAG, .value = &options->field
#define TEXT(field) PARAMETER_TEXT, .value = &options->field

int options_table(const Usage *usage, Options *options, OptionsPurpose purpose,
                  Parameter table[OPTIONS_MAX])
{
    static const char *const FORMATS[] = {"png", "y4m", "rgb", NULL};
    static const char *const DIAGRAM_FORMATS[] = {"png", "y4m", "rgb", "svg", "pdf", NULL};
    static const char *const BACKEND_NAMES[] = {"egl", "osmesa", "window", NULL};
    static const char *const PRECISIONS[] = {"highp", "mediump", NULL};
    static const char *const STAGES[] = {"vert", "frag", NULL};
    static const char *const LIGHTING[] = {"off", "on", NULL};
    static const char *const CLAMPS[] = {"vertex", "end", NULL};
    static const char *const FORMS[] = {"man", "bash", "zsh", "fish", NULL};
    const bool folder = usage->gallery || usage->study;
    const char *output =
        usage->gallery   ? "the folder for the pictures, the contact sheet and index.html; created "
                           "if missing"
        : usage->study   ? "the folder for the results; created if missing"
        : usage->diagram ? "the picture; the extension names the format (.svg, .pdf, .png, .tif, "
                           ".jpg, .webp, .mp4...); - writes to standard output"
                         : "the picture; the extension names the format (.png, .exr, .tif, .jpg, "
                           ".webp, .mp4...); - writes to standard output";
    const Parameter rows[] = {
        {"output", output, TEXT(output), .min = 1, .letter = 'o',
         .placeholder = folder ? "DIR" : "FILE", .standard = options->default_output,
         .given = &options->output_given, .programs = ALL},
        {"size", "in pixels", PARAMETER_TEXT, options, .letter = 's', .placeholder = "WxH",
         .given = &options->size_given, .read = read_size, .write = write_size, .programs = ALL},
        {"time", "the time to draw", PARAMETER_NUMBER, &options->seconds, -OPTIONS_MAX_SECONDS,
         OPTIONS_MAX_SECONDS, .letter = 't', .placeholder = "SECONDS", .programs = DRAWS},
        {"angle", "the time at which an animation of 30 degrees per second reaches this angle",
         TEXT(seconds), .letter = 'a', .placeholder = "DEG", .standard = "", .read = read_angle,
         .programs = DRAWS | ASIDE},
        {"frames",
         "N pictures from --time on: all in one file if that is an animation (.gif, .webp, .apng, "
         ".mp4, .webm); otherwise one file each, with a number in its name, as in "
         "-o turn%03d.png",
         PARAMETER_WHOLE, &options->frames, 1, FRAMES_MAX, .letter = 'n', .placeholder = "N",
         .given = &options->numbered, .programs = FILM},
        {"fps", "pictures per second", PARAMETER_NUMBER, &options->fps, 1e-3, 1e6,
         .placeholder = "F", .programs = FILM},
        {"part",
         usage->gallery
             ? "draw only the I-th of N parts, for several processes or machines that share DIR"
             : "draw only the I-th of N parts of --frames, for several processes or machines. Those "
               "of an animation go to the folder FILE.parts as PNG",
         TEXT(part), .placeholder = "I/N", .standard = "", .read = options_read_part,
         .programs = FILM | GALLERY | ASIDE},
        {"merge",
         usage->gallery ? "draw nothing: write what is missing when all parts are drawn, the "
                          "contact sheet and index.html"
                        : "draw nothing: put the animation together when all parts are drawn",
         FLAG(merge), .programs = FILM | GALLERY | ASIDE},
        {"format",
         "what -o - writes: one PNG (default); all pictures as YUV4MPEG2 video (y4m); or their raw "
         "bytes: red, green, blue (rgb)",
         TEXT(format), .choices = usage->diagram ? DIAGRAM_FORMATS : FORMATS, .programs = FILM},
        {"samples", "multisampling with N samples per pixel", PARAMETER_WHOLE,
         &options->canvas.samples, 0, INT_MAX, .placeholder = "N",
         .standard = usage->gallery ? "4" : "0 (off)", .programs = GL_DRAWS},
        {"orbit",
         "move the camera about its target: degrees to the right and up, and a factor for the "
         "distance",
         TEXT(orbit), .placeholder = "AZIMUTH,ELEVATION[,DISTANCE]", .read = read_orbit,
         .write = write_orbit, .programs = GL_DRAWS},
        {"window", "run in a window; h lists the keys", FLAG(canvas.backend), .letter = 'w',
         .read = read_window, .programs = FILM | ASIDE},
        {"watch", "draw again whenever a shader file changes, until Ctrl-C", FLAG(watch),
         .programs = GL_FILM | ASIDE},
        {"backend",
         "what draws; egl and osmesa need no display; also LIGHTING_BACKEND in the environment",
         TEXT(canvas.backend), .choices = BACKEND_NAMES, .letter = 'b', .standard = "egl",
         .read = read_backend, .write = write_backend, .programs = GL_ALL},
        {"shaders",
         "look for shader files here first, for example your own copies; also LIGHTING_SHADERS in "
         "the environment",
         TEXT(shaders.folder), .min = 1, .placeholder = "DIR", .programs = GL_ALL},
        {"precision", "of fragment shaders", TEXT(shaders.precision), .choices = PRECISIONS,
         .standard = "as the shader says", .programs = GL_DRAWS},
        {"print-shader", "print the source that the driver gets; draw nothing", FLAG(shaders.print),
         .choices = STAGES, .read = read_print, .programs = GL_DRAWS | ASIDE},
        {"deterministic",
         "use no more of an x86 processor than SSE4.1 and vectors of 128 bits, in Mesa and in the C "
         "library, so that different processors give the same bytes",
         FLAG(deterministic), .programs = ALL},
        {"alpha", "keep the alpha channel: the background is transparent", FLAG(alpha),
         .programs = DRAWS},
        {"compress", "of PNG files: 0 is none, 9 is smallest", PARAMETER_WHOLE, &options->compress,
         0, 9, .standard = "fast", .programs = DRAWS},
        {"explain",
         "report the scene's lights and their numbers, the effects that it needs and those that it "
         "does not, why, and what they cost; draw nothing. Of several objects only what differs; "
         "with --verbose everything",
         FLAG(explain), .programs = SCENE | ASIDE},
        {"full", "draw with the program that has every effect", FLAG(full), .programs = SCENE},
        {"error",
         "draw as cheaply as an error of E steps of 1/255 allows; options that are given stay. The "
         "error is against the exact picture of the shapes (solids) or of the mesh as given "
         "(models), the largest over the pixels inside an object: wholly inside one surface, "
         "covered by what is drawn, and reached by the same lights; edges, also those of shadows, "
         "do not count",
         PARAMETER_NUMBER, &options->error, 0, 255, .placeholder = "E", .standard = "",
         .given = &options->cheap, .programs = SCENE},
        {"clamp", "where colours are clamped: at each vertex, as in OpenGL 1.1, or at the end",
         PARAMETER_SWITCH, &options->clamp_vertex, .choices = CLAMPS, .programs = SCENE},
        {"linear-light", "compute in linear light; encode as sRGB at the end", FLAG(linear),
         .programs = SCENE},
        {"terms",
         "draw only these terms of the sum: ambient, diffuse, specular, emission; and only these "
         "lights, which --explain lists, as in diffuse,specular,0",
         TEXT(terms), .placeholder = "TERM,...", .standard = "all", .read = read_terms,
         .write = write_terms, .programs = SCENE},
        {"light-at",
         "put a light there: a position, or the direction towards a directional light; --explain "
         "lists the lights; more of them after slashes, as in 0,1,2,0/1,-1,2,0",
         TEXT(places), .placeholder = "LIGHT,X,Y,Z", .standard = "", .read = read_places,
         .write = write_places, .programs = SCENE},
        {"light-color",
         "another colour of a light, diffuse and specular; or a colour for each; --explain lists the "
         "lights; more of them after slashes, as in 0,1,0.5,0/1,0,0,1,1,1,1",
         TEXT(tints), .placeholder = "LIGHT,R,G,B[,R,G,B]", .standard = "", .read = read_tints,
         .write = write_tints, .programs = SCENE},
        {"shadows",
         "whether surfaces keep the light from others, and how that is found: volumes are exact, to "
         "the pixel; so is planar, on what is flat, else volumes; map, or map:N, is a shadow map of "
         "NxN (1024); on: planar or volumes",
         PARAMETER_CHOICE, &options->shadows, .choices = SHADOW_NAMES, .read = read_shadows,
         .write = write_shadows, .programs = SCENE},
        {"shadow-bias",
         "against acne in shadow maps, in texels: how far a place is moved towards the light; that "
         "times the slope; and along the normal",
         TEXT(shadows.bias), .placeholder = "CONSTANT,SLOPE,NORMAL", .read = read_bias,
         .write = write_bias, .programs = SCENE},
        {"shadow-filter", "compare a shadow map's nearest texel, or the four around, weighted",
         PARAMETER_CHOICE, &options->shadows.smooth, .choices = SHADOW_FILTER_NAMES,
         .programs = SCENE},
        {"lighting", "off: each surface in its own diffuse colour", PARAMETER_SWITCH,
         &options->terms.unlit, .choices = LIGHTING, .programs = SCENE},
        {"show-clipped", "paint over-exposed pixels magenta", FLAG(show_clipped),
         .programs = SCENE},
        {"verbose", "report what runs where and how long it takes", FLAG(verbose), .letter = 'v',
         .programs = ALL | ASIDE},
        {"doctor", "report what this machine can draw with, and what to install", FLAG(doctor),
         .programs = ALL | ASIDE},
        {"generate", "print the man page, or the completion for a shell", TEXT(generate),
         .choices = FORMS, .programs = ALL | ASIDE},
        {"help", "print this text", PARAMETER_FLAG, .letter = 'h', .programs = ALL | ASIDE},
        {"version", "print the version", PARAMETER_FLAG, .value = NULL, .programs = ALL | ASIDE},
    };
    const int program = usage->gallery   ? GALLERY
                        : usage->study   ? STUDY
                        : usage->diagram ? DIAGRAM
                                         : ONE | (usage->scene ? SCENE : 0);
    int count = 0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const int has = rows[i].programs;
        const bool refused = purpose == OPTIONS_TO_READ && !(has & program) &&
                             ((usage->gallery && has & REFUSED) || (usage->diagram && has & ONE));
        if (!refused && (!(has & program) || (has & ASIDE && purpose == OPTIONS_TO_WRITE)))
            continue;
        table[count] = rows[i];
        if (refused)
            table[count].read = usage->diagram ? read_refused_diagram : read_refused;
        count++;
    }
    const int common = count;
    const Parameter *own = usage->parameters;
    for (int i = 0; own && own[i].name && i < OPTIONS_MAX_PARAMETERS; i++, count++) {
        table[count] = own[i];
        /* What is named stays with --error, even if it is the default. */
        if (!own[i].given && (purpose == OPTIONS_TO_READ || options->cheap))
            table[count].given = &options->own_given[i];
    }
    table[count].name = NULL;
    return common;
}

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
    return (Usage){.name = example->name,
                   .summary = example->summary,
                   .scene = example->scene != NULL,
                   .shadows = example->scene && example->scene->shadows,
                   .diagram = example->diagram != NULL,
                   .width = example->width,
                   .height = example->height,
                   .seconds = example->page ? example->page->seconds : 0,
                   .resize = example->scene ? example->scene->size : NULL,
                   .tries = example->tries,
                   .looks = example->looks,
                   .parameters = example_parameters(example)};
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
    options.shadows = SHADOWS_DEFAULT;
    options.shadows.way = usage->shadows ? SHADOWS_ON : SHADOWS_OFF;
    snprintf(options.default_output, sizeof options.default_output, "%s%s", usage->name,
             usage->gallery || usage->study ? "" : ".png");
    return options;
}

/* Standard output: one picture, or a stream of them. */
static bool check_stream(Options *options, Message *message)
{
    options->numbered = false;
    if (options->watch)
        return message_set(message, "--output -: standard output takes one picture, and --watch "
                                    "draws many; name a file");
    const char *format = options->format;
    if (format && (strcmp(format, "svg") == 0 || strcmp(format, "pdf") == 0))
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
static bool unknown_format(const char *path, const char *format, bool diagram, Message *message)
{
    enum { MAX = 64 };
    const char *names[MAX + 3];
    const int pictures = image_format_names(names, MAX);
    int count = pictures + animation_format_names(names + pictures, MAX - pictures);
    const int drawings = count;
    if (diagram) {
        names[count++] = "svg";
        names[count++] = "pdf";
    }
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

static bool find_format(const char *path, bool diagram, char format[16], Message *message)
{
    format[0] = '\0';
    return image_format(path, format, NULL) ||
           (format[0] ? unknown_format(path, format, diagram, message)
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
    if (usage->diagram)
        options->vector = drawing_format(output);
    if (options->animation || options->vector)
        return true;
    return find_format(output, usage->diagram, format, message) &&
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

/* Checks that need neither driver nor files. */
static bool check(Options *options, const Usage *usage, Message *message)
{
    const bool window = options_in_window(options), stream = strcmp(options->output, "-") == 0;
    const char *silent = options->explain ? "--explain" : "--print-shader";
    if (!usage->gallery && !usage->names && options->names[0])
        return message_set(message, "%s: not an option; --help lists them, -o %s",
                           options->names[0],
                           usage->study ? "DIR names the folder" : "FILE names the picture");
    if (options->part.count && options->merge)
        return message_set(message, "--part and --merge: one of them");
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
    if (!(stream ? check_stream(options, message) : check_file(options, usage, message)) ||
        !check_parts(options, message))
        return false;
    const AnimationOptions animation = {.format = options->animation,
                                        .width = options->width,
                                        .height = options->height,
                                        .fps = options->fps,
                                        .alpha = options->alpha};
    return !options->animation || animation_check(&animation, message);
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
    if (options_in_window(options)) /* by LIGHTING_BACKEND too, which core reads without windows */
        options->canvas.backend = backend_find("window", NULL);
    if (options->frames > 1)
        snprintf(options->default_output, sizeof options->default_output, "%s%%04d.png",
                 usage->name);
    if (!options->output_given)
        options->output = options->default_output;
    return check(options, usage, message) ? OPTIONS_RUN : OPTIONS_BAD;
}

/* Ends the process as the signal alone would, after removing half-written files. */
static void end_by_signal(int number)
{
    const struct sigaction standard = {.sa_handler = SIG_DFL};
    output_unlink_temporaries();
    sigaction(number, &standard, NULL);
    raise(number); /* delivered when this returns */
}

/* Ends quietly when the reader of standard output has left, as in `| head`. Writing to any other
 * pipe fails with EPIPE. */
static void end_without_reader(int number)
{
    struct pollfd output = {.fd = STDOUT_FILENO};
    const int error = errno;
    (void)number;
    if (poll(&output, 1, 0) == 1 && output.revents & (POLLERR | POLLHUP)) {
        output_unlink_temporaries();
        _exit(0);
    }
    errno = error;
}

void options_catch_signals(void (*handler)(int), int flags)
{
    static const int ending[] = {SIGINT, SIGTERM, SIGHUP};
    const struct sigaction action = {.sa_handler = handler, .sa_flags = flags};
    struct sigaction before;
    for (size_t i = 0; i < sizeof ending / sizeof ending[0]; i++)
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(ending[i], &action, NULL);
}

void options_prepare_process(void)
{
    for (int file = 0; file <= 2; file++) {
        /* Read-only also for the outputs, so that writing to a closed stream fails. */
        if (fcntl(file, F_GETFD) < 0 && errno == EBADF)
            (void)!open("/dev/null", O_RDONLY);
    }
    const struct sigaction on_pipe = {.sa_handler = end_without_reader, .sa_flags = SA_RESTART};
    sigaction(SIGPIPE, &on_pipe, NULL);
    signal(SIGXFSZ, SIG_IGN);
    options_catch_signals(end_by_signal, SA_RESTART);
}

/* The beginning, a program's name or a file and line, in colour on a terminal. */
static void print_message(const char *program, const Message *message, int color)
{
    const char *begin = message_color(color, STDERR_FILENO);
    const char *end = message_color(MESSAGE_PLAIN, STDERR_FILENO);
    const char *text = message->text[0] ? message->text : "failed";
    const char *rest = message->located ? strstr(text, ": ") : NULL;
    if (rest)
        fprintf(stderr, "%s%.*s:%s%s\n", begin, (int)(rest - text), text, end, rest + 1);
    else
        fprintf(stderr, "%s%s:%s %s\n", begin, program, end, text);
}

int options_fail(const char *program, const Message *message, int code)
{
    fflush(stdout);
    print_message(program, message, MESSAGE_RED);
    return code;
}

void options_warn(const char *program, const Message *message)
{
    print_message(program, message, MESSAGE_YELLOW);
}

void options_tell(const char *program, const char *format, ...)
{
    va_list arguments;
    if (!isatty(STDERR_FILENO))
        return;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", program);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

int options_finish(const char *program, int code)
{
    Message message = {0};
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        /* An earlier write may have failed, whose errno is lost. */
        message_set(&message, "standard output: cannot write%s%s", errno ? ": " : "",
                    errno ? strerror(errno) : "");
        return options_fail(program, &message, EXIT_FAILED);
    }
    return code;
}

/* What is read when a library is loaded. Mesa's llvmpipe and OSMesa choose instructions by the
 * processor: F16C is what computes mediump in 16 bits. glibc's libm has its own variants of sin,
 * pow and others for processors with FMA, whose results differ in the last bit. */
bool options_restart(char *const *arguments, Message *message)
{
    static const char *const least[] = {"GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",
                                        "LP_NATIVE_VECTOR_WIDTH=128",
                                        "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4", NULL};
    return process_restart(arguments, least, message);
}

bool options_begin(Options *options, const Usage *usage, int argc, char *argv[], int *code)
{
    Message message = {0};
    const size_t size = ((size_t)argc + 1) * sizeof *argv;
    char **given = malloc(size); /* options_read moves the names to the front */
    options_prepare_process();
    if (given)
        memcpy(given, argv, size);
    const OptionsResult result = options_read(options, usage, argc, argv, &message);
    bool run = result == OPTIONS_RUN;
    if (!run) {
        *code = result == OPTIONS_ANSWERED ? options_finish(usage->name, 0)
                                           : options_fail(usage->name, &message, EXIT_USAGE);
    } else if (options->deterministic && !(given && options_restart(given, &message))) {
        *code = options_fail(usage->name, &message, EXIT_FAILED);
        run = false;
    }
    free(given);
    return run;
}
