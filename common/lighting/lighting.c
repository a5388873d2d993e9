/*
 * A frame of a plan: shadows first, then each object with its program. Uniforms keep their values
 * in a program, so those of the lights are set once for all objects that follow each other with the
 * same effects; buffers and the program are bound when they change. What remains for each object is
 * what a loop written by hand would do: its matrices, the products of its colors and the lights',
 * and the call that draws.
 */
#include "lighting/lighting.h"

#include "base/memory.h"
#include "lighting/lighting_shadows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static Mat4 clip_from_object(Mat4 clip_from_eye, Mat4 eye_from_world, Mat4 world_from_object,
                             Mat4 eye_from_object)
{
    (void)eye_from_world, (void)world_from_object;
    return mat4_product(clip_from_eye, eye_from_object);
}

const LightingTransforms LIGHTING_TRANSFORMS = {scene_eye_from_object, scene_eye_point,
                                                clip_from_object};

void lighting_use_transforms(Lighting *lighting, const LightingTransforms *transforms)
{
    lighting->transforms = transforms ? *transforms : LIGHTING_TRANSFORMS;
    if (!lighting->transforms.clip_from_object)
        lighting->transforms.clip_from_object = clip_from_object;
}

static bool same_settings(const ShadowSettings *a, const ShadowSettings *b)
{
    return a->way == b->way && a->map_size == b->map_size && a->smooth == b->smooth &&
           memcmp(&a->bias, &b->bias, sizeof a->bias) == 0;
}

void lighting_use_shadows(Lighting *lighting, const ShadowSettings *settings)
{
    ShadowSettings used = *settings;
    if (used.way == SHADOWS_OFF)
        used.way = SHADOWS_DEFAULT.way;
    if (!same_settings(&lighting->shadows, &used))
        lighting->renewal++;
    lighting->shadows = used;
}

ShadowSettings lighting_shadows(const Lighting *lighting)
{
    return lighting->shadows;
}

void lighting_use_normal_matrix(Lighting *lighting, LightingNormalMatrix *normal_matrix)
{
    lighting->normal_matrix = normal_matrix;
    lighting->renewal++;
}

void lighting_use_depth_pass(Lighting *lighting, bool depth_pass)
{
    lighting->depth_pass = depth_pass;
}

void lighting_forget(Lighting *lighting, const Mesh *mesh)
{
    lighting->renewal++;
    shadow_volumes_forget(&lighting->volumes);
    shadow_maps_forget(&lighting->maps);
    lighting_meshes_forget(&lighting->meshes, mesh);
}

/* Lights in eye coordinates */

typedef struct EyeLight {
    float position[4]; /* w = 0: a direction */
    float direction[3], half[3], attenuation[3];
    float spot[4];         /* the cone's axis, and the cosine of its cutoff */
    float exponent, range; /* 1 / its square; 0: none */
    double share;          /* of its attenuation, what does not depend on the distance */
} EyeLight;

/* What is the same for all objects of a scene. */
typedef struct EyeScene {
    const Scene *scene;
    Vec3 ambient; /* the global, and what is constant of the lights', unless each adds its own */
    bool add_own;
    EyeLight *lights;
    const uint16_t *numbers; /* of the object's lights */
} EyeScene;

static EyeLight eye_light(const LightingTransforms *transforms, const Camera *camera,
                          Mat4 eye_from_world, const Light *light)
{
    static const double RADIANS = 0.017453292519943295;
    const bool directional = light->kind == LIGHT_DIRECTIONAL, spot = light->kind == LIGHT_SPOT;
    const bool none = light->constant == 0 && light->linear == 0 && light->quadratic == 0;
    Vec3 direction, half, position = light->position;
    vec3_normalize(light->direction, &direction);
    if (light->space == LIGHT_WORLD) {
        direction = mat4_transform_direction(eye_from_world, direction);
        position = transforms->eye_point(camera, eye_from_world, position);
    }
    vec3_normalize(vec3_add(direction, (Vec3){0, 0, 1}), &half);
    /* Attenuation that does not depend on distance is a factor, within the range of float. */
    const bool shared = !directional && !light_fades(light) && light->constant != 0;
    EyeLight made = {.share = shared ? 1 / fmax(light->constant, 1e-30) : 1,
                     .exponent = spot ? (float)light->exponent : 0};
    vec3_to_float(directional ? direction : position, made.position);
    made.position[3] = directional ? 0 : 1;
    vec3_to_float(direction, made.direction);
    vec3_to_float(half, made.half);
    vec3_to_float(directional || none ? (Vec3){1, 0, 0}
                                      : (Vec3){light->constant, light->linear, light->quadratic},
                  made.attenuation);
    made.range = directional || light->range <= 0 ? 0 : (float)(1 / (light->range * light->range));
    vec3_to_float(direction, made.spot);
    /* No cosine is below -1, so that other lights shine in every direction. */
    made.spot[3] = spot ? (float)cos(light->cutoff * RADIANS) : -2.0F;
    return made;
}

