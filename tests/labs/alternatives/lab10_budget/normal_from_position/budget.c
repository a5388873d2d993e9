/* The sphere of radius 1 lies at the origin: a point of it is its normal. */

#include "lab_code.h"

void lab_budget(LabBudget *budget)
{
    budget->slices = 160;
    budget->stacks = 120;
    budget->cull = true;
}
