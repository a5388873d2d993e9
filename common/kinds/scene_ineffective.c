/* Which options of a program with scenes name what is not there, or change nothing: all that its
 * scenes hand over at three moments is added to a key, less what cannot be seen of it. */
#include "kinds/scene_views.h"

#include "base/cache.h"
#include "lighting/lighting.h"
#include "scene/scene_fields.h"

#include <stdio.h>
#include <string.h>

enum { LIGHTS_MAX = 32 };

/* No shader is needed for a scene's data, and none is loaded. */
static const ShaderLoader NO_SHADERS = {.only_texts = true};

/* --terms */

/* Of which terms there is light. */
static unsigned light_terms(const Scene *scene)
{
    unsigned terms = color_is_black(scene->global_ambient) ? 0 : TERM_AMBIENT;
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        terms |= light->off || color_is_black(light->ambient) ? 0 : TERM_AMBIENT;
        terms |= light->off || color_is_black(light->diffuse) ? 0 : TERM_DIFFUSE;
        terms |= light->off || color_is_black(light->specular) ? 0 : TERM_SPECULAR;
    }
    return terms;
}

/* The terms of the sum that are not black, whatever the directions. */
static unsigned terms_of(const Scene *scene)
{
    const unsigned light = light_terms(scene);
    unsigned terms = 0;
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        const bool colors = object->mesh && object->mesh->colors; /* ambient and diffuse */
        for (int side = 0; side < (object->two_sided ? 2 : 1); side++) {
            const Material *material = side ? &object->back : &object->front;
            if (colors || !color_is_black(material->ambient))
                terms |= light & TERM_AMBIENT;
            if (colors || !color_is_black(material->diffuse))
                terms |= light & TERM_DIFFUSE;
            if (!color_is_black(material->specular))
                terms |= light & TERM_SPECULAR;
            if (!color_is_black(material->emission))
                terms |= TERM_EMISSION;
        }
    }
    return terms;
}

static bool list_lights(int lights, Message *message)
{
    if (lights == 1)
        return message_add(message, "light 0");
    return message_add(message, lights ? "lights 0 to %d" : "no lights", lights - 1);
}

/* Of options that name lights the scene has not. */
static bool refuse_lights(const DrawRequest *request, int lights, Message *message)
{
    const bool placed = request->places.placed >> lights;
    const unsigned absent = (placed ? request->places.placed : request->tints.tinted) >> lights;
    message_set(message, "--light-%s: there is no light %d; the scene has ",
                placed ? "at" : "color", lights + __builtin_ctz(absent));
    return list_lights(lights, message);
}

/* What the views of an example have at the request's time. */
typedef struct Found {
    unsigned terms;
    int lights;
} Found;

static Found find_terms(const Example *example, const DrawRequest *request)
{
    Found found = {.terms = 0};
    int columns, rows;
    const int views = scene_view_grid(example_scene(example), &columns, &rows);
    for (int view = 0; view < views; view++) {
        Scene scene = {.light_count = 0};
        example_scene(example)->make(request->seconds, view, &scene);
        found.terms |= terms_of(&scene);
        found.lights = scene.light_count > found.lights ? scene.light_count : found.lights;
    }
    return found;
}

/* Of --terms that names what the scene has not. */
static bool refuse_terms(SceneTerms named, Found found, Message *message)
{
    int missing = -1, absent = 0;
    for (int i = LIGHTS_MAX - 1; i >= found.lights && named.lights_left_out; i--)
        missing = named.lights_left_out >> i & 1 ? missing : i;
    while (absent < 4 && (!named.left_out || (named.left_out | found.terms) >> absent & 1))
        absent++;
    if (missing < 0 && absent == 4)
        return true;
    if (missing >= 0)
        message_set(message, "--terms: there is no light %d; ", missing);
    else
        message_set(message, "--terms: there is no %s; ", SCENE_TERM_NAMES[absent]);
    bool any = false;
    message_add(message, "the scene has ");
    for (int k = 0; k < 4; k++) {
        if (found.terms >> k & 1)
            message_add(message, "%s%s", any ? ", " : "", SCENE_TERM_NAMES[k]);
        any |= found.terms >> k & 1;
    }
    if (!any)
        message_add(message, "no term that is not black");
    message_add(message, "; ");
    return list_lights(found.lights, message);
}