/* In the full program each light adds its own ambient light, if it has all lights. */
static void find_eye_scene(EyeScene *made, const LightingTransforms *transforms, const Scene *scene,
                           Mat4 eye_from_world, bool full)
{
    made->scene = scene;
    made->add_own = full && scene->light_count <= EFFECTS_MAX_LIGHTS;
    made->ambient = scene->global_ambient;
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        made->lights[i] = eye_light(transforms, &scene->camera, eye_from_world, light);
        if (!made->add_own && !light->off && !light_ambient_varies(light))
            made->ambient =
                vec3_add(made->ambient, vec3_scale(light->ambient, made->lights[i].share));
    }
}

/* Uniforms. GL ignores location -1, that of a uniform the program lacks. */

static void set_float(GLint location, double value)
{
    const float rounded = (float)value;
    if (location >= 0)
        glUniform1fv(location, 1, &rounded);
}

static void set_array(GLint location, int size, int count, const float *values)
{
    if (size == 1)
        glUniform1fv(location, count, values);
    else if (size == 3)
        glUniform3fv(location, count, values);
    else
        glUniform4fv(location, count, values);
}

/* A part of `size` floats of each light of a group; `first`: that of light 0. */
static void set_part(GLint location, int size, const LightGroup *group, const EyeScene *eye,
                     const float *first)
{
    float values[4 * EFFECTS_MAX_LIGHTS];
    if (location < 0)
        return;
    for (int i = 0; i < group->count; i++)
        memcpy(&values[size * i],
               (const char *)first + eye->numbers[group->lights[i]] * sizeof(EyeLight),
               (size_t)size * sizeof *values);
    set_array(location, size, group->count, values);
}

/* Each light's channel of its mask. */
static void set_channels(GLint location, const LightGroup *group, const LightingKey *key)
{
    float channels[4 * EFFECTS_MAX_LIGHTS] = {0};
    if (location < 0)
        return;
    for (int i = 0; i < group->count; i++)
        channels[4 * i + lighting_channel(key, group->lights[i]) % SHADOW_CHANNELS] = 1;
    set_array(location, 4, group->count, channels);
}

static void set_lights(const LightingVariant *variant, const EyeScene *eye)
{
    const LightingProgram *program = variant->program;
    const double viewer = eye->scene->distant_viewer ? 0 : 1;
    set_float(program->local_viewer[SHADER_VERTEX], viewer);
    set_float(program->local_viewer[SHADER_FRAGMENT], viewer);
    for (int g = 0; g < program->group_count; g++) {
        const LightGroup *group = &variant->key.effects.groups[g];
        const GroupLocations *at = &program->groups[g];
        set_part(at->position, group->terms.any ? 4 : 3, group, eye, eye->lights[0].position);
        set_part(at->direction, 3, group, eye, eye->lights[0].direction);
        set_part(at->half, 3, group, eye, eye->lights[0].half);
        set_part(at->attenuation, 3, group, eye, eye->lights[0].attenuation);
        set_part(at->spot, 4, group, eye, eye->lights[0].spot);
        set_part(at->range, 1, group, eye, &eye->lights[0].range);
        set_part(at->exponent, 1, group, eye, &eye->lights[0].exponent);
        set_channels(at->channel, group, &variant->key);
    }
}

/* The products of light and material colors. */
static void set_colors(const GLint locations[3], const EyeScene *eye, const LightGroup *group,
                       const Material *material, bool mediump)
{
    /* A 16-bit float overflows above 65504, and infinity times 0 is NaN. The three terms are added
     * before they are attenuated. */
    const double max = mediump && !group->terms.at_vertex ? 2e4 : INFINITY;
    const Vec3 reflected[3] = {material->ambient, material->diffuse, material->specular};
    for (int k = 0; k < 3; k++) {
        float values[3 * EFFECTS_MAX_LIGHTS];
        if (locations[k] < 0)
            continue;
        for (int i = 0; i < group->count; i++) {
            const int number = eye->numbers[group->lights[i]];
            const Light *light = &eye->scene->lights[number];
            const Vec3 color = k == 0 ? light->ambient : k == 1 ? light->diffuse : light->specular;
            const bool in_base = k == 0 && !eye->add_own && !light_ambient_varies(light);
            /* In the full program a light that is off is black, and attenuation has its own
             * uniform. */
            const double share = light->off || in_base ? 0
                                 : group->terms.any    ? 1
                                                       : eye->lights[number].share;
            const Vec3 all = vec3_scale(color_product(color, reflected[k]), share);
            vec3_to_float((Vec3){fmin(all.x, max), fmin(all.y, max), fmin(all.z, max)},
                          &values[3 * i]);
        }
        glUniform3fv(locations[k], group->count, values);
    }
}

