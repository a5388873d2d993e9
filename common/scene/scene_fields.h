/*
 * scene_fields: the members of a scene's structs by name, for files.
 */
#ifndef SCENE_FIELDS_H
#define SCENE_FIELDS_H

#include "scene/scene.h"

#include <stddef.h>

typedef enum FieldKind { FIELD_NUMBER, FIELD_VECTOR, FIELD_WHOLE, FIELD_FLAG } FieldKind;

typedef struct Field {
    const char *name; /* NULL ends a table */
    FieldKind kind;
    size_t place;
} Field;

#define NUMBER(type, member) #member, FIELD_NUMBER, offsetof(type, member)
#define VECTOR(type, member) #member, FIELD_VECTOR, offsetof(type, member)
#define WHOLE(type, member) #member, FIELD_WHOLE, offsetof(type, member)
#define FLAG(type, member) #member, FIELD_FLAG, offsetof(type, member)

static const Field CAMERA_FIELDS[] = {
    {VECTOR(Camera, eye)},    {VECTOR(Camera, center)}, {VECTOR(Camera, up)},
    {NUMBER(Camera, fovy)},   {NUMBER(Camera, near)},   {NUMBER(Camera, far)},
    {NUMBER(Camera, aspect)}, {.name = NULL},
};

static const Field LIGHT_FIELDS[] = {
    {FLAG(Light, off)},       {FLAG(Light, shadows)},     {WHOLE(Light, kind)},
    {WHOLE(Light, space)},    {VECTOR(Light, position)},  {VECTOR(Light, direction)},
    {VECTOR(Light, ambient)}, {VECTOR(Light, diffuse)},   {VECTOR(Light, specular)},
    {NUMBER(Light, cutoff)},  {NUMBER(Light, exponent)},  {NUMBER(Light, constant)},
    {NUMBER(Light, linear)},  {NUMBER(Light, quadratic)}, {NUMBER(Light, range)},
    {.name = NULL},
};

static const Field MATERIAL_FIELDS[] = {
    {VECTOR(Material, ambient)},
    {VECTOR(Material, diffuse)},
    {VECTOR(Material, specular)},
    {VECTOR(Material, emission)},
    {NUMBER(Material, alpha)},
    {NUMBER(Material, shininess)},
    {.name = NULL},
};

static const Field OBJECT_FIELDS[] = {
    {FLAG(Object, flat)},          {FLAG(Object, closed)},
    {FLAG(Object, clockwise)},     {WHOLE(Object, lamp)},
    {FLAG(Object, behind_lines)},  {FLAG(Object, two_sided)},
    {FLAG(Object, wrong_normals)}, {.name = NULL},
};

static const Field SOLID_FIELDS[] = {
    {WHOLE(Solid, kind)},  {NUMBER(Solid, radius)}, {NUMBER(Solid, height)},
    {NUMBER(Solid, tube)}, {WHOLE(Solid, caps)},    {.name = NULL},
};

static const Field SCENE_FIELDS[] = {
    {VECTOR(Scene, background)},
    {VECTOR(Scene, global_ambient)},
    {WHOLE(Scene, reflection)},
    {WHOLE(Scene, interpolation)},
    {FLAG(Scene, distant_viewer)},
    {FLAG(Scene, clamp_vertex)},
    {FLAG(Scene, skip_renormalization)},
    {FLAG(Scene, signed_dots)},
    {FLAG(Scene, linear)},
    {FLAG(Scene, show_clipped)},
    {.name = NULL},
};

#undef NUMBER
#undef VECTOR
#undef WHOLE
#undef FLAG

/* The member in JSON under which a file has them, in `extras`. */
#define FIELDS_MEMBER "lighting"

#endif
