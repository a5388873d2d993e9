#include "lab_code.h"
#define FINE 200
void lab_budget(LabBudget *b) {
    LabBudget mine = {FINE, FINE / 2, true};
    *b = mine;
}
