#include "shadows/shadow_mask.h"

#include <limits.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SHORT_VERTICES = 65536 };
enum { NONE = 128 }; /* the stencil's count of no volume: less than none is no shadow */

/* Casters */

static void *doubled_vertices(const Mesh *mesh, size_t *size)
{
    float(*all)[4] = malloc((2 * mesh->vertex_count + 1) * sizeof *all);
    *size = 2 * mesh->vertex_count * sizeof *all;
    for (size_t i = 0; all && i < 2 * mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++)
            all[i][k] = mesh->vertices[i / 2].position[k];
        all[i][3] = i % 2 ? 0 : 1;
    }
    return all;
}

bool shadow_caster_open(ShadowCaster *caster, const Mesh *mesh, Message *message)
{
    size_t size;
    *caster = (ShadowCaster){.vertices = 0};
    if (2 * mesh->vertex_count > MAX_SHORT_VERTICES && gl_version() < 30 &&
        !gl_has("GL_OES_element_index_uint"))
        return message_set(message,
                           "shadows: the volume of a mesh of %zu vertices: this driver indexes at "
                           "most %d (it lacks GL_OES_element_index_uint); use fewer divisions",
                           mesh->vertex_count, MAX_SHORT_VERTICES / 2);
    void *vertices = doubled_vertices(mesh, &size);
    if (!vertices)
        return message_set(message, "shadows: not enough memory for %zu vertices",
                           2 * mesh->vertex_count);
    if (silhouette_open(&caster->silhouette, mesh, message)) {
        glGenBuffers(1, &caster->vertices);
        glBindBuffer(GL_ARRAY_BUFFER, caster->vertices);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, vertices, GL_STATIC_DRAW);
    }
    free(vertices);
    return caster->vertices != 0;
}

void shadow_caster_close(ShadowCaster *caster)
{
    if (!caster)
        return;
    silhouette_close(&caster->silhouette);
    if (caster->vertices)
        glDeleteBuffers(1, &caster->vertices);
    *caster = (ShadowCaster){.vertices = 0};
}

/* The mask */

bool shadow_mask_open(ShadowMask *mask, const ShaderLoader *loader, Message *message)
{
    static const float square[4][4] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}, {1, 1, 0, 1}};
    *mask = (ShadowMask){.loader = *loader};
    if (gl_version() < 30 && !gl_has("GL_OES_packed_depth_stencil"))
        return message_set(message,
                           "shadows: %s has no depth with stencil (GL_OES_packed_depth_stencil), "
                           "which volumes need; draw without shadows",
                           (const char *)glGetString(GL_RENDERER));
    if (!shader_open(&mask->shader, loader, "shadow", message))
        return false;
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

/* Those of the list from `first` on. */
static void drop_volumes(ShadowMask *mask, size_t first)
{
    for (size_t i = first; i < mask->uploaded_count; i++)
        glDeleteBuffers(SHADOW_VOLUME_LISTS, mask->uploaded[i].indices);
    mask->uploaded_count = first < mask->uploaded_count ? first : mask->uploaded_count;
}

void shadow_mask_forget(ShadowMask *mask)
{
    drop_volumes(mask, 0);
}

void shadow_mask_close(ShadowMask *mask)
{
    if (!mask)
        return;
    drop_volumes(mask, 0);
    free(mask->uploaded);
    if (mask->framebuffer) {
        drop_images(mask);
        glDeleteFramebuffers(1, &mask->framebuffer);
        glDeleteBuffers(1, &mask->square);
    }
    shader_close(&mask->shader);
    shader_close(&mask->flatten);
    shadow_volume_close(&mask->volume);
    *mask = (ShadowMask){.width = 0};
}

