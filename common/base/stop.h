/*
 * stop: a flag with which another thread cancels a long computation.
 */
#ifndef STOP_H
#define STOP_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Whether to stop; NULL: never. To be called every few milliseconds. */
static inline bool stop_asked(const atomic_bool *stop)
{
    return stop != NULL && atomic_load_explicit(stop, memory_order_relaxed);
}

#endif
