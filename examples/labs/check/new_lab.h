/*
 * new_lab: writes a lab's folder to edit, from shaders that work.
 */
#ifndef NEW_LAB_H
#define NEW_LAB_H

#include "base/message.h"

/* Makes the folder, with the shaders as its solution, a starter, TASK.md, lab.json and
 * expected.png. False, with a message: it exists, or what the shaders need no lab has. */
bool new_lab_write(const char *folder, const char *vertex, const char *fragment, Message *message);

#endif
