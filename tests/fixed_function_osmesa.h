/*
 * fixed_function_osmesa: draws a scene by real OpenGL 1.1 lighting, the fixed-function pipeline of
 * Mesa in an OSMesa context. None of common/'s drawing is in it, and no other GL library: a process
 * that has called it must not open a canvas, nor the other way round.
 */
#ifndef FIXED_FUNCTION_OSMESA_H
#define FIXED_FUNCTION_OSMESA_H

#include "image.h"
#include "scene.h"

/* False, with a message that names the package, where this machine has no OSMesa. Of a scene, what
 * OpenGL 1.1 has is drawn: Gouraud, Blinn-Phong, clamped at the vertices, at most 8 lights. */
bool fixed_function_open(int width, int height, Message *message);
void fixed_function_draw(const Scene *scene, Image *picture);

/* The same shapes, unlit: each side of each object in a grey of its own, on black. */
void fixed_function_draw_sides(const Scene *scene, Image *picture);

void fixed_function_close(void);

#endif
