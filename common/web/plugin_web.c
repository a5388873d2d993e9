/* A page loads no modules. */
#include "base/plugin.h"

#include <stddef.h>

const void *plugin_open(Plugin *plugin, Message *message)
{
    message_set(message, "%s: not in the browser", plugin->library);
    return NULL;
}

bool plugin_probe(Plugin *plugin, Message *findings)
{
    message_add(findings, "  %s: not in the browser\n", plugin->library);
    return false;
}
