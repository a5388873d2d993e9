#include "study/report/report.h"
#include "base/memory.h"
#include "base/output_text.h"
#include "base/text.h"
#include "study/report/report_gnuplot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The plot area, in pixels from the lower left. */
typedef struct Place {
    double x, y;
} Place;
static const Place MIN = {115, 122}, MAX = {985, 423};

/* The pictures above it: where their captions and below them their settings are, and the boxes they
 * fit in. */
static const double CAPTION = 500, SETTING = 479, SETTING_LINE = 21, STRIP = 515, STRIP_HEIGHT = 92;

/* Smaller errors are drawn here. */
static const double FLOOR = 0.01;

/* The largest error of rounding to 8 bits. */
static const double ROUNDING = 0.5;

enum { INTERPOLATIONS = 3 };
static const int FILLED[INTERPOLATIONS] = {7, 9, 5}; /* points */

/* A scene's rows and ranges. */
typedef struct Plot {
    const ResultRow **rows; /* those with a time and an error */
    int count;
    Front front;
    ReportPins pins;
    double x_min, x_max, y_min, y_max;
    bool floored; /* an error is below FLOOR */
} Plot;

static double height_of(const ResultRow *row)
{
    return fmax(row->interior_maximum, FLOOR);
}

static double y_of(const Plot *plot, double error)
{
    const double y = log(error / plot->y_min) / log(plot->y_max / plot->y_min);
    return MIN.y + y * (MAX.y - MIN.y);
}

static Place place_of(const Plot *plot, const ResultRow *row)
{
    const double x = log(row->time / plot->x_min) / log(plot->x_max / plot->x_min);
    return (Place){MIN.x + x * (MAX.x - MIN.x), y_of(plot, height_of(row))};
}

static void plot_close(Plot *plot)
{
    free(plot->rows);
    front_close(&plot->front);
}

/* The efficient row farthest from those with pins; -1 if all have one. */
static int farthest(const Plot *plot, const bool *pinned)
{
    double max = 0;
    int chosen = -1;
    for (int i = 0; i < plot->front.count; i++) {
        if (!(plot->front.rows[i]->time > 0)) /* it has no place */
            continue;
        const Place at = place_of(plot, plot->front.rows[i]);
        double nearest = INFINITY;
        for (int j = 0; j < plot->front.count; j++) {
            const Place other = place_of(plot, plot->front.rows[j]);
            if (pinned[j])
                nearest = fmin(nearest, hypot(at.x - other.x, at.y - other.y));
        }
        if (nearest > max) {
            max = nearest;
            chosen = i;
        }
    }
    return chosen;
}

/* Both ends, and others far from each other. */
static void choose_pins(Plot *plot)
{
    bool *pinned = memory_new((size_t)plot->front.count, sizeof *pinned);
    for (int count = 0; count < REPORT_PINS; count++) {
        const int last = plot->front.count - 1;
        const int i = count == 1 && last > 0 && !pinned[last] ? last : farthest(plot, pinned);
        if (i >= 0)
            pinned[i] = true;
    }
    plot->pins.count = 0;
    for (int i = 0; i < plot->front.count; i++)
        if (pinned[i])
            plot->pins.rows[plot->pins.count++] = plot->front.rows[i];
    free(pinned);
}

static bool plot_open(Plot *plot, const Results *results, const char *scene, Message *message)
{
    int count;
    *plot = (Plot){.x_min = INFINITY, .y_min = INFINITY, .x_max = 0, .y_max = 0};
    plot->rows = results_latest(results, scene, &count);
    for (int i = 0; i < count; i++) {
        const ResultRow *row = plot->rows[i];
        const double error = row->interior_maximum;
        if (!isfinite(error) || !isfinite(row->time) || row->time <= 0)
            continue;
        plot->rows[plot->count++] = row;
        plot->floored = plot->floored || error < FLOOR;
        plot->x_min = fmin(plot->x_min, row->time);
        plot->x_max = fmax(plot->x_max, row->time);
        plot->y_min = fmin(plot->y_min, height_of(row));
        plot->y_max = fmax(plot->y_max, height_of(row));
    }
    if (plot->count == 0) {
        plot_close(plot);
        return message_set(message, "%s: nothing was measured", scene);
    }
    /* Room for labels on the left and below, where there are no rows. */
    const double x_room = pow(plot->x_max / plot->x_min, 0.25) * 1.05;
    const double y_room = pow(plot->y_max / plot->y_min, 0.08) * 1.1;
    plot->x_min /= x_room;
    plot->x_max *= sqrt(sqrt(x_room));
    plot->y_min /= plot->floored ? 1.3 : y_room;
    plot->y_max *= sqrt(y_room);
    front_open(&plot->front, results, scene, ERROR_INTERIOR_MAXIMUM);
    choose_pins(plot);
    return true;
}

