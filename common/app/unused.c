#include "app/unused.h"

#include "base/cache.h"
#include "images/drawing.h"
#include "scene/effects.h"
#include "scene/scene_example.h"

#include <stdio.h>
#include <string.h>

enum { LIGHTS_MAX = 32 };

/* The times, after the first, at which options are tried. */
static const double LATER[] = {0, 0.7, 1.9};

/* No shader is needed for a scene's data, and none is loaded. */
static const ShaderLoader NO_SHADERS = {.only_texts = true};

static void view_grid(const Example *example, int *columns, int *rows)
{
    *columns = *rows = 1;
    if (example->scene->layout)
        example->scene->layout(columns, rows);
}

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

static bool list_terms(unsigned terms, int lights, Message *message)
{
    bool any = false;
    message_add(message, "the scene has ");
    for (int k = 0; k < 4; k++) {
        if (terms >> k & 1)
            message_add(message, "%s%s", any ? ", " : "", OPTIONS_TERM_NAMES[k]);
        any |= terms >> k & 1;
    }
    if (!any)
        message_add(message, "no term that is not black");
    message_add(message, "; ");
    return list_lights(lights, message);
}

/* Of options that name lights the scene has not. */
static bool refuse_lights(const Options *options, int lights, Message *message)
{
    const bool placed = options->places.placed >> lights;
    const unsigned absent = (placed ? options->places.placed : options->tints.tinted) >> lights;
    message_set(message, "--light-%s: there is no light %d; the scene has ",
                placed ? "at" : "color", lights + __builtin_ctz(absent));
    return list_lights(lights, message);
}

bool unused_terms_check(const Example *example, const Options *options, Message *message)
{
    const SceneTerms named = options->terms;
    const unsigned changed = options->places.placed | options->tints.tinted;
    if (!example->scene || (!named.left_out && !named.lights_left_out && !changed))
        return true;
    int columns, rows, lights = 0, missing = -1;
    unsigned terms = 0;
    if (example->init(&NO_SHADERS, NULL)) {
        view_grid(example, &columns, &rows);
        for (int view = 0; view < columns * rows; view++) {
            Scene scene = {.light_count = 0};
            example->scene->make(options->seconds, view, &scene);
            terms |= terms_of(&scene);
            lights = scene.light_count > lights ? scene.light_count : lights;
        }
        for (int i = LIGHTS_MAX - 1; i >= lights && named.lights_left_out; i--)
            missing = named.lights_left_out >> i & 1 ? missing : i;
        if (changed >> lights) {
            example->finish();
            return refuse_lights(options, lights, message);
        }
    } else {
        terms = TERM_ALL; /* drawing says why */
    }
    example->finish();
    int absent = 0;
    while (absent < 4 && (!named.left_out || (named.left_out | terms) >> absent & 1))
        absent++;
    if (missing < 0 && absent == 4)
        return true;
    if (missing >= 0)
        message_set(message, "--terms: there is no light %d; ", missing);
    else
        message_set(message, "--terms: there is no %s; ", OPTIONS_TERM_NAMES[absent]);
    return list_terms(terms, lights, message);
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
        light.constant = light.linear = light.quadratic = 0;
    if (!spot)
        light.cutoff = light.exponent = 0;
    if (light.kind == LIGHT_POINT)
        light.direction = none;
    return light;
}

static void add_light(CacheKey *key, Light light)
{
    const int kinds[] = {light.off, light.shadows, (int)light.kind, (int)light.space};
    const Vec3 vectors[] = {light.position, light.direction, light.ambient, light.diffuse,
                            light.specular};
    const double numbers[] = {light.cutoff, light.exponent, light.constant, light.linear,
                              light.quadratic};
    cache_key_add(key, kinds, sizeof kinds);
    cache_key_add(key, vectors, sizeof vectors);
    cache_key_add(key, numbers, sizeof numbers);
}

/* What of a material is seen: alpha in pictures that keep it, a colour where there is light of its
 * term, the exponent of a highlight where there is one. */
static void add_material(CacheKey *key, const Material *material, unsigned light, bool alpha)
{
    static const Vec3 none = {0, 0, 0};
    const bool shiny = light & TERM_SPECULAR && !color_is_black(material->specular);
    const Vec3 colors[] = {light & TERM_AMBIENT ? material->ambient : none,
                           light & TERM_DIFFUSE ? material->diffuse : none,
                           shiny ? material->specular : none, material->emission};
    const double numbers[] = {alpha ? material->alpha : 0, shiny ? material->shininess : 0};
    cache_key_add(key, colors, sizeof colors);
    cache_key_add(key, numbers, sizeof numbers);
}

