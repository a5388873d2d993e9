/*
 * gallery: every example's picture from one process and one context.
 *
 * Also writes index.html with each picture, its summary and its command. Other threads encode a
 * picture while the next is drawn. Several processes draw a part each, and a last one the rest;
 * --verify compares with an earlier gallery.
 */
#include "app/command.h"
#include "app/options.h"
#include "app/picture_texts.h"
#include "app/renderer.h"
#include "base/clock.h"
#include "base/memory.h"
#include "base/output.h"
#include "base/parse.h"
#include "base/progress.h"
#include "base/template.h"
#include "base/text.h"
#include "core/shader_files.h"
#include "web/all_examples.h"
#include "gallery/regression.h"
#include "window/backends.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool with_lecture, keeps_shaders;
static const char *verified; /* the earlier pictures' folder; NULL: none */

static const Parameter parameters[] = {
    {"lecture",
     "the lecture's nine programs, beside those named; without --time its animations are at 1 s",
     PARAMETER_FLAG, .value = &with_lecture},
    {"keep-shaders", "also keep the shader files that were read, in DIR/shaders, for --verify",
     PARAMETER_FLAG, .value = &keeps_shaders},
    {"verify",
     "draw the pictures of a folder of earlier ones again, and say of each pixel that changed "
     "whether rounding can have moved it, and if not, which line of the shaders the change looks "
     "like; a page shows both (without -o in \"changed\"). Exit status 1 if any cannot be",
     PARAMETER_TEXT, .value = &verified, .min = 1, .placeholder = "DIR", .standard = ""},
    {.name = NULL},
};

static const Usage GALLERY = {
    .name = "gallery",
    .summary = "draws all programs, those named, or the lecture's, with an HTML page",
    .gallery = true,
    .parameters = parameters,
};

/* The examples to draw, in the order of ALL. */
typedef struct Selection {
    const Example *examples[COUNT];
    int count;
} Selection;

static bool select_examples(Selection *selection, char *const *names, Message *message)
{
    bool chosen[COUNT] = {false};
    const char *known[COUNT + 1] = {NULL};
    for (int i = 0; i < COUNT; i++)
        known[i] = ALL[i]->name;
    for (char *const *name = names; *name; name++) {
        int found = -1;
        for (int i = 0; i < COUNT && found < 0; i++)
            if (strcmp(*name, known[i]) == 0)
                found = i;
        if (found < 0) {
            const char *nearest = text_nearest(*name, known);
            return message_set(message, "%s: no such program; %s%s%s", *name,
                               nearest ? "did you mean " : "examples/run --list names them",
                               nearest ? nearest : "", nearest ? "?" : "");
        }
        chosen[found] = true;
    }
    for (int i = 0; i < COUNT; i++)
        if ((!*names && !with_lecture) || chosen[i] || (with_lecture && !ALL[i]->kind))
            selection->examples[selection->count++] = ALL[i];
    return true;
}

/* At 0 s one of the lecture's animations looks like the program that it moves. */
static const double MOVED = 1;

static bool is_animation(const Example *example)
{
    const char *mark = strrchr(example->name, '_');
    return !example->kind && mark && strcmp(mark, "_animation") == 0;
}

/* Without --size a picture has the example's own size, and without --time it shows a movement. */
static Options options_of(const Example *example, const Options *options)
{
    Options own = *options;
    const Usage usage = options_usage(example);
    if (!options->size_given)
        options_size(&usage, &own.width, &own.height);
    if (!options->seconds_given && is_animation(example))
        own.seconds = MOVED;
    own.shadows = options_default(&usage).shadows;
    return own;
}

static bool write_page(const char *folder, const Selection *selection, const Options *options,
                       Message *message)
{
    char path[PATH_MAX], command[512]; /* longer than any */
    TemplateValues *page = template_values();
    for (int i = 0; i < selection->count; i++) {
        const Example *example = selection->examples[i];
        TemplateValues *picture = template_add(page, "picture");
        Options own = options_of(example, options);
        own.output_given = false;
        own.shaders.folder = own.shaders.folder ? "..." : NULL; /* the folder is private */
        command_write(example, &own, NULL, command, sizeof command);
        template_set(picture, "name", "%s", example->name);
        template_set(picture, "summary", "%s", example->summary);
        template_set(picture, "command", "examples/run %s", command);
    }
    snprintf(path, sizeof path, "%s/index.html", folder);
    const bool written = template_write("examples/gallery/gallery.html", page, path, message);
    template_close(page);
    return written;
}

