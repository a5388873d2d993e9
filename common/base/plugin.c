#include "base/plugin.h"

#include "base/paths.h"

#include <dlfcn.h>
#include <stdio.h>
#include <unistd.h>

void *plugin_entry(const PluginName *name, Message *message)
{
    char path[PATH_MAX], reason[1024] = "";
    void *library = NULL;
    for (int place = 0; place < PATHS_PLACE_COUNT && !library; place++) {
        if (!paths_plugin((PathsPlace)place, name->file, path))
            continue;
        library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        const char *error = library ? NULL : dlerror();
        /* The reason why an existing file does not load is more useful than that another is
         * missing. */
        if (error && (!reason[0] || access(path, F_OK) == 0))
            snprintf(reason, sizeof reason, "%s", error);
    }
    if (!library) {
        message_set(message,
                    "%s: its module cannot be loaded (%s); install the package %s and build again",
                    name->library, reason, name->package);
        return NULL;
    }
    void *entry = dlsym(library, name->entry);
    if (!entry)
        message_set(message, "%s: %s", name->library, dlerror());
    return entry;
}
