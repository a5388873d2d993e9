#include "gallery/regression.h"

#include "base/memory.h"
#include "base/output.h"
#include "base/template.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct Regression {
    const char *folder, *output;
    TemplateValues *page;
    Arithmetics found; /* its renderer is "" until the driver is measured */
    Picture before;
    int wrong, moved, same, unknown;
};

bool regression_open(Regression **opened, const char *folder, const char *output, Message *message)
{
    struct stat is, report;
    *opened = NULL;
    if (stat(folder, &is) == 0 && stat(output, &report) == 0 && is.st_ino == report.st_ino &&
        is.st_dev == report.st_dev)
        return message_set(message, "%s: has the earlier pictures; write the report elsewhere",
                           output);
    *opened = memory_new(1, sizeof **opened);
    **opened = (Regression){.folder = folder, .output = output, .page = template_values()};
    return true;
}

bool regression_needs_driver(const Regression *regression)
{
    return !regression->found.renderer[0];
}

bool regression_measure(Regression *regression, const CanvasBackend *backend, Message *message)
{
    Meter meter;
    if (!meter_open(&meter, backend, message))
        return false;
    const bool done = arithmetic_measure(&meter, 1 << 17, &regression->found, message);
    meter_close(&meter);
    return done;
}

void regression_close(Regression *regression)
{
    if (!regression)
        return;
    template_close(regression->page);
    image_close(&regression->before.image);
    free(regression);
}

static bool read_before(Regression *regression, const char *name, Message *message)
{
    Picture *before = &regression->before;
    char file[80];
    before->command[0] = before->driver[0] = '\0';
    snprintf(file, sizeof file, "%s.png", name);
    return output_path(before->path, regression->folder, file, message) &&
           picture_read(before, message);
}

/* Adds the options of a command that another lacks. */
static void add_options(const char *command, const char *other, Message *message)
{
    for (const char *at = strchr(command, ' '); at;) {
        const char *next = strstr(at + 1, " -");
        const int length = next ? (int)(next - at) : (int)strlen(at);
        char *option = memory_format("%.*s ", length, at), *within = memory_format("%s ", other);
        if (!strstr(within, option))
            message_add(message, "%.*s", length, at);
        free(option);
        free(within);
        at = next;
    }
}

bool regression_compare(Regression *regression, const Picture *picture, bool *same,
                        Message *message)
{
    const Image *now = &picture->image, *before = &regression->before.image;
    if (!read_before(regression, picture->title, message))
        return false;
    const bool sized = before->width == now->width && before->height == now->height;
    if (!sized && strcmp(regression->before.command, picture->command) != 0) {
        message_set(message, "%s: is of %dx%d pixels, not %dx%d; draw as it was drawn, with",
                    regression->before.path, before->width, before->height, now->width,
                    now->height);
        add_options(regression->before.command, picture->command, message);
        if (strstr(picture->command, " --samples ") &&
            !strstr(regression->before.command, " --samples ")) /* which it has by itself */
            message_add(message, " --samples 0");
        return false;
    }
    *same = sized &&
            memcmp(before->pixels, now->pixels, image_row_size(now) * (size_t)now->height) == 0;
    regression->same += *same;
    return true;
}

bool regression_has(const Regression *regression, const char *name)
{
    char path[PATH_MAX], file[80];
    snprintf(file, sizeof file, "%s.png", name);
    return output_path(path, regression->folder, file, NULL) && access(path, R_OK) == 0;
}

/* Prints a line of a picture, which is in the report, too. */
__attribute__((format(printf, 3, 4))) static void say(TemplateValues *page, const char *name,
                                                      const char *format, ...)
{
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    printf("%s: %s\n", name, text);
    template_set(template_add(page, "line"), "text", "%s", text);
}

/* Of a driver that is not here nothing was measured. What any may do: numbers of mediump have at
 * least 11 bits (OpenGL ES Shading Language 1.00.17, 4.5.2), positions 4 below a pixel (OpenGL ES
 * 2.0.25, table 6.20), functions the errors that Vulkan allows (Precision and Operation of SPIR-V
 * Instructions, 1.3); nobody limits those of varyings. */
