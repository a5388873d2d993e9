/*
 * scene: what there is to draw, as plain data: a camera, lights, objects and the lighting model.
 *
 * A zeroed field has the usual meaning, so that a scene is written with designated initializers.
 * Nothing here is computed or owned: a scene points at its lights and objects.
 */
#ifndef SCENE_H
#define SCENE_H

#include "light.h"
#include "material.h"
#include "matrix.h"
#include "mesh.h"
#include "solid.h"

#include <stdbool.h>

/* Positions in the world; angle in degrees; distances along the view. Near is greater than 0. */
typedef struct Camera {
    Vec3 eye, center, up;
    double fovy, near, far;
} Camera;

typedef enum Reflection {
    REFLECTION_BLINN_PHONG, /* the highlight by N.H, as in OpenGL 1.1 */
    REFLECTION_PHONG,       /* by R.V */
} Reflection;

typedef enum Interpolation {
    INTERPOLATION_PHONG,   /* of normals: light at every fragment */
    INTERPOLATION_GOURAUD, /* of colours: light at every vertex */
    INTERPOLATION_FLAT,    /* one normal for each triangle, light at its vertices */
} Interpolation;

/* Their names by number, NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const REFLECTION_NAMES[];    /* "blinn-phong", "phong" */
extern const char *const INTERPOLATION_NAMES[]; /* "phong", "gouraud", "flat" */

typedef struct Object {
    const Mesh *mesh;
    Solid solid; /* what the mesh stands for; zeroed, the triangles themselves */
    bool flat;   /* every triangle's three normals are equal, as a cube's are */
    bool closed; /* a solid: no back face is ever seen from outside */
    Mat4 world_from_object;
    Material front;
    /* Lights both sides, the back with its own material and reversed normals. Else every fragment
     * is lit as a front one. */
    bool two_sided;
    Material back;
    /* To show what goes wrong: transform normals with the model-view matrix itself. */
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
    bool clamp_vertex; /* clamp each vertex's colour before it is interpolated, as OpenGL 1.1 does;
                          without effect where fragments are lit */
    bool skip_renormalization; /* leave interpolated normals as they are, shorter than unit */
    bool linear;               /* take colours for linear and encode the sum as sRGB */
    bool show_clipped;         /* paint magenta where a channel exceeds 1 */
} Scene;

/* A scene that shares nothing with the one it was copied from. */
typedef struct SceneCopy {
    Scene scene;
    Light *lights;
    Object *objects;
    Mesh *meshes; /* for each object; empty where an earlier one has the same */
} SceneCopy;

/* Copies lights, objects and meshes; a mesh that several objects share is still one. False, with a
 * message and a zeroed copy, where memory runs out. */
bool scene_copy_open(SceneCopy *copy, const Scene *scene, Message *message);
void scene_copy_close(SceneCopy *copy); /* NULL or a zeroed copy is fine */

/* Whether a scene has a meaning: every number finite and in its range, a camera that looks
 * somewhere, directions that are not zero. The message names the parameter: "light 2: cutoff 95:
 * must be 0 to 90 degrees". */
bool scene_check(const Scene *scene, Message *message);

/* Eye coordinates, and clip coordinates from them. False, as scene_check, for a camera without
 * meaning. `aspect` is width / height. */
bool scene_camera(const Camera *camera, double aspect, Mat4 *eye_from_world, Mat4 *clip_from_eye,
                  Message *message);

/* eye_from_object, composed relative to the eye: the difference of the two translations is taken
 * first, in double precision, so that a scene far from the origin draws as it does there.
 * (Cozzi and Ring, 3D Engine Design for Virtual Globes, 2011, chapter 5) */
Mat4 scene_eye_from_object(const Camera *camera, Mat4 eye_from_world, Mat4 world_from_object);

/* A point of the world in eye coordinates, in the same way. */
Vec3 scene_eye_point(const Camera *camera, Mat4 eye_from_world, Vec3 point_world);

#endif
