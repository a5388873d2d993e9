/*
 * search: hunts for the scene whose picture is farthest from the exact one.
 *
 * From a random scene, numbers are changed, a few at a time: by factors, to special values, to
 * exact coincidences of lights, eye and corners; what makes the error larger is kept. Where nothing
 * does for long, another scene is begun with.
 */
#ifndef SEARCH_H
#define SEARCH_H

#include "random_scene.h"

typedef struct Search {
    Hard hard;
    HardPrecision precision;
    bool tame; /* numbers stay where a scene of a few units' size has them */
    RandomMeshes meshes;
    HardRandom random;
    RandomScene current; /* the climb under way */
    double error;        /* its error */
    int stale;           /* steps since that grew */
    long long steps, judged, climbs;
} Search;

/* Opens a canvas of this size. */
void search_open(Search *search, int size, unsigned long long seed);
void search_close(Search *search);

/* The largest error inside the objects of a float picture, in steps of 1/255, beyond twice what
 * changes of the scene's numbers in the 7th digit do to the exact picture; INFINITY where a value
 * is not finite. Where it cannot be more than `enough`, without that allowance. -1 where a scene is
 * not judged: it has no meaning, shows nothing, or wants more digits of depth than there are. */
double search_error(Search *search, RandomScene *scene, double enough);

/* One change, kept if the error grows. True where nothing has helped for long: search->current is
 * then as bad as this climb gets, and the next step begins another. */
bool search_step(Search *search);

/* Makes a scene simpler, while its error stays at least `least`: fewer lights, objects, colours;
 * rounder numbers. */
void search_shrink(Search *search, RandomScene *scene, double least);

#endif
