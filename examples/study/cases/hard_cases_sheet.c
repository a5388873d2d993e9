#include "study/cases/hard_cases_sheet.h"

#include "images/label.h"

#include <math.h>
#include <stdio.h>

enum {
    PANELS = 3,
    GAP = 8,     /* between the panels of a case */
    MARGIN = 28, /* between cases */
    TITLE = 24,  /* the height of letters */
    TITLE_LINE = 38,
    TEXT = 20,
    TEXT_LINE = 26,
    TEXT_LINES = 4,
};

typedef struct Sheet {
    Image image;
    int width, height; /* of a panel */
} Sheet;

void hard_cost_text(const HardResult *result, char text[HARD_COST_SIZE])
{
    if (fabs(result->cost) <= result->noise)
        snprintf(text, HARD_COST_SIZE, "within the noise");
    else
        snprintf(text, HARD_COST_SIZE, "%+.0f%% (noise %.0f%%)", 100 * result->cost,
                 ceil(100 * result->noise));
}

static unsigned char *pixel_of(const Image *image, int x, int y)
{
    return (unsigned char *)image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static void put_pixel(Sheet *sheet, int x, int y, const unsigned char color[3])
{
    unsigned char *pixel = pixel_of(&sheet->image, x, y);
    for (int c = 0; c < 3; c++)
        pixel[c] = color[c];
    pixel[3] = 255;
}

static void put_panel(Sheet *sheet, const HardResult *result, int panel, int left, int top)
{
    const Reference *exact = &result->exact;
    for (int y = 0; y < sheet->height; y++) {
        for (int x = 0; x < sheet->width; x++) {
            const int from_x = x * exact->width / sheet->width;
            const int from_y = y * exact->height / sheet->height;
            if (panel < 2) {
                put_pixel(sheet, left + x, top + y,
                          pixel_of(panel ? &result->stable : &result->naive, from_x, from_y));
                continue;
            }
            const float *color = &exact->color[3 * (from_y * exact->width + from_x)];
            unsigned char bytes[3];
            for (int c = 0; c < 3; c++)
                bytes[c] = (unsigned char)lrintf(255 * color[c]);
            put_pixel(sheet, left + x, top + y, bytes);
        }
    }
}

static int case_width(const Sheet *sheet)
{
    return PANELS * sheet->width + (PANELS - 1) * GAP;
}

static int case_height(const Sheet *sheet)
{
    return TITLE_LINE + sheet->height + TEXT_LINES * TEXT_LINE + GAP;
}

/* Only significant digits. */
static void error_text(double error, char text[48])
{
    snprintf(text, 48, error < 10 ? "off by %.1f steps" : "off by %.0f steps", error);
}

static void put_case(Sheet *sheet, const HardResult *result, int left, int top)
{
    char lines[PANELS][TEXT_LINES][64] = {{{0}}};
    char cost[HARD_COST_SIZE], title[128];
    hard_cost_text(result, cost);
    snprintf(title, sizeof title, "%s: %s", result->of->name, result->of->what);
    snprintf(lines[0][0], sizeof lines[0][0], "naive");
    snprintf(lines[0][1], sizeof lines[0][1], "%s", result->of->naive);
    error_text(result->naive_error.maximum, lines[0][2]);
    snprintf(lines[0][3], sizeof lines[0][3], "%.*f%% of pixels wrong",
             result->naive_error.wrong < 0.1 ? 1 : 0, 100 * result->naive_error.wrong);
    snprintf(lines[1][0], sizeof lines[1][0], "stable");
    snprintf(lines[1][1], sizeof lines[1][1], "%s", result->of->stable);
    error_text(result->stable_error.maximum, lines[1][2]);
    snprintf(lines[1][3], sizeof lines[1][3], "time %s", cost);
    snprintf(lines[2][0], sizeof lines[2][0], "exact");
    image_label(&sheet->image, left + case_width(sheet) / 2, top + TITLE, TITLE, title, NULL);
    for (int panel = 0; panel < PANELS; panel++) {
        const int x = left + panel * (sheet->width + GAP);
        put_panel(sheet, result, panel, x, top + TITLE_LINE);
        for (int line = 0; line < TEXT_LINES; line++)
            image_label(&sheet->image, x + sheet->width / 2,
                        top + TITLE_LINE + sheet->height + (line + 1) * TEXT_LINE, TEXT,
                        lines[panel][line], NULL);
    }
}

bool hard_sheet(const HardResult *results, int count, int columns, int width, int height,
                const char *path, Message *message)
{
    static const unsigned char ground[3] = {24, 24, 28};
    Sheet sheet = {.width = width, .height = height};
    const int rows = (count + columns - 1) / columns;
    if (!image_open(&sheet.image, MARGIN + columns * (case_width(&sheet) + MARGIN),
                    MARGIN + rows * (case_height(&sheet) + MARGIN), IMAGE_BYTE, message))
        return false;
    for (int y = 0; y < sheet.image.height; y++)
        for (int x = 0; x < sheet.image.width; x++)
            put_pixel(&sheet, x, y, ground);
    for (int i = 0; i < count; i++)
        put_case(&sheet, &results[i], MARGIN + i % columns * (case_width(&sheet) + MARGIN),
                 MARGIN + i / columns * (case_height(&sheet) + MARGIN));
    const bool done = image_write(&sheet.image, path,
                                  &(ImageOptions){.compress = IMAGE_COMPRESS_DEFAULT}, message);
    image_close(&sheet.image);
    return done;
}
