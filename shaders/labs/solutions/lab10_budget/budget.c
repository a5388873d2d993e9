/*
 * Lab 10: what the sphere is drawn with.
 */
#include "lab_code.h"

void lab_budget(LabBudget *budget)
{
    budget->slices = 112;
    budget->stacks = 80;
    budget->cull = true;
}
