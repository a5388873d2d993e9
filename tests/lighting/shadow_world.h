/*
 * shadow_world: an object over a floor in the light of a point, drawn with shadows, for tests.
 */
#ifndef SHADOW_WORLD_H
#define SHADOW_WORLD_H

#include "core/canvas.h"
#include "lighting/lighting.h"

enum { WIDTH = 120, HEIGHT = 96 };

typedef struct ShadowWorld {
    Light lights[20];
    Object objects[4];
    Scene scene;
} ShadowWorld;

extern Canvas canvas;
extern Lighting *lighting;
extern Image image; /* the last that was drawn */
extern Mesh ball, coarse_ring, pipe_mesh, box, plane, pot, doubled, with_t;
extern ShadowWorld world;

/* Fixtures: the canvas and shadows by volumes; the meshes. */
int open_all(void **state);
int close_all(void **state);
int open_meshes(void **state);
int close_meshes(void **state);

void use_way(ShadowWay way);
void draw(const Scene *scene, bool full);

/* Draws; whether at most so many pixels inside an object, or none, are farther than a step from the
 * exact picture. */
bool check_wrong(const char *name, const Scene *scene, long long most);
bool check(const char *name, const Scene *scene);

/* The world with this object; another transform of it; with another ball and eight lights. */
void make_world(const Mesh *mesh);
void turn_first(Mat4 matrix);
void make_eight_lights(void);

#endif
