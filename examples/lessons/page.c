#include "lessons/page.h"

#include "images/label.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* On a dark page and on a light one; at least 7:1 against it, for projectors. */
static const unsigned char BACKGROUND[][3] = {{16, 18, 22}, {255, 255, 255}};
static const TextStyle CAPTION[] = {{.color = {240, 242, 246}}, {.color = {20, 20, 24}}};
static const TextStyle LINES[][2] = {
    [CHANGE_SAME] = {{.color = {195, 200, 210}}, {.color = {70, 72, 80}}},
    [CHANGE_REMOVED] = {{.color = {255, 165, 155}}, {.color = {160, 0, 0}}},
    [CHANGE_ADDED] = {{.color = {140, 240, 150}}, {.color = {0, 90, 20}}},
    [CHANGE_GAP] = {{.color = {180, 185, 195}}, {.color = {80, 82, 90}}},
    [CHANGE_TITLE] = {{.color = {165, 210, 255}}, {.color = {0, 60, 150}}},
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
static bool paint_line(Image *page, Strip at, TextStyle style, const ChangeLine *line,
                       Message *message)
{
    char text[CHANGE_TEXT_SIZE + 8];
    const int fit = (int)(at.width / (style.size * IMAGE_MONO_ADVANCE));
    if (snprintf(text, sizeof text, "%s%s", MARKS[line->kind], line->text) > fit)
        snprintf(text + most(0, fit - 3), 4, "...");
    return image_text(page, at.x, at.y, &style, text, message);
}

bool page_paint_lines(Image *page, const Changes *changes, bool light, Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    const Columns columns = choose_columns(changes, &layout, page->width, page->height);
    const int step = (int)(LINE_HEIGHT * columns.letters);
    const int rows = (page->height - layout.text_top) / step;
    const int width = column_width(columns.count, &layout, page->width);
    bool done = true;
    image_fill(page, NULL, BACKGROUND[light]);
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
            TextStyle style = LINES[line.kind][light];
            style.size = columns.letters;
            style.mono = true;
            done = paint_line(page, at, style, &line, message);
        }
    }
    return done;
}

static void put(Image *page, int left, int top, const Image *picture)
{
    for (int y = 0; y < picture->height && top + y < page->height; y++)
        for (int x = 0; x < picture->width && left + x < page->width; x++) {
            const size_t at = (size_t)y * (size_t)picture->width + (size_t)x;
            const size_t to = (size_t)(top + y) * (size_t)page->width + (size_t)(left + x);
            memcpy((unsigned char *)page->pixels + 4 * to,
                   (const unsigned char *)picture->pixels + 4 * at, 3);
        }
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

bool page_paint_picture(Image *page, int number, const Image *picture, const char *name, bool light,
                        Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    put(page, layout.left[number], layout.top, picture);
    const Strip at = {layout.left[number], layout.top - layout.letters / 3, layout.side};
    return paint_caption(page, CAPTION[light], layout.letters, at, name, message);
}

bool page_paint_captions(Image *page, const char *title, const char *below, bool light,
                         Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    const int width = page->width - 2 * layout.margin;
    const int down = 6 * layout.letters / 5;
    const Strip at = {layout.margin, down, width};
    const Strip under = {layout.margin, layout.top + layout.side + down, width};
    return paint_caption(page, CAPTION[light], layout.letters, at, title, message) &&
           paint_caption(page, LINES[CHANGE_SAME][light], layout.letters, under, below, message);
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
