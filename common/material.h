/*
 * material: how a surface reflects light.
 */
#ifndef MATERIAL_H
#define MATERIAL_H

#include "matrix.h"

/* Reflectivities for red, green and blue, 0 to 1, one for each kind of light. (OpenGL 1.1
 * specification, section 2.13.1, table 2.7) */
typedef struct Material {
    Vec3 ambient, diffuse, specular;
    Vec3 emission;    /* light of its own, whatever shines on it */
    double alpha;     /* of the diffuse colour: the opacity; 1 for an opaque surface, 0 if zeroed */
    double shininess; /* the exponent of the specular term, 0 to 128 */
} Material;

/* A material by a name, from http://devernay.free.fr/cours/opengl/materials.html, where shininess
 * is given as a fraction of 128. */
typedef struct NamedMaterial {
    const char *name;
    Material material;
} NamedMaterial;

enum { MATERIAL_COUNT = 24 };
extern const NamedMaterial MATERIALS[MATERIAL_COUNT];

/* Their names in that order, NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const MATERIAL_NAMES[MATERIAL_COUNT + 1];

/* NULL where there is none of that name. */
const Material *material_find(const char *name);

/* The shininess with which Blinn-Phong's highlight is most like Phong's with this one (more than
 * 0), where light and viewer lie opposite each other: the least squared difference over all normals
 * in their plane. About 4 times as large. */
double material_fitted_shininess(double phong);

#endif
