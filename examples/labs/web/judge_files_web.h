/*
 * judge_files_web: a page keeps the picture of the worst scene that natively is a file.
 */
#ifndef JUDGE_FILES_WEB_H
#define JUDGE_FILES_WEB_H

#include "base/image.h"

/* Moves the picture that judge_worst made since the last call; an image of no size: it made none.
 */
void judge_take_sheet(Image *sheet);

#endif
