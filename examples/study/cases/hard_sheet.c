#include "study/cases/hard_sheet.h"

#include "images/label.h"
#include "study/report/report.h"

#include <math.h>
#include <stdio.h>

enum {
    PANELS = 3,
    GAP = 8,     /* between the panels of a case */
    MARGIN = 28, /* around the cases */
    HEAD = 26,   /* of the names of the panels, above each column */
    TITLE = 20,  /* the height of letters */
    TITLE_LINE = 30,
    TEXT = 17,
    TEXT_LINE = 26,
    TEXT_LINES = 4,
    TEXT_WIDTH = 372, /* to the right of the panels */
};

/* With more than this the machine is too busy for times. */
static const double NOISE_BOUND = 0.25;

typedef struct Sheet {
    Image image;
    int width, height; /* of a panel */
} Sheet;

void hard_cost_text(const HardResult *result, char text[HARD_COST_SIZE])
{
    /* As they would be printed. */
    const double cost = round(100 * result->cost), noise = ceil(100 * result->noise);
    if (!(result->noise <= NOISE_BOUND))
        snprintf(text, HARD_COST_SIZE, "too noisy to tell");
    else if (fabs(cost) <= noise)
        snprintf(text, HARD_COST_SIZE, "within the noise");
    else
        snprintf(text, HARD_COST_SIZE, "%+.0f%% (noise %.0f%%)", cost, noise);
}

static int panels_width(const Sheet *sheet)
{
    return PANELS * (sheet->width + GAP);
}

static int case_width(const Sheet *sheet)
{
    return panels_width(sheet) + TEXT_WIDTH;
}

/* As high as its text at least. */
static int case_height(const Sheet *sheet)
{
    const int text = TEXT_LINES * TEXT_LINE;
    return TITLE_LINE + (sheet->height > text ? sheet->height : text);
}

/* Only significant digits. */
static void error_text(double error, char text[24])
{
    snprintf(text, 24, error < 10 ? "off by %.1f steps" : "off by %.0f steps", error);
}

static bool put_case(Sheet *sheet, const HardResult *result, int left, int top, Message *message)
{
    Image exact;
    const Image *const panels[PANELS] = {&result->naive, &result->stable, &exact};
    if (!reference_image(&result->exact, &exact, message))
        return false;
    char lines[TEXT_LINES][128], title[128], cost[HARD_COST_SIZE], error[24];
    hard_cost_text(result, cost);
    snprintf(title, sizeof title, "%s: %s", result->of->name, result->of->what);
    snprintf(lines[0], sizeof lines[0], "plain: %s", result->of->naive);
    error_text(result->naive_error.maximum, error);
    snprintf(lines[1], sizeof lines[1], "%s, %.*f%% of pixels", error,
             result->naive_error.wrong < 0.1 ? 1 : 0, 100 * result->naive_error.wrong);
    snprintf(lines[2], sizeof lines[2], "stable: %s", result->of->stable);
    error_text(result->stable_error.maximum, error);
    snprintf(lines[3], sizeof lines[3], "%s, time %s", error, cost);
    image_label(&sheet->image, left + case_width(sheet) / 2, top + TITLE, TITLE, title, NULL);
    for (int panel = 0; panel < PANELS; panel++)
        report_panel(&sheet->image,
                     (int[]){left + panel * (sheet->width + GAP), top + TITLE_LINE, sheet->width,
                             sheet->height},
                     panels[panel]);
    image_close(&exact);
    const int space = case_height(sheet) - TITLE_LINE - TEXT_LINES * TEXT_LINE;
    for (int line = 0; line < TEXT_LINES; line++)
        image_label(&sheet->image, left + panels_width(sheet) + TEXT_WIDTH / 2,
                    top + TITLE_LINE + space / 2 + line * TEXT_LINE + TEXT, TEXT, lines[line],
                    NULL);
    return true;
}

/* The names of the panels. */
static void put_head(Sheet *sheet, int left)
{
    static const char *const names[PANELS] = {"plain", "stable", "exact"};
    for (int panel = 0; panel < PANELS; panel++)
        image_label(&sheet->image, left + panel * (sheet->width + GAP) + sheet->width / 2,
                    MARGIN / 2 + TEXT, TEXT, names[panel], NULL);
}

bool hard_sheet(const HardSheet *of, const char *path, Message *message)
{
    static const unsigned char ground[3] = {24, 24, 28};
    Sheet sheet = {.width = of->width, .height = of->height};
    const int rows = (of->count + of->columns - 1) / of->columns;
    const int across = case_width(&sheet) + MARGIN, down = case_height(&sheet) + MARGIN;
    if (!image_open(&sheet.image, MARGIN + of->columns * across, MARGIN / 2 + HEAD + rows * down,
                    IMAGE_BYTE, message))
        return false;
    image_fill(&sheet.image, NULL, ground);
    for (int i = 0; i < of->columns; i++)
        put_head(&sheet, MARGIN + i * across);
    bool done = true;
    for (int i = 0; i < of->count && done; i++)
        done = put_case(&sheet, &of->results[i], MARGIN + i % of->columns * across,
                        MARGIN / 2 + HEAD + i / of->columns * down, message);
    done = done && image_write(&sheet.image, path,
                               &(ImageOptions){.compress = IMAGE_COMPRESS_DEFAULT}, message);
    image_close(&sheet.image);
    return done;
}
