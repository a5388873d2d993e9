/*
 * lighting: draws a scene with programs specialized for the effects of its objects.
 *
 * A program is assembled from shaders/lighting.vert and lighting.frag and cached by its text.
 * Values are uniforms, so that changing a color compiles nothing.
 */
#ifndef LIGHTING_H
#define LIGHTING_H

#include "core/shader.h"
#include "scene/effects.h"

typedef struct Lighting Lighting;

typedef struct LightingCounts {
    int programs; /* compiled so far */
    double compile_seconds;
    long long volumes, volume_triangles; /* of shadows, drawn so far */
    long long volumes_made;              /* of those: others were as in the last frame */
    long long maps, flattened;           /* the faces of a cube are several maps */
} LightingCounts;

/* `loader` is copied; its strings must outlive the Lighting. */
bool lighting_open(Lighting **lighting, const ShaderLoader *loader, Message *message);

/* From now on, how shadows are drawn, instead of SHADOWS_DEFAULT. SHADOWS_OFF: as that. */
void lighting_use_shadows(Lighting *lighting, const ShadowSettings *settings);

ShadowSettings lighting_shadows(const Lighting *lighting);

/* Writes a line for each light with shadows: how they are drawn, or that nothing can come between;
 * of maps how fine they and their depths are. */
bool lighting_explain_shadows(Lighting *lighting, const Scene *scene, FILE *file, Message *message);

/* How transforms are composed; replaceable for the study of their accuracy and cost. */
typedef struct LightingTransforms {
    Mat4 (*eye_from_object)(const Camera *camera, Mat4 eye_from_world, Mat4 world_from_object);
    Vec3 (*eye_point)(const Camera *camera, Mat4 eye_from_world, Vec3 point_world);
    Mat4 (*clip_from_object)(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object);
} LightingTransforms;

/* From now on, instead of scene_eye_from_object, scene_eye_point and clip_from_eye *
 * eye_from_object. NULL restores those. */
void lighting_use_transforms(Lighting *lighting, const LightingTransforms *transforms);

/* From now on, instead of mat4_normal, for every object with normals, to show wrong ones. NULL
 * restores mat4_normal. */
typedef Mat4 LightingNormalMatrix(Mat4 eye_from_object);
void lighting_use_normal_matrix(Lighting *lighting, LightingNormalMatrix *normal_matrix);

/* From now on, whether volumes of shadows are counted before the surfaces only, to show what is
 * wrong with that where the eye is in one. */
void lighting_use_depth_pass(Lighting *lighting, bool depth_pass);

/* Draws a scene that has passed scene_check into the current canvas, without clearing it. `full`
 * uses the program with every effect, for comparison. Mesh buffers are cached by the mesh's
 * address: a mesh must not change before lighting_forget or lighting_close. Where a light has
 * shadows that may fall on something, masks of them are drawn first (shadows/shadow_mask.h), or
 * maps, which the programs look up (shadows/shadow_map.h). */
bool lighting_draw(Lighting *lighting, const Scene *scene, double aspect, bool full,
                   Message *message);

/* The same of a scene whose objects are drawn as `parts` say, scenes of one object each, with as
 * many lights: shadows are those of the scene. */
bool lighting_draw_parts(Lighting *lighting, const Scene *scene, const Scene *parts, double aspect,
                         bool full, Message *message);

/* Drops the buffers of a mesh before it changes or closes; NULL: of all meshes. */
void lighting_forget(Lighting *lighting, const Mesh *mesh);

/* Finds which shadows the programs look up in maps themselves, as a frame of the scene does. */
bool lighting_find_maps(Lighting *lighting, const Scene *scene, bool full, Message *message);

/* The program that draws this object, compiled if necessary; 0, with a message, on failure. For
 * tests and tools; after lighting_find_maps or a frame, if the scene has shadows by maps. */
GLuint lighting_program(Lighting *lighting, const Scene *scene, const Object *object, bool full,
                        Message *message);

/* That program's sources by ShaderStage, as the driver receives them; close both with
 * shader_source_close. Needs no GL. Both are zeroed on failure. */
bool lighting_sources(const Lighting *lighting, const Scene *scene, const Object *object, bool full,
                      ShaderSource sources[2], Message *message);

LightingCounts lighting_counts(const Lighting *lighting);

/* NULL is fine. */
void lighting_close(Lighting *lighting);

#endif
