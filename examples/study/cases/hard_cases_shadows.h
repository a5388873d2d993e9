/*
 * hard_cases_shadows: the hard cases of shadows: what throws them, and where the plain way fails.
 */
#ifndef HARD_CASES_SHADOWS_H
#define HARD_CASES_SHADOWS_H

#include "study/cases/hard_cases_list.h"

/* Each makes the scene that hard_scene_open has begun. */
bool make_acne(HardScene *made, Message *message);
bool make_panning(HardScene *made, Message *message);
bool make_slit(HardScene *made, Message *message);
bool make_roof(HardScene *made, Message *message);
bool make_far_plane(HardScene *made, Message *message);
bool make_terminator(HardScene *made, Message *message);
bool make_distant(HardScene *made, Message *message);
bool make_sheet(HardScene *made, Message *message);
bool make_mirrored(HardScene *made, Message *message);

/* The sphere is known by its triangles alone. */
void spoil_solid(HardScene *made);

#endif
