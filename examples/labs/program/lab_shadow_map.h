/*
 * lab_shadow_map: the shadow map of a lab's scene: the depths that its light sees, in a texture
 * that OpenGL ES 2.0 and WebGL 1 draw and read without extensions: packed into red, green and blue.
 */
#ifndef LAB_SHADOW_MAP_H
#define LAB_SHADOW_MAP_H

#include "core/gl.h"
#include "labs/program/lab_scene.h"

enum { LAB_SHADOW_MAP_SIZE = 1024 }; /* in texels, each way */

typedef struct LabShadowMap {
    GLuint texture;
    Mat4 clip_from_world; /* of the light */
} LabShadowMap;

/* From world space to clip space of a view from the first light at the objects before the last,
 * which is the floor. Their shadows are within. No GL. */
Mat4 lab_shadow_map_matrix(const LabScene *lab_scene);

/* Draws it, and binds what was bound. Of a scene whose light casts no shadows: zeroed. */
bool lab_shadow_map_open(LabShadowMap *map, const LabScene *lab_scene, Message *message);
void lab_shadow_map_close(LabShadowMap *map); /* NULL or zeroed is fine */

#endif