static void set_screen(TemplateValues *values, const char *x, const char *y, Place place)
{
    template_set(values, x, "%.5f", place.x / GNUPLOT_WIDTH);
    template_set(values, y, "%.5f", place.y / GNUPLOT_HEIGHT);
}

static TemplateValues *add_row(TemplateValues *to, const ResultRow *row)
{
    TemplateValues *values = template_add(to, "row");
    template_set(values, "time", "%.9g", row->time);
    template_set(values, "error", "%.9g", height_of(row));
    return values;
}

/* The rows of one interpolation, efficient or not; false if there are none. */
static bool set_rows(TemplateValues *page, const Plot *plot, int interpolation, bool efficient)
{
    static const int hollow[INTERPOLATIONS] = {6, 8, 4};
    TemplateValues *rows = NULL;
    for (int i = 0; i < plot->count; i++) {
        const ResultRow *row = plot->rows[i];
        if (row->quality.choice[AXIS_INTERPOLATION] != interpolation ||
            front_has(&plot->front, row) != efficient)
            continue;
        if (!rows) {
            rows = template_add(page, efficient ? "efficient" : "other");
            template_set(rows, "number", "%d", interpolation);
            template_set(rows, "filled", "%d", FILLED[interpolation]);
            template_set(rows, "hollow", "%d", hollow[interpolation]);
            template_set(rows, "color", "%s", GNUPLOT_PALETTE[interpolation]);
        }
        add_row(rows, row);
    }
    return rows != NULL;
}

/* Each with its quartiles. */
static void set_front(TemplateValues *page, const Plot *plot)
{
    TemplateValues *front = template_add(page, "front");
    for (int i = 0; i < plot->front.count; i++) {
        const ResultRow *row = plot->front.rows[i];
        const bool known = isfinite(row->time_lower) && isfinite(row->time_upper);
        const double lower = known ? fmax(row->time_lower, plot->x_min) : row->time;
        const double upper = known ? fmin(row->time_upper, plot->x_max) : row->time;
        TemplateValues *values = add_row(front, row);
        template_set(values, "lower", "%.9g", lower);
        template_set(values, "width", "%.9g", upper - lower);
    }
}

static void set_points(TemplateValues *page, const Plot *plot)
{
    for (int i = 0; i < INTERPOLATIONS; i++) {
        const bool other = set_rows(page, plot, i, false);
        if (!set_rows(page, plot, i, true) && !other)
            continue;
        TemplateValues *entry = template_add(page, "entry");
        template_set(entry, "filled", "%d", FILLED[i]);
        template_set(entry, "color", "%s", GNUPLOT_PALETTE[i]);
        template_set(entry, "name", "%s", QUALITY_AXES[AXIS_INTERPOLATION].choices[i]);
    }
    if (!plot->front.busy) {
        set_front(page, plot);
        return;
    }
    TemplateValues *busy = template_add(page, "busy");
    template_set(busy, "bound", "%.0f", 100 * FRONT_NOISE_BOUND);
    template_set(busy, "y", "%.5f", (STRIP + STRIP_HEIGHT / 2) / GNUPLOT_HEIGHT);
}

static void set_axes(TemplateValues *page, const Plot *plot)
{
    set_screen(page, "left", "bottom", MIN);
    set_screen(page, "right", "top", MAX);
    gnuplot_set_axis(page, 'x', plot->x_min, plot->x_max, true);
    gnuplot_set_axis(page, 'y', plot->y_min, plot->y_max, true);
    template_set(page, "middle", "%.5f", (MIN.y + MAX.y) / 2 / GNUPLOT_HEIGHT);
    if (plot->floored)
        template_set(page, "floor", "%g", FLOOR);
    if (plot->y_min < ROUNDING && plot->y_max > ROUNDING)
        template_set(page, "rounding", "%.5f", (MIN.x + 6) / GNUPLOT_WIDTH);
    template_set(page, "width", "%d", GNUPLOT_WIDTH);
    template_set(page, "height", "%d", GNUPLOT_HEIGHT);
}

