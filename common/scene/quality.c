/* Thirteen axes, each a list of choices from more accurate to cheaper. A quality is applied to a
 * copy of the scene: other meshes of its solids, lights at infinity, lighting per vertex. */
#include "scene/quality.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

#define CHOICES(...)                                                                               \
    .choices = {__VA_ARGS__, NULL},                                                                \
    .count = (int)(sizeof(const char *[]){__VA_ARGS__} / sizeof(const char *))

const QualityAxisInfo QUALITY_AXES[AXIS_COUNT] = {
    [AXIS_INTERPOLATION] = {.name = "interpolation",
                            .help = "of normals, of colours, or neither",
                            CHOICES("phong", "gouraud", "flat")},
    [AXIS_DIVISIONS] = {.name = "divisions",
                        .help = "the parts into which a full turn, or a side, is cut",
                        CHOICES("6", "8", "12", "16", "24", "32", "48", "64", "96", "128", "192",
                                "256", "384", "512"),
                        .usual = 7},
    [AXIS_PRECISION] = {.name = "precision",
                        .help = "of the fragment shader's floats",
                        CHOICES("highp", "mediump")},
    [AXIS_NORMALS] = {.name = "normals",
                      .help = "normalized at every fragment, or left as interpolated",
                      CHOICES("unit", "interpolated")},
    [AXIS_GUARDS] = {.name = "guards",
                     .help = "against division by zero and the like",
                     CHOICES("on", "off")},
    [AXIS_HIGHLIGHT] = {.name = "highlight",
                        .help = "its cosine by the dot or by the cross product",
                        CHOICES("cosine", "cross")},
    [AXIS_VIEWER] = {.name = "viewer",
                     .help = "at the eye, or infinitely far away",
                     CHOICES("local", "infinite")},
    [AXIS_LIGHTS] = {.name = "lights",
                     .help = "at their positions, or infinitely far away",
                     CHOICES("local", "infinite")},
    [AXIS_SAMPLES] = {.name = "samples", .help = "of a pixel, by the driver", CHOICES("0", "4")},
    [AXIS_SUPERSAMPLE] = {.name = "supersample",
                          .help = "pixels per pixel and dimension",
                          CHOICES("1", "2", "3", "4")},
    [AXIS_OUTPUT] = {.name = "output",
                     .help = "8 bits, rounded to the nearest or dithered; or float",
                     CHOICES("nearest", "dithered", "float")},
    [AXIS_MATRICES] = {.name = "matrices",
                       .help = "the arithmetic of their products",
                       CHOICES("double", "float", "compensated")},
    [AXIS_ORDER] = {.name = "order",
                    .help = "composed relative to the eye, or as in the lecture",
                    CHOICES("eye", "lecture")},
};

Quality quality_usual(void)
{
    Quality quality;
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        quality.choice[axis] = (unsigned char)QUALITY_AXES[axis].usual;
    return quality;
}

bool quality_equal(const Quality *a, const Quality *b)
{
    return memcmp(a->choice, b->choice, sizeof a->choice) == 0;
}

Quality quality_with(Quality quality, QualityAxis axis, int choice)
{
    quality.choice[axis] = (unsigned char)choice;
    return quality;
}

/* The number that a choice names. */
static int number_of(const Quality *quality, QualityAxis axis)
{
    return atoi(QUALITY_AXES[axis].choices[quality->choice[axis]]);
}

int quality_divisions(const Quality *quality)
{
    return number_of(quality, AXIS_DIVISIONS);
}

int quality_samples(const Quality *quality)
{
    return number_of(quality, AXIS_SAMPLES);
}

int quality_supersample(const Quality *quality)
{
    return number_of(quality, AXIS_SUPERSAMPLE);
}

/* Text. */

void quality_text(const Quality *quality, char text[QUALITY_TEXT_SIZE])
{
    size_t used = 0;
    text[0] = '\0';
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const QualityAxisInfo *info = &QUALITY_AXES[axis];
        const int choice = quality->choice[axis];
        if (choice != info->usual && used < QUALITY_TEXT_SIZE)
            used += (size_t)snprintf(text + used, QUALITY_TEXT_SIZE - used, "%s%s=%s",
                                     used ? " " : "", info->name, info->choices[choice]);
    }
    if (!used)
        snprintf(text, QUALITY_TEXT_SIZE, "usual");
}

static void join(const char *const *names, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; names[i] && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", names[i]);
}

bool quality_choose(Quality *quality, const char *axis, const char *choice, Message *message)
{
    const char *names[AXIS_COUNT + 1] = {NULL};
    char known[256];
    for (int i = 0; i < AXIS_COUNT; i++)
        names[i] = QUALITY_AXES[i].name;
    const int found = text_among(axis, names);
    if (found < 0) {
        join(names, known, sizeof known);
        return message_set(message, "%s: no such choice; there are %s", axis, known);
    }
    const QualityAxisInfo *info = &QUALITY_AXES[found];
    const int number = text_among(choice, info->choices);
    if (number < 0) {
        join(info->choices, known, sizeof known);
        return message_set(message, "%s=%s: must be one of %s", axis, choice, known);
    }
    quality->choice[found] = (unsigned char)number;
    return true;
}

