/* dlopen, and a message that names what to install. */
#include "base/plugin.h"

#include "base/paths.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Whether it is the program of a build folder that can make the module, and has not yet. */
static bool unbuilt(const Plugin *plugin)
{
    char path[PATH_MAX];
    return strstr(PLUGINS_TO_BUILD, plugin->file) &&
           paths_plugin(PATHS_SOURCE, plugin->file, path) && access(path, F_OK) != 0;
}

static const void *load(const Plugin *plugin, Message *message)
{
    char path[PATH_MAX], reason[1024] = "";
    void *library = NULL;
    for (int place = 0; place < PATHS_PLACE_COUNT && !library; place++) {
        if (!paths_plugin((PathsPlace)place, plugin->file, path))
            continue;
        library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        const char *error = library ? NULL : dlerror();
        /* The reason why an existing file does not load is more useful than that another is
         * missing. */
        if (error && (!reason[0] || access(path, F_OK) == 0))
            snprintf(reason, sizeof reason, "%s", error);
    }
    if (!library && unbuilt(plugin)) {
        message_set(message,
                    "%s: its module, common/%s, is not built yet: start the program by "
                    "examples/run, which builds it, or build it with ninja",
                    plugin->library, plugin->file);
        return NULL;
    }
    if (!library) {
        message_set(message,
                    "%s: its module cannot be loaded (%s); install the package %s and build again",
                    plugin->library, reason, plugin->package);
        return NULL;
    }
    const void *variable = dlsym(library, plugin->symbol);
    if (!variable)
        message_set(message, "%s: %s", plugin->library, dlerror());
    return variable;
}

const void *plugin_open(Plugin *plugin, Message *message)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* pictures are written by threads */
    pthread_mutex_lock(&lock);
    if (!plugin->loaded)
        plugin->loaded = load(plugin, message);
    const void *loaded = plugin->loaded;
    pthread_mutex_unlock(&lock);
    return loaded;
}

bool plugin_probe(Plugin *plugin, Message *findings)
{
    Message message = {0};
    PluginVersion *const *found = plugin_open(plugin, &message);
    if (!found && unbuilt(plugin)) {
        message_add(findings, "  %-12s installed, gives %s; not built yet: built when needed\n",
                    plugin->library, plugin->purpose);
        return false;
    }
    return package_tell(findings, plugin->library, found ? (*found)() : NULL, plugin->purpose,
                        found ? NULL : message.text);
}

bool package_tell(Message *findings, const char *name, const char *version, const char *gives,
                  const char *missing)
{
    if (missing)
        message_add(findings, "  %-12s missing, gives %s: %s\n", name, gives, missing);
    else
        message_add(findings, "  %-12s %.*s%sfound, gives %s\n", name,
                    version ? (int)strcspn(version, " ") : 0, version ? version : "",
                    version ? ": " : "", gives);
    return !missing;
}
