/*
 * What is uploaded is copied when it is, because OpenGL ES does not give it back; textures that are
 * drawn are read when a draw samples them, once until something else is drawn into any of them.
 * Programs are compiled from their sources while a capture is on, for a binary has none.
 */
#include "probe/capture.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A copy of what a buffer held from one upload to the next. */
typedef struct Block {
    GLuint buffer;
    unsigned char *bytes;
    size_t size;
} Block;

typedef struct TextureSize {
    GLuint name;
    GLenum format;
    int width, height;
} TextureSize;

typedef struct CaptureStore {
    Block *blocks;
    TextureSize *sizes;
    CaptureTexture **textures;
    char **texts; /* sources, each once */
    int block_count, size_count, texture_count, text_count;
    GLuint *shaders; /* deleted at the end: WebGL does not tell the source of a deleted one */
    int shader_count;
    int moment; /* changes with what textures may hold */
} CaptureStore;

static Capture *current;

/* Those that a capture replaces. */
#define REPLACED(X)                                                                                \
    X(BUFFERDATA, BufferData)                                                                      \
    X(BUFFERSUBDATA, BufferSubData)                                                                \
    X(TEXIMAGE2D, TexImage2D)                                                                      \
    X(CLEAR, Clear)                                                                                \
    X(DRAWARRAYS, DrawArrays)                                                                      \
    X(DRAWELEMENTS, DrawElements)                                                                  \
    X(DELETESHADER, DeleteShader)
#define X(TYPE, name) static PFNGL##TYPE##PROC driver##name;
REPLACED(X)
#undef X
static PFNGLPROGRAMBINARYOESPROC driver_binary;

/* One more element at the end of a list. */
static void *grow(void *list, int *count, size_t size)
{
    char *more = memory_grow(list, (size_t)*count + 1, size);
    memset(more + (size_t)*count * size, 0, size);
    ++*count;
    return more;
}

static GLuint bound(GLenum binding)
{
    GLint name = 0;
    glGetIntegerv(binding, &name);
    return (GLuint)name;
}

/* Uploads */

static Block *block_of(GLuint buffer)
{
    const CaptureStore *store = current->store;
    for (int i = store->block_count - 1; i >= 0; i--)
        if (store->blocks[i].buffer == buffer)
            return &store->blocks[i];
    return NULL;
}

static GLuint target_buffer(GLenum target)
{
    return bound(target == GL_ARRAY_BUFFER ? GL_ARRAY_BUFFER_BINDING
                                           : GL_ELEMENT_ARRAY_BUFFER_BINDING);
}

/* Draws keep what the blocks before hold. */
static void keep_block(GLuint buffer, size_t size, const void *bytes)
{
    CaptureStore *store = current->store;
    store->blocks = grow(store->blocks, &store->block_count, sizeof *store->blocks);
    Block *block = &store->blocks[store->block_count - 1];
    *block = (Block){buffer, memory_new(size ? size : 1, 1), size};
    if (bytes)
        memcpy(block->bytes, bytes, size);
}

static void GL_APIENTRY buffer_data(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
    keep_block(target_buffer(target), (size_t)size, data);
    driverBufferData(target, size, data, usage);
}

static void GL_APIENTRY buffer_sub_data(GLenum target, GLintptr offset, GLsizeiptr size,
                                        const void *data)
{
    const Block *old = block_of(target_buffer(target));
    if (old && (size_t)offset + (size_t)size <= old->size) {
        keep_block(old->buffer, old->size, old->bytes);
        memcpy(block_of(target_buffer(target))->bytes + offset, data, (size_t)size);
    }
    driverBufferSubData(target, offset, size, data);
}

static void GL_APIENTRY tex_image(GLenum target, GLint level, GLint internal, GLsizei width,
                                  GLsizei height, GLint border, GLenum format, GLenum type,
                                  const void *pixels)
{
    CaptureStore *store = current->store;
    if (target == GL_TEXTURE_2D && level == 0) {
        store->sizes = grow(store->sizes, &store->size_count, sizeof *store->sizes);
        store->sizes[store->size_count - 1] =
            (TextureSize){bound(GL_TEXTURE_BINDING_2D), format, width, height};
        store->moment++;
    }
    driverTexImage2D(target, level, internal, width, height, border, format, type, pixels);
}

/* Textures */

