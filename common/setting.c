#include "setting.h"

#include <stdlib.h>
#include <string.h>

#define CHOICES(...)                                                                               \
    .choices = {__VA_ARGS__, NULL},                                                                \
    .count = (int)(sizeof(const char *[]){__VA_ARGS__} / sizeof(const char *))

const SettingAxisInfo SETTING_AXES[AXIS_COUNT] = {
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
                      .help = "made unit at every fragment, or left as interpolated",
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
                     .help = "where they are, or infinitely far away",
                     CHOICES("local", "infinite")},
    [AXIS_SAMPLES] = {.name = "samples", .help = "of a pixel, by the driver", CHOICES("0", "4")},
    [AXIS_SUPERSAMPLE] = {.name = "supersample",
                          .help = "pixels for each, to a side",
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

Setting setting_usual(void)
{
    Setting setting;
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        setting.choice[axis] = (unsigned char)SETTING_AXES[axis].usual;
    return setting;
}

bool setting_equal(const Setting *a, const Setting *b)
{
    return memcmp(a->choice, b->choice, sizeof a->choice) == 0;
}

Setting setting_with(Setting setting, SettingAxis axis, int choice)
{
    setting.choice[axis] = (unsigned char)choice;
    return setting;
}

/* The number that the text of a choice is. */
static int number_of(const Setting *setting, SettingAxis axis)
{
    return atoi(SETTING_AXES[axis].choices[setting->choice[axis]]);
}

int setting_divisions(const Setting *setting)
{
    return number_of(setting, AXIS_DIVISIONS);
}

int setting_samples(const Setting *setting)
{
    return number_of(setting, AXIS_SAMPLES);
}

int setting_supersample(const Setting *setting)
{
    return number_of(setting, AXIS_SUPERSAMPLE);
}

/* Text. */

void setting_text(const Setting *setting, char text[SETTING_TEXT_SIZE])
{
    size_t used = 0;
    text[0] = '\0';
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const SettingAxisInfo *info = &SETTING_AXES[axis];
        const int choice = setting->choice[axis];
        if (choice != info->usual && used < SETTING_TEXT_SIZE)
            used += (size_t)snprintf(text + used, SETTING_TEXT_SIZE - used, "%s%s=%s",
                                     used ? " " : "", info->name, info->choices[choice]);
    }
    if (!used)
        snprintf(text, SETTING_TEXT_SIZE, "usual");
}

/* The number of `name` among `names`; -1 where it is none of them. */
static int number_among(const char *const *names, const char *name)
{
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], name) == 0)
            return i;
    return -1;
}

static void join(const char *const *names, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; names[i] && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", names[i]);
}

bool setting_choose(Setting *setting, const char *axis, const char *choice, Message *message)
{
    const char *names[AXIS_COUNT + 1] = {NULL};
    char known[256];
    for (int i = 0; i < AXIS_COUNT; i++)
        names[i] = SETTING_AXES[i].name;
    const int found = number_among(names, axis);
    if (found < 0) {
        join(names, known, sizeof known);
        return message_set(message, "%s: no such choice; there are %s", axis, known);
    }
    const SettingAxisInfo *info = &SETTING_AXES[found];
    const int number = number_among(info->choices, choice);
    if (number < 0) {
        join(info->choices, known, sizeof known);
        return message_set(message, "%s=%s: must be one of %s", axis, choice, known);
    }
    setting->choice[found] = (unsigned char)number;
    return true;
}

bool setting_parse(Setting *setting, const char *text, Message *message)
{
    char copy[SETTING_TEXT_SIZE], *rest = NULL;
    *setting = setting_usual();
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
        if (!setting_choose(setting, word, equals + 1, message))
            return false;
    }
    return true;
}

/* Scenes. */

/* A light where it is and as strong as it is at the camera's centre, for every point. */
static Light at_infinity(const Light *light, Vec3 center)
{
    Light far = *light;
    const Vec3 to_light = vec3_subtract(light->position, center);
    const double d = vec3_length(to_light);
    if (light->kind != LIGHT_POINT || d == 0) /* a spot has a place, or it is none */
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

bool setting_scene_open(SettingScene *made, const Scene *scene, const Setting *setting,
                        SolidMeshes *meshes, Message *message)
{
    const size_t lights = (size_t)scene->light_count, objects = (size_t)scene->object_count;
    *made = (SettingScene){.scene = *scene,
                           .lights = calloc(lights + 1, sizeof *made->lights),
                           .objects = calloc(objects + 1, sizeof *made->objects)};
    if (!made->lights || !made->objects) {
        setting_scene_close(made);
        return message_set(message, "setting: not enough memory for a scene");
    }
    for (size_t i = 0; i < lights; i++)
        made->lights[i] = setting->choice[AXIS_LIGHTS] == LIGHTS_INFINITE
                              ? at_infinity(&scene->lights[i], scene->camera.center)
                              : scene->lights[i];
    for (size_t i = 0; i < objects; i++) {
        Object *object = &made->objects[i];
        *object = scene->objects[i];
        if (object->solid.kind)
            object->mesh =
                solid_meshes_find(meshes, &object->solid, setting_divisions(setting), message);
        if (object->solid.kind && !object->mesh) {
            setting_scene_close(made);
            return false;
        }
    }
    made->scene.lights = made->lights;
    made->scene.objects = made->objects;
    made->scene.interpolation = (Interpolation)setting->choice[AXIS_INTERPOLATION];
    made->scene.distant_viewer |= setting->choice[AXIS_VIEWER] == VIEWER_INFINITE;
    made->scene.skip_renormalization |= setting->choice[AXIS_NORMALS] == NORMALS_INTERPOLATED;
    return true;
}

void setting_scene_close(SettingScene *made)
{
    if (!made)
        return;
    free(made->lights);
    free(made->objects);
    *made = (SettingScene){.lights = NULL};
}

void setting_loader(SettingLoader *made, const ShaderLoader *base, const Setting *setting)
{
    int count = 0;
    memset(made, 0, sizeof *made);
    if (setting->choice[AXIS_GUARDS] == GUARDS_OFF)
        made->replacements[count++] =
            (ShaderReplacement){"lighting/guards.glsl", "study/unguarded.glsl"};
    if (setting->choice[AXIS_HIGHLIGHT] == HIGHLIGHT_CROSS)
        made->replacements[count++] =
            (ShaderReplacement){"lighting/highlight.glsl", "study/highlight_cross.glsl"};
    if (setting->choice[AXIS_OUTPUT] == OUTPUT_DITHERED)
        made->replacements[count++] =
            (ShaderReplacement){"lighting/output.glsl", "study/dithered.glsl"};
    made->loader = *base;
    made->loader.replacements = count ? made->replacements : base->replacements;
    made->loader.precision =
        setting->choice[AXIS_PRECISION] == PRECISION_MEDIUMP ? "mediump" : "highp";
}

CanvasOptions setting_canvas(const Setting *setting, int width, int height)
{
    return (CanvasOptions){.width = width,
                           .height = height,
                           .samples = setting_samples(setting),
                           .supersample = setting_supersample(setting),
                           .real = setting->choice[AXIS_OUTPUT] == OUTPUT_FLOAT};
}