/* Emission and constant ambient light; with vertex colors, which the latter is multiplied by, in
 * two uniforms. */
static void set_side(const LightingVariant *variant, int side, const EyeScene *eye,
                     const Object *object, bool mediump)
{
    const LightingProgram *program = variant->program;
    const SideLocations *at = &program->sides[side];
    const Material material = effects_material(object, side == 1);
    const Vec3 ambient = color_product(eye->ambient, material.ambient);
    const bool colored = variant->key.effects.vertex_color;
    if (at->base >= 0)
        shader_set_vec3(at->base,
                        colored ? material.emission : vec3_add(material.emission, ambient));
    if (at->tint >= 0)
        shader_set_vec3(at->tint, ambient);
    set_float(at->alpha, material.alpha);
    for (int stage = 0; stage < 2; stage++) {
        set_float(at->shininess[stage], material.shininess);
        set_float(at->normal[stage], object->two_sided ? -1 : 1);
    }
    for (int g = 0; g < program->group_count; g++)
        set_colors(program->groups[g].colors[side], eye, &variant->key.effects.groups[g], &material,
                   mediump);
}

/* Drawing */

/* A frame, and what of the last object is still set. */
typedef struct Pass {
    LightingPlan *plan;
    const LightingFrame *frame;
    Mat4 eye_from_world, clip_from_eye;
    bool mediump;
    EyeScene eye;
    const LightingVariant *lit; /* whose lights are set */
    const LightingProgram *program;
    const MeshBuffer *buffer;
} Pass;

static void unbind(Pass *pass)
{
    const LightingProgram *program = pass->program;
    const GLint others[3] = {program ? program->normal : -1, program ? program->color : -1,
                             program ? program->lit_position : -1};
    for (int i = 0; i < 3; i++)
        if (others[i] >= 0)
            glDisableVertexAttribArray((GLuint)others[i]);
}

/* Program and buffers, if they are others than the last object's. */
static void bind(Pass *pass, const PlannedObject *planned)
{
    const LightingProgram *program = planned->variant->program;
    if (pass->program == program && pass->buffer == planned->drawn)
        return;
    unbind(pass);
    if (pass->program != program)
        glUseProgram(program->program);
    mesh_buffer_bind(planned->drawn, program->position, program->normal);
    mesh_buffer_bind_more(planned->drawn, program->color, program->lit_position);
    pass->program = program;
    pass->buffer = planned->drawn;
}

static Mat4 normal_matrix_of(const Lighting *lighting, const Object *object, Mat4 eye_from_object)
{
    if (lighting->normal_matrix)
        return lighting->normal_matrix(eye_from_object);
    if (object->wrong_normals)
        return eye_from_object;
    return mat4_normal(eye_from_object); /* zero if the matrix is singular: unlit */
}

static void set_object(const Pass *pass, const PlannedObject *planned, const Object *object,
                       Mat4 eye_from_object)
{
    const Lighting *lighting = pass->plan->lighting;
    const LightingProgram *program = planned->variant->program;
    shader_set_mat4(program->clip_from_object, lighting->transforms.clip_from_object(
                                                   pass->clip_from_eye, pass->eye_from_world,
                                                   object->world_from_object, eye_from_object));
    if (program->eye_from_object >= 0)
        shader_set_mat4(program->eye_from_object, eye_from_object);
    if (program->normal_matrix >= 0)
        shader_set_mat4(program->normal_matrix,
                        normal_matrix_of(lighting, object, eye_from_object));
    for (int side = 0; side < (planned->variant->key.effects.two_sided ? 2 : 1); side++)
        set_side(planned->variant, side, &pass->eye, object, pass->mediump);
    place_shadows(pass->plan, program, object->world_from_object);
}

static void set_state(const Object *object, bool cull, bool mirrored)
{
    /* A reflection reverses the winding. */
    glFrontFace(mirrored != object->clockwise ? GL_CW : GL_CCW);
    if (cull)
        glEnable(GL_CULL_FACE);
    else
        glDisable(GL_CULL_FACE);
    if (object->behind_lines) {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1, 1);
    }
}

