/*
 * raster_state: what the files of raster share, for them alone.
 */
#ifndef RASTER_STATE_H
#define RASTER_STATE_H

#include "probe/raster.h"
#include "probe/stages.h"

/* Shaders, once for all draws that have the same. */
typedef struct RasterProgram {
    Stages stages;
    GlslRun *runs[2];
    int set_for[2]; /* the draw whose uniforms the runs hold, plus 1 */
} RasterProgram;

enum { HANDED = 1, UNSET = 2 };

/* Of the vertices, by number. */
typedef struct DrawState {
    int program;
    unsigned most;       /* the last vertex */
    double (*places)[4]; /* clip coordinates, as the driver computes them */
    struct {
        const GlslArithmetic *arithmetic;
        signed char *known; /* HANDED, and UNSET: of a variable that has no value */
        double *numbers;    /* of the links */
    } handed[2];            /* as the driver computes, and exactly; filled as they are needed */
} DrawState;

struct Raster {
    const Capture *capture;
    const GlslArithmetic *driver;
    RasterProgram *programs;
    int count, room;
    DrawState *draws;
    const Raster *first; /* which owns what is constant; NULL: this one */
    bool logs, at_pixel; /* see raster_at_pixel */
    bool stopped;        /* see raster_stopped */
    bool unset;          /* see raster_unset */
    const char *kept;    /* see raster_keep */
    /* See raster_observe, by stage. */
    void (*assigned[2])(GlslRun *run, const GlslEvent *event, void *observer);
    void *observer;
};

bool raster_is_filled(const CaptureDraw *draw); /* of triangles */

#endif
