/*
 * outline: whether a submission covers the pixels that the right program covers.
 */
#ifndef OUTLINE_H
#define OUTLINE_H

#include "labs/submission/shots.h"

/* Draws all scenes with the submission and with shaders/labs/outline. */
bool outline_check(const Shots *shots, const Painter *painter, Canvas *canvas, bool *wrong,
                   Message *message);

#endif
