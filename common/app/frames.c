/* A picture is drawn while other threads encode and write those before. */
#include "app/frames.h"

#include "app/picture_texts.h"
#include "base/clock.h"
#include "base/output.h"
#include "base/progress.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

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

/* Draws picture `i`; or, of a part of an animation that is run again, keeps the file if it is what
 * would be drawn. The part's first picture is drawn in any case: only then is known which shader
 * files it reads. */
static bool draw_frame(Renderer *renderer, const Options *options, int i, PictureSources *sources,
                       Picture *picture, Message *message)
{
    const Example *example = renderer->example;
    const double seconds = frames_moment(options, i);
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
