#include "lighting.h"

#include "mesh_buffer.h"
#include "progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEFINES = 32 };

/* What a program is made from. Equal recipes, equal programs. */
typedef struct Recipe {
    const char *defines[MOST_DEFINES];
    char *groups[2]; /* of lights, by ShaderStage */
} Recipe;

typedef struct Variant {
    Recipe recipe;
    Shader shader;
    struct Variant *next;
} Variant;

typedef struct Buffered {
    const Mesh *mesh;
    bool flattened;
    MeshFacts facts; /* of the mesh as it is */
    MeshBuffer buffer;
    struct Buffered *next;
} Buffered;

struct Lighting {
    ShaderLoader loader;
    Variant *variants;
    Buffered *buffers;
    LightingCounts counts;
    LightingTransforms transforms;
    LightingNormalMatrix *normal_matrix; /* NULL: the usual one */
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

void lighting_use_normal_matrix(Lighting *lighting, LightingNormalMatrix *normal_matrix)
{
    lighting->normal_matrix = normal_matrix;
}

/* Recipes. */

/* The uniforms of group.glsl, renamed for each group. */
static const char *const GROUP_UNIFORMS[] = {
    "u_Position",     "u_Direction",   "u_FrontAmbient",  "u_BackAmbient",
    "u_FrontDiffuse", "u_BackDiffuse", "u_FrontSpecular", "u_BackSpecular",
    "u_Half",         "u_Attenuation", "u_Spot",          "u_Exponent",
};
enum { GROUP_UNIFORM_COUNT = sizeof GROUP_UNIFORMS / sizeof GROUP_UNIFORMS[0] };

/* The terms and guards of a group as the defines of group.glsl. */
enum { MOST_GROUP_DEFINES = 12 };
static int group_defines(const LightGroup *group, const char *defines[MOST_GROUP_DEFINES])
{
    const LightTerms *terms = &group->terms;
    const LightGuards *guards = &group->guards;
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
        {guards->distance, "GUARD_DISTANCE"},
        {guards->attenuation, "GUARD_ATTENUATION"},
        {guards->half_vector, "GUARD_HALF_VECTOR"},
    };
    int count = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i].there)
            defines[count++] = all[i].name;
    return count;
}

/* The text that "lighting/vertex_groups.glsl" or its twin for fragments stands for: one function
 * for each group, and add_lights, which calls them. */
