/*
 * judge_pictures: the pictures that go with a verdict.
 */
#ifndef JUDGE_PICTURES_H
#define JUDGE_PICTURES_H

#include "labs/submission/lab_pictures.h"

/* The submission's picture, the right one and their difference, enlarged, side by side. */
bool judge_sheet(const LabPictures *pictures, int picture, Image *sheet, Message *message);

/* The file that judge_worst writes. */
#define JUDGE_WORST "worst.png"

/* Writes that sheet as folder/worst.png (in a page: keeps it, see labs/web). */
bool judge_worst(const LabPictures *pictures, int picture, const char *folder, Message *message);

/* |a - b|, brightened, where `exact` has no edge. */
bool judge_difference(const Image *a, const Image *b, const Reference *exact, Image *difference,
                      Message *message);

#endif
