/*
 * reference: the exact picture of a scene, in double precision, on the CPU. No GL, and nothing of
 * what `lighting` and the shaders compute with.
 *
 * A ray through each pixel's centre meets the scene's shapes: a solid by its formula, with the
 * normals of the formula; anything else by its triangles, with normals interpolated between their
 * corners. There the model's equation is evaluated (OpenGL 1.1 specification, section 2.13.1, and
 * Phong's reflection). Where an edge runs through a pixel, of an object, of one of its faces or of
 * light, the pixel is its mean over a square of one pixel, by squares that are divided where they
 * differ: see reference_pixel.h, which also says what may be overlooked.
 *
 * At a point, rounding makes less than 1e-9 of a step of 1/255 (tests/reference_quad_test.c). Two
 * shapes are triangles all the same:
 *   a teapot is its mesh of 64 divisions, 262,000 triangles; of one that is 250 pixels wide, with a
 *     highlight of shininess 40, 1 interior pixel in 600 is more than half a step from the mesh of
 *     256 divisions, the worst 0.9, and the outline moves by 2 pixels' area in all;
 *   a solid whose world_from_object is singular is the mesh as given.
 */
#ifndef REFERENCE_H
#define REFERENCE_H

#include "scene.h"
#include "stop.h"

typedef struct ReferenceOptions {
    int width, height; /* 1 and more */
    /* The exact picture of the meshes as given, in the place of that of the solids: what a perfect
     * driver would draw. As the scene's interpolation says: normals between the corners and light
     * at every point; or light at the corners, with their normals or with the triangle's, and
     * colours between them. */
    bool meshes;
    /* What an edge may add to a pixel's colour and 255 times its coverage, in steps of 1/255: 0 to
     * 255, 0 for 0.5. Kept down to 0.1; the worst found where 0.5 was asked for is 0.19. */
    double edge_error;
    int threads;             /* 0: as many as there are cores. The picture does not depend on it */
    const atomic_bool *stop; /* NULL, or what another thread makes true to have no picture */
} ReferenceOptions;

/* Row 0 at the top. A pixel's object, depth and face are those at its centre. */
typedef struct Reference {
    int width, height;
    float *color;    /* 3 for each pixel: red, green, blue as the framebuffer would hold them
                        without rounding: clamped to 0..1, encoded as sRGB where the scene
                        says so */
    double *depth;   /* the distance from the eye along the view (-z in eye coordinates);
                        INFINITY where there is no object */
    int *object;     /* its number in the scene; -1 for the background */
    float *coverage; /* the share of the pixel that this object (or background) has, 0..1 */
    unsigned char *interior; /* 1 where no edge runs through the pixel: one surface, smoothly lit;
                                0 for the background */
} Reference;

/* Draws a scene that has passed scene_check. False, with a message and a zeroed reference, where
 * memory cannot be had, an option is out of its range, or it was stopped. Where threads cannot be
 * had fewer do. Stopped, it returns after some 10 ms of computing, more where a mesh has
 * millions of triangles. */
bool reference_open(Reference *reference, const Scene *scene, const ReferenceOptions *options,
                    Message *message);

/* NULL or a zeroed reference is fine. */
void reference_close(Reference *reference);

#endif
