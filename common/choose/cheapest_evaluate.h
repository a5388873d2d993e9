/*
 * cheapest_evaluate: what the search for the cheapest quality knows, and its two questions of a
 * candidate: how far off it is, as drawn, and what it is expected to cost.
 */
#ifndef CHEAPEST_EVALUATE_H
#define CHEAPEST_EVALUATE_H

#include "choose/cheapest_task.h"

/* What is known of an object. */
typedef struct Found {
    double fragments; /* at the first moment */
    double error;     /* of what was drawn last, over all moments */
    bool has_kept;
    ObjectQuality kept, best; /* the cheapest within the error; the most exact */
    double kept_cost, best_error, best_cost;
} Found;

typedef struct Search {
    const CheapestQualityTask *task;
    Scene scene;   /* at the first moment */
    Exact *exacts; /* by moment */
    Image image;
    LightingPlan plan; /* of a candidate, to know its cost */
    int count;         /* of objects */
    double allowed;
    ObjectQuality *current; /* what is drawn, by object */
    Found *found;           /* by object */
    /* Pixels that are off by more than is allowed because other lights reach them, and that is fine
     * for so many. */
    size_t moved, most_moved;
    double every_second[2]; /* the largest error of all objects at even and odd moments */
    double difference;      /* of these for the last choice */
    Progress progress;
    int drawn; /* candidates */
} Search;

/* Draws `current` at all moments. The errors of objects that are nowhere inside stay 0. `left_out`:
 * NULL, or what does not count is added to it. */
bool search_evaluate(Search *search, LeftOut *left_out, Message *message);

/* The expected cost of one object. */
double search_cost(Search *search, int object, const ObjectQuality *quality);

#endif
