/* The interface is a list of values by name; a program's active uniforms are looked up in it, never
 * the other way round, so that a program may leave any of them out. */
#include "labs/program/binding.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

typedef enum Kind {
    KIND_MATRIX,
    KIND_POINT,
    KIND_DIRECTION,
    KIND_COLOR,
    KIND_NUMBER,
    KIND_MAP,
    KIND_PAIR,
    KIND_FOUR
} Kind;

/* A uniform of the interface. */
typedef struct Value {
    const char *name;
    Kind kind;
    int count;                          /* of array elements; 1: no array */
    float m[16];                        /* matrix */
    float v[LAB_MAX_LIGHTS][4], number; /* anything else */
} Value;

enum { MAX_VALUES = BINDING_VALUES, MAX_NAME = 256 };

typedef struct Values {
    Value values[MAX_VALUES];
    int count;
} Values;

enum { POSITION, NORMAL, COLOR, ATTRIBUTES };

static void attributes_of(const Lab *lab, const char *names[ATTRIBUTES + 1])
{
    const LabAttributes *own = &lab->attributes;
    names[POSITION] = own->position ? own->position : "a_Position";
    names[NORMAL] = own->normal ? own->normal : "a_Normal";
    names[COLOR] = own->color ? own->color : "a_Color";
    names[ATTRIBUTES] = NULL;
}

static Value *add(Values *values, const char *name, Kind kind)
{
    Value *value = &values->values[values->count++];
    *value = (Value){.name = name, .kind = kind, .count = 1};
    return value;
}

static void add_matrix(Values *values, const char *name, Mat4 matrix)
{
    mat4_to_float(matrix, add(values, name, KIND_MATRIX)->m);
}

static void set_vector(Value *value, int i, Vec3 vector)
{
    vec3_to_float(vector, value->v[i]);
    value->v[i][3] = value->kind == KIND_DIRECTION ? 0 : 1;
}

static void add_vector(Values *values, const char *name, Kind kind, Vec3 vector)
{
    set_vector(add(values, name, kind), 0, vector);
}

static void add_number(Values *values, const char *name, double number)
{
    add(values, name, KIND_NUMBER)->number = (float)number;
}

static void add_lights(Values *values, const Lab *lab, const Scene *scene)
{
    const bool directional = lab->light == LIGHT_DIRECTIONAL;
    Value *place = add(values, directional ? "u_LightDirection" : "u_LightPosition",
                       directional ? KIND_DIRECTION : KIND_POINT);
    Value *color = add(values, "u_LightColor", KIND_COLOR);
    place->count = color->count = lab->lights;
    for (int i = 0; i < scene->light_count && i < lab->lights; i++) {
        const Light *light = &scene->lights[i];
        Vec3 direction = light->direction;
        vec3_normalize(light->direction, &direction);
        set_vector(place, i, directional ? direction : light->position);
        set_vector(color, i, light->diffuse);
    }
    if (lab->light != LIGHT_SPOT)
        return;
    const Light *spot = scene->light_count ? &scene->lights[0] : &(Light){.off = true};
    Vec3 axis = spot->direction;
    vec3_normalize(spot->direction, &axis);
    add_vector(values, "u_SpotDirection", KIND_DIRECTION, axis);
    add_number(values, "u_SpotCutoff", spot->cutoff);
    /* What other courses hand over instead. */
    add_number(values, "cosine of u_SpotCutoff", cos(spot->cutoff * acos(-1) / 180));
    add_number(values, "cosine of 0.8 u_SpotCutoff", cos(0.8 * spot->cutoff * acos(-1) / 180));
    add_number(values, "constant of u_Attenuation", spot->constant);
    add_number(values, "linear of u_Attenuation", spot->linear);
    add_number(values, "quadratic of u_Attenuation", spot->quadratic);
    add_number(values, "u_SpotExponent", spot->exponent);
    add_vector(values, "u_Attenuation", KIND_DIRECTION,
               (Vec3){spot->constant, spot->linear, spot->quadratic});
}

Mat4 binding_normal_matrix(Mat4 matrix)
{
    Mat4 inverse;
    for (int k = 0; k < 3; k++)
        matrix.m[12 + k] = matrix.m[4 * k + 3] = 0;
    matrix.m[15] = 1;
    mat4_inverse(matrix, &inverse);
    return mat4_transpose(inverse);
}

