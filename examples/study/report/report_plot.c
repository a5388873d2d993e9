#include "study/report/report.h"
#include "base/memory.h"
#include "study/report/report_gnuplot.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The plot area, in pixels from the lower left. */
static const Place MIN = {115, 122}, MAX = {985, 480};

/* The pictures above it: the height of their captions' lines, and the boxes they fit in. */
static const double CAPTION = 500, STRIP = 515, STRIP_HEIGHT = 92;

/* Smaller errors are drawn here. */
static const double FLOOR = 0.01;

/* The largest error of rounding to 8 bits. */
static const double ROUNDING = 0.5;

enum { INTERPOLATIONS = 3 };

/* A scene's rows and ranges. */
typedef struct Plot {
    const ResultRow **rows; /* those with a time and an error */
    int count;
    Front front;
    ReportPins pins;
    ErrorKind kind;
    double x_min, x_max, y_min, y_max;
    bool floored; /* an error is below FLOOR */
} Plot;

static double height_of(const Plot *plot, const ResultRow *row)
{
    return fmax(row_error(row, plot->kind), FLOOR);
}

static double y_of(const Plot *plot, double error)
{
    const double y = log(error / plot->y_min) / log(plot->y_max / plot->y_min);
    return MIN.y + y * (MAX.y - MIN.y);
}

