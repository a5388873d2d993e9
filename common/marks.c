#include "marks.h"

#include <stddef.h>
#include <math.h>
#include <stdlib.h>

static void add(MarkList *list, Vec3 position, Vec3 color)
{
    if (list->count == list->capacity) {
        const int capacity = list->capacity ? 2 * list->capacity : 64;
        MarkVertex *larger = realloc(list->vertices, (size_t)capacity * sizeof *larger);
        if (!larger) {
            list->failed = true;
            return;
        }
        list->vertices = larger;
        list->capacity = capacity;
    }
    MarkVertex *vertex = &list->vertices[list->count++];
    vec3_to_float(position, vertex->position);
    vec3_to_float(color, vertex->color);
}

void marks_add_point(MarkList *list, Vec3 position, Vec3 color)
{
    add(list, position, color);
}

void marks_add_line(MarkList *list, Vec3 from, Vec3 to, Vec3 color)
{
    add(list, from, color);
    add(list, to, color);
}

void marks_add_axes(MarkList *list, double length)
{
    static const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++)
        marks_add_line(list, (Vec3){0, 0, 0}, vec3_scale(axes[i], length), axes[i]);
}

void marks_add_normals(MarkList *list, const Mesh *mesh, Mat4 world_from_object, Mat4 normal_matrix,
                       double length, Vec3 color)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const MeshVertex *vertex = &mesh->vertices[i];
        const Vec3 foot =
            mat4_transform_point(world_from_object, vec3_from_float(vertex->position));
        Vec3 unit;
        vec3_normalize(mat4_transform_direction(normal_matrix, vec3_from_float(vertex->normal)),
                       &unit);
        marks_add_line(list, foot, vec3_add(foot, vec3_scale(unit, length)), color);
    }
}

void marks_add_edges(MarkList *list, const Mesh *mesh, Mat4 world_from_object, Vec3 color)
{
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        Vec3 corners[3];
        for (size_t k = 0; k < 3; k++)
            corners[k] = mat4_transform_point(
                world_from_object, vec3_from_float(mesh->vertices[mesh->indices[i + k]].position));
        for (int k = 0; k < 3; k++)
            marks_add_line(list, corners[k], corners[(k + 1) % 3], color);
    }
}

void marks_add_lights(MarkList *list, const Scene *scene)
{
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        if (light->kind != LIGHT_DIRECTIONAL)
            marks_add_point(list, light->position,
                            light->off ? (Vec3){0.3, 0.3, 0.3} : light->diffuse);
    }
}

void marks_list_close(MarkList *list)
{
    free(list->vertices);
    *list = (MarkList){0};
}

bool marks_open(Marks *marks, const ShaderLoader *loader, Message *message)
{
    *marks = (Marks){0};
    if (!shader_open(&marks->shader, loader, "marks", message) ||
        !shader_attribute(&marks->shader, "a_Position", &marks->a_Position, message) ||
        !shader_attribute(&marks->shader, "a_Color", &marks->a_Color, message) ||
        !shader_uniform(&marks->shader, "u_ClipFromWorld", &marks->u_ClipFromWorld, message) ||
        !shader_uniform(&marks->shader, "u_PointSize", &marks->u_PointSize, message)) {
        marks_close(marks);
        return false;
    }
    glGenBuffers(1, &marks->buffer);
    return true;
}

/* Those whose middle is seen: drivers differ in whether they draw what of another reaches into the
 * picture. */
static void draw_points(const MarkList *list, Mat4 clip_from_world)
{
    for (int i = 0; i < list->count; i++) {
        const Vec3 place = vec3_from_float(list->vertices[i].position);
        const Vec4 clip = mat4_transform(clip_from_world, (Vec4){place.x, place.y, place.z, 1});
        if (fabs(clip.x) <= clip.w && fabs(clip.y) <= clip.w && fabs(clip.z) <= clip.w)
            glDrawArrays(GL_POINTS, i, 1);
    }
}

bool marks_draw(const Marks *marks, const MarkList *list, GLenum mode, double size,
                const Scene *scene, double aspect, Message *message)
{
    Mat4 eye_from_world, clip_from_eye;
    if (list->failed)
        return message_set(message, "marks: not enough memory");
    if (list->count == 0)
        return true;
    if (!scene_camera(&scene->camera, aspect, &eye_from_world, &clip_from_eye, message))
        return false;
    const GLuint position = (GLuint)marks->a_Position, color = (GLuint)marks->a_Color;
    const GLsizei stride = (GLsizei)sizeof(MarkVertex);
    const float point_size = (float)size;
    const Mat4 clip_from_world = mat4_product(clip_from_eye, eye_from_world);
    glUseProgram(marks->shader.program);
    shader_set_mat4(marks->u_ClipFromWorld, clip_from_world);
    glUniform1fv(marks->u_PointSize, 1, &point_size);
    glBindBuffer(GL_ARRAY_BUFFER, marks->buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)list->count * sizeof *list->vertices),
                 list->vertices, GL_STREAM_DRAW);
    glEnableVertexAttribArray(position);
    glEnableVertexAttribArray(color);
    glVertexAttribPointer(position, 3, GL_FLOAT, GL_FALSE, stride,
                          (const void *)offsetof(MarkVertex, position));
    glVertexAttribPointer(color, 3, GL_FLOAT, GL_FALSE, stride,
                          (const void *)offsetof(MarkVertex, color));
    if (mode == GL_POINTS)
        draw_points(list, clip_from_world);
    else
        glDrawArrays(mode, 0, list->count);
    glDisableVertexAttribArray(color);
    return true;
}

void marks_close(Marks *marks)
{
    if (!marks)
        return;
    if (marks->buffer)
        glDeleteBuffers(1, &marks->buffer);
    shader_close(&marks->shader);
    *marks = (Marks){0};
}
