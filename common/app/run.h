/*
 * run: a whole program around one example.
 */
#ifndef RUN_H
#define RUN_H

#include "core/example.h"

/* Reads the command line, draws and writes. Returns the exit code: 0, EXIT_FAILED or EXIT_USAGE. */
int example_main(const Example *example, int argc, char *argv[]);

#endif