static const Value *find(const Values *values, const char *name)
{
    for (int i = values->count - 1; i >= 0; i--)
        if (strcmp(values->values[i].name, name) == 0)
            return &values->values[i];
    return NULL;
}

/* The value that a lab's uniform has, which may begin with "eye ", in eye space, and "minus ". */
static const Value *find_meant(const Values *values, const char *is, bool *eye, bool *minus)
{
    *eye = strncmp(is, "eye ", 4) == 0;
    is += *eye ? 4 : 0;
    *minus = strncmp(is, "minus ", 6) == 0;
    return find(values, is + (*minus ? 6 : 0));
}

static void change(Value *value, const Mat4 *eye_from_world, bool minus)
{
    for (int i = 0; i < LAB_MAX_LIGHTS; i++) {
        Vec3 v = vec3_from_float(value->v[i]);
        if (eye_from_world)
            v = value->kind == KIND_DIRECTION ? mat4_transform_direction(*eye_from_world, v)
                                              : mat4_transform_point(*eye_from_world, v);
        set_vector(value, i, minus ? vec3_scale(v, -1) : v);
    }
}

/* What a lab's folder adds: other names, and values of its own. */
static void add_own(Values *values, const Lab *lab, const double (*own)[4],
                    const Mat4 *eye_from_world)
{
    static const Kind kinds[] = {KIND_NUMBER, KIND_PAIR, KIND_COLOR, KIND_FOUR};
    for (int i = 0; i < lab->uniform_count; i++) {
        const LabUniform *uniform = &lab->uniforms[i];
        bool eye = false, minus = false;
        const Value *of = uniform->is ? find_meant(values, uniform->is, &eye, &minus) : NULL;
        Value *value = add(values, uniform->name, of ? of->kind : kinds[uniform->size - 1]);
        if (of) {
            *value = *of;
            value->name = uniform->name;
            if (eye || minus)
                change(value, eye ? eye_from_world : NULL, minus);
            if (uniform->light >= 0) {
                const int light = uniform->light < of->count ? uniform->light : 0;
                memmove(value->v[0], value->v[light], sizeof value->v[0]);
                value->count = 1;
            }
            continue;
        }
        value->v[0][3] = 1;
        for (int c = 0; c < uniform->size && own; c++)
            value->v[0][c] = (float)own[i][c];
        value->number = value->v[0][0];
    }
}

/* Without `drawn` only names and kinds. */
static bool gather(Values *values, const Lab *lab, const Drawn *drawn, Message *message)
{
    const Scene none = {.light_count = 0};
    const Scene *scene = drawn ? drawn->scene : &none;
    const Object *object = drawn ? &scene->objects[drawn->object] : &(Object){.mesh = NULL};
    Mat4 eye_from_world = mat4_identity(), clip_from_eye = mat4_identity();
    Mat4 world = mat4_identity(), normal = world, eye_normal = world;
    if (drawn) {
        world = drawn->world_from_object ? *drawn->world_from_object : object->world_from_object;
        if (!scene_camera(&scene->camera, drawn->aspect, &eye_from_world, &clip_from_eye, message))
            return false;
        normal = drawn->normal_matrix ? *drawn->normal_matrix : binding_normal_matrix(world);
        eye_normal = binding_normal_matrix(mat4_product(eye_from_world, world));
    }
    const Mat4 eye_from_model = mat4_product(eye_from_world, world);
    values->count = 0;
    add_matrix(values, "u_MvpMatrix", mat4_product(clip_from_eye, eye_from_model));
    add_matrix(values, "u_ModelMatrix", world);
    add_matrix(values, "u_NormalMatrix", normal);
    add_matrix(values, "u_ViewMatrix", eye_from_world);
    add_matrix(values, "u_ProjMatrix", clip_from_eye);
    add_matrix(values, "u_ViewProjMatrix", mat4_product(clip_from_eye, eye_from_world));
    add_matrix(values, "u_ModelViewMatrix", eye_from_model);
    add_matrix(values, "u_EyeNormalMatrix", eye_normal);
    add_vector(values, "u_EyePosition", KIND_POINT, scene->camera.eye);
    add_vector(values, "u_AmbientLight", KIND_COLOR, scene->global_ambient);
    add_vector(values, "color of the object", KIND_COLOR, object->front.diffuse);
    add_lights(values, lab, scene);
    if (lab->specular) {
        add_vector(values, "u_SpecularColor", KIND_COLOR, object->front.specular);
        add_number(values, "u_Shininess", object->front.shininess);
    }
    if (lab->shadow) {
        add_matrix(values, "u_LightMatrix",
                   drawn && drawn->map ? drawn->map->clip_from_world : mat4_identity());
        add(values, "u_ShadowMap", KIND_MAP);
        add_number(values, "u_ShadowMapSize", LAB_SHADOW_MAP_SIZE);
    }
    if (lab->two_sided) {
        add_vector(values, "u_BackColor", KIND_COLOR, object->back.diffuse);
        add_number(values, "u_Mirrored", mat4_determinant(world) < 0 ? -1 : 1);
    }
    add_own(values, lab, drawn ? drawn->own : NULL, &eye_from_world);
    return true;
}

