/*
 * random_scene: scenes that look random, the same for the same seeds, as flat data: printed as C
 * text that a test can hold, changed number by number by what looks for errors.
 */
#ifndef RANDOM_SCENE_H
#define RANDOM_SCENE_H

#include "hard.h"
#include "scene.h"

#include <stdio.h>

enum { RANDOM_MOST_LIGHTS = 8, RANDOM_MOST_OBJECTS = 4 };

/* What an object's mesh is made from: a solid with a formula, or one of those below with the
 * solid's radius. */
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
} RandomShape;

/* A scene with its lights and objects. Those are found through `scene` once random_scene_ready has
 * been called: anew for each copy. */
typedef struct RandomScene {
    Scene scene;
    Light lights[RANDOM_MOST_LIGHTS];
    Object objects[RANDOM_MOST_OBJECTS];
    RandomShape shapes[RANDOM_MOST_OBJECTS];
} RandomScene;

/* Meshes that have been made, one for each shape. Zeroed: none. */
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

/* A scene around the origin that passes scene_check once it is ready. `kind` decides what there is,
 * and with it which programs draw the scene; `numbers` every number. Places are multiples of 2^-20,
 * so that they can be moved without rounding. Nothing asks for what the exact picture lacks. */
void random_scene_make(RandomScene *made, unsigned long long kind, unsigned long long numbers);

/* Points the scene at its lights and objects, and these at their meshes, whether flat and closed.
 * False where a shape cannot be made. */
bool random_scene_ready(RandomScene *made, RandomMeshes *meshes, Message *message);

/* Whether at some vertex (of a mesh that is ready) rounding to float may decide on which side of a
 * jump light lies: at the edge of a cone, or of a highlight where the surface turns away. Where
 * light is computed at vertices, or a whole face lies there, that changes more than an edge. */
bool random_scene_grazes(const RandomScene *made);

/* Draws a scene that is ready. False, with a message, as lighting_draw. */
bool random_scene_draw(const RandomScene *made, const Canvas *canvas, Lighting *lighting,
                       Image *image, Message *message);

/* A number of the scene, and what scene_check or the making of a mesh takes. */
typedef struct RandomNumber {
    double *value;
    double least, most;
} RandomNumber;
enum { RANDOM_MOST_NUMBERS = 400 };

/* Those that count, of lights, objects and sides that there are; returns how many. */
int random_scene_numbers(RandomScene *made, RandomNumber numbers[RANDOM_MOST_NUMBERS]);

/* Writes "static const RandomScene NAME = {...};", from which a compiler makes the same bits. */
void random_scene_print(const RandomScene *made, const char *name, FILE *file);

#endif
