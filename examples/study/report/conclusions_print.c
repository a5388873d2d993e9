/*
 * The first screen of accuracy: lines of text with bars of characters, or, on a terminal with
 * colours, cells that have a picture, too.
 */
#include "study/report/conclusions.h"

#include "base/memory.h"
#include "base/text.h"
#include "images/picture_queue.h"
#include "study/report/half_blocks.h"
#include "study/report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* `half` places to the left of | for what is faster and as many to its right for what is slower. */
static void put_bar(double ratio, int half, char bar[16])
{
    memset(bar, ' ', (size_t)(2 * half + 1));
    bar[half] = '|';
    bar[2 * half + 1] = '\0';
    const int length = (int)lround(half * glance_bar(ratio));
    for (int i = length < 0 ? length : 1; i <= (length < 0 ? -1 : length); i++)
        bar[half + i] = '#';
}

static void put_rows(const Conclusions *conclusions, FILE *file)
{
    for (int i = 0; i < conclusions->glance_count; i++) {
        const Glance *glance = &conclusions->glances[i];
        char bar[16];
        put_bar(glance->ratio, 7, bar);
        fprintf(file, "%-18s %s %s (%s; %s)\n", glance->name, bar, glance->verdict, glance->time,
                glance->error);
    }
}

/* The first screen on a terminal with colours: cells of a picture and text beside it. The lower
 * half of a cell's last line is empty, so that a picture has an odd number of rows. */
enum { CELL = 40, CELL_LINES = 5, SIDE = 2 * CELL_LINES - 1, CELL_TEXT = CELL - SIDE - 2 };

/* A line of the picture on the page: of its right half, the difference. */
static void put_cell_picture(const Image *pair, int line, FILE *file)
{
    const int part[4] = {REPORT_PANEL + REPORT_GAP, 0, REPORT_PANEL, pair->height};
    const int rows = pair->width == part[0] + part[2] ? SIDE * pair->height / REPORT_PANEL : 0;
    half_blocks_put(pair, part, (int[]){SIDE, rows < SIDE ? rows : SIDE}, line, file);
}

/* The name is bold, a bar is green or yellow. */
static void put_cell_text(const Glance *glance, int line, FILE *file)
{
    const char *const lines[CELL_LINES] = {"", glance->verdict, glance->time, glance->error, ""};
    const char *const plain = message_color(MESSAGE_PLAIN, fileno(file));
    char bar[16];
    if (line > 0) {
        fprintf(file, "%-*.*s ", CELL_TEXT, CELL_TEXT, lines[line]);
        return;
    }
    put_bar(glance->ratio, 5, bar);
    fprintf(file, "\033[1m%-18s%s%s%s%s ", glance->name, plain,
            message_color(glance->ratio < 1 ? MESSAGE_GREEN : MESSAGE_YELLOW, fileno(file)), bar,
            plain);
}

static void put_cells(const Conclusions *conclusions, const char *folder, int columns, FILE *file)
{
    const int count = conclusions->glance_count, across = columns / CELL;
    Picture *pairs = memory_new(GLANCES, sizeof *pairs);
    for (int i = 0; i < count; i++) {
        glance_path(conclusions->glances[i].file, folder, pairs[i].path);
        (void)picture_read(&pairs[i], NULL); /* otherwise it is blank */
    }
    for (int first = 0; first < count; first += across)
        for (int line = 0; line < CELL_LINES; line++)
            for (int i = first; i < first + across && i < count; i++) {
                put_cell_picture(&pairs[i].image, line, file);
                fputc(' ', file);
                put_cell_text(&conclusions->glances[i], line, file);
                fputs(i + 1 == first + across || i + 1 == count ? "\n" : "", file);
            }
    for (int i = 0; i < count; i++)
        image_close(&pairs[i].image);
    free(pairs);
    text_wrap(file,
              "Against the usual setting. Bars: time, a quarter to four times. Errors: steps of "
              "1/255, in the scene named. Pictures: where, from blue, little, to yellow, much.",
              0, 0, columns);
    fputc('\n', file);
}

void conclusions_print(const Conclusions *conclusions, const char *folder, FILE *file)
{
    const int columns = half_blocks_columns(file);
    const bool warns = columns && conclusions->busy;
    for (int i = 0; i < conclusions->count; i++) {
        fputs(i == 0 && warns ? message_color(MESSAGE_RED, fileno(file)) : "", file);
        text_wrap(file, conclusions->lines[i], 0, 0, columns ? columns : CONCLUSION_SIZE);
        fprintf(file, "%s\n", i == 0 && warns ? message_color(MESSAGE_PLAIN, fileno(file)) : "");
        if (i == 0 && columns)
            put_cells(conclusions, folder, columns, file);
        else if (i == 0)
            put_rows(conclusions, file);
    }
    fprintf(file, "%s/index.html: plots; table.txt: all tables, which --verbose prints\n", folder);
}
