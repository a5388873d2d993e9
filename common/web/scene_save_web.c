/* A page writes no files. */
#include "kinds/scene_views.h"

bool scene_save(const Scene *scene, const char *path, Message *message)
{
    (void)scene;
    return message_set(message, "%.80s: not in the browser; the command writes it", path);
}
