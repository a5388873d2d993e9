#include "base/output_text.h"
#include "base/text.h"
#include "images/label.h"
#include "reference/picture_error.h"
#include "study/report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PANELS = 3,
    MIN_PANEL = 320, /* the width up to which small pictures are enlarged */
    MARGIN = 10,
    LETTERS = 14, /* the height of text */
    LINE = 22,
    BAR = 16, /* the height of the scale */
};

typedef struct Color {
    unsigned char of[3];
} Color;

static const Color GROUND = {{24, 24, 28}}, WHITE = {{255, 255, 255}};

/* The colour of differences within the rounding to 8 bits. */
static const Color NEUTRAL = {{52, 52, 56}};
static const Color UNDEFINED = {{255, 0, 255}};
static const double ROUNDING = 0.5, FULL = 255;

/* The layout of a sheet, in pixels. */
typedef struct Sheet {
    Image image;
    int scale;         /* the side of a picture's pixel */
    int width, height; /* of a panel */
} Sheet;

static Color viridis(double t)
{
    Color color;
    image_viridis(t, color.of);
    return color;
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

void report_panel(Image *sheet, const int place[4], const Image *picture)
{
    enum { SIDE = 4 };
    const unsigned char *pixels = picture->pixels;
    for (int n = 0; n < place[2] * place[3]; n++) {
        const int x = n % place[2], y = n / place[2];
        int sums[3] = {0};
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int across = (2 * (SIDE * x + i % SIDE) + 1) * picture->width;
            const int down = (2 * (SIDE * y + i / SIDE) + 1) * picture->height;
            const int column = across / (2 * SIDE * place[2]), row = down / (2 * SIDE * place[3]);
            for (int c = 0; c < 3; c++)
                sums[c] += pixels[4 * (row * picture->width + column) + c];
        }
        unsigned char mean[3];
        for (int c = 0; c < 3; c++)
            mean[c] = (unsigned char)((sums[c] + SIDE * SIDE / 2) / (SIDE * SIDE));
        image_fill(sheet, (int[]){place[0] + x, place[1] + y, 1, 1}, mean);
    }
}

/* The colour of a pixel in a panel. */
static Color panel_color(int panel, const Image *drawn, const Reference *exact, size_t pixel)
{
    Color shown;
    bool finite = true;
    for (size_t c = 0; c < 3; c++) {
        const double of_drawn = channel(drawn, 4 * pixel + c);
        const double value = panel == 0 ? of_drawn : (double)exact->color[3 * pixel + c];
        finite = finite && isfinite(of_drawn);
        shown.of[c] = (unsigned char)(value > 0 ? lround(255 * fmin(value, 1)) : 0);
    }
    if (panel < 2)
        return shown;
    return finite ? color_of(pixel_error(drawn, pixel, &exact->color[3 * pixel]).largest)
                  : UNDEFINED;
}

/* The pictures of the panels. */
static bool open_panels(Image panels[PANELS], const Image *drawn, const Reference *exact,
                        Message *message)
{
    for (int panel = 0; panel < PANELS; panel++) {
        if (!image_open(&panels[panel], exact->width, exact->height, IMAGE_BYTE, message))
            return false;
        for (int i = 0; i < exact->width * exact->height; i++)
            image_fill(&panels[panel], (int[]){i % exact->width, i / exact->width, 1, 1},
                       panel_color(panel, drawn, exact, (size_t)i).of);
    }
    return true;
}

static void close_panels(Image panels[PANELS])
{
    for (int panel = 0; panel < PANELS; panel++)
        image_close(&panels[panel]);
}

static int panel_left(const Sheet *sheet, int panel)
{
    return MARGIN + panel * (sheet->width + MARGIN);
}

static void put_panel(Sheet *sheet, int panel, const Image *picture)
{
    static const char *const titles[PANELS] = {"drawn", "exact", "difference, in steps of 1/255"};
    const int left = panel_left(sheet, panel), top = MARGIN + LINE;
    image_label(&sheet->image, left + sheet->width / 2, MARGIN + LETTERS, LETTERS, titles[panel],
                NULL);
    report_panel(&sheet->image, (int[]){left, top, sheet->width, sheet->height}, picture);
}