/* Its colours as the driver converts them to floats: of bytes, exactly b / 255. */
static float *read_texels(GLuint texture, int width, int height)
{
    const GLuint framebuffer = bound(GL_FRAMEBUFFER_BINDING);
    const size_t count = 4 * (size_t)width * (size_t)height;
    unsigned char *bytes = memory_new(count, 1);
    float *texels = NULL;
    GLuint reader = 0;
    GLint alignment = 4;
    glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
    glGenFramebuffers(1, &reader);
    glBindFramebuffer(GL_FRAMEBUFFER, reader);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) {
        glPixelStorei(GL_PACK_ALIGNMENT, 4);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
        glPixelStorei(GL_PACK_ALIGNMENT, alignment);
        texels = memory_new(count, sizeof *texels);
        for (size_t i = 0; i < count; i++)
            texels[i] = (float)bytes[i] / 255;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glDeleteFramebuffers(1, &reader);
    free(bytes);
    return texels;
}

static void note_wrapping(CaptureTexture *texture)
{
    GLint wrap[2] = {GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE};
    glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, &wrap[0]);
    glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, &wrap[1]);
    for (int i = 0; i < 2; i++)
        texture->repeats[i] = wrap[i] == GL_REPEAT;
}

/* The texture of a unit; NULL: none, or one of unknown size. */
static CaptureTexture *texture_of(int unit)
{
    CaptureStore *store = current->store;
    const TextureSize *size = NULL;
    CaptureTexture *texture = NULL;
    GLint active = GL_TEXTURE0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    const GLuint name = bound(GL_TEXTURE_BINDING_2D);
    for (int i = 0; i < store->size_count; i++)
        if (name && store->sizes[i].name == name)
            size = &store->sizes[i];
    for (int i = 0; size && i < store->texture_count; i++)
        if (store->textures[i]->name == name && store->textures[i]->moment == store->moment)
            texture = store->textures[i];
    if (size && !texture) {
        store->textures = grow(store->textures, &store->texture_count, sizeof *store->textures);
        texture = store->textures[store->texture_count - 1] = memory_new(1, sizeof *texture);
        *texture = (CaptureTexture){
            .name = name, .width = size->width, .height = size->height, .moment = store->moment};
        texture->texels = size->format == GL_RGBA || size->format == GL_RGB
                              ? read_texels(name, size->width, size->height)
                              : NULL;
        note_wrapping(texture);
    }
    glActiveTexture((GLenum)active);
    return texture;
}

/* Draws */

static const char *keep_text(char *text)
{
    CaptureStore *store = current->store;
    for (int i = 0; i < store->text_count; i++) {
        if (strcmp(store->texts[i], text) == 0) {
            free(text);
            return store->texts[i];
        }
    }
    store->texts = grow(store->texts, &store->text_count, sizeof *store->texts);
    return store->texts[store->text_count - 1] = text;
}

static void note_sources(CaptureDraw *draw, GLuint program)
{
    GLuint shaders[2] = {0, 0};
    GLsizei count = 0;
    glGetAttachedShaders(program, 2, &count, shaders);
    for (int i = 0; i < count; i++) {
        GLint type = 0, length = 0;
        glGetShaderiv(shaders[i], GL_SHADER_TYPE, &type);
        glGetShaderiv(shaders[i], GL_SHADER_SOURCE_LENGTH, &length);
        char *text = memory_new((size_t)length + 1, 1);
        glGetShaderSource(shaders[i], length + 1, NULL, text);
        draw->sources[type == GL_FRAGMENT_SHADER] = keep_text(text);
    }
}

static void note_attribute(CaptureDraw *draw, GLuint program, int index)
{
    CaptureAttribute made = {.size = 4};
    GLint length = 0;
    GLenum type = 0;
    glGetActiveAttrib(program, (GLuint)index, sizeof made.name, NULL, &length, &type, made.name);
    const GLint location = glGetAttribLocation(program, made.name);
    if (location < 0)
        return;
    const CanvasAttribute set = canvas_attribute((GLuint)location);
    const Block *block = set.enabled ? block_of((GLuint)set.buffer) : NULL;
    const size_t offset = (size_t)set.pointer;
    memcpy(made.value, set.value, sizeof made.value);
    if (block && offset < block->size) {
        const size_t one = set.type == GL_FLOAT                                    ? 4
                           : set.type == GL_SHORT || set.type == GL_UNSIGNED_SHORT ? 2
                                                                                   : 1;
        made.bytes = block->bytes + offset;
        made.byte_count = block->size - offset;
        made.stride = set.stride ? (size_t)set.stride : one * (size_t)set.size;
        made.type = (GLenum)set.type;
        made.size = set.size;
        made.normalized = set.normalized;
    }
    draw->attributes = grow(draw->attributes, &draw->attribute_count, sizeof made);
    draw->attributes[draw->attribute_count - 1] = made;
}

