#include "lab_code.h"

void lab_budget(LabBudget *budget)
{
    budget->slices = 256;
    budget->stacks = 256;
    budget->cull = false;
}