/* `captured`: what draws it is, too, and the files that are read are left open; NULL: neither. */
static bool draw_one(const Example *example, Canvas *canvas, const Options *options,
                     Picture *picture, RegressionPicture *captured, Message *message)
{
    Renderer renderer;
    ShaderFiles files = {.count = 0};
    Options own = options_of(example, options);
    own.shaders.files = captured ? &captured->files : &files;
    const DrawRequest request = options_request(&own, example);
    const bool shadows = options_have_shadows(&own);
    if ((shadows != canvas->supersampled &&
         !canvas_set_samples(canvas, own.canvas.samples, shadows, message)) ||
        !canvas_resize(canvas, own.width, own.height, message))
        return false;
    if (captured)
        capture_begin(&captured->capture, canvas);
    bool drawn = renderer_open(&renderer, example, canvas, &request, message);
    if (drawn && renderer.warning.text[0])
        options_warn(example->name, &renderer.warning);
    drawn = drawn && renderer_picture(&renderer, &request, own.seconds, &picture->image, message);
    if (captured)
        capture_end(&captured->capture);
    renderer_close(&renderer);
    picture_texts_set(example, canvas, &own, own.seconds, picture);
    PictureSources sources = {.files = 0};
    if (own.part.count)
        picture_texts_sources(&sources, example, &own, picture);
    else if (keeps_shaders && drawn)
        drawn = regression_keep(options->output, &files, message);
    shader_files_close(&files);
    return drawn;
}

/* Parts have theirs beside that of the whole. */
static const char *beside(const Options *options)
{
    return options->part.count ? ".parts" : "";
}

static void set_path(Picture *picture, const Example *example, const Options *options)
{
    snprintf(picture->path, sizeof picture->path, "%s%s/%s.png", options->output, beside(options),
             example->name);
}

static bool draw_all(const Selection *selection, Canvas *canvas, const Options *options,
                     Message *message)
{
    PictureQueue *queue;
    Progress progress = progress_start("gallery");
    const PictureQueueOptions pictures = {canvas->width, canvas->height, IMAGE_BYTE,
                                          .count = selection->count};
    if (!picture_queue_open(&queue, &pictures, message))
        return false;
    bool done = true;
    for (int i = 0; i < selection->count && done; i++) {
        const double start = clock_now();
        const Example *example = selection->examples[i];
        Picture *picture = picture_queue_take(queue);
        set_path(picture, example, options);
        done = draw_one(example, canvas, options, picture, NULL, message) &&
               picture_queue_give(queue, picture, message);
        if (options->verbose)
            fprintf(stderr, "%s took %.1f ms\n", example->name, 1e3 * (clock_now() - start));
        progress_update(&progress, i + 1, selection->count);
    }
    progress_end(&progress);
    return picture_queue_close(queue, message) && done;
}

/* --merge: the pictures that the parts have drawn, to the folder, or only checked so that a failure
 * leaves no half gallery. */
static bool read_all(const Selection *selection, const Options *options, bool checks,
                     Message *message)
{
    const CanvasBackend *given = options->canvas.backend;
    const CanvasBackend *backend = given ? given : backend_default(message);
    Options drawn = *options;
    drawn.part = (Part){1, 1};
    Picture *picture = memory_new(1, sizeof *picture);
    bool done = backend != NULL;
    PictureOrigin origins[2] = {{.driver = ""}}; /* of diagrams and of others */
    for (int i = 0; i < selection->count && done; i++) {
        const Example *example = selection->examples[i];
        const Options own = options_of(example, options);
        const Canvas canvas = {.width = own.width, .height = own.height, .backend = backend};
        set_path(picture, example, &drawn);
        picture_texts_set(example, &canvas, &own, own.seconds, picture);
        done = picture_texts_check(picture, &origins[!example_kind(example)->without_gl], message);
        if (!done || checks)
            continue;
        set_path(picture, example, options);
        picture->sources[0] = '\0';
        done = picture_write(picture, message);
    }
    image_close(&picture->image);
    free(picture);
    return done;
}

static bool open_canvas(Canvas *canvas, const Options *options, Message *message)
{
    if (!shader_loader_check(&options->shaders, message))
        return false;
    setenv("LP_NUM_THREADS", "0", 0); /* as in run.c: other threads encode */
    return options_open_canvas(canvas, options, "gallery.png", message);
}