static void add_object(CacheKey *key, const Object *object, unsigned light, bool alpha)
{
    const int flags[] = {object->flat,         object->closed,    object->clockwise,
                         object->behind_lines, object->two_sided, object->wrong_normals,
                         object->lamp};
    cache_key_add(key, flags, sizeof flags);
    cache_key_add(key, &object->world_from_object, sizeof object->world_from_object);
    add_material(key, &object->front, light, alpha);
    if (object->two_sided)
        add_material(key, &object->back, light, alpha);
    if (object->mesh)
        scene_key_mesh(key, object->mesh);
}

static void add_scene(CacheKey *key, const Scene *scene, bool alpha)
{
    const int kinds[] = {scene->light_count,          (int)scene->interpolation,
                         (int)scene->reflection,      scene->distant_viewer,
                         scene->object_count,         scene->clamp_vertex,
                         scene->skip_renormalization, scene->linear};
    cache_key_add(key, kinds, sizeof kinds);
    cache_key_add(key, &scene->camera, sizeof scene->camera);
    cache_key_add(key, &scene->background, sizeof scene->background);
    cache_key_add(key, &scene->global_ambient, sizeof scene->global_ambient);
    for (int i = 0; i < scene->light_count; i++)
        add_light(key, seen_light(scene->lights[i]));
    for (int i = 0; i < scene->object_count; i++)
        add_object(key, &scene->objects[i], light_terms(scene), alpha);
}

static void add_marks(CacheKey *key, Annotations *marks)
{
    OverlayList *lists[] = {&marks->lines, &marks->points};
    for (int i = 0; i < 2; i++) {
        cache_key_add(key, lists[i]->vertices,
                      (size_t)lists[i]->count * sizeof *lists[i]->vertices);
        overlay_list_close(lists[i]);
    }
}