static char *groups_text(const Effects *effects, bool at_vertex)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
    for (int g = 0; g < effects->group_count; g++) {
        const LightGroup *group = &effects->groups[g];
        const char *defines[MOST_GROUP_DEFINES];
        const int count = group_defines(group, defines);
        if (group->terms.at_vertex != at_vertex)
            continue;
        fprintf(file, "#define GROUP group%d\n#define COUNT %d\n", g, group->count);
        for (int i = 0; i < count; i++)
            fprintf(file, "#define %s\n", defines[i]);
        for (int i = 0; i < GROUP_UNIFORM_COUNT; i++)
            fprintf(file, "#define %s %s%d\n", GROUP_UNIFORMS[i], GROUP_UNIFORMS[i], g);
        fprintf(file, "#include \"lighting/group.glsl\"\n#undef GROUP\n#undef COUNT\n");
        for (int i = 0; i < count; i++)
            fprintf(file, "#undef %s\n", defines[i]);
        for (int i = 0; i < GROUP_UNIFORM_COUNT; i++)
            fprintf(file, "#undef %s\n", GROUP_UNIFORMS[i]);
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

/* Whether fragments may be computed in 16 bits. */
static bool is_mediump(const ShaderLoader *loader)
{
    return loader->precision && strcmp(loader->precision, "mediump") == 0;
}

/* In 16 bits, where effects' proofs of what cannot be do not hold, every guard is compiled in. */
static bool recipe_open(Recipe *recipe, const Effects *wanted, const ShaderLoader *loader,
                        Message *message)
{
    const bool mediump = is_mediump(loader);
    Effects guarded = *wanted;
    if (mediump)
        effects_guard(&guarded);
    const Effects *effects = &guarded;
    bool lights[2] = {false}, position[2] = {false}, normals[2] = {false}; /* by ShaderStage */
    bool specular = false, full = false;
    bool guards = effects->guard_vertex || effects->guard_fragment || effects->guard_viewer;
    for (int g = 0; g < effects->group_count; g++) {
        const LightTerms *terms = &effects->groups[g].terms;
        const LightGuards *of_group = &effects->groups[g].guards;
        const int stage = terms->at_vertex ? SHADER_VERTEX : SHADER_FRAGMENT;
        lights[stage] = true;
        position[stage] |=
            terms->kind != LIGHT_DIRECTIONAL || (terms->specular && effects->local_viewer);
        normals[stage] |= terms->diffuse || terms->specular;
        specular |= terms->specular;
        full |= terms->any;
        guards |= of_group->distance || of_group->attenuation || of_group->half_vector;
    }
    const struct {
        bool there;
        const char *define;
    } all[] = {
        {full, "FULL"},
        {mediump, "MEDIUMP"},
        {effects->base, "BASE"},
        {effects->alpha, "ALPHA"},
        {effects->two_sided, "TWO_SIDED"},
        {lights[SHADER_VERTEX], "VERTEX_LIGHTS"},
        {lights[SHADER_FRAGMENT], "FRAGMENT_LIGHTS"},
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
        {guards, "GUARDS"},
        {effects->guard_vertex, "GUARD_VERTEX"},
        {effects->guard_fragment, "GUARD_FRAGMENT"},
        {effects->guard_viewer, "GUARD_VIEWER"},
    };
    int count = 0;
    *recipe = (Recipe){{NULL}, {NULL}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i].there)
            recipe->defines[count++] = all[i].define;
    recipe->groups[SHADER_VERTEX] = groups_text(effects, true);
    recipe->groups[SHADER_FRAGMENT] = groups_text(effects, false);
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

/* Compared whole. The defines are constants of this file: equal ones are the same one. */
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

static const Variant *find_variant(Lighting *lighting, const Effects *effects, Message *message)
{
    Recipe recipe;
    ShaderText texts[3];
    if (!recipe_open(&recipe, effects, &lighting->loader, message)) {
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
    const double start = progress_now();
    if (!variant || !shader_open(&variant->shader, &loader, "lighting", message)) {
        message_set(message, "lighting: not enough memory");
        recipe_close(&recipe);
        free(variant);
        return NULL;
    }
    lighting->counts.programs++;
    lighting->counts.compile_seconds += progress_now() - start;
    variant->recipe = recipe;
    variant->next = lighting->variants;
    lighting->variants = variant;
    return variant;
}

/* A copy with a normal for each triangle. */
static bool flat_copy(const Mesh *mesh, Mesh *flat, Message *message)
{
    if (!mesh_open(flat, mesh->vertex_count, mesh->index_count, message))
        return false;
    memcpy(flat->vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    memcpy(flat->indices, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    return mesh_flatten(flat, message);
}

static const Buffered *find_buffer(Lighting *lighting, const Mesh *mesh, bool flatten,
                                   Message *message)
{
    for (const Buffered *buffered = lighting->buffers; buffered; buffered = buffered->next)
        if (buffered->mesh == mesh && buffered->flattened == flatten)
            return buffered;
    Buffered *buffered = calloc(1, sizeof *buffered);
    Mesh flat = {0};
    if (!buffered) {
        message_set(message, "lighting: not enough memory");
        return NULL;
    }
    const bool done = (!flatten || flat_copy(mesh, &flat, message)) &&
                      mesh_buffer_open(&buffered->buffer, flatten ? &flat : mesh, message);
    mesh_close(&flat);
    if (!done) {
        free(buffered);
        return NULL;
    }
    buffered->mesh = mesh;
    buffered->flattened = flatten;
    buffered->facts = mesh_facts(mesh);
    buffered->next = lighting->buffers;
    lighting->buffers = buffered;
    return buffered;
}

void lighting_forget(Lighting *lighting, const Mesh *mesh)
{
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

/* Uniforms. One that a program does not have has location -1, which GL ignores. */

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

/* Where light is attenuated by the same factor everywhere, that is 1 / constant. */
static double constant_share(const Light *light)
{
    const bool shared = light->kind != LIGHT_DIRECTIONAL && !light_fades(light);
    /* No more than a float holds. */
    return shared && light->constant != 0 ? 1 / fmax(light->constant, 1e-30) : 1;
}

/* Emission and ambient light that does not vary over the surface. In the full program every light
 * adds its own ambient. */
static Vec3 base_color(const Scene *scene, const Material *material, bool full)
{
    Vec3 sum = vec3_add(material->emission, multiply(scene->global_ambient, material->ambient));
    for (int i = 0; i < scene->light_count && !full; i++) {
        const Light *light = &scene->lights[i];
        if (!light->off && !light_ambient_varies(light))
            sum = vec3_add(sum, vec3_scale(multiply(light->ambient, material->ambient),
                                           constant_share(light)));
    }
    return sum;
}

static Vec3 at_most(Vec3 a, double most)
{
    return (Vec3){fmin(a.x, most), fmin(a.y, most), fmin(a.z, most)};
}

/* The products of a group's lights with a material, in the six colour uniforms. */
static void set_colors(GLuint program, const Scene *scene, const LightGroup *group, int g,
                       const Material *material, bool mediump, const char *const names[3])
{
    /* In 16 bits more than 65504 is infinite, and infinity times a share of 0 no number. The three
     * terms are added before they are multiplied. */
    const double most = mediump && !group->terms.at_vertex ? 2e4 : INFINITY;
    float values[3][3 * EFFECTS_MOST_LIGHTS];
    for (int i = 0; i < group->count; i++) {
        const Light *light = &scene->lights[group->lights[i]];
        /* In the full program a light that is off is black, and attenuation has its own uniform. */
        const double share = light->off ? 0 : group->terms.any ? 1 : constant_share(light);
        const Vec3 products[3] = {multiply(light->ambient, material->ambient),
                                  multiply(light->diffuse, material->diffuse),
                                  multiply(light->specular, material->specular)};
        for (int k = 0; k < 3; k++)
            vec3_to_float(at_most(vec3_scale(products[k], share), most), &values[k][3 * i]);
    }
    for (int k = 0; k < 3; k++)
        set_array(program, names[k], g, 3, group->count, values[k]);
}

static void set_group(GLuint program, const LightingTransforms *transforms, const Scene *scene,
                      Mat4 eye_from_world, const LightGroup *group, int g)
{
    float position[4 * EFFECTS_MOST_LIGHTS], direction[3 * EFFECTS_MOST_LIGHTS];
    float half[3 * EFFECTS_MOST_LIGHTS], attenuation[3 * EFFECTS_MOST_LIGHTS];
    float spot[4 * EFFECTS_MOST_LIGHTS], exponent[EFFECTS_MOST_LIGHTS];
    static const double RADIANS = 0.017453292519943295;
    const int size = group->terms.any ? 4 : 3; /* of a position */
    for (int i = 0; i < group->count; i++) {
        const Light *light = &scene->lights[group->lights[i]];
        const bool directional = light->kind == LIGHT_DIRECTIONAL;
        Vec3 unit, half_eye;
        vec3_normalize(light->direction, &unit);
        const Vec3 direction_eye = mat4_transform_direction(eye_from_world, unit);
        const Vec3 place =
            directional ? direction_eye
                        : transforms->eye_point(&scene->camera, eye_from_world, light->position);
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
        /* No cosine is below -1: what is no spot shines everywhere. */
        spot[4 * i + 3] = light->kind == LIGHT_SPOT ? (float)cos(light->cutoff * RADIANS) : -2.0F;
        exponent[i] = light->kind == LIGHT_SPOT ? (float)light->exponent : 0;
    }
    set_array(program, "u_Position", g, size, group->count, position);
    set_array(program, "u_Direction", g, 3, group->count, direction);
    set_array(program, "u_Half", g, 3, group->count, half);
    set_array(program, "u_Attenuation", g, 3, group->count, attenuation);
    set_array(program, "u_Spot", g, 4, group->count, spot);
    set_array(program, "u_Exponent", g, 1, group->count, exponent);
}

static void set_materials(GLuint program, const Scene *scene, const Object *object,
                          const Effects *effects, bool full, bool mediump)
{
    static const char *const front[3] = {"u_FrontAmbient", "u_FrontDiffuse", "u_FrontSpecular"};
    static const char *const back[3] = {"u_BackAmbient", "u_BackDiffuse", "u_BackSpecular"};
    /* In the full program one-sided objects have two equal sides. */
    const Material *behind = object->two_sided ? &object->back : &object->front;
    set_vec3(program, "u_FrontBase", base_color(scene, &object->front, full));
    set_float(program, "u_FrontAlpha", object->front.alpha);
    set_float(program, "u_FrontShininess", object->front.shininess);
    set_float(program, "u_VertexFrontShininess", object->front.shininess);
    for (int g = 0; g < effects->group_count; g++)
        set_colors(program, scene, &effects->groups[g], g, &object->front, mediump, front);
    if (!effects->two_sided)
        return;
    set_vec3(program, "u_BackBase", base_color(scene, behind, full));
    set_float(program, "u_BackAlpha", behind->alpha);
    set_float(program, "u_BackShininess", behind->shininess);
    set_float(program, "u_VertexBackShininess", behind->shininess);
    set_float(program, "u_BackNormal", object->two_sided ? -1 : 1);
    set_float(program, "u_VertexBackNormal", object->two_sided ? -1 : 1);
    for (int g = 0; g < effects->group_count; g++)
        set_colors(program, scene, &effects->groups[g], g, behind, mediump, back);
}

/* Drawing. */

static bool draw_object(Lighting *lighting, const Scene *scene, const Object *object,
                        Mat4 eye_from_world, Mat4 clip_from_eye, bool full, bool samples,
                        Message *message)
{
    const bool flatten = scene->interpolation == INTERPOLATION_FLAT && !object->flat;
    const Buffered *buffered = find_buffer(lighting, object->mesh, flatten, message);
    if (!buffered)
        return false;
    Effects effects =
        full ? effects_full(scene, object) : effects_of_facts(scene, object, &buffered->facts);
    if (samples)
        effects_guard(&effects);
    if (lighting->normal_matrix && effects.normals)
        effects.normal_matrix = effects.normalize_vertex = true;
    const Variant *variant = find_variant(lighting, &effects, message);
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
        mat4_normal(eye_from_object, &normal_matrix); /* zero where there is none: unlit */
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

    /* A mirror turns what was counter-clockwise. */
    glFrontFace(mat4_determinant(eye_from_object) < 0 ? GL_CW : GL_CCW);
    if (effects.cull)
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
    const GLint position = glGetAttribLocation(program, "a_Position");
    const GLint normal = glGetAttribLocation(program, "a_Normal");
    mesh_buffer_bind(&buffered->buffer, position, normal);
    glDrawElements(GL_TRIANGLES, buffered->buffer.index_count, buffered->buffer.index_type, NULL);
    if (normal >= 0)
        glDisableVertexAttribArray((GLuint)normal);
    return true;
}

bool lighting_draw(Lighting *lighting, const Scene *scene, double aspect, bool full,
                   Message *message)
{
    Mat4 eye_from_world, clip_from_eye;
    if (!scene_camera(&scene->camera, aspect, &eye_from_world, &clip_from_eye, message))
        return false;
    if (scene->light_count > EFFECTS_MOST_LIGHTS)
        return message_set(message, "scene: %d lights: at most %d fit into one program",
                           scene->light_count, EFFECTS_MOST_LIGHTS);
    GLint samples = 0;
    glGetIntegerv(GL_SAMPLES, &samples);
    glEnable(GL_DEPTH_TEST);
    bool done = true;
    for (int i = 0; i < scene->object_count && done; i++) {
        Message why = {.located = false};
        done = draw_object(lighting, scene, &scene->objects[i], eye_from_world, clip_from_eye, full,
                           samples > 1, &why);
        if (!done && why.located && message)
            *message = why; /* a shader's, which begins with its place */
        else if (!done)
            message_set(message, "object %d: %s", i, why.text);
    }
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    return done;
}

bool lighting_open(Lighting **opened, const ShaderLoader *loader, Message *message)
{
    Lighting *lighting = calloc(1, sizeof *lighting);
    *opened = lighting;
    if (!lighting)
        return message_set(message, "lighting: not enough memory");
    lighting->loader = *loader;
    lighting->transforms = USUAL;
    return true;
}

GLuint lighting_program(Lighting *lighting, const Scene *scene, const Object *object, bool full,
                        Message *message)
{
    const Effects effects = full ? effects_full(scene, object) : effects_of(scene, object);
    const Variant *variant = find_variant(lighting, &effects, message);
    return variant ? variant->shader.program : 0;
}

bool lighting_sources(const Lighting *lighting, const Scene *scene, const Object *object, bool full,
                      ShaderSource sources[2], Message *message)
{
    const Effects effects = full ? effects_full(scene, object) : effects_of(scene, object);
    Recipe recipe;
    ShaderText texts[3];
    bool done = recipe_open(&recipe, &effects, &lighting->loader, message);
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
    return lighting->counts;
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
    while (lighting->buffers) {
        Buffered *buffered = lighting->buffers;
        lighting->buffers = buffered->next;
        mesh_buffer_close(&buffered->buffer);
        free(buffered);
    }
    free(lighting);
}
