/*
 * file_scene: the scene that a file holds, at any time, with a camera and a light where it has
 * none. No GL.
 */
#ifndef FILE_SCENE_H
#define FILE_SCENE_H

#include "scene/effects.h"
#include "scene/scene_file.h"

#include <stdio.h>

typedef struct FileSceneOptions {
    const char *path;
    int up;             /* a ModelUp */
    const char *camera; /* its number or name; "fit": one that sees all; NULL: the first, or that */
    double exposure;    /* a factor of the lights; 0: one that overexposes little, if the file's are
                           in candela and lux, or above 1 */
} FileSceneOptions;

typedef struct FileScene {
    SceneFile file;
    int camera; /* -1: one that sees all */
    double exposure;
    Vec3 middle; /* of all objects, as they rest */
    double radius;
    Mat4 *poses;
    Object *objects;
    Light *lights;
} FileScene;

/* Closed after a failure, too. */
bool file_scene_open(FileScene *made, const FileSceneOptions *options, Message *message);

/* Points at `made` until the next call. */
void file_scene_make(FileScene *made, double seconds, Scene *scene);

/* A line for each thing that the file has and the scene has not, with how often. */
void file_scene_explain(const FileScene *made, FILE *file);

void file_scene_close(FileScene *made);

#endif
