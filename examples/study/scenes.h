/*
 * scenes: what the study draws: objects that stand for solids and have no meshes yet, for a setting
 * gives them theirs.
 */
#ifndef SCENES_H
#define SCENES_H

#include "scene.h"

enum { STUDY_MOST_OBJECTS = 6, STUDY_MOST_LIGHTS = 4 };

/* Points into itself: not to be copied. */
typedef struct StudyScene {
    Scene scene;
    Light lights[STUDY_MOST_LIGHTS];
    Object objects[STUDY_MOST_OBJECTS];
} StudyScene;

typedef struct StudySceneInfo {
    const char *name; /* "shiny32" */
    const char *what; /* in a few words */
    void (*make)(StudyScene *made);
    bool few; /* only for the table of efficient settings: measured with the settings of that */
} StudySceneInfo;

enum { STUDY_SCENE_COUNT = 12 };
extern const StudySceneInfo STUDY_SCENES[STUDY_SCENE_COUNT];

/* The scene of that number; the number of a name among them. */
void study_scene(int number, StudyScene *made);
int study_scene_number(const char *name);

/* A sphere of this shininess: Phong's reflection, or Blinn-Phong's. */
void study_shiny(StudyScene *made, double shininess, Reflection reflection);

#endif
