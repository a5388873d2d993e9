#include "example.h"

#include "output.h"
#include "progress.h"
#include "stage.h"

#include <stdio.h>
#include <stdlib.h>

/* One picture, all on this thread. */
static bool draw_one(const Example *example, const Canvas *canvas, const Options *options,
                     Message *message)
{
    Picture picture = {.path = ""};
    snprintf(picture.path, sizeof picture.path, "%s", options->output);
    const double start = progress_now();
    bool done = image_open(&picture.image, canvas->width, canvas->height,
                           canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, message) &&
                stage_picture(example, canvas, options, options->seconds, &picture, message);
    const double drawn = progress_now();
    done = done && picture_write(&picture, message);
    if (done && options->verbose)
        fprintf(stderr, "drawing and reading took %.1f ms, encoding and writing %.1f ms\n",
                1e3 * (drawn - start), 1e3 * (progress_now() - drawn));
    image_close(&picture.image);
    return done;
}

/* Several pictures: a second thread writes one while the next is drawn. */
static bool draw_many(const Example *example, const Canvas *canvas, const Options *options,
                      Message *message)
{
    PictureQueue *queue;
    if (!picture_queue_open(&queue, canvas->width, canvas->height,
                            canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, message))
        return false;
    Progress progress = progress_start(example->name);
    bool done = true;
    for (int i = 0; i < options->frames && done; i++) {
        const double seconds = options->seconds + i / options->fps;
        Picture *picture = picture_queue_take(queue);
        done = output_numbered(options->output, i, picture->path, sizeof picture->path, message) &&
               stage_picture(example, canvas, options, seconds, picture, message) &&
               picture_queue_give(queue, picture, message);
        progress_update(&progress, i + 1, options->frames);
    }
    progress_end(&progress);
    const bool written = picture_queue_close(queue, message);
    if (done && written && options->verbose)
        fprintf(stderr, "%d pictures took %.1f ms\n", options->frames,
                1e3 * (progress_now() - progress.start));
    return done && written;
}

static bool run(const Example *example, const Options *options, Message *message)
{
    char first[PATH_MAX];
    Canvas canvas = {0};
    const bool many = options->frames > 1;
    if (many && !output_numbered(options->output, 0, first, sizeof first, message))
        return false;
    if (!shader_loader_check(&options->shaders, message))
        return false;
    if (!options->shaders.print && !output_check(many ? first : options->output, message))
        return false;
    /* While a second thread encodes, llvmpipe's own threads are in its way. */
    if (many)
        setenv("LP_NUM_THREADS", "0", 0);
    if (!stage_open(&canvas, options, options->output, message))
        return false;
    bool done = stage_enter(example, options, message);
    if (done) {
        if (!options->shaders.print)
            done = many ? draw_many(example, &canvas, options, message)
                        : draw_one(example, &canvas, options, message);
        stage_leave(example);
    }
    canvas_close(&canvas);
    return done;
}

int example_main(const Example *example, int argc, char *argv[])
{
    Options options;
    Message message = {0};
    const Usage usage = {.name = example->name, .summary = example->summary};
    options_prepare_process();
    switch (options_read(&options, &usage, argc, argv, &message)) {
    case OPTIONS_ANSWERED:
        return options_finish(example->name, 0);
    case OPTIONS_BAD:
        return options_fail(example->name, &message, EXIT_USAGE);
    case OPTIONS_RUN:
        break;
    }
    if (options.doctor)
        return options_finish(example->name, stage_doctor());
    if (!run(example, &options, &message))
        return options_fail(example->name, &message, EXIT_FAILED);
    return options_finish(example->name, 0);
}
