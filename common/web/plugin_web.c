/* A page loads no modules. */
#include "base/plugin.h"

#include <stddef.h>

void *plugin_entry(const PluginName *name, Message *message)
{
    message_set(message, "%s: not in the browser", name->library);
    return NULL;
}
