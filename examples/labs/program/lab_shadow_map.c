/* A shadow map (Williams, Casting curved shadows on curved surfaces, 1978) whose frustum holds just
 * the objects that cast shadows; depth is packed into three bytes, because not every OpenGL ES 2.0
 * has depth textures. */
#include "labs/program/binding.h"

#include "core/canvas.h"
#include "core/mesh_buffer.h"
#include "core/shader.h"

#include <math.h>

/* The middle of the objects that cast shadows, and the radius around it. */
static double casters(const LabScene *lab_scene, Vec3 *center)
{
    const int count = lab_scene->scene.object_count - 1;
    Vec3 low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = vec3_scale(low, -1);
    double radius = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < count; i++) {
            const Object *object = &lab_scene->objects[i];
            for (size_t v = 0; v < object->mesh->vertex_count; v++) {
                const Vec3 at = mat4_transform_point(
                    object->world_from_object, vec3_from_float(object->mesh->vertices[v].position));
                low = (Vec3){fmin(low.x, at.x), fmin(low.y, at.y), fmin(low.z, at.z)};
                high = (Vec3){fmax(high.x, at.x), fmax(high.y, at.y), fmax(high.z, at.z)};
                if (pass == 1)
                    radius = fmax(radius, vec3_length(vec3_subtract(at, *center)));
            }
        }
        *center = vec3_scale(vec3_add(low, high), 0.5);
    }
    return radius;
}

/* From world space to clip space of a view from the first light at the objects before the last,
 * which is the floor. Their shadows are within. */
static Mat4 shadow_map_matrix(const LabScene *lab_scene)
{
    /* A few texels more than the objects need; from before them to beyond the floor. */
    const double margin = 1.05, near = 0.25, far = 5;
    const Vec3 light = lab_scene->lights[0].position;
    Vec3 center;
    const double radius = casters(lab_scene, &center);
    const double distance = vec3_length(vec3_subtract(light, center));
    const double degrees = 2 * asin(fmin(margin * radius / distance, 0.9)) * 180 / acos(-1);
    /* The light is above, so z is never its direction. */
    return mat4_product(mat4_perspective(degrees, 1, near * distance, far * distance),
                        mat4_look_at(light, center, (Vec3){0, 0, -1}));
}

static bool draw_objects(const LabShadowMap *map, const LabScene *lab_scene, Message *message)
{
    const GLint position = glGetAttribLocation(map->shader.program, "a_Position");
    const GLint clip = glGetUniformLocation(map->shader.program, "u_ClipFromObject");
    glUseProgram(map->shader.program);
    for (int i = 0; i < lab_scene->scene.object_count; i++) {
        const Object *object = &lab_scene->objects[i];
        MeshBuffer mesh;
        if (!mesh_buffer_open(&mesh, object->mesh, message))
            return false;
        shader_set_mat4(clip, mat4_product(map->clip_from_world, object->world_from_object));
        mesh_buffer_bind(&mesh, position, -1);
        glDrawElements(GL_TRIANGLES, mesh.index_count, mesh.index_type, NULL);
        mesh_buffer_close(&mesh);
    }
    return true;
}

static bool draw_map(const LabShadowMap *map, const LabScene *lab_scene, Message *message)
{
    GLuint framebuffer, depth;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map->texture, 0);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER,
                          gl_version() >= 30 || gl_has("GL_OES_depth24") ? GL_DEPTH_COMPONENT24_OES
                                                                         : GL_DEPTH_COMPONENT16,
                          LAB_SHADOW_MAP_SIZE, LAB_SHADOW_MAP_SIZE);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    bool done = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ||
                message_set(message, "the driver cannot draw a shadow map of %dx%d",
                            LAB_SHADOW_MAP_SIZE, LAB_SHADOW_MAP_SIZE);
    if (done) {
        glViewport(0, 0, LAB_SHADOW_MAP_SIZE, LAB_SHADOW_MAP_SIZE);
        glClearColor(1, 1, 1, 1); /* beyond all depths */
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        done = draw_objects(map, lab_scene, message);
    }
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &depth);
    return done;
}

bool lab_shadow_map_open(LabShadowMap *map, const LabScene *lab_scene, Message *message)
{
    const ShaderLoader loader = {.precision = "highp"};
    GLint target, place[4];
    if (map->texture)
        glDeleteTextures(1, &map->texture);
    map->texture = 0;
    if (!lab_scene->lights[0].shadows)
        return true;
    if (!map->shader.program && !shader_open(&map->shader, &loader, "labs/map", message))
        return false;
    const bool cut = glIsEnabled(GL_SCISSOR_TEST), cull = glIsEnabled(GL_CULL_FACE);
    const bool hidden = glIsEnabled(GL_DEPTH_TEST);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &target);
    glGetIntegerv(GL_VIEWPORT, place);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    map->clip_from_world = shadow_map_matrix(lab_scene);
    map->texture =
        canvas_texture(GL_RGBA, GL_UNSIGNED_BYTE, LAB_SHADOW_MAP_SIZE, LAB_SHADOW_MAP_SIZE);
    const bool done = draw_map(map, lab_scene, message);
    if (cut)
        glEnable(GL_SCISSOR_TEST);
    if (cull)
        glEnable(GL_CULL_FACE);
    if (!hidden)
        glDisable(GL_DEPTH_TEST);
    glViewport(place[0], place[1], place[2], place[3]);
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)target);
    if (!done)
        lab_shadow_map_close(map);
    return done;
}

void lab_shadow_map_close(LabShadowMap *map)
{
    if (!map)
        return;
    if (map->texture)
        glDeleteTextures(1, &map->texture);
    shader_close(&map->shader);
    *map = (LabShadowMap){.texture = 0};
}
