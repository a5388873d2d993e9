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

#include "labs/submission/shots.h"
#include "labs/submission/verdict.h"

/* Fills in the message, mistakes and symptoms of a wrong submission, drawn in all shots. False,
 * with a message: the driver failed. */
bool diagnose(const Shots *shots, const Painter *painter, Canvas *canvas, Verdict *verdict,
              Message *message);

/* Only the symptoms. */
bool diagnose_symptoms(const Shots *shots, const Painter *painter, Canvas *canvas, Verdict *verdict,
                       Message *message);

/* *wrong: the submission, drawn in all shots, covers other pixels than the right program. */
bool diagnose_outline(const Shots *shots, const Painter *painter, Canvas *canvas, bool *wrong,
                      Message *message);

#endif
