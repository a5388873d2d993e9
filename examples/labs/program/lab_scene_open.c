/* A scene of a seed is made of random numbers in an order that never changes, so that a seed's
 * scenes stay what they are; ranges keep out what would show nothing (a light that reaches no face
 * that is seen) or what has no one right picture (normals of other lengths, grazing light). */
#include "labs/program/lab_scene_open.h"

#include "labs/program/lab_scene_parts.h"
#include "scene/scene_example.h"

#include <math.h>

/* Of LAB_SCENE_HUGE: squared distances then exceed the largest 16-bit float, 65504. */
static const double HUGE_FACTOR = 300;

static bool open_usual(LabScene *lab_scene, const Lab *lab, double seconds, Message *message)
{
    const LabOwnScene *usual = &lab->scene;
    const double scale = usual->scale;
    /* Lab 9's is mirrored in every second second. */
    const bool mirrored = lab->two_sided && fmod(floor(seconds), 2) != 0;
    Mat4 world = mat4_product(example_turned(seconds),
                              mat4_scale((Vec3){mirrored ? -scale : scale, scale, scale}));
    lab_scene->seconds = seconds;
    lab_scene->scene.camera.eye = usual->eye;
    lab_scene->scene.camera.center = usual->center;
    if (scale == 0)
        world = lab->given ? lab_scene_world(seconds) : mat4_identity();
    for (int i = 0; i < lab->lights; i++)
        lab_scene_set_light(lab_scene, i, usual->lights[i].place, usual->lights[i].color);
    if (lab->light == LIGHT_SPOT) {
        lab_scene_set_spot(lab_scene, usual->at, usual->cutoff, usual->exponent);
        lab_scene->lights[0].constant = usual->attenuation.x;
        lab_scene->lights[0].linear = usual->attenuation.y;
        lab_scene->lights[0].quadratic = usual->attenuation.z;
    }
    if (!lab_scene_add_object(lab_scene, usual->shape, world, message))
        return false;
    const LabSurface surface = {usual->color, {0.5, 0.5, 0.5}, {0.6, 0.6, 0.7}, usual->shininess};
    lab_scene_set_material(lab_scene, lab, 0, &surface);
    if (!lab->shadow)
        return true;
    lab_scene->objects[0].world_from_object = lab_scene_on_floor(&lab_scene->meshes[0], world);
    return lab_scene_add_floor(lab_scene, (Vec3){0.6, 0.75, 0.7}, message);
}

bool lab_scene_open_usual(LabScene *lab_scene, const Lab *lab, double seconds, Message *message)
{
    lab_scene_begin(lab_scene, lab, LAB_SCENE_PLAIN);
    if (open_usual(lab_scene, lab, seconds, message))
        return true;
    lab_scene_close(lab_scene);
    return false;
}

static LabShape choose_shape(const Lab *lab, LabSceneKind kind, int number, Random *random)
{
    const LabShape flat[] = {SHAPE_OF_CUBE, SHAPE_OF_ICOSAHEDRON, SHAPE_OF_DODECAHEDRON,
                             SHAPE_OF_OCTAHEDRON};
    if (lab->given || lab->budget)
        return lab->given ? SHAPE_OF_CUBE_ON_CORNER : SHAPE_OF_SPHERE;
    if (lab->two_sided)
        return kind == LAB_SCENE_PLAIN || kind == LAB_SCENE_COARSE || kind == LAB_SCENE_HUGE ||
                       number == 1
                   ? SHAPE_OF_TUBE /* part of it is always lit */
                   : SHAPE_OF_QUAD;
    if (lab->flat)
        return kind == LAB_SCENE_COARSE ? SHAPE_OF_DODECAHEDRON
                                        : flat[(int)random_between(random, 0, 3.999)];
    if (kind == LAB_SCENE_COARSE)
        return SHAPE_OF_COARSE_BALL;
    if (kind == LAB_SCENE_MOVED || number == 1)
        return flat[(int)random_between(random, 0, 3.999)];
    return random_chance(random) ? SHAPE_OF_BALL : SHAPE_OF_TORUS;
}

