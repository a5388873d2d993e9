/*
 * scenes: the study's scenes. Their objects are solids without meshes: a quality setting determines
 * the meshes.
 */
#ifndef SCENES_H
#define SCENES_H

#include "scene/file_scene.h"

enum { STUDY_MAX_OBJECTS = 6, STUDY_MAX_LIGHTS = 4 };

/* Not to be copied: `scene` points at the arrays. */
typedef struct StudyScene {
    Scene scene;
    Light lights[STUDY_MAX_LIGHTS];
    Object objects[STUDY_MAX_OBJECTS];
} StudyScene;

typedef struct StudySceneInfo {
    const char *name; /* "shiny32" */
    const char *what; /* for --help */
    void (*make)(StudyScene *made);
    bool few; /* measured with other interpolation, divisions, precision and normals alone */
} StudySceneInfo;

/* The study's own, and after those the file's. */
enum { STUDY_SCENE_COUNT = 12, STUDY_FILE = STUDY_SCENE_COUNT };
extern const StudySceneInfo STUDY_SCENES[STUDY_SCENE_COUNT + 1];

/* Opens the file of the last one, for as long as the process lives; it gets its name of what it
 * holds: "file-0123456789ab". */
bool study_open_file(const char *path, Message *message);

/* A scene by its number; the number of a name, which must be one of them. */
void study_scene(int number, StudyScene *made);
int study_scene_number(const char *name);

/* The shiny sphere of shiny8 to shiny128, with this exponent and reflection model. */
void study_shiny(StudyScene *made, double shininess, Reflection reflection);

#endif
