/*
 * confine: limits a process to computing.
 */
#ifndef CONFINE_H
#define CONFINE_H

#include "base/message.h"

/* Called by a process before it loads untrusted machine code. From then on it can use memory, read
 * files while `loading`, write to open files, and end. It cannot start processes or threads, run
 * programs, create, change or remove files, use the network, or signal or trace other processes:
 * those calls fail with EPERM, for root too (seccomp(2)). Called again without `loading` it can
 * open nothing. Close first what must stay out of its reach. False if the kernel does not support
 * it: then load nothing. */
bool confine_process(bool loading, Message *message);

#endif
