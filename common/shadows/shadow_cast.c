/*
 * Volumes are made on the processor (silhouette.h), when a light or a caster has moved against the
 * other, and stay uploaded. Their faces are counted where the depth test fails or passes; what is
 * hard is a surface that is itself the cap of a volume: which side of it is lit is decided by its
 * own triangles, drawn again at equal depth. See shadow_cast.h for the method and its sources.
 */
#include "shadows/shadow_cast.h"

#include <limits.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SHORT_VERTICES = 65536 };

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

/* Volumes that are uploaded */

/* The next in the frame's order; NULL: no memory. */
static UploadedVolume *next_volume(ShadowVolumes *volumes)
{
    if (volumes->next == volumes->uploaded_capacity) {
        const size_t capacity = 2 * volumes->uploaded_capacity + 4;
        UploadedVolume *larger = realloc(volumes->uploaded, capacity * sizeof *larger);
        if (!larger)
            return NULL;
        volumes->uploaded = larger;
        volumes->uploaded_capacity = capacity;
    }
    if (volumes->next == volumes->uploaded_count) {
        UploadedVolume *made = &volumes->uploaded[volumes->uploaded_count++];
        *made = (UploadedVolume){.caster = NULL};
        glGenBuffers(SHADOW_VOLUME_LISTS, made->indices);
    }
    return &volumes->uploaded[volumes->next++];
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

static bool same_kind(const ShadowVolumeKind *a, const ShadowVolumeKind *b)
{
    return memcmp(&a->light, &b->light, sizeof a->light) == 0 && a->facing == b->facing &&
           a->end == b->end && a->dark == b->dark;
}

/* Made again only if it is not that of the last frame. NULL: no memory, or too many triangles. */
static const UploadedVolume *find_volume(ShadowVolumes *volumes, const ShadowThrow *thrown,
                                         Message *message)
{
    const ShadowVolumeKind kind = {thrown->light_object, thrown->facing, end_of(thrown),
                                   thrown->behind || thrown->odd};
    const size_t vertices = thrown->caster->silhouette.mesh->vertex_count;
    UploadedVolume *found = next_volume(volumes);
    if (!found) {
        message_set(message, "shadows: not enough memory");
        return NULL;
    }
    if (found->caster == thrown->caster && same_kind(&found->kind, &kind))
        return found;
    ShadowVolume *volume = &volumes->volume;
    found->caster = NULL;
    if (!shadow_volume_make(volume, &thrown->caster->silhouette, &kind, message))
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
    found->kind = kind;
    volumes->made++;
    return found;
}

bool shadow_cast(ShadowVolumes *volumes, ShadowMask *mask, const ShadowThrow *thrown,
                 Message *message)
{
    const Silhouette *silhouette = &thrown->caster->silhouette;
    const UploadedVolume *volume = find_volume(volumes, thrown, message);
    if (!volume)
        return false;
    const Vec4 given = thrown->light_object, end = thrown->end;
    const Vec3 place = {given.x, given.y, given.z};
    float light[4] = {0, 0, 0, given.w != 0 ? 1 : 0};
    const float plane[4] = {(float)end.x, (float)end.y, (float)end.z,
                            (float)(end.x * silhouette->center.x + end.y * silhouette->center.y +
                                    end.z * silhouette->center.z + end.w)};
    vec3_to_float(given.w != 0 ? vec3_subtract(place, silhouette->center) : place, light);
    shadow_mask_transform(mask, thrown->surface.clip_from_object, mask->near);
    shader_set_vec3(mask->current->center, silhouette->center);
    glUniform4fv(mask->current->light, 1, light);
    glUniform4fv(mask->current->end, 1, plane);
    shadow_mask_state(&thrown->surface, false);
    glDepthMask(GL_FALSE);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 0, 0xff);
    const GLuint position = (GLuint)mask->current->position;
    mesh_buffer_bind(thrown->surface.buffer, (GLint)position, -1);
    for (int i = 0; i < 4; i++)
        draw_caps(thrown, (Caps){volume, i / 2, i % 2});
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthFunc(GL_LESS);
    count_faces(thrown->behind, true);
    glBindBuffer(GL_ARRAY_BUFFER, thrown->caster->vertices);
    glVertexAttribPointer(position, 4, GL_FLOAT, GL_FALSE, 0, NULL);
    draw_list(volume, SHADOW_VOLUME_SIDES, 2 * silhouette->mesh->vertex_count);
    volumes->drawn++;
    return true;
}

/* Those of the list from `first` on. */
static void drop_volumes(ShadowVolumes *volumes, size_t first)
{
    for (size_t i = first; i < volumes->uploaded_count; i++)
        glDeleteBuffers(SHADOW_VOLUME_LISTS, volumes->uploaded[i].indices);
    volumes->uploaded_count = first < volumes->uploaded_count ? first : volumes->uploaded_count;
}

void shadow_cast_begin(ShadowVolumes *volumes)
{
    volumes->next = 0;
}

void shadow_cast_end(ShadowVolumes *volumes, bool failed)
{
    drop_volumes(volumes, failed ? 0 : volumes->next);
}

void shadow_volumes_forget(ShadowVolumes *volumes)
{
    drop_volumes(volumes, 0);
}

void shadow_volumes_close(ShadowVolumes *volumes)
{
    drop_volumes(volumes, 0);
    free(volumes->uploaded);
    shadow_volume_close(&volumes->volume);
    *volumes = (ShadowVolumes){.next = 0};
}