/* The scale below the difference: grey for rounding, then the colours up to 255. */
static void put_scale(Sheet *sheet)
{
    static const double numbers[] = {0.5, 1, 2, 5, 10, 20, 50, 100, 255};
    const int top = 2 * MARGIN + LINE + sheet->height;
    const int width = sheet->width - 2 * MARGIN, neutral = width / 10;
    const int left = panel_left(sheet, 2) + MARGIN, start = left + neutral;
    image_fill(&sheet->image, (int[]){left, top, neutral, BAR}, NEUTRAL.of);
    for (int x = start; x < left + width; x++)
        image_fill(&sheet->image, (int[]){x, top, 1, BAR},
                   viridis((x - start + 0.5) / (width - neutral)).of);
    image_label(&sheet->image, left, top + BAR + LINE - 6, LETTERS - 2, "0", NULL);
    image_fill(&sheet->image, (int[]){left, top + BAR, 1, 4}, WHITE.of);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char text[16];
        const int x = start + (int)lround(scale_of(numbers[i]) * (width - neutral - 1));
        snprintf(text, sizeof text, "%g", numbers[i]);
        image_fill(&sheet->image, (int[]){x, top + BAR, 1, 4}, WHITE.of);
        image_label(&sheet->image, x, top + BAR + LINE - 6, LETTERS - 2, text, NULL);
    }
}

/* The caption in lines of the sheet's width, to be freed; how many they are. */
static char *break_lines(const char *caption, int width, int *count)
{
    OutputText lines;
    output_text_open(&lines);
    text_wrap(lines.file, caption, 0, 0, (int)(width / (0.6 * LETTERS)));
    char *text = output_text_close(&lines);
    *count = text[0] != '\0';
    for (const char *at = text; (at = strchr(at, '\n')); at++)
        ++*count;
    return text;
}

bool report_pair(const Image *drawn, const Reference *exact, const char *path, Message *message)
{
    enum { SECOND = REPORT_PANEL + REPORT_GAP };
    Image pair = {.width = 0}, panels[PANELS] = {{.width = 0}};
    const int height = (REPORT_PANEL * exact->height + exact->width - 1) / exact->width;
    bool done = open_panels(panels, drawn, exact, message) &&
                image_open(&pair, 2 * REPORT_PANEL + REPORT_GAP, height, IMAGE_BYTE, message);
    if (done) {
        image_fill(&pair, NULL, WHITE.of);
        report_panel(&pair, (int[]){0, 0, REPORT_PANEL, height}, &panels[0]);
        report_panel(&pair, (int[]){SECOND, 0, REPORT_PANEL, height}, &panels[2]);
        done =
            image_write(&pair, path, &(ImageOptions){.compress = IMAGE_COMPRESS_DEFAULT}, message);
    }
    close_panels(panels);
    image_close(&pair);
    return done;
}

bool report_sheet(const Image *drawn, const Reference *exact, const char *caption, const char *path,
                  Message *message)
{
    int count;
    Sheet sheet = {.scale = 1};
    if (drawn->width != exact->width || drawn->height != exact->height)
        return message_set(message, "%s: the drawn picture has %dx%d pixels, the exact one %dx%d",
                           path, drawn->width, drawn->height, exact->width, exact->height);
    sheet.scale = (MIN_PANEL + exact->width - 1) / exact->width;
    sheet.width = sheet.scale * exact->width;
    sheet.height = sheet.scale * exact->height;
    const int width = PANELS * (sheet.width + MARGIN) + MARGIN;
    char *lines = break_lines(caption, width - 2 * MARGIN, &count);
    const int height = 3 * MARGIN + LINE + sheet.height + BAR + LINE + MARGIN + count * LINE;
    Image panels[PANELS] = {{.width = 0}};
    bool done = open_panels(panels, drawn, exact, message) &&
                image_open(&sheet.image, width, height, IMAGE_BYTE, message);
    if (done) {
        const ImageText text[] = {{"Description", caption}, {NULL, NULL}};
        const ImageOptions options = {.compress = IMAGE_COMPRESS_DEFAULT,
                                      .text = caption[0] ? text : NULL};
        image_fill(&sheet.image, NULL, GROUND.of);
        for (int panel = 0; panel < PANELS; panel++)
            put_panel(&sheet, panel, &panels[panel]);
        put_scale(&sheet);
        int y = 2 * MARGIN + LINE + sheet.height + BAR + LINE + MARGIN + LETTERS;
        for (char *line = strtok(lines, "\n"); line; line = strtok(NULL, "\n"), y += LINE)
            image_label(&sheet.image, sheet.image.width / 2, y, LETTERS, line, NULL);
        done = image_write(&sheet.image, path, &options, message);
    }
    free(lines);
    close_panels(panels);
    image_close(&sheet.image);
    return done;
}