int binding_values(const Lab *lab, const Drawn *drawn, BindingValue values[BINDING_VALUES],
                   Message *message)
{
    Values all;
    if (!gather(&all, lab, drawn, message))
        return 0;
    for (int i = 0; i < all.count; i++) {
        const Value *from = &all.values[i];
        BindingValue *to = &values[i];
        *to = (BindingValue){from->name, from->count, from->kind == KIND_PAIR ? 2 : 4, {0}};
        if (from->kind == KIND_MATRIX)
            to->size = 16, memcpy(to->numbers, from->m, sizeof from->m);
        else if (from->kind == KIND_NUMBER)
            to->size = 1, to->numbers[0] = from->number;
        else if (from->kind == KIND_MAP)
            to->size = 0;
        else
            memcpy(to->numbers, from->v, sizeof from->v);
    }
    return all.count;
}

bool binding_has(const Lab *lab, const char *name)
{
    Values values;
    bool eye, minus;
    return gather(&values, lab, NULL, NULL) && find_meant(&values, name, &eye, &minus);
}

static bool suits(const Value *value, GLenum type)
{
    if (value->kind == KIND_MATRIX)
        return type == GL_FLOAT_MAT4 || type == GL_FLOAT_MAT3;
    if (value->kind == KIND_NUMBER)
        return type == GL_FLOAT || type == GL_INT;
    if (value->kind == KIND_MAP)
        return type == GL_SAMPLER_2D;
    if (value->kind == KIND_PAIR || value->kind == KIND_FOUR)
        return type == (value->kind == KIND_PAIR ? GL_FLOAT_VEC2 : GL_FLOAT_VEC4);
    return type == GL_FLOAT_VEC3 || type == GL_FLOAT_VEC4;
}

static const char *type_of(const Value *value)
{
    static const char *const NAMES[] = {"mat4",  "vec3",      "vec3", "vec3",
                                        "float", "sampler2D", "vec2", "vec4"};
    return NAMES[value->kind];
}

/* A uniform of a program; `value` is NULL if the interface has none of its name. */
typedef struct Uniform {
    char name[MAX_NAME];
    GLint size;
    GLenum type;
    const Value *value;
} Uniform;

static Uniform uniform_at(GLuint program, GLint i, const Values *values)
{
    Uniform uniform = {.size = 0};
    glGetActiveUniform(program, (GLuint)i, sizeof uniform.name, NULL, &uniform.size, &uniform.type,
                       uniform.name);
    char *element = strrchr(uniform.name, '['); /* an array's ends in [0] */
    if (element && strcmp(element, "[0]") == 0)
        *element = '\0';
    uniform.value = find(values, uniform.name);
    return uniform;
}

static bool unknown(const Shader *shader, const char *kind, const char *name,
                    const char *const *names, Message *message)
{
    const char *nearest = text_nearest(name, names);
    Message text = {0};
    message_set(&text, "%s %s does not exist in this lab; %s%s%s", kind, name,
                nearest ? "did you mean " : "TASK.md lists the names", nearest ? nearest : "",
                nearest ? "?" : "");
    return shader_complain(shader, name, text.text, message);
}

static bool mistyped(const Shader *shader, const char *kind, const char *name, const char *type,
                     Message *message)
{
    Message text = {0};
    message_set(&text, "%s %s: declare it as %s", kind, name, type);
    return shader_complain(shader, name, text.text, message);
}

