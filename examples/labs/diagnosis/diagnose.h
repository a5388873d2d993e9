/*
 * diagnose: finds the catalogue's mistake that draws what a wrong submission drew.
 *
 * A mistake is named only if its pictures match the submission's in every scene and no other
 * mistake's do. If several match, the submission is drawn in further scenes that tell them apart;
 * if none does, all are named as "one of". If no single mistake matches, pairs are tried. Otherwise
 * only symptoms are described.
 */
#ifndef DIAGNOSE_H
#define DIAGNOSE_H

#include "labs/submission/lab_pictures.h"
#include "labs/submission/verdict.h"

/* Fills in the message, mistakes and symptoms of a wrong submission, drawn in all pictures.
 * `moved`: its outline is wrong (outline.h). False, with a message: the driver failed. */
bool diagnose(const LabPictures *pictures, const Painter *painter, bool moved, Canvas *canvas,
              Verdict *verdict, Message *message);

#endif
