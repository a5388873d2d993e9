#include "study/report/report.h"
#include "study/report/report_gnuplot.h"

#include <math.h>
#include <string.h>

/* The range of an axis. On a logarithmic one, values up to 0 are drawn at `floor`. */
typedef struct Range {
    double min, max, floor;
    bool log, floored;
} Range;

static Range range_of(const ReportSeries *series, int count, bool vertical, bool log)
{
    Range range = {.min = INFINITY, .max = -INFINITY, .log = log};
    for (int i = 0; i < count; i++) {
        const double *values = vertical ? series[i].y : series[i].x;
        for (int j = 0; j < series[i].count; j++) {
            if (!isfinite(series[i].x[j]) || !isfinite(series[i].y[j]))
                continue;
            if (log && values[j] <= 0) {
                range.floored = true;
                continue;
            }
            range.min = fmin(range.min, values[j]);
            range.max = fmax(range.max, values[j]);
        }
    }
    if (range.min > range.max)
        range.min = range.max = 1;
    range.floor = range.min / 2;
    if (log) {
        range.min = range.floored ? range.floor : range.min;
        const double room = pow(range.max / range.min, 0.03) * 1.02;
        range.min /= room;
        range.max *= room;
    } else {
        const double room = 0.03 * (range.max - range.min);
        range.min -= room > 0 ? room : 1;
        range.max += room > 0 ? room : 1;
    }
    return range;
}

static double value_in(const Range *range, double value)
{
    return range->log && value <= 0 ? range->floor : value;
}

/* A series without points is still in the key. */
static void put_series(FILE *script, int number, const ReportSeries *series, const Range *x,
                       const Range *y)
{
    bool any = false;
    fprintf(script, "$series%d << EOD\n", number);
    for (int j = 0; j < series->count; j++) {
        if (!isfinite(series->x[j]) || !isfinite(series->y[j]))
            continue;
        fprintf(script, "%.9g %.9g\n", value_in(x, series->x[j]), value_in(y, series->y[j]));
        any = true;
    }
    fputs(any ? "EOD\n" : "NaN NaN\nEOD\n", script);
}

static void put_curve_axis(FILE *script, char axis, const char *label, const Range *range)
{
    char text[256];
    gnuplot_axis(script, axis, range->min, range->max, range->log);
    snprintf(text, sizeof text, "%s%s", label,
             range->floored ? " (0: drawn at the lower end)" : "");
    fprintf(script, "set %clabel ", axis);
    gnuplot_string(script, text);
    fputc('\n', script);
}

/* Instead of tics at 1, 2 and 5 times powers of ten. */
static void put_doubling(FILE *script, const Range *x)
{
    int written = 0;
    fputs("set xtics nomirror out (", script);
    for (double value = 1; value <= x->max; value *= 2)
        if (value >= x->min)
            fprintf(script, "%s'%.0f' %.0f", written++ ? ", " : "", value, value);
    fputs(")\n", script);
}

/* The approximate number of lines of the key. */
static int key_lines(const ReportSeries *series, int count)
{
    double longest = 1;
    for (int i = 0; i < count; i++)
        longest = fmax(longest, (double)strlen(series[i].name));
    const int columns = (int)fmax(1, floor(0.85 * GNUPLOT_WIDTH / (10.5 * longest + 80)));
    return (count + columns - 1) / columns;
}

bool report_curves(const ReportAxes *axes, const ReportSeries *series, int count,
                   const char *folder, const char *name, Message *message)
{
    static const int marks[] = {7, 9, 5, 11, 13};
    const Range x = range_of(series, count, false, axes->log_x);
    const Range y = range_of(series, count, true, axes->log_y);
    OutputText script;
    int drawn = 0;
    output_text_open(&script);
    FILE *file = script.file;
    const int lines = key_lines(series, count);
    gnuplot_foot(file, axes->foot);
    gnuplot_title(file, axes->title);
    fprintf(file,
            "set encoding utf8\nset border 3 lc rgb '#444444'\n"
            "set grid lc rgb '#dddddd' lw 0.6 lt 1\n"
            "set tmargin at screen %.5f\nset bmargin at screen 0.175\n"
            "set key at screen 0.5,0.937 center top horizontal reverse Left samplen 2.5 width 1\n",
            1 - (62.0 + 24 * lines) / GNUPLOT_HEIGHT);
    put_curve_axis(file, 'x', axes->x, &x);
    if (axes->doubling_x)
        put_doubling(file, &x);
    put_curve_axis(file, 'y', axes->y, &y);
    for (int i = 0; i < count; i++)
        put_series(file, i, &series[i], &x, &y);
    for (int i = 0; i < count; i++) {
        fprintf(file,
                "%s $series%d using 1:2 with linespoints lw 1.8 pt %d ps 0.7 lc rgb '%s' title ",
                drawn++ ? ", \\\n " : "plot", i, marks[i % 5], GNUPLOT_PALETTE[i % GNUPLOT_COLORS]);
        gnuplot_string(file, series[i].name);
    }
    fputc('\n', file);
    return gnuplot_finish(&script, folder, name, message);
}
