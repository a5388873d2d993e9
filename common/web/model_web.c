/* The plugin of the module that reads models in a page: our own readers, which are linked. */
#include "base/plugin.h"
#include "scene/model_module.h"

#include <string.h>

static bool read_file(const char *path, ModelUp up, SceneFile *file, Message *reason)
{
    bool other;
    (void)up;
    const bool read = own_read(path, file, &other, reason);
    return !other ? read
                  : message_set(reason,
                                "a page reads .gltf, .glb, .obj and .ply; the command reads other "
                                "formats, too");
}

static const ModelModule own = {.read = read_file};

const void *plugin_open(Plugin *plugin, Message *message)
{
    if (strcmp(plugin->symbol, "model_module") == 0)
        return &own;
    message_set(message, "%s: not in the browser", plugin->library);
    return NULL;
}

bool plugin_probe(Plugin *plugin, Message *findings)
{
    message_add(findings, "  %s: not in the browser\n", plugin->library);
    return false;
}
