/* An animation in parts is a folder of pictures, which --merge reads back. Files of lines and
 * curves are written one by one. */
#include "app/frames.h"

#include "app/picture_texts.h"
#include "window/backends.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool frames_write_vectors(const Example *example, const Options *options, Message *message)
{
    bool done = true;
    for (int i = 0; i < options->frames && done; i++) {
        char path[PATH_MAX];
        const VectorFile file = {path, options->vector, options->width, options->height,
                                 options->alpha};
        if (part_has(options->part, (uint64_t)i))
            done = frames_path(options, i, path, message) &&
                   example_kind(example)->write_vector(example, frames_moment(options, i), &file,
                                                       message);
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
            picture_texts_set(example, &canvas, &parts.options, frames_moment(options, i), picture);
        done = done && picture_texts_check(picture, &origin, message) &&
               picture_queue_give(sink.queue, picture, message);
    }
    return frames_close(&sink, done, message);
}
