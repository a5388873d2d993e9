/* Programs that draw themselves: the lecture's, and those whose drawing can fail. */
#include "app/options_table.h"
#include "app/renderer.h"
#include "scene/scene_example.h"

#include <math.h>

static bool begin(const Renderer *renderer, const DrawRequest *request, double seconds,
                  Frame *frame, Message *message)
{
    const Canvas *canvas = renderer->canvas;
    *frame = (Frame){.seconds = seconds,
                     .aspect = (double)canvas->width / canvas->height,
                     .orbit = request->orbit};
    renderer_clear(renderer, request, vec3_from_float(renderer->example->clear_color));
    return isfinite(seconds) || message_set(message, "time %g s: must be finite", seconds);
}

static bool draw(Renderer *renderer, const DrawRequest *request, double seconds, Message *message)
{
    Frame frame;
    if (!begin(renderer, request, seconds, &frame, message))
        return false;
    renderer->example->draw(&frame);
    return true;
}

static bool try_draw(Renderer *renderer, const DrawRequest *request, double seconds,
                     Message *message)
{
    const FallibleExample *content = renderer->example->content;
    Frame frame;
    return begin(renderer, request, seconds, &frame, message) && content->draw(&frame, message);
}

const ExampleKind LECTURE_KIND = {.program = PROGRAM_ONE, .draw = draw};
const ExampleKind FALLIBLE_KIND = {.program = PROGRAM_ONE, .draw = try_draw};