bool scene_check_names(const Example *example, const DrawRequest *request, Message *message)
{
    const SceneTerms named = request->terms;
    const unsigned changed = request->places.placed | request->tints.tinted;
    if (!named.left_out && !named.lights_left_out && !changed)
        return true;
    const bool made = example->init(&NO_SHADERS, NULL);
    const Found found = made ? find_terms(example, request) : (Found){.terms = 0};
    example->finish();
    if (!made) /* drawing says why */
        return true;
    return found.lights < LIGHTS_MAX && changed >> found.lights
               ? refuse_lights(request, found.lights, message)
               : refuse_terms(named, found, message);
}

/* Options */

/* Only what can be seen of a light. */
static Light seen_light(Light light)
{
    const bool directional = light.kind == LIGHT_DIRECTIONAL, spot = light.kind == LIGHT_SPOT;
    static const Vec3 none = {0, 0, 0};
    if (light.off)
        return (Light){.off = true};
    if (directional)
        light.position = none;
    if (directional)
        light.constant = light.linear = light.quadratic = light.range = 0;
    if (!spot)
        light.cutoff = light.exponent = 0;
    if (light.kind == LIGHT_POINT)
        light.direction = none;
    return light;
}

static void add_fields(CacheKey *key, const Field *fields, const void *from)
{
    static const size_t sizes[] = {[FIELD_NUMBER] = sizeof(double),
                                   [FIELD_VECTOR] = sizeof(Vec3),
                                   [FIELD_WHOLE] = sizeof(int),
                                   [FIELD_FLAG] = sizeof(bool)};
    for (; fields->name; fields++)
        cache_key_add(key, (const char *)from + fields->place, sizes[fields->kind]);
}

/* What of a material is seen: alpha in pictures that keep it, a colour where there is light of its
 * term, the exponent of a highlight where there is one. */
static void add_material(CacheKey *key, Material material, unsigned light, bool alpha)
{
    static const Vec3 none = {0, 0, 0};
    if (!(light & TERM_AMBIENT))
        material.ambient = none;
    if (!(light & TERM_DIFFUSE))
        material.diffuse = none;
    if (!(light & TERM_SPECULAR))
        material.specular = none;
    if (!alpha)
        material.alpha = 0;
    if (color_is_black(material.specular))
        material.shininess = 0;
    add_fields(key, MATERIAL_FIELDS, &material);
}

static void add_object(CacheKey *key, const Object *object, unsigned light, bool alpha)
{
    add_fields(key, OBJECT_FIELDS, object);
    cache_key_add(key, &object->world_from_object, sizeof object->world_from_object);
    add_material(key, object->front, light, alpha);
    if (object->two_sided)
        add_material(key, object->back, light, alpha);
    if (object->mesh)
        scene_key_mesh(key, object->mesh);
}

void scene_key(CacheKey *key, const Scene *scene, bool alpha)
{
    const int counts[] = {scene->light_count, scene->object_count};
    cache_key_add(key, counts, sizeof counts);
    add_fields(key, SCENE_FIELDS, scene);
    add_fields(key, CAMERA_FIELDS, &scene->camera);
    for (int i = 0; i < scene->light_count; i++) {
        const Light light = seen_light(scene->lights[i]);
        add_fields(key, LIGHT_FIELDS, &light);
    }
    for (int i = 0; i < scene->object_count; i++)
        add_object(key, &scene->objects[i], light_terms(scene), alpha);
}

static void add_view(CacheKey *key, const Example *example, const Options *options, double seconds,
                     int view)
{
    const SceneExample *own = example_scene(example);
    Scene scene = {.light_count = 0};
    SceneCopy kept;
    Annotations marks = {{.count = 0}, {.count = 0}};
    own->make(seconds, view, &scene);
    scene_copy_open(&kept, &scene);
    scene_keep_terms(&kept, options->terms);
    scene_key(key, &kept.scene, options->alpha);
    if (own->annotate)
        own->annotate(seconds, view, &kept.scene, &marks);
    OverlayList *lists[] = {&marks.lines, &marks.points};
    for (int i = 0; i < 2; i++) {
        cache_key_add(key, lists[i]->vertices,
                      (size_t)lists[i]->count * sizeof *lists[i]->vertices);
        overlay_list_close(lists[i]);
    }
    const char *label = own->label ? own->label(view) : NULL;
    cache_key_add(key, label ? label : "", label ? strlen(label) : 0);
    scene_copy_close(&kept);
}

