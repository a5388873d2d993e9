#include "scene/lighting.h"

#include "base/clock.h"
#include "core/mesh_buffer.h"
#include "core/mesh_make.h"
#include "shadows/shadow_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEFINES = 32 };

/* What determines a program: equal recipes give equal programs. */
typedef struct Recipe {
    const char *defines[MAX_DEFINES];
    char *groups[2]; /* of lights, by ShaderStage */
} Recipe;

typedef struct Variant {
    Recipe recipe;
    Shader shader;
    struct Variant *next;
} Variant;

typedef struct Buffered {
    const Mesh *mesh;
    Interpolation remade; /* INTERPOLATION_PHONG: the mesh itself */
    MeshBox box;          /* of `mesh` */
    MeshBuffer buffer;
    struct Buffered *next;
} Buffered;

/* What throws a shadow. */
typedef struct Caster {
    const Mesh *mesh;
    ShadowCaster shadow;
    struct Caster *next;
} Caster;

struct Lighting {
    ShaderLoader loader;
    Variant *variants;
    Buffered *buffers;
    Caster *casters;
    ShadowSettings shadows;
    ShadowMask mask;     /* opened when a scene first needs it */
    ShadowMaps maps;     /* likewise */
    uint32_t map_lights; /* a bit for each whose map the programs that light objects look up; the
                            shadows of others are in masks */
    LightingCounts counts;
    LightingTransforms transforms;
    LightingNormalMatrix *normal_matrix; /* NULL: mat4_normal */
    bool depth_pass;                     /* even where the eye is in a volume */
};

static Mat4 clip_from_object(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object)
{
    (void)eye_from_world, (void)world_from_object;
    return mat4_product(clip_from_eye, eye_from_object);
}

static const LightingTransforms USUAL = {scene_eye_from_object, scene_eye_point, clip_from_object};

void lighting_use_transforms(Lighting *lighting, const LightingTransforms *transforms)
{
    lighting->transforms = transforms ? *transforms : USUAL;
}

void lighting_use_shadows(Lighting *lighting, const ShadowSettings *settings)
{
    lighting->shadows = *settings;
    if (settings->way == SHADOWS_OFF)
        lighting->shadows.way = SHADOWS_DEFAULT.way;
}

void lighting_use_normal_matrix(Lighting *lighting, LightingNormalMatrix *normal_matrix)
{
    lighting->normal_matrix = normal_matrix;
}

void lighting_use_depth_pass(Lighting *lighting, bool depth_pass)
{
    lighting->depth_pass = depth_pass;
}

/* Recipes. */

/* The uniforms of group.glsl, renamed per group. */
static const char *const GROUP_UNIFORMS[] = {
    "u_Position",     "u_Direction",   "u_FrontAmbient",  "u_BackAmbient",
    "u_FrontDiffuse", "u_BackDiffuse", "u_FrontSpecular", "u_BackSpecular",
    "u_Half",         "u_Attenuation", "u_Spot",          "u_Exponent",
};
enum { GROUP_UNIFORM_COUNT = sizeof GROUP_UNIFORMS / sizeof GROUP_UNIFORMS[0] };

/* The defines of group.glsl. 16-bit floats need the guard of the attenuation for any light. */
enum { MAX_GROUP_DEFINES = 12 };
static int group_defines(const LightGroup *group, bool mediump,
                         const char *defines[MAX_GROUP_DEFINES])
{
    const LightTerms *terms = &group->terms;
    const struct {
        bool there;
        const char *name;
    } all[] = {
        {terms->any, "ANY"},
        {terms->kind == LIGHT_DIRECTIONAL, "DIRECTIONAL"},
        {terms->kind == LIGHT_SPOT, "SPOT"},
        {terms->ambient, "AMBIENT"},
        {terms->diffuse, "DIFFUSE"},
        {terms->specular, "SPECULAR"},
        {terms->half_vector, "HALF_VECTOR"},
        {terms->attenuation, "ATTENUATION"},
        {terms->exponent, "EXPONENT"},
        {terms->attenuation && (group->guard_attenuation || mediump), "GUARD_ATTENUATION"},
        {terms->shadow && !terms->at_vertex, "SHADOW"},
        {terms->shadow && !terms->at_vertex && group->count > 1, "CHANNELS"},
    };
    int count = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i].there)
            defines[count++] = all[i].name;
    return count;
}

static int masks_of(const Effects *effects)
{
    int count = 0;
    for (int g = 0; g < effects->group_count; g++)
        count = effects->groups[g].terms.shadow > count ? effects->groups[g].terms.shadow : count;
    return count;
}

/* Whether fragments may be computed in 16 bits. */
static bool is_mediump(const ShaderLoader *loader)
{
    return loader->precision && strcmp(loader->precision, "mediump") == 0;
}

static ShadowLookup lookup_of(const ShadowSettings *settings)
{
    return (ShadowLookup){settings->smooth != 0, settings->bias.x, settings->bias.y,
                          settings->bias.z};
}

/* What each light's code for its map has under a name of its own. */
static const char *const MAP_NAMES[] = {"u_MapScale", "u_MapMove",  "u_MapSize",   "u_MapBias",
                                        "u_Map",      "v_MapPlace", "v_MapNormal", "map_depth",
                                        "hidden",     "find_place", "find_shadow"};
enum { MAP_NAME_COUNT = sizeof MAP_NAMES / sizeof MAP_NAMES[0] };

/* What a program looks up: maps, a bit for each light; and masks, a bit each. */
typedef struct Shadows {
    uint32_t maps, masks;
} Shadows;

static Shadows shadows_of(const Effects *effects, const Scene *scene, const Lighting *lighting)
{
    Shadows shadows = {0, 0};
    for (int g = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        for (int i = 0; group->terms.shadow && i < group->count; i++) {
            const int light = group->lights[i];
            if (lighting->map_lights >> light & 1)
                shadows.maps |= (uint32_t)1 << light;
            else
                shadows.masks |= (uint32_t)1 << effects_channel(scene, light) / SHADOW_CHANNELS;
        }
    }
    return shadows;
}

static void write_map(int light, int look, FILE *file)
{
    const char *defines[LOOK_DEFINES];
    const int count = shadow_map_defines(look, defines);
    for (int i = 0; i < MAP_NAME_COUNT; i++)
        fprintf(file, "#define %s %s%d\n", MAP_NAMES[i], MAP_NAMES[i], light);
    for (int i = 0; i < count; i++)
        fprintf(file, "#define %s\n", defines[i]);
    fprintf(file, "#include \"lighting/shadow_map.glsl\"\n");
    for (int i = 0; i < count; i++)
        fprintf(file, "#undef %s\n", defines[i]);
    for (int i = 0; i < MAP_NAME_COUNT; i++)
        fprintf(file, "#undef %s\n", MAP_NAMES[i]);
}

/* Where the fragments are on the maps. */
static void write_map_places(uint32_t maps, FILE *file)
{
    for (int l = 0; l < SHADOW_MAPS; l++)
        if (maps >> l & 1)
            fprintf(file,
                    "uniform mat4 u_LightFromObject%d;\nuniform mat4 u_LightNormal%d;\n"
                    "varying vec3 v_MapPlace%d;\nvarying vec3 v_MapNormal%d;\n",
                    l, l, l, l);
    fprintf(file, "void place_on_maps() {\n");
    for (int l = 0; l < SHADOW_MAPS; l++)
        if (maps >> l & 1)
            fprintf(file,
                    "    v_MapPlace%d = (u_LightFromObject%d * a_Position).xyz;\n"
                    "    v_MapNormal%d = (u_LightNormal%d * vec4(a_Normal, 0.0)).xyz;\n",
                    l, l, l, l);
    fprintf(file, "}\n");
}

/* Once for all groups: the share of each light that is in shadow, of four lights in a vector.
 * Depths and places need highp, which the loader replaces in mediump. There gl_FragCoord has 11
 * bits, too few for the size of a framebuffer: the place comes from the vertex shader. */
