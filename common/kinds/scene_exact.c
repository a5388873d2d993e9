/* One ray through the pixel's centre, and the lighting equation where it ends. */
#include "kinds/scene_views.h"

#include "base/memory.h"
#include "base/output_text.h"
#include "reference/reference_explain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double RADIANS = 0.017453292519943295;

/* A grey is one number. */
static void put_color(FILE *file, const char *before, Vec3 color)
{
    if (color.x == color.y && color.y == color.z)
        fprintf(file, "%s%.6g", before, color.x);
    else
        fprintf(file, "%s%.6g, %.6g, %.6g", before, color.x, color.y, color.z);
}

/* "diffuse: (1) * (0.5, 0.4, 0.1) * N.L 0.8 = 0.4, 0.32, 0.08"; nothing where a factor is black.
 */
static void put_term(FILE *file, const char *name, const Vec3 factors[2], const char *rest,
                     Vec3 term)
{
    if (color_is_black(factors[0]) || color_is_black(factors[1]))
        return;
    fprintf(file, "%s: ", name);
    put_color(file, "(", factors[0]);
    put_color(file, ") * (", factors[1]);
    fprintf(file, ")%s", rest);
    put_color(file, " = ", term);
    fputc('\n', file);
}

static Vec3 put_light(FILE *file, const Explained *at, const ExplainLight *lit, int number)
{
    const Light *light = lit->light;
    const Material *material = &at->material;
    char rest[100];
    fprintf(file, "light %d, %.6g of it arrives%s:\n", number, lit->share,
            lit->hidden ? "; in shadow, which leaves the ambient term" : "");
    put_term(file, "  ambient", (Vec3[]){light->ambient, material->ambient}, "", lit->ambient);
    snprintf(rest, sizeof rest, " * N.L %.6g", lit->n_dot_l);
    put_term(file, "  diffuse", (Vec3[]){light->diffuse, material->diffuse}, rest, lit->diffuse);
    snprintf(rest, sizeof rest, " * (%s %.6g)^%.6g%s", at->phong ? "R.V" : "N.H", lit->cosine,
             material->shininess, lit->n_dot_l > 0 ? "" : ", behind the surface");
    put_term(file, "  specular", (Vec3[]){light->specular, material->specular}, rest,
             lit->specular);
    const Vec3 sum =
        lit->hidden ? lit->ambient : vec3_add(lit->ambient, vec3_add(lit->diffuse, lit->specular));
    return vec3_scale(sum, lit->share);
}

static char *equation(const Explained *at, const Scene *scene)
{
    OutputText text;
    Vec3 sum = at->base;
    output_text_open(&text);
    FILE *file = text.file;
    if (!color_is_black(at->material.emission)) {
        put_color(file, "emission: ", at->material.emission);
        fputc('\n', file);
    }
    put_term(file, "global ambient", (Vec3[]){scene->global_ambient, at->material.ambient}, "",
             vec3_subtract(at->base, at->material.emission));
    for (int i = 0; i < at->count; i++)
        sum = vec3_add(
            sum, put_light(file, at, &at->lights[i], (int)(at->lights[i].light - scene->lights)));
    put_color(file, "sum: ", sum);
    fprintf(file, "%s\n", scene->linear ? ", which is encoded as sRGB" : "");
    return output_text_close(&text);
}

/* What the directions are drawn with. */
typedef struct Pointer {
    const Trace *trace;
    const Explained *at;
    double size; /* of a unit vector in the world */
    int left, top;
} Pointer;

static void add_direction(ExactPixel *exact, const Pointer *pointer, const char *letter, int light,
                          Vec3 direction)
{
    if (exact->direction_count == EXACT_DIRECTIONS)
        return;
    ExactDirection *made = &exact->directions[exact->direction_count++];
    snprintf(made->name, sizeof made->name, light < 0 ? "%s" : "%s%d", letter, light % 1000);
    memcpy(made->vector, (double[]){direction.x, direction.y, direction.z}, sizeof made->vector);
    trace_place(pointer->trace,
                vec3_add(pointer->at->position, vec3_scale(direction, pointer->size)), made->to);
    made->to[0] += pointer->left;
    made->to[1] += pointer->top;
}

static void explain(ExactPixel *exact, const Trace *trace, const Scene *scene, const int place[4],
                    const double at[2])
{
    Explained said;
    if (explain_open(&said, trace, at[0], at[1])) {
        /* A fifth of the view's height. */
        const double fovy = scene_fovy(&scene->camera, (double)place[2] / place[3]);
        const Pointer pointer = {trace, &said, 0.4 * tan(fovy / 2 * RADIANS) * said.depth, place[0],
                                 place[1]};
        exact->equation = equation(&said, scene);
        add_direction(exact, &pointer, "N", -1, said.normal);
        add_direction(exact, &pointer, "V", -1, said.viewer);
        for (int i = 0; i < said.count; i++) {
            const int number = (int)(said.lights[i].light - scene->lights);
            add_direction(exact, &pointer, "L", number, said.lights[i].direction);
            add_direction(exact, &pointer, said.phong ? "R" : "H", number, said.lights[i].mirror);
        }
    }
    explain_close(&said);
}

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
        Sample sample;
        if (!scene_view_place(renderer, number, place) || !is_inside(pixel, place))
            continue;
        const SceneExact *view = open_view(renderer, request, number, place);
        const double at[2] = {pixel[0] - place[0] + 0.5, pixel[1] - place[1] + 0.5};
        if (!view->trace)
            return false;
        trace_sample(view->trace, at[0], at[1], &sample);
        memcpy(exact->color, sample.color, sizeof sample.color);
        snprintf(exact->object, sizeof exact->object,
                 sample.object < 0 ? "the background" : "object %d", sample.object);
        explain(exact, view->trace, &view->copy.scene, place, at);
        return true;
    }
    return false;
}