static void make_texture(ShadowMask *mask, int number)
{
    glGenTextures(1, &mask->textures[number]);
    glBindTexture(GL_TEXTURE_2D, mask->textures[number]);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, mask->width, mask->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
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
            make_texture(mask, i);
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

static void use(ShadowMask *mask, const Shader *shader)
{
    mask->program = shader->program;
    glUseProgram(mask->program);
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
    mask->next = 0;
    make_images(mask, count);
    glBindFramebuffer(GL_FRAMEBUFFER, mask->framebuffer);
    glClearColor(0, 0, 0, 0);
    glClearStencil(NONE);
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

static void set_vector(const ShadowMask *mask, const char *name, int size, const float *values)
{
    const GLint location = glGetUniformLocation(mask->program, name);
    if (size == 1)
        glUniform1fv(location, 1, values);
    else if (size == 3)
        glUniform3fv(location, 1, values);
    else
        glUniform4fv(location, 1, values);
}

static void set_transform(const ShadowMask *mask, Mat4 clip_from_object, double near)
{
    const float rounded = (float)near;
    shader_set_mat4(glGetUniformLocation(mask->program, "u_ClipFromObject"), clip_from_object);
    set_vector(mask, "u_Near", 1, &rounded);
}

static GLuint position_of(const ShadowMask *mask)
{
    return (GLuint)glGetAttribLocation(mask->program, "a_Position");
}

/* The winding and the offset that the surface is drawn with. */
static void set_state(const ShadowSurface *surface, bool clockwise)
{
    glFrontFace(surface->mirrored != clockwise ? GL_CW : GL_CCW);
    if (surface->behind_lines) {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1, 1);
    }
}

void shadow_mask_draw(ShadowMask *mask, const ShadowSurface *surface, GLint normal)
{
    set_transform(mask, surface->clip_from_object, mask->near);
    set_state(surface, surface->clockwise);
    if (surface->cull)
        glEnable(GL_CULL_FACE);
    mesh_buffer_bind(surface->buffer, (GLint)position_of(mask), normal);
    glDrawElements(GL_TRIANGLES, surface->buffer->index_count, surface->buffer->index_type, NULL);
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

void shadow_mask_surface(ShadowMask *mask, const ShadowSurface *surface)
{
    shadow_mask_draw(mask, surface, -1);
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

void shadow_mask_write(ShadowMask *mask, int channel, const Shader *shader)
{
    use(mask, shader ? shader : &mask->shader);
    at_equal_depth(shader != NULL);
    if (shader)
        write_channel(mask, channel);
    else
        write_color(false, false, false, false);
}

/* Volumes that are uploaded */

/* The next in the frame's order; NULL: no memory. */
static UploadedVolume *next_volume(ShadowMask *mask)
{
    if (mask->next == mask->uploaded_capacity) {
        const size_t capacity = 2 * mask->uploaded_capacity + 4;
        UploadedVolume *larger = realloc(mask->uploaded, capacity * sizeof *larger);
        if (!larger)
            return NULL;
        mask->uploaded = larger;
        mask->uploaded_capacity = capacity;
    }
    if (mask->next == mask->uploaded_count) {
        UploadedVolume *made = &mask->uploaded[mask->uploaded_count++];
        *made = (UploadedVolume){.caster = NULL};
        glGenBuffers(SHADOW_VOLUME_LISTS, made->indices);
    }
    return &mask->uploaded[mask->next++];
}

static bool is_wide(size_t vertices)
{
    return vertices > MAX_SHORT_VERTICES;
}

/* Overwrites the indices. False: more than one call draws. */
static bool upload(UploadedVolume *to, int which, uint32_t *indices, size_t count, bool wide)
{
    if (count > INT_MAX)
        return false;
    to->counts[which] = (GLsizei)count;
    for (size_t i = 0; i < count && !wide; i++) { /* in place */
        const GLushort narrow = (GLushort)indices[i];
        memcpy((char *)indices + i * sizeof narrow, &narrow, sizeof narrow);
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, to->indices[which]);
    if (count > 0)
        glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                     (GLsizeiptr)(count * (wide ? sizeof *indices : sizeof(GLushort))), indices,
                     GL_DYNAMIC_DRAW);
    return true;
}

static void draw_list(const UploadedVolume *volume, int which, size_t vertices)
{
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, volume->indices[which]);
    if (volume->counts[which] > 0)
        glDrawElements(GL_TRIANGLES, volume->counts[which],
                       is_wide(vertices) ? GL_UNSIGNED_INT : GL_UNSIGNED_SHORT, NULL);
}

/* Behind the surface, faces that look out of the volume begin it and the others end it; before the
 * surface likewise, seen from the eye. */
static void count_faces(bool behind, bool front_looks_out)
{
    const GLenum out = behind ? GL_DECR_WRAP : GL_INCR_WRAP;
    const GLenum in = behind ? GL_INCR_WRAP : GL_DECR_WRAP;
    const GLenum front = front_looks_out ? out : in, back = front_looks_out ? in : out;
    glStencilOpSeparate(GL_FRONT, GL_KEEP, behind ? front : GL_KEEP, behind ? GL_KEEP : front);
    glStencilOpSeparate(GL_BACK, GL_KEEP, behind ? back : GL_KEEP, behind ? GL_KEEP : back);
}

/* Triangles that face the light or not, and whose normals are on the other side or not. */
typedef struct Caps {
    const UploadedVolume *volume;
    bool lit, turned;
} Caps;

static void draw_triangles(const ShadowThrow *thrown, Caps caps)
{
    draw_list(caps.volume, shadow_volume_caps(caps.lit, caps.turned),
              thrown->caster->silhouette.mesh->vertex_count);
}

/* `front`: seen from the side from which the triangle is counter-clockwise. The object's back is
 * the other side, unless its front faces are clockwise. */
static bool is_back(const ShadowThrow *thrown, bool front)
{
    return front == thrown->surface.clockwise;
}

/* Whether the surface that is a cap itself counts as outside the volume, in light: on the side that
 * its normal is on. That of a two-sided object seen from the back is on the other. */
static bool cap_is_outside(const ShadowThrow *thrown, Caps caps, bool front)
{
    const bool normal_lit = caps.lit != caps.turned;
    const bool back = thrown->two_sided && is_back(thrown, front);
    return thrown->facing == SILHOUETTE_UNLIT || normal_lit != back;
}

/* Whether the triangles are of the volume's boundary. */
static bool is_counted(const ShadowThrow *thrown, Caps caps)
{
    return thrown->facing == SILHOUETTE_ALL || caps.lit == (thrown->facing == SILHOUETTE_LIT);
}

/* Triangles that are both cap and surface, seen from the front or the back: what to add to the
 * count, where nothing lies before the surface or where what does was counted. Seen from inside a
 * volume whose outside it is on, it ends the volume. On the side away from the light it is in
 * shadow, whatever was counted: the side of the volume next to it may lie as close as rounding. */
static int own_count(const ShadowThrow *thrown, Caps caps, bool front)
{
    const bool outside = cap_is_outside(thrown, caps, front), looks_out = front == caps.lit;
    if (!thrown->own || (thrown->surface.cull && is_back(thrown, front)))
        return 0;
    if (!outside)
        return 1;
    return looks_out || thrown->behind || !is_counted(thrown, caps) ? 0 : -1;
}

static void draw_own(const ShadowThrow *thrown, Caps caps)
{
    const int counts[2] = {own_count(thrown, caps, true), own_count(thrown, caps, false)};
    glDepthFunc(GL_EQUAL);
    for (int back = 0; back < 2; back++) {
        if (counts[back] == 0)
            continue;
        glStencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP,
                            counts[back] > 0 ? GL_INCR_WRAP : GL_DECR_WRAP);
        if (counts[0] == counts[1]) { /* both sides at once */
            draw_triangles(thrown, caps);
            return;
        }
        glEnable(GL_CULL_FACE);
        glCullFace(back ? GL_FRONT : GL_BACK);
        draw_triangles(thrown, caps);
        glDisable(GL_CULL_FACE);
    }
}