static bool add_view(CacheKey *key, const Example *example, const Options *options, double seconds,
                     int view)
{
    const SceneExample *own = example->scene;
    Scene scene = {.light_count = 0};
    SceneCopy kept;
    Annotations marks = {{.count = 0}, {.count = 0}};
    own->make(seconds, view, &scene);
    if (!scene_copy_open(&kept, &scene, false, NULL))
        return false;
    scene_keep_terms(&kept, options->terms);
    add_scene(key, &kept.scene, options->alpha);
    if (own->annotate)
        own->annotate(seconds, view, &kept.scene, &marks);
    add_marks(key, &marks);
    const char *label = own->label ? own->label(view) : NULL;
    cache_key_add(key, label ? label : "", label ? strlen(label) : 0);
    scene_copy_close(&kept);
    return true;
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

static bool add_drawing(CacheKey *key, const Example *example, const Options *options,
                        double seconds)
{
    Drawing drawing;
    const bool done = drawing_begin(&drawing, options->width, options->height, NULL) &&
                      example->diagram->compose(seconds, &drawing, NULL);
    for (int i = 0; done && i < drawing.path_count; i++) {
        const DrawingPath *path = &drawing.paths[i];
        const DrawingStyle *style = &path->style;
        const Vec3 colors[] = {style->fill, style->stroke};
        const double numbers[] = {style->fill_alpha, style->width, style->dash};
        cache_key_add(key, colors, sizeof colors);
        cache_key_add(key, numbers, sizeof numbers);
        cache_key_add(key, &path->step_count, sizeof path->step_count);
    }
    if (done) {
        cache_key_add(key, drawing.steps, (size_t)drawing.step_count * sizeof *drawing.steps);
        cache_key_add(key, drawing.points, (size_t)drawing.point_count * sizeof *drawing.points);
    }
    drawing_end(&drawing);
    return done;
}

/* All that the example hands over, with its parameters as they are now. */
static bool make_key(const Example *example, const Options *options, CacheKey *key)
{
    const Usage usage = options_usage(example);
    int grid[2], size[2] = {options->width, options->height};
    bool done = true;
    *key = (CacheKey){{0, 0}};
    if (!options->size_given)
        options_size(&usage, &size[0], &size[1]);
    cache_key_add(key, size, sizeof size);
    for (int k = 0; k < 3 && done && example->diagram; k++)
        done = add_drawing(key, example, options, options->seconds + LATER[k]);
    if (example->diagram)
        return done;
    done = example->init(&NO_SHADERS, NULL) && add_retouched(key, example->scene);
    view_grid(example, &grid[0], &grid[1]);
    cache_key_add(key, grid, sizeof grid);
    for (int k = 0; k < 3; k++)
        for (int view = 0; view < grid[0] * grid[1] && done; view++)
            done = add_view(key, example, options, options->seconds + LATER[k], view);
    example->finish();
    return done;
}

/* Sets the parameters as if the options had been given without one: those from which others follow
 * first, as when they are read. */
static void set_without(const Parameter *table, const Options *options, int left_out,
                        const ParameterValue *defaults, const ParameterValue *values)
{
    for (int i = 0; table[i].name; i++)
        parameter_restore(&table[i], defaults[i]);
    for (int turn = 0; turn < 2; turn++)
        for (int i = 0; table[i].name; i++) {
            if (i == left_out || !options->own_given[i] ||
                (turn == 0) != (table[i].changed != NULL))
                continue;
            parameter_restore(&table[i], values[i]);
            if (table[i].changed)
                table[i].changed(&table[i]);
        }
}

/* The own options that were given; -1 if one of them names a file. */
static int count_given(const Parameter *table, const Options *options)
{
    int count = 0;
    for (int i = 0; table && table[i].name; i++) {
        if (options->own_given[i] && table[i].kind == PARAMETER_TEXT)
            return -1;
        count += options->own_given[i];
    }
    return count;
}

/* --shadows */

/* With the lights as the options have them and shadows of all; true too if that is not known. */
static bool shadow_falls(const Scene *made, const Options *options)
{
    SceneCopy kept;
    bool falls = false;
    if (!scene_copy_open(&kept, made, false, NULL))
        return true;
    scene_place_lights(&kept, &options->places);
    scene_tint_lights(&kept, &options->tints);
    scene_keep_terms(&kept, options->terms);
    for (int i = 0; i < made->light_count; i++)
        kept.lights[i].shadows = true;
    falls = !scene_check(&kept.scene, NULL);
    for (int i = 0; i < made->object_count && !falls; i++) {
        const Effects effects = effects_of(&kept.scene, &kept.scene.objects[i]);
        for (int k = 0; k < effects.group_count; k++)
            falls |= effects.groups[k].terms.shadow > 0;
    }
    scene_copy_close(&kept);
    return falls;
}

/* Whether the picture is the same with and without shadows. Several samples of a pixel are drawn in
 * another way with them, and a caption may name what shadows cost. */
static bool shadows_unused(const Example *example, const Options *options)
{
    const SceneExample *own = example->scene;
    int columns, rows;
    if (!own || options_have_shadows(options) == own->shadows || options->canvas.samples > 1)
        return false;
    bool falls = !example->init(&NO_SHADERS, NULL) || (own->plain_label && own->plain_label(0));
    view_grid(example, &columns, &rows);
    for (int k = 0; k < 3; k++)
        for (int view = 0; view < columns * rows && !falls; view++) {
            Scene scene = {.light_count = 0};
            own->make(options->seconds + LATER[k], view, &scene);
            orbit_move(options->orbit, &scene.camera.eye, scene.camera.center, &scene.camera.up);
            falls = shadow_falls(&scene, options);
        }
    example->finish();
    return !falls;
}

void unused_options(const Example *example, const Options *options, const ParameterValue *defaults,
                    char *text, size_t size)
{
    const Parameter *table = example_parameters(example);
    ParameterValue values[OPTIONS_MAX_PARAMETERS];
    CacheKey all, without;
    text[0] = '\0';
    const int given = count_given(table, options);
    /* With --error an option that is given stays, whatever else it does. */
    if (given < 0 || options->cheap)
        return;
    if (shadows_unused(example, options))
        snprintf(text, size, "--shadows");
    if (given == 0)
        return;
    for (int i = 0; table[i].name; i++)
        values[i] = parameter_save(&table[i]);
    bool done = make_key(example, options, &all);
    for (int i = 0; table[i].name && done; i++) {
        if (!options->own_given[i] || parameter_equal(&table[i], &defaults[i]))
            continue;
        set_without(table, options, i, defaults, values);
        done = make_key(example, options, &without);
        const size_t length = strlen(text);
        if (done && memcmp(&all, &without, sizeof all) == 0)
            snprintf(text + length, size - length, "%s--%s", length ? ", " : "", table[i].name);
        for (int k = 0; table[k].name; k++)
            parameter_restore(&table[k], values[k]);
    }
}