static void write_shadows(const Effects *effects, const Scene *scene, const Lighting *lighting,
                          FILE *file)
{
    const Shadows shadows = shadows_of(effects, scene, lighting);
    const ShadowLookup lookup = lookup_of(&lighting->shadows);
    const bool mediump = is_mediump(&lighting->loader);
    const int count = masks_of(effects);
    if (!count)
        return;
    fprintf(file, "#define LOOK_UP_SHADOWS\n");
    for (int m = 0; m < count; m++)
        fprintf(file, "vec4 shadow_mask%d = vec4(0.0);\n", m);
    fprintf(file, mediump ? "#undef highp\nprecision highp float;\n" : "");
    for (int l = 0; l < scene->light_count; l++)
        if (shadows.maps >> l & 1)
            write_map(l, shadow_map_look(&lighting->maps, l, 0, &lookup), file);
    for (int m = 0; m < count; m++)
        if (shadows.masks >> m & 1)
            fprintf(file, "uniform sampler2D u_Mask%d;\n", m);
    if (shadows.masks)
        fprintf(file,
                "uniform vec4 u_MaskPlace;\n%s"
                "vec2 mask_place() { return %s * u_MaskPlace.xy + u_MaskPlace.zw; }\n",
                mediump ? "varying vec3 v_MaskPlace;\n" : "",
                mediump ? "(v_MaskPlace.xy / v_MaskPlace.z)" : "gl_FragCoord.xy");
    fprintf(file, "void look_up_shadows() {\n");
    for (int m = 0; m < count; m++)
        if (shadows.masks >> m & 1)
            fprintf(file, "    shadow_mask%d = texture2D(u_Mask%d, mask_place());\n", m, m);
    for (int l = 0; l < scene->light_count; l++)
        if (shadows.maps >> l & 1)
            fprintf(file, "    shadow_mask%d.%c = find_shadow%d();\n",
                    effects_channel(scene, l) / SHADOW_CHANNELS,
                    "rgba"[effects_channel(scene, l) % SHADOW_CHANNELS], l);
    fprintf(file, "}\n%s", mediump ? "precision mediump float;\n#define highp mediump\n" : "");
}

/* Of light that is computed at the vertices the part that a shadow keeps off is interpolated for
 * each light alone. In the vertex shader: where; in the fragment shader: their sum. */
static void write_vertex_shadows(const Effects *effects, const Scene *scene, bool at_vertex,
                                 FILE *file)
{
    int count = 0;
    for (int g = 0; g < effects->group_count; g++)
        if (effects->groups[g].terms.at_vertex && effects->groups[g].terms.shadow)
            count += effects->groups[g].count;
    if (!count)
        return;
    fprintf(file, "varying vec3 v_FrontDirect[%d];\n", count);
    if (effects->two_sided)
        fprintf(file, "varying vec3 v_BackDirect[%d];\n", count);
    if (at_vertex)
        return;
    fprintf(file, "#define SHADOWED_LIGHT vec3(0.0)");
    for (int g = 0, first = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        for (int i = 0; group->terms.at_vertex && group->terms.shadow && i < group->count; i++) {
            const int channel = effects_channel(scene, group->lights[i]) % SHADOW_CHANNELS;
            fprintf(file, " + (1.0 - shadow_mask%d.%c) * SIDE(v_FrontDirect[%d], v_BackDirect[%d])",
                    group->terms.shadow - 1, "rgba"[channel], first, first);
            first++;
        }
    }
    fprintf(file, "\n");
}

/* What of a light of the group is in shadow: one channel, if the group has but one light. */
static void write_shadowed(const Scene *scene, const LightGroup *group, int g, FILE *file)
{
    const int mask = group->terms.shadow - 1;
    if (group->count > 1)
        fprintf(file,
                "#define u_Channel u_Channel%d\n"
                "#define SHADOWED dot(shadow_mask%d, u_Channel[i])\n",
                g, mask);
    else
        fprintf(file, "#define SHADOWED shadow_mask%d.%c\n", mask,
                "rgba"[effects_channel(scene, group->lights[0]) % SHADOW_CHANNELS]);
}

/* The text of "lighting/vertex_groups.glsl" or "lighting/fragment_groups.glsl": a function per
 * group, and add_lights, which calls them. */
static char *groups_text(const Effects *effects, const Scene *scene, const Lighting *lighting,
                         bool at_vertex)
{
    char *text = NULL;
    size_t size = 0;
    int shadowed = 0; /* at the vertices, so far */
    const Shadows shadows = shadows_of(effects, scene, lighting);
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
    if (!at_vertex)
        write_shadows(effects, scene, lighting, file);
    else if (shadows.maps)
        write_map_places(shadows.maps, file);
    write_vertex_shadows(effects, scene, at_vertex, file);
    for (int g = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        const char *defines[MAX_GROUP_DEFINES];
        const int count = group_defines(group, is_mediump(&lighting->loader), defines);
        if (group->terms.at_vertex != at_vertex)
            continue;
        fprintf(file, "#define GROUP group%d\n#define COUNT %d\n", g, group->count);
        for (int i = 0; i < count; i++)
            fprintf(file, "#define %s\n", defines[i]);
        for (int i = 0; i < GROUP_UNIFORM_COUNT; i++)
            fprintf(file, "#define %s %s%d\n", GROUP_UNIFORMS[i], GROUP_UNIFORMS[i], g);
        if (group->terms.shadow && at_vertex)
            fprintf(file, "#define VERTEX_SHADOW %d\n", shadowed);
        else if (group->terms.shadow)
            write_shadowed(scene, group, g, file);
        shadowed += group->terms.shadow ? group->count : 0;
        fprintf(file, "#include \"lighting/group.glsl\"\n#undef GROUP\n#undef COUNT\n");
        for (int i = 0; i < count; i++)
            fprintf(file, "#undef %s\n", defines[i]);
        for (int i = 0; i < GROUP_UNIFORM_COUNT; i++)
            fprintf(file, "#undef %s\n", GROUP_UNIFORMS[i]);
        if (group->terms.shadow)
            fprintf(file,
                    at_vertex ? "#undef VERTEX_SHADOW\n" : "#undef u_Channel\n#undef SHADOWED\n");
    }
    fprintf(file, "void add_lights(vec3 normal, vec3 position, vec3 viewer, bool front, inout vec3 "
                  "color) {\n");
    for (int g = 0; g < effects->group_count; g++)
        if (effects->groups[g].terms.at_vertex == at_vertex)
            fprintf(file, "    group%d(normal, position, viewer, front, color);\n", g);
    fprintf(file, "}\n");
    fclose(file);
    return text;
}

