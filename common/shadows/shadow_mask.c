/*
 * A mask is a picture of the scene, of as many pixels as the canvas, whose channels say which light
 * a pixel does not get. The nearest surfaces are drawn into its depth buffer, then for each light
 * the volumes in which its casters keep it off are counted in the stencil, and a square that covers
 * all copies where the count is not zero to the light's channel. What is drawn twice has the same
 * shader and bytes, and so the same depths.
 */
#include "shadows/shadow_mask.h"

#include "core/canvas.h"

/* The mask */

MaskShader mask_shader(const Shader *shader)
{
    const GLuint program = shader->program;
    return (MaskShader){.shader = *shader,
                        .position = glGetAttribLocation(program, "a_Position"),
                        .normal = glGetAttribLocation(program, "a_Normal"),
                        .clip_from_object = glGetUniformLocation(program, "u_ClipFromObject"),
                        .near = glGetUniformLocation(program, "u_Near"),
                        .center = glGetUniformLocation(program, "u_Center"),
                        .light = glGetUniformLocation(program, "u_Light"),
                        .end = glGetUniformLocation(program, "u_End")};
}

bool shadow_mask_open(ShadowMask *mask, const ShaderLoader *loader, Message *message)
{
    static const float square[4][4] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}, {1, 1, 0, 1}};
    Shader shader;
    *mask = (ShadowMask){.width = 0};
    if (gl_version() < 30 && !gl_has("GL_OES_packed_depth_stencil"))
        return message_set(message,
                           "shadows: %s has no depth with stencil (GL_OES_packed_depth_stencil), "
                           "which volumes need; draw without shadows",
                           (const char *)glGetString(GL_RENDERER));
    if (!shader_open(&shader, loader, "shadow", message))
        return false;
    mask->shader = mask_shader(&shader);
    glGenFramebuffers(1, &mask->framebuffer);
    glGenBuffers(1, &mask->square);
    glBindBuffer(GL_ARRAY_BUFFER, mask->square);
    glBufferData(GL_ARRAY_BUFFER, sizeof square, square, GL_STATIC_DRAW);
    return true;
}

static void drop_images(ShadowMask *mask)
{
    if (mask->depth)
        glDeleteRenderbuffers(1, &mask->depth);
    for (int i = 0; i < SHADOW_MASKS; i++)
        if (mask->textures[i])
            glDeleteTextures(1, &mask->textures[i]);
    mask->depth = 0;
    for (int i = 0; i < SHADOW_MASKS; i++)
        mask->textures[i] = 0;
    mask->width = mask->height = 0;
}

void shadow_mask_close(ShadowMask *mask)
{
    if (!mask)
        return;
    if (mask->framebuffer) {
        drop_images(mask);
        glDeleteFramebuffers(1, &mask->framebuffer);
        glDeleteBuffers(1, &mask->square);
    }
    shader_close(&mask->shader.shader);
    *mask = (ShadowMask){.width = 0};
}

/* As large as the framebuffer is up to the viewport's upper right corner, so that a fragment has
 * the same coordinates in both. */
static void make_images(ShadowMask *mask, int count)
{
    const int width = mask->place[0] + mask->place[2], height = mask->place[1] + mask->place[3];
    if (width > mask->width || height > mask->height) {
        drop_images(mask);
        mask->width = width;
        mask->height = height;
        glGenRenderbuffers(1, &mask->depth);
        glBindRenderbuffer(GL_RENDERBUFFER, mask->depth);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8_OES, width, height);
        glBindFramebuffer(GL_FRAMEBUFFER, mask->framebuffer);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                  mask->depth);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                  mask->depth);
    }
    for (int i = 0; i < count; i++)
        if (!mask->textures[i])
            mask->textures[i] =
                canvas_texture(GL_RGBA, GL_UNSIGNED_BYTE, mask->width, mask->height);
}

static void attach(const ShadowMask *mask, int number)
{
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           mask->textures[number], 0);
}

static void write_color(bool red, bool green, bool blue, bool alpha)
{
    glColorMask(red ? GL_TRUE : GL_FALSE, green ? GL_TRUE : GL_FALSE, blue ? GL_TRUE : GL_FALSE,
                alpha ? GL_TRUE : GL_FALSE);
}

static void use(ShadowMask *mask, const MaskShader *shader)
{
    mask->current = shader;
    glUseProgram(shader->shader.program);
}

