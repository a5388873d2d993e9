/*
 * main: the entry point of every example. The build compiles this file once for each, with EXAMPLE
 * as the name of its descriptor.
 */
#include "app/run.h"
#include "core/example.h"

extern const Example EXAMPLE;

int main(int argc, char *argv[])
{
    return example_main(&EXAMPLE, argc, argv);
}
