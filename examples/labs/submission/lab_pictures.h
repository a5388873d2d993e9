/*
 * lab_pictures: the scenes of a check, each with its exact pictures and the submission's.
 */
#ifndef LAB_PICTURES_H
#define LAB_PICTURES_H

#include "labs/submission/submission.h"
#include "reference/picture_error.h"
#include "reference/reference.h"

/* A drawn picture against the exact one, and against another drawn one. No GL. Errors are as in
 * reference/picture_error.h. */

/* The largest error of a correct picture. Rounding to bytes adds 0.5, 32-bit arithmetic far less;
 * two ways to write the same formula differ by at most 1, and Blinn-Phong with the fitted exponent
 * and with four times Phong's by 1.9 (see scene.c). Mistakes that show cause at least 4. */
#define COMPARE_TOLERANCE 2.5

/* Over the pixels inside an object and over background pixels without an object next to them.
 * `mask`: the exact picture of the meshes as drawn; NULL if they are the shapes. Pixels where the
 * two have different outlines do not count, unless they are more than two pixels inside the exact
 * one. Of an image an odd number of times as large the middle pixels of squares are compared. */
ErrorSum compare_exact(const Image *image, const Reference *exact, const Reference *mask);

/* Makes what a solution drew, as large or larger, the exact picture; no edge is interior. */
void compare_take(Reference *exact, const Image *image);

/* Two pictures may be right: light at the vertices or at the fragments, or in lab 7 the fitted
 * exponent or four times Phong's; or what each solution draws. */
enum { LAB_PICTURE_MAX_TRUTHS = LAB_MAX_SOLUTIONS };

typedef struct LabPicture {
    LabScene lab_scene;
    Image image; /* what the submission drew */
    Reference truths[LAB_PICTURE_MAX_TRUTHS];
    Reference mask; /* lab 10: drawn with the submission's mesh */
} LabPicture;

enum { LAB_PICTURES_MAX = 2 * LAB_SCENE_KIND_COUNT };

typedef struct LabPictures {
    const Lab *lab;
    LabPicture items[LAB_PICTURES_MAX];
    int count;
    int truth_count;
    int truth; /* the one nearest to the submission, over all scenes */
    bool own;  /* drawn in the files' own precision: errors that 16 bits explain are right */
    SubmissionGeometry geometry;
    Mat4 world_from_object[LAB_PICTURES_MAX], normal_matrix[LAB_PICTURES_MAX]; /* lab 3 */
    Mesh mesh;                                                                 /* lab 10 */
    const Painter *solutions; /* as many as truths; NULL: the exact pictures are right */
} LabPictures;

/* Makes the scenes and their exact pictures. Zeroed on failure. */
bool lab_pictures_open(LabPictures *pictures, const Lab *lab, uint64_t seed, Message *message);

/* What these draw, one for each of the lab's solutions, is right. They must outlive the pictures.
 */
bool lab_pictures_use_solutions(LabPictures *pictures, const Painter *solutions, Canvas *canvas,
                                Message *message);

/* Draws all scenes with a submission's program, resizing the canvas. */
bool lab_pictures_draw(LabPictures *pictures, const Painter *painter, Canvas *canvas,
                       Message *message);

/* Adds the known and the seed's scene that are 300 times as large, drawn with this program. Errors
 * that 16 bits explain count as right. */
bool lab_pictures_draw_huge(LabPictures *pictures, uint64_t seed, const Painter *painter,
                            Canvas *canvas, Message *message);

/* Whether the picture is right at a size and an offset drawn by the seed and, in lab 10, at the
 * size whose operations are counted. Not for lab 3, whose shaders are given. */
bool lab_pictures_check_sizes(const LabPictures *pictures, uint64_t seed, const Painter *painter,
                              Canvas *canvas, bool *right, Message *message);

/* Lab 10: sets the sphere. Pixels at its outline or at that of the exact sphere do not count. */
bool lab_pictures_use_sphere(LabPictures *pictures, int slices, int stacks, Message *message);

/* Lab 11: pixels near an edge of a shadow, or of an object, are no longer interior: a map has
 * texels, and a bias moves its shadows. */
void lab_pictures_leave_out_edges(Reference *exact);

/* What replaces scene i's own geometry. */
SubmissionGeometry lab_pictures_geometry(const LabPictures *pictures, int i);

/* The scene of a truth: a copy of the scene's, with its objects in `objects`. */
Scene lab_pictures_truth_scene(const Lab *lab, const LabScene *lab_scene, int truth,
                               Object objects[LAB_SCENE_MAX_OBJECTS]);

/* The error that scene i may have: in lab 10 one step and a quarter; in the scenes of
 * lab_pictures_draw_huge more than 11 significant bits can make. */
double lab_pictures_tolerance(const LabPictures *pictures, int i);

/* Whether another program would be right in all scenes. What is drawn there stays. */
bool lab_pictures_is_right(const LabPictures *pictures, const Painter *painter, Canvas *canvas,
                           bool *right, Message *message);

/* A scene's error against a truth. */
ErrorSum lab_picture_error(const LabPicture *picture, int truth);

void lab_pictures_close(LabPictures *pictures);

#endif
