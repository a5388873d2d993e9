/*
 * probe_map: the shadow map of a lab's scene: the depths that its light sees, in a texture that
 * OpenGL ES 2.0 and WebGL 1 draw and read without extensions: packed into red, green and blue.
 */
#ifndef PROBE_MAP_H
#define PROBE_MAP_H

#include "core/gl.h"
#include "labs/program/probe.h"

enum { PROBE_MAP_SIZE = 1024 }; /* in texels, each way */

typedef struct ProbeMap {
    GLuint texture;
    Mat4 clip_from_world; /* of the light */
} ProbeMap;

/* From world space to clip space of a view from the first light at the objects before the last,
 * which is the floor. Their shadows are within. No GL. */
Mat4 probe_map_matrix(const Probe *probe);

/* Draws it, and binds what was bound. Of a scene whose light casts no shadows: zeroed. */
bool probe_map_open(ProbeMap *map, const Probe *probe, Message *message);
void probe_map_close(ProbeMap *map); /* NULL or zeroed is fine */

#endif
