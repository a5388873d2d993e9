/* The end of a page's module without memory: there are no files to remove, and the page says it. */
#include "base/memory.h"

#include <stdlib.h>

_Noreturn void memory_end(void)
{
    abort();
}
