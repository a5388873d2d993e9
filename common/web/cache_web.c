/* Nothing is kept between visits to a page. */
#include "base/cache.h"

void *cache_read(const char *kind, const CacheKey *key, size_t *size)
{
    (void)kind;
    (void)key;
    (void)size;
    return NULL;
}

void cache_write(const char *kind, const CacheKey *key, const void *bytes, size_t size)
{
    (void)kind;
    (void)key;
    (void)bytes;
    (void)size;
}

void cache_prepare_driver(void)
{
}
