/*
 * judge_pictures: the pictures that go with a verdict.
 */
#ifndef JUDGE_PICTURES_H
#define JUDGE_PICTURES_H

#include "labs/submission/shots.h"

/* The file that judge_worst writes. */
#define JUDGE_WORST "worst.png"

/* Writes folder/worst.png: the submission's picture, the right one and their brightened difference,
 * enlarged, side by side. */
bool judge_worst(const Shots *shots, int shot, const char *folder, Message *message);

/* The exact picture as bytes. */
bool judge_exact_image(const Reference *exact, Image *image, Message *message);

#endif
