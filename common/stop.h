/*
 * stop: how another thread ends a long computation.
 */
#ifndef STOP_H
#define STOP_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Whether it is to end; NULL: never. To be asked every few milliseconds. */
static inline bool stop_asked(const atomic_bool *stop)
{
    return stop != NULL && atomic_load_explicit(stop, memory_order_relaxed);
}

#endif