static int numbers_of(GLenum type)
{
    switch (type) {
    case GL_FLOAT_VEC2:
    case GL_INT_VEC2:
    case GL_BOOL_VEC2:
        return 2;
    case GL_FLOAT_VEC3:
    case GL_INT_VEC3:
    case GL_BOOL_VEC3:
        return 3;
    case GL_FLOAT_VEC4:
    case GL_INT_VEC4:
    case GL_BOOL_VEC4:
    case GL_FLOAT_MAT2:
        return 4;
    case GL_FLOAT_MAT3:
        return 9;
    case GL_FLOAT_MAT4:
        return 16;
    default:
        return 1;
    }
}

static void note_texture(CaptureDraw *draw, float *unit)
{
    CaptureTexture *texture = texture_of((int)*unit);
    *unit = -1;
    if (!texture)
        return;
    *unit = (float)draw->texture_count;
    draw->textures = grow(draw->textures, &draw->texture_count, sizeof(CaptureTexture *));
    draw->textures[draw->texture_count - 1] = texture;
}

static void note_uniform(CaptureDraw *draw, GLuint program, int index)
{
    CaptureUniform made = {.length = 1};
    glGetActiveUniform(program, (GLuint)index, sizeof made.name, NULL, &made.length, &made.type,
                       made.name);
    char *bracket = strrchr(made.name, '[');
    if (bracket && strcmp(bracket, "[0]") == 0)
        *bracket = '\0';
    made.numbers = numbers_of(made.type);
    made.values = memory_new((size_t)(made.length * made.numbers), sizeof *made.values);
    for (int i = 0; i < made.length; i++) {
        char name[CAPTURE_NAME + 16];
        snprintf(name, sizeof name, bracket ? "%s[%d]" : "%s", made.name, i);
        const GLint location = glGetUniformLocation(program, name);
        if (location >= 0)
            glGetUniformfv(program, location, made.values + i * made.numbers);
        if (made.type == GL_SAMPLER_2D)
            note_texture(draw, made.values + i);
    }
    draw->uniforms = grow(draw->uniforms, &draw->uniform_count, sizeof made);
    draw->uniforms[draw->uniform_count - 1] = made;
}

static void note_state(CaptureDraw *draw)
{
    GLboolean colors[4], depth = GL_TRUE;
    draw->scissors = glIsEnabled(GL_SCISSOR_TEST);
    draw->blends = glIsEnabled(GL_BLEND);
    draw->tests_depth = glIsEnabled(GL_DEPTH_TEST);
    draw->culls = glIsEnabled(GL_CULL_FACE);
    draw->tests_stencil = glIsEnabled(GL_STENCIL_TEST);
    glGetIntegerv(GL_VIEWPORT, draw->viewport);
    glGetIntegerv(GL_SCISSOR_BOX, draw->scissor);
    glGetBooleanv(GL_COLOR_WRITEMASK, colors);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth);
    for (int i = 0; i < 4; i++)
        draw->colors[i] = colors[i];
    draw->writes_depth = depth;
    draw->depth_func = bound(GL_DEPTH_FUNC);
    draw->cull_face = bound(GL_CULL_FACE_MODE);
    draw->front_face = bound(GL_FRONT_FACE);
    glGetFloatv(GL_LINE_WIDTH, &draw->line_width);
}

/* False: into another framebuffer, which may be a texture's. */
static bool is_kept(void)
{
    if (bound(GL_FRAMEBUFFER_BINDING) == current->framebuffer)
        return true;
    current->store->moment++;
    return false;
}

static CaptureDraw *note_draw(GLenum mode, int count)
{
    const GLuint program = bound(GL_CURRENT_PROGRAM);
    GLint attributes = 0, uniforms = 0;
    CaptureDraw made = {.mode = mode, .vertex_count = count > 0 ? count : 0};
    made.vertices = memory_new((size_t)made.vertex_count + 1, sizeof *made.vertices);
    glGetProgramiv(program, GL_ACTIVE_ATTRIBUTES, &attributes);
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &uniforms);
    note_sources(&made, program);
    for (int i = 0; i < attributes; i++)
        note_attribute(&made, program, i);
    for (int i = 0; i < uniforms; i++)
        note_uniform(&made, program, i);
    note_state(&made);
    current->draws = grow(current->draws, &current->draw_count, sizeof made);
    current->draws[current->draw_count - 1] = made;
    return &current->draws[current->draw_count - 1];
}