/* A pin's picture in its part of the strip. */
static double pin_left(int pin)
{
    const double part = (MAX.x - MIN.x + 80) / REPORT_PINS;
    return MIN.x - 80 + part * pin;
}

static double pin_width(void)
{
    return (MAX.x - MIN.x + 80) / REPORT_PINS - 14;
}

/* True if it is there. `first`: of all. */
static bool set_picture(TemplateValues *page, const Plot *plot, const char *path, int number,
                        bool first)
{
    const ResultRow *row = plot->pins.rows[number];
    if (access(path, R_OK) != 0)
        return false;
    /* As wide as there is room, but for tall pictures. */
    const double aspect = (double)row->height / row->width * REPORT_PANEL;
    TemplateValues *picture = template_add(page, "picture");
    template_set(picture, "join", "%s", first ? "plot " : ", \\\n  ");
    gnuplot_set(picture, "path", path);
    template_set(picture, "x", "%g", pin_left(number));
    template_set(picture, "y", "%g", STRIP);
    template_set(picture, "scale", "%.6g",
                 fmin(pin_width() / (2 * REPORT_PANEL + REPORT_GAP), STRIP_HEIGHT / aspect));
    return true;
}

void report_pin_path(const char *folder, const char *scene, int pin, char path[PATH_MAX])
{
    snprintf(path, PATH_MAX, "%s/%s-pin-%d.png", folder, scene, pin + 1);
}

bool report_pins(ReportPins *pins, const Results *results, const char *scene, Message *message)
{
    Plot plot;
    if (!plot_open(&plot, results, scene, message))
        return false;
    *pins = plot.pins;
    plot_close(&plot);
    return true;
}

/* A setting's choices, in lines as wide as its picture; how many of these there are. */
static int set_setting(TemplateValues *page, const Quality *quality, double middle)
{
    enum { WIDTH = 17, MOST = 3 };
    char setting[QUALITY_TEXT_SIZE];
    int count = 0;
    OutputText wrapped;
    output_text_open(&wrapped);
    quality_text(quality, setting);
    text_wrap(wrapped.file, setting, 0, 0, WIDTH);
    char *text = output_text_close(&wrapped);
    for (char *line = strtok(text, "\n"), *next; line && count < MOST; line = next) {
        TemplateValues *values = template_add(page, "setting");
        next = strtok(NULL, "\n");
        char *shown = memory_format("%s%s", line, count == MOST - 1 && next ? " ..." : "");
        gnuplot_set(values, "text", shown);
        set_screen(values, "x", "y", (Place){middle, SETTING - SETTING_LINE * count++});
        free(shown);
    }
    free(text);
    return count;
}

/* A row's picture, what it is of, and a line from there to its point. */
static bool set_pin(TemplateValues *page, const Plot *plot, int number, const char *path,
                    bool first)
{
    const ResultRow *row = plot->pins.rows[number];
    const double middle = pin_left(number) + pin_width() / 2, error = row->interior_maximum;
    const double below = SETTING + 6 - SETTING_LINE * set_setting(page, &row->quality, middle);
    TemplateValues *pin = template_add(page, "pin");
    template_set(pin, "caption", "'%.*f ms, %.*f steps'", row->time < 9.95, row->time, error < 9.95,
                 error);
    set_screen(pin, "x0", "y", (Place){middle, CAPTION});
    template_set(pin, "y0", "%.5f", below / GNUPLOT_HEIGHT);
    set_screen(pin, "x1", "y1", place_of(plot, row));
    return set_picture(page, plot, path, number, first);
}

bool report_plot(const Results *results, const char *scene, const char *title, const char *folder,
                 Message *message)
{
    Plot plot;
    char with[RESULT_WITH_SIZE], path[PATH_MAX];
    bool any = false;
    if (!plot_open(&plot, results, scene, message))
        return false;
    results_measured_with(plot.rows[0], with);
    TemplateValues *page = gnuplot_values(title, with);
    set_axes(page, &plot);
    for (int i = 0; i < plot.pins.count; i++) {
        report_pin_path(folder, scene, i, path);
        any |= set_pin(page, &plot, i, path, !any);
    }
    set_points(page, &plot);
    plot_close(&plot);
    return gnuplot_draw("examples/study/report/scene.gp", page, folder, scene, message);
}
