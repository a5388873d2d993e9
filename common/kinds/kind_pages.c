/* Programs of pages, painted from text and from what is drawn beside them. */
#include "app/options_table.h"
#include "scene/scene_example.h"

static void describe(const Example *example, Usage *usage)
{
    const PageExample *content = example->content;
    usage->seconds = content->seconds;
}

static bool paint(Renderer *renderer, const DrawRequest *request, double seconds, Image *image,
                  Message *message)
{
    const Canvas *canvas = renderer->canvas;
    const PageExample *content = renderer->example->content;
    const Frame frame = {.seconds = seconds,
                         .aspect = (double)canvas->width / canvas->height,
                         .orbit = request->orbit};
    return content->paint(&frame, canvas, image, message);
}

static bool turn_page(const Example *example, int pages)
{
    const Parameter *page = &example->parameters[0];
    int *number = page->value;
    const int before = *number;
    for (; pages > 0 && page->choices[*number + 1]; pages--)
        ++*number;
    for (; pages < 0 && *number > 0; pages++)
        --*number;
    return *number != before;
}

const ExampleKind PAGES_KIND = {
    .bytes = true,
    .program = PROGRAM_ONE,
    .describe = describe,
    .paint = paint,
    .turn_page = turn_page,
};
