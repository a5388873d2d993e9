/* Keys: 128 bits that mix all that they are made of, in two independent ways. Not for use against
 * somebody who makes collisions on purpose. */
#include "base/cache.h"

#include "base/paths.h"
#include "base/version.h"

#include <limits.h>
#include <string.h>
#include <sys/stat.h>

/* The finalizer of MurmurHash3 (Appleby, 2011). */
static uint64_t mixed(uint64_t z)
{
    z = (z ^ (z >> 33)) * 0xFF51AFD7ED558CCDu;
    z = (z ^ (z >> 33)) * 0xC4CEB9FE1A85EC53u;
    return z ^ (z >> 33);
}

void cache_key_add(CacheKey *key, const void *bytes, size_t size)
{
    uint64_t a = key->bits[0] + size, b = key->bits[1] ^ (size * 0x9E3779B97F4A7C15u);
    for (size_t at = 0; at < size; at += sizeof(uint64_t)) {
        uint64_t word = 0;
        const size_t rest = size - at;
        memcpy(&word, (const char *)bytes + at, rest < sizeof word ? rest : sizeof word);
        a = mixed(a ^ word) + 0x9E3779B97F4A7C15u;
        b = (b ^ mixed(word + 0xD1B54A32D192ED03u)) * 0x2545F4914F6CDD1Du;
        b ^= b >> 29;
    }
    key->bits[0] = mixed(a);
    key->bits[1] = mixed(b);
}

static bool add_file(CacheKey *key, const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode))
        return false;
    cache_key_add(key, &status.st_mtim, sizeof status.st_mtim);
    cache_key_add(key, &status.st_size, sizeof status.st_size);
    return true;
}

void cache_key_add_program(CacheKey *key)
{
    char path[PATH_MAX];
    cache_key_add(key, VERSION, sizeof VERSION);
    if (paths_program(path, NULL))
        add_file(key, path);
}
