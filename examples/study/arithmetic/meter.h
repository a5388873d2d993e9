/*
 * meter: lets a driver's vertex and fragment shaders compute, and reads the numbers back.
 */
#ifndef METER_H
#define METER_H

#include "core/canvas.h"
#include "study/arithmetic/functions.h"

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

#endif
