/*
 * The shader is run as the driver computes up to each of its assignments and exactly from there on:
 * where the error of the colour jumps from one to the next, it is born. Of very many, it is looked
 * for in parts, then in the part with the largest jump.
 */
#include "probe/origin.h"

#include <math.h>

double origin_step(double channel)
{
    return 255 * fmin(fmax(channel, 0), 1);
}

double origin_apart(const double a[4], const double b[4])
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(origin_step(a[i]) - origin_step(b[i])));
    return most;
}

bool origin_undefined(const Raster *raster, const GlslRun *run, const double color[4])
{
    return run->stopped || raster_unset(raster) || glsl_noted(run, GLSL_NOTE_UNSET) ||
           isnan(color[0]) || isnan(color[1]) || isnan(color[2]);
}

/* The largest jump so far: at an event, after which error; the part it ends. */
typedef struct Search {
    const double *exact;
    double before, largest, base;
    int birth, begin, after;
} Search;

static void judge(Search *search, int event, double error)
{
    const double jump = fabs(error - search->before);
    if (jump > search->largest) {
        search->largest = jump;
        search->birth = event;
        search->base = search->before;
        search->begin = search->after;
    }
    search->before = error;
    search->after = event + 1;
}

static void judge_run(GlslRun *run, int event, bool same, void *context)
{
    Search *search = context;
    double color[4];
    if (!same)
        raster_color(run, color);
    judge(search, event, same ? search->before : origin_apart(color, search->exact));
}

int origin_find(Raster *raster, const RasterPixel *pixel, int events, const double exact[4])
{
    enum { PARTS = 500 };
    double start = 0, color[4];
    for (int first = -1, last = events - 1;;) {
        const int step = 1 + (last - first) / PARTS;
        Search search = {exact, start, -1, start, -1, first, first};
        int next = first;
        if (first < 0) {
            raster_run(raster, pixel, raster_driver(raster), -1, color);
            judge(&search, -1, origin_apart(color, exact));
            next = step - 1 < last ? step - 1 : last;
        }
        if (last >= 0)
            raster_run_each(raster, pixel, (int[]){next, last, step}, judge_run, &search);
        if (step == 1)
            return search.birth;
        first = search.begin;
        last = search.birth;
        start = search.base;
    }
}
