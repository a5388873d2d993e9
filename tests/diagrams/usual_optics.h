/*
 * usual_optics: a light, a surface and an eye, for tests.
 */
#ifndef USUAL_OPTICS_H
#define USUAL_OPTICS_H

#include "diagrams/optics.h"
#include "support/testing.h"

/* Of sums and products of a few numbers near 1 in double precision. */
#define ROUNDING 1e-12

static inline Optics usual(double light, double eye, double shininess, Reflection reflection)
{
    return (Optics){.light = light,
                    .eye = eye,
                    .shininess = shininess,
                    .reflection = reflection,
                    .material = material_find("jade"),
                    .ambient = 0.2,
                    .distance = 0.75,
                    .constant = 1,
                    .linear = 0.2,
                    .quadratic = 0.2,
                    .sides = 4};
}

static inline void assert_near(double a, double b)
{
    if (!(fabs(a - b) <= ROUNDING))
        fail_msg("%.17g is not %.17g", a, b);
}

static inline double cosine(double degrees)
{
    return cos(degrees * PI / 180);
}

#endif