static void widen(Arithmetic *of, bool narrow)
{
    static const struct {
        Function function;
        double units;
    } allowed[] = {{FUNCTION_DIVIDE, 2.5}, {FUNCTION_SQRT, 4.5}, {FUNCTION_INVERSESQRT, 2},
                   {FUNCTION_EXP2, 3},     {FUNCTION_LOG2, 4},   {FUNCTION_SIN, 0x1p12},
                   {FUNCTION_COS, 0x1p12}};
    if (narrow && of->format.bits > 11) {
        of->format.bits = 11;
        of->format.min_exponent = -14;
        of->format.max_exponent = 15;
    }
    for (size_t i = 0; i < sizeof allowed / sizeof allowed[0]; i++) {
        Accuracy *accuracy = &of->accuracies[allowed[i].function];
        const double units = narrow && allowed[i].units > 4 ? 4 : allowed[i].units;
        accuracy->largest = fmax(accuracy->largest, units);
    }
    /* log2(x) is off by 4 units near 1, and the exponent, below 2^(i - 3), multiplies that. */
    for (int i = 0; i < 16; i++) {
        float *error = &of->accuracies[FUNCTION_POW].absolute[i];
        const double allowed_error = format_unit(&of->format) * (4 + 8 * ldexp(1, i - 3));
        *error = fmaxf(*error, (float)fmin(allowed_error, 1));
    }
}

/* Shader files */

static bool shader_path(const char *folder, const ShaderFile *file, char path[PATH_MAX],
                        Message *message)
{
    char name[PATH_MAX];
    const char *slash = strrchr(file->path, '/');
    snprintf(name, sizeof name, "shaders/%s", slash ? slash + 1 : file->path);
    return output_path(path, folder, name, message);
}

bool regression_keep(const char *folder, const ShaderFiles *files, Message *message)
{
    char path[PATH_MAX];
    bool done = !files->count ||
                (output_path(path, folder, "shaders", message) && output_folder(path, message));
    for (int i = 0; i < files->count && done; i++) {
        const ShaderFile *file = &files->files[i];
        done = !file->text || (shader_path(folder, file, path, message) &&
                               output_write(path, file->text, file->size, message));
    }
    return done;
}

/* Lines of shader files that have changed, as places, "LightedCube.vert:15", and NULL. */
typedef struct Changed {
    char **places;
    int count, room;
    char first[PLACE_TEXT]; /* line */
} Changed;

static void add_place(Changed *changed, const char *name, int number, const char *line)
{
    if (!changed->count)
        snprintf(changed->first, sizeof changed->first, "%.*s", (int)strcspn(line, "\n"), line);
    *(char **)memory_add(&changed->places, &changed->count, &changed->room, sizeof(char *)) =
        memory_format("%s:%d", name, number);
}

static bool has_line(const char *text, const char *line, size_t length)
{
    for (const char *at = text; at; at = strchr(at, '\n')) {
        at += *at == '\n';
        if (strncmp(at, line, length) == 0 && (at[length] == '\n' || !at[length]))
            return true;
    }
    return false;
}

/* The lines that a text had not; if lines are only gone, that after them. */
static void add_lines(Changed *changed, const char *name, const char *before, const char *now)
{
    const int known = changed->count;
    int number = 1, first = 0;
    const char *begin = now;
    for (const char *line = now; *line; number++) {
        const size_t length = strcspn(line, "\n");
        if (!has_line(before, line, length))
            add_place(changed, name, number, line);
        if (!first && (size_t)(line - now) + length <= strlen(before) &&
            memcmp(before, now, (size_t)(line - now) + length) != 0) {
            first = number;
            begin = line;
        }
        line += length + (line[length] == '\n');
    }
    if (changed->count == known)
        add_place(changed, name, first, begin);
}

