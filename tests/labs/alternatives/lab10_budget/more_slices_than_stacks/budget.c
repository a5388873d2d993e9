#include "lab_code.h"

void lab_budget(LabBudget *budget)
{
    budget->slices = 300;
    budget->stacks = 100;
    budget->cull = true;
}