/* Always turned, so that several faces show; scaled if the lab scales, but curved shapes evenly:
 * their normals stay equally long, so normalizing them before interpolation makes no difference.
 * Never so large or far that the object leaves the picture. */
static Mat4 choose_world(const Lab *lab, LabSceneKind kind, bool flat, double seconds,
                         Random *random)
{
    Vec3 factors = {1, 1, 1}, offset = {0, 0, 0};
    Vec3 axis = random_direction(random);
    const double degrees = random_signed(random, 35, 145);
    const double first = random_between(random, 0.5, 0.75), second = random_between(random, 1, 1.3);
    const double third = random_between(random, 0.75, 1);
    const int turn = (int)random_between(random, 0, 2.999);
    offset.x = random_signed(random, 0.2, 0.45);
    offset.y = random_signed(random, 0.2, 0.45);
    offset.z = random_signed(random, 0.2, 0.6);
    if (lab->given)
        return lab_scene_world(seconds);
    if (lab->budget)
        return mat4_identity();
    if (!lab->rigid && !flat)
        factors = (Vec3){third, third, third};
    else if (!lab->rigid)
        factors = turn == 0   ? (Vec3){first, second, third}
                  : turn == 1 ? (Vec3){third, first, second}
                              : (Vec3){second, third, first};
    if (lab->two_sided &&
        (kind == LAB_SCENE_MOVED || kind == LAB_SCENE_BEHIND || kind == LAB_SCENE_WIDE))
        factors.x = -factors.x;
    return mat4_product(mat4_translate(offset),
                        mat4_product(mat4_rotate(degrees, axis), mat4_scale(factors)));
}

/* The direction from the object to the eye. */
static Vec3 choose_view(LabSceneKind kind, Random *random)
{
    const double spread = kind == LAB_SCENE_PLAIN ? 20 : 60;
    if (kind == LAB_SCENE_ALONG || kind == LAB_SCENE_AGAINST)
        return (Vec3){0, 0, 1};
    return random_near(random, (Vec3){0, 0.2, 1}, 5, spread);
}

/* In C, except in lab 10, light goes beyond 1: what clamps it before it meets the colour is wrong.
 */
static bool is_strong(const LabScene *lab_scene, const Lab *lab)
{
    return lab_scene->kind == LAB_SCENE_COARSE && !lab->budget && !lab->given;
}

static void choose_lights(LabScene *lab_scene, const Lab *lab, Vec3 view, Random *random)
{
    const Vec3 origin = {0, 0, 0};
    Vec3 first = origin;
    const double share = lab_scene->kind == LAB_SCENE_CROWD ? 0.85 : 0.8;
    for (int i = 0; i < lab->lights; i++) {
        /* From the side, for light and shade; or from behind. */
        const bool behind =
            lab_scene->kind == LAB_SCENE_BEHIND && (i == 0 || random_chance(random) || lab->flat);
        /* In C the first light is near the eye: there half vectors have nearly length 1. */
        const bool beside =
            lab_scene->kind == LAB_SCENE_ALONG || (lab_scene->kind == LAB_SCENE_COARSE && i == 0);
        const bool beyond = lab_scene->kind == LAB_SCENE_AGAINST;
        const double max_behind = lab->budget ? 170 : 140;
        /* Beside the first one: faces that no light reaches show. */
        const bool same = behind && lab->flat && i > 0;
        const Vec3 towards = same ? random_near(random, first, 5, 30)
                             : behind
                                 ? random_near(random, view, lab->budget ? 155 : 105, max_behind)
                             : beyond ? random_near(random, vec3_scale(view, -1), 8, 22)
                             : beside ? random_near(random, view, 8, 22)
                                      : random_near(random, view, 25, 75);
        first = i == 0 ? towards : first;
        const double distance = lab_scene->kind == LAB_SCENE_WIDE
                                    ? random_between(random, 1.9, 2.3)
                                    : random_between(random, 2.4, 4.5);
        const double max = i == 0 ? 0.65 * share : 0.45 * share;
        const bool strong = is_strong(lab_scene, lab);
        const double most = lab->lights > 1 ? max : share;
        lab_scene_set_light(lab_scene, i, vec3_scale(towards, distance),
                            random_color(random, (strong ? 0.7 : 0.35) * most, most));
    }
    if (lab->light != LIGHT_SPOT)
        return;
    Light *light = &lab_scene->lights[0];
    /* A wide cone is aimed past the object, so that its edge is on it. */
    const bool wide = lab_scene->kind == LAB_SCENE_CROWD || lab_scene->kind == LAB_SCENE_WIDE;
    const Vec3 aside = vec3_scale(random_direction(random), wide ? 0.9 : 0.25);
    light->diffuse = light->specular = vec3_scale(light->diffuse, 1.35);
    const double exponent = random_between(random, 3, 12);
    const double cutoff = wide ? random_between(random, 26, 40) : random_between(random, 14, 24);
    lab_scene_set_spot(lab_scene, vec3_add(origin, aside), cutoff, exponent);
    light->constant = random_between(random, 0.5, 0.8);
    light->linear = random_between(random, 0.05, 0.15);
    light->quadratic = random_between(random, 0.02, 0.06);
}

