/*
 * studio: draws a scene with a setting, times it and compares it with the exact picture.
 *
 * One context for all settings, a canvas for each kind of framebuffer, programs kept from one
 * setting to the next. Needs an open driver.
 */
#ifndef STUDIO_H
#define STUDIO_H

#include "lighting.h"
#include "reference.h"
#include "setting.h"

typedef struct Studio Studio;

/* Width and height are those of every picture. `loader` is for where shaders are looked for. */
bool studio_open(Studio **studio, const ShaderLoader *loader, const CanvasBackend *backend,
                 int width, int height, Message *message);
const char *studio_renderer(const Studio *studio); /* "llvmpipe (LLVM 15.0.6, 256 bits)" */
const char *studio_version(const Studio *studio);  /* "OpenGL ES 3.2 Mesa 22.3.6" */

/* Drops the meshes that were made for the drawings so far, none of which is open. */
void studio_forget(Studio *studio);

/* A setting of a scene, ready to be drawn: its meshes made and uploaded, its programs compiled, one
 * frame drawn. */
typedef struct Drawing {
    Setting setting;
    SettingScene made;
    Lighting *lighting;   /* the studio's */
    const Canvas *canvas; /* the studio's */
    Image image;          /* the last frame */
} Drawing;
bool drawing_open(Drawing *drawing, Studio *studio, const Scene *scene, const Setting *setting,
                  Message *message);

/* Draws one frame and reads it back, with glFinish before and after; the seconds in *wall, those of
 * the driver's own timer (of drawing alone) in *gpu, NAN where it has none. */
bool drawing_frame(Drawing *drawing, Studio *studio, double *wall, double *gpu, Message *message);

/* The same but for the objects: clears, finishes, reads back. */
bool drawing_empty(Drawing *drawing, Studio *studio, double *wall, Message *message);

/* How far the last frame lies from the exact picture. */
typedef struct DrawingError {
    double interior_rms, interior_maximum, all_rms, all_maximum; /* in steps of 1/255 */
    int interior_pixels;
} DrawingError;

/* Interior are the pixels that the exact picture calls so and whose neighbours, in the mesh as
 * drawn, belong to the same object at about the same depth (within 5%): there the two pictures show
 * the same piece of surface. A value that is not finite counts as wrong by 255. The frame's mesh
 * is drawn once more for it. */
bool drawing_error(Drawing *drawing, Studio *studio, const Reference *exact, DrawingError *error,
                   Message *message);

/* Vertices and seen fragments of a frame, after drawing_error; operations of the costliest program
 * at each vertex and fragment, -1 where no tool counts them. */
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
