#include "images/label.h"
#include "reference/picture_error.h"
#include "study/report/report.h"

#include <math.h>
#include <string.h>

enum {
    PANELS = 3,
    MIN_PANEL = 320, /* the width up to which small pictures are enlarged */
    MARGIN = 10,
    LETTERS = 14, /* the height of text */
    LINE = 22,
    BAR = 16, /* the height of the scale */
    MAX_CAPTION_LINES = 8,
};

typedef struct Color {
    unsigned char red, green, blue;
} Color;

static const Color GROUND = {24, 24, 28};

/* The colour of differences within the rounding to 8 bits. */
static const Color NEUTRAL = {52, 52, 56};
static const Color UNDEFINED = {255, 0, 255};
static const double ROUNDING = 0.5, FULL = 255;

/* The layout of a sheet, in pixels. */
typedef struct Sheet {
    Image image;
    int scale;         /* the side of a picture's pixel */
    int width, height; /* of a panel */
} Sheet;

/* Viridis (van der Walt and Smith, 2015): perceptually uniform in lightness. */
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

/* The position of a difference, in steps of 1/255, on the logarithmic scale 0..1. */
static double scale_of(double difference)
{
    return log(difference / ROUNDING) / log(FULL / ROUNDING);
}

static Color color_of(double difference)
{
    /* The tolerance is that of a float. */
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

/* Whether every channel is finite. */
static bool is_finite(const Image *image, size_t pixel)
{
    return isfinite(channel(image, 4 * pixel)) && isfinite(channel(image, 4 * pixel + 1)) &&
           isfinite(channel(image, 4 * pixel + 2));
}

/* The colour of a pixel in a panel. */
static Color panel_color(int panel, const Image *drawn, const Reference *exact, size_t pixel)
{
    double shown[3];
    if (panel == 2)
        return is_finite(drawn, pixel)
                   ? color_of(pixel_error(drawn, pixel, &exact->color[3 * pixel]).largest)
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

static void put_panel(Sheet *sheet, int panel, const Image *drawn, const Reference *exact)
{
    static const char *const titles[PANELS] = {"drawn", "exact", "difference, in steps of 1/255"};
    const int left = panel_left(sheet, panel), top = MARGIN + LINE;
    image_label(&sheet->image, left + sheet->width / 2, MARGIN + LETTERS, LETTERS, titles[panel],
                NULL);
    for (int y = 0; y < exact->height; y++)
        for (int x = 0; x < exact->width; x++)
            fill(&sheet->image, left + x * sheet->scale, top + y * sheet->scale, sheet->scale,
                 sheet->scale,
                 panel_color(panel, drawn, exact, (size_t)y * (size_t)exact->width + (size_t)x));
}

/* The scale below the difference: grey for rounding, then the colours up to 255. */
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
    image_label(&sheet->image, left, top + BAR + LINE - 6, LETTERS - 2, "0", NULL);
    fill(&sheet->image, left, top + BAR, 1, 4, white);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char text[16];
        const int x = start + (int)lround(scale_of(numbers[i]) * (width - neutral - 1));
        snprintf(text, sizeof text, "%g", numbers[i]);
        fill(&sheet->image, x, top + BAR, 1, 4, white);
        image_label(&sheet->image, x, top + BAR + LINE - 6, LETTERS - 2, text, NULL);
    }
}

/* Wraps a caption to the sheet's width; returns the number of lines. */
static int break_lines(const char *caption, int width, char lines[MAX_CAPTION_LINES][512])
{
    const int max = (int)fmin(511, width / (0.6 * LETTERS));
    int count = 0, used = 0;
    for (const char *word = caption; *word && count < MAX_CAPTION_LINES;) {
        const int length = (int)strcspn(word, " \n");
        if (used && used + 1 + length > max) {
            count++;
            used = 0;
            continue;
        }
        used += snprintf(lines[count] + used, (size_t)(512 - used), "%s%.*s", used ? " " : "",
                         (int)fmin(length, max), word);
        if (word[length] == '\n') {
            count++;
            used = 0;
        }
        word += length + (word[length] != '\0');
    }
    return count + (used > 0);
}

static void put_caption(Sheet *sheet, char lines[MAX_CAPTION_LINES][512], int count)
{
    const int top = 2 * MARGIN + LINE + sheet->height + BAR + LINE + MARGIN;
    for (int i = 0; i < count; i++)
        image_label(&sheet->image, sheet->image.width / 2, top + i * LINE + LETTERS, LETTERS,
                    lines[i], NULL);
}

/* The mean of a panel's colors over one pixel of a small picture. */
static Color mean_color(int panel, const Image *drawn, const Reference *exact, int x, int y,
                        int height)
{
    enum { SIDE = 4 };
    int red = 0, green = 0, blue = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int across = 2 * (SIDE * x + i % SIDE) + 1, down = 2 * (SIDE * y + i / SIDE) + 1;
        const size_t column = (size_t)(across * exact->width / (2 * SIDE * REPORT_PANEL));
        const size_t row = (size_t)(down * exact->height / (2 * SIDE * height));
        const Color color = panel_color(panel, drawn, exact, row * (size_t)exact->width + column);
        red += color.red;
        green += color.green;
        blue += color.blue;
    }
    return (Color){(unsigned char)(red / (SIDE * SIDE)), (unsigned char)(green / (SIDE * SIDE)),
                   (unsigned char)(blue / (SIDE * SIDE))};
}

bool report_pair(const Image *drawn, const Reference *exact, const char *path, Message *message)
{
    Image pair;
    const int height = (REPORT_PANEL * exact->height + exact->width - 1) / exact->width;
    if (!image_open(&pair, 2 * REPORT_PANEL + REPORT_GAP, height, IMAGE_BYTE, message))
        return false;
    fill(&pair, 0, 0, pair.width, height, (Color){255, 255, 255});
    for (int side = 0; side < 2; side++)
        for (int y = 0; y < height; y++)
            for (int x = 0; x < REPORT_PANEL; x++)
                fill(&pair, side * (REPORT_PANEL + REPORT_GAP) + x, y, 1, 1,
                     mean_color(side ? 2 : 0, drawn, exact, x, y, height));
    const bool done =
        image_write(&pair, path, &(ImageOptions){.compress = IMAGE_COMPRESS_DEFAULT}, message);
    image_close(&pair);
    return done;
}

bool report_sheet(const Image *drawn, const Reference *exact, const char *caption, const char *path,
                  Message *message)
{
    char lines[MAX_CAPTION_LINES][512] = {{0}};
    Sheet sheet = {.scale = 1};
    if (drawn->width != exact->width || drawn->height != exact->height)
        return message_set(message, "%s: the drawn picture has %dx%d pixels, the exact one %dx%d",
                           path, drawn->width, drawn->height, exact->width, exact->height);
    sheet.scale = (MIN_PANEL + exact->width - 1) / exact->width;
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
