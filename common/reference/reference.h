/*
 * reference: the exact picture of a scene: ray casting in double precision on the CPU. No GL;
 * shares no code with `lighting` and the shaders.
 *
 * A ray through each pixel's center is intersected with the shapes: solids by formula, with exact
 * normals, anything else by triangles with interpolated normals. The lighting equation is evaluated
 * there (OpenGL 1.1 specification, section 2.13.1, and Phong's reflection). A pixel crossed by an
 * edge, of an object, a face or light, is the mean over its area, by adaptive subdivision: see
 * reference_pixel.h, also for what that may miss.
 *
 * A light that casts shadows is followed from each such point: see reference_shadow.h. Edges of
 * shadows are edges. On triangles the segment begins on the triangle and the lighting has the
 * interpolated normal: with `meshes`, a triangle that faces away from the light is in its own
 * shadow even where N.L > 0, as it is for stencil volumes, except on a convex object
 * (object_is_convex), which has no shadow on itself. Without `meshes`, solids have no triangles and
 * so no such terminator. Where light is computed at the corners, shadows are still those of each
 * point.
 *
 * Rounding adds less than 1e-9 steps of 1/255 (tests/reference/reference_quad_test.c). Two shapes
 * are triangles: a solid with a singular world_from_object is its mesh as given, and a teapot is
 * its mesh of 64 divisions, 262,000 triangles, whose segments to lights begin on the smooth surface
 * that its normals suggest. At 250 pixels and shininess 40 one of 600 interior
 * pixels of the teapot differs by more than half a step from 256 divisions, at most 0.9, and its
 * outline by 2 pixels' area in all.
 */
#ifndef REFERENCE_H
#define REFERENCE_H

#include "base/image.h"
#include "base/progress.h"
#include "base/stop.h"
#include "scene/scene.h"

enum { REFERENCE_TEAPOT_DIVISIONS = 64 }; /* of a patch */

typedef struct ReferenceOptions {
    int width, height; /* 1 and more */
    /* The meshes as given instead of the solids: what a perfect driver would draw, with the scene's
     * interpolation. */
    bool meshes;
    /* Colors at the centers of pixels, as without antialiasing, instead of the means over their
     * areas. Coverage and interior are the same. */
    bool centers;
    /* The largest error at edges of a pixel's color and of 255 times its coverage, in steps of
     * 1/255: 0.1 to 255; 0 means 0.5. The worst measured for 0.5 is 0.19. */
    double edge_error;
    int threads;             /* 0: one per core. The picture does not depend on it */
    const atomic_bool *stop; /* NULL, or set by another thread to cancel */
    Progress *progress;      /* NULL, or shows how much is done */
} ReferenceOptions;

/* Row 0 at the top. Object and depth are those at the pixel's center. */
typedef struct Reference {
    int width, height;
    float *color;    /* red, green, blue as in a framebuffer without rounding: clamped to 0..1,
                        encoded as sRGB if the scene is linear */
    double *depth;   /* -z in eye coordinates; INFINITY for the background */
    int *object;     /* index in the scene; -1 for the background */
    float *coverage; /* the fraction of the pixel that this object (or background) covers */
    unsigned char *interior; /* 1 if no edge runs through the pixel: one surface, smoothly lit; 0
                                for the background */
    /* Of each light that casts shadows two bits (beyond 16 lights some share theirs): whether in a
     * part of the pixel a shadow keeps it off, and whether it reaches one; of the object at the
     * center. NULL: no light casts any. */
    uint32_t *lights;
} Reference;

/* Whether a light that reaches a pixel in one picture is kept from a part of it in the other; of
 * Reference.lights. */
static inline bool reference_lights_differ(uint32_t a, uint32_t b)
{
    const uint32_t hidden = 0x55555555;
    return ((a & b >> 1) | (b & a >> 1)) & hidden;
}

/* Draws a scene that has passed scene_check. False, with a zeroed reference, if memory runs out, an
 * option is out of range, or it was stopped. Once stopped it returns within some 10 ms, more if a
 * mesh has millions of triangles. */
bool reference_open(Reference *reference, const Scene *scene, const ReferenceOptions *options,
                    Message *message);

/* The picture as bytes. */
bool reference_image(const Reference *exact, Image *image, Message *message);

/* NULL or a zeroed reference is fine. */
void reference_close(Reference *reference);

#endif
