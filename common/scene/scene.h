/*
 * scene: plain data to draw: a camera, lights, objects and the lighting model.
 *
 * Zero is the default of every field, so that scenes are written with designated initializers. A
 * scene owns nothing: it points at its lights and objects.
 */
#ifndef SCENE_H
#define SCENE_H

#include "base/cache.h"
#include "core/matrix.h"
#include "core/mesh.h"
#include "scene/light.h"
#include "scene/material.h"
#include "shapes/solid.h"

#include <stdbool.h>
#include <stdint.h>

/* Positions in world coordinates; fovy in degrees; near and far along the view, near > 0. */
typedef struct Camera {
    Vec3 eye, center, up;
    double fovy, near, far;
    /* In a picture narrower than this, width / height, fovy grows, so that what is seen of the
     * width stays. 0: it never does. */
    double aspect;
} Camera;

typedef enum Reflection {
    REFLECTION_BLINN_PHONG, /* N.H, as in OpenGL 1.1 */
    REFLECTION_PHONG,       /* R.V */
} Reflection;

typedef enum Interpolation {
    INTERPOLATION_PHONG,    /* of normals: lighting per fragment */
    INTERPOLATION_GOURAUD,  /* of colors: lighting per vertex */
    INTERPOLATION_FLAT,     /* one normal per triangle, lighting per vertex */
    INTERPOLATION_CONSTANT, /* one color per triangle, of its last vertex, as GL_FLAT */
} Interpolation;

/* Names by value, NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const REFLECTION_NAMES[]; /* "blinn-phong", "phong" */
enum { VIEWER_LOCAL, VIEWER_INFINITE };
extern const char *const VIEWER_NAMES[];        /* "local", "infinite" */
extern const char *const INTERPOLATION_NAMES[]; /* "phong", "gouraud", "flat", "constant" */

/* How the shadows of lights that have them are drawn. */
typedef enum ShadowWay {
    SHADOWS_OFF,     /* no light has any */
    SHADOWS_ON,      /* exact: volumes */
    SHADOWS_VOLUMES, /* exact, to the pixel */
    SHADOWS_MAP,
} ShadowWay;
extern const char *const SHADOW_NAMES[]; /* "off", "on", "volumes", "map" */

typedef struct ShadowSettings {
    int way;      /* a ShadowWay */
    int map_size; /* in texels, each way */
    int smooth;   /* a map's four nearest texels are compared; 0: the nearest */
    Vec3 bias;    /* of maps, in texels: towards the light, that times the slope, along the normal:
                     see shadows/shadow_map.h */
} ShadowSettings;
extern const ShadowSettings SHADOWS_DEFAULT;    /* exact */
extern const char *const SHADOW_FILTER_NAMES[]; /* "nearest", "2x2" */
enum { SHADOW_MAP_MIN = 16, SHADOW_MAP_MAX = 8192 };

typedef struct Object {
    const char *name; /* NULL: none */
    const Mesh *mesh;
    Solid solid;       /* the exact shape; zeroed, or if the mesh has colors: the triangles */
    bool flat;         /* the three normals of each triangle are equal */
    bool closed;       /* no back face is visible from outside */
    bool clockwise;    /* front faces are clockwise, as glFrontFace(GL_CW) has it */
    int lamp;          /* stands for light lamp - 1 within: casts no shadow; 0: for none */
    bool behind_lines; /* pushed back by polygon offset, so that its edges are drawn whole */
    Mat4 world_from_object;
    /* If the mesh has colors, they are the ambient and diffuse reflectivity (glColorMaterial). */
    Material front;
    /* The back has its own material and opposite normals; otherwise it is lit like the front. */
    bool two_sided;
    Material back;
    /* Transforms normals with the model-view matrix, to show what goes wrong. */
    bool wrong_normals;
} Object;

typedef struct Scene {
    Camera camera;
    Vec3 background;
    Vec3 global_ambient;
    const Light *lights;
    int light_count;
    const Object *objects;
    int object_count;
    Reflection reflection;
    Interpolation interpolation;
    bool distant_viewer; /* V = (0, 0, 1) in eye coordinates everywhere, as OpenGL 1.1's default */
    bool clamp_vertex;   /* clamp vertex colors before interpolation, as OpenGL 1.1 does; no
                            effect with lighting per fragment */
    bool skip_renormalization; /* do not normalize interpolated normals */
    bool signed_dots;  /* a negative N.L is not clamped to 0: a light behind a surface takes light
                          away. Of lights that cast shadows nothing arrives there. */
    bool linear;       /* colors are linear; encode the sum as sRGB */
    bool show_clipped; /* magenta if a channel exceeds 1 */
} Scene;

