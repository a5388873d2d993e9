/*
 * shots: the scenes of a check, each with its exact pictures and the submission's.
 */
#ifndef SHOTS_H
#define SHOTS_H

#include "labs/submission/compare.h"
#include "labs/submission/submission.h"

/* Two pictures may be right: light at the vertices or at the fragments, or in lab 7 the fitted
 * exponent or four times Phong's. */
enum { SHOT_MAX_TRUTHS = 2 };

typedef struct Shot {
    Probe probe;
    Image image; /* what the submission drew */
    Reference truths[SHOT_MAX_TRUTHS];
    Reference mask; /* lab 10: drawn with the submission's mesh */
} Shot;

enum { SHOTS_MAX = 2 * PROBE_KIND_COUNT };

typedef struct Shots {
    const Lab *lab;
    Shot shots[SHOTS_MAX];
    int count;
    int truth_count;
    int truth; /* the one nearest to the submission, over all scenes */
    bool own;  /* the pictures are those of shots_draw_own */
    SubmissionGeometry geometry;
    Mat4 world_from_object[SHOTS_MAX], normal_matrix[SHOTS_MAX]; /* lab 3 */
    Mesh mesh;                                                   /* lab 10 */
} Shots;

/* Makes the scenes and their exact pictures. Zeroed on failure. */
bool shots_open(Shots *shots, const Lab *lab, uint64_t seed, Message *message);

/* Draws all scenes with a submission's program, resizing the canvas. */
bool shots_draw(Shots *shots, const Painter *painter, Canvas *canvas, Message *message);

/* Adds the known and the seed's scene that are 300 times as large, drawn with this program. Errors
 * that 16 bits explain count as right. */
bool shots_draw_huge(Shots *shots, uint64_t seed, const Painter *painter, Canvas *canvas,
                     Message *message);

/* Draws all scenes again with this program, of the files' own precision. Errors that 16 bits
 * explain count as right. */
bool shots_draw_own(Shots *shots, const Painter *painter, Canvas *canvas, Message *message);

/* Whether the picture is right at a size and an offset drawn by the seed and, in lab 10, at the
 * size whose operations are counted. Not for lab 3, whose shaders are given. */
bool shots_check_sizes(const Shots *shots, uint64_t seed, const Painter *painter, Canvas *canvas,
                       bool *right, Message *message);

/* Lab 10: sets the sphere. Pixels at its outline or at that of the exact sphere do not count. */
bool shots_use_sphere(Shots *shots, int slices, int stacks, Message *message);

/* Lab 11: pixels near an edge of a shadow, or of an object, are no longer interior: a map has
 * texels, and a bias moves its shadows. */
bool shots_leave_out_edges(Reference *exact, Message *message);

/* What replaces scene i's own geometry. */
SubmissionGeometry shots_geometry(const Shots *shots, int i);

/* The scene of a truth: a copy of the probe's, with its objects in `objects`. */
Scene shots_truth_scene(const Lab *lab, const Probe *probe, int truth,
                        Object objects[PROBE_MAX_OBJECTS]);

/* The error that scene i may have: in lab 10 one step and a quarter; in the scenes of
 * shots_draw_huge more than 11 significant bits can make. */
double shots_tolerance(const Shots *shots, int i);

/* Scene i's error against a truth. */
ErrorSum shots_error(const Shots *shots, int i, int truth);

void shots_close(Shots *shots);

#endif