/* The caps on the mesh, behind the surfaces; before them there are none. Where they are the
 * surface, equal depths decide. */
static void draw_behind(const ShadowThrow *thrown, Caps caps)
{
    count_faces(true, caps.lit);
    glEnable(GL_CULL_FACE);
    for (int back = 0; back < 2; back++) {
        const bool looks_out = !back == caps.lit;
        glCullFace(back ? GL_FRONT : GL_BACK);
        glDepthFunc(cap_is_outside(thrown, caps, !back) == looks_out ? GL_LESS : GL_LEQUAL);
        draw_triangles(thrown, caps);
    }
    glDisable(GL_CULL_FACE);
}

static void draw_caps(const ShadowThrow *thrown, Caps caps)
{
    if (caps.volume->counts[shadow_volume_caps(caps.lit, caps.turned)] == 0)
        return;
    if (thrown->behind && is_counted(thrown, caps))
        draw_behind(thrown, caps);
    draw_own(thrown, caps);
    glCullFace(GL_BACK);
}

/* Before the surfaces caps are counted only at an end that the eye looks through; parallel rays
 * meet in one point at infinity. */
static ShadowEnd end_of(const ShadowThrow *thrown)
{
    const Vec4 end = thrown->end;
    const bool infinite = end.x == 0 && end.y == 0 && end.z == 0;
    return infinite && thrown->light_object.w == 0 ? SHADOW_END_POINT
           : thrown->behind || thrown->beyond      ? SHADOW_END_CAPS
                                                   : SHADOW_END_OPEN;
}

