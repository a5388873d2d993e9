/*
 * The cases of shadows: what casts them, and where the plain way fails.
 */
#include "study/cases/hard_case.h"

/* A teapot in light that grazes the floor. The floor is any mesh, not known to be flat, and so in
 * the map, too. */
static void make_acne(HardScene *made)
{
    made->lights[0].kind = LIGHT_DIRECTIONAL;
    made->lights[0].direction = (Vec3){-1, 0.2, 0.35};
    made->objects[1].solid = (Solid){.kind = SOLID_NONE};
}

static void make_slit(HardScene *made)
{
    made->scene.camera.eye = (Vec3){1.6, 3, 4.4};
}

/* The shadow of a plate behind the eye goes forward, beyond the far plane, which is right behind
 * the floor. */
static void make_far_plane(HardScene *made)
{
    made->scene.camera.far = 8.5;
}

static void make_terminator(HardScene *made)
{
    made->objects[0].solid = (Solid){.kind = SOLID_SPHERE, .radius = 0.9};
    made->objects[0].closed = true;
}

static void spoil_solid(HardScene *made)
{
    made->naive_objects[0].solid = (Solid){.kind = SOLID_NONE};
}

/* A million units from the origin. */
static void make_distant(HardScene *made)
{
    static const Vec3 offset = {1000000.3, 300000.7, -1000000.1};
    Camera *camera = &made->scene.camera;
    for (int i = 0; i < 2; i++)
        made->objects[i].world_from_object =
            mat4_product(mat4_translate(offset), made->objects[i].world_from_object);
    made->lights[0].position = vec3_add(made->lights[0].position, offset);
    camera->eye = vec3_add(camera->eye, offset);
    camera->center = vec3_add(camera->center, offset);
}

/* An open square, leaning: its front is turned to the light. */
static void make_sheet(HardScene *made)
{
    made->objects[0].two_sided = true;
    made->objects[0].back = made->objects[0].front;
    made->objects[0].world_from_object =
        mat4_product(mat4_rotate(-50, (Vec3){1, 0.4, 0}), made->objects[0].world_from_object);
}

static void make_mirrored(HardScene *made)
{
    made->objects[0].closed = made->objects[1].closed = true;
}

/* At a corner of the box, turned. */
static void make_lamp(HardScene *made)
{
    Mat4 *box = &made->objects[0].world_from_object;
    *box = mat4_product(mat4_rotate(35, (Vec3){0.1, 1, 0}), *box);
    made->lights[0].position = mat4_transform_point(*box, (Vec3){0.5, 0.5, 0.5});
}

const HardCase HARD_SHADOWS[HARD_SHADOW_COUNT] = {
    {"acne", "a shadow map in grazing light: a texel is one depth", "map of 256, no bias",
     "volumes", .shape = HARD_TEAPOT, .size = 0.8, .floor = -0.65, .make = make_acne,
     .shadows = {SHADOWS_MAP, 256, 0, {0, 0, 0}}},
    {"peter-panning", "a shadow map with a large bias: the shadow leaves its plate",
     "map of 128, bias 24", "volumes", .shape = HARD_CUBE,
     .boxes = {{{-0.2, 0, -0.5}, {1.8, 1.2, 0.08}}}, .floor = -0.6, .light = {-1.6, 3, -3.5},
     .shadows = {SHADOWS_MAP, 128, 0, {24, 0, 0}}},
    {"slit", "light through a slit that is narrower than a map's texel", "map of 32", "volumes",
     .shape = HARD_CUBE,
     .boxes = {{{-0.54, -0.1, -0.4}, {1, 1, 0.5}}, {{0.54, -0.1, -0.4}, {1, 1, 0.5}}},
     .floor = -0.6, .light = {0, 3, -2.2}, .make = make_slit,
     .shadows = {SHADOWS_MAP, 32, 0, {1, 1.5, 0}}},
    {"eye-in-shadow", "the eye in a shadow volume: under a roof", "counted before surfaces",
     "counted behind them", .shape = HARD_CUBE,
     .boxes = {{{0, 3, 3.4}, {3.2, 0.1, 3.4}}, {{0.3, -0.15, 0.6}, {0.9, 0.9, 0.9}}}, .floor = -0.6,
     .light = {-1.5, 6, 2.5}, .depth_pass = true},
    {"far-plane", "a shadow volume that goes on beyond the far plane", "cut off there",
     "projected without it", .shape = HARD_CUBE,
     .boxes = {{{0, 3.23, 6.5}, {0.9, 0.66, 0.02}}, {{1, -0.15, -0.2}, {0.9, 0.9, 0.9}}},
     .floor = -0.6, .light = {0, 5.5, 10}, .make = make_far_plane,
     .replaced = {{"shadow.vert", "study/shadow_far_plane.vert"}}},
    {"terminator", "a coarse sphere with smooth normals, in its own shadow", "that of its facets",
     "convex: by N.L alone", .size = 0.9, .slices = 8, .stacks = 5, .floor = -0.9, .fovy = 26,
     .light = {-3, 1.3, 1.4}, .make = make_terminator, .spoil = spoil_solid},
    {"far-shadow", "what casts the shadow is a million units from the origin",
     "float, view x model", "relative to the eye", .shape = HARD_TEAPOT, .size = 0.8,
     .floor = -0.65, .light = {-2, 2.6, 2}, .make = make_distant,
     .transforms = naive_float_lecture},
    {"sheet", "an open sheet, and a map of back faces, which needs no bias",
     "back faces in the map", "volumes, open or closed", .shape = HARD_QUAD,
     .scale = {0.8, 0.8, 0.8}, .floor = -0.7, .light = {-3, 3, 2}, .make = make_sheet,
     .replaced = {{"shadow.frag", "study/shadow_back_faces.frag"}},
     .shadows = {SHADOWS_MAP, 1024, 0, {0, 0, 0}}},
    {"turned", "a mirrored ring, and a map of back faces: they are its front",
     "back faces in the map", "volumes, mirrored or not", .shape = HARD_RING, .scale = {-1, 1, 1},
     .floor = -0.7, .light = {-3, 3, 2}, .make = make_mirrored,
     .replaced = {{"shadow.frag", "study/shadow_back_faces.frag"}},
     .shadows = {SHADOWS_MAP, 1024, 0, {0, 0, 0}}},
    {"lamp", "a light exactly at a vertex of what throws the shadow", "map of 32", "volumes",
     .shape = HARD_CUBE, .boxes = {{{0, -0.125, 0}, {1, 1, 1}}}, .floor = -0.75, .make = make_lamp,
     .shadows = {SHADOWS_MAP, 32, 0, {1, 1.5, 0}}},
};
