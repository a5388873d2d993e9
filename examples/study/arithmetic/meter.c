/*
 * A shader as an arithmetic unit: inputs come in textures or attributes, one point a pixel is
 * drawn, and its colour, a 32-bit float, is the result. First both shaders have to pass numbers of
 * 24 bits unchanged, because otherwise what is read back says nothing of what was computed.
 */
#include "study/arithmetic/arithmetic.h"

#include "base/memory.h"
#include "core/shader.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 512, HEIGHT = 256 };
_Static_assert(BATCH_COUNT <= WIDTH * HEIGHT, "a batch fits");

const char *const METER_PRECISION_NAMES[METER_PRECISIONS] = {"highp", "mediump", "lowp"};
const char *const METER_STAGE_NAMES[METER_STAGES] = {"vertex", "fragment"};

/* The inputs are highp, so that they arrive whole. They and the result are multiplied by ONE, which
 * the compiler does not know to be 1: Mesa computes a single operation between two highp numbers in
 * highp, whatever it is declared as, and only chains of operations as in a scene's shaders in
 * mediump. The shaders: study/meter_vertex and study/meter_fragment. */
static GLuint program_of(const char *code, const char *one, MeterStage stage,
                         MeterPrecision precision, Message *message)
{
    char defines[3][256];
    const char *const lines[] = {defines[0], defines[1], defines[2], NULL};
    const ShaderLoader loader = {.defines = lines};
    Shader shader;
    snprintf(defines[0], sizeof defines[0], "PRECISION %s", METER_PRECISION_NAMES[precision]);
    snprintf(defines[1], sizeof defines[1], "ONE %s", one);
    snprintf(defines[2], sizeof defines[2], "CODE %s", code);
    return shader_open(&shader, &loader,
                       stage == METER_VERTEX ? "study/meter_vertex" : "study/meter_fragment",
                       message)
               ? shader.program
               : 0;
}

GLuint meter_program(const char *code, MeterStage stage, MeterPrecision precision, Message *message)
{
    return program_of(code, "u_One", stage, precision, message);
}

GLuint meter_copy(MeterStage stage, Message *message)
{
    return program_of("a", "1.0", stage, METER_HIGHP, message);
}

static void load_texture(GLuint texture, const float (*values)[4], int rows)
{
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F_EXT, WIDTH, rows, 0, GL_RGBA, GL_FLOAT, values);
}

static int rows_of(int count)
{
    return (count + WIDTH - 1) / WIDTH;
}

void meter_load(const Meter *meter, const float (*a)[4], const float (*b)[4], int count)
{
    const float(*const values[2])[4] = {a, b};
    for (int i = 0; i < 2; i++) {
        load_texture(meter->textures[i], values[i], rows_of(count));
        glBindBuffer(GL_ARRAY_BUFFER, meter->buffers[i]);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)count * 16, values[i], GL_STREAM_DRAW);
    }
}

static void draw_points(const Meter *meter, GLuint program, int count)
{
    static const char *const names[] = {"a_A", "a_B", "a_Position"};
    GLint at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = glGetAttribLocation(program, names[i]);
        if (at[i] < 0)
            continue; /* a function of `a` alone */
        glBindBuffer(GL_ARRAY_BUFFER, meter->buffers[i]);
        glVertexAttribPointer((GLuint)at[i], i < 2 ? 4 : 2, GL_FLOAT, GL_FALSE, 0, NULL);
        glEnableVertexAttribArray((GLuint)at[i]);
    }
    glDrawArrays(GL_POINTS, 0, count);
    for (int i = 0; i < 3; i++)
        if (at[i] >= 0)
            glDisableVertexAttribArray((GLuint)at[i]);
}

static void draw_rectangle(const Meter *meter, GLuint program)
{
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const GLuint position = (GLuint)glGetAttribLocation(program, "a_Position");
    glUniform1i(glGetUniformLocation(program, "u_A"), 0);
    glUniform1i(glGetUniformLocation(program, "u_B"), 1);
    for (GLenum i = 0; i < 2; i++) {
        glActiveTexture(GL_TEXTURE0 + i);
        glBindTexture(GL_TEXTURE_2D, meter->textures[i]);
    }
    glActiveTexture(GL_TEXTURE0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glVertexAttribPointer(position, 2, GL_FLOAT, GL_FALSE, 0, corners);
    glEnableVertexAttribArray(position);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDisableVertexAttribArray(position);
}

void meter_draw(const Meter *meter, GLuint program, MeterStage stage, int count)
{
    canvas_begin(&meter->canvas);
    glViewport(0, 0, WIDTH, stage == METER_VERTEX ? HEIGHT : rows_of(count));
    glUseProgram(program);
    glUniform1fv(glGetUniformLocation(program, "u_One"), 1, (const float[]){1});
    if (stage == METER_VERTEX)
        draw_points(meter, program, count);
    else
        draw_rectangle(meter, program);
}

bool meter_run(const Meter *meter, GLuint program, MeterStage stage, float (*results)[4], int count,
               Message *message)
{
    meter_draw(meter, program, stage, count);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, WIDTH, rows_of(count), GL_RGBA, GL_FLOAT, results);
    const GLenum error = glGetError();
    return error == GL_NO_ERROR || message_set(message, "measuring in the %s shader: %s",
                                               METER_STAGE_NAMES[stage], gl_error_name(error));
}

