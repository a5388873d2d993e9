/*
 * class: check for a whole class: finds the submissions, judges each in a sandbox, writes tables
 * and pages.
 */
#ifndef CLASS_H
#define CLASS_H

#include <stdbool.h>

/* Whether the command line is one of these: --class, --merge, or --inside, with which the program
 * calls itself. Then it is done, and *code is the exit code: 0 where every result is there,
 * whatever it is; 1 where something failed, or a signal asked to end; 2 for a usage error. */
bool class_main(int argc, char *argv[], int *code);

#endif
