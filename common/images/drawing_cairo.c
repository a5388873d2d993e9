/* The plugin that links cairo: see drawing_list.h. */
#include "images/drawing_list.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <stdint.h>
#include <string.h>

static void set_color(cairo_t *cairo, Vec3 color, double alpha)
{
    cairo_set_source_rgba(cairo, color.x, color.y, color.z, alpha);
}

static void follow(cairo_t *cairo, const Drawing *drawing, const DrawingPath *path)
{
    const DrawingPoint *p = drawing->points + path->first_point;
    cairo_new_path(cairo);
    for (int i = 0; i < path->step_count; i++) {
        switch (drawing->steps[path->first_step + i]) {
        case DRAWING_MOVE:
            cairo_move_to(cairo, p[0].x, p[0].y);
            p += 1;
            break;
        case DRAWING_LINE:
            cairo_line_to(cairo, p[0].x, p[0].y);
            p += 1;
            break;
        case DRAWING_CURVE:
            cairo_curve_to(cairo, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y);
            p += 3;
            break;
        case DRAWING_CLOSE:
            cairo_close_path(cairo);
            break;
        }
    }
}

/* The one function that draws, on every kind of surface. */
static const char *paint_all(cairo_t *cairo, const Drawing *drawing, bool transparent)
{
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    if (!transparent) {
        set_color(cairo, (Vec3){1, 1, 1}, 1);
        cairo_paint(cairo);
    }
    for (int i = 0; i < drawing->path_count; i++) {
        const DrawingPath *path = &drawing->paths[i];
        const DrawingStyle *style = &path->style;
        follow(cairo, drawing, path);
        if (style->fill_alpha > 0) {
            set_color(cairo, style->fill, style->fill_alpha);
            cairo_fill_preserve(cairo);
        }
        if (style->width > 0) {
            cairo_set_dash(cairo, &style->dash, style->dash > 0, 0);
            cairo_set_line_width(cairo, style->width);
            set_color(cairo, style->stroke, 1);
            cairo_stroke(cairo);
        }
    }
    const cairo_status_t status = cairo_status(cairo);
    return status ? cairo_status_to_string(status) : NULL;
}

static const char *draw_on(cairo_surface_t *surface, const Drawing *drawing, bool transparent,
                           double scale_x, double scale_y)
{
    cairo_t *cairo = cairo_create(surface);
    cairo_scale(cairo, scale_x, scale_y);
    const char *reason = paint_all(cairo, drawing, transparent);
    cairo_destroy(cairo);
    return reason;
}

/* From cairo's native-endian words, whose colors are multiplied by alpha. */
static void take_pixels(Image *image, cairo_surface_t *surface)
{
    const unsigned char *rows = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    unsigned char *to = image->pixels;
    for (int y = 0; y < image->height; y++, rows += stride)
        for (int x = 0; x < image->width; x++, to += 4) {
            uint32_t word;
            memcpy(&word, rows + 4 * x, 4);
            const uint32_t alpha = word >> 24, half = alpha / 2;
            for (int c = 0; c < 3; c++) {
                const uint32_t color = word >> (16 - 8 * c) & 255;
                to[c] = (unsigned char)(alpha ? (255 * color + half) / alpha : 0);
            }
            to[3] = (unsigned char)alpha;
        }
}

static const char *paint(const Drawing *drawing, Image *image, bool transparent)
{
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image->width, image->height);
    const char *reason = draw_on(surface, drawing, transparent, image->width / drawing->width,
                                 image->height / drawing->height);
    cairo_surface_flush(surface);
    if (!reason)
        take_pixels(image, surface);
    cairo_surface_destroy(surface);
    return reason;
}

static cairo_status_t append(void *file, const unsigned char *bytes, unsigned size)
{
    return fwrite(bytes, 1, size, file) == size ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static const char *encode(const Drawing *drawing, const char *format, bool transparent, FILE *to)
{
    const bool svg = strcmp(format, "svg") == 0;
    cairo_surface_t *surface =
        (svg ? cairo_svg_surface_create_for_stream
             : cairo_pdf_surface_create_for_stream)(append, to, drawing->width, drawing->height);
    if (svg)
        cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    else /* none, so that equal drawings are equal files */
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
    const char *reason = draw_on(surface, drawing, transparent, 1, 1);
    cairo_surface_finish(surface);
    const cairo_status_t status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return reason ? reason : status ? cairo_status_to_string(status) : NULL;
}

__attribute__((visibility("default"))) const DrawingPlugin drawing_plugin = {
    .version = cairo_version_string, .paint = paint, .encode = encode};
