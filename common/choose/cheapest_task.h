/*
 * cheapest_task: what is looked for and among what: the task of cheapest_quality.h, its result, the
 * candidates, and the exact pictures that they are compared with.
 */
#ifndef CHEAPEST_TASK_H
#define CHEAPEST_TASK_H

#include "base/cache.h"
#include "base/progress.h"
#include "core/canvas.h"
#include "lighting/lighting.h"
#include "scene/quality.h"
#include "scene/scene.h"

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

/* Exact pictures of moments of a scene, as much as the search for the cheapest quality needs,
 * kept in base/cache. */

typedef struct Exact {
    uint16_t *colors; /* 65535 is 1 */
    int16_t *owner;   /* the object whose inside the pixel is; -1: none, and an edge may run through
                         it; -2: it is wholly background */
    int16_t *seen;    /* the object at its center; -1: none */
    uint32_t *lights; /* see Reference; NULL: no light casts shadows */
    size_t inside;    /* pixels with an owner */
} Exact;

/* From the cache, or computed and put there; `area`: its width and height. The scene has at most
 * INT16_MAX objects. */
bool exact_open(Exact *exact, const Scene *scene, const int area[2], Progress *progress,
                Message *message);
void exact_close(Exact *exact); /* a zeroed one is fine */

/* Adds to a key all that a scene's exact picture depends on; with `meshes` those that stand for
 * solids, too. */
void exact_key_scene(CacheKey *key, const Scene *scene, bool meshes);

#endif
