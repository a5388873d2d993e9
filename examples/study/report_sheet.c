#include "report.h"

#include "reference_error.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PANELS = 3,
    LEAST_PANEL = 320, /* the width up to which small pictures are enlarged */
    MARGIN = 10,
    LETTERS = 14, /* the height of text */
    LINE = 22,
    BAR = 16, /* the height of the scale */
    MOST_CAPTION_LINES = 8,
};

typedef struct Color {
    unsigned char red, green, blue;
} Color;

static const Color GROUND = {24, 24, 28};

/* Differences that rounding to 8 bits makes are all of this colour. */
static const Color NEUTRAL = {52, 52, 56};
static const Color UNDEFINED = {255, 0, 255};
static const double ROUNDING = 0.5, FULL = 255;

/* How a sheet is laid out, in pixels. */
typedef struct Sheet {
    Image image;
    int scale;         /* the side of a picture's pixel */
    int width, height; /* of a panel */
    bool silent;       /* text cannot be written here */
} Sheet;

/* Viridis (van der Walt and Smith, 2015), which is as much lighter as t is larger. */
static Color viridis(double t)
{
    static const Color stops[] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                  {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                  {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
    enum { PARTS = (int)(sizeof stops / sizeof stops[0]) - 1 };
    const double place = fmin(fmax(t, 0), 1) * PARTS;
    const int part = place < PARTS ? (int)place : PARTS - 1;
    const double share = place - part;
    const Color a = stops[part], b = stops[part + 1];
    return (Color){(unsigned char)lround(a.red + share * (b.red - a.red)),
                   (unsigned char)lround(a.green + share * (b.green - a.green)),
                   (unsigned char)lround(a.blue + share * (b.blue - a.blue))};
}

/* Where a difference, in steps of 1/255, is on the scale, 0 to 1; logarithmic. */
static double scale_of(double difference)
{
    return log(difference / ROUNDING) / log(FULL / ROUNDING);
}

static Color color_of(double difference)
{
    /* A hair more than half a step is what rounding makes of a float. */
    return difference <= ROUNDING + 1e-3 ? NEUTRAL : viridis(scale_of(difference));
}

static double channel(const Image *image, size_t index)
{
    return image->type == IMAGE_FLOAT ? (double)((const float *)image->pixels)[index]
                                      : ((const unsigned char *)image->pixels)[index] / 255.0;
}

static unsigned char to_byte(double value)
{
    return (unsigned char)(value > 0 ? lround(255 * fmin(value, 1)) : 0);
}

/* Whether every channel is a number. */
static bool is_finite(const Image *image, size_t pixel)
{
    return isfinite(channel(image, 4 * pixel)) && isfinite(channel(image, 4 * pixel + 1)) &&
           isfinite(channel(image, 4 * pixel + 2));
}

/* The colour of a panel's pixel. */
static Color panel_color(int panel, const Image *drawn, const Reference *exact, size_t pixel)
{
    double shown[3];
    if (panel == 2)
        return is_finite(drawn, pixel)
                   ? color_of(reference_pixel_error(drawn, pixel, exact, pixel).largest)
                   : UNDEFINED;
    for (size_t i = 0; i < 3; i++)
        shown[i] = panel == 0 ? channel(drawn, 4 * pixel + i) : (double)exact->color[3 * pixel + i];
    return (Color){to_byte(shown[0]), to_byte(shown[1]), to_byte(shown[2])};
}

static void fill(Image *image, int left, int top, int width, int height, Color color)
{
    for (int y = top; y < top + height; y++) {
        unsigned char *pixel =
            (unsigned char *)image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)left);
        for (int x = 0; x < width; x++, pixel += 4) {
            pixel[0] = color.red;
            pixel[1] = color.green;
            pixel[2] = color.blue;
            pixel[3] = 255;
        }
    }
}

static int panel_left(const Sheet *sheet, int panel)
{
    return MARGIN + panel * (sheet->width + MARGIN);
}

/* The first text that cannot be written is the last that is tried. */
static void put_text(Sheet *sheet, int x, int baseline, int size, const char *text)
{
    Message ignored = {0};
    if (!sheet->silent && text[0])
        sheet->silent = !image_label(&sheet->image, x, baseline, size, text, &ignored);
}

