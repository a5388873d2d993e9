#include "lab_code.h"

void lab_budget(LabBudget *budget)
{
    budget->slices = 40;
    budget->stacks = 40;
    budget->cull = true;
}
