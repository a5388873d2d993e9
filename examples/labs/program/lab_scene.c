/* What the scenes of all labs are made of: shapes, lights, materials. */
#include "labs/program/lab_scene.h"

#include "core/example.h"
#include "shapes/mesh_solids.h"

#include <string.h>

const char *const LAB_SCENE_NAMES[LAB_SCENE_KIND_COUNT] = {"A", "B", "C", "D", "E",
                                                           "F", "G", "H", "I"};

const Vec3 LAB_AXIS = {1, 2, 0.5}, LAB_SCALE = {2, 0.7, 1.2};

void lab_scene_world_parts(double seconds, Mat4 *move, Mat4 *turn, Mat4 *scale)
{
    *move = mat4_translate((Vec3){0.5, 0.3, -0.8});
    *turn = mat4_rotate(DEGREES_PER_SECOND * seconds, LAB_AXIS);
    *scale = mat4_scale(LAB_SCALE);
}

Mat4 lab_scene_world(double seconds)
{
    Mat4 move, turn, scale;
    lab_scene_world_parts(seconds, &move, &turn, &scale);
    return mat4_product(move, mat4_product(turn, scale));
}

static Material matte(Vec3 color)
{
    return (Material){.ambient = color, .diffuse = color, .alpha = 1};
}

static bool open_tube(Mesh *mesh, Message *message)
{
    if (!mesh_cylinder(mesh, (MeshCylinder){0.9, 1.6, 12, 1, MESH_CAP_NONE}, message))
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].position[2] -= 0.8F;
    if (mesh_flatten(mesh, message))
        return true;
    mesh_close(mesh);
    return false;
}

static bool open_cube_on_corner(Mesh *mesh, Message *message)
{
    const Mat4 turn =
        mat4_product(mat4_rotate(35, (Vec3){1, 0, 0}), mat4_rotate(45, (Vec3){0, 0, 1}));
    if (!mesh_cube(mesh, 1, message))
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        MeshVertex *vertex = &mesh->vertices[i];
        vec3_to_float(mat4_transform_point(turn, vec3_from_float(vertex->position)),
                      vertex->position);
        vec3_to_float(mat4_transform_direction(turn, vec3_from_float(vertex->normal)),
                      vertex->normal);
    }
    return true;
}

static bool open_shape(Mesh *mesh, LabShape shape, Message *message)
{
    switch (shape) {
    case SHAPE_OF_CUBE:
        return mesh_cube(mesh, 1, message);
    case SHAPE_OF_CUBE_ON_CORNER:
        return open_cube_on_corner(mesh, message);
    case SHAPE_OF_ICOSAHEDRON:
        return mesh_regular(mesh, MESH_ICOSAHEDRON, 1.3, message);
    case SHAPE_OF_DODECAHEDRON:
        return mesh_regular(mesh, MESH_DODECAHEDRON, 1.3, message);
    case SHAPE_OF_OCTAHEDRON:
        return mesh_regular(mesh, MESH_OCTAHEDRON, 1.4, message);
    case SHAPE_OF_QUAD:
        return mesh_quad(mesh, 1, message);
    case SHAPE_OF_TUBE:
        return open_tube(mesh, message);
    case SHAPE_OF_BALL:
        return mesh_sphere(mesh, 1.2, 20, 16, message);
    case SHAPE_OF_COARSE_BALL:
        return mesh_sphere(mesh, 1.2, 8, 6, message);
    case SHAPE_OF_SPHERE:
        return mesh_sphere(mesh, 1, 64, 64, message);
    default: /* SHAPE_OF_TORUS */
        return mesh_torus(mesh, 0.45, 0.9, 10, 18, message);
    }
}

bool lab_scene_add_object(LabScene *lab_scene, LabShape shape, Mat4 world_from_object,
                          Message *message)
{
    const int i = lab_scene->scene.object_count;
    if (!open_shape(&lab_scene->meshes[i], shape, message))
        return false;
    const bool open = shape == SHAPE_OF_QUAD || shape == SHAPE_OF_TUBE;
    lab_scene->objects[i] = (Object){.mesh = &lab_scene->meshes[i],
                                     .flat = shape < SHAPE_OF_BALL,
                                     .closed = !open,
                                     .world_from_object = world_from_object};
    if (shape == SHAPE_OF_SPHERE)
        lab_scene->objects[i].solid = (Solid){.kind = SOLID_SPHERE, .radius = 1};
    lab_scene->scene.object_count++;
    return true;
}

void lab_scene_begin(LabScene *lab_scene, const Lab *lab, LabSceneKind kind)
{
    *lab_scene = (LabScene){.kind = kind, .known = true, .width = 96, .height = 96};
    lab_scene->scene = (Scene){
        .camera = {.eye = {0, 0, 6}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 100},
        .global_ambient = lab->ambient ? (Vec3){0.2, 0.2, 0.2} : (Vec3){0, 0, 0},
        .lights = lab_scene->lights,
        .objects = lab_scene->objects,
        .light_count = lab->lights,
        .reflection = lab->reflection,
    };
    for (int i = 0; i < lab->lights; i++)
        lab_scene->lights[i] = (Light){.kind = lab->light, .shadows = lab->shadow};
    for (int i = 0; i < lab->uniform_count; i++)
        memcpy(lab_scene->own[i], lab->uniforms[i].value, sizeof lab_scene->own[i]);
}

void lab_scene_set_light(LabScene *lab_scene, int i, Vec3 place, Vec3 color)
{
    Light *light = &lab_scene->lights[i];
    if (light->kind == LIGHT_DIRECTIONAL)
        light->direction = place;
    else
        light->position = place;
    light->diffuse = light->specular = color;
}

void lab_scene_set_spot(LabScene *lab_scene, Vec3 at, double cutoff, double exponent)
{
    Light *light = &lab_scene->lights[0];
    light->direction = vec3_subtract(at, light->position);
    light->cutoff = cutoff;
    light->exponent = exponent;
}

void lab_scene_set_material(LabScene *lab_scene, const Lab *lab, int i, const LabSurface *surface)
{
    Object *object = &lab_scene->objects[i];
    object->front = matte(surface->color);
    if (lab->specular) {
        object->front.specular = surface->specular;
        object->front.shininess = surface->shininess;
    }
    if (lab->fitted)
        lab_scene->fitted[i] = material_fitted_shininess(surface->shininess);
    object->two_sided = lab->two_sided;
    object->back = matte(surface->back);
}

void lab_scene_close(LabScene *lab_scene)
{
    if (!lab_scene)
        return;
    for (int i = 0; i < LAB_SCENE_MAX_OBJECTS; i++)
        mesh_close(&lab_scene->meshes[i]);
    *lab_scene = (LabScene){.width = 0};
}
