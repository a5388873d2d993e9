#include "lessons/page.h"

#include "images/label.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const unsigned char BACKGROUND[3] = {24, 26, 30};
static const TextStyle CAPTION = {.color = {230, 232, 236}}, BELOW = {.color = {180, 185, 195}};
static const TextStyle LINES[] = {
    [CHANGE_SAME] = {.mono = true, .color = {165, 170, 180}},
    [CHANGE_REMOVED] = {.mono = true, .color = {255, 140, 130}},
    [CHANGE_ADDED] = {.mono = true, .color = {120, 225, 130}},
    [CHANGE_GAP] = {.mono = true, .color = {150, 155, 165}},
    [CHANGE_TITLE] = {.mono = true, .color = {140, 190, 255}},
};
static const char *const MARKS[] = {"  ", "- ", "+ ", "  ...", ""};

static const double LINE_HEIGHT = 1.3; /* in em */

static int most(int a, int b)
{
    return a > b ? a : b;
}

PageLayout page_layout(int width, int height)
{
    enum { MARGINS = 64, WIDTHS = 53, SMALLEST = 7 };
    const int unit = width < 4 * height / 3 ? width : 4 * height / 3; /* as wide as designed */
    PageLayout layout = {.margin = most(2, unit / MARGINS),
                         .letters = most(SMALLEST, unit / WIDTHS)};
    const int caption = 3 * layout.letters / 2, gaps = (PAGE_PICTURES + 1) * layout.margin;
    const int wide = (width - gaps) / PAGE_PICTURES;
    const int high = height / 2 - 2 * caption;
    layout.side = most(1, wide < high ? wide : high);
    layout.top = 2 * caption;
    layout.text_top = layout.top + layout.side + caption;
    for (int i = 0; i < PAGE_PICTURES; i++)
        layout.left[i] =
            layout.margin + i * (most(1, wide) + layout.margin) + (most(1, wide) - layout.side) / 2;
    return layout;
}

/* Columns of lines: number i begins with line first[i]. */
enum { MAX_COLUMNS = 3 };
typedef struct Columns {
    int count, first[MAX_COLUMNS + 1], rows, letters;
} Columns;

/* Where a column of so many rows ends that begins with line `first`: before a file's title if that
 * is in its second half, never after one. */
static int column_end(const Changes *changes, int first, int rows)
{
    const int end = first + rows;
    if (end >= changes->count)
        return changes->count;
    for (int i = end; i > first + rows / 2; i--)
        if (changes->lines[i].kind == CHANGE_TITLE)
            return i;
    return rows > 1 && changes->lines[end - 1].kind == CHANGE_TITLE ? end - 1 : end;
}

/* The fewest rows, from so many on, in which so many columns have all lines. */
static Columns split_columns(const Changes *changes, int count, int rows)
{
    Columns columns = {.count = count, .rows = rows};
    for (;; columns.rows++) {
        for (int i = 0; i < count; i++)
            columns.first[i + 1] = column_end(changes, columns.first[i], columns.rows);
        if (columns.first[count] == changes->count)
            return columns;
    }
}

/* Whether each column begins with a file. */
static bool columns_are_files(const Changes *changes, const Columns *columns)
{
    bool all = true;
    for (int i = 1; i < columns->count; i++) {
        const int first = columns->first[i];
        all &= first == changes->count || changes->lines[first].kind == CHANGE_TITLE;
    }
    return all;
}

static int column_width(int columns, const PageLayout *layout, int width)
{
    return (width - (columns + 1) * layout->margin) / columns;
}

/* As many columns as give the largest letters at which the longest line and all rows fit; each with
 * files of its own if there is room. */
static Columns choose_columns(const Changes *changes, const PageLayout *layout, int width,
                              int height)
{
    enum { SMALLEST = 7 };
    const int room = height - layout->text_top - layout->margin / 2;
    Columns chosen = {.letters = -1};
    int longest = 1;
    for (int i = 0; i < changes->count; i++) {
        const ChangeLine *line = &changes->lines[i];
        longest = most(longest, (int)(strlen(line->text) + strlen(MARKS[line->kind])));
    }
    for (int count = 1; count <= MAX_COLUMNS; count++) {
        Columns columns = split_columns(changes, count, (changes->count + count - 1) / count);
        const double wide = column_width(count, layout, width) / (longest * IMAGE_MONO_ADVANCE);
        const double high = room / (most(1, columns.rows) * LINE_HEIGHT);
        columns.letters = (int)fmin(layout->letters, fmin(wide, high));
        if (columns.letters > chosen.letters)
            chosen = columns;
    }
    const int letters = most(SMALLEST, chosen.letters);
    const int most_rows = (int)(room / (letters * LINE_HEIGHT));
    /* Rather lines that are cut than lines that are missing. */
    if (chosen.letters < SMALLEST && chosen.count == 1 && chosen.rows > most_rows)
        chosen = split_columns(changes, 2, (changes->count + 1) / 2);
    Columns files = chosen;
    for (int rows = chosen.rows; rows <= most_rows && !columns_are_files(changes, &files); rows++)
        files = split_columns(changes, chosen.count, rows);
    if (columns_are_files(changes, &files))
        chosen = files;
    chosen.letters = letters;
    return chosen;
}

