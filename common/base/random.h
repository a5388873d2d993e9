/*
 * random: pseudorandom numbers, the same on every machine for the same seed: splitmix64 (Steele,
 * Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014).
 */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdint.h>

typedef struct Random {
    uint64_t state; /* at first the seed */
} Random;

/* 64 uniform bits. */
static inline uint64_t random_bits(Random *random)
{
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* Uniform in [min, max). */
static inline double random_between(Random *random, double min, double max)
{
    return min + (max - min) * ((double)(random_bits(random) >> 11) * 0x1p-53);
}

/* 0 to limit - 1. */
static inline int random_below(Random *random, int limit)
{
    return (int)(random_bits(random) % (uint64_t)limit);
}

#endif
