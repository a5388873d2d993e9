#include "core/mesh_make.h"
#include "lighting/lighting_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

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

ShadowSettings lighting_shadows(const Lighting *lighting)
{
    return lighting->shadows;
}

void lighting_use_normal_matrix(Lighting *lighting, LightingNormalMatrix *normal_matrix)
{
    lighting->normal_matrix = normal_matrix;
}

void lighting_use_depth_pass(Lighting *lighting, bool depth_pass)
{
    lighting->depth_pass = depth_pass;
}

/* Meshes. */

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

const Buffered *lighting_buffer(Lighting *lighting, const Mesh *mesh, Interpolation remade,
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

void lighting_forget(Lighting *lighting, const Mesh *mesh)
{
    lighting_forget_shadows(lighting, mesh);
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

static Mat4 normal_matrix_of(const Lighting *lighting, const Object *object, Mat4 eye_from_object)
{
    if (lighting->normal_matrix)
        return lighting->normal_matrix(eye_from_object);
    if (object->wrong_normals)
        return eye_from_object;
    return mat4_normal(eye_from_object); /* zero if the matrix is singular: unlit */
}

static void set_uniforms(GLuint program, const Lighting *lighting, const Scene *scene,
                         const Object *object, const Effects *effects, const LightingFrame *frame,
                         Mat4 eye_from_object)
{
    const LightingTransforms *transforms = &lighting->transforms;
    set_mat4(program, "u_ClipFromObject",
             transforms->clip_from_object(frame->clip_from_eye, frame->eye_from_world,
                                          object->world_from_object, eye_from_object));
    set_mat4(program, "u_EyeFromObject", eye_from_object);
    set_mat4(program, "u_NormalMatrix", normal_matrix_of(lighting, object, eye_from_object));
    set_float(program, "u_LocalViewer", scene->distant_viewer ? 0 : 1);
    set_float(program, "u_VertexLocalViewer", scene->distant_viewer ? 0 : 1);
    set_materials(program, scene, object, effects, frame->full, lighting_is_mediump(lighting));
    for (int g = 0; g < effects->group_count; g++)
        set_group(program, transforms, scene, frame->eye_from_world, &effects->groups[g], g);
    lighting_set_shadows(program, lighting, frame->masks, object);
}

static bool draw_object(Lighting *lighting, const Scene *scene, const Object *object,
                        const LightingFrame *frame, uint32_t shadowed, Message *message)
{
    const Buffered *buffered =
        lighting_buffer(lighting, object->mesh, remade_for(scene, object), message);
    if (!buffered)
        return false;
    Effects effects = frame->full ? effects_full(scene, object)
                                  : effects_of_boxed(scene, object, &buffered->box, shadowed);
    if (lighting->normal_matrix && effects.normals)
        effects.normal_matrix = effects.normalize_vertex = true;
    const GLuint program = lighting_find_program(lighting, scene, &effects, message);
    if (!program)
        return false;

    const Mat4 eye_from_object = lighting->transforms.eye_from_object(
        &scene->camera, frame->eye_from_world, object->world_from_object);
    glUseProgram(program);
    set_uniforms(program, lighting, scene, object, &effects, frame, eye_from_object);
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
    if (!shadow_plan_open(&plan, lighting, scene, message))
        return false;
    const ShadowFrame shadows = {scene, &plan,        frame.eye_from_world, frame.clip_from_eye,
                                 full,  parts != NULL};
    bool done = lighting_draw_shadows(lighting, &shadows, &frame.masks, message);
    glEnable(GL_DEPTH_TEST);
    lighting_bind_shadows(lighting, frame.masks, true);
    done = done && draw_objects(lighting, scene, parts, &frame, &plan, message);
    lighting_bind_shadows(lighting, frame.masks, false);
    shadow_plan_close(&plan);
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
    lighting_close_programs(lighting);
    lighting_forget(lighting, NULL);
    shadow_mask_close(&lighting->mask);
    shadow_maps_close(&lighting->maps);
    free(lighting);
}