bool shadow_mask_begin(ShadowMask *mask, int count, double near, Message *message)
{
    GLint samples = 0;
    glGetIntegerv(GL_SAMPLES, &samples);
    if (samples > 1)
        return message_set(message,
                           "shadows: a framebuffer of %d samples; a mask has one for each pixel: "
                           "use supersampling",
                           (int)samples);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &mask->target);
    glGetIntegerv(GL_VIEWPORT, mask->place);
    mask->near = near;
    make_images(mask, count);
    glBindFramebuffer(GL_FRAMEBUFFER, mask->framebuffer);
    glClearColor(0, 0, 0, 0);
    glClearStencil(SHADOW_NONE);
    for (int i = count - 1; i >= 0; i--) {
        attach(mask, i);
        if (i == count - 1 && glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
            glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)mask->target);
            return message_set(message, "shadows: the driver cannot draw to a mask of %dx%d",
                               mask->width, mask->height);
        }
        glClear(i ? GL_COLOR_BUFFER_BIT
                  : GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    }
    use(mask, &mask->shader);
    write_color(false, false, false, false);
    glEnable(GL_DEPTH_TEST);
    return true;
}

void shadow_mask_transform(const ShadowMask *mask, Mat4 clip_from_object, double near)
{
    const float rounded = (float)near;
    shader_set_mat4(mask->current->clip_from_object, clip_from_object);
    glUniform1fv(mask->current->near, 1, &rounded);
}

void shadow_mask_state(const ShadowSurface *surface, bool clockwise)
{
    glFrontFace(surface->mirrored != clockwise ? GL_CW : GL_CCW);
    if (surface->behind_lines) {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1, 1);
    }
}

void shadow_mask_draw(ShadowMask *mask, const ShadowSurface *surface)
{
    const GLint normal = mask->current->normal;
    shadow_mask_transform(mask, surface->clip_from_object, mask->near);
    shadow_mask_state(surface, surface->clockwise);
    if (surface->cull)
        glEnable(GL_CULL_FACE);
    mesh_buffer_bind(surface->buffer, mask->current->position, normal);
    glDrawElements(GL_TRIANGLES, surface->buffer->index_count, surface->buffer->index_type, NULL);
    if (normal >= 0)
        glDisableVertexAttribArray((GLuint)normal);
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

/* Only the nearest surface of a pixel. Of two in the same place the first is drawn, so the caller
 * goes through them backwards. */
static void at_equal_depth(bool on)
{
    glDepthMask(on ? GL_FALSE : GL_TRUE);
    glDepthFunc(on ? GL_EQUAL : GL_LESS);
}

static void write_channel(const ShadowMask *mask, int channel)
{
    const int bit = channel % SHADOW_CHANNELS;
    attach(mask, channel / SHADOW_CHANNELS);
    write_color(bit == 0, bit == 1, bit == 2, bit == 3);
}

void shadow_mask_write(ShadowMask *mask, int channel, const MaskShader *shader)
{
    use(mask, shader ? shader : &mask->shader);
    at_equal_depth(shader != NULL);
    if (shader)
        write_channel(mask, channel);
    else
        write_color(false, false, false, false);
}

void shadow_mask_light(ShadowMask *mask, int channel)
{
    const GLuint position = (GLuint)mask->shader.position;
    write_channel(mask, channel);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_LESS, SHADOW_NONE, 0xff);
    /* Cleared for the next light. */
    glStencilOpSeparate(GL_FRONT_AND_BACK, GL_REPLACE, GL_REPLACE, GL_REPLACE);
    shadow_mask_transform(mask, mat4_identity(), 0.5);
    glBindBuffer(GL_ARRAY_BUFFER, mask->square);
    glEnableVertexAttribArray(position);
    glVertexAttribPointer(position, 4, GL_FLOAT, GL_FALSE, 0, NULL);
    glFrontFace(GL_CCW);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    write_color(false, false, false, false);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
}

bool shadow_mask_end(ShadowMask *mask, Message *message)
{
    attach(mask, 0);
    write_color(true, true, true, true);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_STENCIL_TEST);
    glFrontFace(GL_CCW);
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)mask->target);
    const GLenum error = glGetError();
    return error == GL_NO_ERROR ||
           message_set(message, "shadows: a mask of %dx%d: %s from the driver", mask->width,
                       mask->height, gl_error_name(error));
}

void shadow_mask_bind(const ShadowMask *mask, int count)
{
    for (int i = 0; i < count; i++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)i);
        glBindTexture(GL_TEXTURE_2D, mask ? mask->textures[i] : 0);
    }
    glActiveTexture(GL_TEXTURE0);
}