/* Those of the files that were read, and says which files they are of. */
static void find_changed(const Regression *regression, const RegressionPicture *of,
                         Changed *changed, TemplateValues *page)
{
    char path[PATH_MAX];
    for (int i = 0; i < of->files.count; i++) {
        const ShaderFile *file = &of->files.files[i];
        ImageFile before = {.bytes = NULL};
        if (file->text && shader_path(regression->folder, file, path, NULL) &&
            image_file_read(&before, path, NULL)) {
            char *text = memory_new(before.size + 1, 1);
            memcpy(text, before.bytes, before.size);
            const char *name = strrchr(path, '/') + 1;
            if (strcmp(text, file->text) != 0) {
                say(page, of->now->title, "%s has changed", name);
                add_lines(changed, name, text, file->text);
            }
            free(text);
        }
        image_file_close(&before);
    }
    *(char **)memory_add(&changed->places, &changed->count, &changed->room, sizeof(char *)) = NULL;
}

static const char *path_of(const Regression *regression, const char *name, const char *what,
                           char path[PATH_MAX])
{
    snprintf(path, PATH_MAX, "%s/%s-%s.png", regression->output, name, what);
    return path;
}

/* The picture of now, faint, and in it what has moved. */
static bool write_difference(const Image *now, const Moved *moved, const char *path,
                             Message *message)
{
    static const unsigned char colors[MOVED_KINDS][3] = {[MOVED_ROUNDING] = {90, 160, 255},
                                                         [MOVED_EDGE] = {255, 200, 0},
                                                         [MOVED_WRONG] = {255, 0, 80},
                                                         [MOVED_UNKNOWN] = {180, 180, 180}};
    Image image = {.width = 0};
    if (!image_open(&image, now->width, now->height, IMAGE_BYTE, message))
        return false;
    for (size_t i = 0; i < (size_t)now->width * (size_t)now->height; i++) {
        const unsigned char *from = (const unsigned char *)now->pixels + 4 * i;
        unsigned char *to = (unsigned char *)image.pixels + 4 * i;
        for (int k = 0; k < 3; k++)
            to[k] = moved->kinds && moved->kinds[i] ? colors[(int)moved->kinds[i]][k]
                                                    : (unsigned char)(from[k] / 4);
        to[3] = 255;
    }
    const bool done = image_write(&image, path, &(ImageOptions){.compress = 6}, message);
    image_close(&image);
    return done;
}

/* Where the shaders have changed, or, if they have not, what in them looks like the change. */
static void say_cause(const Moved *moved, const Changed *changed, char *text, size_t size)
{
    const Cause *cause = &moved->cause;
    const bool known = changed->count > 1;
    char turn[40] = "";
    if (cause->turns > 1)
        snprintf(turn, sizeof turn, ", turn %d of its loop", cause->turn + 1);
    if (cause->name[0])
        snprintf(text, size, "%s %s%s, in %s: %s", known ? ":" : "; most like the change is",
                 cause->name, turn, cause->place, cause->line);
    else if (known)
        snprintf(text, size, ": %s: %s", changed->places[0], changed->first);
}

static void say_moved(const Moved *moved, const Changed *changed, const char *name,
                      TemplateValues *page)
{
    const int *counts = moved->counts;
    const int all =
        counts[MOVED_ROUNDING] + counts[MOVED_EDGE] + counts[MOVED_WRONG] + counts[MOVED_UNKNOWN];
    const int rounded = all - counts[MOVED_WRONG] - counts[MOVED_UNKNOWN];
    char rest[600] = "all by rounding", edges[64] = "", cause[500] = "";
    if (counts[MOVED_WRONG]) {
        say_cause(moved, changed, cause, sizeof cause);
        snprintf(rest, sizeof rest, "%d cannot be by rounding%s", counts[MOVED_WRONG], cause);
    } else if (counts[MOVED_UNKNOWN]) {
        snprintf(rest, sizeof rest,
                 "%d by rounding; %d are drawn by no shader, and cannot be judged", rounded,
                 counts[MOVED_UNKNOWN]);
    } else if (counts[MOVED_EDGE]) {
        snprintf(rest, sizeof rest, "all by rounding or at edges");
    }
    if (counts[MOVED_EDGE])
        snprintf(edges, sizeof edges, " (%d at edges)", counts[MOVED_EDGE]);
    say(page, name, "%d pixel%s moved%s by up to %.0f step%s: %s", all, all == 1 ? "" : "s", edges,
        moved->most, moved->most > 1 ? "s" : "", rest);
}

