/*
 * compare: two surveys side by side.
 */
#ifndef COMPARE_H
#define COMPARE_H

#include "base/message.h"

#include <stdio.h>

/* Prints the settings that the results of both folders have: all, or those with at most one unusual
 * choice. */
bool compare_folders(const char *const folders[2], bool all, FILE *file, Message *message);

#endif
