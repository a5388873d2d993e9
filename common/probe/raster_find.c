/*
 * A triangle is never clipped: with clip coordinates (x, y, w) of its corners as the columns of a
 * matrix M, M^-1 (X, Y, 1) gives the corners' weights over w at a place (X, Y) of the viewport,
 * also where a corner is behind the eye (Olano and Greer, Triangle scan conversion using 2D
 * homogeneous coordinates, 1997).
 */
#include "probe/raster_state.h"

#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* x, y and w of three corners, and of a place. */
typedef struct Corners {
    double at[3][3];
} Corners;

static double determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static double area_of(const Corners *p) /* with its sign */
{
    return determinant(p->at[0], p->at[1], p->at[2]);
}

/* The weights, which add up to 1, if the place is in the triangle. */
static bool weigh(const Corners *p, double area, const double at[3], double weights[3])
{
    weights[0] = determinant(at, p->at[1], p->at[2]) / area;
    weights[1] = determinant(p->at[0], at, p->at[2]) / area;
    weights[2] = determinant(p->at[0], p->at[1], at) / area;
    const bool inside = weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0;
    const double sum = weights[0] + weights[1] + weights[2];
    for (int i = 0; i < 3; i++)
        weights[i] /= sum;
    return inside && sum > 0;
}

static Corners snapped(const Corners *p, const int viewport[4])
{
    static const double GRID = 256;
    Corners moved = *p;
    for (int i = 0; i < 3; i++) {
        const double w = p->at[i][2];
        for (int k = 0; k < 2 && w > 0; k++) {
            const double half = viewport[2 + k] / 2.0;
            moved.at[i][k] = w * rint((p->at[i][k] / w) * half * GRID) / (half * GRID);
        }
    }
    return moved;
}

static bool passes(GLenum function, double depth, double before)
{
    return function == GL_ALWAYS || (function == GL_LESS && depth < before) ||
           (function == GL_LEQUAL && depth <= before) || (function == GL_EQUAL && depth == before);
}

/* A triangle of a draw; its pixels are within `box`, first and last column, first and last row. */
typedef struct Triangle {
    const CaptureDraw *draw;
    RasterPixel pixel; /* what its pixels have in common */
    Corners corners, grid;
    double depths[3], area, grid_area;
    int box[4];
} Triangle;

/* Shows the triangle at a pixel; `depth` is that of what it shows so far. */
static void try_triangle(const Triangle *triangle, int column, int row, RasterPixel *pixel,
                         double *depth)
{
    const CaptureDraw *draw = triangle->draw;
    const int *v = draw->viewport;
    const double place[2] = {column + 0.5, row + 0.5};
    const double at[3] = {2 * (place[0] - v[0]) / v[2] - 1, 2 * (place[1] - v[1]) / v[3] - 1, 1};
    double weights[3], z = 0, w = 0;
    if (!weigh(&triangle->grid, triangle->grid_area, at, weights))
        return;
    weigh(&triangle->corners, triangle->area, at, weights);
    for (int i = 0; i < 3; i++) {
        z += weights[i] * triangle->depths[i];
        w += weights[i] * triangle->corners.at[i][2];
    }
    const double found = (z / w + 1) / 2;
    if (fabs(z) > w || (draw->tests_depth && !passes(draw->depth_func, found, *depth)))
        return;
    if (draw->tests_depth && draw->writes_depth)
        *depth = found;
    *pixel = triangle->pixel;
    memcpy(pixel->weights, weights, sizeof weights);
    memcpy(pixel->coord, (double[4]){place[0], place[1], found, 1 / w}, sizeof pixel->coord);
}

