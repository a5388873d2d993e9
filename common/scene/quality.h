/*
 * quality: how a scene is drawn, from more accurate to cheaper: one choice on each of thirteen
 * axes. The scene is the same. No GL.
 */
#ifndef QUALITY_H
#define QUALITY_H

#include "core/canvas.h"
#include "core/shader.h"
#include "scene/effects.h"

#include <stdint.h>

typedef enum QualityAxis {
    AXIS_INTERPOLATION,
    AXIS_DIVISIONS,
    AXIS_PRECISION,
    AXIS_NORMALS,
    AXIS_GUARDS,
    AXIS_HIGHLIGHT,
    AXIS_VIEWER,
    AXIS_LIGHTS,
    AXIS_SAMPLES,
    AXIS_SUPERSAMPLE,
    AXIS_OUTPUT,
    AXIS_MATRICES,
    AXIS_ORDER,
    AXIS_COUNT,
} QualityAxis;

enum { QUALITY_MAX_CHOICES = 14 };

typedef struct QualityAxisInfo {
    const char *name;                             /* "interpolation" */
    const char *help;                             /* in a few words */
    const char *choices[QUALITY_MAX_CHOICES + 1]; /* "phong", "gouraud"...; NULL-terminated */
    int count;
    int usual; /* index of the usual choice */
} QualityAxisInfo;

extern const QualityAxisInfo QUALITY_AXES[AXIS_COUNT];

/* The choices of each axis, in the order of QUALITY_AXES. AXIS_INTERPOLATION: see scene.h. */
enum { PRECISION_HIGHP, PRECISION_MEDIUMP };
enum { NORMALS_UNIT, NORMALS_INTERPOLATED };
enum { GUARDS_ON, GUARDS_OFF };
enum { HIGHLIGHT_COSINE, HIGHLIGHT_CROSS };
enum { LIGHTS_LOCAL, LIGHTS_INFINITE };
enum { OUTPUT_NEAREST, OUTPUT_DITHERED, OUTPUT_FLOAT };
enum { MATRICES_DOUBLE, MATRICES_FLOAT, MATRICES_COMPENSATED };
enum { ORDER_EYE, ORDER_LECTURE };

typedef struct Quality {
    unsigned char choice[AXIS_COUNT];
} Quality;

Quality quality_usual(void);
bool quality_equal(const Quality *a, const Quality *b);

/* The same with another choice on one axis. */
Quality quality_with(Quality quality, QualityAxis axis, int choice);

/* The values of these axes' choices. */
int quality_divisions(const Quality *quality);
int quality_samples(const Quality *quality);
int quality_supersample(const Quality *quality);

/* The choices that differ from the usual: "interpolation=gouraud divisions=24", or "usual". Always
 * shorter than QUALITY_TEXT_SIZE. */
enum { QUALITY_TEXT_SIZE = 320 };
void quality_text(const Quality *quality, char text[QUALITY_TEXT_SIZE]);

/* Sets one axis from the names of axis and choice. The message lists the valid names. */
bool quality_choose(Quality *quality, const char *axis, const char *choice, Message *message);

/* Reads what quality_text writes. */
bool quality_parse(Quality *quality, const char *text, Message *message);

/* A copy of the scene in some quality. Objects that stand for solids may lack meshes: they get
 * those with the quality's divisions from `meshes`. Otherwise `scene` would pass scene_check. A
 * point light moved to infinity keeps its direction and attenuation at the camera's center. */
bool quality_scene_open(SceneCopy *made, const Scene *scene, const Quality *quality,
                        SolidMeshes *meshes, Message *message);

/* How one object of a scene is drawn, which may be other than its neighbors; lights by their
 * numbers as bits, up to EFFECTS_MAX_LIGHTS. */
typedef struct ObjectQuality {
    int divisions; /* of a solid's mesh; 0: the mesh as given */
    Interpolation interpolation;
    bool distant_viewer, skip_renormalization;
    uint32_t far_lights;   /* moved to infinity, as seen from the object's origin */
    uint32_t matte_lights; /* without their highlights */
    uint32_t dark_lights;  /* off */
} ObjectQuality;

/* As the scene says. */
ObjectQuality object_quality_plain(const Scene *scene);
bool object_quality_equal(const ObjectQuality *a, const ObjectQuality *b);

/* A scene drawn object by object. */
typedef struct QualityParts {
    Scene scene;  /* all objects, with the meshes that are drawn */
    Scene *parts; /* each has one object and its own lights */
    Light *lights;
    Object *objects;
} QualityParts;

/* `qualities`: of each object. */
bool quality_parts_open(QualityParts *made, const Scene *scene, const ObjectQuality *qualities,
                        SolidMeshes *meshes, Message *message);
void quality_parts_close(QualityParts *made);

/* The expected time to draw object `number` with these effects, in arbitrary units that differ from
 * nanoseconds on llvmpipe (Mesa 22.3, two cores) by a factor of two: from its triangles and
 * vertices, the fragments that it covers, the operations that the effects call for, and the volumes
 * of shadows. The same on every machine, so that what is chosen by it is, too. */
double quality_parts_cost(const QualityParts *made, int number, const Effects *effects,
                          double fragments);

/* The shader loader: precision, and replacements for the files of guards, highlight and output. */
typedef struct QualityLoader {
    ShaderLoader loader;
    ShaderReplacement replacements[4];
} QualityLoader;
void quality_loader(QualityLoader *made, const ShaderLoader *base, const Quality *quality);

/* The canvas of this size. */
CanvasOptions quality_canvas(const Quality *quality, int width, int height);

#endif
