/*
 * Each draw gets buffers of its own: its vertices in the order in which they are drawn, so that
 * there are no indices. A program is linked once for all draws of the same texts.
 */
#include "probe/replay.h"

#include "base/memory.h"

#include <stdlib.h>

typedef struct Linked {
    const char *sources[2]; /* the draws' own */
    GLuint program;         /* 0: left out */
} Linked;

typedef struct Replay {
    ReplaySources *sources;
    void *context;
    Linked *linked;
    int count, room;
} Replay;

static GLuint compile(GLenum stage, const char *text, Message *message)
{
    char log[512] = "";
    GLint compiled = 0;
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return shader;
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    glDeleteShader(shader);
    message_set(message, "the driver refuses a changed shader: %s", log);
    return 0;
}

static GLuint link_texts(const char *const texts[2], Message *message)
{
    GLint linked = 0;
    const GLuint vertex = compile(GL_VERTEX_SHADER, texts[0], message);
    const GLuint fragment = vertex ? compile(GL_FRAGMENT_SHADER, texts[1], message) : 0;
    GLuint program = fragment ? glCreateProgram() : 0;
    if (program) {
        glAttachShader(program, vertex);
        glAttachShader(program, fragment);
        /* In desktop OpenGL nothing is drawn without an array for attribute 0. */
        glBindAttribLocation(program, 0, "a_Position");
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
    }
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    if (program && !linked) {
        glDeleteProgram(program);
        message_set(message, "the driver does not link a changed shader");
        program = 0;
    }
    return program;
}

/* False: it cannot be linked. */
static bool find_program(Replay *replay, const CaptureDraw *draw, GLuint *program, Message *message)
{
    char *changed[2] = {NULL, NULL};
    for (int i = 0; i < replay->count; i++) {
        const Linked *known = &replay->linked[i];
        *program = known->program;
        if (known->sources[0] == draw->sources[0] && known->sources[1] == draw->sources[1])
            return true;
    }
    *program = 0;
    if (!draw->sources[0] || !draw->sources[1])
        return message_set(message, "a program without its sources was drawn with");
    const bool drawn = !replay->sources || replay->sources(draw, changed, replay->context);
    const char *const texts[2] = {changed[0] ? changed[0] : draw->sources[0],
                                  changed[1] ? changed[1] : draw->sources[1]};
    *program = drawn ? link_texts(texts, message) : 0;
    free(changed[0]);
    free(changed[1]);
    Linked *made = memory_add(&replay->linked, &replay->count, &replay->room, sizeof *made);
    *made = (Linked){{draw->sources[0], draw->sources[1]}, *program};
    return *program || !drawn;
}

