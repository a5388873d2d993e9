/*
 * inside: the sandboxed process: takes on its limits, then does one step.
 */
#ifndef INSIDE_H
#define INSIDE_H

/* Exit codes besides 0. */
enum {
    INSIDE_REFUSED = 3, /* the last line on standard error says why */
    INSIDE_TIMEOUT = 4,
    INSIDE_BROKEN = 5, /* the sandbox itself failed */
};

/* PROGRAM --inside USER SECONDS FOLDER STEP...: becomes that user (if root), takes on the limits,
 * then does one of these steps, with FOLDER for its files:
 *   prove HIDDEN PORT LABS  tries what must be impossible, and reports what was; fails if it may
 * not read the folder LABS or run this program unpack                  the archive on standard
 * input -> its source files judge LAB SEED          the submission on standard input ->
 * verdict.json and pictures The result goes to standard output as a bundle. Returns the exit code.
 */
int inside_main(int count, char *arguments[]);

#endif