static bool recipe_open(Recipe *recipe, const Effects *effects, const Scene *scene,
                        const Lighting *lighting, Message *message)
{
    const bool mediump = is_mediump(&lighting->loader);
    const Shadows shadows = shadows_of(effects, scene, lighting);
    /* By ShaderStage. What is clamped at the vertices is computed there, the base too. */
    bool lights[2] = {[SHADER_VERTEX] = effects->clamp_vertex}, position[2] = {false};
    bool normals[2] = {false}, colored[2] = {false};
    bool specular = false, full = false, vertex_shadows = false;
    for (int g = 0; g < effects->group_count; g++) {
        const LightTerms *terms = &effects->groups[g].terms;
        const int stage = terms->at_vertex ? SHADER_VERTEX : SHADER_FRAGMENT;
        lights[stage] = true;
        position[stage] |=
            terms->kind != LIGHT_DIRECTIONAL || (terms->specular && effects->local_viewer);
        normals[stage] |= terms->diffuse || terms->specular;
        colored[stage] |= effects->vertex_color && (terms->ambient || terms->diffuse);
        specular |= terms->specular;
        full |= terms->any;
        vertex_shadows |= terms->shadow && terms->at_vertex;
    }
    colored[lights[SHADER_VERTEX] ? SHADER_VERTEX : SHADER_FRAGMENT] |=
        effects->vertex_color && effects->base;
    const struct {
        bool there;
        const char *define;
    } all[] = {
        {full, "FULL"},
        {mediump, "MEDIUMP"},
        {effects->base, "BASE"},
        {effects->alpha, "ALPHA"},
        {effects->vertex_color, "VERTEX_COLOR"},
        {colored[SHADER_FRAGMENT], "FRAGMENT_COLOR"},
        {effects->lit_positions && lights[SHADER_VERTEX], "LIT_POSITION"},
        {effects->two_sided, "TWO_SIDED"},
        {lights[SHADER_VERTEX], "VERTEX_LIGHTS"},
        {lights[SHADER_FRAGMENT], "FRAGMENT_LIGHTS"},
        {vertex_shadows, "VERTEX_SHADOWS"},
        {shadows.maps != 0, "SHADOW_MAPS"},
        {mediump && shadows.masks, "MASK_PLACE"},
        {position[SHADER_VERTEX] || position[SHADER_FRAGMENT], "POSITION"},
        {position[SHADER_FRAGMENT], "FRAGMENT_POSITION"},
        {normals[SHADER_VERTEX] || normals[SHADER_FRAGMENT], "NORMALS"},
        {normals[SHADER_FRAGMENT], "FRAGMENT_NORMALS"},
        {effects->normal_matrix, "NORMAL_MATRIX"},
        {effects->normalize_vertex, "NORMALIZE_VERTEX"},
        {effects->normalize_fragment, "NORMALIZE_FRAGMENT"},
        {effects->local_viewer, "LOCAL_VIEWER"},
        {specular, "SHININESS"},
        {specular && effects->reflection == REFLECTION_PHONG, "PHONG"},
        {effects->clamp_vertex, "CLAMP_VERTEX"},
        {effects->linear, "LINEAR"},
        {effects->show_clipped, "SHOW_CLIPPED"},
        {effects->limit, "LIMIT"},
    };
    *recipe = (Recipe){{NULL}, {NULL}};
    for (size_t i = 0, count = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i].there)
            recipe->defines[count++] = all[i].define;
    recipe->groups[SHADER_VERTEX] = groups_text(effects, scene, lighting, true);
    recipe->groups[SHADER_FRAGMENT] = groups_text(effects, scene, lighting, false);
    if (recipe->groups[SHADER_VERTEX] && recipe->groups[SHADER_FRAGMENT])
        return true;
    return message_set(message, "lighting: not enough memory");
}

static void recipe_close(Recipe *recipe)
{
    free(recipe->groups[SHADER_VERTEX]);
    free(recipe->groups[SHADER_FRAGMENT]);
    *recipe = (Recipe){{NULL}, {NULL}};
}

/* The defines are string literals of this file, so pointers are compared. */
static bool recipe_equal(const Recipe *a, const Recipe *b)
{
    return memcmp(a->defines, b->defines, sizeof a->defines) == 0 &&
           strcmp(a->groups[0], b->groups[0]) == 0 && strcmp(a->groups[1], b->groups[1]) == 0;
}

/* A loader for this recipe; `texts` has room for three. */
static ShaderLoader recipe_loader(const Recipe *recipe, const ShaderLoader *base,
                                  ShaderText texts[3])
{
    ShaderLoader loader = *base;
    texts[0] = (ShaderText){"lighting/vertex_groups.glsl", recipe->groups[SHADER_VERTEX]};
    texts[1] = (ShaderText){"lighting/fragment_groups.glsl", recipe->groups[SHADER_FRAGMENT]};
    texts[2] = (ShaderText){NULL, NULL};
    loader.texts = texts;
    loader.defines = recipe->defines;
    return loader;
}

/* Programs and buffers. */

static const Variant *find_variant(Lighting *lighting, const Scene *scene, const Effects *effects,
                                   Message *message)
{
    Recipe recipe;
    ShaderText texts[3];
    if (!recipe_open(&recipe, effects, scene, lighting, message)) {
        recipe_close(&recipe);
        return NULL;
    }
    for (const Variant *variant = lighting->variants; variant; variant = variant->next) {
        if (recipe_equal(&variant->recipe, &recipe)) {
            recipe_close(&recipe);
            return variant;
        }
    }
    Variant *variant = calloc(1, sizeof *variant);
    const ShaderLoader loader = recipe_loader(&recipe, &lighting->loader, texts);
    const double start = clock_now();
    if (!variant || !shader_open(&variant->shader, &loader, "lighting", message)) {
        message_set(message, "lighting: not enough memory");
        recipe_close(&recipe);
        free(variant);
        return NULL;
    }
    lighting->counts.programs++;
    lighting->counts.compile_seconds += clock_now() - start;
    variant->recipe = recipe;
    variant->next = lighting->variants;
    lighting->variants = variant;
    return variant;
}

/* A copy as this interpolation needs it. */
static bool remade_copy(const Mesh *mesh, Interpolation kind, Mesh *made, Message *message)
{
    if (!mesh_copy(made, mesh, message))
        return false;
    if (kind == INTERPOLATION_FLAT ? mesh_flatten(made, message) : mesh_provoke(made, message))
        return true;
    mesh_close(made);
    return false;
}

/* How an object's mesh must be remade; INTERPOLATION_PHONG: not at all. */
static Interpolation remade_for(const Scene *scene, const Object *object)
{
    const bool flatten = scene->interpolation == INTERPOLATION_FLAT && !object->flat;
    return flatten || scene->interpolation == INTERPOLATION_CONSTANT ? scene->interpolation
                                                                     : INTERPOLATION_PHONG;
}

static const Buffered *find_buffer(Lighting *lighting, const Mesh *mesh, Interpolation remade,
                                   Message *message)
{
    for (const Buffered *buffered = lighting->buffers; buffered; buffered = buffered->next)
        if (buffered->mesh == mesh && buffered->remade == remade)
            return buffered;
    Buffered *buffered = calloc(1, sizeof *buffered);
    Mesh made = {0};
    if (!buffered) {
        message_set(message, "lighting: not enough memory");
        return NULL;
    }
    const bool own = remade != INTERPOLATION_PHONG;
    const bool done = (!own || remade_copy(mesh, remade, &made, message)) &&
                      mesh_buffer_open(&buffered->buffer, own ? &made : mesh, message);
    mesh_close(&made);
    if (!done) {
        free(buffered);
        return NULL;
    }
    buffered->mesh = mesh;
    buffered->remade = remade;
    buffered->box = mesh_bounds(mesh);
    buffered->next = lighting->buffers;
    lighting->buffers = buffered;
    return buffered;
}

static void forget_casters(Lighting *lighting, const Mesh *mesh)
{
    for (Caster **link = &lighting->casters; *link;) {
        Caster *caster = *link;
        if (mesh && caster->mesh != mesh) {
            link = &caster->next;
            continue;
        }
        *link = caster->next;
        shadow_caster_close(&caster->shadow);
        free(caster);
    }
}

void lighting_forget(Lighting *lighting, const Mesh *mesh)
{
    forget_casters(lighting, mesh);
    shadow_mask_forget(&lighting->mask);
    shadow_maps_forget(&lighting->maps);
    for (Buffered **link = &lighting->buffers; *link;) {
        Buffered *buffered = *link;
        if (mesh && buffered->mesh != mesh) {
            link = &buffered->next;
            continue;
        }
        *link = buffered->next;
        mesh_buffer_close(&buffered->buffer);
        free(buffered);
    }
}

/* Uniforms. GL ignores location -1, that of a uniform the program lacks. */

static void set_float(GLuint program, const char *name, double value)
{
    const float rounded = (float)value;
    glUniform1fv(glGetUniformLocation(program, name), 1, &rounded);
}

static void set_vec3(GLuint program, const char *name, Vec3 value)
{
    shader_set_vec3(glGetUniformLocation(program, name), value);
}

static void set_mat4(GLuint program, const char *name, Mat4 value)
{
    shader_set_mat4(glGetUniformLocation(program, name), value);
}

/* `count` vectors of `size` components to a uniform array of group `g`. */
static void set_array(GLuint program, const char *name, int g, int size, int count,
                      const float *values)
{
    char full_name[32];
    snprintf(full_name, sizeof full_name, "%s%d", name, g);
    const GLint location = glGetUniformLocation(program, full_name);
    if (size == 1)
        glUniform1fv(location, count, values);
    else if (size == 3)
        glUniform3fv(location, count, values);
    else
        glUniform4fv(location, count, values);
}

