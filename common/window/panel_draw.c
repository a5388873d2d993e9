/*
 * Triangles in pixels with one texture, the atlas of letters, in the order in which they lie over
 * each other. Lecture programs set their state once, before the loop, and are drawn between panels:
 * so all state that is changed here is read before and written back after.
 */
#include "window/panel_draw.h"

#include "core/canvas.h"

#include <stddef.h>

bool panel_draw_open(PanelDraw *draw, const ShaderLoader *loader, Message *message)
{
    const ShaderLoader own = {.folder = loader->folder, .keeps = loader->keeps};
    *draw = (PanelDraw){0};
    if (!shader_open(&draw->shader, &own, "panel", message) ||
        !shader_attribute(&draw->shader, "a_Position", &draw->a_Position, message) ||
        !shader_attribute(&draw->shader, "a_TexCoord", &draw->a_TexCoord, message) ||
        !shader_attribute(&draw->shader, "a_Color", &draw->a_Color, message) ||
        !shader_uniform(&draw->shader, "u_Size", &draw->u_Size, message)) {
        panel_draw_close(draw);
        return false;
    }
    glGenBuffers(1, &draw->vertices);
    glGenBuffers(1, &draw->indices);
    return true;
}

/* What others set once and rely on. */

typedef struct GlState {
    GLint program, array_buffer, element_buffer, unit, texture;
    GLint equation[2], function[4]; /* of blending: color, alpha; source and destination of each */
    GLint scissor[4], viewport[4];
    GLboolean mask[4];
    GLboolean enabled[6]; /* as CAPABILITIES */
    CanvasAttribute attributes[3];
} GlState;

static const GLenum CAPABILITIES[6] = {GL_BLEND,        GL_CULL_FACE,
                                       GL_DEPTH_TEST,   GL_SAMPLE_ALPHA_TO_COVERAGE,
                                       GL_SCISSOR_TEST, GL_STENCIL_TEST};
static const bool WANTED[6] = {true, false, false, false, true, false};

static GlState save(const PanelDraw *draw)
{
    static const GLenum functions[4] = {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA,
                                        GL_BLEND_DST_ALPHA};
    GlState state = {.attributes = {canvas_attribute((GLuint)draw->a_Position),
                                    canvas_attribute((GLuint)draw->a_TexCoord),
                                    canvas_attribute((GLuint)draw->a_Color)}};
    glGetIntegerv(GL_CURRENT_PROGRAM, &state.program);
    glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &state.array_buffer);
    glGetIntegerv(GL_ELEMENT_ARRAY_BUFFER_BINDING, &state.element_buffer);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &state.unit);
    glActiveTexture(GL_TEXTURE0);
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &state.texture);
    glGetIntegerv(GL_BLEND_EQUATION_RGB, &state.equation[0]);
    glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &state.equation[1]);
    for (int i = 0; i < 4; i++)
        glGetIntegerv(functions[i], &state.function[i]);
    glGetIntegerv(GL_SCISSOR_BOX, state.scissor);
    glGetIntegerv(GL_VIEWPORT, state.viewport);
    glGetBooleanv(GL_COLOR_WRITEMASK, state.mask);
    for (int i = 0; i < 6; i++)
        state.enabled[i] = glIsEnabled(CAPABILITIES[i]);
    return state;
}

static void restore(const GlState *state)
{
    for (int i = 0; i < 3; i++)
        canvas_set_attribute(&state->attributes[i]);
    for (int i = 0; i < 6; i++)
        (state->enabled[i] ? glEnable : glDisable)(CAPABILITIES[i]);
    glColorMask(state->mask[0], state->mask[1], state->mask[2], state->mask[3]);
    glViewport(state->viewport[0], state->viewport[1], state->viewport[2], state->viewport[3]);
    glScissor(state->scissor[0], state->scissor[1], state->scissor[2], state->scissor[3]);
    glBlendFuncSeparate((GLenum)state->function[0], (GLenum)state->function[1],
                        (GLenum)state->function[2], (GLenum)state->function[3]);
    glBlendEquationSeparate((GLenum)state->equation[0], (GLenum)state->equation[1]);
    glBindTexture(GL_TEXTURE_2D, (GLuint)state->texture);
    glActiveTexture((GLenum)state->unit);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, (GLuint)state->element_buffer);
    glBindBuffer(GL_ARRAY_BUFFER, (GLuint)state->array_buffer);
    glUseProgram((GLuint)state->program);
}

