/* Lines and points of one color each, collected on the CPU and drawn from a buffer that each list
 * fills anew. Of the sides of triangles only those are edges that no other triangle of the same
 * plane has, too: sides are sorted by their ends, in a fixed order, and equal ones compared. */
#include "scene/overlay.h"

#include <stddef.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add(OverlayList *list, Vec3 position, Vec3 color)
{
    if (list->count == list->capacity) {
        const int capacity = list->capacity ? 2 * list->capacity : 64;
        OverlayVertex *larger = realloc(list->vertices, (size_t)capacity * sizeof *larger);
        if (!larger) {
            list->failed = true;
            return;
        }
        list->vertices = larger;
        list->capacity = capacity;
    }
    OverlayVertex *vertex = &list->vertices[list->count++];
    vec3_to_float(position, vertex->position);
    vec3_to_float(color, vertex->color);
}

static void add_line(OverlayList *list, Vec3 from, Vec3 to, Vec3 color)
{
    add(list, from, color);
    add(list, to, color);
}

void overlay_add_axes(OverlayList *list, double length)
{
    static const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++)
        add_line(list, (Vec3){0, 0, 0}, vec3_scale(axes[i], length), axes[i]);
}

/* How an object's normals become lines. */
typedef struct NormalLines {
    const Object *object;
    Mat4 normal_matrix;
    double length;
} NormalLines;

static void add_normal(OverlayList *list, const NormalLines *lines, Vec3 foot, Vec3 normal)
{
    const Vec3 from = mat4_transform_point(lines->object->world_from_object, foot);
    const double length = lines->length;
    Vec3 unit;
    if (!vec3_normalize(mat4_transform_direction(lines->normal_matrix, normal), &unit))
        return;
    add_line(list, from, vec3_add(from, vec3_scale(unit, length)), (Vec3){1, 1, 0});
    if (lines->object->two_sided)
        add_line(list, from, vec3_add(from, vec3_scale(unit, -length)), (Vec3){0.4, 0.8, 1});
}

static void add_normals(OverlayList *list, const Object *object, bool flat)
{
    const Mesh *mesh = object->mesh;
    const MeshBox box = mesh_bounds(mesh);
    /* In proportion to the object, and to the distance of many from each other. */
    const double share = fmin(fmax(2 / sqrt((double)mesh->vertex_count), 0.1), 0.5);
    const NormalLines lines = {object,
                               object->wrong_normals ? object->world_from_object
                                                     : mat4_normal(object->world_from_object),
                               share * scene_sphere(object, &box).radius};
    for (size_t i = 0; i < mesh->vertex_count && !flat; i++)
        add_normal(list, &lines, vec3_from_float(mesh->vertices[i].position),
                   vec3_from_float(mesh->vertices[i].normal));
    for (size_t i = 0; i < mesh->index_count / 3 && flat; i++) {
        Vec3 sum = {0, 0, 0}, normal;
        for (size_t k = 0; k < 3; k++)
            sum = vec3_add(sum, vec3_from_float(mesh->vertices[mesh->indices[3 * i + k]].position));
        if (mesh_face(mesh, i, &normal))
            add_normal(list, &lines, vec3_scale(sum, 1.0 / 3), normal);
    }
}

void overlay_add_normals(OverlayList *list, const Scene *scene)
{
    for (int i = 0; i < scene->object_count; i++)
        add_normals(list, &scene->objects[i], scene->interpolation == INTERPOLATION_FLAT);
}

/* A side of a triangle: its ends in a fixed order, and the triangle's normal. */
typedef struct Edge {
    float ends[2][3];
    Vec3 normal;
} Edge;