static bool merge_gallery(const Selection *selection, const Options *options, Message *message)
{
    return read_all(selection, options, true, message) && output_folder(options->output, message) &&
           read_all(selection, options, false, message) &&
           write_page(options->output, selection, options, message);
}

static bool write_gallery(const Selection *selection, const Options *options, Message *message)
{
    Canvas canvas = {0};
    Renderer renderer;
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%s%s", options->output, beside(options));
    bool done = open_canvas(&canvas, options, message);
    /* Each is opened once before anything is written: a failure must not leave half a gallery. */
    for (int i = 0; i < selection->count && done; i++) {
        const DrawRequest request = options_request(options, selection->examples[i]);
        done = renderer_open(&renderer, selection->examples[i], &canvas, &request, message);
        if (done)
            renderer_close(&renderer);
    }
    if (done && !options->shaders.print)
        done = output_folder(folder, message) && draw_all(selection, &canvas, options, message) &&
               (options->part.count || write_page(folder, selection, options, message));
    canvas_close(&canvas);
    return done;
}

static bool judge(Regression *regression, RegressionPicture *of, Canvas *canvas,
                  const Options *options, Message *message)
{
    bool same = false; /* unless it cannot be read */
    if (!regression_compare(regression, of->now, &same, message) || same)
        return same;
    if (regression_needs_driver(regression))
        canvas_close(canvas);
    return (canvas->context || (regression_measure(regression, options->canvas.backend, message) &&
                                open_canvas(canvas, options, message))) &&
           regression_judge(regression, of, message);
}

/* --verify; *code is EXIT_FAILED if a pixel cannot be. */
static bool verify(const Selection *selection, const Options *options, int *code, Message *message)
{
    Regression *regression;
    Canvas canvas = {0};
    Picture *picture = memory_new(1, sizeof *picture);
    bool done = regression_open(&regression, verified,
                                options->output_given ? options->output : "changed", message) &&
                open_canvas(&canvas, options, message);
    for (int i = 0; i < selection->count && done; i++) {
        const Example *example = selection->examples[i];
        RegressionPicture of = {.now = picture, .canvas = &canvas};
        if (!options->names[0] && !regression_has(regression, example->name))
            continue;
        done = draw_one(example, &canvas, options, picture, &of, message) &&
               judge(regression, &of, &canvas, options, message);
        capture_close(&of.capture);
        shader_files_close(&of.files);
    }
    done = done && regression_end(regression, code, message);
    canvas_close(&canvas);
    regression_close(regression);
    image_close(&picture->image);
    free(picture);
    return done;
}

static bool check(const Options *options, Message *message)
{
    if (verified &&
        (keeps_shaders || options->part.count || options->merge || options->shaders.print))
        return message_set(message,
                           "--verify %s: leave out --keep-shaders, --part, --merge and "
                           "--print-shader",
                           verified);
    return !keeps_shaders || (!options->part.count && !options->merge) ||
           message_set(message, "--keep-shaders: goes with neither --part nor --merge, which reads "
                                "no shaders");
}

/* Of all examples, those of --part. */
static void select_part(Selection *selection, Part part)
{
    int kept = 0;
    for (int i = 0; i < selection->count; i++)
        if (part_has(part, (uint64_t)i))
            selection->examples[kept++] = selection->examples[i];
    selection->count = kept;
}

int main(int argc, char *argv[])
{
    Options options;
    int code;
    Message message = {0};
    Selection selection = {.count = 0};
    if (!options_begin(&options, &GALLERY, argc, argv, &code))
        return code;
    if (!check(&options, &message) || !select_examples(&selection, options.names, &message))
        return options_fail(GALLERY.name, &message, EXIT_USAGE);
    select_part(&selection, options.part);
    if (!(verified        ? verify(&selection, &options, &code, &message)
          : options.merge ? merge_gallery(&selection, &options, &message)
                          : write_gallery(&selection, &options, &message)))
        return options_fail(GALLERY.name, &message, EXIT_FAILED);
    if (verified)
        return options_finish(GALLERY.name, code);
    if (!options.shaders.print && !options.part.count)
        printf("%s/index.html\n", options.output);
    return options_finish(GALLERY.name, 0);
}
