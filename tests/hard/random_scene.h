/*
 * random_scene: random scenes as flat data, the same for the same seeds.
 */
#ifndef RANDOM_SCENE_H
#define RANDOM_SCENE_H

#include "hard/hard.h"
#include "scene/scene.h"

enum { RANDOM_MAX_LIGHTS = 8, RANDOM_MAX_OBJECTS = 4 };

/* The source of an object's mesh: a solid with a formula, or one of those below with the solid's
 * radius. */
typedef enum RandomForm {
    FORM_SOLID,
    FORM_TETRAHEDRON,
    FORM_OCTAHEDRON,
    FORM_DODECAHEDRON,
    FORM_ICOSAHEDRON,
    FORM_LECTURE_SPHERE,
    FORM_COUNT,
} RandomForm;

typedef struct RandomShape {
    RandomForm form;
    Solid solid;
    int divisions;
    bool colored; /* its vertices have colors, which vary smoothly */
} RandomShape;

/* A scene with its lights and objects. `scene` points to them after random_scene_ready, which is
 * needed again for each copy. */
typedef struct RandomScene {
    Scene scene;
    Light lights[RANDOM_MAX_LIGHTS];
    Object objects[RANDOM_MAX_OBJECTS];
    RandomShape shapes[RANDOM_MAX_OBJECTS];
} RandomScene;

/* A cache of meshes, one for each shape. Zeroed: empty. */
typedef struct RandomMesh {
    RandomShape shape;
    Mesh mesh;
    struct RandomMesh *next;
} RandomMesh;
typedef struct RandomMeshes {
    RandomMesh *first;
    int count;
} RandomMeshes;
void random_meshes_close(RandomMeshes *meshes);

/* A scene around the origin that passes scene_check once it is ready. `kind` decides what it
 * contains, and so which programs draw it; `numbers` is the seed of every number. Positions are
 * multiples of 2^-20, so that they can be moved without rounding. It uses nothing that the exact
 * picture lacks. */
void random_scene_make(RandomScene *made, unsigned long long kind, unsigned long long numbers);

/* Points the scene to its lights and objects, and these to their meshes. False if a shape cannot be
 * made. */
bool random_scene_ready(RandomScene *made, RandomMeshes *meshes, Message *message);

/* Whether at some vertex (of a mesh that is ready) rounding to float may decide on which side of a
 * discontinuity light falls: the edge of a cone, or the end of a highlight where the surface turns
 * away. If light is computed at vertices, or a whole face lies there, this changes more than an
 * edge. */
bool random_scene_grazes(const RandomScene *made);

#endif
