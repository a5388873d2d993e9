/*
 * suspects: which of many wrong programs draw what a submission draws.
 */
#ifndef SUSPECTS_H
#define SUSPECTS_H

#include "shots.h"
#include "wrong_program.h"

typedef struct Lineup {
    const Shots *shots;
    const Painter *painter; /* the submission */
    Canvas *canvas;
    Canvas sheet; /* many small pictures */
    WrongProgram wrong;
    int order[SHOTS_MOST]; /* scenes by how far the submission is off, the worst first */
    bool moved;            /* whether its outline is not the right one */
    Image image, drawn;    /* of the canvas's last size */
    ProbeBuffers buffers[SHOTS_MOST];
    Mesh coarse; /* lab 10: what small pictures are drawn with */
} Lineup;

/* Compiles, uploads, and looks at the submission's outline. False, with a message, where the driver
 * fails; close it all the same. */
bool lineup_open(Lineup *lineup, const Shots *shots, const Painter *painter, Canvas *canvas,
                 Message *message);
void lineup_close(Lineup *lineup);

/* Keeps those suspects whose small pictures of the two worst scenes are like the submission's, in
 * their order, and sets *count. None that should stay is dropped but by chance of rounding. */
bool lineup_screen(Lineup *lineup, Suspect *suspects, int *count, Message *message);

/* Keeps those that match in all scenes. `near`: whether another one nearly does. */
bool lineup_verify(Lineup *lineup, Suspect *suspects, int *count, bool *near, Message *message);

/* Draws the submission and the suspects in a further scene, and keeps those that match. */
bool lineup_confront(Lineup *lineup, const Probe *probe, Suspect *suspects, int *count,
                     Message *message);

#endif
