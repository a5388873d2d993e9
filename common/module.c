#include "module.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

void module_program_folder(char folder[4096])
{
    const ssize_t length = readlink("/proc/self/exe", folder, 4095);
    folder[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = '\0';
}

/* A program of the build folder has its modules there; any other, only those that were installed.
 */
static bool is_in(const char *folder, const char *root)
{
    const size_t length = strlen(root);
    return strncmp(folder, root, length) == 0 && (folder[length] == '/' || folder[length] == '\0');
}

void *module_entry(const ModuleName *name, Message *message)
{
    char folder[4096], path[2][8192], reason[1024] = "";
    void *library = NULL;
    int count = 1;
    module_program_folder(folder);
    if (is_in(folder, BUILD_ROOT)) {
        snprintf(path[0], sizeof path[0], "%s/%s", MODULES_BUILT, name->file);
    } else {
        snprintf(path[0], sizeof path[0], "%s/%s/%s", folder, MODULES_RELATIVE, name->file);
        snprintf(path[count++], sizeof path[1], "%s/%s", MODULES_INSTALLED, name->file);
    }
    for (int i = 0; i < count && !library; i++) {
        library = dlopen(path[i], RTLD_NOW | RTLD_LOCAL);
        if (library)
            break;
        const char *error = dlerror();
        /* A module that is there but cannot be loaded says more than one that is not. */
        if (!reason[0] || access(path[i], F_OK) == 0)
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
