/*
 * search: hunts for the scene whose picture is farthest from the exact one.
 *
 * Starting at a random scene, it changes a few numbers at a time: by factors, to special values, to
 * exact coincidences of lights, eye and corners. A change that increases the error is kept. If none
 * helps for long, it starts again with another scene.
 */
#ifndef SEARCH_H
#define SEARCH_H

#include "hard/random_scene.h"

typedef struct Search {
    HardPrecision precision;
    bool tame; /* numbers stay in the range of a scene of a few units */
    RandomMeshes meshes;
    Random random;
    RandomScene current; /* the current climb */
    double error;        /* its error */
    int stale;           /* steps since it last increased */
    long long steps, judged, climbs;
} Search;

/* Opens a canvas of this size. */
void search_open(Search *search, int size, unsigned long long seed);
void search_close(Search *search);

/* The largest error inside the objects of a float picture, in steps of 1/255, beyond twice the
 * effect of changing the scene's numbers in the 7th digit; INFINITY if a value is not finite. If
 * the error cannot be more than `enough`, without that allowance. -1 if a scene is not judged: it
 * is invalid, shows nothing, or needs more bits of depth than there are. */
double search_error(Search *search, RandomScene *scene, double enough);

/* Makes one change, and keeps it if the error grows. True if nothing has helped for long:
 * search->current is then the end of this climb, and the next step starts another. */
bool search_step(Search *search);

/* Simplifies a scene while its error stays at least `least`: fewer lights, objects, colors; rounder
 * numbers. */
void search_shrink(Search *search, RandomScene *scene, double min);

#endif
