/*
 * cheapest_search: the search for the cheapest quality, without the cache of what was chosen; see
 * cheapest_quality.h.
 */
#ifndef CHEAPEST_SEARCH_H
#define CHEAPEST_SEARCH_H

#include "core/canvas.h"
#include "lighting/lighting.h"
#include "scene/quality.h"

typedef struct CheapestQualityTask {
    const Canvas *canvas; /* candidates are drawn into it */
    int place[4];         /* and read from this part: x, y, width, height */
    Lighting *lighting;
    bool full; /* see lighting_draw */
    SolidMeshes *meshes;
    double error; /* allowed, in steps of 1/255 */
    /* What stays as the scene says: bits of 1 << AXIS_INTERPOLATION, _DIVISIONS, _NORMALS, _VIEWER,
     * _LIGHTS. */
    unsigned kept;
    /* The scene at moment `number`, valid until the next call; it passes scene_check and has the
     * same objects and lights at all of them. */
    int moments;
    bool (*scene)(void *data, int number, Scene *scene, Message *message);
    void *data;
    /* There are more moments between these: a third of the error is kept in reserve, or twice
     * what the error at every second moment differs from that at the others. */
    bool moving;
} CheapestQualityTask;

/* Pixels that do not count and are off by more than is allowed. */
typedef struct LeftOut {
    long long pixels;
    double largest; /* error of theirs; 0 without pixels */
} LeftOut;

/* Inside objects, where an edge of a shadow lies elsewhere than in the exact picture; and at
 * outlines. */
enum { LEFT_OUT_SHADOWS, LEFT_OUT_OUTLINES, LEFT_OUT_COUNT };

typedef struct CheapestQuality {
    ObjectQuality *objects;
    int count, moments;
    long long inside; /* pixels inside objects, of all moments */
    LeftOut left_out[LEFT_OUT_COUNT], plain_left_out[LEFT_OUT_COUNT];
    double error, plain_error; /* over all moments */
    double cost, plain_cost;   /* expected, see quality_parts_cost */
    double margin;             /* the reserve for the moments between */
    bool cached;
} CheapestQuality;

/* Fills in a choice for a scene of `cheapest->count` objects, for each of which it has room. */
bool cheapest_search(CheapestQuality *cheapest, const CheapestQualityTask *task, Message *message);

/* The ways to draw an object among which the cheapest is looked for: finenesses of its mesh, and
 * simplifications of its lighting. `kept`: see CheapestQualityTask. */

/* Divisions of a turn, or a side, from coarse to fine; how many of them can be drawn of an object.
 */
extern const int CANDIDATE_LEVELS[];
int candidate_level_count(unsigned kept, const Object *object);

/* The number of simplifications there may be in a scene: the viewer, the normals, and three of each
 * light. */
int candidate_relaxation_count(const Scene *scene);

/* Adds one of them. False: there is no such one for this quality. */
bool candidate_relax(unsigned kept, const Scene *scene, int which, ObjectQuality *quality);

/* Takes the next finer level; with `plain` also back what was simplified. False: there is none. */
bool candidate_refine(unsigned kept, const Object *object, const ObjectQuality *plain,
                      ObjectQuality *quality);

bool candidate_is_kept(unsigned kept, QualityAxis axis);

#endif
