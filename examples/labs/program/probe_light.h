/*
 * probe_light: makes the lights of a probe so bright that whatever clamps them shows. No GL.
 */
#ifndef PROBE_LIGHT_H
#define PROBE_LIGHT_H

#include "labs/program/probe.h"

/* The light of each lamp, before it is multiplied by the surface's colour, exceeds 1 in two
 * channels although no colour of the picture does. On flat shapes the first lamp faces a face. With
 * a highlight, except in lab 7, one channel has only that, up to 1. */
void probe_overexpose_light(Probe *probe, const Lab *lab);

/* One channel of the picture exceeds 1. */
void probe_overexpose_picture(Probe *probe);

#endif