static void set_numbers(const CaptureUniform *uniform, GLint location, const float *v)
{
    switch (uniform->type) {
    case GL_FLOAT_MAT2:
        glUniformMatrix2fv(location, 1, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT3:
        glUniformMatrix3fv(location, 1, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT4:
        glUniformMatrix4fv(location, 1, GL_FALSE, v);
        break;
    case GL_FLOAT:
        glUniform1fv(location, 1, v);
        break;
    case GL_FLOAT_VEC2:
        glUniform2fv(location, 1, v);
        break;
    case GL_FLOAT_VEC3:
        glUniform3fv(location, 1, v);
        break;
    case GL_FLOAT_VEC4:
        glUniform4fv(location, 1, v);
        break;
    default: { /* ints and bools, of one to four */
        GLint whole[4] = {0};
        for (int i = 0; i < uniform->numbers && i < 4; i++)
            whole[i] = (GLint)v[i];
        if (uniform->numbers == 1)
            glUniform1i(location, whole[0]);
        else if (uniform->numbers == 2)
            glUniform2iv(location, 1, whole);
        else if (uniform->numbers == 3)
            glUniform3iv(location, 1, whole);
        else
            glUniform4iv(location, 1, whole);
    }
    }
}

static GLuint make_texture(const CaptureTexture *texture)
{
    const size_t count = 4 * (size_t)texture->width * (size_t)texture->height;
    unsigned char *bytes = memory_new(count, 1);
    GLuint name = 0;
    for (size_t i = 0; i < count; i++)
        bytes[i] = (unsigned char)(255 * texture->texels[i] + 0.5F);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, texture->width, texture->height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, bytes);
    free(bytes);
    const GLint filter = texture->linear ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    for (int i = 0; i < 2; i++)
        glTexParameteri(GL_TEXTURE_2D, i ? GL_TEXTURE_WRAP_T : GL_TEXTURE_WRAP_S,
                        texture->repeats[i] ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    return name;
}

static void set_uniforms(const CaptureDraw *draw, GLuint program)
{
    for (int i = 0; i < draw->uniform_count; i++) {
        const CaptureUniform *uniform = &draw->uniforms[i];
        for (int k = 0; k < uniform->length; k++) {
            char *name = memory_format(uniform->length > 1 ? "%s[%d]" : "%s", uniform->name, k);
            const GLint location = glGetUniformLocation(program, name);
            if (location >= 0)
                set_numbers(uniform, location, uniform->values + k * uniform->numbers);
            free(name);
        }
    }
}

static GLuint set_attribute(const CaptureDraw *draw, const CaptureAttribute *attribute,
                            GLint location)
{
    GLuint buffer = 0;
    if (location < 0)
        return 0;
    if (!attribute->bytes) {
        glDisableVertexAttribArray((GLuint)location);
        glVertexAttrib4fv((GLuint)location, attribute->value);
        return 0;
    }
    float *values = memory_new(4 * (size_t)draw->vertex_count + 1, sizeof *values);
    for (int i = 0; i < draw->vertex_count; i++)
        capture_attribute(attribute, draw->vertices[i], values + 4 * i);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(4 * sizeof *values * (size_t)draw->vertex_count),
                 values, GL_STREAM_DRAW);
    free(values);
    glVertexAttribPointer((GLuint)location, 4, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray((GLuint)location);
    return buffer;
}

static void set_enabled(GLenum what, bool on)
{
    if (on)
        glEnable(what);
    else
        glDisable(what);
}

static void set_state(const CaptureDraw *draw)
{
    const int *v = draw->viewport, *s = draw->scissor;
    glViewport(v[0], v[1], v[2], v[3]);
    glScissor(s[0], s[1], s[2], s[3]);
    set_enabled(GL_SCISSOR_TEST, draw->scissors);
    set_enabled(GL_DEPTH_TEST, draw->tests_depth);
    set_enabled(GL_CULL_FACE, draw->culls);
    glDepthFunc(draw->depth_func);
    glDepthMask(draw->writes_depth);
    glCullFace(draw->cull_face);
    glFrontFace(draw->front_face);
    glColorMask(draw->colors[0], draw->colors[1], draw->colors[2], draw->colors[3]);
    glLineWidth(draw->line_width);
    set_enabled(GL_POLYGON_OFFSET_FILL, draw->offsets);
    glPolygonOffset(draw->offset[0], draw->offset[1]);
}

static void draw_one(const CaptureDraw *draw, GLuint program)
{
    enum { MOST = 16 };
    GLuint buffers[MOST] = {0}, textures[MOST] = {0};
    GLint attributes = 0;
    glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &attributes);
    for (GLint i = 0; i < attributes; i++)
        glDisableVertexAttribArray((GLuint)i);
    glUseProgram(program);
    set_state(draw);
    set_uniforms(draw, program);
    for (int i = 0; i < draw->texture_count && i < MOST; i++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)i);
        if (draw->textures[i]->texels)
            textures[i] = make_texture(draw->textures[i]);
        else
            glBindTexture(GL_TEXTURE_2D, draw->textures[i]->name);
    }
    for (int i = 0; i < draw->attribute_count && i < MOST; i++)
        buffers[i] = set_attribute(draw, &draw->attributes[i],
                                   glGetAttribLocation(program, draw->attributes[i].name));
    glDrawArrays(draw->mode, 0, draw->vertex_count);
    for (int i = 0; i < draw->texture_count && i < MOST; i++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)i);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    glActiveTexture(GL_TEXTURE0);
    glDeleteBuffers(MOST, buffers);
    glDeleteTextures(MOST, textures);
}

bool replay_draw(const Capture *capture, const Canvas *canvas, ReplaySources *sources,
                 void *context, Message *message)
{
    Replay replay = {.sources = sources, .context = context};
    const float *c = capture->clear_color;
    bool done = true;
    canvas_clear(canvas, vec3_from_float(c), (double)c[3]);
    for (int i = 0; i < capture->draw_count && done; i++) {
        GLuint program = 0;
        done = find_program(&replay, &capture->draws[i], &program, message);
        if (program)
            draw_one(&capture->draws[i], program);
    }
    canvas_begin(canvas);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    for (int i = 0; i < replay.count; i++)
        glDeleteProgram(replay.linked[i].program);
    free(replay.linked);
    return done;
}
