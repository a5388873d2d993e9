/*
 * setting: how a scene is drawn, where one has the choice between more exact and cheaper: one
 * choice on each of thirteen axes. What is drawn, the scene, is the same. No GL.
 */
#ifndef SETTING_H
#define SETTING_H

#include "canvas.h"
#include "scene.h"
#include "shader.h"

#include <stdio.h>

typedef enum SettingAxis {
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
} SettingAxis;

enum { SETTING_MOST_CHOICES = 14 };

typedef struct SettingAxisInfo {
    const char *name;                              /* "interpolation" */
    const char *help;                              /* what is chosen, in a few words */
    const char *choices[SETTING_MOST_CHOICES + 1]; /* "phong", "gouraud"...; ended by NULL */
    int count;
    int usual; /* the number of the usual choice */
} SettingAxisInfo;

extern const SettingAxisInfo SETTING_AXES[AXIS_COUNT];

/* The numbers of the choices, by axis, in the order of SETTING_AXES. */
enum { PRECISION_HIGHP, PRECISION_MEDIUMP };
enum { NORMALS_UNIT, NORMALS_INTERPOLATED };
enum { GUARDS_ON, GUARDS_OFF };
enum { HIGHLIGHT_COSINE, HIGHLIGHT_CROSS };
enum { VIEWER_LOCAL, VIEWER_INFINITE };
enum { LIGHTS_LOCAL, LIGHTS_INFINITE };
enum { OUTPUT_NEAREST, OUTPUT_DITHERED, OUTPUT_FLOAT };
enum { MATRICES_DOUBLE, MATRICES_FLOAT, MATRICES_COMPENSATED };
enum { ORDER_EYE, ORDER_LECTURE };
/* On the axis of interpolation, those of scene.h. */

typedef struct Setting {
    unsigned char choice[AXIS_COUNT];
} Setting;

Setting setting_usual(void);
bool setting_equal(const Setting *a, const Setting *b);

/* The setting with another choice on one axis. */
Setting setting_with(Setting setting, SettingAxis axis, int choice);

/* The numbers that these axes' choices stand for. */
int setting_divisions(const Setting *setting);
int setting_samples(const Setting *setting);
int setting_supersample(const Setting *setting);

/* What differs from the usual: "interpolation=gouraud divisions=24", or "usual". Longest is less
 * than SETTING_TEXT_SIZE. */
enum { SETTING_TEXT_SIZE = 320 };
void setting_text(const Setting *setting, char text[SETTING_TEXT_SIZE]);

/* Sets one axis from the texts of its name and choice. The message names what there is. */
bool setting_choose(Setting *setting, const char *axis, const char *choice, Message *message);

/* Reads what setting_text writes. */
bool setting_parse(Setting *setting, const char *text, Message *message);

/* A scene as a setting has it: lights and objects of its own, the rest the scene's. */
typedef struct SettingScene {
    Scene scene;
    Light *lights;
    Object *objects;
} SettingScene;

/* `scene` would pass scene_check, but objects that stand for solids may lack meshes: these get
 * those of the setting's divisions, from `meshes`; the others stay as they are. Lights at infinity
 * shine from where they are towards the camera's centre; what they lose by distance there they lose
 * everywhere. */
bool setting_scene_open(SettingScene *made, const Scene *scene, const Setting *setting,
                        SolidMeshes *meshes, Message *message);
void setting_scene_close(SettingScene *made);

/* The loader for a setting's shaders: precision, and the files that stand in for those of the
 * guards, the highlight and the output. */
typedef struct SettingLoader {
    ShaderLoader loader;
    ShaderReplacement replacements[4];
} SettingLoader;
void setting_loader(SettingLoader *made, const ShaderLoader *base, const Setting *setting);

/* The canvas for a setting, of this size. */
CanvasOptions setting_canvas(const Setting *setting, int width, int height);

#endif