static Place place_of(const Plot *plot, const ResultRow *row)
{
    const double x = log(row->time / plot->x_min) / log(plot->x_max / plot->x_min);
    return (Place){MIN.x + x * (MAX.x - MIN.x), y_of(plot, height_of(plot, row))};
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

static bool plot_open(Plot *plot, const Results *results, const char *scene, ErrorKind kind,
                      Message *message)
{
    int count;
    *plot = (Plot){.kind = kind, .x_min = INFINITY, .y_min = INFINITY, .x_max = 0, .y_max = 0};
    plot->rows = results_latest(results, scene, &count);
    for (int i = 0; i < count; i++) {
        const ResultRow *row = plot->rows[i];
        const double error = row_error(row, kind);
        if (!isfinite(error) || !isfinite(row->time) || row->time <= 0)
            continue;
        plot->rows[plot->count++] = row;
        plot->floored = plot->floored || error < FLOOR;
        plot->x_min = fmin(plot->x_min, row->time);
        plot->x_max = fmax(plot->x_max, row->time);
        plot->y_min = fmin(plot->y_min, height_of(plot, row));
        plot->y_max = fmax(plot->y_max, height_of(plot, row));
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
    front_open(&plot->front, results, scene, kind);
    choose_pins(plot);
    return true;
}

static void make_labels(const Plot *plot, Label labels[REPORT_PINS])
{
    for (int i = 0; i < plot->pins.count; i++) {
        labels[i] = (Label){.point = place_of(plot, plot->pins.rows[i])};
        label_name(&labels[i], &plot->pins.rows[i]->quality);
    }
}

static bool place_labels(const Plot *plot, Label *labels, int count, Message *message)
{
    Place *places = malloc((size_t)(plot->count + plot->front.count) * sizeof *places);
    if (!places)
        return message_set(message, "the plot: %s", strerror(ENOMEM));
    for (int i = 0; i < plot->count; i++)
        places[i] = place_of(plot, plot->rows[i]);
    for (int i = 0; i < plot->front.count; i++)
        places[plot->count + i] = place_of(plot, plot->front.rows[i]);
    const double y = y_of(plot, ROUNDING);
    labels_place(labels, count,
                 &(LabelGround){.min = {MIN.x + 4, MIN.y + 4},
                                .max = {MAX.x + 15, MAX.y},
                                .taken_min = {MIN.x, y - 4},
                                .taken_max = {MIN.x + 180, y + 26},
                                .path = places + plot->count,
                                .path_count = plot->front.count,
                                .points = places,
                                .point_count = plot->count,
                                .letter = 10.5,
                                .line = 21});
    free(places);
    return true;
}

static void put_screen(FILE *script, Place place)
{
    fprintf(script, " screen %.5f,%.5f", place.x / GNUPLOT_WIDTH, place.y / GNUPLOT_HEIGHT);
}

static void put_labels(FILE *script, const Label *labels, int count)
{
    for (int i = 0; i < count; i++) {
        const Label *label = &labels[i];
        const bool before = label->max.x <= label->point.x; /* it ends at the point */
        const double step = (label->max.y - label->min.y) / label->line_count;
        if (!label->placed)
            continue;
        for (int j = 0; j < label->line_count; j++) {
            fputs("set label ", script);
            gnuplot_string(script, label->lines[j]);
            fputs(" at", script);
            put_screen(script, (Place){before ? label->max.x : label->min.x,
                                       label->max.y - (j + 0.5) * step});
            fprintf(script, " %s front textcolor rgb '#222222'\n", before ? "right" : "left");
        }
        if (!label->led)
            continue;
        fputs("set arrow from", script);
        put_screen(script, (Place){fmin(fmax(label->point.x, label->min.x), label->max.x),
                                   fmin(fmax(label->point.y, label->min.y), label->max.y)});
        fputs(" to", script);
        put_screen(script, label->point);
        fputs(" nohead front lw 0.7 lc rgb '#888888'\n", script);
    }
}

/* The rows of one interpolation, efficient or not, as a data block; false if there are none. */
static bool put_rows(FILE *script, const Plot *plot, int interpolation, bool efficient)
{
    bool any = false;
    for (int i = 0; i < plot->count; i++) {
        const ResultRow *row = plot->rows[i];
        if (row->quality.choice[AXIS_INTERPOLATION] != interpolation ||
            front_has(&plot->front, row) != efficient)
            continue;
        if (!any)
            fprintf(script, "$%s%d << EOD\n", efficient ? "efficient" : "other", interpolation);
        any = true;
        fprintf(script, "%.9g %.9g\n", row->time, height_of(plot, row));
    }
    if (any)
        fputs("EOD\n", script);
    return any;
}

/* Each with its quartiles. */
static void put_front(FILE *script, const Plot *plot)
{
    fputs("$front << EOD\n", script);
    for (int i = 0; i < plot->front.count; i++) {
        const ResultRow *row = plot->front.rows[i];
        const bool known = isfinite(row->time_lower) && isfinite(row->time_upper);
        const double lower = known ? fmax(row->time_lower, plot->x_min) : row->time;
        const double upper = known ? fmin(row->time_upper, plot->x_max) : row->time;
        fprintf(script, "%.9g %.9g %.9g %.9g\n", row->time, height_of(plot, row), lower,
                upper - lower);
    }
    fputs("EOD\n", script);
}

static void put_axes(FILE *script, const Plot *plot, const char *title)
{
    static const char *const kinds[] = {
        [ERROR_INTERIOR_MAXIMUM] = "largest error",
        [ERROR_INTERIOR_RMS] = "RMS error",
        [ERROR_ALL_RMS] = "RMS error of all pixels",
    };
    char label[160];
    char with[RESULT_WITH_SIZE];
    results_measured_with(plot->rows[0], with);
    gnuplot_foot(script, with);
    gnuplot_title(script, title);
    fputs("set encoding utf8\nset border 3 lc rgb '#444444'\n", script);
    fprintf(script,
            "set lmargin at screen %.5f\nset rmargin at screen %.5f\n"
            "set bmargin at screen %.5f\nset tmargin at screen %.5f\n",
            MIN.x / GNUPLOT_WIDTH, MAX.x / GNUPLOT_WIDTH, MIN.y / GNUPLOT_HEIGHT,
            MAX.y / GNUPLOT_HEIGHT);
    gnuplot_axis(script, 'x', plot->x_min, plot->x_max, true);
    gnuplot_axis(script, 'y', plot->y_min, plot->y_max, true);
    fputs("set xlabel 'time of a frame, drawn and read back, in ms' offset 0,0.4\nset label ",
          script);
    snprintf(label, sizeof label, "%s, in steps of 1/255", kinds[plot->kind]);
    gnuplot_string(script, label);
    fprintf(script, " at screen 0.022,%.5f center rotate", (MIN.y + MAX.y) / 2 / GNUPLOT_HEIGHT);
    if (plot->floored)
        fprintf(script, "\nset ytics add ('≤%g' %g)", FLOOR, FLOOR);
    fputs("\nset grid lc rgb '#dddddd' lw 0.6 lt 1\n"
          "set key at screen 0.5,0.937 center top horizontal reverse Left samplen 1.5 width 1\n",
          script);
    if (plot->kind == ERROR_INTERIOR_MAXIMUM && plot->y_min < ROUNDING && plot->y_max > ROUNDING)
        fprintf(script,
                "set arrow from graph 0,first 0.5 to graph 1,first 0.5 nohead back lw 1 dt 2 "
                "lc rgb '#999999'\n"
                "set label 'rounding to 8 bits' at screen %.5f,first 0.5 left offset 0,0.5 "
                "textcolor rgb '#666666'\n",
                (MIN.x + 6) / GNUPLOT_WIDTH);
}

/* The line of the efficient ones; where the machine was busy that instead. */
static void put_efficient(FILE *script, const Plot *plot)
{
    if (!plot->front.busy) {
        put_front(script, plot);
        fputs("plot $front using 1:2 with lines lw 1.5 lc rgb '#555555' title 'efficient', \\\n"
              "  $front using 3:2:4:(0) with vectors nohead lw 1.5 lc rgb '#555555' notitle",
              script);
        return;
    }
    fprintf(script,
            "set label 'The machine was busy: half the times have a noise of more than %.0f%%; no "
            "setting is marked.' at screen 0.5,%.5f center front textcolor rgb '#b00000'\n"
            "plot NaN notitle",
            100 * FRONT_NOISE_BOUND, (STRIP + STRIP_HEIGHT / 2) / GNUPLOT_HEIGHT);
}

/* Later ones cover earlier ones. */
static void put_plot(FILE *script, const Plot *plot)
{
    static const int filled[INTERPOLATIONS] = {7, 9, 5}, hollow[INTERPOLATIONS] = {6, 8, 4};
    bool other[INTERPOLATIONS], efficient[INTERPOLATIONS];
    for (int i = 0; i < INTERPOLATIONS; i++) {
        other[i] = put_rows(script, plot, i, false);
        efficient[i] = put_rows(script, plot, i, true);
    }
    put_efficient(script, plot);
    for (int i = 0; i < INTERPOLATIONS; i++)
        if (other[i])
            fprintf(script,
                    ", \\\n  $other%d using 1:2 with points pt %d ps 0.5 lw 1 lc rgb '%s' notitle",
                    i, hollow[i], GNUPLOT_PALETTE[i]);
    for (int i = 0; i < INTERPOLATIONS; i++)
        if (efficient[i])
            fprintf(script,
                    ", \\\n  $efficient%d using 1:2 with points pt %d ps 1.1 lc rgb '%s' notitle, "
                    "\\\n  '' using 1:2 with points pt %d ps 1.1 lw 1 lc rgb '#000000' notitle",
                    i, filled[i], GNUPLOT_PALETTE[i], hollow[i]);
    for (int i = 0; i < INTERPOLATIONS; i++)
        if (other[i] || efficient[i])
            fprintf(script, ", \\\n  keyentry with points pt %d ps 0.9 lc rgb '%s' title '%s'",
                    filled[i], GNUPLOT_PALETTE[i], QUALITY_AXES[AXIS_INTERPOLATION].choices[i]);
    fputs("\n", script);
}

/* A pin's picture in its part of the strip; lines from there to its point. */
static double pin_left(int pin)
{
    const double part = (MAX.x - MIN.x + 80) / REPORT_PINS;
    return MIN.x - 80 + part * pin;
}

static double pin_width(void)
{
    return (MAX.x - MIN.x + 80) / REPORT_PINS - 14;
}

static void put_pins(FILE *script, const Plot *plot)
{
    for (int i = 0; i < plot->pins.count; i++) {
        const ResultRow *row = plot->pins.rows[i];
        char caption[64];
        const double middle = pin_left(i) + pin_width() / 2;
        const double error = row_error(row, plot->kind);
        snprintf(caption, sizeof caption, "%.*f ms, %.*f steps", row->time < 9.95, row->time,
                 error < 9.95, error);
        fputs("set label ", script);
        gnuplot_string(script, caption);
        fputs(" at", script);
        put_screen(script, (Place){middle, CAPTION});
        fputs(" center front\nset arrow from", script);
        put_screen(script, (Place){middle, CAPTION - 12});
        fputs(" to", script);
        put_screen(script, place_of(plot, row));
        fputs(" nohead back lw 1 lc rgb '#999999'\n", script);
    }
}

/* Over the plot, in pixels. */
static void put_pictures(FILE *script, const char *scene, const char *folder, const Plot *plot)
{
    bool any = false;
    fprintf(script,
            "unset border\nunset tics\nunset key\nunset title\nunset xlabel\nunset ylabel\n"
            "unset label\nunset arrow\nunset grid\nunset logscale\nset lmargin at screen 0\n"
            "set rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\n"
            "set xrange [0:%d]\nset yrange [0:%d]\n",
            GNUPLOT_WIDTH, GNUPLOT_HEIGHT);
    for (int i = 0; i < plot->pins.count; i++) {
        const ResultRow *row = plot->pins.rows[i];
        char path[PATH_MAX];
        report_pin_path(folder, scene, i, path);
        if (access(path, R_OK) != 0)
            continue;
        /* As wide as there is room, but for tall pictures. */
        const double aspect = (double)row->height / row->width * REPORT_PANEL;
        const double scale =
            fmin(pin_width() / (2 * REPORT_PANEL + REPORT_GAP), STRIP_HEIGHT / aspect);
        fputs(any ? ", \\\n  " : "plot ", script);
        gnuplot_string(script, path);
        fprintf(script, " binary filetype=png origin=(%g,%g) dx=%.6g dy=%.6g with rgbimage",
                pin_left(i), STRIP, scale, scale);
        any = true;
    }
    fputs("\n", script);
}

void report_pin_path(const char *folder, const char *scene, int pin, char path[PATH_MAX])
{
    snprintf(path, PATH_MAX, "%s/%s-pin-%d.png", folder, scene, pin + 1);
}

bool report_pins(ReportPins *pins, const Results *results, const char *scene, ErrorKind kind,
                 Message *message)
{
    Plot plot;
    if (!plot_open(&plot, results, scene, kind, message))
        return false;
    *pins = plot.pins;
    plot_close(&plot);
    return true;
}

bool report_plot(const Results *results, const char *scene, const char *title, ErrorKind kind,
                 const char *folder, Message *message)
{
    Plot plot;
    Label labels[REPORT_PINS];
    OutputText script;
    if (!plot_open(&plot, results, scene, kind, message))
        return false;
    const int count = plot.pins.count;
    make_labels(&plot, labels);
    bool done = place_labels(&plot, labels, count, message);
    if (done) {
        output_text_open(&script);
        FILE *file = script.file;
        fputs("set multiplot\n", file);
        put_axes(file, &plot, title);
        put_labels(file, labels, count);
        put_pins(file, &plot);
        put_plot(file, &plot);
        put_pictures(file, scene, folder, &plot);
        fputs("unset multiplot\n", file);
        done = gnuplot_finish(&script, folder, scene, message);
    }
    plot_close(&plot);
    return done;
}
