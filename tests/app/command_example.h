/*
 * command_example: an example with parameters of every kind, for tests of command lines.
 */
#ifndef COMMAND_EXAMPLE_H
#define COMMAND_EXAMPLE_H

#include "app/options.h"
#include "support/testing.h"

extern double turn;
extern int slices, shape, style;
extern bool marks, sheet;
extern Vec3 color;
extern const char *model, *title;

enum { PARAMETER_COUNT = 11 };
extern const Parameter PARAMETERS[PARAMETER_COUNT + 1];
extern const Example example;
extern ParameterValue defaults[PARAMETER_COUNT];
void put_back(const ParameterValue *values);

/* Fixtures. */
int save_defaults(void **state);
int restore_defaults(void **state);
#define COMMAND_TEST(name) TEST_WITH(0, name, NULL, restore_defaults)

/* The options of an empty command line, without the default name of the output. */
Options plain_options(const Example *of);

#endif
