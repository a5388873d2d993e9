/* A page draws what was asked for: the search for what is cheapest is left to the command. */
#include "kinds/scene_views.h"

void scene_forget_choices(SceneState *state)
{
    (void)state;
}

void scene_explain_choice(const Renderer *renderer, const DrawRequest *request,
                          const SceneView *view, int number, FILE *file)
{
    (void)renderer;
    (void)request;
    (void)view;
    (void)number;
    (void)file;
}

bool scene_choose(Renderer *renderer, const DrawRequest *request, double seconds, Message *message)
{
    (void)renderer;
    (void)seconds;
    return !request->cheap ||
           message_set(message, "a picture within an error: not in the browser; the command "
                                "draws it");
}
