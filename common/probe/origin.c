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

int origin_find(Raster *raster, const RasterPixel *pixel, int events, const double exact[4])
{
    enum { PARTS = 500 };
    double start = 0, color[4];
    int birth = -1, first = -1, last = events - 1;
    for (int step = 1 + (last - first) / PARTS;; step = 1 + (last - first) / PARTS) {
        double before = start, largest = -1, base = start;
        int begin = first, after = first; /* of the part with the largest jump; of the next */
        for (int i = first;; i = i + step < last ? i + step : last) {
            raster_run(raster, pixel, raster_driver(raster), i, color);
            const double error = origin_apart(color, exact), jump = fabs(error - before);
            if (jump > largest) {
                largest = jump;
                birth = i;
                base = before;
                begin = after;
            }
            before = error;
            after = i + 1;
            if (i >= last)
                break;
        }
        if (step == 1)
            break;
        first = begin;
        last = birth;
        start = base;
    }
    return birth;
}
