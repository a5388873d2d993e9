/*
 * Scene: a scene of your own, from a file: glTF 2.0, or what Assimp reads.
 *
 * Look at --explain: which effects its objects need, what of the file is not drawn; and at --error,
 * --precision mediump and --shadows.
 */
#include "scene/file_scene.h"
#include "scene/scene_example.h"
#include "scene/shape.h"

static FileSceneOptions file;
static int interpolation; /* 0: as the file has it; or 1 + an Interpolation */
static Vec3 global_ambient;
static const char *const INTERPOLATIONS[] = {"file", "phong", "gouraud", "flat", "constant", NULL};

static const Parameter parameters[] = {
    {"file", "the scene: glTF 2.0 (.gltf, .glb), FBX, COLLADA, Blender, 3DS...", PARAMETER_TEXT,
     .value = &file.path, .placeholder = "FILE", .min = 1},
    {"camera", "by number, or its or its node's name; fit: one that sees all", PARAMETER_TEXT,
     .value = &file.camera, .placeholder = "N|NAME", .min = 1, .standard = "the first, or fit"},
    {"up", "the axis of the file that points up", PARAMETER_CHOICE, .value = &file.up,
     .choices = SHAPE_UP_NAMES},
    {"exposure",
     "how much brighter its lights are; 0: chosen where they are in candela and lux, or above 1",
     PARAMETER_NUMBER, .value = &file.exposure, .min = 0, .max = 1e9},
    {"interpolation",
     "of normals, of colours; flat: one normal for each triangle; constant: one "
     "colour",
     PARAMETER_CHOICE, .value = &interpolation, .choices = INTERPOLATIONS,
     .fixes = 1U << AXIS_INTERPOLATION},
    COLOR_PARAMETER("global-ambient", "ambient light besides the file's", global_ambient),
    {.name = NULL},
};

static FileScene made;

static bool init(const ShaderLoader *loader, Message *message)
{
    (void)loader;
    if (!file.path)
        return message_set(message, "no file is named, as in Scene room.glb");
    return file_scene_open(&made, &file, message);
}

static void scene(double seconds, int view, Scene *scene)
{
    (void)view;
    file_scene_make(&made, seconds, scene);
    scene->global_ambient = vec3_add(scene->global_ambient, global_ambient);
    if (interpolation > 0)
        scene->interpolation = (Interpolation)(interpolation - 1);
}

static void explain(FILE *output)
{
    file_scene_explain(&made, output);
}

static void finish(void)
{
    file_scene_close(&made);
}

const Example Scene_ = {
    .name = "Scene",
    .summary = "a scene from a file: glTF 2.0, FBX, COLLADA, Blender, 3DS",
    .tries = {"room.glb --explain", "room.glb --shadows on", "room.gltf --camera fit --error 1"},
    .looks = {"what each object needs, and what of the file is not drawn",
              "every light of the file has shadows",
              "as cheap as an error of one step of 1/255 allows"},
    .init = init,
    .finish = finish,
    .kind = &SCENE_KIND,
    .content = &(const SceneExample){.make = scene, .operand = &file.path, .explain = explain},
    .parameters = parameters,
};