static Vec3 multiply(Vec3 a, Vec3 b)
{
    return (Vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* The attenuation factor of a light that does not depend on distance: 1 / constant. */
static double constant_share(const Light *light)
{
    const bool shared = light->kind != LIGHT_DIRECTIONAL && !light_fades(light);
    /* Within the range of float. */
    return shared && light->constant != 0 ? 1 / fmax(light->constant, 1e-30) : 1;
}

/* Constant ambient light that the material reflects. In the full program each light adds its own.
 */
static Vec3 base_ambient(const Scene *scene, const Material *material, bool full)
{
    Vec3 sum = multiply(scene->global_ambient, material->ambient);
    for (int i = 0; i < scene->light_count && !full; i++) {
        const Light *light = &scene->lights[i];
        if (!light->off && !light_ambient_varies(light))
            sum = vec3_add(sum, vec3_scale(multiply(light->ambient, material->ambient),
                                           constant_share(light)));
    }
    return sum;
}

static Vec3 at_max(Vec3 a, double max)
{
    return (Vec3){fmin(a.x, max), fmin(a.y, max), fmin(a.z, max)};
}

/* The products of light and material colors, in the color uniforms. */
static void set_colors(GLuint program, const Scene *scene, const LightGroup *group, int g,
                       const Material *material, bool mediump, const char *const names[3])
{
    /* A 16-bit float overflows above 65504, and infinity times 0 is NaN. The three terms are added
     * before they are attenuated. */
    const double max = mediump && !group->terms.at_vertex ? 2e4 : INFINITY;
    float values[3][3 * EFFECTS_MAX_LIGHTS];
    for (int i = 0; i < group->count; i++) {
        const Light *light = &scene->lights[group->lights[i]];
        /* In the full program a light that is off is black, and attenuation has its own uniform. */
        const double share = light->off ? 0 : group->terms.any ? 1 : constant_share(light);
        const Vec3 products[3] = {multiply(light->ambient, material->ambient),
                                  multiply(light->diffuse, material->diffuse),
                                  multiply(light->specular, material->specular)};
        for (int k = 0; k < 3; k++)
            vec3_to_float(at_max(vec3_scale(products[k], share), max), &values[k][3 * i]);
    }
    for (int k = 0; k < 3; k++)
        set_array(program, names[k], g, 3, group->count, values[k]);
}

/* A light in eye coordinates: the direction is a unit vector. */
static Light eye_light(const LightingTransforms *transforms, const Camera *camera,
                       Mat4 eye_from_world, const Light *given)
{
    Light light = *given;
    vec3_normalize(given->direction, &light.direction);
    if (given->space == LIGHT_WORLD) {
        light.direction = mat4_transform_direction(eye_from_world, light.direction);
        light.position = transforms->eye_point(camera, eye_from_world, given->position);
    }
    return light;
}

/* Each light's channel of its mask. */
static void set_channels(GLuint program, const Scene *scene, const LightGroup *group, int g)
{
    float channels[4 * EFFECTS_MAX_LIGHTS] = {0};
    for (int i = 0; i < group->count; i++)
        channels[4 * i + effects_channel(scene, group->lights[i]) % SHADOW_CHANNELS] = 1;
    set_array(program, "u_Channel", g, 4, group->count, channels);
}

static void set_group(GLuint program, const LightingTransforms *transforms, const Scene *scene,
                      Mat4 eye_from_world, const LightGroup *group, int g)
{
    float position[4 * EFFECTS_MAX_LIGHTS], direction[3 * EFFECTS_MAX_LIGHTS];
    float half[3 * EFFECTS_MAX_LIGHTS], attenuation[3 * EFFECTS_MAX_LIGHTS];
    float spot[4 * EFFECTS_MAX_LIGHTS], exponent[EFFECTS_MAX_LIGHTS];
    static const double RADIANS = 0.017453292519943295;
    const int size = group->terms.any ? 4 : 3; /* of a position */
    for (int i = 0; i < group->count; i++) {
        const Light made =
            eye_light(transforms, &scene->camera, eye_from_world, &scene->lights[group->lights[i]]);
        const Light *light = &made;
        const bool directional = light->kind == LIGHT_DIRECTIONAL;
        const Vec3 direction_eye = light->direction;
        const Vec3 place = directional ? direction_eye : light->position;
        Vec3 half_eye;
        vec3_to_float(place, &position[size * i]);
        if (size == 4)
            position[4 * i + 3] = directional ? 0 : 1;
        vec3_to_float(direction_eye, &direction[3 * i]);
        vec3_normalize(vec3_add(direction_eye, (Vec3){0, 0, 1}), &half_eye);
        vec3_to_float(half_eye, &half[3 * i]);
        const bool none = light->constant == 0 && light->linear == 0 && light->quadratic == 0;
        vec3_to_float(directional || none
                          ? (Vec3){1, 0, 0}
                          : (Vec3){light->constant, light->linear, light->quadratic},
                      &attenuation[3 * i]);
        vec3_to_float(direction_eye, &spot[4 * i]);
        /* No cosine is below -1, so that other lights shine in every direction. */
        spot[4 * i + 3] = light->kind == LIGHT_SPOT ? (float)cos(light->cutoff * RADIANS) : -2.0F;
        exponent[i] = light->kind == LIGHT_SPOT ? (float)light->exponent : 0;
    }
    set_array(program, "u_Position", g, size, group->count, position);
    set_array(program, "u_Direction", g, 3, group->count, direction);
    set_array(program, "u_Half", g, 3, group->count, half);
    set_array(program, "u_Attenuation", g, 3, group->count, attenuation);
    set_array(program, "u_Spot", g, 4, group->count, spot);
    set_array(program, "u_Exponent", g, 1, group->count, exponent);
    if (group->terms.shadow && group->count > 1)
        set_channels(program, scene, group, g);
}

/* Emission and constant ambient light; with vertex colors, which the latter is multiplied by, in
 * two uniforms. */
static void set_base(GLuint program, const char *base, const char *tint, const Scene *scene,
                     const Material *material, bool colored, bool full)
{
    const Vec3 ambient = base_ambient(scene, material, full);
    set_vec3(program, base, colored ? material->emission : vec3_add(material->emission, ambient));
    set_vec3(program, tint, ambient);
}

static void set_materials(GLuint program, const Scene *scene, const Object *object,
                          const Effects *effects, bool full, bool mediump)
{
    static const char *const front[3] = {"u_FrontAmbient", "u_FrontDiffuse", "u_FrontSpecular"};
    static const char *const back[3] = {"u_BackAmbient", "u_BackDiffuse", "u_BackSpecular"};
    /* In the full program one-sided objects have two equal sides. */
    const Material sides[2] = {effects_material(object, false), effects_material(object, true)};
    const Material *before = &sides[0], *behind = &sides[1];
    const bool colored = effects->vertex_color;
    set_base(program, "u_FrontBase", "u_FrontTint", scene, before, colored, full);
    set_float(program, "u_FrontAlpha", before->alpha);
    set_float(program, "u_FrontShininess", before->shininess);
    set_float(program, "u_VertexFrontShininess", before->shininess);
    for (int g = 0; g < effects->group_count; g++)
        set_colors(program, scene, &effects->groups[g], g, before, mediump, front);
    if (!effects->two_sided)
        return;
    set_base(program, "u_BackBase", "u_BackTint", scene, behind, colored, full);
    set_float(program, "u_BackAlpha", behind->alpha);
    set_float(program, "u_BackShininess", behind->shininess);
    set_float(program, "u_VertexBackShininess", behind->shininess);
    set_float(program, "u_BackNormal", object->two_sided ? -1 : 1);
    set_float(program, "u_VertexBackNormal", object->two_sided ? -1 : 1);
    for (int g = 0; g < effects->group_count; g++)
        set_colors(program, scene, &effects->groups[g], g, behind, mediump, back);
}

/* Shadows. */

/* Which light's shadows may fall on what, a bit for each light: empty without shadows. */
typedef struct ShadowPlan {
    int count;                   /* of objects */
    uint32_t *receives, *throws; /* of each object */
    MeshBox *boxes;
    PlacedBox *placed; /* the same in the world */
    uint32_t all;      /* the lights that something receives */
} ShadowPlan;

static void plan_close(ShadowPlan *plan)
{
    free(plan->receives);
    free(plan->throws);
    free(plan->boxes);
    free(plan->placed);
    *plan = (ShadowPlan){.count = 0};
}

static void plan_pair(ShadowPlan *plan, const Scene *scene, int occluder, int receiver)
{
    for (int l = 0; l < scene->light_count; l++) {
        if (!effects_may_shadow(scene, l, occluder, receiver, plan->boxes, plan->placed))
            continue;
        plan->receives[receiver] |= (uint32_t)1 << l;
        plan->throws[occluder] |= (uint32_t)1 << l;
        plan->all |= (uint32_t)1 << l;
    }
}

static bool plan_open(ShadowPlan *plan, Lighting *lighting, const Scene *scene, Message *message)
{
    const size_t count = (size_t)scene->object_count;
    bool any = false, on = false;
    *plan = (ShadowPlan){.count = 0};
    for (int l = 0; l < scene->light_count; l++) {
        any |= scene->lights[l].shadows;
        on |= scene->lights[l].shadows && !scene->lights[l].off;
    }
    if (!any)
        return true; /* the full program has masks of lights that are off, too */
    if (on && scene->clamp_vertex && scene->interpolation != INTERPOLATION_PHONG)
        return message_set(message, "shadows are looked up at the fragments: light that is clamped "
                                    "at the vertices has none");
    *plan = (ShadowPlan){.count = scene->object_count,
                         .receives = calloc(count + 1, sizeof *plan->receives),
                         .throws = calloc(count + 1, sizeof *plan->throws),
                         .boxes = calloc(count + 1, sizeof *plan->boxes),
                         .placed = calloc(count + 1, sizeof *plan->placed)};
    if (!plan->receives || !plan->throws || !plan->boxes || !plan->placed) {
        plan_close(plan);
        return message_set(message, "shadows: not enough memory for %zu objects", count);
    }
    for (size_t i = 0; i < count; i++) {
        const Buffered *buffered =
            find_buffer(lighting, scene->objects[i].mesh, INTERPOLATION_PHONG, message);
        if (!buffered) {
            plan_close(plan);
            return false;
        }
        plan->boxes[i] = buffered->box;
        plan->placed[i] = placed_box(&buffered->box, scene->objects[i].world_from_object);
    }
    for (int o = 0; o < scene->object_count; o++)
        for (int r = 0; r < scene->object_count; r++)
            plan_pair(plan, scene, o, r);
    return true;
}

static const Caster *find_caster(Lighting *lighting, const Mesh *mesh, Message *message)
{
    for (const Caster *caster = lighting->casters; caster; caster = caster->next)
        if (caster->mesh == mesh)
            return caster;
    Caster *caster = calloc(1, sizeof *caster);
    if (!caster || !shadow_caster_open(&caster->shadow, mesh, message)) {
        message_set(message, "shadows: not enough memory");
        free(caster);
        return NULL;
    }
    caster->mesh = mesh;
    caster->next = lighting->casters;
    lighting->casters = caster;
    return caster;
}

/* What the masks of a frame are drawn from. */
typedef struct ShadowFrame {
    const Scene *scene;
    const ShadowPlan *plan;
    Mat4 eye_from_world, clip_from_eye;
    bool full, in_parts; /* the latter: lights of an object may be others than the scene's */
} ShadowFrame;

static ShadowSurface surface_of(Lighting *lighting, const ShadowFrame *frame, int number)
{
    const LightingTransforms *transforms = &lighting->transforms;
    const Object *object = &frame->scene->objects[number];
    const Mat4 eye_from_object = transforms->eye_from_object(
        &frame->scene->camera, frame->eye_from_world, object->world_from_object);
    const Effects effects = effects_of_boxed(frame->scene, object, &frame->plan->boxes[number], 0);
    return (ShadowSurface){
        .buffer = &find_buffer(lighting, object->mesh, INTERPOLATION_PHONG, NULL)->buffer,
        .clip_from_object =
            transforms->clip_from_object(frame->clip_from_eye, frame->eye_from_world,
                                         object->world_from_object, eye_from_object),
        .mirrored = mat4_determinant(eye_from_object) < 0,
        .clockwise = object->clockwise,
        .cull = effects.cull,
        .behind_lines = object->behind_lines};
}

/* A closed mesh may leave out half of its triangles: see SilhouetteFacing. */
static SilhouetteFacing facing_of(const ShadowFrame *frame, int number, bool closed, Vec4 light)
{
    const Object *object = &frame->scene->objects[number];
    const MeshBox *box = &frame->plan->boxes[number];
    const bool outside = light.w == 0 || light.x < box->low.x || light.x > box->high.x ||
                         light.y < box->low.y || light.y > box->high.y || light.z < box->low.z ||
                         light.z > box->high.z;
    if (!closed)
        return SILHOUETTE_ALL;
    if (object_is_convex(object))
        return SILHOUETTE_UNLIT;
    return outside ? SILHOUETTE_LIT : SILHOUETTE_ALL;
}

/* From the eye to the near plane, as far as it is seen. */
static PlacedBox eye_box(const ShadowFrame *frame)
{
    const Camera *camera = &frame->scene->camera;
    /* Eye coordinates, of the rotation: its rows are the axes. */
    const double *m = frame->eye_from_world.m, *p = frame->clip_from_eye.m;
    const Vec3 right = {m[0], m[4], m[8]}, up = {m[1], m[5], m[9]}, back = {m[2], m[6], m[10]};
    return (PlacedBox){.center = vec3_add(camera->eye, vec3_scale(back, -0.5 * camera->near)),
                       .half = {vec3_scale(right, camera->near / p[0]),
                                vec3_scale(up, camera->near / p[5]),
                                vec3_scale(back, 0.5 * camera->near)}};
}

/* Whether the near plane may lie in the shadow: then the eye may, too. */
static bool eye_in_shadow(const ShadowFrame *frame, int number, const Light *light)
{
    const PlacedBox seen = eye_box(frame);
    return may_come_between(&frame->plan->placed[number], &seen, light_place(light));
}

/* Where a box begins along a direction, and where it ends. */
static double box_least(const PlacedBox *box, Vec3 way)
{
    return vec3_dot(box->center, way) - placed_reach(box, way);
}

static double box_most(const PlacedBox *box, Vec3 way)
{
    return vec3_dot(box->center, way) + placed_reach(box, way);
}

/* The least of what receives a light's shadows along a direction, less a little. */
static double receivers_least(const ShadowFrame *frame, int light, Vec3 way)
{
    double least = INFINITY, most = -INFINITY;
    for (int r = 0; r < frame->plan->count; r++) {
        if (!(frame->full || frame->plan->receives[r] >> light & 1))
            continue;
        least = fmin(least, box_least(&frame->plan->placed[r], way));
        most = fmax(most, box_most(&frame->plan->placed[r], way));
    }
    return least - 1e-3 * (most - least) - 1e-5 * fabs(least);
}

/* Looks for the plane before which all receivers lie that ends a caster's volume the soonest: of
 * those along the sides of the receivers' boxes. Infinity, if there is none. */
static Vec4 find_end(const ShadowFrame *frame, int number, int light_number, const Light *light)
{
    static const double FAR = 1e6; /* a light's distance that leaves no digits of a float */
    const Vec4 none = {0, 0, 0, 1};
    const PlacedBox *caster = &frame->plan->placed[number];
    const bool directional = light->kind == LIGHT_DIRECTIONAL;
    double soonest = INFINITY;
    Vec4 found = none;
    if (!directional && vec3_length(vec3_subtract(light->position, caster->center)) >
                            FAR * vec3_length(vec3_add(caster->half[0], caster->half[1])))
        return none;
    for (int k = 0; k < 6 * frame->plan->count; k++) {
        const Vec3 *half = frame->plan->placed[k / 6].half;
        Vec3 way;
        if (!vec3_normalize(vec3_cross(half[k / 2 % 3], half[(k / 2 + 1) % 3]), &way))
            continue;
        way = vec3_scale(way, k % 2 ? -1 : 1);
        /* The light is on the plane's other side, and the caster between them. */
        const double least = receivers_least(frame, light_number, way);
        const double most = box_most(caster, way);
        const double lights =
            directional ? vec3_dot(light->direction, way) : vec3_dot(light->position, way) - most;
        const double steps = (vec3_dot(caster->center, way) - least) / lights;
        if (lights > 0 && box_least(caster, way) > least && steps < soonest) {
            soonest = steps;
            found = (Vec4){way.x, way.y, way.z, -least};
        }
    }
    return found;
}

/* Whether the near plane may lie beyond the end of a volume: then the eye sees into it there. */
static bool eye_beyond(const ShadowFrame *frame, Vec4 end)
{
    const PlacedBox seen = eye_box(frame);
    return box_least(&seen, (Vec3){end.x, end.y, end.z}) + end.w < 0;
}

/* In object coordinates. */
static Vec4 plane_of_object(Vec4 plane, Mat4 world_from_object)
{
    return mat4_transform(mat4_transpose(world_from_object), plane);
}

/* What is the same for volumes and flattened shadows, which end at a plane. */
static bool make_throw(Lighting *lighting, const ShadowFrame *frame, const Light *light, int number,
                       Vec4 end, ShadowThrow *thrown, Message *message)
{
    const Object *object = &frame->scene->objects[number];
    Mat4 object_from_world;
    if (!mat4_inverse(object->world_from_object, &object_from_world))
        return message_set(message, "object %d is flattened, and throws no shadow by volumes",
                           number);
    const Caster *caster = find_caster(lighting, object->mesh, message);
    if (!caster)
        return false;
    *thrown = (ShadowThrow){.surface = surface_of(lighting, frame, number),
                            .caster = &caster->shadow,
                            .light_object = mat4_transform(object_from_world, light_place(light)),
                            .end = plane_of_object(end, object->world_from_object)};
    return true;
}

/* Whether light may fall where the mesh's normals say that none does: the object is drawn with
 * others, with a normal of the triangle, with another light, in 16 bits, or its back is where the
 * mesh has its front. */
static bool has_odd_normals(const Lighting *lighting, const ShadowFrame *frame,
                            const Object *object)
{
    return object->wrong_normals || lighting->normal_matrix || frame->in_parts ||
           frame->scene->interpolation == INTERPOLATION_FLAT || is_mediump(&lighting->loader) ||
           (object->two_sided && object->clockwise);
}

static bool cast_shadow(Lighting *lighting, const ShadowFrame *frame, const Light *light,
                        int light_number, int number, Message *message)
{
    const Vec4 end = find_end(frame, number, light_number, light);
    ShadowThrow thrown;
    if (!make_throw(lighting, frame, light, number, end, &thrown, message))
        return false;
    thrown.two_sided = frame->scene->objects[number].two_sided;
    thrown.behind = !lighting->depth_pass && eye_in_shadow(frame, number, light);
    thrown.own = frame->full || frame->plan->receives[number] >> light_number & 1;
    thrown.odd = has_odd_normals(lighting, frame, &frame->scene->objects[number]);
    thrown.beyond = eye_beyond(frame, end);
    thrown.facing = facing_of(frame, number, thrown.caster->silhouette.closed, thrown.light_object);
    return shadow_mask_cast(&lighting->mask, &thrown, message);
}

/* The plane of a flat object, with the light on its positive side; false: it is not flat. */
static bool flat_plane(const ShadowFrame *frame, int number, const Light *light, Vec4 *plane)
{
    const MeshBox *box = &frame->plan->boxes[number];
    const PlacedBox *placed = &frame->plan->placed[number];
    const double thick[3] = {box->high.x - box->low.x, box->high.y - box->low.y,
                             box->high.z - box->low.z};
    const Vec4 place = light_place(light);
    for (int k = 0; k < 3; k++) {
        Vec3 way;
        if (thick[k] != 0 ||
            !vec3_normalize(vec3_cross(placed->half[(k + 1) % 3], placed->half[(k + 2) % 3]), &way))
            continue;
        const double offset = vec3_dot(way, placed->center);
        const bool before = way.x * place.x + way.y * place.y + way.z * place.z > offset * place.w;
        way = vec3_scale(way, before ? 1 : -1);
        *plane = (Vec4){way.x, way.y, way.z, before ? -offset : offset};
        return true;
    }
    return false;
}

/* The first object that receives a light's shadows and is not flat, or is one too many; -1: none.
 */
static int not_flat(const ShadowFrame *frame, int number, const Light *light)
{
    int count = 0;
    Vec4 plane;
    for (int r = 0; r < frame->plan->count; r++) {
        if (!(frame->plan->receives[r] >> number & 1))
            continue;
        if (count++ >= SHADOW_FLATS || !flat_plane(frame, r, light, &plane))
            return r;
    }
    return -1;
}

static bool flatten_shadows(Lighting *lighting, const ShadowFrame *frame, const Light *light,
                            int number, Message *message)
{
    ShadowThrow thrown;
    Vec4 plane;
    for (int r = frame->plan->count - 1, flats = 0; r >= 0; r--) {
        if (!(frame->plan->receives[r] >> number & 1) || !flat_plane(frame, r, light, &plane))
            continue;
        const ShadowSurface surface = surface_of(lighting, frame, r);
        shadow_mask_flat(&lighting->mask, &surface, flats);
        for (int o = 0; o < frame->plan->count; o++)
            if (frame->plan->throws[o] >> number & 1 && o != r &&
                (!make_throw(lighting, frame, light, o, plane, &thrown, message) ||
                 !shadow_mask_flatten(&lighting->mask, &thrown, flats, message)))
                return false;
        flats++;
    }
    return true;
}

/* Maps. */

static int fit_maps(const Lighting *lighting, const ShadowFrame *frame, int number,
                    ShadowFrustum frusta[SHADOW_FACES])
{
    static const double RADIANS = 0.017453292519943295;
    const Light light = scene_world_light(frame->scene, number);
    const bool spot = light.kind == LIGHT_SPOT;
    const ShadowFitting fitting = {.light = light_place(&light),
                                   .axis = spot ? light.direction : (Vec3){0, 0, 0},
                                   .reach = spot ? tan(light.cutoff * RADIANS) : 0,
                                   .boxes = frame->plan->placed,
                                   .throws = frame->plan->throws,
                                   .receives = frame->plan->receives,
                                   .count = frame->plan->count,
                                   .number = number};
    return shadow_frusta(&fitting, lighting->shadows.map_size, frusta);
}

static bool draw_map(Lighting *lighting, const ShadowFrame *frame, int number, Message *message)
{
    ShadowFrustum frusta[SHADOW_FACES];
    const Scene *scene = frame->scene;
    ShadowMapCaster *casters = calloc((size_t)scene->object_count + 1, sizeof *casters);
    int count = 0;
    if (!casters)
        return message_set(message, "shadows: not enough memory");
    for (int o = 0; o < scene->object_count; o++)
        if (frame->plan->throws[o] >> number & 1)
            casters[count++] = (ShadowMapCaster){
                &find_buffer(lighting, scene->objects[o].mesh, INTERPOLATION_PHONG, NULL)->buffer,
                scene->objects[o].world_from_object};
    const int faces = fit_maps(lighting, frame, number, frusta);
    const bool done = shadow_map_draw(&lighting->maps, number, lighting->shadows.map_size, frusta,
                                      faces, casters, count, message);
    free(casters);
    return done;
}

static bool open_maps(Lighting *lighting, Message *message)
{
    return lighting->maps.framebuffer ||
           shadow_maps_open(&lighting->maps, &lighting->loader, message);
}

static bool draw_maps(Lighting *lighting, const ShadowFrame *frame, Message *message)
{
    if (!open_maps(lighting, message))
        return false;
    for (int l = 0; l < frame->scene->light_count; l++)
        if (frame->plan->all >> l & 1 && !draw_map(lighting, frame, l, message))
            return false;
    return true;
}

static bool look_up_map(Lighting *lighting, const ShadowFrame *frame, int number, Message *message)
{
    const ShadowLookup lookup = lookup_of(&lighting->shadows);
    bool done = true;
    for (int r = frame->plan->count - 1; r >= 0 && done; r--) {
        if (!(frame->plan->receives[r] >> number & 1))
            continue;
        const ShadowSurface surface = surface_of(lighting, frame, r);
        done = shadow_map_mark(&lighting->maps, &lighting->mask, number,
                               effects_channel(frame->scene, number), &surface,
                               frame->scene->objects[r].world_from_object, &lookup, message);
    }
    return done;
}

/* The lights whose maps programs look up themselves: those that have one, as many as a program has
 * room for, with two varyings for each, two for what is lit at its vertices, and six others. Full
 * programs have masks of all lights, with or without a map. */
static uint32_t find_map_lights(const Lighting *lighting, const ShadowFrame *frame)
{
    GLint varyings = 0, units = 0;
    glGetIntegerv(GL_MAX_VARYING_VECTORS, &varyings);
    glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    const int masks = (frame->scene->light_count + SHADOW_CHANNELS - 1) / SHADOW_CHANNELS;
    int room = (varyings - 6) / 4 < units - masks ? (varyings - 6) / 4 : units - masks;
    uint32_t lights = 0;
    for (int l = 0; l < frame->scene->light_count && !frame->full; l++)
        if (frame->plan->all >> l & 1 && lighting->maps.lights[l].count == 1 && room-- > 0)
            lights |= (uint32_t)1 << l;
    return lights;
}

static bool draw_light_mask(Lighting *lighting, const ShadowFrame *frame, int number,
                            Message *message)
{
    Light light = scene_world_light(frame->scene, number);
    vec3_normalize(light.direction, &light.direction);
    bool done = true;
    if (lighting->shadows.way == SHADOWS_MAP)
        return look_up_map(lighting, frame, number, message);
    if (lighting->shadows.way != SHADOWS_VOLUMES && not_flat(frame, number, &light) < 0)
        done = flatten_shadows(lighting, frame, &light, number, message);
    else
        for (int o = 0; o < frame->scene->object_count && done; o++)
            done = !(frame->plan->throws[o] >> number & 1) ||
                   cast_shadow(lighting, frame, &light, number, o, message);
    if (done)
        shadow_mask_light(&lighting->mask, effects_channel(frame->scene, number));
    return done;
}

/* The number of masks that the programs of this scene look up. */
static int mask_count(const Lighting *lighting, const ShadowFrame *frame)
{
    int count = 0;
    for (int l = 0; l < frame->scene->light_count; l++)
        if (frame->full ? frame->scene->lights[l].shadows
                        : frame->plan->all & ~lighting->map_lights & (uint32_t)1 << l)
            count = effects_channel(frame->scene, l) / SHADOW_CHANNELS + 1;
    return count;
}

static bool draw_masks(Lighting *lighting, const ShadowFrame *frame, int count, Message *message)
{
    ShadowMask *mask = &lighting->mask;
    if ((!mask->framebuffer && !shadow_mask_open(mask, &lighting->loader, message)) ||
        !shadow_mask_begin(mask, count, frame->scene->camera.near, message))
        return false;
    for (int o = 0; o < frame->scene->object_count; o++) {
        const ShadowSurface surface = surface_of(lighting, frame, o);
        shadow_mask_surface(mask, &surface);
    }
    bool done = true;
    for (int l = 0; l < frame->scene->light_count && done; l++)
        if ((frame->plan->all & ~lighting->map_lights) >> l & 1)
            done = draw_light_mask(lighting, frame, l, message);
    return shadow_mask_end(mask, message) && done;
}

/* Maps, and `count` masks. */
static bool draw_shadows(Lighting *lighting, const ShadowFrame *frame, int *count, Message *message)
{
    const bool maps = lighting->shadows.way == SHADOWS_MAP && frame->plan->all;
    lighting->map_lights = 0;
    if (maps && !draw_maps(lighting, frame, message))
        return false;
    if (maps)
        lighting->map_lights = find_map_lights(lighting, frame);
    *count = mask_count(lighting, frame);
    return *count == 0 || draw_masks(lighting, frame, *count, message);
}

/* To units from `first` on, of the lights in their order; `bind` false: no longer. */
static void bind_maps(const Lighting *lighting, int first, bool bind)
{
    GLenum unit = GL_TEXTURE0 + (GLenum)first;
    for (int l = 0; l < SHADOW_MAPS; l++) {
        if (!(lighting->map_lights >> l & 1))
            continue;
        glActiveTexture(unit++);
        glBindTexture(GL_TEXTURE_2D, bind ? lighting->maps.lights[l].textures[0] : 0);
    }
    glActiveTexture(GL_TEXTURE0);
}

/* `first` as bind_maps was given it. */
static void set_maps(GLuint program, const Lighting *lighting, int first, const Object *object)
{
    const ShadowLookup lookup = lookup_of(&lighting->shadows);
    char name[32], suffix[8];
    for (int l = 0, unit = first; l < SHADOW_MAPS; l++) {
        if (!(lighting->map_lights >> l & 1))
            continue;
        snprintf(suffix, sizeof suffix, "%d", l);
        snprintf(name, sizeof name, "u_Map%s", suffix);
        glUniform1i(glGetUniformLocation(program, name), unit++);
        shadow_map_uniforms(&lighting->maps, l, 0, &lookup, object->world_from_object, program,
                            suffix);
    }
}

static void explain_maps(const Lighting *lighting, const ShadowFrame *frame, int number, FILE *file)
{
    ShadowFrustum frusta[SHADOW_FACES];
    const int count = fit_maps(lighting, frame, number, frusta);
    const int size = lighting->shadows.map_size, bits = lighting->maps.bits;
    for (int i = 0; i < count; i++) {
        const double near = frusta[i].near, far = frusta[i].far;
        fprintf(
            file,
            "light %d: map %d of %d, %dx%d: a texel is %.2g wide at the back; depths of %d bits%s"
            " from %.4g to %.4g, in steps of %.1g in front and %.1g at the back\n",
            number, i, count, size, size,
            frusta[i].width / size * (frusta[i].perspective ? far : 1), bits,
            lighting->maps.packed ? " in colours" : "", near, far,
            shadow_depth_step(&frusta[i], bits, near), shadow_depth_step(&frusta[i], bits, far));
    }
}

static void explain_light(const Lighting *lighting, const ShadowFrame *frame, int number,
                          FILE *file)
{
    Light light = scene_world_light(frame->scene, number);
    const int curved = not_flat(frame, number, &light);
    if (!(frame->plan->all >> number & 1))
        fprintf(file, "light %d: none, because nothing can come between\n", number);
    else if (lighting->shadows.way == SHADOWS_MAP)
        explain_maps(lighting, frame, number, file);
    else if (lighting->shadows.way == SHADOWS_VOLUMES)
        fprintf(file, "light %d: volumes\n", number);
    else if (curved < 0)
        fprintf(file, "light %d: planar, because all that they may fall on is flat\n", number);
    else
        fprintf(file, "light %d: volumes, because object %d, on which they may fall, is not flat\n",
                number, curved);
}

bool lighting_explain_shadows(Lighting *lighting, const Scene *scene, FILE *file, Message *message)
{
    ShadowPlan plan;
    bool any = false;
    for (int l = 0; l < scene->light_count; l++)
        any |= scene->lights[l].shadows && !scene->lights[l].off;
    if (!any)
        return true;
    if ((lighting->shadows.way == SHADOWS_MAP && !open_maps(lighting, message)) ||
        !plan_open(&plan, lighting, scene, message))
        return false;
    const ShadowFrame frame = {.scene = scene, .plan = &plan};
    fprintf(file, "# shadows\n");
    for (int l = 0; l < scene->light_count; l++)
        if (scene->lights[l].shadows && !scene->lights[l].off)
            explain_light(lighting, &frame, l, file);
    plan_close(&plan);
    return true;
}

/* Where the masks are looked up: at places in the framebuffer, or in mediump in its viewport, from
 * -1 to 1. */
static void set_masks(GLuint program, const ShadowMask *mask, bool mediump, int count)
{
    const double size[2] = {mask->width, mask->height};
    float place[4] = {0};
    char name[32];
    for (int i = 0; i < 2; i++) {
        const double half = mask->place[2 + i] / 2.0;
        place[i] = (float)((mediump ? half : 1) / size[i]);
        place[2 + i] = (float)((mediump ? mask->place[i] + half : 0) / size[i]);
    }
    for (int i = 0; i < count; i++) {
        snprintf(name, sizeof name, "u_Mask%d", i);
        glUniform1i(glGetUniformLocation(program, name), i);
    }
    if (count)
        glUniform4fv(glGetUniformLocation(program, "u_MaskPlace"), 1, place);
}

/* Drawing. */

/* What is the same for all objects of a frame. */
typedef struct LightingFrame {
    Mat4 eye_from_world, clip_from_eye;
    bool full;
    int masks;
} LightingFrame;

static void draw_buffer(GLuint program, const MeshBuffer *buffer)
{
    const GLint position = glGetAttribLocation(program, "a_Position");
    const GLint normal = glGetAttribLocation(program, "a_Normal");
    const GLint others[] = {normal, glGetAttribLocation(program, "a_Color"),
                            glGetAttribLocation(program, "a_LitPosition")};
    mesh_buffer_bind(buffer, position, normal);
    mesh_buffer_bind_more(buffer, others[1], others[2]);
    glDrawElements(GL_TRIANGLES, buffer->index_count, buffer->index_type, NULL);
    for (int i = 0; i < 3; i++)
        if (others[i] >= 0)
            glDisableVertexAttribArray((GLuint)others[i]);
}

static bool draw_object(Lighting *lighting, const Scene *scene, const Object *object,
                        const LightingFrame *frame, uint32_t shadowed, Message *message)
{
    const Mat4 eye_from_world = frame->eye_from_world, clip_from_eye = frame->clip_from_eye;
    const bool full = frame->full;
    const Buffered *buffered =
        find_buffer(lighting, object->mesh, remade_for(scene, object), message);
    if (!buffered)
        return false;
    Effects effects = full ? effects_full(scene, object)
                           : effects_of_boxed(scene, object, &buffered->box, shadowed);
    if (lighting->normal_matrix && effects.normals)
        effects.normal_matrix = effects.normalize_vertex = true;
    const Variant *variant = find_variant(lighting, scene, &effects, message);
    if (!variant)
        return false;

    const GLuint program = variant->shader.program;
    const LightingTransforms *transforms = &lighting->transforms;
    const Mat4 eye_from_object =
        transforms->eye_from_object(&scene->camera, eye_from_world, object->world_from_object);
    Mat4 normal_matrix;
    if (lighting->normal_matrix)
        normal_matrix = lighting->normal_matrix(eye_from_object);
    else if (object->wrong_normals)
        normal_matrix = eye_from_object;
    else
        normal_matrix = mat4_normal(eye_from_object); /* zero if the matrix is singular: unlit */
    glUseProgram(program);
    set_mat4(program, "u_ClipFromObject",
             transforms->clip_from_object(clip_from_eye, eye_from_world, object->world_from_object,
                                          eye_from_object));
    set_mat4(program, "u_EyeFromObject", eye_from_object);
    set_mat4(program, "u_NormalMatrix", normal_matrix);
    set_float(program, "u_LocalViewer", scene->distant_viewer ? 0 : 1);
    set_float(program, "u_VertexLocalViewer", scene->distant_viewer ? 0 : 1);
    set_materials(program, scene, object, &effects, full, is_mediump(&lighting->loader));
    for (int g = 0; g < effects.group_count; g++)
        set_group(program, transforms, scene, eye_from_world, &effects.groups[g], g);
    set_masks(program, &lighting->mask, is_mediump(&lighting->loader), frame->masks);
    set_maps(program, lighting, frame->masks, object);

    /* A reflection reverses the winding. */
    glFrontFace((mat4_determinant(eye_from_object) < 0) != object->clockwise ? GL_CW : GL_CCW);
    if (object->behind_lines) {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1, 1);
    }
    if (effects.cull)
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
    draw_buffer(program, &buffered->buffer);
    glDisable(GL_POLYGON_OFFSET_FILL);
    return true;
}

/* Object `i` as parts[i] says, if there are parts. */
static bool draw_objects(Lighting *lighting, const Scene *scene, const Scene *parts,
                         const LightingFrame *frame, const ShadowPlan *plan, Message *message)
{
    bool done = true;
    for (int i = 0; i < scene->object_count && done; i++) {
        Message why = {.located = false};
        done = draw_object(lighting, parts ? &parts[i] : scene,
                           parts ? &parts[i].objects[0] : &scene->objects[i], frame,
                           plan->count ? plan->receives[i] : 0, &why);
        if (!done && why.located && message)
            *message = why; /* a shader's, which begins with file:line */
        else if (!done)
            message_set(message, "object %d: %s", i, why.text);
    }
    return done;
}

bool lighting_draw_parts(Lighting *lighting, const Scene *scene, const Scene *parts, double aspect,
                         bool full, Message *message)
{
    LightingFrame frame = {.full = full};
    ShadowPlan plan;
    if (!scene_camera(&scene->camera, aspect, &frame.eye_from_world, &frame.clip_from_eye, message))
        return false;
    if (scene->light_count > EFFECTS_MAX_LIGHTS)
        return message_set(message, "scene: %d lights: at most %d fit into one program",
                           scene->light_count, EFFECTS_MAX_LIGHTS);
    if (!plan_open(&plan, lighting, scene, message))
        return false;
    const ShadowFrame shadows = {scene, &plan,        frame.eye_from_world, frame.clip_from_eye,
                                 full,  parts != NULL};
    bool done = draw_shadows(lighting, &shadows, &frame.masks, message);
    glEnable(GL_DEPTH_TEST);
    shadow_mask_bind(&lighting->mask, frame.masks);
    bind_maps(lighting, frame.masks, true);
    done = done && draw_objects(lighting, scene, parts, &frame, &plan, message);
    shadow_mask_bind(NULL, frame.masks);
    bind_maps(lighting, frame.masks, false);
    plan_close(&plan);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    return done;
}

bool lighting_draw(Lighting *lighting, const Scene *scene, double aspect, bool full,
                   Message *message)
{
    return lighting_draw_parts(lighting, scene, NULL, aspect, full, message);
}

bool lighting_open(Lighting **opened, const ShaderLoader *loader, Message *message)
{
    Lighting *lighting = calloc(1, sizeof *lighting);
    *opened = lighting;
    if (!lighting)
        return message_set(message, "lighting: not enough memory");
    lighting->loader = *loader;
    lighting->transforms = USUAL;
    lighting->shadows = SHADOWS_DEFAULT;
    return true;
}

GLuint lighting_program(Lighting *lighting, const Scene *scene, const Object *object, bool full,
                        Message *message)
{
    const Effects effects = full ? effects_full(scene, object) : effects_of(scene, object);
    const Variant *variant = find_variant(lighting, scene, &effects, message);
    return variant ? variant->shader.program : 0;
}

bool lighting_sources(const Lighting *lighting, const Scene *scene, const Object *object, bool full,
                      ShaderSource sources[2], Message *message)
{
    const Effects effects = full ? effects_full(scene, object) : effects_of(scene, object);
    Recipe recipe;
    ShaderText texts[3];
    bool done = recipe_open(&recipe, &effects, scene, lighting, message);
    const ShaderLoader loader = recipe_loader(&recipe, &lighting->loader, texts);
    sources[SHADER_VERTEX] = sources[SHADER_FRAGMENT] = (ShaderSource){0};
    done = done &&
           shader_source_open(&sources[SHADER_VERTEX], &loader, "lighting.vert", SHADER_VERTEX,
                              message) &&
           shader_source_open(&sources[SHADER_FRAGMENT], &loader, "lighting.frag", SHADER_FRAGMENT,
                              message);
    if (!done)
        shader_source_close(&sources[SHADER_VERTEX]);
    recipe_close(&recipe);
    return done;
}

LightingCounts lighting_counts(const Lighting *lighting)
{
    LightingCounts counts = lighting->counts;
    counts.volumes = lighting->mask.volumes;
    counts.volumes_made = lighting->mask.made;
    counts.volume_triangles = lighting->mask.triangles;
    counts.maps = lighting->maps.drawn;
    counts.flattened = lighting->mask.flattened;
    return counts;
}

void lighting_close(Lighting *lighting)
{
    if (!lighting)
        return;
    while (lighting->variants) {
        Variant *variant = lighting->variants;
        lighting->variants = variant->next;
        shader_close(&variant->shader);
        recipe_close(&variant->recipe);
        free(variant);
    }
    lighting_forget(lighting, NULL);
    shadow_mask_close(&lighting->mask);
    shadow_maps_close(&lighting->maps);
    free(lighting);
}
