/* From what an example makes to the scenes that are drawn: in which part of the picture, with the
 * camera, lights and terms that were asked for, and as cheaply as the error allows. */
#include "kinds/scene_views.h"

#include "app/options.h"

SceneState *scene_state(const Renderer *renderer)
{
    return renderer->state;
}

int scene_view_grid(const SceneExample *example, int *columns, int *rows)
{
    *columns = example->columns ? example->columns : 1;
    *rows = example->rows ? example->rows : 1;
    if (example->layout)
        example->layout(columns, rows);
    return *columns * *rows;
}

static int view_grid(const Renderer *renderer, int *columns, int *rows)
{
    return scene_view_grid(example_scene(renderer->example), columns, rows);
}

int scene_view_count(const Renderer *renderer)
{
    int columns, rows;
    return view_grid(renderer, &columns, &rows);
}

bool scene_view_place(const Renderer *renderer, int view, int place[4])
{
    int columns, rows;
    view_grid(renderer, &columns, &rows);
    const int column = view % columns, row = view / columns;
    place[2] = renderer->canvas->width / columns; /* all are equal; what is left over stays empty */
    place[3] = renderer->canvas->height / rows;
    place[0] = column * place[2];
    place[1] = row * place[3];
    return place[2] > 0 && place[3] > 0;
}

/* As the example makes it, seen as the request wants it. */
static bool make_plain(const ViewMoment *moment, Scene *scene, Message *message)
{
    const DrawRequest *request = moment->request;
    example_scene(moment->renderer->example)->make(moment->seconds, moment->view, scene);
    orbit_move(request->orbit, &scene->camera.eye, scene->camera.center, &scene->camera.up);
    scene->clamp_vertex |= request->clamp_vertex;
    scene->signed_dots |= request->signed_dots;
    scene->linear |= request->linear;
    scene->show_clipped |= request->show_clipped;
    /* Of a view in the picture that the program makes without --size; a saved scene has its own. */
    const Usage usage = options_usage(moment->renderer->example);
    int width, height, columns, rows;
    options_size(&usage, &width, &height);
    view_grid(moment->renderer, &columns, &rows);
    if (!(scene->camera.aspect > 0))
        scene->camera.aspect = (double)width * rows / ((double)height * columns);
    if (!scene_check(scene, message))
        return false;
    if (orbit_moves(request->orbit))
        scene_fit_depth(scene);
    return true;
}

bool scene_view_make(const ViewMoment *moment, SceneCopy *kept, Scene *scene, Message *message)
{
    const DrawRequest *request = moment->request;
    const SceneTerms *terms = &request->terms;
    const bool shadows = request->shadows.way != SHADOWS_OFF;
    const bool own = example_scene(moment->renderer->example)->shadows;
    if (!make_plain(moment, scene, message))
        return false;
    if (!terms->left_out && !terms->lights_left_out && !terms->unlit && !request->places.placed &&
        !request->tints.tinted && shadows == own)
        return true;
    scene_copy_open(kept, scene);
    scene_place_lights(kept, &request->places);
    scene_tint_lights(kept, &request->tints);
    scene_keep_terms(kept, *terms);
    if (shadows != own)
        scene_cast_shadows(kept, shadows);
    *scene = kept->scene;
    return scene_check(scene, message);
}

bool scene_view_open(SceneView *view, Renderer *renderer, const DrawRequest *request,
                     double seconds, int number, Message *message)
{
    SceneState *state = scene_state(renderer);
    const ViewMoment moment = {renderer, request, seconds, number};
    *view = (SceneView){.asked = {.object_count = 0}};
    if (!scene_choose(renderer, request, seconds, message) ||
        !scene_view_make(&moment, &view->kept, &view->asked, message))
        return false;
    view->scene = view->asked;
    if (!request->cheap || state->choices[number].count != view->asked.object_count)
        return true;
    if (!quality_parts_open(&view->made, &view->asked, state->choices[number].objects,
                            &state->meshes, message))
        return false;
    view->scene = view->made.scene;
    return true;
}

void scene_view_close(SceneView *view)
{
    quality_parts_close(&view->made);
    scene_copy_close(&view->kept);
}
