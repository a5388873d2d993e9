/*
 * studio: draws a scene with a quality setting, times it and compares it with the exact picture.
 *
 * One context for all settings, a canvas per kind of framebuffer; programs are kept.
 */
#ifndef STUDIO_H
#define STUDIO_H

#include "lighting/lighting.h"
#include "reference/reference.h"
#include "scene/quality.h"

typedef struct Studio Studio;

/* Every picture has this width and height. `loader` says where shaders are. */
bool studio_open(Studio **studio, const ShaderLoader *loader, const CanvasBackend *backend,
                 int width, int height, Message *message);
const char *studio_renderer(const Studio *studio); /* "llvmpipe (LLVM 15.0.6, 256 bits)" */
const char *studio_version(const Studio *studio);  /* "OpenGL ES 3.2 Mesa 22.3.6" */

/* Drops the meshes of the drawings so far, all of which must be closed. */
void studio_forget(Studio *studio);

/* A scene with a setting, ready to draw: meshes uploaded, programs compiled, one frame drawn. */
typedef struct Drawing {
    Quality quality;
    QualityScene made;
    Lighting *lighting;   /* the studio's */
    const Canvas *canvas; /* the studio's */
    Image image;          /* the last frame */
} Drawing;
bool drawing_open(Drawing *drawing, Studio *studio, const Scene *scene, const Quality *quality,
                  Message *message);

/* Draws one frame and reads it back, with glFinish before and after. *wall: seconds; *gpu: seconds
 * of drawing alone by the driver's timer, NAN if it has none. */
bool drawing_frame(Drawing *drawing, Studio *studio, double *wall, double *gpu, Message *message);

/* The same without the objects: clears, finishes, reads back. */
bool drawing_empty(Drawing *drawing, Studio *studio, double *wall, Message *message);

/* The error of the last frame against the exact picture. */
typedef struct DrawingError {
    double interior_rms, interior_maximum, all_rms, all_maximum; /* in steps of 1/255 */
    int interior_pixels;
} DrawingError;

/* Interior: see pixel_is_interior. */
DrawingError drawing_error(const Drawing *drawing, const Reference *exact);

/* Vertices and visible fragments of the last frame; operations per vertex and per
 * fragment of the costliest program, -1 if no tool counts them. */
typedef struct DrawingCounts {
    long long vertices, fragments;
    int vertex_operations, fragment_operations;
} DrawingCounts;
bool drawing_counts(const Drawing *drawing, Studio *studio, DrawingCounts *counts,
                    Message *message);

void drawing_close(Drawing *drawing);

/* NULL is fine. After every drawing has been closed. */
void studio_close(Studio *studio);

#endif
