/* What examples with scenes share: shading and surfaces as options, the textbook's camera. */
#include "scene/scene_example.h"

#include <math.h>
#include <stddef.h>

const SceneExample *example_scene(const Example *example)
{
    return example->kind == &SCENE_KIND ? example->content : NULL;
}

void scene_shading_apply(const SceneShading *shading, Scene *scene)
{
    scene->reflection = (Reflection)shading->reflection;
    scene->interpolation = (Interpolation)shading->interpolation;
    scene->distant_viewer = shading->viewer == VIEWER_INFINITE;
}

void scene_surface_named(const Parameter *parameter)
{
    Surface *surface = (Surface *)((char *)parameter->value - offsetof(Surface, name));
    if (surface->name < MATERIAL_COUNT)
        surface->material = MATERIALS[surface->name].material;
}

void light_colors_apply(const LightColors *colors, Light *light)
{
    light->ambient = colors->ambient;
    light->diffuse = colors->diffuse;
    light->specular = colors->specular;
}

Camera example_camera(Vec3 eye, double extent)
{
    static const double DEGREES = 57.29577951308232;
    const double distance = vec3_length(eye);
    return (Camera){.eye = eye,
                    .up = {0, 1, 0},
                    .fovy = 2 * DEGREES * atan(extent / distance),
                    .near = fmax(distance - 2 * extent, 0.1),
                    .far = distance + 2 * extent};
}

void example_annotate(double seconds, int view, const Scene *scene, Annotations *annotations)
{
    (void)seconds, (void)view;
    overlay_add_axes(&annotations->lines, 2);
    overlay_add_lights(&annotations->points, scene);
}

Mat4 example_turned(double seconds)
{
    return mat4_rotate(DEGREES_PER_SECOND * seconds, (Vec3){0, 1, 0});
}

Vec3 example_turn(Vec3 point, double seconds)
{
    return mat4_transform_point(example_turned(seconds), point);
}