Claim meter_claim(MeterStage stage, MeterPrecision precision)
{
    static const GLenum kinds[METER_PRECISIONS] = {GL_HIGH_FLOAT, GL_MEDIUM_FLOAT, GL_LOW_FLOAT};
    GLint range[2] = {0, 0}, bits = 0;
    glGetShaderPrecisionFormat(stage == METER_VERTEX ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER,
                               kinds[precision], range, &bits);
    return (Claim){range[0], range[1], bits};
}

/* By a program of meter_program, which it deletes. */
static bool compute(const Meter *meter, GLuint program, MeterStage stage,
                    const FormatProbes *probes, float results[FORMAT_PROBES], Message *message)
{
    float inputs[FORMAT_PROBES][4], found[FORMAT_PROBES][4];
    if (!program)
        return false;
    for (int i = 0; i < FORMAT_PROBES; i++) {
        inputs[i][0] = probes->x[i];
        inputs[i][1] = probes->y[i];
        inputs[i][2] = probes->z[i];
        inputs[i][3] = 0;
    }
    meter_load(meter, (const float(*)[4])inputs, (const float(*)[4])inputs, FORMAT_PROBES);
    const bool done = meter_run(meter, program, stage, found, FORMAT_PROBES, message);
    glDeleteProgram(program);
    for (int i = 0; i < FORMAT_PROBES && done; i++)
        results[i] = found[i][0];
    return done;
}

bool meter_format(const Meter *meter, MeterStage stage, MeterPrecision precision, Format *format,
                  Message *message)
{
    FormatProbes probes;
    float sums[FORMAT_PROBES], products[FORMAT_PROBES];
    format_sums(&probes);
    GLuint program = meter_program("vec4(a.x + a.y)", stage, precision, message);
    if (!compute(meter, program, stage, &probes, sums, message))
        return false;
    format_products(&probes);
    program = meter_program("vec4((a.x * a.y) * a.z)", stage, precision, message);
    if (!compute(meter, program, stage, &probes, products, message))
        return false;
    return format_of(sums, products, format) ||
           message_set(message, "%s: %s numbers of the %s shader are no floating-point numbers",
                       meter->canvas.renderer, METER_PRECISION_NAMES[precision],
                       METER_STAGE_NAMES[stage]);
}

static bool prepare(Meter *meter, Message *message)
{
    if (!meter->canvas.real)
        return message_set(message,
                           "%s: cannot draw to 32-bit floats (GL_EXT_color_buffer_float), from "
                           "which results are read",
                           meter->canvas.renderer);
    glGenTextures(2, meter->textures);
    glGenBuffers(3, meter->buffers);
    for (int i = 0; i < 2; i++) {
        glBindTexture(GL_TEXTURE_2D, meter->textures[i]);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    /* Positions at the centers of pixels, row by row. */
    float(*at)[2] = memory_new(BATCH_COUNT, sizeof *at);
    for (int i = 0; i < BATCH_COUNT; i++) {
        at[i][0] = (float)(2 * (i % WIDTH + 0.5) / WIDTH - 1);
        at[i][1] = (float)(2 * (i / WIDTH + 0.5) / HEIGHT - 1);
    }
    glBindBuffer(GL_ARRAY_BUFFER, meter->buffers[2]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)sizeof(float[2]) * BATCH_COUNT, at, GL_STATIC_DRAW);
    free(at);
    /* Whether numbers with 24 significant bits pass both stages unchanged. */
    enum { COUNT = 512 };
    float inputs[COUNT][4], found[COUNT][4];
    for (int i = 0; i < 4 * COUNT; i++)
        inputs[i / 4][i % 4] = ldexpf((float)(0x800001 + 4097 * i), i % 200 - 123);
    meter_load(meter, (const float(*)[4])inputs, (const float(*)[4])inputs, COUNT);
    for (int stage = 0; stage < METER_STAGES; stage++) {
        const GLuint program = meter_copy((MeterStage)stage, message);
        if (!program || !meter_run(meter, program, (MeterStage)stage, found, COUNT, message))
            return false;
        glDeleteProgram(program);
        if (memcmp(inputs, found, sizeof found) != 0)
            return message_set(message,
                               "%s: highp of the %s shader has fewer than 24 bits, whatever the "
                               "driver says: results cannot be read",
                               meter->canvas.renderer, METER_STAGE_NAMES[stage]);
    }
    return true;
}

bool meter_open(Meter *meter, const CanvasBackend *backend, Message *message)
{
    const CanvasOptions options = {
        .backend = backend, .width = WIDTH, .height = HEIGHT, .real = true};
    *meter = (Meter){.canvas = {.context = NULL}};
    if (!canvas_open(&meter->canvas, &options, message))
        return false;
    if (prepare(meter, message))
        return true;
    meter_close(meter);
    return false;
}

void meter_close(Meter *meter)
{
    canvas_close(&meter->canvas); /* its textures and buffers, too */
}
