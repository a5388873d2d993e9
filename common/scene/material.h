/*
 * material: how a surface reflects light.
 */
#ifndef MATERIAL_H
#define MATERIAL_H

#include "core/matrix.h"

/* Reflectivities for red, green and blue, 0 to 1. (OpenGL 1.1 specification, section 2.13.1, table
 * 2.7) */
typedef struct Material {
    Vec3 ambient, diffuse, specular;
    Vec3 emission;    /* independent of all lights */
    double alpha;     /* opacity: 1 is opaque; a zeroed material is transparent */
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

/* The initializer of one of them: lecture pages start with it. */
enum { MATERIAL_GOLD_INDEX = 10 };
#define MATERIAL_GOLD MATERIAL_OF(MATERIAL_GOLD_NUMBERS)
#define MATERIAL_GOLD_NUMBERS                                                                      \
    0.24725, 0.1995, 0.0745, 0.75164, 0.60648, 0.22648, 0.628281, 0.555802, 0.366065, 0.4

/* An opaque material from these numbers as the list has them. */
#define MATERIAL_OF(...) MATERIAL_OF_(__VA_ARGS__)
#define MATERIAL_OF_(ar, ag, ab, dr, dg, db, sr, sg, sb, share)                                    \
    {                                                                                              \
        {ar, ag, ab}, {dr, dg, db}, {sr, sg, sb}, {0, 0, 0}, 1, 128 * share                        \
    }

/* Names in that order, then "none", NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const MATERIAL_NAMES[MATERIAL_COUNT + 2];

/* NULL if there is none. */
const Material *material_find(const char *name);

/* The Blinn-Phong shininess whose highlight is closest to Phong's with this shininess (more than 0)
 * for grazing light opposite the viewer: least squares over the normals in their plane. About 4
 * times as large. */
double material_fitted_shininess(double phong);

#endif
