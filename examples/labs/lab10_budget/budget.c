/*
 * Lab 10: what the sphere is drawn with.
 */
#include "lab_code.h"

void lab_budget(LabBudget *budget)
{
    /* To do: as few triangles as the error allows. */
    budget->slices = 12;
    budget->stacks = 12;
    budget->cull = false;
}