static bool check_attributes(const Lab *lab, const Shader *shader, Message *message)
{
    const GLuint program = shader->program;
    const char *names[ATTRIBUTES + 1];
    GLint count = 0;
    attributes_of(lab, names);
    glGetProgramiv(program, GL_ACTIVE_ATTRIBUTES, &count);
    for (GLint i = 0; i < count; i++) {
        char name[MAX_NAME] = "";
        GLint size;
        GLenum type;
        bool known = false;
        glGetActiveAttrib(program, (GLuint)i, sizeof name, NULL, &size, &type, name);
        for (int k = 0; names[k]; k++)
            known |= strcmp(name, names[k]) == 0;
        if (!known && strncmp(name, "gl_", 3) != 0)
            return unknown(shader, "attribute", name, names, message);
        if (known && type != GL_FLOAT_VEC3 && type != GL_FLOAT_VEC4)
            return mistyped(shader, "attribute", name, "vec4 or vec3", message);
    }
    return true;
}

bool binding_check(const Lab *lab, const Shader *shader, Message *message)
{
    const GLuint program = shader->program;
    Values values;
    const char *names[MAX_VALUES + 1] = {NULL};
    GLint count = 0;
    if (!gather(&values, lab, NULL, message))
        return false;
    for (int i = 0; i < values.count; i++)
        names[i] = values.values[i].name;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; i++) {
        const Uniform uniform = uniform_at(program, i, &values);
        if (strncmp(uniform.name, "gl_", 3) == 0)
            continue;
        if (!uniform.value)
            return unknown(shader, "uniform", uniform.name, names, message);
        if (!suits(uniform.value, uniform.type))
            return mistyped(shader, "uniform", uniform.name, type_of(uniform.value), message);
    }
    return check_attributes(lab, shader, message);
}

static void set_matrix(GLint location, GLenum type, const float m[16])
{
    if (type == GL_FLOAT_MAT4) {
        glUniformMatrix4fv(location, 1, GL_FALSE, m);
        return;
    }
    const float upper[9] = {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
    glUniformMatrix3fv(location, 1, GL_FALSE, upper);
}

static void set_value(GLint location, const Uniform *uniform)
{
    const Value *value = uniform->value;
    const GLenum type = uniform->type;
    const GLsizei count = uniform->size < value->count ? uniform->size : value->count;
    float packed[3 * LAB_MAX_LIGHTS];
    if (!suits(value, type))
        return;
    if (value->kind == KIND_MATRIX) {
        set_matrix(location, type, value->m);
    } else if (value->kind == KIND_MAP) {
        glUniform1i(location, 0); /* the unit it is bound to */
    } else if (type == GL_INT) {
        glUniform1i(location, (GLint)value->number);
    } else if (type == GL_FLOAT_VEC2) {
        glUniform2fv(location, 1, value->v[0]);
    } else if (type == GL_FLOAT) {
        glUniform1fv(location, 1, &value->number);
    } else if (type == GL_FLOAT_VEC4) {
        glUniform4fv(location, count, value->v[0]);
    } else {
        for (int i = 0; i < 3 * LAB_MAX_LIGHTS; i++)
            packed[i] = value->v[i / 3][i % 3];
        glUniform3fv(location, count, packed);
    }
}

static void set_uniforms(GLuint program, const Values *values)
{
    GLint count = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; i++) {
        const Uniform uniform = uniform_at(program, i, values);
        const GLint location = glGetUniformLocation(program, uniform.name);
        if (uniform.value && location >= 0)
            set_value(location, &uniform);
    }
}

bool binding_draw(const Lab *lab, GLuint program, const MeshBuffer *mesh, const Drawn *drawn,
                  Message *message)
{
    Values values;
    const char *names[ATTRIBUTES + 1];
    if (!gather(&values, lab, drawn, message))
        return false;
    attributes_of(lab, names);
    glUseProgram(program);
    set_uniforms(program, &values);
    mesh_buffer_bind(mesh, glGetAttribLocation(program, names[POSITION]),
                     glGetAttribLocation(program, names[NORMAL]));
    const GLint color = glGetAttribLocation(program, names[COLOR]);
    if (color >= 0) {
        float rgba[4] = {0, 0, 0, 1};
        vec3_to_float(drawn->scene->objects[drawn->object].front.diffuse, rgba);
        glDisableVertexAttribArray((GLuint)color);
        glVertexAttrib4fv((GLuint)color, rgba);
    }
    if (drawn->map)
        glBindTexture(GL_TEXTURE_2D, drawn->map->texture);
    glDrawElements(GL_TRIANGLES, mesh->index_count, mesh->index_type, NULL);
    return true;
}