static void put_panel(Sheet *sheet, int panel, const Image *drawn, const Reference *exact)
{
    static const char *const titles[PANELS] = {"drawn", "exact", "difference, in steps of 1/255"};
    const int left = panel_left(sheet, panel), top = MARGIN + LINE;
    put_text(sheet, left + sheet->width / 2, MARGIN + LETTERS, LETTERS, titles[panel]);
    for (int y = 0; y < exact->height; y++)
        for (int x = 0; x < exact->width; x++)
            fill(&sheet->image, left + x * sheet->scale, top + y * sheet->scale, sheet->scale,
                 sheet->scale,
                 panel_color(panel, drawn, exact, (size_t)y * (size_t)exact->width + (size_t)x));
}

/* Below the difference: first what rounding makes, then the colours up to 255. */
static void put_scale(Sheet *sheet)
{
    static const double numbers[] = {0.5, 1, 2, 5, 10, 20, 50, 100, 255};
    const Color white = {255, 255, 255};
    const int top = 2 * MARGIN + LINE + sheet->height;
    const int width = sheet->width - 2 * MARGIN, neutral = width / 10;
    const int left = panel_left(sheet, 2) + MARGIN, start = left + neutral;
    fill(&sheet->image, left, top, neutral, BAR, NEUTRAL);
    for (int x = start; x < left + width; x++)
        fill(&sheet->image, x, top, 1, BAR, viridis((x - start + 0.5) / (width - neutral)));
    put_text(sheet, left, top + BAR + LINE - 6, LETTERS - 2, "0");
    fill(&sheet->image, left, top + BAR, 1, 4, white);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char text[16];
        const int x = start + (int)lround(scale_of(numbers[i]) * (width - neutral - 1));
        snprintf(text, sizeof text, "%g", numbers[i]);
        fill(&sheet->image, x, top + BAR, 1, 4, white);
        put_text(sheet, x, top + BAR + LINE - 6, LETTERS - 2, text);
    }
}

/* Breaks a caption into lines that a sheet has room for. */
static int break_lines(const char *caption, int width, char lines[MOST_CAPTION_LINES][512])
{
    const int most = (int)fmin(511, width / (0.6 * LETTERS));
    int count = 0, used = 0;
    for (const char *word = caption; *word && count < MOST_CAPTION_LINES;) {
        const int length = (int)strcspn(word, " \n");
        if (used && used + 1 + length > most) {
            count++;
            used = 0;
            continue;
        }
        used += snprintf(lines[count] + used, (size_t)(512 - used), "%s%.*s", used ? " " : "",
                         (int)fmin(length, most), word);
        if (word[length] == '\n') {
            count++;
            used = 0;
        }
        word += length + (word[length] != '\0');
    }
    return count + (used > 0);
}

static void put_caption(Sheet *sheet, char lines[MOST_CAPTION_LINES][512], int count)
{
    const int top = 2 * MARGIN + LINE + sheet->height + BAR + LINE + MARGIN;
    for (int i = 0; i < count; i++)
        put_text(sheet, sheet->image.width / 2, top + i * LINE + LETTERS, LETTERS, lines[i]);
}

bool report_sheet(const Image *drawn, const Reference *exact, const char *caption, const char *path,
                  Message *message)
{
    char lines[MOST_CAPTION_LINES][512] = {{0}};
    Sheet sheet = {.scale = 1};
    if (drawn->width != exact->width || drawn->height != exact->height)
        return message_set(message, "%s: the drawn picture has %dx%d pixels, the exact one %dx%d",
                           path, drawn->width, drawn->height, exact->width, exact->height);
    sheet.scale = (LEAST_PANEL + exact->width - 1) / exact->width;
    sheet.width = sheet.scale * exact->width;
    sheet.height = sheet.scale * exact->height;
    const int width = PANELS * (sheet.width + MARGIN) + MARGIN;
    const int count = break_lines(caption, width - 2 * MARGIN, lines);
    const int height = 3 * MARGIN + LINE + sheet.height + BAR + LINE + MARGIN + count * LINE;
    if (!image_open(&sheet.image, width, height, IMAGE_BYTE, message))
        return false;
    fill(&sheet.image, 0, 0, width, height, GROUND);
    for (int panel = 0; panel < PANELS; panel++)
        put_panel(&sheet, panel, drawn, exact);
    put_scale(&sheet);
    put_caption(&sheet, lines, count);
    const ImageText text[] = {{"Description", caption}, {NULL, NULL}};
    const bool done = image_write(
        &sheet.image, path,
        &(ImageOptions){.compress = IMAGE_COMPRESS_DEFAULT, .text = caption[0] ? text : NULL},
        message);
    image_close(&sheet.image);
    return done;
}