bool quality_parse(Quality *quality, const char *text, Message *message)
{
    char copy[QUALITY_TEXT_SIZE], *rest = NULL;
    *quality = quality_usual();
    if (strcmp(text, "usual") == 0)
        return true;
    if (strlen(text) >= sizeof copy)
        return message_set(message, "a setting of %zu characters: too long", strlen(text));
    memcpy(copy, text, strlen(text) + 1);
    for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
        char *equals = strchr(word, '=');
        if (!equals)
            return message_set(message, "%s: must be AXIS=CHOICE, as in interpolation=gouraud",
                               word);
        *equals = '\0';
        if (!quality_choose(quality, word, equals + 1, message))
            return false;
    }
    return true;
}

/* Scenes. */

/* A directional light that equals this point light at the camera's center. */
static Light at_infinity(const Light *light, Vec3 center)
{
    Light far = *light;
    const Vec3 to_light = vec3_subtract(light->position, center);
    const double d = vec3_length(to_light);
    if (light->kind != LIGHT_POINT || d == 0 || light->range > 0) /* which need a position */
        return far;
    const double loss = light->constant + light->linear * d + light->quadratic * d * d;
    const double share = loss > 0 ? 1 / loss : 1;
    far.kind = LIGHT_DIRECTIONAL;
    far.direction = to_light;
    far.ambient = vec3_scale(light->ambient, share);
    far.diffuse = vec3_scale(light->diffuse, share);
    far.specular = vec3_scale(light->specular, share);
    far.constant = far.linear = far.quadratic = 0;
    return far;
}

bool quality_scene_open(SceneCopy *made, const Scene *scene, const Quality *quality,
                        SolidMeshes *meshes, Message *message)
{
    scene_copy_open(made, scene);
    for (int i = 0; i < scene->light_count; i++) {
        const Light light = scene_world_light(scene, i);
        if (quality->choice[AXIS_LIGHTS] == LIGHTS_INFINITE)
            made->lights[i] = at_infinity(&light, scene->camera.center);
    }
    for (int i = 0; i < scene->object_count; i++) {
        Object *object = &made->objects[i];
        const bool colored = object->mesh && object->mesh->colors;
        const bool remade = object->solid.kind && !colored;
        if (remade)
            object->mesh =
                solid_meshes_find(meshes, &object->solid, quality_divisions(quality), message);
        if (remade && !object->mesh) {
            scene_copy_close(made);
            return false;
        }
    }
    made->scene.interpolation = (Interpolation)quality->choice[AXIS_INTERPOLATION];
    made->scene.distant_viewer |= quality->choice[AXIS_VIEWER] == VIEWER_INFINITE;
    made->scene.skip_renormalization |= quality->choice[AXIS_NORMALS] == NORMALS_INTERPOLATED;
    return true;
}

/* Object by object. */

ObjectQuality object_quality_plain(const Scene *scene)
{
    return (ObjectQuality){.interpolation = scene->interpolation,
                           .distant_viewer = scene->distant_viewer,
                           .skip_renormalization = scene->skip_renormalization};
}

bool object_quality_equal(const ObjectQuality *a, const ObjectQuality *b)
{
    return a->divisions == b->divisions && a->interpolation == b->interpolation &&
           a->distant_viewer == b->distant_viewer &&
           a->skip_renormalization == b->skip_renormalization && a->far_lights == b->far_lights &&
           a->matte_lights == b->matte_lights && a->dark_lights == b->dark_lights;
}

static Light light_of(const Scene *scene, int number, const ObjectQuality *quality, Vec3 origin)
{
    const uint32_t bit = number < EFFECTS_MAX_LIGHTS ? (uint32_t)1 << number : 0;
    const Light world = scene_world_light(scene, number);
    Light made = quality->far_lights & bit ? at_infinity(&world, origin) : scene->lights[number];
    if (quality->matte_lights & bit)
        made.specular = (Vec3){0, 0, 0};
    made.off |= (quality->dark_lights & bit) != 0;
    return made;
}

bool quality_parts_open(QualityParts *made, const Scene *scene, const ObjectQuality *qualities,
                        SolidMeshes *meshes, Message *message)
{
    const size_t lights = (size_t)scene->light_count, objects = (size_t)scene->object_count;
    *made = (QualityParts){.scene = *scene,
                           .parts = memory_new(objects, sizeof *made->parts),
                           .lights = memory_new(objects * lights, sizeof *made->lights),
                           .objects = memory_new(objects, sizeof *made->objects)};
    for (size_t i = 0; i < objects; i++) {
        const ObjectQuality *quality = &qualities[i];
        Object *object = &made->objects[i];
        Scene *part = &made->parts[i];
        const double *m = scene->objects[i].world_from_object.m;
        *object = scene->objects[i];
        if (object->solid.kind && quality->divisions)
            object->mesh = solid_meshes_find(meshes, &object->solid, quality->divisions, message);
        if (!object->mesh) {
            quality_parts_close(made);
            return false;
        }
        *part = *scene;
        part->objects = object;
        part->object_count = 1;
        const bool same = !(quality->far_lights | quality->matte_lights | quality->dark_lights);
        part->lights = same ? scene->lights : made->lights + i * lights;
        for (size_t k = 0; k < lights && !same; k++)
            made->lights[i * lights + k] =
                light_of(scene, (int)k, quality, (Vec3){m[12], m[13], m[14]});
        part->interpolation = quality->interpolation;
        part->distant_viewer = quality->distant_viewer;
        part->skip_renormalization = quality->skip_renormalization;
    }
    made->scene.objects = made->objects;
    return true;
}

