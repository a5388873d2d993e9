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

static void set_series(TemplateValues *plot, int number, const ReportSeries *series, const Range *x,
                       const Range *y)
{
    static const int marks[] = {7, 9, 5, 11, 13};
    TemplateValues *values = template_add(plot, "series");
    template_set(values, "comma", "%s", number ? ", \\\n " : "");
    template_set(values, "number", "%d", number);
    template_set(values, "mark", "%d", marks[number % 5]);
    template_set(values, "color", "%s", GNUPLOT_PALETTE[number % GNUPLOT_COLORS]);
    gnuplot_set(values, "name", series->name);
    for (int j = 0; j < series->count; j++) {
        if (!isfinite(series->x[j]) || !isfinite(series->y[j]))
            continue;
        TemplateValues *point = template_add(values, "point");
        template_set(point, "x", "%.9g", value_in(x, series->x[j]));
        template_set(point, "y", "%.9g", value_in(y, series->y[j]));
    }
}

static void set_axis(TemplateValues *plot, const char axis[2], const char *label,
                     const Range *range)
{
    char text[256];
    gnuplot_set_axis(plot, axis[0], range->min, range->max, range->log);
    snprintf(text, sizeof text, "%s%s", label,
             range->floored ? " (0: drawn at the lower end)" : "");
    gnuplot_set(plot, axis, text);
}

/* Instead of tics at 1, 2 and 5 times powers of ten. */
static void set_doubling(TemplateValues *plot, const Range *x)
{
    TemplateValues *doubling = template_add(plot, "doubling");
    int count = 0;
    for (double value = 1; value <= x->max; value *= 2) {
        if (value < x->min)
            continue;
        TemplateValues *tic = template_add(doubling, "tic");
        template_set(tic, "comma", "%s", count++ ? ", " : "");
        template_set(tic, "at", "%.0f", value);
    }
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
    const Range x = range_of(series, count, false, axes->log_x);
    const Range y = range_of(series, count, true, axes->log_y);
    TemplateValues *plot = gnuplot_values(axes->title, axes->foot);
    template_set(plot, "top", "%.5f", 1 - (62.0 + 24 * key_lines(series, count)) / GNUPLOT_HEIGHT);
    set_axis(plot, "x", axes->x, &x);
    set_axis(plot, "y", axes->y, &y);
    if (axes->doubling_x)
        set_doubling(plot, &x);
    for (int i = 0; i < count; i++)
        set_series(plot, i, &series[i], &x, &y);
    return gnuplot_draw("examples/study/report/curves.gp", plot, folder, name, message);
}
