/* Where the pixel's view is, and what its trace knows. */
#include "kinds/scene_views.h"

#include "base/memory.h"
#include "kinds/exact_light.h"

#include <stdlib.h>
#include <string.h>

/* A view: its scene, copied because the next view's is made in its place, and what follows rays
 * through it. */
typedef struct SceneExact {
    CacheKey key; /* of scene and size */
    SceneCopy copy;
    Trace *trace; /* NULL: nothing is known */
} SceneExact;

static void close_view(SceneExact *view)
{
    trace_close(view->trace);
    scene_copy_close(&view->copy);
    *view = (SceneExact){.trace = NULL};
}

void scene_forget_exact(Renderer *renderer)
{
    SceneState *state = scene_state(renderer);
    for (int i = 0; state->exact && i < scene_view_count(renderer); i++)
        close_view(&state->exact[i]);
    free(state->exact);
    state->exact = NULL;
}

static const SceneExact *open_view(Renderer *renderer, const DrawRequest *request, int number,
                                   const int place[4])
{
    SceneState *state = scene_state(renderer);
    if (!state->exact)
        state->exact = memory_new((size_t)scene_view_count(renderer), sizeof *state->exact);
    SceneExact *view = &state->exact[number];
    const ViewMoment moment = {renderer, request, request->seconds, number};
    const ReferenceOptions size = {.width = place[2], .height = place[3], .threads = 1};
    SceneCopy kept = {.lights = NULL};
    Scene scene;
    CacheKey key = {{0}};
    const bool made = scene_view_make(&moment, &kept, &scene, NULL) && scene.object_count > 0;
    if (made) {
        scene_key(&key, &scene, false);
        cache_key_add(&key, &place[2], 2 * sizeof place[2]);
    }
    if (!made || memcmp(&key, &view->key, sizeof key) != 0)
        close_view(view);
    if (made && !view->trace) {
        view->key = key;
        scene_copy_open(&view->copy, &scene);
        trace_open(&view->trace, &view->copy.scene, &size, NULL);
    }
    scene_copy_close(&kept);
    return view;
}

static bool is_inside(const int pixel[2], const int place[4])
{
    return pixel[0] >= place[0] && pixel[1] >= place[1] && pixel[0] < place[0] + place[2] &&
           pixel[1] < place[1] + place[3];
}

bool scene_exact_pixel(Renderer *renderer, const DrawRequest *request, const int pixel[2],
                       ExactPixel *exact)
{
    *exact = (ExactPixel){.equation = NULL};
    for (int number = 0; number < scene_view_count(renderer); number++) {
        int place[4];
        if (!scene_view_place(renderer, number, place) || !is_inside(pixel, place))
            continue;
        const SceneExact *view = open_view(renderer, request, number, place);
        const double at[2] = {pixel[0] - place[0] + 0.5, pixel[1] - place[1] + 0.5};
        if (!view->trace)
            return false;
        exact_light_tell(exact, view->trace, &view->copy.scene, place, at, request->terms.unlit);
        return true;
    }
    return false;
}
