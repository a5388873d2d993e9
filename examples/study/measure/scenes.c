#include "study/measure/scenes.h"

#include "choose/cheapest_search.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const Vec3 Y = {0, 1, 0};

static void settle(StudyScene *made, int lights, int objects)
{
    made->scene.lights = made->lights;
    made->scene.light_count = lights;
    made->scene.objects = made->objects;
    made->scene.object_count = objects;
}

/* PointLightedSphere. */
static void lecture_sphere(StudyScene *made)
{
    made->lights[0] =
        (Light){.kind = LIGHT_POINT, .position = {5, 8, 7}, .diffuse = {0.8, 0.8, 0.8}};
    made->objects[0] = (Object){.solid = {.kind = SOLID_SPHERE, .radius = 1},
                                .closed = true,
                                .world_from_object = mat4_identity(),
                                .front = {.ambient = {1, 1, 1}, .diffuse = {1, 1, 1}, .alpha = 1}};
    made->scene.camera = (Camera){{0, 0, 6}, {0, 0, 0}, Y, 30, 1, 100, 0};
    made->scene.global_ambient = (Vec3){0.2, 0.2, 0.2};
    settle(made, 1, 1);
}

/* PointLightedCube. */
static void lecture_cube(StudyScene *made)
{
    made->lights[0] = (Light){.kind = LIGHT_POINT, .position = {2.3, 4, 3.5}, .diffuse = {1, 1, 1}};
    made->objects[0] = (Object){.solid = {.kind = SOLID_BOX, .radius = 2},
                                .flat = true,
                                .closed = true,
                                .world_from_object = mat4_identity(),
                                .front = {.ambient = {1, 0, 0}, .diffuse = {1, 0, 0}, .alpha = 1}};
    made->scene.camera = (Camera){{6, 6, 14}, {0, 0, 0}, Y, 30, 1, 100, 0};
    made->scene.global_ambient = (Vec3){0.2, 0.2, 0.2};
    settle(made, 1, 1);
}

void study_shiny(StudyScene *made, double shininess, Reflection reflection)
{
    memset(made, 0, sizeof *made);
    made->lights[0] = (Light){.kind = LIGHT_POINT,
                              .position = {2.5, 3, 4},
                              .ambient = {0.1, 0.1, 0.1},
                              .diffuse = {1, 1, 1},
                              .specular = {1, 1, 1}};
    made->objects[0] = (Object){.solid = {.kind = SOLID_SPHERE, .radius = 1},
                                .closed = true,
                                .world_from_object = mat4_identity(),
                                .front = {.ambient = {0.3, 0.25, 0.1},
                                          .diffuse = {0.4, 0.32, 0.12},
                                          .specular = {0.55, 0.55, 0.55},
                                          .alpha = 1,
                                          .shininess = shininess}};
    made->scene.camera = (Camera){{0, 0, 6}, {0, 0, 0}, Y, 22, 1, 100, 0};
    made->scene.background = (Vec3){0.1, 0.1, 0.1};
    made->scene.reflection = reflection;
    settle(made, 1, 1);
}

static void shiny8(StudyScene *made)
{
    study_shiny(made, 8, REFLECTION_PHONG);
}

static void shiny32(StudyScene *made)
{
    study_shiny(made, 32, REFLECTION_PHONG);
}

static void shiny128(StudyScene *made)
{
    study_shiny(made, 128, REFLECTION_PHONG);
}

/* A square on the ground, lit from the side by a spot with a soft edge. */
static void spot(StudyScene *made)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    made->lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {-1.5, 2, 0.8},
                              .direction = {1.5, -2, -0.6},
                              .cutoff = 30,
                              .exponent = 40,
                              .constant = 0.5,
                              .quadratic = 0.1,
                              .diffuse = {1.5, 1.5, 1.3},
                              .specular = {1, 1, 0.9}};
    made->objects[0] =
        (Object){.solid = {.kind = SOLID_QUAD},
                 .flat = true,
                 .world_from_object = mat4_product(lying, mat4_scale((Vec3){2, 2, 1})),
                 .front = {.ambient = {0.6, 0.6, 0.7},
                           .diffuse = {0.6, 0.6, 0.7},
                           .specular = {0.4, 0.4, 0.4},
                           .alpha = 1,
                           .shininess = 20}};
    made->scene.camera = (Camera){{1.5, 3.5, 5}, {0, 0, 0}, Y, 40, 1, 100, 0};
    made->scene.global_ambient = (Vec3){0.25, 0.25, 0.25};
    made->scene.reflection = REFLECTION_PHONG;
    settle(made, 1, 1);
}

