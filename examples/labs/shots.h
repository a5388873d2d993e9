/*
 * shots: the scenes of a check, each with its exact pictures and with what a submission drew.
 */
#ifndef SHOTS_H
#define SHOTS_H

#include "compare.h"
#include "submission.h"

/* Up to two pictures are right: light at the vertices or at the fragments where a lab leaves that
 * open, the fitted exponent or four times Phong's in lab 7. */
enum { SHOT_MOST_TRUTHS = 2 };

typedef struct Shot {
    Probe probe;
    Image image; /* what the submission drew */
    Reference truths[SHOT_MOST_TRUTHS];
    Reference mask; /* of lab 10: the mesh of the submission's fineness */
} Shot;

enum { SHOTS_MOST = 2 * PROBE_KIND_COUNT };

typedef struct Shots {
    const Lab *lab;
    Shot shots[SHOTS_MOST];
    int count;
    int truth_count;
    int truth; /* the one that the submission is nearer to, of all scenes together */
    SubmissionGeometry geometry;
    Mat4 world_from_object[SHOTS_MOST], normal_matrix[SHOTS_MOST]; /* of lab 3 */
    Mesh mesh;                                                     /* of lab 10 */
} Shots;

/* Makes the scenes and their exact pictures; nothing is drawn yet. Zeroed on failure. */
bool shots_open(Shots *shots, const Lab *lab, uint64_t seed, Message *message);

/* Draws all of them with a submission's program. The canvas gets their sizes. */
bool shots_draw(Shots *shots, const Painter *painter, Canvas *canvas, Message *message);

/* Adds the scenes that are 300 times as large, known and of the seed, drawn with this program. What
 * is off by less than 16 bits explain counts as right. */
bool shots_draw_huge(Shots *shots, uint64_t seed, const Painter *painter, Canvas *canvas,
                     Message *message);

/* Lab 10: the sphere that is drawn. Pixels beside its outline, or that of the exact one, do not
 * count. */
bool shots_use_sphere(Shots *shots, int slices, int stacks, Message *message);

/* What stands in the place of what scene i has. */
SubmissionGeometry shots_geometry(const Shots *shots, int i);

/* The scene of a truth: a copy of the probe's, whose objects are in `objects`. */
Scene shots_truth_scene(const Lab *lab, const Probe *probe, int truth,
                        Object objects[PROBE_MOST_OBJECTS]);

/* How many steps scene i may be off: in lab 10 the one that its task allows, in the scenes of
 * shots_draw_huge more than 11 significant bits are ever off there. */
double shots_tolerance(const Shots *shots, int i);

/* How far scene i is off from a truth. */
ErrorSum shots_error(const Shots *shots, int i, int truth);

void shots_close(Shots *shots);

#endif
