#include "lessons/page.h"

#include "images/label.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const unsigned char BACKGROUND[3] = {24, 26, 30};
static const TextStyle CAPTION = {.color = {230, 232, 236}}, BELOW = {.color = {165, 170, 180}};
static const TextStyle LINES[] = {
    [CHANGE_SAME] = {.mono = true, .color = {165, 170, 180}},
    [CHANGE_REMOVED] = {.mono = true, .color = {255, 140, 130}},
    [CHANGE_ADDED] = {.mono = true, .color = {120, 225, 130}},
    [CHANGE_GAP] = {.mono = true, .color = {110, 115, 125}},
    [CHANGE_TITLE] = {.mono = true, .color = {140, 190, 255}},
};
static const char *const MARKS[] = {"  ", "- ", "+ ", "  ...", ""};

static const double LINE_HEIGHT = 1.35; /* in em */

static int most(int a, int b)
{
    return a > b ? a : b;
}

PageLayout page_layout(int width, int height)
{
    enum { MARGINS = 64, SMALLEST = 7 };
    const int unit = width < 4 * height / 3 ? width : 4 * height / 3; /* as wide as designed */
    PageLayout layout = {.margin = most(2, unit / MARGINS), .letters = most(SMALLEST, unit / 72)};
    const int caption = 2 * layout.letters, gaps = (PAGE_PICTURES + 1) * layout.margin;
    const int wide = (width - gaps) / PAGE_PICTURES;
    const int high = height / 2 - caption;
    layout.side = most(1, wide < high ? wide : high);
    layout.top = caption;
    layout.text_top = layout.top + layout.side + caption + layout.letters / 2;
    for (int i = 0; i < PAGE_PICTURES; i++)
        layout.left[i] =
            layout.margin + i * (most(1, wide) + layout.margin) + (most(1, wide) - layout.side) / 2;
    return layout;
}

/* One column across the page, or two: the second begins with line `second`. */
typedef struct Columns {
    int count, second, letters;
} Columns;

static int rows_of(const Changes *changes, const Columns *columns)
{
    return columns->count == 1 ? changes->count
                               : most(columns->second, changes->count - columns->second);
}

/* The letters at which the longest line and all rows fit. */
static int letters_that_fit(const Changes *changes, const Columns *columns, int width, int height,
                            int largest)
{
    int longest = 1;
    for (int i = 0; i < changes->count; i++) {
        const ChangeLine *line = &changes->lines[i];
        longest = most(longest, (int)(strlen(line->text) + strlen(MARKS[line->kind])));
    }
    const double wide = width / (longest * IMAGE_MONO_ADVANCE);
    const double high = height / (most(1, rows_of(changes, columns)) * LINE_HEIGHT);
    return (int)fmin(largest, fmin(wide, high));
}

/* The second column begins with the second file, if that is not only its title, else in the middle.
 */
static int second_column(const Changes *changes)
{
    int found = 0;
    for (int i = 1; i < changes->count; i++)
        if (changes->lines[i].kind == CHANGE_TITLE)
            found = found ? -1 : i;
    return found > 1 && found < changes->count - 1 ? found : (changes->count + 1) / 2;
}

static Columns choose_columns(const Changes *changes, const PageLayout *layout, int width,
                              int height)
{
    enum { SMALLEST = 7 };
    const int room = height - layout->text_top - layout->margin / 2;
    const int largest = most(SMALLEST, 4 * layout->letters / 3);
    Columns one = {.count = 1}, two = {.count = 2, .second = second_column(changes)};
    one.letters = letters_that_fit(changes, &one, width - 2 * layout->margin, room, largest);
    two.letters = letters_that_fit(changes, &two, (width - 3 * layout->margin) / 2, room, largest);
    Columns chosen = two.letters >= one.letters ? two : one;
    chosen.letters = most(SMALLEST, chosen.letters);
    return chosen;
}