/* SpotLight from nearer: the hard edge of a cone on a sphere. */
static void spot_sphere(StudyScene *made)
{
    made->lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {0, 0, 1.5},
                              .direction = {0, 0, -1},
                              .cutoff = 30,
                              .diffuse = {1, 1, 1},
                              .specular = {1, 1, 1}};
    made->objects[0] = (Object){.solid = {.kind = SOLID_SPHERE, .radius = 1},
                                .closed = true,
                                .world_from_object = mat4_identity(),
                                .front = *material_find("silver")};
    made->scene.camera = (Camera){{3, 3, 3}, {0, 0, 0}, Y, 30, 1, 100, 0};
    made->scene.background = (Vec3){0.2, 0.2, 0.2};
    made->scene.global_ambient = (Vec3){0.3, 0.3, 0.3};
    made->scene.reflection = REFLECTION_PHONG;
    settle(made, 1, 1);
}

/* FourLights with a torus instead of the teapot: a dim light at the viewer, three coloured ones. */
static void four_lights(StudyScene *made)
{
    static const Vec3 eye = {0, 4, 7};
    static const Vec3 colors[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const Vec3 places[3] = {{2.5, 1.2, 0}, {-1.25, 1.2, -2.165}, {-1.25, 1.2, 2.165}};
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    made->lights[0] = (Light){.kind = LIGHT_POINT,
                              .position = eye,
                              .diffuse = {0.5, 0.5, 0.5},
                              .specular = {0.5, 0.5, 0.5}};
    made->objects[0] =
        (Object){.solid = {.kind = SOLID_DISC, .radius = 3},
                 .flat = true,
                 .world_from_object = lying,
                 .front = {.ambient = {0.8, 0.8, 0.8}, .diffuse = {0.8, 0.8, 0.8}, .alpha = 1}};
    made->objects[1] =
        (Object){.solid = {.kind = SOLID_TORUS, .radius = 0.9, .tube = 0.4},
                 .closed = true,
                 .world_from_object = mat4_product(mat4_translate((Vec3){0, 0.9, 0}), lying),
                 .front = {.ambient = {0.7, 0.7, 0.7},
                           .diffuse = {0.7, 0.7, 0.7},
                           .specular = {0.2, 0.2, 0.2},
                           .alpha = 1,
                           .shininess = 32}};
    for (int i = 0; i < 3; i++) {
        made->lights[1 + i] = (Light){.kind = LIGHT_POINT,
                                      .position = places[i],
                                      .ambient = vec3_scale(colors[i], 0.1),
                                      .diffuse = vec3_scale(colors[i], 0.5),
                                      .specular = vec3_scale(colors[i], 0.5)};
        made->objects[2 + i] = (Object){.solid = {.kind = SOLID_SPHERE, .radius = 0.12},
                                        .closed = true,
                                        .world_from_object = mat4_translate(places[i]),
                                        .front = {.emission = colors[i], .alpha = 1}};
    }
    made->scene.camera = (Camera){eye, {0, 0.3, 0}, Y, 40, 1, 100, 0};
    made->scene.global_ambient = (Vec3){0.15, 0.15, 0.15};
    settle(made, 4, 5);
}

/* ShadingModels with a teapot of gold. */
static void teapot(StudyScene *made)
{
    static const Vec3 places[2] = {{0, 1.5, 1.5}, {1.5, 1.5, 0}};
    for (int i = 0; i < 2; i++)
        made->lights[i] = (Light){.kind = LIGHT_POINT,
                                  .position = vec3_scale(places[i], 2),
                                  .ambient = {0.1, 0.1, 0.1},
                                  .diffuse = {0.8, 0.8, 0.8},
                                  .specular = {0.8, 0.8, 0.8}};
    made->objects[0] = (Object){.solid = {.kind = SOLID_TEAPOT, .radius = 1},
                                .world_from_object = mat4_identity(),
                                .front = *material_find("gold")};
    made->scene.camera = (Camera){{2, 2, 4}, {0, 0, 0}, Y, 35, 1, 100, 0};
    made->scene.background = (Vec3){0.2, 0.2, 0.2};
    settle(made, 2, 1);
}

/* four_lights with a teapot. */
static void teapot_lights(StudyScene *made)
{
    four_lights(made);
    made->objects[1].solid = (Solid){.kind = SOLID_TEAPOT, .radius = 1};
    made->objects[1].closed = false;
    made->objects[1].world_from_object = mat4_translate((Vec3){0, 0.75, 0});
}

/* shiny32, rotated and translated. Rotated, because along a coordinate axis the rounding errors of
 * the positions of eye and object are equal and cancel. */
static void far_away(StudyScene *made)
{
    static const Vec3 offset = {1000000.3, 200000.7, -500000.1};
    Mat4 turned;
    study_shiny(made, 32, REFLECTION_PHONG);
    turned = mat4_rotate(50, (Vec3){1, 2, 3});
    const Mat4 moved = mat4_product(mat4_translate(offset), turned);
    Camera *camera = &made->scene.camera;
    made->objects[0].world_from_object = moved;
    made->lights[0].position = mat4_transform_point(moved, made->lights[0].position);
    camera->eye = mat4_transform_point(moved, camera->eye);
    camera->center = mat4_transform_point(moved, camera->center);
    camera->up = mat4_transform_direction(moved, camera->up);
}

/* shiny32, 150 times as large: the sphere is 300 units wide. */
static void wide(StudyScene *made)
{
    static const double scale = 150;
    study_shiny(made, 32, REFLECTION_PHONG);
    made->objects[0].solid.radius *= scale;
    made->lights[0].position = vec3_scale(made->lights[0].position, scale);
    Camera *camera = &made->scene.camera;
    camera->eye = vec3_scale(camera->eye, scale);
    camera->near *= scale;
    camera->far *= scale;
}

static FileScene file;
static char file_name[24];

bool study_open_file(const char *path, Message *message)
{
    CacheKey key = {{0, 0}};
    StudyScene made;
    if (!file_scene_open(&file, &(FileSceneOptions){.path = path}, message))
        return false;
    study_scene(STUDY_FILE, &made);
    exact_key_scene(&key, &made.scene, true);
    snprintf(file_name, sizeof file_name, "file-%012" PRIx64, key.bits[0] >> 16);
    return true;
}

static void from_file(StudyScene *made)
{
    file_scene_make(&file, 0, &made->scene);
}

const StudySceneInfo STUDY_SCENES[STUDY_SCENE_COUNT + 1] = {
    {"sphere", "the lecture's sphere, diffuse, a point light", lecture_sphere, false},
    {"cube", "the lecture's cube, diffuse, a point light", lecture_cube, false},
    {"shiny8", "a sphere with Phong's highlight, shininess 8", shiny8, false},
    {"shiny32", "a sphere with Phong's highlight, shininess 32", shiny32, false},
    {"shiny128", "a sphere with Phong's highlight, shininess 128", shiny128, false},
    {"spot", "a soft spot on a plane, fading with the distance", spot, false},
    {"four-lights", "a torus on a disc, four lights", four_lights, false},
    {"teapot", "a teapot of gold, two lights", teapot, false},
    {"far", "shiny32, a million units from the origin", far_away, false},
    {"wide", "shiny32, 300 units wide", wide, false},
    {"spot-sphere", "a spot with a hard edge on a sphere", spot_sphere, true},
    {"teapot-lights", "a teapot on a disc, four lights", teapot_lights, true},
    {file_name, "the scene of the file", from_file, false},
};

int study_scene_number(const char *name)
{
    int number = 0;
    while (strcmp(STUDY_SCENES[number].name, name) != 0)
        number++;
    return number;
}

void study_scene(int number, StudyScene *made)
{
    memset(made, 0, sizeof *made);
    STUDY_SCENES[number].make(made);
}
