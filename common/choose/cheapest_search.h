/*
 * cheapest_search: the search for the cheapest quality, without the cache of what was chosen; see
 * cheapest_quality.h.
 */
#ifndef CHEAPEST_SEARCH_H
#define CHEAPEST_SEARCH_H

#include "choose/cheapest_task.h"

/* Fills in a choice for a scene of `cheapest->count` objects, for each of which it has room. */
bool cheapest_search(CheapestQuality *cheapest, const CheapestQualityTask *task, Message *message);

#endif
