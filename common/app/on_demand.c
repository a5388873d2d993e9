/*
 * A program of the lecture by itself: one picture, as it comes without arguments. All that it may
 * be asked for besides, and all that it has to say, is in the plugin app.so, of what other programs
 * are linked with. So these programs compile few files, and a first picture loads none of the rest.
 */
#include "app/app_plugin.h"

#include "base/build_id.h"
#include "base/output.h"
#include "base/version.h"
#include "images/image_options.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const AppPlugin *find(Message *message)
{
    static Plugin plugin = {"app.so", "app_plugin", "app", "", "lighting", NULL};
    const AppPlugin *found = plugin_open(&plugin, message);
    if (!found || strcmp(found->build_id, BUILD_ID) == 0)
        return found;
    message_set(message,
                "app: its module, common/app.so, is of another build than the program: start "
                "the program by examples/run, which builds both, or build all with ninja");
    return NULL;
}

static const CanvasBackend *load_osmesa(void)
{
    const AppPlugin *found = find(NULL);
    return found ? found->osmesa : NULL;
}

const CanvasBackend CANVAS_OSMESA = {
    .name = "osmesa", .summary = CANVAS_OSMESA_SUMMARY, .load = load_osmesa};

/* Without the plugin the driver's words stand alone. */
void shader_advise(const ShaderSource sources[2], int refused, Message *message)
{
    const AppPlugin *found = message && message->text[0] ? find(NULL) : NULL;
    if (found)
        found->shader_advise(sources, refused, message);
}

/* Without macros, arrays, and functions but main, nothing grows. */
static bool is_plain(const char *text)
{
    const char *body = strchr(text, '{');
    return !(body && strchr(body + 1, '{')) && !strstr(text, "define") && !strchr(text, '[');
}

bool shader_bounded(const ShaderSource *source, ShaderStage stage, double turns_max,
                    Message *message)
{
    const AppPlugin *found = is_plain(source->text) && turns_max <= 0 ? NULL : find(NULL);
    return !found || found->shader_bounded(source, stage, turns_max, message);
}

static void say(const Example *example, const Message *message)
{
    fprintf(stderr, "%s%s%s\n", message->located ? "" : example->name, message->located ? "" : ": ",
            message->text);
}

/* The same bytes as the plugin's. */
static bool write_picture(const Example *example, const Canvas *canvas, const Image *image,
                          const char *path, Message *message)
{
    char driver[512];
    const ImageText text[] = {
        {"Title", example->name}, {"Software", "lighting " VERSION}, {"Time", "0 s"},
        {"Driver", driver},       {"Command", example->name},        {NULL, NULL}};
    const ImageOptions options = {.compress = IMAGE_COMPRESS_DEFAULT, .text = text};
    ImageFile file = {.bytes = NULL};
    snprintf(driver, sizeof driver, "%s, %s; %s", canvas->backend->name, canvas->platform,
             canvas->renderer);
    const bool done = image_png_encode(image, &options, &file, message) &&
                      output_write(path, file.bytes, file.size, message);
    free(file.bytes);
    return done;
}

/* The picture, in an open canvas. With a warning there is none if the plugin can say it better. */
static bool draw(const Example *example, const Canvas *canvas, const char *path, Message *message)
{
    Message warning = {0};
    const ShaderLoader loader = {.keeps = true, .warning = &warning};
    const Frame frame = {.aspect = (double)canvas->width / canvas->height};
    Image image = {.pixels = NULL};
    bool done = example->init(&loader, message) &&
                image_open(&image, canvas->width, canvas->height, IMAGE_BYTE, message);
    if (warning.text[0]) {
        done = done && !find(NULL);
        say(example, &warning);
    }
    if (done) {
        canvas_clear(canvas, vec3_from_float(example->clear_color), 1);
        example->draw(&frame);
        done = canvas_read(canvas, &image, message) &&
               write_picture(example, canvas, &image, path, message);
    }
    example->finish();
    image_close(&image);
    return done;
}

static bool draw_first(const Example *example, Message *message)
{
    char path[80];
    const CanvasOptions options = {.backend = &CANVAS_EGL,
                                   .width = example->width ? example->width : OPTIONS_SIDE,
                                   .height = example->height ? example->height : OPTIONS_SIDE};
    Canvas canvas = {0};
    snprintf(path, sizeof path, "%s.png", example->name);
    const bool done = output_check(path, message) && canvas_open(&canvas, &options, message) &&
                      draw(example, &canvas, path, message);
    canvas_close(&canvas);
    if (done && isatty(STDERR_FILENO))
        fprintf(stderr, "%s: wrote %s, %dx%d\n", example->name, path, options.width,
                options.height);
    return done;
}

int example_main(const Example *example, int argc, char *argv[])
{
    Message message = {0}, missing = {0};
    const bool first = argc == 1 && !getenv("LIGHTING_BACKEND") && !getenv("LIGHTING_SHADERS");
    options_prepare_process();
    if (first && draw_first(example, &message))
        return 0;
    const AppPlugin *found = find(&missing);
    if (found) /* what went wrong, too */
        return found->main(example, argc, argv);
    say(example, first ? &message : &missing);
    return EXIT_FAILED;
}
