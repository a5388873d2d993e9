/*
 * probe_open: makes the scenes of a lab. No GL.
 */
#ifndef PROBE_OPEN_H
#define PROBE_OPEN_H

#include "labs/program/probe.h"

/* The known form of a scene. False, with a message: out of memory. */
bool probe_open_known(Probe *probe, const Lab *lab, ProbeKind kind, Message *message);

/* The form of a seed. */
bool probe_open_seed(Probe *probe, const Lab *lab, ProbeKind kind, uint64_t seed, Message *message);

/* The scene of the lab's program at a time. */
bool probe_open_usual(Probe *probe, const Lab *lab, double seconds, Message *message);

#endif
