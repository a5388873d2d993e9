/*
 * fixed_function_osmesa: draws a scene by real OpenGL 1.1 lighting, the fixed-function pipeline of
 * Mesa in an OSMesa context. None of common/'s drawing is in it, and no other GL library: a process
 * that has called it must not open a canvas, nor the other way round.
 */
#ifndef FIXED_FUNCTION_OSMESA_H
#define FIXED_FUNCTION_OSMESA_H

#include "images/image_file.h"
#include "scene/scene.h"

/* False, with a message that names the package, where this machine has no OSMesa. Of a scene, what
 * OpenGL 1.1 has is drawn: Gouraud or constant (GL_FLAT), Blinn-Phong, clamped at the vertices, at
 * most 8 lights. With vertex colors (GL_COLOR_MATERIAL) both sides have the front's alpha. Not
 * `behind_lines`: how far polygon offset moves a surface is the implementation's choice. */
bool fixed_function_open(int width, int height, Message *message);
void fixed_function_draw(const Scene *scene, Image *picture);

/* The same shapes, unlit: each side of each object in a red of its own, on black; if a triangle has
 * one color, with a green and blue for each. */
void fixed_function_draw_sides(const Scene *scene, Image *picture);

void fixed_function_close(void);

#endif
