/* A picture is drawn while other threads encode and write those before. */
#include "app/frames.h"

#include "app/picture_texts.h"
#include "base/clock.h"
#include "base/input.h"
#include "base/memory.h"
#include "base/output.h"
#include "base/progress.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

double frames_moment(const Options *options, int i)
{
    return options->seconds + i / options->fps;
}

/* Numbered pictures of a part have the same bytes as without parts. So what they were drawn from
 * stands in a file beside them, FILE.I-of-N, which is written only when that has changed. */
static bool note_sources(const Options *options, PictureSources *sources, Message *message)
{
    struct stat file;
    size_t size;
    Message none = {0};
    char *path =
        memory_format("%s.%d-of-%d", options->output, options->part.number, options->part.count);
    char *before = input_whole(path, &size, &none);
    const bool done = (before && strcmp(before, sources->text) == 0) ||
                      output_write(path, sources->text, strlen(sources->text), message);
    if (done && stat(path, &file) == 0)
        sources->since = file.st_mtim;
    free(before);
    free(path);
    return done;
}

/* Whether a picture may be kept when its part is run again. */
static bool may_be_kept(const Options *options, const Picture *picture)
{
    char format[16];
    return options->part.count && options->numbered && image_format(picture->path, format, NULL) &&
           strcmp(format, "png") == 0;
}

static bool is_kept(const Example *example, const Options *options, PictureSources *sources,
                    Picture *picture)
{
    const struct timespec *since = &sources->since;
    struct stat file;
    if (options->keeps)
        picture_texts_sources(sources, example, options, picture);
    else if (stat(picture->path, &file) != 0 || file.st_mtim.tv_sec < since->tv_sec ||
             (file.st_mtim.tv_sec == since->tv_sec && file.st_mtim.tv_nsec < since->tv_nsec))
        return false;
    return picture_texts_kept(picture);
}

/* Draws picture `i`; or, of a part that is run again, keeps the file if it is what would be drawn.
 * The part's first picture is drawn in any case: only then is known which shader files it reads. */
static bool draw_frame(Renderer *renderer, const Options *options, int i, PictureSources *sources,
                       Picture *picture, Message *message)
{
    const Example *example = renderer->example;
    const double seconds = frames_moment(options, i);
    if (!frames_path(options, i, picture->path, message))
        return false;
    const bool may = may_be_kept(options, picture);
    if (may && sources->text[0]) {
        picture_texts_set(example, renderer->canvas, options, seconds, picture);
        sources->kept = is_kept(example, options, sources, picture);
    }
    if (sources->kept)
        return true;
    const DrawRequest request = options_request(options, example);
    if (!renderer_picture(renderer, &request, seconds, &picture->image, message))
        return false;
    picture_texts_set(example, renderer->canvas, options, seconds, picture);
    if (!may)
        return true;
    const int noted = sources->text[0] ? sources->files : -1;
    picture_texts_sources(sources, example, options, picture);
    if (options->keeps)
        return true;
    picture->sources[0] = '\0';
    return noted == sources->files || note_sources(options, sources, message);
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