static bool paint_line(Image *page, int x, int y, int letters, const ChangeLine *line,
                       Message *message)
{
    char text[CHANGE_TEXT_SIZE + 8];
    TextStyle style = LINES[line->kind];
    style.size = letters;
    snprintf(text, sizeof text, "%s%s", MARKS[line->kind], line->text);
    return image_text(page, x, y, &style, text, message);
}

bool page_paint_lines(Image *page, const Changes *changes, Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    const Columns columns = choose_columns(changes, &layout, page->width, page->height);
    const int step = (int)(LINE_HEIGHT * columns.letters);
    const int rows = (page->height - layout.text_top) / step;
    unsigned char *pixels = page->pixels;
    for (size_t i = 0; i < (size_t)page->width * (size_t)page->height; i++) {
        memcpy(pixels + 4 * i, BACKGROUND, 3);
        pixels[4 * i + 3] = 255;
    }
    bool done = true;
    for (int i = 0; i < changes->count && done; i++) {
        const bool second = columns.count == 2 && i >= columns.second;
        const int row = second ? i - columns.second : i;
        const int end = columns.count == 2 && !second ? columns.second : changes->count;
        const int x = second ? (page->width + layout.margin) / 2 : layout.margin;
        ChangeLine line = changes->lines[i];
        if (row >= rows)
            continue;
        if (row == rows - 1 && i + 1 < end) {
            line.kind = CHANGE_TITLE;
            snprintf(line.text, sizeof line.text, "%d more lines", end - i);
        }
        done = paint_line(page, x, layout.text_top + (row + 1) * step - step / 4, columns.letters,
                          &line, message);
    }
    return done;
}

static void put(Image *page, int left, int top, const Image *picture)
{
    const int width = left + picture->width > page->width ? page->width - left : picture->width;
    for (int y = 0; y < picture->height && top + y < page->height && width > 0; y++)
        memcpy((char *)page->pixels + (size_t)(top + y) * image_row_size(page) + 4 * (size_t)left,
               (const char *)picture->pixels + (size_t)y * image_row_size(picture),
               4 * (size_t)width);
}

/* In letters with which it is no wider than a picture; none if they could not be read. */
static bool paint_caption(Image *page, TextStyle style, int letters, int x, int y, int width,
                          const char *text, Message *message)
{
    const int place[4] = {0, 0, width + 4, 3 * (letters + 2)};
    style.size = letters;
    return image_caption_size(place, text, &style.size, message) &&
           (style.size == 0 || image_text(page, x, y, &style, text, message));
}

bool page_paint_picture(Image *page, int number, const Image *picture, const char *above,
                        const char *below, Message *message)
{
    const PageLayout layout = page_layout(page->width, page->height);
    const int left = layout.left[number], bottom = layout.top + layout.side;
    put(page, left, layout.top, picture);
    return (!above ||
            paint_caption(page, CAPTION, layout.letters, left, layout.top - layout.letters / 2,
                          layout.side, above, message)) &&
           (!below || paint_caption(page, BELOW, 4 * layout.letters / 5, left,
                                    bottom + 5 * layout.letters / 4, layout.side, below, message));
}

PageDifference page_difference(const Image *before, const Image *after, Image *difference)
{
    const unsigned char *a = before->pixels, *b = after->pixels;
    const size_t count = (size_t)before->width * (size_t)before->height;
    unsigned char *to = difference->pixels;
    PageDifference found = {.largest = 0};
    for (size_t i = 0; i < count; i++) {
        bool differs = false;
        for (size_t c = 4 * i; c < 4 * i + 3; c++) {
            to[c] = (unsigned char)abs(a[c] - b[c]);
            differs |= to[c] > 0;
            found.largest = most(found.largest, to[c]);
        }
        found.pixels += differs;
    }
    found.factor = 255 / most(1, found.largest);
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 4 * i; c < 4 * i + 3; c++)
            to[c] = (unsigned char)(found.factor * to[c]);
        to[4 * i + 3] = 255;
    }
    return found;
}
