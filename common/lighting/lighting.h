/*
 * lighting: draws a scene with programs specialized for the effects of its objects, from a plan.
 *
 * A plan is what is decided: the effects of each object and its program, what casts shadows on what
 * in which light, and how each shadow is drawn. It is plain data: --explain prints it. A frame then
 * only sets values and draws. The programs are assembled from shaders/lighting.vert and
 * lighting.frag. Values are uniforms, so that changing a color compiles nothing.
 */
#ifndef LIGHTING_H
#define LIGHTING_H

#include "core/mesh_buffer.h"
#include "core/shader.h"
#include "scene/effects.h"
#include "scene/shadow_pairs.h"
#include "shadows/shadow_frustum.h"

typedef struct Lighting Lighting;

typedef struct LightingCounts {
    int programs; /* compiled so far */
    double compile_seconds;
    long long texts;        /* of programs written, to find those to compile */
    long long volumes;      /* of shadows, drawn so far */
    long long volumes_made; /* of those: others were as in the last frame */
    long long maps;         /* the faces of a cube are several maps */
} LightingCounts;

/* `loader` is copied; its strings must outlive the Lighting. */
bool lighting_open(Lighting **lighting, const ShaderLoader *loader, Message *message);

/* From now on, how shadows are drawn, instead of SHADOWS_DEFAULT. SHADOWS_OFF: as that. */
void lighting_use_shadows(Lighting *lighting, const ShadowSettings *settings);

ShadowSettings lighting_shadows(const Lighting *lighting);

/* How transforms are composed; replaceable for the study of their accuracy and cost. */
typedef struct LightingTransforms {
    Mat4 (*eye_from_object)(const Camera *camera, Mat4 eye_from_world, Mat4 world_from_object);
    Vec3 (*eye_point)(const Camera *camera, Mat4 eye_from_world, Vec3 point_world);
    Mat4 (*clip_from_object)(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object); /* NULL: as usual */
} LightingTransforms;

/* The usual ones: scene_eye_from_object, scene_eye_point and clip_from_eye * eye_from_object. */
extern const LightingTransforms LIGHTING_TRANSFORMS;

/* From now on, instead of those. NULL restores them. */
void lighting_use_transforms(Lighting *lighting, const LightingTransforms *transforms);

/* From now on, instead of mat4_normal, for every object with normals, to show wrong ones. NULL
 * restores mat4_normal. */
typedef Mat4 LightingNormalMatrix(Mat4 eye_from_object);
void lighting_use_normal_matrix(Lighting *lighting, LightingNormalMatrix *normal_matrix);

/* From now on, whether volumes of shadows are counted before the surfaces only, to show what is
 * wrong with that where the eye is in one. */
void lighting_use_depth_pass(Lighting *lighting, bool depth_pass);

/* What is drawn: a scene that has passed scene_check. */
typedef struct LightingFrame {
    const Scene *scene;
    /* NULL; or object i is drawn as parts[i] says, a scene of one object, with as many lights:
     * shadows are those of the scene. */
    const Scene *parts;
    double aspect; /* width / height */
    bool full;     /* with the program of every effect, for comparison */
    int view;      /* for lighting_show: of views that are drawn in turn, from 0 on */
} LightingFrame;

typedef struct PlannedObject {
    ObjectFacts facts;                     /* why its effects are what they are */
    const struct LightingVariant *variant; /* its effects and program */
    const MeshBuffer *drawn, *plain;   /* its mesh, as the interpolation needs it; and as it is */
    const struct ShadowCaster *caster; /* NULL: it casts no shadow by a volume */
    /* What the facts were last found from. */
    const Mesh *mesh;
    NormalCone normals; /* the mesh's */
    bool convex, lamp;
    Mat4 world_from_object;
    EffectsPlace place;
} PlannedObject;

typedef struct PlannedLight {
    ShadowWay way;   /* of its shadows; SHADOWS_OFF: none can fall */
    bool in_program; /* its map is looked up by the programs that light objects; else by one that
                        marks its channel of a mask */
    int look;        /* then: shadow_map_look */
    int face_count;
    ShadowFrustum faces[SHADOW_FACES]; /* of its map */
    Light placed;                      /* in the world */
} PlannedLight;