static void set_light(ShadowMask *mask, const ShadowThrow *thrown, Vec3 near)
{
    const Vec4 given = thrown->light_object;
    const Vec3 place = {given.x, given.y, given.z};
    float center[3], light[4] = {0, 0, 0, given.w != 0 ? 1 : 0};
    vec3_to_float(near, center);
    vec3_to_float(given.w != 0 ? vec3_subtract(place, near) : place, light);
    set_transform(mask, thrown->surface.clip_from_object, mask->near);
    set_vector(mask, "u_Center", 3, center);
    set_vector(mask, "u_Light", 4, light);
    const Vec4 end = thrown->end;
    float plane[4] = {(float)end.x, (float)end.y, (float)end.z,
                      (float)(end.x * near.x + end.y * near.y + end.z * near.z + end.w)};
    set_vector(mask, "u_End", 4, plane);
}

/* Made again only if it is not that of the last frame. NULL: no memory, or too many triangles. */
static const UploadedVolume *find_volume(ShadowMask *mask, const ShadowThrow *thrown,
                                         Message *message)
{
    const Vec4 light = thrown->light_object;
    const ShadowEnd end = end_of(thrown);
    const bool dark = thrown->behind || thrown->odd;
    const size_t vertices = thrown->caster->silhouette.mesh->vertex_count;
    UploadedVolume *found = next_volume(mask);
    if (!found) {
        message_set(message, "shadows: not enough memory");
        return NULL;
    }
    if (found->caster == thrown->caster && memcmp(&found->light, &light, sizeof light) == 0 &&
        found->facing == thrown->facing && found->end == end && found->dark == dark)
        return found;
    ShadowVolume *volume = &mask->volume;
    found->caster = NULL;
    if (!shadow_volume_make(volume, &thrown->caster->silhouette, light, thrown->facing, end, dark,
                            message))
        return NULL;
    bool done = upload(found, SHADOW_VOLUME_SIDES, volume->sides, volume->side_count,
                       is_wide(2 * vertices));
    for (int i = 0; i < SHADOW_VOLUME_SIDES; i++)
        done = done && upload(found, i, volume->caps[i], volume->cap_counts[i], is_wide(vertices));
    if (!done) {
        message_set(message, "shadows: a volume has more triangles than one call draws");
        return NULL;
    }
    found->caster = thrown->caster;
    found->light = light;
    found->facing = thrown->facing;
    found->end = end;
    found->dark = dark;
    mask->made++;
    return found;
}

