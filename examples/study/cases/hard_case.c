#include "study/cases/hard_case.h"

#include "shapes/mesh_solids.h"

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

static bool open_mesh(const HardCase *of, Mesh *mesh, Message *message)
{
    const double size = of->size > 0 ? of->size : 1;
    switch (of->shape) {
    case HARD_TEAPOT:
        return mesh_teapot(mesh, size, 10, message);
    case HARD_QUAD:
        return mesh_quad(mesh, 1, message);
    case HARD_CUBE:
        return mesh_cube(mesh, 0.5, message);
    case HARD_RING:
        return mesh_torus(mesh, 0.3, 0.65, 24, 48, message);
    default:
        return mesh_sphere(mesh, size, of->slices, of->stacks, message);
    }
}

static Mat4 placed(HardBox box)
{
    return mat4_product(mat4_translate(box.at), mat4_scale(box.size));
}

/* The light casts shadows, on a square floor at this height too. */
static bool put_floor(HardScene *made, double height, Message *message)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    made->lights[0].shadows = true;
    made->objects[0].front.specular = (Vec3){0.2, 0.2, 0.2};
    made->objects[1] = made->objects[0];
    made->objects[1].mesh = &made->floor;
    made->objects[1].solid = (Solid){.kind = SOLID_QUAD};
    made->objects[1].flat = true;
    made->objects[1].front.ambient = made->objects[1].front.diffuse = (Vec3){0.55, 0.6, 0.7};
    made->objects[1].front.specular = (Vec3){0, 0, 0};
    made->objects[1].world_from_object =
        mat4_product(placed((HardBox){{0, height, 0}, {2.5, 1, 2.5}}), lying);
    made->scene.object_count = 2;
    made->scene.camera.eye = (Vec3){0, 2.4, 5};
    made->scene.camera.center = (Vec3){0, -0.1, 0};
    made->scene.camera.fovy = 38;
    return mesh_quad(&made->floor, 1, message);
}

/* Known by their faces, none of which hides the light from another; of one material. */
static void put_boxes(HardScene *made, const HardBox boxes[2])
{
    made->objects[0].world_from_object = placed(boxes[0]);
    made->objects[0].solid = (Solid){.kind = SOLID_BOX, .radius = 0.5};
    made->objects[0].closed = made->objects[0].flat = true;
    if (boxes[1].size.x > 0) {
        made->objects[2] = made->objects[0];
        made->objects[2].world_from_object = placed(boxes[1]);
        made->scene.object_count = 3;
    }
}

static bool is_given(Vec3 v)
{
    return vec3_length(v) > 0;
}

bool hard_scene_open(HardScene *made, const HardCase *of, Message *message)
{
    memset(made, 0, sizeof *made);
    begin(made);
    if (!open_mesh(of, &made->mesh, message) ||
        (of->floor != 0 && !put_floor(made, of->floor, message)))
        return false;
    if (of->fovy > 0)
        made->scene.camera.fovy = of->fovy;
    if (is_given(of->light))
        made->lights[0].position = of->light;
    if (is_given(of->scale))
        made->objects[0].world_from_object = mat4_scale(of->scale);
    if (of->shape == HARD_CUBE)
        put_boxes(made, of->boxes);
    if (of->make)
        of->make(made);
    made->naive = made->scene;
    made->naive.objects = made->naive_objects;
    memcpy(made->naive_objects, made->objects, sizeof made->objects);
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
