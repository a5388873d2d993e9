/*
 * The cases of shadows: what casts them, and where the plain way fails.
 */
#include "study/cases/hard_case.h"

#include "shapes/mesh_solids.h"

static Mat4 placed(Vec3 at, Vec3 size)
{
    return mat4_product(mat4_translate(at), mat4_scale(size));
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
        mat4_product(placed((Vec3){0, height, 0}, (Vec3){2.5, 1, 2.5}), lying);
    made->scene.object_count = 2;
    made->scene.camera.eye = (Vec3){0, 2.4, 5};
    made->scene.camera.center = (Vec3){0, -0.1, 0};
    made->scene.camera.fovy = 38;
    return mesh_quad(&made->floor, 1, message);
}

/* A box of this size; known by its faces, none of which hides the light from another. */
static bool put_box(HardScene *made, Vec3 at, Vec3 size, Message *message)
{
    made->objects[0].world_from_object = placed(at, size);
    made->objects[0].solid = (Solid){.kind = SOLID_BOX, .radius = 0.5};
    made->objects[0].closed = made->objects[0].flat = true;
    return mesh_cube(&made->mesh, 0.5, message);
}

/* Another box, of the same material. */
static void put_second(HardScene *made, Vec3 at, Vec3 size)
{
    made->objects[2] = made->objects[0];
    made->objects[2].world_from_object = placed(at, size);
    made->scene.object_count = 3;
}

/* A teapot in light that grazes the floor. The floor is any mesh, not known to be flat, and so in
 * the map, too. */
static bool make_acne(HardScene *made, Message *message)
{
    if (!put_floor(made, -0.65, message))
        return false;
    made->lights[0].kind = LIGHT_DIRECTIONAL;
    made->lights[0].direction = (Vec3){-1, 0.2, 0.35};
    made->objects[1].solid = (Solid){.kind = SOLID_NONE};
    return mesh_teapot(&made->mesh, 0.8, 10, message);
}

/* A plate that stands on the floor. */
static bool make_panning(HardScene *made, Message *message)
{
    made->lights[0].position = (Vec3){-1.6, 3, -3.5};
    return put_floor(made, -0.6, message) &&
           put_box(made, (Vec3){-0.2, 0, -0.5}, (Vec3){1.8, 1.2, 0.08}, message);
}

/* Two boxes, with a slit between them. */
static bool make_slit(HardScene *made, Message *message)
{
    made->lights[0].position = (Vec3){0, 3, -2.2};
    if (!put_floor(made, -0.6, message) ||
        !put_box(made, (Vec3){-0.54, -0.1, -0.4}, (Vec3){1, 1, 0.5}, message))
        return false;
    put_second(made, (Vec3){0.54, -0.1, -0.4}, (Vec3){1, 1, 0.5});
    made->scene.camera.eye = (Vec3){1.6, 3, 4.4};
    return true;
}

/* A roof over the eye, and a box on the floor, partly in its shadow. */
static bool make_roof(HardScene *made, Message *message)
{
    made->lights[0].position = (Vec3){-1.5, 6, 2.5};
    if (!put_floor(made, -0.6, message) ||
        !put_box(made, (Vec3){0, 3, 3.4}, (Vec3){3.2, 0.1, 3.4}, message))
        return false;
    put_second(made, (Vec3){0.3, -0.15, 0.6}, (Vec3){0.9, 0.9, 0.9});
    return true;
}

/* A plate behind the eye, and a light behind that: the shadow goes forward, beyond the far plane,
 * which is right behind the floor. */
static bool make_far_plane(HardScene *made, Message *message)
{
    made->lights[0].position = (Vec3){0, 5.5, 10};
    if (!put_floor(made, -0.6, message) ||
        !put_box(made, (Vec3){0, 3.23, 6.5}, (Vec3){0.9, 0.66, 0.02}, message))
        return false;
    put_second(made, (Vec3){1, -0.15, -0.2}, (Vec3){0.9, 0.9, 0.9});
    made->scene.camera.far = 8.5;
    return true;
}