bool shadow_mask_cast(ShadowMask *mask, const ShadowThrow *thrown, Message *message)
{
    const Silhouette *silhouette = &thrown->caster->silhouette;
    const UploadedVolume *volume = find_volume(mask, thrown, message);
    if (!volume)
        return false;
    set_light(mask, thrown, silhouette->center);
    set_state(&thrown->surface, false);
    glDepthMask(GL_FALSE);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 0, 0xff);
    const GLuint position = position_of(mask);
    mesh_buffer_bind(thrown->surface.buffer, (GLint)position, -1);
    for (int i = 0; i < 4; i++)
        draw_caps(thrown, (Caps){volume, i / 2, i % 2});
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthFunc(GL_LESS);
    count_faces(thrown->behind, true);
    glBindBuffer(GL_ARRAY_BUFFER, thrown->caster->vertices);
    glVertexAttribPointer(position, 4, GL_FLOAT, GL_FALSE, 0, NULL);
    draw_list(volume, SHADOW_VOLUME_SIDES, 2 * silhouette->mesh->vertex_count);
    mask->volumes++;
    mask->triangles += volume->counts[SHADOW_VOLUME_SIDES] / 3;
    return true;
}

/* Flattened shadows. Each flat surface has a count of its own where it is seen, less than NONE;
 * inverted, which is more than NONE, it is in shadow, and no longer found. */

void shadow_mask_flat(ShadowMask *mask, const ShadowSurface *surface, int number)
{
    at_equal_depth(true);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1 + number, 0xff);
    glStencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP, GL_REPLACE);
    shadow_mask_draw(mask, surface, -1);
    glDisable(GL_STENCIL_TEST);
    at_equal_depth(false);
}

static bool open_flatten(ShadowMask *mask, Message *message)
{
    static const char *const defines[] = {"FLATTEN", NULL};
    ShaderLoader loader = mask->loader;
    loader.defines = defines;
    loader.precision = NULL; /* 16 bits do not tell the sides of a plane apart */
    return mask->flatten.program || shader_open(&mask->flatten, &loader, "shadow", message);
}

bool shadow_mask_flatten(ShadowMask *mask, const ShadowThrow *thrown, int number, Message *message)
{
    enum { STRIDE = 8 * sizeof(float), MOVED = 4 * sizeof(float) };
    const MeshBuffer *buffer = thrown->surface.buffer;
    if (!open_flatten(mask, message))
        return false;
    use(mask, &mask->flatten);
    set_light(mask, thrown, thrown->caster->silhouette.center);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_EQUAL, 1 + number, 0xff);
    glStencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP, GL_INVERT);
    mesh_buffer_bind(buffer, (GLint)position_of(mask), -1);
    glBindBuffer(GL_ARRAY_BUFFER, thrown->caster->vertices);
    glVertexAttribPointer(position_of(mask), 4, GL_FLOAT, GL_FALSE, STRIDE,
                          (const void *)(uintptr_t)MOVED);
    glDrawElements(GL_TRIANGLES, buffer->index_count, buffer->index_type, NULL);
    glDisable(GL_STENCIL_TEST);
    glEnable(GL_DEPTH_TEST);
    use(mask, &mask->shader);
    mask->flattened++;
    return true;
}

void shadow_mask_light(ShadowMask *mask, int channel)
{
    const GLuint position = position_of(mask);
    write_channel(mask, channel);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_LESS, NONE, 0xff);
    /* Cleared for the next light. */
    glStencilOpSeparate(GL_FRONT_AND_BACK, GL_REPLACE, GL_REPLACE, GL_REPLACE);
    set_transform(mask, mat4_identity(), 0.5);
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
    drop_volumes(mask, error == GL_NO_ERROR ? mask->next : 0);
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
