/*
 * raster_state: what the files of raster share, for them alone.
 */
#ifndef RASTER_STATE_H
#define RASTER_STATE_H

#include "probe/raster.h"

/* A varying's registers in the fragment's run and in the vertex's, and its place among the numbers
 * that a vertex hands over. */
typedef struct Link {
    int fragment, vertex, count, at;
    const char *name;
} Link;

/* Both stages of a program, once for all its draws. */
typedef struct Stages {
    const char *sources[2];
    GlslTree *trees[2];
    GlslCode *codes[2];
    GlslRun *runs[2];
    Link *links;
    int link_count, handed; /* handed: the numbers of all links */
    int set_for[2];         /* the draw whose uniforms the runs hold, plus 1 */
} Stages;

/* Of the vertices, by number. */
typedef struct DrawState {
    int stages;
    unsigned most;       /* the last vertex */
    double (*places)[4]; /* clip coordinates, as the driver computes them */
    struct {
        const GlslArithmetic *arithmetic;
        bool *known;
        double *numbers; /* of the links */
    } handed[2];         /* as the driver computes, and exactly; filled as they are needed */
} DrawState;

struct Raster {
    const Capture *capture;
    const GlslArithmetic *driver;
    Stages *stages;
    int count, room;
    DrawState *draws;
    const Raster *first; /* which owns what is constant; NULL: this one */
    bool logs;
    const char *kept; /* see raster_keep */
};

bool raster_is_filled(const CaptureDraw *draw); /* of triangles */

#endif