/* Drawing. */

static void upload_atlas(PanelDraw *draw, const PanelDrawing *drawing)
{
    GLint alignment = 4;
    if (!draw->atlas)
        glGenTextures(1, &draw->atlas);
    glBindTexture(GL_TEXTURE_2D, draw->atlas);
    if (draw->generation == drawing->generation)
        return;
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    /* Letters are as large as in the atlas. */
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, drawing->atlas_width, drawing->atlas_height, 0,
                 GL_ALPHA, GL_UNSIGNED_BYTE, drawing->atlas);
    glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
    draw->generation = drawing->generation;
}

/* Into new memory, so that the driver need not wait for the frame before. */
static void upload(GLenum target, GLuint buffer, size_t *room, const void *data, size_t size)
{
    while (*room < size)
        *room = *room ? 2 * *room : 65536;
    glBindBuffer(target, buffer);
    glBufferData(target, (GLsizeiptr)*room, NULL, GL_STREAM_DRAW);
    glBufferSubData(target, 0, (GLsizeiptr)size, data);
}

static void point_attribute(GLint location, GLint size, GLenum type, GLboolean normalized,
                            size_t offset)
{
    glVertexAttribPointer((GLuint)location, size, type, normalized, (GLsizei)sizeof(PanelVertex),
                          (const void *)offset);
    glEnableVertexAttribArray((GLuint)location);
}

static void point_attributes(const PanelDraw *draw, int vertex)
{
    const size_t first = (size_t)vertex * sizeof(PanelVertex);
    point_attribute(draw->a_Position, 2, GL_FLOAT, GL_FALSE, first + offsetof(PanelVertex, x));
    point_attribute(draw->a_TexCoord, 2, GL_FLOAT, GL_FALSE, first + offsetof(PanelVertex, u));
    point_attribute(draw->a_Color, 4, GL_UNSIGNED_BYTE, GL_TRUE,
                    first + offsetof(PanelVertex, color));
}

static void begin(const PanelDraw *draw, int width, int height)
{
    const GLfloat size[2] = {(GLfloat)width, (GLfloat)height};
    for (int i = 0; i < 6; i++)
        (WANTED[i] ? glEnable : glDisable)(CAPABILITIES[i]);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glViewport(0, 0, width, height);
    glBlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
    /* What is opaque stays so. */
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(draw->shader.program);
    glUniform2fv(draw->u_Size, 1, size);
}

bool panel_draw(PanelDraw *draw, const PanelDrawing *drawing, int width, int height,
                Message *message)
{
    if (drawing->command_count == 0)
        return true;
    const GlState state = save(draw);
    begin(draw, width, height);
    upload_atlas(draw, drawing);
    upload(GL_ARRAY_BUFFER, draw->vertices, &draw->vertex_room, drawing->vertices,
           (size_t)drawing->vertex_count * sizeof *drawing->vertices);
    upload(GL_ELEMENT_ARRAY_BUFFER, draw->indices, &draw->index_room, drawing->indices,
           (size_t)drawing->index_count * sizeof *drawing->indices);
    int vertex = -1;
    for (int i = 0; i < drawing->command_count; i++) {
        const PanelCommand *command = &drawing->commands[i];
        if (command->vertex != vertex)
            point_attributes(draw, command->vertex);
        vertex = command->vertex;
        glScissor(command->x, height - command->y - command->height, command->width,
                  command->height);
        glDrawElements(GL_TRIANGLES, command->count, GL_UNSIGNED_SHORT,
                       (const void *)((size_t)command->first * sizeof *drawing->indices));
    }
    restore(&state);
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR)
        return message_set(message, "panel: %s from the driver", gl_error_name(error));
    return true;
}

void panel_draw_close(PanelDraw *draw)
{
    if (!draw)
        return;
    if (draw->vertices)
        glDeleteBuffers(1, &draw->vertices);
    if (draw->indices)
        glDeleteBuffers(1, &draw->indices);
    if (draw->atlas)
        glDeleteTextures(1, &draw->atlas);
    shader_close(&draw->shader);
    *draw = (PanelDraw){0};
}