/* Where a line of text begins, and how wide it may be. */
typedef struct Strip {
    int x, y, width;
} Strip;

/* A line that is too wide ends in three points. */
static bool paint_line(Image *page, Strip at, int letters, const ChangeLine *line, Message *message)
{
    char text[CHANGE_TEXT_SIZE + 8];
    TextStyle style = LINES[line->kind];
    const int fit = (int)(at.width / (letters * IMAGE_MONO_ADVANCE));
    style.size = letters;
    if (snprintf(text, sizeof text, "%s%s", MARKS[line->kind], line->text) > fit)
        snprintf(text + most(0, fit - 3), 4, "...");
    return image_text(page, at.x, at.y, &style, text, message);
}

bool page_paint_lines(Image *page, const Changes *changes, Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    const Columns columns = choose_columns(changes, &layout, page->width, page->height);
    const int step = (int)(LINE_HEIGHT * columns.letters);
    const int rows = (page->height - layout.text_top) / step;
    const int width = column_width(columns.count, &layout, page->width);
    bool done = true;
    image_fill(page, NULL, BACKGROUND);
    for (int column = 0; column < columns.count; column++) {
        const int first = columns.first[column], end = columns.first[column + 1];
        for (int i = first; i < end && i - first < rows && done; i++) {
            const int row = i - first;
            ChangeLine line = changes->lines[i];
            if (row == rows - 1 && i + 1 < end) {
                line.kind = CHANGE_TITLE;
                snprintf(line.text, sizeof line.text, "%d more lines", end - i);
            }
            const Strip at = {layout.margin + column * (width + layout.margin),
                              layout.text_top + (row + 1) * step - step / 4, width};
            done = paint_line(page, at, columns.letters, &line, message);
        }
    }
    return done;
}

static void copy_opaque(unsigned char *to, const unsigned char *from, int width)
{
    memcpy(to, from, 4 * (size_t)width);
    for (int x = 0; x < width; x++)
        to[4 * x + 3] = 255;
}

static void put(Image *page, int left, int top, const Image *picture)
{
    const int width = left + picture->width > page->width ? page->width - left : picture->width;
    for (int y = 0; y < picture->height && top + y < page->height && width > 0; y++)
        copy_opaque((unsigned char *)page->pixels + (size_t)(top + y) * image_row_size(page) +
                        4 * (size_t)left,
                    (const unsigned char *)picture->pixels + (size_t)y * image_row_size(picture),
                    width);
}

/* In letters with which it is no wider than a picture; none if they could not be read. */
static bool paint_caption(Image *page, TextStyle style, int letters, Strip at, const char *text,
                          Message *message)
{
    const int place[4] = {0, 0, at.width + 4, 3 * (letters + 2)};
    style.size = letters;
    return image_caption_size(place, text, &style.size, message) &&
           (style.size == 0 || image_text(page, at.x, at.y, &style, text, message));
}

bool page_paint_picture(Image *page, int number, const Image *picture, const char *name,
                        Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    put(page, layout.left[number], layout.top, picture);
    const Strip at = {layout.left[number], layout.top - layout.letters / 3, layout.side};
    return paint_caption(page, CAPTION, layout.letters, at, name, message);
}

bool page_paint_captions(Image *page, const char *title, const char *below, Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    const int width = page->width - 2 * layout.margin;
    const int down = 6 * layout.letters / 5;
    const Strip at = {layout.margin, down, width};
    const Strip under = {layout.margin, layout.top + layout.side + down, width};
    return paint_caption(page, CAPTION, layout.letters, at, title, message) &&
           paint_caption(page, BELOW, layout.letters, under, below, message);
}

PageDifference page_difference(const Image *before, const Image *after, Image *difference)
{
    const unsigned char *a = before->pixels, *b = after->pixels;
    const size_t count = (size_t)before->width * (size_t)before->height;
    unsigned char *to = difference->pixels;
    PageDifference found = {.largest = 0};
    for (size_t i = 0; i < 4 * count; i += 4) {
        int largest = 0;
        for (size_t c = i; c < i + 3; c++) {
            to[c] = (unsigned char)abs(a[c] - b[c]);
            largest = most(largest, to[c]);
        }
        to[i + 3] = 255;
        found.pixels += largest > 0;
        found.largest = most(found.largest, largest);
        if (a[i + 3] == 255 && b[i + 3] == 255)
            found.inside = most(found.inside, largest);
    }
    found.factor = 255 / most(1, found.inside ? found.inside : found.largest);
    for (size_t i = 0; i < 4 * count; i++) {
        const int scaled = found.factor * to[i];
        to[i] = (unsigned char)(scaled < 255 ? scaled : 255);
    }
    return found;
}