static double choose_shininess(LabSceneKind kind, const Lab *lab, Random *random)
{
    static const double min[LAB_SCENE_KIND_COUNT] = {12, 8, 26, 2, 14, 8, 10, 8, 2};
    static const double max[LAB_SCENE_KIND_COUNT] = {24, 14, 30, 4, 24, 14, 16, 10, 3};
    if (lab->budget)
        return random_between(random, 24, 32);
    /* From Phong's 8 on (Blinn-Phong's 33) 4 times the exponent fits nearly as well; not below. */
    if (lab->fitted && kind == LAB_SCENE_BEHIND)
        return random_between(random, 8, 10);
    return random_between(random, min[kind], max[kind]);
}

static void choose_size(LabScene *lab_scene, Random *random)
{
    static const int sizes[] = {64, 72, 80, 96};
    const int size = sizes[(int)random_between(random, 0, 3.999)];
    lab_scene->width = lab_scene->kind == LAB_SCENE_WIDE ? 128 : size;
    lab_scene->height = lab_scene->kind == LAB_SCENE_WIDE ? 64 : size;
}

static void enlarge(LabScene *lab_scene)
{
    const double k = HUGE_FACTOR;
    Scene *scene = &lab_scene->scene;
    Camera *camera = &scene->camera;
    camera->eye = vec3_scale(camera->eye, k);
    camera->center = vec3_scale(camera->center, k);
    camera->near *= k;
    camera->far *= k;
    for (int i = 0; i < scene->object_count; i++)
        lab_scene->objects[i].world_from_object =
            mat4_product(mat4_scale((Vec3){k, k, k}), lab_scene->objects[i].world_from_object);
    for (int i = 0; i < scene->light_count; i++) {
        lab_scene->lights[i].position = vec3_scale(lab_scene->lights[i].position, k);
        lab_scene->lights[i].linear /= k;
        lab_scene->lights[i].quadratic /= k * k;
    }
}

/* Moves the eye to the world's origin, and everything with it. */
static void look_from_origin(LabScene *lab_scene)
{
    Scene *scene = &lab_scene->scene;
    Camera *camera = &scene->camera;
    const Vec3 way = vec3_scale(camera->eye, -1);
    camera->eye = (Vec3){0, 0, 0};
    camera->center = vec3_add(camera->center, way);
    for (int i = 0; i < scene->object_count; i++)
        lab_scene->objects[i].world_from_object =
            mat4_product(mat4_translate(way), lab_scene->objects[i].world_from_object);
    for (int i = 0; i < scene->light_count; i++)
        lab_scene->lights[i].position = vec3_add(lab_scene->lights[i].position, way);
}

