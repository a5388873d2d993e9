/*
 * efficient: the table of efficient settings for each class of scenes, as measured, and the choice
 * of one by the error that is allowed. No GL.
 */
#ifndef EFFICIENT_H
#define EFFICIENT_H

#include "setting.h"

#include <limits.h>

/* What makes a scene hard to draw: the first of these that it has. */
typedef enum SceneClass {
    SCENE_SPOT,     /* a spot light: a cone's edge */
    SCENE_SHINY128, /* highlights of a shininess over 32 */
    SCENE_SHINY32,  /* over 8 */
    SCENE_SHINY8,   /* any highlight */
    SCENE_CURVED,   /* no highlight, but a curved surface */
    SCENE_FLAT,     /* neither */
    SCENE_CLASS_COUNT,
} SceneClass;

/* "spot", "shiny128"..., NULL-terminated. */
extern const char *const SCENE_CLASS_NAMES[SCENE_CLASS_COUNT + 1];

SceneClass scene_class(const Scene *scene);

/* Whether the table may have a setting: it differs from the usual one only on axes whose error does
 * not depend on where the lights and the viewer are, and which are the scene's, not the canvas's.
 */
bool efficient_allows(const Setting *setting);

typedef struct EfficientRow {
    SceneClass class;
    Setting setting;
    double maximum; /* of the error inside objects, in steps of 1/255 */
    double rms;
    double milliseconds;
} EfficientRow;

enum { EFFICIENT_MOST_ROWS = 512 };

typedef struct Efficient {
    EfficientRow rows[EFFICIENT_MOST_ROWS];
    int count;
    char path[PATH_MAX]; /* where it is from */
} Efficient;

/* Reads the first table that is there, of: the file that the environment's LIGHTING_EFFICIENT
 * names; lighting/efficient.csv in XDG_CONFIG_HOME or ~/.config, as `accuracy --calibrate` writes
 * it; that of the source tree, and of the installation. The message names file and line of what is
 * wrong with it. */
bool efficient_read(Efficient *table, Message *message);

/* The same from text in memory; `path` is for the messages. */
bool efficient_parse(Efficient *table, const char *path, const char *text, size_t size,
                     Message *message);

/* Where `accuracy --calibrate` is to write: the first two of the places above, the folder made.
 * False where there is neither. */
bool efficient_path_to_write(char path[PATH_MAX], Message *message);

/* Writes a table, whole or not at all; `renderer` is what it was measured with. */
bool efficient_write(const Efficient *table, const char *path, const char *renderer,
                     Message *message);

/* The cheapest setting for this class whose error is at most `error`. NULL, with a message that
 * tells the least there is, where none is. */
const EfficientRow *efficient_choose(const Efficient *table, SceneClass class, double error,
                                     Message *message);

#endif
