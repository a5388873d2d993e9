/* The end of a process without memory: half-written files go, and one line is said. Only by system
 * calls, because buffers and locks of the C library may be in any state. */
#include "base/memory.h"
#include "base/output.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

_Noreturn void memory_end(void)
{
    static const char reason[] = ": not enough memory\n";
    const char *name = program_invocation_short_name;
    output_unlink_temporaries();
    output_append(STDERR_FILENO, name, strlen(name));
    output_append(STDERR_FILENO, reason, sizeof reason - 1);
    _exit(MEMORY_EXIT);
}
