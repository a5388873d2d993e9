/*
 * compare: two surveys side by side.
 */
#ifndef COMPARE_H
#define COMPARE_H

#include "base/message.h"

#include <stdio.h>

/* Prints the settings that the results of both folders have, of those with one unusual choice, and
 * writes OUTPUT/compare.html, with all. */
bool compare_folders(const char *const folders[2], const char *output, FILE *file,
                     Message *message);

#endif
