/*
 * raster: what happens between vertex and picture: interpolation, edges, positions, depth, and the
 * framebuffer's rounding.
 */
#ifndef RASTER_H
#define RASTER_H

#include "study/arithmetic/meter.h"

enum { RASTER_SUBPIXELS = 10 }; /* as many bits can be told */

typedef struct Raster {
    /* The largest error of a varying in units in the last place (24 bits) of the largest of its
     * corners' values: of triangles hundreds of pixels large, and of such whose depth varies up to
     * eightfold; of triangles of a few pixels in units of the differences of the corners. */
    double flat, perspective, small;
    /* Of quadrilaterals of two triangles: the same at pixels that the shared edge passes, and how
     * many such pixels are drawn twice or not at all. */
    double edge;
    long edge_pixels, edge_twice, edge_missed;
    double bytes;         /* the largest error of rounding to 8 bits, in steps */
    int subpixel_bits;    /* of positions: of a pixel's width 2^-bits is resolved; at most
                             RASTER_SUBPIXELS */
    int claimed_subpixel; /* GL_SUBPIXEL_BITS */
    int depth_bits;       /* 2^-bits of the depth's range is resolved on average */
    double depth_step;    /* the largest difference of depths not told apart, in that unit */
    double depth_error;   /* by how much two triangles in one plane differ, in that unit */
} Raster;

bool raster_measure(const Meter *meter, Raster *raster, Message *message);

#endif
