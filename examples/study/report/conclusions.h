/*
 * conclusions: what a study's rows say, in a sentence each.
 */
#ifndef CONCLUSIONS_H
#define CONCLUSIONS_H

#include "study/measure/models.h"
#include "study/results/results.h"

/* "1.3 steps: Phong interpolation 1.8 ms, Gouraud 17 ms": the smallest largest error inside objects
 * that both reach, and what that takes; which times differ by no more than the noise, and that the
 * machine was busy. Empty if one of them was not measured. */
enum { CONCLUSION_SIZE = 320 };
void conclusion_of_scene(const Results *results, const char *scene, char text[CONCLUSION_SIZE]);

/* Up to CONCLUSIONS lines, those whose rows there are; returns their number. The first says what
 * was measured, with how much noise. */
enum { CONCLUSIONS = 9 };
typedef struct Conclusions {
    char lines[CONCLUSIONS][CONCLUSION_SIZE];
    int count;
} Conclusions;

/* Of these scenes, by their numbers. */
Conclusions conclusions_of(const Results *results, const int *scenes, int count,
                           const ModelsApart *apart);

#endif