static bool judge(Regression *regression, const RegressionPicture *of, Proof *proof,
                  const Changed *changed, Moved *moved, Message *message)
{
    Arithmetics found = regression->found;
    Arithmetic *vertex = &found.of[METER_VERTEX][METER_HIGHP];
    Arithmetic *fragment = &found.of[METER_FRAGMENT][METER_MEDIUMP];
    if (strcmp(regression->before.driver, of->now->driver) != 0) {
        widen(vertex, false);
        widen(fragment, true);
        found.raster.subpixel_bits = 4;
    }
    proof->driver = (ProofDriver){.vertex = vertex, .fragment = fragment, .raster = &found.raster};
    const MovedQuestion question = {
        .proof = proof,
        .before = &regression->before.image,
        .now = &of->now->image,
        .scale = of->canvas->supersample,
        .samples = of->canvas->samples > 1 || of->canvas->supersample > 1,
        .asked = changed->count > 1 ? (const char *const *)changed->places : NULL};
    return proof_of_capture(proof, message) && moved_judge(moved, &question, message);
}

bool regression_judge(Regression *regression, RegressionPicture *of, Message *message)
{
    const Image *before = &regression->before.image;
    const Picture *now = of->now;
    Proof proof = {.capture = of->capture}; /* which closes it */
    Moved moved = {.most = 0};
    Changed changed = {.count = 0};
    Message why = {0};
    TemplateValues *page = template_add(regression->page, "picture");
    of->capture = (Capture){.draw_count = 0};
    template_set(page, "name", "%s", now->title);
    /* Says which options are others than they were: where the shaders are does not count. */
    if (regression->before.command[0] && strcmp(regression->before.command, now->command) != 0)
        say(page, now->title, "its command was %s, and is %s", regression->before.command,
            now->command);
    find_changed(regression, of, &changed, page);
    const bool sized = before->width == now->image.width && before->height == now->image.height;
    bool wrong = !sized, unknown = false;
    if (!sized) {
        say(page, now->title, "%dx%d pixels instead of %dx%d", now->image.width, now->image.height,
            before->width, before->height);
    } else if (judge(regression, of, &proof, &changed, &moved, &why)) {
        say_moved(&moved, &changed, now->title, page);
        wrong = moved.counts[MOVED_WRONG] > 0;
        unknown = !wrong && moved.counts[MOVED_UNKNOWN] > 0;
    } else {
        unknown = true;
        say(page, now->title, "has changed; whether by rounding, cannot be said: %s", why.text);
    }
    if (wrong)
        template_set(page, "wrong", "yes");
    regression->wrong += wrong;
    regression->unknown += unknown;
    regression->moved += !wrong && !unknown;
    char path[PATH_MAX];
    const ImageOptions options = {.compress = 6};
    const bool done =
        output_folder(regression->output, message) &&
        image_write(&regression->before.image, path_of(regression, now->title, "before", path),
                    &options, message) &&
        image_write(&now->image, path_of(regression, now->title, "now", path), &options, message) &&
        write_difference(&now->image, &moved, path_of(regression, now->title, "difference", path),
                         message);
    for (int i = 0; i < changed.count; i++)
        free(changed.places[i]);
    free(changed.places);
    free(moved.kinds);
    proof_close(&proof);
    return done;
}

bool regression_end(Regression *regression, int *code, Message *message)
{
    char path[PATH_MAX], said[200];
    snprintf(said, sizeof said,
             "%d pictures are the same, %d moved by rounding, %d cannot have, %d cannot be judged",
             regression->same, regression->moved, regression->wrong, regression->unknown);
    *code = regression->wrong > 0;
    template_set(regression->page, "said", "%s", said);
    template_set(regression->page, "driver", "%s", regression->found.renderer);
    const int all = regression->same + regression->wrong + regression->moved + regression->unknown;
    if (!all)
        return message_set(message, "%s: has no picture of a program", regression->folder);
    puts(said);
    if (all == regression->same)
        return true;
    const bool done =
        output_path(path, regression->output, "index.html", message) &&
        template_write("examples/gallery/regression.html", regression->page, path, message);
    if (done)
        printf("%s\n", path);
    return done;
}
