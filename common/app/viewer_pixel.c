/* A pixel that is clicked is explained as --probe explains it: of the picture that stands still,
 * and again when that is another, a few times per second. Instead of the picture one of its
 * shaders' values may be drawn, as --show draws it. While time runs all this stays as it was, and
 * the picture is what is drawn.
 */
#include "app/viewer_state.h"
#include "base/memory.h"
#include "base/output_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double LINE_SECONDS = 0.1, AGAIN_SECONDS = 0.25;

static bool can_explain(const Viewer *viewer)
{
    return viewer_is_made(viewer) && !example_kind(viewer->example)->paint && !viewer->canvas->real;
}

/* Where a point of the window is in the picture; false: outside. */
static bool find_place(const Viewer *viewer, double x, double y, int pixel[2])
{
    const int *place = viewer->place;
    pixel[0] = (int)x - place[0];
    pixel[1] = (int)y - place[1];
    return x >= place[0] && y >= place[1] && pixel[0] < place[2] && pixel[1] < place[3];
}

void viewer_pixel_click(Viewer *viewer, double x, double y)
{
    ViewerPixel *pixel = &viewer->pixel;
    int at[2];
    if (!can_explain(viewer) || !find_place(viewer, x, y, at))
        return;
    for (int i = 0; i < 2; i++)
        pixel->at[i] = (at[i] + 0.5) / viewer->place[2 + i];
    pixel->open = viewer->paused = true;
    pixel->time = 0;
    if (viewer->panel.view != PANEL_OPEN)
        viewer_panel_toggle(&viewer->panel);
}

static bool is_other(const Viewer *viewer)
{
    const DrawRequest request = options_request(&viewer->options, viewer->example);
    const ViewerPixel *pixel = &viewer->pixel;
    return pixel->time == 0 || pixel->renewals != viewer->panel.renewals ||
           viewer_panel_other(&pixel->of, &viewer->reload.renderer, &request);
}

bool viewer_pixel_due(const Viewer *viewer)
{
    return viewer->pixel.open && viewer->paused && can_explain(viewer) && is_other(viewer) &&
           clock_now() - viewer->pixel.time >= AGAIN_SECONDS;
}

static void forget(ViewerPixel *pixel)
{
    free(pixel->text);
    free(pixel->all);
    free(pixel->legend);
    pixel->text = pixel->all = pixel->legend = NULL;
    pixel->names[0] = NULL;
    image_close(&pixel->image);
}

/* The verdict first. */
static char *arranged(char *text)
{
    static const char VERDICT[] = "\nverdict: ";
    char *verdict = text ? strstr(text, VERDICT) : NULL;
    char *end = verdict ? strchr(verdict + 1, '\n') : NULL;
    if (!end)
        return text;
    *verdict = *end = '\0';
    char *all = memory_format("%s\n%s\n%s", verdict + sizeof VERDICT - 1, text, end + 1);
    free(text);
    return all;
}

static void find_names(ViewerPixel *pixel, const Probing *probing, const ProbePlugin *plugin)
{
    char *place = NULL;
    int count = 0;
    OutputText text;
    output_text_open(&text);
    fprintf(text.file, "error\nblame\n");
    for (int stage = 1; stage >= 0; stage--)
        plugin->names(&probing->capture, &probing->driver, stage, text.file, NULL);
    pixel->all = output_text_close(&text);
    for (char *name = strtok_r(pixel->all, "\n", &place); name && count < PIXEL_NAMES;
         name = strtok_r(NULL, "\n", &place)) {
        bool known = false; /* in both stages */
        for (int i = 0; i < count && !known; i++)
            known = strcmp(pixel->names[i], name) == 0;
        if (!known)
            pixel->names[count++] = name;
    }
    pixel->names[count] = NULL;
}

