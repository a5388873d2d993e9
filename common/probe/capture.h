/*
 * capture: the draws of a frame as data: sources, uniforms, vertices, textures and state.
 *
 * GL functions are pointers (core/gl.h). While a capture is on, those that upload and draw are
 * functions that note what they are given before they pass it on; else it costs nothing. Begin it
 * before anything is uploaded. What a driver alone knows is asked of it at each draw, so that
 * nobody who draws has to know of this. Depth textures cannot be read in OpenGL ES 2.
 */
#ifndef CAPTURE_H
#define CAPTURE_H

#include "core/canvas.h"

enum { CAPTURE_NAME = 128 };

/* An active attribute: `bytes` of its buffer from its first vertex on, or one value for all. */
typedef struct CaptureAttribute {
    char name[CAPTURE_NAME];
    const unsigned char *bytes; /* NULL: `value` */
    size_t byte_count, stride;
    GLenum type;
    int size;
    bool normalized;
    float value[4];
} CaptureAttribute;

/* An active uniform, of an array each element in turn; a sampler's number is its texture's in the
 * draw, or -1. */
typedef struct CaptureUniform {
    char name[CAPTURE_NAME]; /* without "[0]" */
    GLenum type;
    int length, numbers; /* of elements; of numbers in each */
    float *values;
} CaptureUniform;

typedef struct CaptureTexture {
    GLuint name;
    int width, height, moment;
    float *texels; /* red, green, blue, alpha; the first row is at 0; NULL: it cannot be read */
    bool repeats[2];
} CaptureTexture;

typedef struct CaptureDraw {
    const char *sources[2]; /* by ShaderStage */
    GLenum mode;
    int vertex_count;   /* of the draw */
    unsigned *vertices; /* the number of each */
    CaptureAttribute *attributes;
    CaptureUniform *uniforms;
    CaptureTexture **textures;
    int attribute_count, uniform_count, texture_count;
    int viewport[4], scissor[4];
    bool scissors, blends, tests_depth, writes_depth, culls, tests_stencil, colors[4];
    GLenum depth_func, cull_face, front_face;
    float line_width;
} CaptureDraw;

typedef struct Capture {
    GLuint framebuffer; /* only draws into this one are kept; those before its last whole clear are
                           not */
    CaptureDraw *draws;
    int draw_count;
    float clear_color[4];
    struct CaptureStore *store;
} Capture;

/* One is on at a time. The canvas's context is current until the end. */
void capture_begin(Capture *capture, const Canvas *canvas);

/* GL draws as ever; what was captured stays. */
void capture_end(Capture *capture);

void capture_close(Capture *capture); /* a zeroed one is fine */

/* A vertex's attribute as four numbers, (0, 0, 0, 1) where it has fewer, or lies beyond its buffer.
 */
void capture_attribute(const CaptureAttribute *attribute, unsigned vertex, float value[4]);

#endif
