/*
 * proof: by how much a driver's arithmetic can change what a scene's shaders give, over pieces of
 * its triangles.
 */
#ifndef PROOF_H
#define PROOF_H

#include "glsl/glsl_bound.h"
#include "probe/capture.h"
#include "scene/parameter.h"
#include "study/arithmetic/arithmetic.h"

/* What is measured of the driver; `height`: of the picture, in pixels; 0: as it was drawn. */
typedef struct ProofDriver {
    const Arithmetic *vertex, *fragment; /* of the precision that the fragment shader declares */
    const Raster *raster;
    int height;
} ProofDriver;

/* A range of cameras, as --orbit moves the scene's: degrees to the right and up, and a factor of
 * the distance. */
typedef struct ProofCameras {
    double low[3], high[3];
} ProofCameras;

/* A scene as it is drawn in the current context, into what is bound there. */
typedef struct Proof {
    ProofDriver driver;
    Capture capture;
    bool moves; /* the camera */
    ProofCameras cameras;
    struct ProofDraw *draws; /* of the capture, the first so many */
    int draw_count;
} Proof;

/* `shadows`: with them; `cameras`: NULL: the scene's. False: a shader cannot be run, and why. */
bool proof_open(Proof *proof, const Scene *scene, const ProofDriver *driver, bool shadows,
                const ProofCameras *cameras, Message *message);
void proof_close(Proof *proof);

/* Of what is in `proof->capture` already. False: closed, too. */
bool proof_of_capture(Proof *proof, Message *message);

/* A triangle of a draw that is not culled, or from some of the cameras is not. */
typedef struct ProofTriangle {
    int draw, number;
    unsigned corners[3];
} ProofTriangle;

/* The next after *triangle, which begins with {.draw = 0, .number = -1}; false: there is none. */
bool proof_next(const Proof *proof, ProofTriangle *triangle);

/* Of a piece of a triangle, from some cameras: the shares of its second and third corner, and the
 * camera's azimuth, elevation (radians) and distance, are these or up to half so much less or more.
 */
typedef struct ProofBox {
    double center[GLSL_WAYS], half[GLSL_WAYS];
} ProofBox;

typedef struct ProofBound {
    double steps; /* the largest error of a channel, clamped, before it is rounded to a byte */
    bool bounded; /* without the clamp, too */
    int node;     /* of the fragment shader, in the line that makes most of it; 0: what it gets */
    double share; /* what that makes, in steps */
    int widest;   /* the direction in which most changes */
} ProofBound;
ProofBound proof_piece(const Proof *proof, const ProofTriangle *triangle, const ProofBox *box);

/* What each channel of the driver's colour can be there, before it is clamped. False: anything,
 * because an edge of light runs through the pixel, or no bound exists. */
bool proof_color(const Proof *proof, const ProofTriangle *triangle, const ProofBox *box,
                 GlslRange channels[3]);

/* "line 21: pow(base, exponent)". */
void proof_text(const Proof *proof, int draw, const ProofBound *bound, char *text, size_t size);

bool proof_is_drawn(const Proof *proof, int draw);

/* Clip coordinates, and a point's size; of draws of points and lines, too. */
enum { PROOF_PLACE = 5 };
void proof_vertex(const Proof *proof, int draw, unsigned vertex, double place[PROOF_PLACE]);

/* Of all points of a draw. */
typedef struct ProvedDraw {
    ProofBound bound;
    int draw, triangle; /* where it is largest */
    double camera[3];   /* from where, as in ProofCameras */
    double found;       /* the largest bound at single points: that of all is not less */
    int triangles, pieces;
    char text[64]; /* as proof_text */
} ProvedDraw;

/* Of each object of a scene. */
typedef struct Proved {
    ProvedDraw draws[16];
    int count;
} Proved;
bool prove_scene(const Scene *scene, const ProofDriver *driver, const ProofCameras *cameras,
                 int pieces, Proved *proved, Message *message);

extern const ParameterCodec PROOF_CAMERAS; /* of ProofCameras */

/* Measures the driver, and prints a line for each object of a scene of the study, in highp and in
 * mediump, and what is assumed. `cameras`: NULL: the scene's. */
bool prove_study(int scene, const ProofCameras *cameras, const CanvasBackend *backend, int height,
                 FILE *file, Message *message);

#endif