static void GL_APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count)
{
    if (is_kept()) {
        CaptureDraw *draw = note_draw(mode, count);
        for (int i = 0; i < draw->vertex_count; i++)
            draw->vertices[i] = (unsigned)(first + i);
    }
    driverDrawArrays(mode, first, count);
}

static void GL_APIENTRY draw_elements(GLenum mode, GLsizei count, GLenum type, const void *offset)
{
    if (is_kept()) {
        CaptureDraw *draw = note_draw(mode, count);
        const Block *block = block_of(bound(GL_ELEMENT_ARRAY_BUFFER_BINDING));
        const size_t size = type == GL_UNSIGNED_INT ? 4 : type == GL_UNSIGNED_SHORT ? 2 : 1;
        for (int i = 0; i < draw->vertex_count; i++) {
            const size_t at = (size_t)offset + (size_t)i * size;
            unsigned char *bytes = block && at + size <= block->size ? block->bytes + at : NULL;
            for (size_t k = 0; bytes && k < size; k++) /* little-endian, as WebGL's and ours */
                draw->vertices[i] |= (unsigned)bytes[k] << 8 * k;
        }
    }
    driverDrawElements(mode, count, type, offset);
}

static void forget_draws(Capture *capture)
{
    for (int i = 0; i < capture->draw_count; i++) {
        CaptureDraw *draw = &capture->draws[i];
        for (int k = 0; k < draw->uniform_count; k++)
            free(draw->uniforms[k].values);
        free(draw->uniforms);
        free(draw->attributes);
        free(draw->textures);
        free(draw->vertices);
    }
    free(capture->draws);
    capture->draws = NULL;
    capture->draw_count = 0;
}

static void GL_APIENTRY clear(GLbitfield buffers)
{
    if (is_kept() && buffers & GL_COLOR_BUFFER_BIT && !glIsEnabled(GL_SCISSOR_TEST)) {
        forget_draws(current);
        glGetFloatv(GL_COLOR_CLEAR_VALUE, current->clear_color);
    }
    driverClear(buffers);
}

static void GL_APIENTRY delete_shader(GLuint shader)
{
    CaptureStore *store = current->store;
    store->shaders = grow(store->shaders, &store->shader_count, sizeof *store->shaders);
    store->shaders[store->shader_count - 1] = shader;
}

/* On and off */

void capture_begin(Capture *capture, const Canvas *canvas)
{
    *capture = (Capture){.framebuffer = canvas->framebuffer};
    capture->store = memory_new(1, sizeof *capture->store);
    current = capture;
#define X(TYPE, name) driver##name = gl##name;
    REPLACED(X)
#undef X
    driver_binary = glProgramBinaryOES;
    glProgramBinaryOES = NULL;
    glBufferData = buffer_data;
    glBufferSubData = buffer_sub_data;
    glTexImage2D = tex_image;
    glClear = clear;
    glDrawArrays = draw_arrays;
    glDrawElements = draw_elements;
    glDeleteShader = delete_shader;
}

void capture_end(Capture *capture)
{
    if (current != capture)
        return;
    current = NULL;
    glProgramBinaryOES = driver_binary;
#define X(TYPE, name) gl##name = driver##name;
    REPLACED(X)
#undef X
    for (int i = 0; i < capture->store->shader_count; i++)
        glDeleteShader(capture->store->shaders[i]);
}

void capture_close(Capture *capture)
{
    CaptureStore *store = capture->store;
    capture_end(capture);
    forget_draws(capture);
    for (int i = 0; store && i < store->block_count; i++)
        free(store->blocks[i].bytes);
    for (int i = 0; store && i < store->text_count; i++)
        free(store->texts[i]);
    for (int i = 0; store && i < store->texture_count; i++) {
        free(store->textures[i]->texels);
        free(store->textures[i]);
    }
    if (store) {
        free(store->blocks);
        free(store->sizes);
        free(store->texts);
        free(store->textures);
        free(store->shaders);
    }
    free(store);
    *capture = (Capture){0};
}