/* The camera, the lights and the objects of all labs but lab 11. */
static bool choose_scene(LabScene *lab_scene, const Lab *lab, Random *random, Message *message)
{
    const LabSceneKind kind = lab_scene->kind;
    Scene *scene = &lab_scene->scene;
    const int count = kind == LAB_SCENE_CROWD && !lab->given && !lab->budget ? 2 : 1;
    const Vec3 view = choose_view(kind, random);
    const double distance = lab->given ? 12.5 : lab->budget ? 6 : kind == LAB_SCENE_CROWD ? 8.5 : 7;
    scene->camera.center = lab->budget  ? (Vec3){0, 0, 0}
                           : lab->given ? (Vec3){0.5, 0.3, -0.8}
                                        : (Vec3){0.05, -0.05, 0.1};
    scene->camera.eye = vec3_add(scene->camera.center, vec3_scale(view, distance));
    scene->camera.fovy = random_between(random, 27, 31);
    if (lab->ambient)
        scene->global_ambient = random_color(random, 0.1, 0.25);
    choose_lights(lab_scene, lab, view, random);
    for (int i = 0; i < count; i++) {
        const LabShape shape = choose_shape(lab, kind, i, random);
        Mat4 world = choose_world(lab, kind, shape < SHAPE_OF_BALL, lab_scene->seconds, random);
        /* The second is behind the first and partly beside it. */
        if (i == 1)
            world = mat4_product(
                mat4_translate(vec3_add(vec3_scale(view, -1.6), (Vec3){0.9, 0.35, 0})), world);
        if (!lab_scene_add_object(lab_scene, shape, world, message))
            return false;
        const bool strong = is_strong(lab_scene, lab);
        LabSurface surface;
        surface.color = random_color(random, strong ? 0.25 : 0.35, strong ? 0.5 : 0.95);
        surface.specular = random_color(random, strong ? 0.12 : 0.25, strong ? 0.24 : 0.5);
        surface.shininess = choose_shininess(kind, lab, random);
        surface.back = random_color(random, 0.3, 0.95);
        lab_scene_set_material(lab_scene, lab, i, &surface);
    }
    return true;
}

static bool open_random(LabScene *lab_scene, const Lab *lab, Random *random, Message *message)
{
    const LabSceneKind kind = lab_scene->kind;
    choose_size(lab_scene, random);
    lab_scene->seconds = floor(random_between(random, 1, 12) * 8) / 8;
    if (lab->shadow ? !lab_scene_choose_shadow(lab_scene, random, message)
                    : !choose_scene(lab_scene, lab, random, message))
        return false;
    if (is_strong(lab_scene, lab))
        lab_scene_overexpose_light(lab_scene, lab);
    if (kind == LAB_SCENE_WIDE && !lab->budget && !lab->given)
        lab_scene_overexpose_picture(lab_scene);
    if (kind == LAB_SCENE_HUGE && !lab->given && !lab->budget)
        enlarge(lab_scene);
    if (kind == LAB_SCENE_ALONG && !lab->budget)
        look_from_origin(lab_scene);
    for (int i = 0; i < lab->uniform_count; i++)
        for (int c = 0; c < lab->uniforms[i].size; c++)
            lab_scene->own[i][c] =
                random_between(random, lab->uniforms[i].min[c], lab->uniforms[i].max[c]);
    return true;
}

static bool open_numbers(LabScene *lab_scene, const Lab *lab, LabSceneKind kind, uint64_t seed,
                         Message *message)
{
    Random random = {seed * 1000003 + (uint64_t)lab->number * 1009 + (uint64_t)kind * 31 + 7};
    lab_scene_begin(lab_scene, lab, kind);
    if (open_random(lab_scene, lab, &random, message))
        return true;
    lab_scene_close(lab_scene);
    return false;
}

bool lab_scene_open_known(LabScene *lab_scene, const Lab *lab, LabSceneKind kind, Message *message)
{
    if (kind == LAB_SCENE_PLAIN)
        return lab_scene_open_usual(lab_scene, lab, 1, message);
    return open_numbers(lab_scene, lab, kind, 0x4C616273, message);
}

bool lab_scene_open_seed(LabScene *lab_scene, const Lab *lab, LabSceneKind kind, uint64_t seed,
                         Message *message)
{
    const bool opened = open_numbers(lab_scene, lab, kind, seed ^ 0x5EED000000000000u, message);
    lab_scene->known = false;
    return opened;
}
