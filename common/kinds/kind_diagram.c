/* Programs that compose a figure of lines and text, which cairo paints; no OpenGL. */
#include "app/options_table.h"
#include "images/drawing.h"
#include "kinds/ineffective_options.h"
#include "scene/scene_example.h"

static bool compose(const Example *example, double seconds, int width, int height, Drawing *drawing,
                    Message *message)
{
    const DiagramExample *content = example->content;
    if (drawing_begin(drawing, width, height, message) &&
        content->compose(seconds, drawing, message))
        return true;
    drawing_end(drawing);
    return false;
}

static bool paint(Renderer *renderer, const DrawRequest *request, double seconds, Image *image,
                  Message *message)
{
    Drawing drawing;
    const bool done =
        compose(renderer->example, seconds, image->width, image->height, &drawing, message) &&
        drawing_paint(&drawing, image, request->alpha, message);
    drawing_end(&drawing);
    return done;
}

static bool write_vector(const Example *example, double seconds, const VectorFile *file,
                         Message *message)
{
    Drawing drawing;
    const bool done = compose(example, seconds, file->width, file->height, &drawing, message) &&
                      drawing_write(&drawing, file->path, file->format, file->alpha, message);
    drawing_end(&drawing);
    return done;
}

/* All of a figure that a picture shows. */
static bool add_drawing(const Example *example, const Options *options, double seconds,
                        CacheKey *key)
{
    Drawing drawing;
    const bool done = compose(example, seconds, options->width, options->height, &drawing, NULL);
    for (int i = 0; done && i < drawing.path_count; i++) {
        const DrawingPath *path = &drawing.paths[i];
        const DrawingStyle *style = &path->style;
        const Vec3 colors[] = {style->fill, style->stroke};
        const double numbers[] = {style->fill_alpha, style->width, style->dash};
        cache_key_add(key, colors, sizeof colors);
        cache_key_add(key, numbers, sizeof numbers);
        cache_key_add(key, &path->step_count, sizeof path->step_count);
    }
    if (done) {
        cache_key_add(key, drawing.steps, (size_t)drawing.step_count * sizeof *drawing.steps);
        cache_key_add(key, drawing.points, (size_t)drawing.point_count * sizeof *drawing.points);
    }
    drawing_end(&drawing);
    return done;
}

static bool add_drawings(const Example *example, const Options *options, CacheKey *key)
{
    bool done = true;
    for (int k = 0; k < INEFFECTIVE_MOMENTS && done; k++)
        done = add_drawing(example, options, options->seconds + INEFFECTIVE_LATER[k], key);
    return done;
}

static void find_ineffective(const Example *example, const Options *options,
                             const ParameterValue *defaults, char *text, size_t size)
{
    if (!ineffective_unknown(example, options))
        ineffective_options(example, options, defaults, add_drawings, text, size);
}

const ExampleKind DIAGRAM_KIND = {
    .without_gl = true,
    .bytes = true,
    .program = PROGRAM_DIAGRAM,
    .find_ineffective = find_ineffective,
    .paint = paint,
    .vector_format = drawing_format,
    .write_vector = write_vector,
};
