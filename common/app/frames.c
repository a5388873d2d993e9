/* A picture is drawn while other threads encode and write those before. An animation in parts is a
 * folder of pictures, which --merge reads back. */
#include "app/frames.h"

#include "app/picture_texts.h"
#include "base/clock.h"
#include "base/output.h"
#include "base/progress.h"
#include "window/backends.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool frames_path(const Options *options, int number, char path[PATH_MAX], Message *message)
{
    if (options->numbered)
        return output_numbered(options->output, number, path, PATH_MAX, message);
    if (snprintf(path, PATH_MAX, "%s", options->output) >= PATH_MAX)
        return message_set(message, "%s: %s", options->output, strerror(ENAMETOOLONG));
    return true;
}

bool frames_open(FrameSink *sink, const Canvas *canvas, const Options *options, Message *message)
{
    const AnimationOptions animation = {.format = options->animation,
                                        .path = options->output,
                                        .width = canvas->width,
                                        .height = canvas->height,
                                        .frames = options->frames,
                                        .fps = options->fps,
                                        .alpha = options->alpha,
                                        .compress = options->compress};
    *sink = (FrameSink){.queue = NULL};
    if (options->animation && !animation_open(&sink->animation, &animation, message))
        return false;
    const PictureQueueOptions pictures = {.width = canvas->width,
                                          .height = canvas->height,
                                          .type = canvas->real ? IMAGE_FLOAT : IMAGE_BYTE,
                                          .count = options->frames,
                                          .write = sink->animation ? animation_add : NULL,
                                          .data = sink->animation};
    return picture_queue_open(&sink->queue, &pictures, message);
}

bool frames_close(FrameSink *sink, bool drawn, Message *message)
{
    const bool written = picture_queue_close(sink->queue, message) && drawn;
    return animation_close(sink->animation, written, message);
}

/* The moment of picture `i`. */
static double moment(const Options *options, int i)
{
    return options->seconds + i / options->fps;
}

/* Draws picture `i`; or, of a part of an animation that is run again, keeps the file if it is what
 * would be drawn. The part's first picture is drawn in any case: only then is known which shader
 * files it reads. */
static bool draw_frame(Renderer *renderer, const Options *options, int i, PictureSources *sources,
                       Picture *picture, Message *message)
{
    const Example *example = renderer->example;
    const double seconds = moment(options, i);
    sources->kept = false;
    if (!frames_path(options, i, picture->path, message))
        return false;
    if (options->keeps && sources->text[0]) {
        picture_texts_set(example, renderer->canvas, options, seconds, picture);
        picture_texts_sources(sources, example, options, picture);
        sources->kept = picture_texts_kept(picture);
    }
    if (sources->kept)
        return true;
    const DrawRequest request = options_request(options, example);
    if (!renderer_picture(renderer, &request, seconds, &picture->image, message))
        return false;
    picture_texts_set(example, renderer->canvas, options, seconds, picture);
    if (options->keeps)
        picture_texts_sources(sources, example, options, picture);
    return true;
}

bool frames_draw(Renderer *renderer, const Options *options, PictureQueue *queue, Message *message)
{
    const Example *example = renderer->example;
    Progress progress = progress_start(example->name);
    PictureSources sources = {.files = 0};
    Picture *picture = NULL;
    bool done = true;
    for (int i = 0; i < options->frames && done; i++) {
        if (!part_has(options->part, (uint64_t)i))
            continue;
        picture = sources.kept ? picture : picture_queue_take(queue);
        done = draw_frame(renderer, options, i, &sources, picture, message) &&
               (sources.kept || picture_queue_give(queue, picture, message));
        progress_update(&progress, i + 1, options->frames);
    }
    progress_end(&progress);
    if (done && options->verbose)
        fprintf(stderr, "drawing and reading took %.1f ms\n", 1e3 * (clock_now() - progress.start));
    return done;
}

bool frames_write_vectors(const Example *example, const Options *options, Message *message)
{
    bool done = true;
    for (int i = 0; i < options->frames && done; i++) {
        char path[PATH_MAX];
        const VectorFile file = {path, options->vector, options->width, options->height,
                                 options->alpha};
        if (part_has(options->part, (uint64_t)i))
            done = frames_path(options, i, path, message) &&
                   example_kind(example)->write_vector(example, moment(options, i), &file, message);
    }
    return done;
}

bool frames_find_parts(FrameParts *parts, const Options *options, Message *message)
{
    size_t length = 0;
    parts->options = *options;
    parts->options.animation = NULL;
    parts->options.keeps = true;
    parts->options.numbered = true;
    parts->options.output = parts->pictures;
    if (snprintf(parts->folder, sizeof parts->folder, "%s.parts", options->output) >= PATH_MAX)
        return message_set(message, "%s: %s", options->output, strerror(ENAMETOOLONG));
    for (const char *p = parts->folder; *p; p++) {
        parts->pictures[length++] = *p;
        if (*p == '%')
            parts->pictures[length++] = '%';
    }
    snprintf(parts->pictures + length, sizeof parts->pictures - length, "/%%06d.png");
    return true;
}

static bool parts_are_whole(const FrameParts *parts, Message *message)
{
    int missing = 0, first = 0;
    for (int i = parts->options.frames - 1; i >= 0; i--) {
        char path[PATH_MAX];
        if (!frames_path(&parts->options, i, path, message))
            return false;
        if (access(path, F_OK) != 0) {
            missing++;
            first = i;
        }
    }
    return !missing || message_set(message,
                                   "%s: %d of %d pictures are missing, the first is %06d.png; "
                                   "--part draws them",
                                   parts->folder, missing, parts->options.frames, first);
}

bool frames_merge(const Example *example, const Options *options, Message *message)
{
    const CanvasBackend *given = options->canvas.backend;
    const Canvas canvas = {.width = options->width,
                           .height = options->height,
                           .backend = example_kind(example)->without_gl ? NULL
                                      : given                           ? given
                                                                        : backend_default(message)};
    FrameParts parts;
    FrameSink sink = {.queue = NULL};
    PictureOrigin origin = {.driver = ""};
    if (!frames_find_parts(&parts, options, message) || !parts_are_whole(&parts, message))
        return false;
    bool done = frames_open(&sink, &canvas, options, message);
    for (int i = 0; i < options->frames && done; i++) {
        Picture *picture = picture_queue_take(sink.queue);
        done = frames_path(&parts.options, i, picture->path, message);
        if (done)
            picture_texts_set(example, &canvas, &parts.options, moment(options, i), picture);
        done = done && picture_texts_check(picture, &origin, message) &&
               picture_queue_give(sink.queue, picture, message);
    }
    return frames_close(&sink, done, message);
}
