/*
 * fuzz: what libFuzzer's targets share.
 */
#ifndef FUZZ_H
#define FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* The target: called with one input after the other. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
#define FUZZ(data, size) int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)

/* A finding, unless it holds. */
static inline void require(bool holds)
{
    if (!holds)
        abort();
}

#endif
