/*
 * exact_world: a scene to be changed, of which tests take exact pictures. No GL.
 */
#ifndef EXACT_WORLD_H
#define EXACT_WORLD_H

#include "reference/reference.h"
#include "shapes/solid.h"

enum { WORLD_SIZE = 64, WORLD_PIXELS = WORLD_SIZE * WORLD_SIZE, WORLD_MAX = 4 };

/* The eye at z = 4, so that z = 0 is 4 away and 2 * 4 tan 22.5 degrees high. */
typedef struct World {
    Mesh meshes[WORLD_MAX];
    Object objects[WORLD_MAX];
    Light lights[WORLD_MAX];
    Scene scene;
} World;
extern World world;

void world_open(void);         /* without lights and objects */
void world_close_meshes(void); /* for other ones */
void world_close(void);        /* with its pictures */

Object *world_add(Solid solid, int divisions, Mat4 world_from_object);

/* Fails the test unless the picture is finite. It stays open until world_close or world_forget. The
 * size may be left out. */
Reference world_trace(ReferenceOptions options);
void world_forget(void);

/* The largest difference of two pictures, in steps of 1/255. */
double world_difference(const Reference *a, const Reference *b);

/* Whether all values are the same, bit by bit, but for depths and lights. */
bool world_same(const Reference *a, const Reference *b);

/* The pixels that `mixed` names, more than `least`, are plain means of grid * grid samples. */
void world_assert_means(const Reference *picture, int grid,
                        bool (*mixed)(const Reference *picture, int pixel), int least);

#endif