typedef struct SceneCopy {
    Scene scene;
    Light *lights;
    Object *objects;
    Mesh *meshes; /* of a deep copy, per object; empty if an earlier one has the same */
} SceneCopy;

/* Copies lights and objects. */
void scene_copy_open(SceneCopy *copy, const Scene *scene);

/* Meshes too; objects that share one still do. On failure the copy is zeroed. */
bool scene_copy_open_deep(SceneCopy *copy, const Scene *scene, Message *message);
void scene_copy_close(SceneCopy *copy); /* NULL or a zeroed copy is fine */

/* Lights of a scene at most; of those that cast shadows the first, because a mask has a bit for
 * each. */
enum { SCENE_MAX_LIGHTS = 65536, SCENE_MAX_CASTING = 32 };

/* Whether every number is finite and in its range, the camera valid and no direction zero. The
 * message names the parameter: "light 2: cutoff 95: must be 0 to 90". */
bool scene_check(const Scene *scene, Message *message);

/* The camera's transforms. False for an invalid camera. `aspect` is width / height. */
bool scene_camera(const Camera *camera, double aspect, Mat4 *eye_from_world, Mat4 *clip_from_eye,
                  Message *message);

/* The vertical field of view at this aspect, in degrees. */
double scene_fovy(const Camera *camera, double aspect);

/* Moves the near and far planes outwards where an object lies before or behind them, as far as the
 * depth buffer's precision lets them: near is not less than far / 1e5, nor, of an object whose box
 * has the eye in it, than far / 1e3. */
void scene_fit_depth(Scene *scene);

/* Whether no point of an object hides a light from another that faces it: it stands for a flat or a
 * closed convex solid. Such an object does not shadow itself, whatever the facets of its mesh are:
 * where N.L > 0 it sees the light. */
bool object_is_convex(const Object *object);

/* Whether a light that is on casts shadows. */
bool scene_has_shadows(const Scene *scene);

/* A sphere around an object's box, in world coordinates. */
typedef struct Sphere {
    Vec3 center;
    double radius;
} Sphere;
Sphere scene_sphere(const Object *object, const MeshBox *box);

/* A light in world coordinates, whatever its space. */
Light scene_world_light(const Scene *scene, int number);

/* What of a scene is not drawn. Zeroed: all is. */
typedef struct SceneTerms {
    unsigned left_out;        /* of the sum: TERM_* */
    uint32_t lights_left_out; /* a bit each; from the 32nd on the last */
    bool unlit;               /* no lighting at all: the diffuse color, or the mesh's */
} SceneTerms;
enum { TERM_AMBIENT = 1, TERM_DIFFUSE = 2, TERM_SPECULAR = 4, TERM_EMISSION = 8, TERM_ALL = 15 };

/* Removes from a copy's lights and materials what the terms leave out. */
void scene_keep_terms(SceneCopy *copy, SceneTerms terms);

/* Lets a copy's lights cast shadows, as far as they may, or none of them. */
void scene_cast_shadows(SceneCopy *copy, bool shadows);

/* Lights that were moved. Zeroed: none. */
enum { SCENE_MAX_PLACED = 8 };
typedef struct LightPlaces {
    unsigned placed;           /* a bit each */
    Vec3 at[SCENE_MAX_PLACED]; /* their positions, or directions of directional ones */
} LightPlaces;

/* Moves a copy's lights, and the objects that stand for them. */
void scene_place_lights(SceneCopy *copy, const LightPlaces *places);

/* Lights that were given other colors. Zeroed: none. */
typedef struct LightTints {
    unsigned tinted; /* a bit each */
    Vec3 diffuse[SCENE_MAX_PLACED], specular[SCENE_MAX_PLACED];
} LightTints;

/* Colors a copy's lights; objects that stand for them emit the diffuse color. */
void scene_tint_lights(SceneCopy *copy, const LightTints *tints);

/* eye_from_object, composed relative to the eye: the two translations are subtracted first, in
 * double precision, so that a scene far from the origin is drawn as accurately as one near it.
 * (Cozzi and Ring, 3D Engine Design for Virtual Globes, 2011, chapter 5) */
Mat4 scene_eye_from_object(const Camera *camera, Mat4 eye_from_world, Mat4 world_from_object);

/* A world point in eye coordinates, in the same way. */
Vec3 scene_eye_point(const Camera *camera, Mat4 eye_from_world, Vec3 point_world);

/* Adds what a mesh contains to a key. */
void scene_key_mesh(CacheKey *key, const Mesh *mesh);

#endif
