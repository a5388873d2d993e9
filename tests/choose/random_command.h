/*
 * random_command: command lines of any program with a scene, as one would type them.
 */
#ifndef RANDOM_COMMAND_H
#define RANDOM_COMMAND_H

#include "base/random.h"
#include "support/examples.h"

extern Random randomness;
int below(int limit);

/* Files in the current folder that commands name: two balls, and two triangles that are bent,
 * without normals. */
void write_models(void);

enum { MAX_WORDS = 56 };

typedef struct Command {
    const Example *example;
    char words[MAX_WORDS][96];
    int count;
} Command;

void add(Command *command, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* `most`: pixels of width. `error`: 0: any; else this one, and nothing is given that can be chosen.
 * `lit`: lights may be moved and colored, and have shadows. */
Command any_command(double most, double error, bool lit);

#endif
