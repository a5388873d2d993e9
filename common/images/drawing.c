/*
 * A figure is four lists that grow: paths, the steps of all paths, the points of all steps, and the
 * texts. A path knows where its steps and points begin, so that any surface can walk it: pixels,
 * SVG and PDF alike. A letter is a path like others: TrueType's curves are quadratic, with one
 * control c between the ends a and b; the same curve as a cubic has the controls (a + 2c)/3 and (b
 * + 2c)/3.
 */
#include "images/drawing.h"

#include "base/cache.h"
#include "base/memory.h"
#include "base/output.h"
#include "base/plugin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define FONTS "/usr/share/fonts/truetype/liberation/LiberationSerif-"
#define FONTS_PACKAGE "fonts-liberation"

bool drawing_begin(Drawing *drawing, double width, double height, Message *message)
{
    *drawing = (Drawing){.width = width, .height = height};
    if (font_open(&drawing->upright, FONTS "Regular.ttf", FONTS_PACKAGE, message) &&
        font_open(&drawing->italic, FONTS "Italic.ttf", FONTS_PACKAGE, message))
        return true;
    drawing_end(drawing);
    return false;
}

void drawing_end(Drawing *drawing)
{
    if (!drawing)
        return;
    font_close(&drawing->upright);
    font_close(&drawing->italic);
    free(drawing->steps);
    free(drawing->points);
    free(drawing->paths);
    free(drawing->labels);
    *drawing = (Drawing){.width = 0};
}

/* Paths. */

#define ONE_MORE(drawing, list, count, room)                                                       \
    memory_add(&(drawing)->list, &(drawing)->count, &(drawing)->room, sizeof *(drawing)->list)

void drawing_path(Drawing *drawing, DrawingStyle style)
{
    DrawingPath *path = ONE_MORE(drawing, paths, path_count, path_room);
    *path = (DrawingPath){
        .style = style, .first_step = drawing->step_count, .first_point = drawing->point_count};
}

static void add_step(Drawing *drawing, DrawingStep step, const DrawingPoint *points, int count)
{
    DrawingStep *added = ONE_MORE(drawing, steps, step_count, step_room);
    *added = step;
    for (int i = 0; i < count; i++) {
        DrawingPoint *point = ONE_MORE(drawing, points, point_count, point_room);
        *point = points[i];
    }
    drawing->paths[drawing->path_count - 1].step_count++;
}

void drawing_move(Drawing *drawing, DrawingPoint to)
{
    add_step(drawing, DRAWING_MOVE, &to, 1);
}

void drawing_line(Drawing *drawing, DrawingPoint to)
{
    add_step(drawing, DRAWING_LINE, &to, 1);
}

void drawing_curve(Drawing *drawing, DrawingPoint a, DrawingPoint b, DrawingPoint to)
{
    add_step(drawing, DRAWING_CURVE, (const DrawingPoint[]){a, b, to}, 3);
}

void drawing_close_path(Drawing *drawing)
{
    add_step(drawing, DRAWING_CLOSE, NULL, 0);
}

/* Text. */

/* The outline of a glyph. */
static void add_glyph(Drawing *drawing, const stbtt_fontinfo *font, int glyph, DrawingPoint at,
                      double scale)
{
    stbtt_vertex *vertices;
    DrawingPoint last = at;
    const int count = stbtt_GetGlyphShape(font, glyph, &vertices);
    for (int i = 0; i < count; i++) {
        const stbtt_vertex *v = &vertices[i];
        const DrawingPoint to = {at.x + scale * v->x, at.y - scale * v->y};
        const DrawingPoint by = {at.x + scale * v->cx, at.y - scale * v->cy};
        if (v->type == STBTT_vmove)
            drawing_move(drawing, to);
        else if (v->type == STBTT_vline)
            drawing_line(drawing, to);
        else
            drawing_curve(drawing, (DrawingPoint){(last.x + 2 * by.x) / 3, (last.y + 2 * by.y) / 3},
                          (DrawingPoint){(to.x + 2 * by.x) / 3, (to.y + 2 * by.y) / 3}, to);
        last = to;
    }
    stbtt_FreeShape(font, vertices);
}

