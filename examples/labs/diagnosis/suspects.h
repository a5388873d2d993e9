/*
 * suspects: which of many wrong programs draw the same as a submission.
 */
#ifndef SUSPECTS_H
#define SUSPECTS_H

#include "labs/diagnosis/wrong_program.h"
#include "labs/submission/lab_pictures.h"

/* What leaves less than this share of how far the submission is from right draws the same. */
#define LINEUP_EXACT 0.003

typedef struct Lineup {
    const LabPictures *pictures;
    const Painter *painter; /* the submission */
    Canvas *canvas;
    Canvas sheet; /* for many small pictures */
    WrongProgram wrong;
    int order[LAB_PICTURES_MAX]; /* scenes by the submission's error, the worst first */
    bool moved;                  /* its outline is wrong */
    bool soft;                   /* smoothed edges are as right */
    Image image, drawn;          /* of the canvas's last size */
    Image right[LAB_PICTURES_MAX];
    Choices right_choices;
    double wrong_by; /* squares of the submission's differences from right, over all scenes */
    LabSceneBuffers buffers[LAB_PICTURES_MAX];
    Mesh coarse; /* lab 10: for small pictures */
} Lineup;

/* Compiles and uploads. `moved`: the submission's outline is wrong. False, with a message: the
 * driver failed; close the lineup in any case. */
bool lineup_open(Lineup *lineup, const LabPictures *pictures, const Painter *painter, bool moved,
                 Canvas *canvas, Message *message);
void lineup_close(Lineup *lineup);

/* Keeps the suspects whose small pictures of the two worst scenes are like the submission's, in
 * their order, and sets *count. Tolerant: only rounding can drop a match. */
bool lineup_screen(Lineup *lineup, Suspect *suspects, int *count, Message *message);

/* Keeps the suspects that match in all scenes, and are far nearer to the submission than either is
 * to the right pictures. *near: another one nearly does. */
bool lineup_verify(Lineup *lineup, Suspect *suspects, int *count, bool *near, Message *message);

/* Draws submission and suspects in a further scene, and keeps those that match. */
bool lineup_confront(Lineup *lineup, const LabScene *lab_scene, Suspect *suspects, int *count,
                     Message *message);

/* Keeps those that explain what is wrong, and of them those that are about as near as the nearest.
 */
void lineup_nearest(const Lineup *lineup, Suspect *suspects, int *count);

/* Sets a number's value to that with which it is nearest to the submission in the worst scenes.
 * False if it could as well be another. */
bool lineup_fit(Lineup *lineup, Suspect *suspect);

#endif
