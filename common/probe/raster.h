/*
 * raster: which triangle of a capture a pixel shows, and its shaders, run for it.
 *
 * Coverage and depth are by OpenGL ES 2.0.25, sections 2.12 to 3.5, and vertices snap to 1/256 of a
 * pixel, as llvmpipe's do. Interpolation is in double precision. Lines and points are not looked
 * for.
 */
#ifndef RASTER_H
#define RASTER_H

#include "glsl/glsl_run.h"
#include "probe/capture.h"

typedef struct Raster Raster;

/* The capture has to live as long. False: a shader cannot be run, and why. */
bool raster_open(Raster **raster, const Capture *capture, const GlslArithmetic *driver,
                 Message *message);
const GlslArithmetic *raster_driver(const Raster *raster); /* what it was opened with */
void raster_close(Raster *raster);                         /* NULL is fine */

/* For another thread: shares what is constant with `first`, and is closed before it. */
Raster *raster_beside(const Raster *first);

typedef struct RasterPixel {
    int draw;            /* of the capture; -1: the background */
    unsigned corners[3]; /* the triangle's vertices, by number in its buffers */
    bool front;
    double weights[3]; /* of the corners: perspective-correct barycentrics */
    double coord[4];   /* gl_FragCoord */
} RasterPixel;

/* In columns and rows of the framebuffer; row 0 is its bottom. */
void raster_find(const Raster *raster, int column, int row, RasterPixel *pixel);

/* The same for all pixels of a window: column, row, width, height. */
void raster_scan(const Raster *raster, const int window[4], RasterPixel *pixels);

/* Runs both stages of a draw for the pixel, with one arithmetic; the fragment's run is returned, as
 * it is until the next. Its numbers are exact after event `exact_from` (INT_MAX: none; only then
 * events are logged). */
const GlslRun *raster_run(Raster *raster, const RasterPixel *pixel,
                          const GlslArithmetic *arithmetic, int exact_from, double color[4]);

/* The same with the driver's arithmetic for the events[0], events[1] and events[2] of
 * glsl_run_each; then raster_color is the fragment's colour. */
void raster_run_each(Raster *raster, const RasterPixel *pixel, const int events[3], GlslEach *each,
                     void *context);
void raster_color(GlslRun *run, double color[4]);

/* Whether a loop did not end for a pixel: from then on each run of its shader has few turns. */
bool raster_stopped(const Raster *raster);

/* Whether a vertex of the last pixel that was run read a variable that has no value. */
bool raster_unset(const Raster *raster);

/* Whatever the arithmetic, this varying is what the driver computes; NULL: none. */
void raster_keep(Raster *raster, const char *varying);

/* The varyings are not interpolated, but what the vertex stage computes of the interpolated
 * attributes: as if its lines stood in the fragment's shader. */
void raster_at_pixel(Raster *raster, bool computed);

/* Events are logged with `exact_from`, too. */
void raster_log(Raster *raster, bool always);

/* Is called in each run of a stage from now on, after each assignment, which it may change
 * (glsl_run.h); NULL: no more. */
void raster_observe(Raster *raster, int stage,
                    void (*assigned)(GlslRun *run, const GlslEvent *event, void *observer),
                    void *observer);

/* Runs the vertex stage. */
const GlslRun *raster_vertex(Raster *raster, int draw, unsigned vertex,
                             const GlslArithmetic *arithmetic);

/* What a sampler has that is not read, and is black instead; NULL: nothing, or it is no sampler. */
const char *raster_unread(const CaptureDraw *draw, const CaptureUniform *uniform);

/* NULL: not a draw of triangles. */
const GlslCode *raster_code(const Raster *raster, int draw, int stage);

#endif
