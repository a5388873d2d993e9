/* A page has the options as controls, with their help: there is nothing to print it on. */
#include "app/help.h"

void help_print(const Usage *usage, const Parameter *table)
{
    (void)usage;
    (void)table;
}

void help_generate(const char *form, const Usage *usage, const Parameter *table)
{
    (void)form;
    (void)usage;
    (void)table;
}
