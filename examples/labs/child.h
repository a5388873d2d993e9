/*
 * child: a second process, and a pipe through which it answers.
 */
#ifndef CHILD_H
#define CHILD_H

#include "message.h"

#include <sys/types.h>

/* Forks. In the child it is 0, and *end is where the child writes; in the parent it is the child's
 * id, and *end where its answer is to be read, and to be closed. -1, with a message, where there is
 * no second process. */
pid_t child_start(int *end, Message *message);

/* Waits until it has ended: its status, as waitpid has it. */
int child_wait(pid_t child);

#endif
