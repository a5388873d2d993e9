#include "gallery/sheet.h"

#include "images/label.h"

#include <math.h>
#include <stdio.h>

/* The contact sheet: thumbnails in rows, with labels below. In pixels. */
enum { COLUMNS = 5, THUMBNAIL = 200, MARGIN = 10, LABEL = 22, LABEL_SIZE = 12 };

/* Each pixel of a thumbnail is the mean of the whole pixels that it covers, at least one. */
static void shrink(const Image *image, unsigned char *to, size_t stride, int width, int height)
{
    const size_t row_size = image_row_size(image);
    for (int y = 0; y < height; y++) {
        const int y0 = y * image->height / height;
        const int y1 = (y + 1) * image->height / height;
        const int rows = y1 > y0 ? y1 - y0 : 1;
        unsigned char *pixel = to + (size_t)y * stride;
        for (int x = 0, x0 = 0; x < width; x++, pixel += 4) {
            const int x1 = (x + 1) * image->width / width;
            const int columns = x1 > x0 ? x1 - x0 : 1;
            const unsigned count = (unsigned)(rows * columns);
            unsigned red = count / 2, green = count / 2, blue = count / 2;
            const unsigned char *row =
                (unsigned char *)image->pixels + (size_t)y0 * row_size + 4 * (size_t)x0;
            for (int j = 0; j < rows; j++, row += row_size) {
                for (int i = 0; i < columns; i++) {
                    red += row[4 * i];
                    green += row[4 * i + 1];
                    blue += row[4 * i + 2];
                }
            }
            pixel[0] = (unsigned char)(red / count);
            pixel[1] = (unsigned char)(green / count);
            pixel[2] = (unsigned char)(blue / count);
            pixel[3] = 255;
            x0 = x1;
        }
    }
}

bool sheet_open(Image *sheet, int count, Message *message)
{
    const int columns = count < COLUMNS ? count : COLUMNS;
    const int rows = (count + COLUMNS - 1) / COLUMNS;
    if (!image_open(sheet, MARGIN + columns * (THUMBNAIL + MARGIN),
                    MARGIN + rows * (THUMBNAIL + LABEL + MARGIN), IMAGE_BYTE, message))
        return false;
    image_fill(sheet, NULL, (const unsigned char[3]){48, 48, 48});
    return true;
}

static void sheet_place(int index, int *x, int *y)
{
    *x = MARGIN + index % COLUMNS * (THUMBNAIL + MARGIN);
    *y = MARGIN + index / COLUMNS * (THUMBNAIL + LABEL + MARGIN);
}

void sheet_put(Image *sheet, int index, const Image *image)
{
    const int longer = image->width > image->height ? image->width : image->height;
    int width = (int)lround((double)THUMBNAIL * image->width / longer);
    int height = (int)lround((double)THUMBNAIL * image->height / longer);
    width = width < 1 ? 1 : width;
    height = height < 1 ? 1 : height;
    int x, y;
    sheet_place(index, &x, &y);
    x += (THUMBNAIL - width) / 2;
    y += (THUMBNAIL - height) / 2;
    const size_t stride = image_row_size(sheet);
    unsigned char *to = (unsigned char *)sheet->pixels + (size_t)y * stride + 4 * (size_t)x;
    shrink(image, to, stride, width, height);
}

void sheet_label(Image *sheet, const Example *const *examples, int count)
{
    for (int i = 0; i < count; i++) {
        int x, y;
        Message message = {0};
        sheet_place(i, &x, &y);
        if (!image_label(sheet, x + THUMBNAIL / 2, y + THUMBNAIL + 15, LABEL_SIZE,
                         examples[i]->name, &message)) {
            fprintf(stderr, "gallery: the contact sheet has no labels: %s\n", message.text);
            return;
        }
    }
}
