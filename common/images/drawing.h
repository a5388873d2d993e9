/*
 * drawing: a figure of lines, areas and text, as a list of paths; painted into an image, or written
 * as SVG or PDF.
 *
 * Units are pixels of the picture (of SVG too; points of PDF), from its upper left corner. Text
 * becomes the outlines of its letters, in Liberation Serif, so that a file looks the same where
 * that font is missing, and its size is known before it is drawn. Building a list needs the font's
 * files alone; painting and writing load the plugin that links cairo.
 */
#ifndef DRAWING_H
#define DRAWING_H

#include "images/drawing_list.h"
#include "images/image_file.h"

/* An empty drawing. Fails without the fonts. A zeroed one can be closed. */
bool drawing_begin(Drawing *drawing, double width, double height, Message *message);
void drawing_end(Drawing *drawing);

/* Adds a path, to which the steps that follow belong. */
void drawing_path(Drawing *drawing, DrawingStyle style);
void drawing_move(Drawing *drawing, DrawingPoint to);
void drawing_line(Drawing *drawing, DrawingPoint to);
void drawing_curve(Drawing *drawing, DrawingPoint a, DrawingPoint b, DrawingPoint to);
void drawing_close_path(Drawing *drawing);

/* Texts are UTF-8; letters between two $ are italic, and ^{...} and _{...} are raised and lowered.
 * The box of a text is that of its ink, `size` pixels per em, for a baseline that begins at 0,0. */
DrawingBox drawing_text_box(const Drawing *drawing, double size, const char *text);

/* Adds a text with its baseline's beginning at `at`. */
void drawing_text(Drawing *drawing, DrawingPoint at, double size, Vec3 color, const char *text);

/* "svg" or "pdf", as a path's extension has it; NULL: neither. */
const char *drawing_format(const char *path);

/* Paints a drawing over white, or over nothing if `transparent`, into a byte image of any size, to
 * which it is scaled. */
bool drawing_paint(const Drawing *drawing, Image *image, bool transparent, Message *message);

/* Encodes to memory: equal drawings become equal bytes. */
bool drawing_encode(const Drawing *drawing, const char *format, bool transparent, ImageFile *file,
                    Message *message);

/* drawing_encode and output_write. */
bool drawing_write(const Drawing *drawing, const char *path, const char *format, bool transparent,
                   Message *message);

#endif