static void find_shown(ViewerPixel *pixel, const Probing *probing, const ProbePlugin *plugin)
{
    const Canvas *canvas = probing->renderer.canvas;
    Message why = {.located = false};
    OutputText legend;
    output_text_open(&legend);
    if (!image_open(&pixel->image, canvas->width, canvas->height, IMAGE_BYTE, &why) ||
        plugin->show(&probing->capture, &probing->driver, pixel->shown, &pixel->image, legend.file,
                     &why) != SHOW_DONE) {
        fprintf(legend.file, "%s", why.text);
        image_close(&pixel->image);
    }
    pixel->legend = output_text_close(&legend);
}

/* In the renderer's place, because only one is open at a time; `explained`: at that pixel. */
static bool probe(Viewer *viewer, Probing *probing, const int *explained, Message *why)
{
    ViewerPixel *pixel = &viewer->pixel;
    Renderer *renderer = &viewer->reload.renderer;
    const ProbePlugin *plugin = probing_plugin(why);
    if (viewer->options.canvas.samples > 1)
        message_set(why, "a pixel of several samples has no one colour: set samples to 0");
    if (!plugin || viewer->options.canvas.samples > 1)
        return false;
    renderer_close(renderer);
    const bool opened =
        probing_open(probing, viewer->example, &viewer->options, viewer->canvas, why);
    if (opened && explained) {
        pixel->text = arranged(probing_pixel(probing, plugin, explained, false, why));
        find_names(pixel, probing, plugin);
        if (pixel->shown[0])
            find_shown(pixel, probing, plugin);
    }
    renderer_close(&probing->renderer);
    if (!renderer_open(renderer, viewer->example, viewer->canvas, viewer_request(viewer), why))
        shader_reload_renew(&viewer->reload);
    return opened;
}

void viewer_pixel_update(Viewer *viewer)
{
    ViewerPixel *pixel = &viewer->pixel;
    const Canvas *canvas = viewer->canvas;
    const double start = clock_now();
    Probing probing = {.renderer = {.example = NULL}};
    Message why = {.located = false};
    if (!viewer_pixel_due(viewer))
        return;
    const int at[2] = {(int)(pixel->at[0] * canvas->width), (int)(pixel->at[1] * canvas->height)};
    forget(pixel);
    pixel->of = viewer_panel_picture(&viewer->reload.renderer, viewer_request(viewer));
    pixel->renewals = viewer->panel.renewals;
    probe(viewer, &probing, at, &why);
    probing_close(&probing);
    if (!pixel->text)
        pixel->text = memory_text(why.text);
    if (!viewer->panel.panel || viewer->options.verbose)
        fprintf(stderr, "%s\n", pixel->text);
    snprintf(pixel->title, sizeof pixel->title, "Pixel %d,%d at %.10g s", at[0], at[1],
             viewer->options.seconds);
    pixel->time = clock_now();
    if (viewer->options.verbose)
        fprintf(stderr, "explaining the pixel took %.1f ms\n", 1e3 * (pixel->time - start));
}

/* By the scene, or by running the shaders of the picture, which is captured once. */
static bool find_exact(Viewer *viewer, const int at[2], ExactPixel *exact)
{
    ViewerPixel *pixel = &viewer->pixel;
    Renderer *renderer = &viewer->reload.renderer;
    double color[4];
    int draw;
    if (renderer->kind->exact)
        return renderer->kind->exact(renderer, viewer_request(viewer), at, exact);
    pixel->sees = pixel->sees || probe(viewer, &pixel->seen, NULL, NULL);
    const ProbeQuestion question = {.capture = &pixel->seen.capture,
                                    .driver = &pixel->seen.driver,
                                    .column = at[0],
                                    .row = at[1],
                                    .height = viewer->canvas->height};
    if (!pixel->sees || !probing_plugin(NULL)->exact(&question, color, &draw))
        return false;
    *exact = (ExactPixel){{(float)color[0], (float)color[1], (float)color[2]}, .equation = NULL};
    snprintf(exact->object, sizeof exact->object, "object %d", draw);
    return true;
}

