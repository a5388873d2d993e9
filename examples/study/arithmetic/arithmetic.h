/*
 * arithmetic: all that is measured of a driver's arithmetic, what it can make of a picture, and
 * both as text, JSON and a plot.
 */
#ifndef ARITHMETIC_H
#define ARITHMETIC_H

#include "core/canvas.h"
#include "glsl/glsl_bound.h"
#include "scene/scene.h"
#include "study/arithmetic/functions.h"

#include <stdio.h>

/* Lets a driver's vertex and fragment shaders compute, and reads the numbers back. */

typedef enum MeterPrecision {
    METER_HIGHP,
    METER_MEDIUMP,
    METER_LOWP,
    METER_PRECISIONS
} MeterPrecision;
typedef enum MeterStage { METER_VERTEX, METER_FRAGMENT, METER_STAGES } MeterStage;
extern const char *const METER_PRECISION_NAMES[METER_PRECISIONS];
extern const char *const METER_STAGE_NAMES[METER_STAGES];

/* Draws one pixel for each invocation into a canvas of floats: a pixel's fragment, or a vertex with
 * a point as large as a pixel. */
typedef struct Meter {
    Canvas canvas;
    GLuint textures[2], buffers[3]; /* of a and b; and of the points' positions */
} Meter;

/* False if the driver cannot draw to floats, or if a number does not come back as it was. */
bool meter_open(Meter *meter, const CanvasBackend *backend, Message *message);
void meter_close(Meter *meter);

/* Compiles what computes `code`, an expression of vec4 a and vec4 b; or what passes `a` on, as
 * highp, and computes nothing. 0, with a message, on failure. */
GLuint meter_program(const char *code, MeterStage stage, MeterPrecision precision,
                     Message *message);
GLuint meter_copy(MeterStage stage, Message *message);

/* Invocations of up to BATCH_COUNT inputs, then of results: four numbers each. */
void meter_load(const Meter *meter, const float (*a)[4], const float (*b)[4], int count);
void meter_draw(const Meter *meter, GLuint program, MeterStage stage, int count);
bool meter_run(const Meter *meter, GLuint program, MeterStage stage, float (*results)[4], int count,
               Message *message);

/* What the driver says about a precision. */
Claim meter_claim(MeterStage stage, MeterPrecision precision);

/* The format of a precision, from what it computes. */
bool meter_format(const Meter *meter, MeterStage stage, MeterPrecision precision, Format *format,
                  Message *message);

/* What happens between vertex and picture: interpolation, edges, positions, depth, and the
 * framebuffer's rounding. */

enum { RASTER_SUBPIXELS = 10 }; /* as many bits can be told */

typedef struct Raster {
    double units; /* the largest error of varyings, of triangles of many shapes, in raster_units */
    /* Of quadrilaterals of two triangles, of pixels that the shared edge passes: drawn twice, not.
     */
    long edge_pixels, edge_twice, edge_missed;
    double bytes;         /* the largest error of rounding to 8 bits, in steps */
    int color_bits;       /* bits that a colour is cut to before that; 0: none is lost */
    int subpixel_bits;    /* of positions: of a pixel's width 2^-bits is resolved; at most
                             RASTER_SUBPIXELS */
    int claimed_subpixel; /* GL_SUBPIXEL_BITS */
    int depth_bits;       /* 2^-bits of the depth's range is resolved on average */
    double depth_step;    /* the largest difference of depths not told apart, in that unit */
    double depth_error;   /* by how much two triangles in one plane differ, in that unit */
} Raster;

bool raster_measure(const Meter *meter, Raster *raster, Message *message);

/* A number at a corner of a triangle, and by how much those at the next two differ from it. */
typedef GlslRange RasterNumber[3];

/* What a triangle's place and shape make of errors of what is interpolated in it, by planes in the
 * window's coordinates, of numbers / w and of 1 / w (OpenGL ES 2.0 specification, 3.5.1). */
