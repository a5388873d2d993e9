/*
 * breakout: tries, from within a sandbox, what must be impossible there.
 */
#ifndef BREAKOUT_H
#define BREAKOUT_H

#include "base/message.h"

/* *failed: what was tried in vain, of SandboxProof: to see the path `hidden`, to reach this port of
 * the machine, and so on. False, with a message, if the process cannot work here at all: it may not
 * read the folder `labs` or run this program. */
bool breakout_try(const char *hidden, int port, const char *labs, unsigned *failed,
                  Message *message);

#endif