/* Its colour, and while time stands still the exact one. */
static void write_line(Viewer *viewer, const int at[2], const unsigned char drawn[3])
{
    char *line = viewer->pixel.line;
    ExactPixel exact;
    double most = 0;
    const int length =
        snprintf(line, PIXEL_LINE, "%d,%d: %d, %d, %d", at[0], at[1], drawn[0], drawn[1], drawn[2]);
    if (!viewer->paused || !find_exact(viewer, at, &exact))
        return;
    free(exact.equation);
    free(exact.terms);
    double steps[3];
    for (int i = 0; i < 3; i++) {
        steps[i] = 255 * fmin(fmax((double)exact.color[i], 0), 1);
        most = fmax(most, fabs(steps[i] - drawn[i]));
    }
    snprintf(line + length, (size_t)(PIXEL_LINE - length),
             "; %s, exactly %.1f, %.1f, %.1f: %.1f steps off", exact.object, steps[0], steps[1],
             steps[2], most);
}

void viewer_pixel_point(Viewer *viewer)
{
    ViewerPixel *pixel = &viewer->pixel;
    const Canvas *canvas = viewer->canvas;
    const double now = clock_now();
    Image image = {.width = 0};
    int at[2];
    const bool over = can_explain(viewer) && !viewer->panel.result.wants_pointer &&
                      !viewer->input.buttons[0] &&
                      find_place(viewer, viewer->input.x, viewer->input.y, at);
    if (!over)
        pixel->line[0] = '\0';
    if (!over || (!viewer->paused && now - pixel->line_time < LINE_SECONDS))
        return;
    const PanelPicture of = viewer_panel_picture(&viewer->reload.renderer, viewer_request(viewer));
    const bool same = viewer->paused == pixel->line_paused && pixel->line[0] &&
                      pixel->line_renewals == viewer->panel.renewals &&
                      !viewer_panel_other(&pixel->line_of, &viewer->reload.renderer, &of.request);
    if (same && memcmp(at, pixel->line_at, sizeof at) == 0)
        return;
    if (!same)
        probing_close(&pixel->seen);
    pixel->sees = pixel->sees && same;
    memcpy(pixel->line_at, at, sizeof at);
    pixel->line_of = of;
    pixel->line_renewals = viewer->panel.renewals;
    pixel->line_paused = viewer->paused;
    pixel->line_time = now;
    if (image_open(&image, canvas->width, canvas->height, IMAGE_BYTE, NULL) &&
        canvas_read(canvas, &image, NULL))
        write_line(viewer, at,
                   (unsigned char *)image.pixels +
                       4 * ((size_t)at[1] * (size_t)image.width + (size_t)at[0]));
    image_close(&image);
}

PanelPixel viewer_pixel_content(const Viewer *viewer)
{
    const ViewerPixel *pixel = &viewer->pixel;
    return (PanelPixel){.line = pixel->line[0] ? pixel->line : NULL,
                        .title = pixel->title,
                        .text = pixel->open ? pixel->text : NULL,
                        .names = pixel->names,
                        .shown = pixel->shown,
                        .legend = !viewer->paused ? "the moment above; space stops time, and this "
                                                    "is said anew"
                                                  : pixel->legend};
}

void viewer_pixel_choose(Viewer *viewer, const PanelResult *result)
{
    ViewerPixel *pixel = &viewer->pixel;
    if (result->shown) {
        snprintf(pixel->shown, sizeof pixel->shown, "%s", result->shown);
        pixel->time = 0;
    }
    if (result->pixel_closed)
        viewer_pixel_close(pixel);
}

const Image *viewer_pixel_image(const Viewer *viewer)
{
    const ViewerPixel *pixel = &viewer->pixel;
    return pixel->open && pixel->image.pixels && viewer->panel.view == PANEL_OPEN &&
                   !is_other(viewer)
               ? &pixel->image
               : NULL;
}

void viewer_pixel_close(ViewerPixel *pixel)
{
    forget(pixel);
    probing_close(&pixel->seen);
    *pixel = (ViewerPixel){.open = false};
}
