/*
 * hard_cases_list: the catalogue of what goes wrong: scenes, and how the plain formula draws them.
 */
#ifndef HARD_CASES_LIST_H
#define HARD_CASES_LIST_H

#include "lighting.h"

/* A scene, and that of the plain formula. Points into itself: not to be copied. */
typedef struct HardScene {
    Scene scene, naive;
    Light lights[2];
    Object objects[2], naive_objects[2]; /* the latter are copies, but for `spoil` */
    Mesh mesh, naive_mesh;               /* the latter as the former, or of its own */
} HardScene;

typedef struct HardCase {
    const char *name;           /* "mirror" */
    const char *what;           /* in one line of at most 62 characters */
    const char *naive, *stable; /* what is drawn, in at most 24 characters */
    bool (*make)(HardScene *made, Message *message);
    /* How the plain formula differs, each NULL where it does not: */
    void (*spoil)(HardScene *made);
    ShaderReplacement replaced[3]; /* ended by a NULL name. Times are those with the first alone:
                                      the second lets its result be seen */
    const char *precision;
    LightingNormalMatrix *normal_matrix;
    const LightingTransforms *(*transforms)(void);
    int width, height; /* of the picture, enlarged then; 0: as asked for */
} HardCase;

enum { HARD_CASE_COUNT = 20 };
extern const HardCase HARD_CASES[HARD_CASE_COUNT];

/* Their names and "all", NULL-terminated, for a PARAMETER_CHOICE. */
extern const char *const HARD_CASE_NAMES[HARD_CASE_COUNT + 2];

/* Makes a case's scenes; hard_scene_close may be called in any case. */
bool hard_scene_open(HardScene *made, const HardCase *hard_case, Message *message);
void hard_scene_close(HardScene *made);

#endif
