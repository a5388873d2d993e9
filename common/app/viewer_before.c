/* Before and after: the picture as it was when b was pressed, over the one that is, left of a line
 * that follows the pointer. Time stands still, so that what differs is what was changed. */
#include "app/viewer_state.h"

#include "core/gl.h"

#include <math.h>
#include <string.h>

static bool keep(Viewer *viewer, Message *message)
{
    const Image *now = &viewer->picture.image;
    if (!viewer_is_made(viewer))
        return message_set(message, "b: there is no picture until the error is corrected");
    if (!viewer_read_picture(viewer, message) ||
        !image_open(&viewer->before, now->width, now->height, now->type, message))
        return false;
    memcpy(viewer->before.pixels, now->pixels, image_row_size(now) * (size_t)now->height);
    return true;
}

void viewer_before_toggle(Viewer *viewer)
{
    Message message = {0};
    if (viewer->before.pixels) {
        image_close(&viewer->before);
        return;
    }
    viewer->paused = true;
    viewer->division = 0.5;
    if (!keep(viewer, &message))
        options_fail(viewer->example->name, &message, EXIT_FAILED);
    viewer_panel_notice(&viewer->panel,
                        message.text[0] ? message.text : "left of the pointer: as it was until b");
}

bool viewer_before_present(Viewer *viewer, const int place[4], Message *message)
{
    const WindowInput *input = &viewer->input;
    const Image *before = &viewer->before;
    const double at = (input->x - place[0]) / place[2], row = input->y - viewer->place[1];
    if (!before->pixels)
        return true;
    if (at >= 0 && at <= 1 && row >= 0 && row < place[3])
        viewer->division = at;
    /* The window may have another size by now. */
    const int columns = (int)round(viewer->division * before->width);
    const int left[4] = {place[0], place[1], columns * place[2] / before->width, place[3]};
    const bool done = columns == 0 || canvas_present_image(before, columns, left, message);
    glEnable(GL_SCISSOR_TEST);
    glScissor(left[0] + left[2], left[1], 1, left[3]);
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    glViewport(place[0], place[1], place[2], place[3]);
    return done;
}
