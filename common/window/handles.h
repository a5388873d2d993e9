/*
 * handles: the lights of a scene as points of its picture, which can be dragged. No GL.
 *
 * A light that belongs to the viewer has none.
 */
#ifndef HANDLES_H
#define HANDLES_H

#include "scene/scene.h"

typedef struct Handle {
    int view, light;
    double x, y; /* pixels from the picture's upper left corner */
} Handle;

enum { HANDLES_MAX = 64 };

/* Appends the lights of a view that its part of the picture (x, y, width, height) shows; returns
 * the new count. A directional light is at its direction from the origin. */
int handles_add(Handle handles[HANDLES_MAX], int count, const Scene *scene, int view,
                const int place[4]);

/* Around a sphere in the picture: x, y and radius, which is not positive behind the eye. */
void handles_ring(const Camera *camera, const int place[4], Sphere sphere, float ring[3]);

/* The nearest within `reach` pixels of (x, y); NULL: none. */
const Handle *handles_find(const Handle *handles, int count, double x, double y, double reach);

/* Where a light is whose point is dragged to (x, y): in the plane through it that is parallel to
 * the picture, or of a directional light a direction of the same length. Rounded to less than a
 * pixel. False if the scene has no such light, or the camera is none. */
bool handle_drag(const Scene *scene, const int place[4], int light, double x, double y, Vec3 *at);

#endif
