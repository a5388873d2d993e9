/* What of a triangle's shape and place the errors of interpolated numbers depend on. */
#include "glsl/glsl_bound_tape.h"
#include "study/arithmetic/arithmetic.h"

GlslRange raster_determinant(const RasterNumber x, const RasterNumber y, const RasterNumber w)
{
    const GlslRange *of[5] = {x, y, w, x, y};
    GlslRange sum = {0, 0};
    for (int k = 0; k < 3; k++)
        sum = range_sum(
            sum, range_product(of[k][0], range_minus(range_product(of[k + 1][1], of[k + 2][2]),
                                                     range_product(of[k + 1][2], of[k + 2][1]))));
    return sum;
}

/* Of number / w, between two corners at most. */
static double difference(const RasterTriangle *triangle, const RasterNumber number)
{
    const GlslRange *w = triangle->place[2];
    GlslRange apart[3] = {{0, 0}};
    double most = 0;
    for (int i = 1; i < 3; i++) {
        const GlslRange squared = range_product(w[0], range_sum(w[0], w[i]));
        apart[i] = range_product(
            range_minus(range_product(number[i], w[0]), range_product(number[0], w[i])),
            (GlslRange){1 / squared.high, 1 / squared.low});
    }
    for (int i = 0; i < 3; i++)
        most = fmax(most, magnitude(range_minus(apart[i], apart[(i + 1) % 3])));
    return most;
}

/* How much number / w changes over all that window coordinates are made of, and its shape. */
static double slope_of(const RasterTriangle *triangle, const RasterNumber number)
{
    const RasterNumber *at = triangle->place;
    const double x = magnitude(raster_determinant(number, at[1], at[2]));
    const double y = magnitude(raster_determinant(at[0], number, at[2]));
    const double area = fmax(triangle->area.low, -triangle->area.high);
    const double apart = difference(triangle, number), most = triangle->most * apart;
    const double slope =
        (x * triangle->extent[0] + y * triangle->extent[1]) / area + triangle->shape * apart;
    return area > 0 && slope < most ? slope : most;
}

void raster_triangle(RasterTriangle *triangle, const double half[2], int subpixel_bits)
{
    static const RasterNumber one = {{1, 1}, {0, 0}, {0, 0}}, none = {{0, 0}, {0, 0}, {0, 0}};
    const RasterNumber *at = triangle->place;
    double all = 1, side = 0, extent = 0;
    triangle->area = raster_determinant(at[0], at[1], at[2]);
    triangle->high = 0;
    for (int k = 0; k < 2; k++) {
        triangle->extent[k] = 0;
        for (int i = 0; i < 3; i++) {
            const GlslRange w = range_sum(at[2][0], (i ? at[2] : none)[i]);
            const GlslRange place = range_sum(at[k][0], (i ? at[k] : none)[i]);
            const double made = magnitude(range_sum(w, place)) + magnitude(place);
            triangle->extent[k] = fmax(triangle->extent[k], made / w.low);
            triangle->high = w.low > 0 ? fmax(triangle->high, w.high) : (double)INFINITY;
            all *= k ? w.high : 1;
        }
        side = hypot(side, difference(triangle, at[k]) * half[k]);
        extent += triangle->extent[k] * half[k];
    }
    triangle->height =
        half[0] * half[1] / all / side * fmax(fmax(triangle->area.low, -triangle->area.high), 0);
    triangle->shape = side / triangle->height;
    triangle->most = ldexp(extent + side, subpixel_bits - 1);
    triangle->slope = slope_of(triangle, one);
}

double raster_units(const RasterTriangle *triangle, const RasterNumber number)
{
    const double first = magnitude(number[0]), second = magnitude(range_sum(number[0], number[1]));
    const double most = fmax(fmax(first, second), magnitude(range_sum(number[0], number[2])));
    if (!isfinite(triangle->high))
        return 0x1p19 * most;
    return 2 * most + triangle->high * (slope_of(triangle, number) + most * triangle->slope);
}
