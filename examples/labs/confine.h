/*
 * confine: from a call on, a process computes and does nothing else.
 */
#ifndef CONFINE_H
#define CONFINE_H

#include "message.h"

/* For the process that runs somebody else's machine code, before that is loaded. From here on it
 * can use memory, read files, write to what is open, and end. It cannot start processes or threads,
 * run programs, make, change or remove files, use the network, or signal or trace other processes:
 * those calls fail with EPERM. No privilege undoes it, root is bound too (seccomp(2)), and a fork
 * bomb makes no second process. What is to stay out of its reach is to be closed before. False
 * where the kernel does not offer it: then load nothing. */
bool confine_process(Message *message);

#endif
