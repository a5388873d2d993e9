/*
 * lighting: draws a scene with programs made for its effects, and for nothing more.
 *
 * A program is put together from shaders/lighting.vert and lighting.frag by the effects of each
 * object, and kept: another object, or the same one later, whose program would have the same text
 * uses it again. Values are uniforms, so that changing a colour compiles nothing.
 */
#ifndef LIGHTING_H
#define LIGHTING_H

#include "effects.h"
#include "shader.h"

typedef struct Lighting Lighting;

/* What has been spent. */
typedef struct LightingCounts {
    int programs;           /* compiled */
    double compile_seconds; /* on them */
} LightingCounts;

/* `loader` is copied; its strings must outlive the Lighting. */
bool lighting_open(Lighting **lighting, const ShaderLoader *loader, Message *message);

/* How coordinates are composed. For the study of what that costs: */
typedef struct LightingTransforms {
    Mat4 (*eye_from_object)(const Camera *camera, Mat4 eye_from_world, Mat4 world_from_object);
    Vec3 (*eye_point)(const Camera *camera, Mat4 eye_from_world, Vec3 point_world);
    Mat4 (*clip_from_object)(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object);
} LightingTransforms;

/* In the place of scene_eye_from_object, scene_eye_point and clip_from_eye * eye_from_object, from
 * now on. NULL: those again. */
void lighting_use_transforms(Lighting *lighting, const LightingTransforms *transforms);

/* In the place of mat4_normal, from now on, and for every object with normals. NULL: that again,
 * where it is needed. To see what goes wrong. */
typedef Mat4 LightingNormalMatrix(Mat4 eye_from_object);
void lighting_use_normal_matrix(Lighting *lighting, LightingNormalMatrix *normal_matrix);

/* Draws a scene that has passed scene_check into the current canvas, over what is there. `full`
 * draws it with the program that has every effect, for comparison. A mesh's buffers are made at its
 * first drawing and kept by its address: it must not change before lighting_forget or
 * lighting_close. */
bool lighting_draw(Lighting *lighting, const Scene *scene, double aspect, bool full,
                   Message *message);

/* Drops the buffers of a mesh that is about to change or to be closed; NULL: of all meshes. */
void lighting_forget(Lighting *lighting, const Mesh *mesh);

/* The program that draws this object, made if need be; 0, with a message, if that fails. For tests
 * and tools that look into it. */
GLuint lighting_program(Lighting *lighting, const Scene *scene, const Object *object, bool full,
                        Message *message);

/* The same program's text, by ShaderStage, as the driver is given it; close both with
 * shader_source_close. Compiles nothing and needs no GL. Both are zeroed on failure. */
bool lighting_sources(const Lighting *lighting, const Scene *scene, const Object *object, bool full,
                      ShaderSource sources[2], Message *message);

LightingCounts lighting_counts(const Lighting *lighting);

/* NULL is fine. */
void lighting_close(Lighting *lighting);

#endif