/* Narrows a box to where the corners are, unless one is behind the eye. */
static void narrow(Triangle *triangle)
{
    const int *v = triangle->draw->viewport;
    for (int k = 0; k < 2; k++) {
        double least = INFINITY, most = -INFINITY;
        for (int i = 0; i < 3; i++) {
            const double *p = triangle->grid.at[i];
            if (!(p[2] > 0))
                return;
            const double at = v[k] + (p[k] / p[2] + 1) / 2 * v[2 + k];
            least = fmin(least, at);
            most = fmax(most, at);
        }
        int *box = triangle->box + 2 * k;
        box[0] = (int)fmax(box[0], fmin(floor(least) - 1, box[1] + 1));
        box[1] = (int)fmin(box[1], fmax(ceil(most), box[0] - 1));
    }
}

/* False: it is not seen. */
static bool prepare(const Raster *raster, Triangle *triangle)
{
    const CaptureDraw *draw = triangle->draw;
    RasterPixel *pixel = &triangle->pixel;
    for (int i = 0; i < 3; i++) {
        const double *place = raster->draws[pixel->draw].places[pixel->corners[i]];
        triangle->depths[i] = place[2];
        memcpy(triangle->corners.at[i], (double[3]){place[0], place[1], place[3]},
               sizeof triangle->corners.at[i]);
    }
    triangle->grid = snapped(&triangle->corners, draw->viewport);
    triangle->area = area_of(&triangle->corners);
    triangle->grid_area = area_of(&triangle->grid);
    pixel->front = (triangle->area > 0) == (draw->front_face == GL_CCW);
    if (draw->culls &&
        (draw->cull_face == GL_FRONT_AND_BACK || pixel->front == (draw->cull_face == GL_FRONT)))
        return false;
    narrow(triangle);
    return true;
}

/* Both as column, row, width, height; a box is narrowed to what is in the area, too. */
static void clip(int box[4], const int area[4])
{
    for (int k = 0; k < 2; k++) {
        const int last = area[k] + area[2 + k] - 1;
        box[2 * k] = box[2 * k] > area[k] ? box[2 * k] : area[k];
        box[2 * k + 1] = box[2 * k + 1] < last ? box[2 * k + 1] : last;
    }
}

static void scan_draw(const Raster *raster, int number, const int window[4], RasterPixel *pixels,
                      double *depths)
{
    const CaptureDraw *draw = &raster->capture->draws[number];
    const int step = draw->mode == GL_TRIANGLES ? 3 : 1;
    int box[4] = {0, INT_MAX, 0, INT_MAX};
    clip(box, window);
    clip(box, draw->viewport);
    if (draw->scissors)
        clip(box, draw->scissor);
    for (int i = 0; i + 2 < draw->vertex_count; i += step) {
        const bool odd = draw->mode == GL_TRIANGLE_STRIP && i % 2;
        Triangle triangle = {.draw = draw, .pixel = {.draw = number}};
        unsigned *corners = triangle.pixel.corners;
        memcpy(triangle.box, box, sizeof box);
        corners[0] = draw->vertices[draw->mode == GL_TRIANGLE_FAN ? 0 : i + odd];
        corners[1] = draw->vertices[i + 1 - odd];
        corners[2] = draw->vertices[i + 2];
        if (!prepare(raster, &triangle))
            continue;
        for (int row = triangle.box[2]; row <= triangle.box[3]; row++)
            for (int column = triangle.box[0]; column <= triangle.box[1]; column++) {
                const int at = (row - window[1]) * window[2] + column - window[0];
                try_triangle(&triangle, column, row, &pixels[at], &depths[at]);
            }
    }
}

void raster_scan(const Raster *raster, const int window[4], RasterPixel *pixels)
{
    const int count = window[2] * window[3];
    double *depths = memory_new((size_t)count, sizeof *depths);
    for (int i = 0; i < count; i++) {
        depths[i] = 1;
        pixels[i] = (RasterPixel){.draw = -1};
    }
    for (int d = 0; d < raster->capture->draw_count; d++)
        if (raster_is_filled(&raster->capture->draws[d]) && raster->capture->draws[d].colors[0])
            scan_draw(raster, d, window, pixels, depths);
    free(depths);
}

void raster_find(const Raster *raster, int column, int row, RasterPixel *pixel)
{
    raster_scan(raster, (const int[4]){column, row, 1, 1}, pixel);
}