/* Zeroed: not made. */
typedef struct LightingPlan {
    Lighting *lighting;
    int object_count, object_capacity, light_capacity;
    int light_count; /* of the lights that may cast shadows: all, or the first */
    PlannedObject *objects;
    SceneFacts *scenes; /* one; or of each object */
    EffectsView view;
    struct EyeLight *eye_lights; /* of the scene, while a frame is drawn */
    int eye_room;
    PlannedLight *lights;
    ShadowPairs pairs; /* what casts and receives which light's shadows */
    uint32_t shadows;  /* the lights that have any, a bit each */
    uint32_t maps;     /* the lights whose maps the programs look up, a bit each */
    int masks;         /* how many textures of masks */
    bool full, in_parts;
    bool each;           /* objects have lights of their own: in parts, or of too many for all */
    LightingFrame frame; /* the last */
    long long decisions; /* how often an object's effects or program were decided so far */
    int renewal;         /* the Lighting's, when it was made */
    Vec3 eye;
    struct ShadowSurface *surfaces; /* of the objects, while a frame is drawn */
    struct ShadowMapCaster *casters;
} LightingPlan;

/* Makes a plan of a frame, or of the next: then an object is decided anew only if its facts or its
 * scene's have changed, which are found again and compared as bytes (scene/effects.h): about 0.1 µs
 * an object, and what shadows may fall on if something has moved. In a frame without decisions
 * nothing is allocated, compiled or looked up by name. Mesh buffers are cached by the mesh's
 * address: a mesh must not change before lighting_forget or lighting_close. */
bool lighting_plan(LightingPlan *plan, Lighting *lighting, const LightingFrame *frame,
                   Message *message);

/* The same, but only decides: compiles and uploads nothing, and needs no GL unless shadows are by
 * maps. The plan is to be read, not drawn. */
bool lighting_decide(LightingPlan *plan, Lighting *lighting, const LightingFrame *frame,
                     Message *message);

/* Draws the frame into the current canvas, without clearing it. The plan is that of this frame.
 * Where a light has shadows that may fall on something, masks of them are drawn first
 * (shadows/shadow_mask.h), or maps, which the programs look up (shadows/shadow_map.h). */
bool lighting_draw(LightingPlan *plan, const LightingFrame *frame, Message *message);

void lighting_plan_close(LightingPlan *plan); /* NULL or zeroed is fine */

/* Both at once, with a plan that is kept for the next frame of this view. */
bool lighting_show(Lighting *lighting, const LightingFrame *frame, Message *message);

/* What a plan says of an object: its effects, and a line for each one and for each one left out,
 * with the reason. */
const SceneFacts *lighting_plan_facts(const LightingPlan *plan, int object);
Effects lighting_plan_effects(const LightingPlan *plan, int object);
void lighting_plan_explain(const LightingPlan *plan, int object, FILE *file);

/* Of each light of a scene that has more than an object may have, an EffectsReach. Its frame must
 * still be there. False: an object has all lights of the scene. */
bool lighting_plan_reach(const LightingPlan *plan, int object, uint8_t *why);

/* A line for each light with shadows: how they are drawn, or that nothing can come between; of maps
 * how fine they and their depths are. */
void lighting_plan_explain_shadows(const LightingPlan *plan, const Scene *scene, FILE *file);

/* The sources of an object's program by ShaderStage, as the driver receives them, or of the one
 * with every effect; close both with shader_source_close. Both are zeroed on failure. */
bool lighting_plan_sources(const LightingPlan *plan, int object, bool full, ShaderSource sources[2],
                           Message *message);

/* The same with other effects than the object's; shadows are looked up as they are for its own. */
bool lighting_plan_sources_of(const LightingPlan *plan, int object, const Effects *effects,
                              ShaderSource sources[2], Message *message);

/* The same for an object of a scene, from a plan that is only decided. */
bool lighting_sources(Lighting *lighting, const Scene *scene, const Object *object, bool full,
                      ShaderSource sources[2], Message *message);

/* Drops the buffers of a mesh before it changes or closes; NULL: of all meshes. */
void lighting_forget(Lighting *lighting, const Mesh *mesh);

LightingCounts lighting_counts(const Lighting *lighting);

/* NULL is fine. */
void lighting_close(Lighting *lighting);

#endif