/* What the finished picture is changed to, shown on a pattern. */
static bool add_retouched(CacheKey *key, const SceneExample *own)
{
    Image image;
    if (!own->retouch)
        return true;
    if (!image_open(&image, 96, 48, IMAGE_BYTE, NULL))
        return false;
    const size_t size = (size_t)image.height * image_row_size(&image);
    for (size_t i = 0; i < size; i++)
        ((unsigned char *)image.pixels)[i] = (unsigned char)(i * i / 7);
    own->retouch(&image);
    cache_key_add(key, image.pixels, size);
    image_close(&image);
    return true;
}

static void add_scenes(const Example *example, const Options *options, CacheKey *key)
{
    int grid[2];
    const int views = scene_view_grid(example_scene(example), &grid[0], &grid[1]);
    cache_key_add(key, grid, sizeof grid);
    for (int k = 0; k < INEFFECTIVE_MOMENTS; k++)
        for (int view = 0; view < views; view++)
            add_view(key, example, options, options->seconds + INEFFECTIVE_LATER[k], view);
}

static bool make_key(const Example *example, const Options *options, CacheKey *key)
{
    const bool done =
        example->init(&NO_SHADERS, NULL) && add_retouched(key, example_scene(example));
    if (done)
        add_scenes(example, options, key);
    example->finish();
    return done;
}

/* --shadows, --clamp-dots */

typedef bool HasEffect(const LightTerms *terms);

static bool has_shadow(const LightTerms *terms)
{
    return terms->shadow > 0;
}

static bool has_signed_dots(const LightTerms *terms)
{
    return terms->signed_dots;
}

/* Whether any object has the effect, with the lights as the options have them, all with shadows or
 * none. */
static bool scene_has(Lighting *lighting, const Scene *made, const Options *options, bool shadows,
                      HasEffect *effect)
{
    SceneCopy kept;
    LightingPlan plan = {.lighting = NULL};
    scene_copy_open(&kept, made);
    const LightingFrame frame = {.scene = &kept.scene, .aspect = 1};
    scene_place_lights(&kept, &options->places);
    scene_tint_lights(&kept, &options->tints);
    scene_keep_terms(&kept, options->terms);
    kept.scene.signed_dots = options->signed_dots;
    scene_cast_shadows(&kept, shadows);
    bool has = !scene_check(&kept.scene, NULL) || !lighting_decide(&plan, lighting, &frame, NULL);
    for (int i = 0; i < made->object_count && !has; i++) {
        const Effects effects = lighting_plan_effects(&plan, i);
        for (int k = 0; k < effects.group_count; k++)
            has |= effect(&effects.groups[k].terms);
    }
    lighting_plan_close(&plan);
    scene_copy_close(&kept);
    return has;
}

/* The same at any of the moments. */
static bool example_has(const Example *example, const Options *options, bool shadows,
                        HasEffect *effect)
{
    const SceneExample *own = example_scene(example);
    int columns, rows;
    Lighting *lighting = NULL;
    bool has = !lighting_open(&lighting, &NO_SHADERS, NULL) || !example->init(&NO_SHADERS, NULL);
    const int views = scene_view_grid(own, &columns, &rows);
    for (int k = 0; k < INEFFECTIVE_MOMENTS; k++)
        for (int view = 0; view < views && !has; view++) {
            Scene scene = {.light_count = 0};
            own->make(options->seconds + INEFFECTIVE_LATER[k], view, &scene);
            orbit_move(options->orbit, &scene.camera.eye, scene.camera.center, &scene.camera.up);
            has = scene_has(lighting, &scene, options, shadows, effect);
        }
    example->finish();
    lighting_close(lighting);
    return has;
}

/* Whether the picture is the same with and without shadows. Several samples of a pixel are drawn in
 * another way with them, and a caption may name what shadows cost. */
static bool shadows_ineffective(const Example *example, const Options *options)
{
    const SceneExample *own = example_scene(example);
    return options_have_shadows(options) != own->shadows && options->canvas.samples <= 1 &&
           !(own->plain_label && own->plain_label(0)) &&
           !example_has(example, options, true, has_shadow);
}

void ineffective_scene_options(const Example *example, const Options *options,
                               const ParameterValue *defaults, char *text, size_t size)
{
    /* With --error an option that is given stays, whatever else it does. */
    if (options->cheap || ineffective_unknown(example, options))
        return;
    if (shadows_ineffective(example, options))
        snprintf(text, size, "--shadows");
    if (options->signed_dots &&
        !example_has(example, options, options_have_shadows(options), has_signed_dots))
        snprintf(text + strlen(text), size - strlen(text), "%s--clamp-dots", text[0] ? ", " : "");
    ineffective_options(example, options, defaults, make_key, text, size);
}
