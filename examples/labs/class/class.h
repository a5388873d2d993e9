/*
 * class: check for a whole class: finds the submissions, judges each in a sandbox, writes tables
 * and pages.
 */
#ifndef CLASS_H
#define CLASS_H

#include <stdbool.h>

/* Whether the command line has --class, --merge, or --inside, with which the program calls itself.
 * If so, it has run, and *code is the exit code: 0 if every result is there, whatever it says; 1
 * for a failure or an interrupt; 2 for a usage error. */
bool class_main(int argc, char *argv[], int *code);

#endif