/* In parts each object has lights of its own. */
static void draw_object(Pass *pass, int number)
{
    const LightingFrame *frame = pass->frame;
    const LightingTransforms *transforms = &pass->plan->lighting->transforms;
    const PlannedObject *planned = &pass->plan->objects[number];
    const LightingVariant *variant = planned->variant;
    const Scene *scene = frame->parts ? &frame->parts[number] : frame->scene;
    const Object *object = frame->parts ? &scene->objects[0] : &scene->objects[number];
    const Mat4 eye_from_object = transforms->eye_from_object(&scene->camera, pass->eye_from_world,
                                                             object->world_from_object);
    const uint16_t *before = pass->eye.numbers;
    bind(pass, planned);
    if (frame->parts)
        find_eye_scene(&pass->eye, transforms, scene, pass->eye_from_world, frame->full);
    pass->eye.numbers = lighting_plan_facts(pass->plan, number)->numbers;
    if (frame->parts || pass->lit != variant ||
        (pass->eye.numbers != before &&
         memcmp(pass->eye.numbers, before, EFFECTS_MAX_LIGHTS * sizeof *before) != 0)) {
        set_lights(variant, &pass->eye);
        set_shadows(pass->plan, variant->program);
        pass->lit = variant;
    }
    set_object(pass, planned, object, eye_from_object);
    set_state(object, variant->key.effects.cull, mat4_determinant(eye_from_object) < 0);
    glDrawElements(GL_TRIANGLES, planned->drawn->index_count, planned->drawn->index_type, NULL);
    if (object->behind_lines)
        glDisable(GL_POLYGON_OFFSET_FILL);
}

static void draw_objects(Pass *pass)
{
    LightingPlan *plan = pass->plan;
    if (pass->frame->scene->light_count > plan->eye_room) {
        plan->eye_room = pass->frame->scene->light_count;
        plan->eye_lights =
            memory_grow(plan->eye_lights, (size_t)plan->eye_room, sizeof *plan->eye_lights);
    }
    pass->eye.lights = plan->eye_lights;
    pass->mediump = lighting_is_mediump(&plan->lighting->programs.loader);
    if (!pass->frame->parts)
        find_eye_scene(&pass->eye, &plan->lighting->transforms, pass->frame->scene,
                       pass->eye_from_world, pass->frame->full);
    glEnable(GL_DEPTH_TEST);
    bind_shadows(plan, true);
    for (int i = 0; i < plan->object_count; i++)
        draw_object(pass, i);
    unbind(pass);
    bind_shadows(plan, false);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
}

bool lighting_draw(LightingPlan *plan, const LightingFrame *frame, Message *message)
{
    Pass pass = {.plan = plan, .frame = frame};
    const Scene *scene = frame->scene;
    if (!scene_camera(&scene->camera, frame->aspect, &pass.eye_from_world, &pass.clip_from_eye,
                      message))
        return false;
    const ShadowFrame shadows = {scene, plan, pass.eye_from_world, pass.clip_from_eye};
    const bool done = draw_shadows(&shadows, message);
    if (done)
        draw_objects(&pass);
    return done;
}

bool lighting_show(Lighting *lighting, const LightingFrame *frame, Message *message)
{
    if (frame->view >= lighting->shown_count)
        lighting->shown =
            memory_grow(lighting->shown, (size_t)frame->view + 1, sizeof *lighting->shown);
    for (; lighting->shown_count <= frame->view; lighting->shown_count++)
        lighting->shown[lighting->shown_count] = (LightingPlan){.lighting = NULL};
    LightingPlan *plan = &lighting->shown[frame->view];
    return lighting_plan(plan, lighting, frame, message) && lighting_draw(plan, frame, message);
}

bool lighting_open(Lighting **opened, const ShaderLoader *loader, Message *message)
{
    Lighting *lighting = memory_new(1, sizeof *lighting);
    (void)message;
    lighting->programs.loader = *loader;
    lighting->transforms = LIGHTING_TRANSFORMS;
    lighting->shadows = SHADOWS_DEFAULT;
    *opened = lighting;
    return true;
}

LightingCounts lighting_counts(const Lighting *lighting)
{
    return (LightingCounts){.programs = lighting->programs.count,
                            .compile_seconds = lighting->programs.compile_seconds,
                            .texts = lighting->programs.printed,
                            .volumes = lighting->volumes.drawn,
                            .volumes_made = lighting->volumes.made,
                            .maps = lighting->maps.drawn};
}

void lighting_close(Lighting *lighting)
{
    if (!lighting)
        return;
    for (int i = 0; i < lighting->shown_count; i++)
        lighting_plan_close(&lighting->shown[i]);
    free(lighting->shown);
    lighting_close_programs(&lighting->programs);
    lighting_meshes_forget(&lighting->meshes, NULL);
    shadow_volumes_close(&lighting->volumes);
    shadow_mask_close(&lighting->mask);
    shadow_maps_close(&lighting->maps);
    free(lighting);
}
