/*
 * diagnose: which mistake, of those in the catalogue, draws what a wrong submission drew.
 *
 * A mistake is named only where its pictures match the submission's in every scene, and where no
 * other mistake's do. Where several match, scenes are looked for in which they differ, and the
 * submission is drawn there, too; where none is found, all of them are named as one of. Where no
 * mistake alone matches, pairs are tried. Else the symptoms are described, and nothing is named.
 */
#ifndef DIAGNOSE_H
#define DIAGNOSE_H

#include "shots.h"
#include "verdict.h"

/* Fills in the message, mistakes and symptoms of a wrong submission that was drawn in all shots.
 * False, with a message, where the driver fails. */
bool diagnose(const Shots *shots, const Painter *painter, Canvas *canvas, Verdict *verdict,
              Message *message);

#endif
