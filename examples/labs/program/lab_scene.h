/*
 * lab_scene: the scenes in which a submission is drawn, each made to reveal other mistakes. No GL.
 *
 *   A  the lab's own scene, as its program draws it
 *   B  turned, moved and, if the lab scales, scaled unevenly; the camera off the axis
 *   C  a coarse sphere and a narrow highlight; in labs of flat shapes a solid with many faces
 *   D  the light behind the object, a wide highlight
 *   E  overlapping objects, the far one drawn last
 *   F  a picture twice as wide as high, the light near the surface
 *   G  everything 300 times as large: overflows 16 bits
 *   H  the lights beside the eye, which is the world's origin and looks along -z
 *   I  the lights beyond the object, the eye on the z axis, a wide highlight
 *
 * H and I serve to tell mistakes apart: they show highlights near the line of sight. Each scene has
 * a known form, always the same, and one per seed, with other colours, positions, sizes and times.
 * In lab 3 the time gives the model matrix; lab 10 always has the unit sphere; lab 11 has a floor,
 * and its eye is always above it (lab_scene_parts.h).
 */
#ifndef LAB_SCENE_H
#define LAB_SCENE_H

#include "base/random.h"
#include "labs/program/lab.h"

typedef enum LabSceneKind {
    LAB_SCENE_PLAIN,
    LAB_SCENE_MOVED,
    LAB_SCENE_COARSE,
    LAB_SCENE_BEHIND,
    LAB_SCENE_CROWD,
    LAB_SCENE_WIDE,
    LAB_SCENE_HUGE,
    LAB_SCENE_ALONG,
    LAB_SCENE_AGAINST,
    LAB_SCENE_KIND_COUNT,
} LabSceneKind;

/* "A" to "I". */
extern const char *const LAB_SCENE_NAMES[LAB_SCENE_KIND_COUNT];

enum { LAB_SCENE_MAX_OBJECTS = 3 };

typedef struct LabScene {
    LabSceneKind kind;
    bool known; /* else of a seed */
    int width, height;
    double seconds;
    Scene scene; /* points into this scene: do not move it */
    Light lights[LAB_MAX_LIGHTS];
    Object objects[LAB_SCENE_MAX_OBJECTS];
    Mesh meshes[LAB_SCENE_MAX_OBJECTS];
    double fitted[LAB_SCENE_MAX_OBJECTS]; /* lab 7: Blinn-Phong's exponent for the object's */
    double own[LAB_MAX_UNIFORMS][4];      /* values of the lab's own uniforms */
} LabScene;

/* Lab 3's model matrix is move * turn * scale; the turn is about LAB_AXIS, by DEGREES_PER_SECOND.
 */
extern const Vec3 LAB_AXIS, LAB_SCALE;
void lab_scene_world_parts(double seconds, Mat4 *move, Mat4 *turn, Mat4 *scale);
Mat4 lab_scene_world(double seconds);

/* What scenes are made of. */

/* Of an object; `back` counts if the lab has two sides. */
typedef struct LabSurface {
    Vec3 color, specular, back;
    double shininess;
} LabSurface;

/* A scene without objects. */
void lab_scene_begin(LabScene *lab_scene, const Lab *lab, LabSceneKind kind);

/* A light at, or from, this place. */
void lab_scene_set_light(LabScene *lab_scene, int i, Vec3 place, Vec3 color);

/* The cone of lab 8's light, aimed at a point. */
void lab_scene_set_spot(LabScene *lab_scene, Vec3 at, double cutoff, double exponent);

bool lab_scene_add_object(LabScene *lab_scene, LabShape shape, Mat4 world_from_object,
                          Message *message);

/* Of object i. */
void lab_scene_set_material(LabScene *lab_scene, const Lab *lab, int i, const LabSurface *surface);

/* NULL or zeroed is fine. */
void lab_scene_close(LabScene *lab_scene);

#endif
