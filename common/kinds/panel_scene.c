/* What a window's panel shows of a program with scenes: errors from a worker in the background,
 * effects as --explain lists them, lights with their handles. */
#include "kinds/scene_views.h"

/* If this fails, drawing the frame fails too and reports why. */
static bool start(ErrorWorker *worker, Renderer *renderer, const DrawRequest *request)
{
    ErrorPicture picture;
    if (!scene_error_picture(renderer, request, request->seconds, &picture, NULL))
        return false;
    error_worker_start(worker, &picture);
    return true;
}

static PanelErrorPart part_of(const ErrorSum *sum)
{
    return (PanelErrorPart){.rms = error_sum_rms(sum), .maximum = sum->maximum};
}

static PanelError known_error(ErrorWorker *worker)
{
    ErrorResult result;
    error_worker_result(worker, &result);
    return (PanelError){.known = result.known,
                        .computing = result.computing,
                        .of_computing = part_of(&result.of_computing),
                        .of_mesh = part_of(&result.error.interior),
                        .at_edges = part_of(&result.error.edges),
                        .seconds = result.seconds,
                        .colors = PICTURE_ERROR_COLORS};
}

static void copy_map(ErrorWorker *worker, Image *map, int *number)
{
    ErrorResult result;
    error_worker_result(worker, &result);
    if (result.known && result.number != *number && error_worker_map(worker, map))
        *number = result.number;
}

static int find_lights(Renderer *renderer, const DrawRequest *request,
                       Light lights[SCENE_MAX_PLACED])
{
    DrawRequest plain = *request;
    int count = 0;
    plain.terms = (SceneTerms){.left_out = 0};
    plain.tints = (LightTints){.tinted = 0};
    plain.cheap = false;
    for (int number = 0; number < scene_view_count(renderer); number++) {
        SceneView view;
        if (scene_view_open(&view, renderer, &plain, request->seconds, number, NULL))
            for (; count < view.asked.light_count && count < SCENE_MAX_PLACED; count++)
                lights[count] = view.asked.lights[count];
        scene_view_close(&view);
    }
    return count;
}

static int find_handles(Renderer *renderer, const DrawRequest *request, Handle handles[HANDLES_MAX])
{
    int count = 0;
    for (int number = 0; number < scene_view_count(renderer); number++) {
        SceneView view;
        int place[4];
        if (!scene_view_place(renderer, number, place))
            continue;
        if (scene_view_open(&view, renderer, request, request->seconds, number, NULL))
            count = handles_add(handles, count, &view.asked, number, place);
        scene_view_close(&view);
    }
    return count;
}

static bool drag(Renderer *renderer, const DrawRequest *request, const Handle *handle, Vec3 *at)
{
    SceneView view;
    int place[4];
    if (handle->light >= SCENE_MAX_PLACED || !scene_view_place(renderer, handle->view, place))
        return false;
    const bool done =
        scene_view_open(&view, renderer, request, request->seconds, handle->view, NULL) &&
        handle_drag(&view.asked, place, handle->light, handle->x, handle->y, at);
    scene_view_close(&view);
    return done;
}

const PanelKind SCENE_PANEL = {
    .open = error_worker_open,
    .close = error_worker_close,
    .start = start,
    .cancel = error_worker_cancel,
    .busy = error_worker_busy,
    .error = known_error,
    .map = copy_map,
    .write_effects = explain_effects,
    .lights = find_lights,
    .handles = find_handles,
    .find_handle = handles_find,
    .drag = drag,
};
