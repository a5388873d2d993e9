/*
 * main: the entry of every example's program. The build compiles this file once for each, with
 * EXAMPLE as the name of its descriptor.
 */
#include "example.h"

extern const Example EXAMPLE;

int main(int argc, char *argv[])
{
    return example_main(&EXAMPLE, argc, argv);
}