/* Measures a text and, if `draws`, adds it to the last path. */
static DrawingBox set_text(const Drawing *drawing, Drawing *to, DrawingPoint at, double size,
                           const char *text)
{
    static const double SMALL = 0.7, RAISED = 0.38, LOWERED = 0.16; /* of the size */
    DrawingBox box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    bool italic = false;
    double share = 1, shift = 0;
    while (*text) {
        const bool script = (text[0] == '^' || text[0] == '_') && text[1] == '{';
        if (*text == '$' || script || (*text == '}' && share < 1)) {
            italic ^= *text == '$';
            shift = script ? (*text == '^' ? RAISED : -LOWERED) : *text == '}' ? 0 : shift;
            share = script ? SMALL : *text == '}' ? 1 : share;
            text += script ? 2 : 1;
            continue;
        }
        const int code = font_character(&text);
        const bool letter = (code | 32) >= 'a' && (code | 32) <= 'z';
        const bool greek = code >= 0x391 && code <= 0x3C9;
        const stbtt_fontinfo *font =
            italic && (letter || greek) ? &drawing->italic.info : &drawing->upright.info;
        const double scale = (double)stbtt_ScaleForMappingEmToPixels(font, (float)(share * size));
        const int glyph = stbtt_FindGlyphIndex(font, code);
        const double y = at.y - shift * size;
        int advance, bearing, left, bottom, right, top;
        if (stbtt_GetGlyphBox(font, glyph, &left, &bottom, &right, &top)) {
            box.left = fmin(box.left, at.x + scale * left);
            box.right = fmax(box.right, at.x + scale * right);
            box.top = fmin(box.top, y - scale * top);
            box.bottom = fmax(box.bottom, y - scale * bottom);
            if (to)
                add_glyph(to, font, glyph, (DrawingPoint){at.x, y}, scale);
        }
        stbtt_GetGlyphHMetrics(font, glyph, &advance, &bearing);
        at.x += scale * advance;
    }
    return box;
}

DrawingBox drawing_text_box(const Drawing *drawing, double size, const char *text)
{
    return set_text(drawing, NULL, (DrawingPoint){0, 0}, size, text);
}

void drawing_text(Drawing *drawing, DrawingPoint at, double size, Vec3 color, const char *text)
{
    drawing_path(drawing, (DrawingStyle){.fill = color, .fill_alpha = 1});
    DrawingLabel *label = ONE_MORE(drawing, labels, label_count, label_room);
    label->box = set_text(drawing, drawing, at, size, text);
    snprintf(label->text, sizeof label->text, "%s", text);
}

/* Files. */

static Plugin cairo = {PLUGIN_DRAWINGS};

static const DrawingPlugin *open_cairo(Message *message)
{
    cache_prepare_driver();
    return plugin_open(&cairo, message);
}

bool drawing_paint(const Drawing *drawing, Image *image, bool transparent, Message *message)
{
    const DrawingPlugin *plugin = open_cairo(message);
    if (!plugin)
        return false;
    const char *reason = plugin->paint(drawing, image, transparent);
    return !reason || message_set(message, "cairo: %s", reason);
}

const char *drawing_format(const char *path)
{
    const char *dot = strrchr(path, '.');
    return !dot                           ? NULL
           : strcasecmp(dot, ".svg") == 0 ? "svg"
           : strcasecmp(dot, ".pdf") == 0 ? "pdf"
                                          : NULL;
}

/* cairo 1.16 numbers its surfaces, so that the second file of a process differs from the first. */
static void drop_surface_number(ImageFile *file)
{
    static const char ID[] = " id=\"surface";
    char *bytes = (char *)file->bytes;
    char *id = memmem(bytes, file->size, ID, sizeof ID - 1);
    char *end = id ? memchr(id, '>', file->size - (size_t)(id - bytes)) : NULL;
    if (!end)
        return;
    memmove(id, end, file->size - (size_t)(end - bytes));
    file->size -= (size_t)(end - id);
}

bool drawing_encode(const Drawing *drawing, const char *format, bool transparent, ImageFile *file,
                    Message *message)
{
    const DrawingPlugin *plugin = open_cairo(message);
    char *bytes = NULL;
    *file = (ImageFile){0};
    if (!plugin)
        return false;
    FILE *stream = open_memstream(&bytes, &file->size);
    const char *reason =
        stream ? plugin->encode(drawing, format, transparent, stream) : "not enough memory";
    if (stream && fclose(stream) != 0 && !reason)
        reason = "not enough memory";
    file->bytes = (unsigned char *)bytes;
    if (reason) {
        image_file_close(file);
        return message_set(message, "cairo: cannot write %s: %s", format, reason);
    }
    if (strcmp(format, "svg") == 0)
        drop_surface_number(file);
    return true;
}

bool drawing_write(const Drawing *drawing, const char *path, const char *format, bool transparent,
                   Message *message)
{
    ImageFile file;
    if (!drawing_encode(drawing, format, transparent, &file, message))
        return false;
    const bool written = output_write(path, file.bytes, file.size, message);
    image_file_close(&file);
    return written;
}
