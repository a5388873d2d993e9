/* The pages' module has no --probe: the module of pixels has it. */
#include "kinds/scene_views.h"

bool scene_exact_pixel(Renderer *renderer, const DrawRequest *request, const int pixel[2],
                       ExactPixel *exact)
{
    (void)renderer, (void)request, (void)pixel, (void)exact;
    return false;
}

void scene_forget_exact(Renderer *renderer)
{
    (void)renderer;
}