void quality_parts_close(QualityParts *made)
{
    if (!made)
        return;
    free(made->parts);
    free(made->lights);
    free(made->objects);
    *made = (QualityParts){.parts = NULL};
}

/* Scalar operations of a vertex or a fragment, by the counts of shader_cost. */
static double operations(const Effects *effects, bool at_vertex)
{
    double sum = 2;
    bool lit = false;
    for (int g = 0; g < effects->group_count; g++) {
        const LightTerms *terms = &effects->groups[g].terms;
        if (terms->at_vertex != at_vertex)
            continue;
        double one = 4;
        lit |= terms->diffuse || terms->specular;
        one += terms->kind != LIGHT_DIRECTIONAL ? 12 : 0;
        one += terms->ambient ? 4 : 0;
        one += terms->diffuse ? 10 : 0;
        one += terms->specular ? 25 : 0;
        one += terms->specular && !terms->half_vector ? 14 : 0;
        one += (terms->attenuation ? 8 : 0) + (terms->range ? 4 : 0);
        one += terms->kind == LIGHT_SPOT ? 8 : 0;
        one += terms->exponent ? 12 : 0;
        sum += one * effects->groups[g].count;
    }
    const bool normalized = at_vertex ? effects->normalize_vertex : effects->normalize_fragment;
    return sum + (lit && normalized ? 9 : 0) + (lit && effects->local_viewer ? 9 : 0) +
           (effects->linear && !at_vertex ? 20 : 0);
}

/* Of the volumes of one object, and of finding out which of its fragments are in one, for all
 * lights: also for those that are off for this object, because it keeps them from others. */
static double shadow_cost(const Scene *scene, const Object *object, double fragments)
{
    static const double TRIANGLE = 130, FRAGMENT = 20;
    const double triangles = object->lamp ? 0 : (double)object->mesh->index_count / 3;
    int lights = 0;
    for (int i = 0; i < scene->light_count; i++)
        lights += scene->lights[i].shadows && !scene->lights[i].off;
    return lights * (TRIANGLE * triangles + FRAGMENT * fragments);
}

double quality_parts_cost(const QualityParts *made, int number, const Effects *effects,
                          double fragments)
{
    static const double TRIANGLE = 50, VERTEX = 20, OF_VERTEX = 0.3, FRAGMENT = 3,
                        OF_FRAGMENT = 0.12;
    const Scene *part = &made->parts[number];
    const Object *object = &made->objects[number];
    const bool flattened = part->interpolation == INTERPOLATION_CONSTANT ||
                           (part->interpolation == INTERPOLATION_FLAT && !object->flat);
    const double vertices =
        (double)(flattened ? object->mesh->index_count : object->mesh->vertex_count);
    return shadow_cost(&made->scene, object, fragments) +
           TRIANGLE * (double)object->mesh->index_count / 3 +
           vertices * (VERTEX + OF_VERTEX * operations(effects, true)) +
           fragments * (FRAGMENT + OF_FRAGMENT * operations(effects, false));
}

void quality_loader(QualityLoader *made, const ShaderLoader *base, const Quality *quality)
{
    int count = 0;
    memset(made, 0, sizeof *made);
    if (quality->choice[AXIS_GUARDS] == GUARDS_OFF)
        made->replacements[count++] =
            (ShaderReplacement){"lighting/guards.glsl", "study/unguarded.glsl"};
    if (quality->choice[AXIS_HIGHLIGHT] == HIGHLIGHT_CROSS)
        made->replacements[count++] =
            (ShaderReplacement){"lighting/highlight.glsl", "study/highlight_cross.glsl"};
    if (quality->choice[AXIS_OUTPUT] == OUTPUT_DITHERED)
        made->replacements[count++] =
            (ShaderReplacement){"lighting/output.glsl", "study/dithered.glsl"};
    made->loader = *base;
    made->loader.replacements = count ? made->replacements : base->replacements;
    made->loader.precision =
        quality->choice[AXIS_PRECISION] == PRECISION_MEDIUMP ? "mediump" : "highp";
}

CanvasOptions quality_canvas(const Quality *quality, int width, int height)
{
    return (CanvasOptions){.width = width,
                           .height = height,
                           .samples = quality_samples(quality),
                           .supersample = quality_supersample(quality),
                           .real = quality->choice[AXIS_OUTPUT] == OUTPUT_FLOAT};
}
