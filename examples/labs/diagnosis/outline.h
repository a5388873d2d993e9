/*
 * outline: whether a submission covers the pixels that the right program covers.
 */
#ifndef OUTLINE_H
#define OUTLINE_H

#include "labs/submission/lab_pictures.h"

/* Draws all scenes with the submission and with shaders/labs/outline. */
bool outline_check(const LabPictures *pictures, const Painter *painter, Canvas *canvas, bool *wrong,
                   Message *message);

#endif