typedef struct RasterTriangle {
    RasterNumber place[3]; /* clip coordinates x, y and w */
    GlslRange area;        /* their determinant: positive, if it is seen counterclockwise */
    double height;         /* above its longest side, in pixels, at least */
    double high;           /* the largest w */
    double extent[2];      /* the numbers its window coordinates are made of, in half windows */
    double shape;          /* its longest side over its height */
    double most, slope;
} RasterTriangle;
GlslRange raster_determinant(const RasterNumber x, const RasterNumber y, const RasterNumber w);

/* Of its place. `half`: the window's width and height, in pixels, halved. Lower triangles than
 * 2 steps of the positions' grid have all points beside a side, and are left out. */
void raster_triangle(RasterTriangle *triangle, const double half[2], int subpixel_bits);

/* The largest error is Raster's units times this times 2^-24: what a unit in the last place of the
 * window's coordinates, of the planes' slopes, and of itself changes. */
double raster_units(const RasterTriangle *triangle, const RasterNumber number);

/* Of one precision in one stage. */
typedef struct Arithmetic {
    Format format;
    Claim claim;
    Accuracy accuracies[FUNCTION_COUNT];
} Arithmetic;

typedef struct Arithmetics {
    char renderer[128], version[128];
    Arithmetic of[METER_STAGES][METER_PRECISIONS];
    Raster raster;
    long inputs; /* of each function, unless that is more than there are */
    double seconds;
} Arithmetics;

/* All. `inputs`: of each function; 0: 2^24, or fewer where that would take more than a minute.
 * Draws a progress bar. */
bool arithmetic_measure(const Meter *meter, long inputs, Arithmetics *found, Message *message);

/* "fragment shaders compute with 24 bits in highp, 11 in mediump, 11 in lowp; vertex shaders..." */
enum { ARITHMETIC_LINE = 160 };
void arithmetic_line(const Arithmetics *found, char line[ARITHMETIC_LINE]);

/* The largest error that measured arithmetic can make in the picture of a scene: its shaders, as
 * the driver gets them, run with ranges that hold all that the largest measured error of each
 * operation allows (glsl/glsl_bound.h). They are taken from a frame that is drawn for that: a
 * canvas is open, whose picture changes. */

/* In steps of 1/255, against the exact picture of the meshes as given, inside objects: at least the
 * half step of rounding, at most 255. `height`: of the picture, in pixels. `fragment`: of the
 * precision that its fragment shader declares. The scene has passed scene_check, and its objects
 * have meshes. Shadows are left out. It is sampled at the corners of the triangles and between, at
 * 5000 points and more. */
double predict_scene(const Scene *scene, int height, const Arithmetic *vertex,
                     const Arithmetic *fragment, const Raster *raster);

/* What of that the power function alone adds to a highlight of this shininess, as bright as can be.
 */
double predict_pow(const Arithmetic *fragment, double shininess);

/* What the largest errors in pictures can be, by class of scene. */
enum { FORECAST_SCENES = 8, FORECAST_SHININESSES = 3 };
typedef struct Forecast {
    int height;                          /* of the pictures, in pixels */
    const char *scenes[FORECAST_SCENES]; /* what it is */
    double steps[FORECAST_SCENES][2];    /* in highp and in mediump; in steps of 1/255 */
    double shininess[FORECAST_SHININESSES], power[FORECAST_SHININESSES][2]; /* of pow alone */
} Forecast;
bool forecast_make(const Arithmetics *found, int height, Forecast *forecast, Message *message);

/* Tables of some fifty lines, or of Markdown. */
void arithmetic_text(const Arithmetics *found, const Forecast *forecast, bool markdown, FILE *file);

/* One object. */
void arithmetic_json(const Arithmetics *found, const Forecast *forecast, FILE *file);

/* FOLDER/precision.svg and .png: the largest error of some functions by the size of what they get.
 * False if gnuplot is missing. */
bool arithmetic_plot(const Arithmetics *found, const char *folder, Message *message);

#endif