static bool make_terminator(HardScene *made, Message *message)
{
    made->lights[0].position = (Vec3){-3, 1.3, 1.4};
    if (!put_floor(made, -0.9, message))
        return false;
    made->scene.camera.fovy = 26;
    made->objects[0].solid = (Solid){.kind = SOLID_SPHERE, .radius = 0.9};
    made->objects[0].closed = true;
    return mesh_sphere(&made->mesh, 0.9, 8, 5, message);
}

static void spoil_solid(HardScene *made)
{
    made->naive_objects[0].solid = (Solid){.kind = SOLID_NONE};
}

/* A teapot on the floor, a million units from the origin. */
static bool make_distant(HardScene *made, Message *message)
{
    static const Vec3 offset = {1000000.3, 300000.7, -1000000.1};
    Camera *camera = &made->scene.camera;
    if (!put_floor(made, -0.65, message))
        return false;
    for (int i = 0; i < 2; i++)
        made->objects[i].world_from_object =
            mat4_product(mat4_translate(offset), made->objects[i].world_from_object);
    made->lights[0].position = vec3_add((Vec3){-2, 2.6, 2}, offset);
    camera->eye = vec3_add(camera->eye, offset);
    camera->center = vec3_add(camera->center, offset);
    return mesh_teapot(&made->mesh, 0.8, 10, message);
}

/* An open square, leaning: its front is turned to the light. */
static bool make_sheet(HardScene *made, Message *message)
{
    made->lights[0].position = (Vec3){-3, 3, 2};
    if (!put_floor(made, -0.7, message))
        return false;
    made->objects[0].two_sided = true;
    made->objects[0].back = made->objects[0].front;
    made->objects[0].world_from_object =
        mat4_product(mat4_rotate(-50, (Vec3){1, 0.4, 0}), mat4_scale((Vec3){0.8, 0.8, 0.8}));
    return mesh_quad(&made->mesh, 1, message);
}

static bool make_mirrored(HardScene *made, Message *message)
{
    made->lights[0].position = (Vec3){-3, 3, 2};
    made->objects[0].world_from_object = mat4_scale((Vec3){-1, 1, 1});
    made->objects[0].closed = true;
    const bool done = put_floor(made, -0.7, message);
    return done && mesh_torus(&made->mesh, 0.3, 0.65, 24, 48, message);
}

const HardCase HARD_SHADOWS[HARD_SHADOW_COUNT] = {
    {"acne", "a shadow map in grazing light: a texel is one depth", "map of 256, no bias",
     "volumes", make_acne, .shadows = {SHADOWS_MAP, 256, 0, {0, 0, 0}}},
    {"peter-panning", "a shadow map with a large bias: the shadow leaves its plate",
     "map of 128, bias 24", "volumes", make_panning, .shadows = {SHADOWS_MAP, 128, 0, {24, 0, 0}}},
    {"slit", "light through a slit that is narrower than a map's texel", "map of 32", "volumes",
     make_slit, .shadows = {SHADOWS_MAP, 32, 0, {1, 1.5, 0}}},
    {"eye-in-shadow", "the eye in a shadow volume: under a roof", "counted before surfaces",
     "counted behind them", make_roof, .depth_pass = true},
    {"far-plane", "a shadow volume that goes on beyond the far plane", "cut off there",
     "projected without it", make_far_plane,
     .replaced = {{"shadow.vert", "study/shadow_far_plane.vert"}}},
    {"terminator", "a coarse sphere with smooth normals, in its own shadow", "that of its facets",
     "convex: by N.L alone", make_terminator, .spoil = spoil_solid},
    {"far-shadow", "what casts the shadow is a million units from the origin",
     "float, view x model", "relative to the eye", make_distant, .transforms = naive_float_lecture},
    {"sheet", "an open sheet, and a map of back faces, which needs no bias",
     "back faces in the map", "volumes, open or closed", make_sheet,
     .replaced = {{"shadow.frag", "study/shadow_back_faces.frag"}},
     .shadows = {SHADOWS_MAP, 1024, 0, {0, 0, 0}}},
    {"turned", "a mirrored ring, and a map of back faces: they are its front",
     "back faces in the map", "volumes, mirrored or not", make_mirrored,
     .replaced = {{"shadow.frag", "study/shadow_back_faces.frag"}},
     .shadows = {SHADOWS_MAP, 1024, 0, {0, 0, 0}}},
};
