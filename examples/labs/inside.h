/*
 * inside: what this program does within a sandbox: take on its limits, then one step.
 */
#ifndef INSIDE_H
#define INSIDE_H

#include "message.h"

#include <limits.h>

/* Exit codes besides 0. */
enum {
    INSIDE_REFUSED = 3, /* one line on standard error says why */
    INSIDE_TIMEOUT = 4,
    INSIDE_BROKEN = 5, /* something about the sandbox */
};

/* Files and folders that the program needs to draw and to compile; ended by NULL. */
extern const char *const INSIDE_READABLE[];

/* The same, from the program's folder on, for a program that was installed and moved. */
extern const char *const INSIDE_READABLE_RELATIVE[];

/* The path of the program that runs. */
bool inside_program(char program[PATH_MAX], Message *message);

/* PROGRAM --inside USER SECONDS FOLDER STEP...: becomes that user (if root), takes on the limits,
 * and with FOLDER for its files does one of
 *   prove HIDDEN PORT LABS  tries what must be impossible, and says which was; fails where it may
 *                           not read the folder LABS, or not run this program
 *   unpack                  the archive on standard input -> its source files
 *   judge LAB SEED          the submission on standard input -> verdict.json and pictures
 * What it finds goes to standard output as a bundle. Returns the exit code. */
int inside_main(int count, char *arguments[]);

#endif
