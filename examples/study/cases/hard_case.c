#include "study/cases/hard_case.h"

#include <string.h>

const HardCase *hard_case(int number)
{
    return number < HARD_FORMULA_COUNT ? &HARD_FORMULAS[number]
                                       : &HARD_SHADOWS[number - HARD_FORMULA_COUNT];
}

/* The start of every case: a slightly shiny object, a point light, some ambient light. */
static void begin(HardScene *made)
{
    made->lights[0] = (Light){.kind = LIGHT_POINT,
                              .position = {-2, 3, 4},
                              .diffuse = {0.8, 0.8, 0.75},
                              .specular = {0.5, 0.5, 0.5}};
    made->objects[0] = (Object){.mesh = &made->mesh,
                                .world_from_object = mat4_identity(),
                                .front = {.ambient = {0.9, 0.6, 0.35},
                                          .diffuse = {0.9, 0.6, 0.35},
                                          .specular = {0.6, 0.6, 0.6},
                                          .alpha = 1,
                                          .shininess = 32}};
    made->scene = (Scene){.camera = {{0, 1.2, 4}, {0, 0, 0}, {0, 1, 0}, 36, 1, 20, 0},
                          .background = {0.12, 0.13, 0.17},
                          .global_ambient = {0.25, 0.25, 0.25},
                          .lights = made->lights,
                          .light_count = 1,
                          .objects = made->objects,
                          .object_count = 1};
}

bool hard_scene_open(HardScene *made, const HardCase *of, Message *message)
{
    memset(made, 0, sizeof *made);
    begin(made);
    if (!of->make(made, message))
        return false;
    made->naive = made->scene;
    made->naive.objects = made->naive_objects;
    memcpy(made->naive_objects, made->objects, sizeof made->objects);
    if (made->naive_mesh.vertices)
        made->naive_objects[0].mesh = &made->naive_mesh;
    if (of->spoil)
        of->spoil(made);
    return scene_check(&made->scene, message) && scene_check(&made->naive, message);
}

void hard_scene_close(HardScene *made)
{
    mesh_close(&made->mesh);
    mesh_close(&made->naive_mesh);
    mesh_close(&made->floor);
}