/* As numbers: zero has two signs. */
static int compare_places(const float a[3], const float b[3])
{
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

static int compare_edges(const void *a, const void *b)
{
    const Edge *x = a, *y = b;
    const int first = compare_places(x->ends[0], y->ends[0]);
    return first ? first : compare_places(x->ends[1], y->ends[1]);
}

/* The sides of all triangles with an area; sorted, so that shared ones follow each other. */
static size_t sort_edges(const Mesh *mesh, Edge *edges)
{
    size_t count = 0;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        Vec3 normal;
        if (!mesh_face(mesh, i / 3, &normal))
            continue;
        for (size_t k = 0; k < 3; k++) {
            const uint32_t *indices = mesh->indices + i;
            const float *from = mesh->vertices[indices[k]].position;
            const float *to = mesh->vertices[indices[(k + 1) % 3]].position;
            Edge *edge = &edges[count++];
            const bool swap = compare_places(from, to) > 0;
            memcpy(edge->ends[0], swap ? to : from, sizeof edge->ends[0]);
            memcpy(edge->ends[1], swap ? from : to, sizeof edge->ends[1]);
            edge->normal = normal;
        }
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    return count;
}

void overlay_add_edges(OverlayList *list, const Mesh *mesh, Mat4 world_from_object, Vec3 color)
{
    static const double IN_ONE_PLANE = 1e-6; /* the square of the sine; floats are off by 1e-12 */
    Edge *edges = malloc((mesh->index_count + 1) * sizeof *edges);
    if (!edges) {
        list->failed = true;
        return;
    }
    const size_t count = sort_edges(mesh, edges);
    for (size_t first = 0, next; first < count; first = next) {
        const Edge *edge = &edges[first];
        for (next = first + 1; next < count && compare_edges(edge, &edges[next]) == 0;)
            next++;
        const Vec3 apart = vec3_cross(edge->normal, edges[next - 1].normal);
        const bool diagonal = next == first + 2 && vec3_dot(apart, apart) < IN_ONE_PLANE &&
                              vec3_dot(edge->normal, edge[1].normal) > 0;
        if (!diagonal)
            add_line(list, mat4_transform_point(world_from_object, vec3_from_float(edge->ends[0])),
                     mat4_transform_point(world_from_object, vec3_from_float(edge->ends[1])),
                     color);
    }
    free(edges);
}

void overlay_add_lights(OverlayList *list, const Scene *scene)
{
    for (int i = 0; i < scene->light_count; i++) {
        const Light light = scene_world_light(scene, i);
        const Vec4 place = light_place(&light);
        add(list, (Vec3){place.x, place.y, place.z},
            light.off ? (Vec3){0.1, 0.1, 0.1} : (Vec3){1, 1, 1});
    }
}

void overlay_list_close(OverlayList *list)
{
    free(list->vertices);
    *list = (OverlayList){0};
}

bool overlay_open(Overlay *overlay, const ShaderLoader *loader, Message *message)
{
    *overlay = (Overlay){0};
    if (!shader_open(&overlay->shader, loader, "overlay", message) ||
        !shader_attribute(&overlay->shader, "a_Position", &overlay->a_Position, message) ||
        !shader_attribute(&overlay->shader, "a_Color", &overlay->a_Color, message) ||
        !shader_uniform(&overlay->shader, "u_ClipFromWorld", &overlay->u_ClipFromWorld, message) ||
        !shader_uniform(&overlay->shader, "u_PointSize", &overlay->u_PointSize, message)) {
        overlay_close(overlay);
        return false;
    }
    glGenBuffers(1, &overlay->buffer);
    return true;
}

/* Draws the points whose center is visible: drivers differ in whether they clip the others. */
static void draw_points(const OverlayList *list, Mat4 clip_from_world)
{
    for (int i = 0; i < list->count; i++) {
        const Vec3 place = vec3_from_float(list->vertices[i].position);
        const Vec4 clip = mat4_transform(clip_from_world, (Vec4){place.x, place.y, place.z, 1});
        if (fabs(clip.x) <= clip.w && fabs(clip.y) <= clip.w && fabs(clip.z) <= clip.w)
            glDrawArrays(GL_POINTS, i, 1);
    }
}

bool overlay_draw(const Overlay *overlay, const OverlayList *list, const Scene *scene,
                  double aspect, Message *message)
{
    Mat4 eye_from_world, clip_from_eye;
    if (list->failed)
        return message_set(message, "overlay: not enough memory");
    if (list->count == 0)
        return true;
    if (!scene_camera(&scene->camera, aspect, &eye_from_world, &clip_from_eye, message))
        return false;
    const GLuint position = (GLuint)overlay->a_Position, color = (GLuint)overlay->a_Color;
    const GLsizei stride = (GLsizei)sizeof(OverlayVertex);
    const float width = list->size > 0 ? (float)list->size : 1;
    const Mat4 clip_from_world = mat4_product(clip_from_eye, eye_from_world);
    glUseProgram(overlay->shader.program);
    shader_set_mat4(overlay->u_ClipFromWorld, clip_from_world);
    glUniform1fv(overlay->u_PointSize, 1, &width);
    glBindBuffer(GL_ARRAY_BUFFER, overlay->buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)list->count * sizeof *list->vertices),
                 list->vertices, GL_STREAM_DRAW);
    glEnableVertexAttribArray(position);
    glEnableVertexAttribArray(color);
    glVertexAttribPointer(position, 3, GL_FLOAT, GL_FALSE, stride,
                          (const void *)offsetof(OverlayVertex, position));
    glVertexAttribPointer(color, 3, GL_FLOAT, GL_FALSE, stride,
                          (const void *)offsetof(OverlayVertex, color));
    glLineWidth(list->points ? 1 : width);
    if (list->points)
        draw_points(list, clip_from_world);
    else
        glDrawArrays(GL_LINES, 0, list->count);
    glDisableVertexAttribArray(color);
    return true;
}

void overlay_close(Overlay *overlay)
{
    if (!overlay)
        return;
    if (overlay->buffer)
        glDeleteBuffers(1, &overlay->buffer);
    shader_close(&overlay->shader);
    *overlay = (Overlay){0};
}
