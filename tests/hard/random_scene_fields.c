/*
 * A random scene as a list of numbers, for the search, and as C, for what it finds. Both follow one
 * table for each struct, of the fields' names, places and ranges.
 */
#include "hard/random_scene.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

typedef struct Field {
    const char *name;
    enum { FIELD_NUMBER, FIELD_VECTOR, FIELD_FLAG } type;
    size_t at;
    double min, max; /* 0: it is no number to be changed */
    unsigned kinds;  /* of lights that have it, a bit each; 0: all */
} Field;

enum { NEAR_KINDS = 1 << LIGHT_POINT | 1 << LIGHT_SPOT };
#define COUNT(fields) (sizeof(fields) / sizeof(fields)[0])
#define COLORS(type, max)                                                                          \
    {".ambient", FIELD_VECTOR, offsetof(type, ambient), 0, max, 0},                                \
        {".diffuse", FIELD_VECTOR, offsetof(type, diffuse), 0, max, 0},                            \
    {                                                                                              \
        ".specular", FIELD_VECTOR, offsetof(type, specular), 0, max, 0                             \
    }

static const Field CAMERA[] = {
    {".eye", FIELD_VECTOR, offsetof(Camera, eye), -1e15, 1e15, 0},
    {".center", FIELD_VECTOR, offsetof(Camera, center), -1e15, 1e15, 0},
    {".up", FIELD_VECTOR, offsetof(Camera, up), -1e15, 1e15, 0},
    {".fovy", FIELD_NUMBER, offsetof(Camera, fovy), DBL_MIN, 180, 0},
    {".near", FIELD_NUMBER, offsetof(Camera, near), DBL_MIN, DBL_MAX, 0},
    {".far", FIELD_NUMBER, offsetof(Camera, far), DBL_MIN, (double)INFINITY, 0},
};
static const Field SCENE[] = {
    {".global_ambient", FIELD_VECTOR, offsetof(Scene, global_ambient), 0, 1e6, 0},
    {".background", FIELD_VECTOR, offsetof(Scene, background), 0, 0, 0},
    {".distant_viewer", FIELD_FLAG, offsetof(Scene, distant_viewer), 0, 0, 0},
    {".clamp_vertex", FIELD_FLAG, offsetof(Scene, clamp_vertex), 0, 0, 0},
    {".linear", FIELD_FLAG, offsetof(Scene, linear), 0, 0, 0},
    {".show_clipped", FIELD_FLAG, offsetof(Scene, show_clipped), 0, 0, 0},
    {".signed_dots", FIELD_FLAG, offsetof(Scene, signed_dots), 0, 0, 0},
};
static const Field LIGHT[] = {
    COLORS(Light, 1e6),
    {".direction", FIELD_VECTOR, offsetof(Light, direction), -DBL_MAX, DBL_MAX,
     1 << LIGHT_DIRECTIONAL | 1 << LIGHT_SPOT},
    {".position", FIELD_VECTOR, offsetof(Light, position), -1e15, 1e15, NEAR_KINDS},
    {".constant", FIELD_NUMBER, offsetof(Light, constant), 0, 1e30, NEAR_KINDS},
    {".linear", FIELD_NUMBER, offsetof(Light, linear), 0, 1e30, NEAR_KINDS},
    {".quadratic", FIELD_NUMBER, offsetof(Light, quadratic), 0, 1e30, NEAR_KINDS},
    {".cutoff", FIELD_NUMBER, offsetof(Light, cutoff), 0, 90, 1 << LIGHT_SPOT},
    {".exponent", FIELD_NUMBER, offsetof(Light, exponent), 0, 128, 1 << LIGHT_SPOT},
    {".off", FIELD_FLAG, offsetof(Light, off), 0, 0, 0},
    {".shadows", FIELD_FLAG, offsetof(Light, shadows), 0, 0, 0},
};
static const Field MATERIAL[] = {
    COLORS(Material, 1),
    {".emission", FIELD_VECTOR, offsetof(Material, emission), 0, 1, 0},
    {".shininess", FIELD_NUMBER, offsetof(Material, shininess), 0, 128, 0},
};
static const Field SOLID[] = {
    {".radius", FIELD_NUMBER, offsetof(Solid, radius), 1e-30, 1e30, 0},
    {".height", FIELD_NUMBER, offsetof(Solid, height), 1e-30, 1e30, 0},
    {".tube", FIELD_NUMBER, offsetof(Solid, tube), 1e-30, 1e30, 0},
};
static const Field OBJECT[] = {
    {".two_sided", FIELD_FLAG, offsetof(Object, two_sided), 0, 0, 0},
    {".wrong_normals", FIELD_FLAG, offsetof(Object, wrong_normals), 0, 0, 0},
    {".clockwise", FIELD_FLAG, offsetof(Object, clockwise), 0, 0, 0},
};

typedef struct Numbers {
    RandomNumber *numbers;
    int count;
} Numbers;

static void add(Numbers *to, double *value, double min, double max)
{
    to->numbers[to->count++] = (RandomNumber){value, min, max};
}

/* Of a light of this kind. */
static void add_fields(Numbers *to, void *of, const Field *fields, size_t count, int kind)
{
    for (size_t i = 0; i < count; i++) {
        const Field *field = &fields[i];
        double *value = (double *)(void *)((char *)of + field->at);
        if (field->max == 0 || (field->kinds && !(field->kinds >> kind & 1)))
            continue;
        for (int k = 0; k < (field->type == FIELD_VECTOR ? 3 : 1); k++)
            add(to, value + k, field->min, field->max);
    }
}

int random_scene_numbers(RandomScene *made, RandomNumber numbers[RANDOM_MAX_NUMBERS])
{
    Numbers to = {numbers, 0};
    add_fields(&to, &made->scene.camera, CAMERA, COUNT(CAMERA), 0);
    add_fields(&to, &made->scene, SCENE, COUNT(SCENE), 0);
    for (int i = 0; i < made->scene.light_count; i++)
        add_fields(&to, &made->lights[i], LIGHT, COUNT(LIGHT), (int)made->lights[i].kind);
    for (int i = 0; i < made->scene.object_count; i++) {
        Object *object = &made->objects[i];
        Solid *solid = &made->shapes[i].solid;
        double *const sizes[] = {&solid->radius, &solid->height, &solid->tube};
        for (int k = 0; k < 15; k++)
            if (k % 4 < 3)
                add(&to, &object->world_from_object.m[k], -DBL_MAX, DBL_MAX);
        add_fields(&to, &object->front, MATERIAL, COUNT(MATERIAL), 0);
        if (object->two_sided)
            add_fields(&to, &object->back, MATERIAL, COUNT(MATERIAL), 0);
        for (int k = 0; k < 3; k++)
            if (*sizes[k] != 0)
                add(&to, sizes[k], SOLID[k].min, SOLID[k].max);
    }
    return to.count;
}

/* Without what is zero. */
static void print_fields(FILE *file, const void *of, const Field *fields, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const void *at = (const char *)of + fields[i].at;
        const double *v = at;
        if (fields[i].type == FIELD_FLAG)
            fputs(*(const bool *)at ? fields[i].name : "", file);
        if (fields[i].type == FIELD_FLAG && *(const bool *)at)
            fputs(" = true, ", file);
        if (fields[i].type == FIELD_VECTOR && (v[0] != 0 || v[1] != 0 || v[2] != 0))
            fprintf(file, "%s = {%.17g, %.17g, %.17g}, ", fields[i].name, v[0], v[1], v[2]);
        if (fields[i].type == FIELD_NUMBER && isinf(*v))
            fprintf(file, "%s = %sINFINITY, ", fields[i].name, *v < 0 ? "-" : "");
        else if (fields[i].type == FIELD_NUMBER && *v != 0)
            fprintf(file, "%s = %.17g, ", fields[i].name, *v);
    }
}

static void print_choice(FILE *file, const char *name, int value, const char *const texts[])
{
    if (value != 0)
        fprintf(file, "%s = %s, ", name, texts[value]);
}

static void print_light(FILE *file, int number, const Light *light)
{
    static const char *const kinds[] = {"LIGHT_DIRECTIONAL", "LIGHT_POINT", "LIGHT_SPOT"};
    static const char *const spaces[] = {"LIGHT_WORLD", "LIGHT_EYE"};
    fprintf(file, ".lights[%d] = {.kind = %s, ", number, kinds[light->kind]);
    print_choice(file, ".space", (int)light->space, spaces);
    print_fields(file, light, LIGHT, COUNT(LIGHT));
    fprintf(file, "},\n");
}

static void print_object(FILE *file, int number, const Object *object)
{
    fprintf(file, ".objects[%d] = {.world_from_object = {{", number);
    for (int k = 0; k < 16; k++)
        fprintf(file, "%.17g, ", object->world_from_object.m[k]);
    fprintf(file, "}},\n");
    for (int side = 0; side < (object->two_sided ? 2 : 1); side++) {
        const Material *material = side ? &object->back : &object->front;
        fprintf(file, "%s = {.alpha = %.17g, ", side ? ".back" : ".front", material->alpha);
        print_fields(file, material, MATERIAL, COUNT(MATERIAL));
        fprintf(file, "},\n");
    }
    print_fields(file, object, OBJECT, COUNT(OBJECT));
    fprintf(file, "},\n");
}

static void print_shape(FILE *file, int number, const RandomShape *shape)
{
    static const char *const forms[FORM_COUNT] = {"FORM_SOLID",       "FORM_TETRAHEDRON",
                                                  "FORM_OCTAHEDRON",  "FORM_DODECAHEDRON",
                                                  "FORM_ICOSAHEDRON", "FORM_LECTURE_SPHERE"};
    static const char *const kinds[] = {"SOLID_NONE", "SOLID_SPHERE", "SOLID_BOX",
                                        "SOLID_QUAD", "SOLID_DISC",   "SOLID_CYLINDER",
                                        "SOLID_CONE", "SOLID_TORUS",  "SOLID_TEAPOT"};
    static const char *const caps[] = {"MESH_CAP_NONE", "MESH_CAP_BOTTOM", "MESH_CAP_TOP",
                                       "MESH_CAP_BOTH"};
    fprintf(file, ".shapes[%d] = {", number);
    print_choice(file, ".form", (int)shape->form, forms);
    fprintf(file, ".solid = {");
    print_choice(file, ".kind", (int)shape->solid.kind, kinds);
    print_fields(file, &shape->solid, SOLID, COUNT(SOLID));
    print_choice(file, ".caps", (int)shape->solid.caps, caps);
    fprintf(file, "}, .divisions = %d", shape->divisions);
    fputs(shape->colored ? ", .colored = true},\n" : "},\n", file);
}

void random_scene_print(const RandomScene *made, const char *name, FILE *file)
{
    static const char *const interpolations[] = {"INTERPOLATION_PHONG", "INTERPOLATION_GOURAUD",
                                                 "INTERPOLATION_FLAT", "INTERPOLATION_CONSTANT"};
    static const char *const reflections[] = {"REFLECTION_BLINN_PHONG", "REFLECTION_PHONG"};
    const Scene *scene = &made->scene;
    fprintf(file, "static const RandomScene %s = {\n.scene = {.camera = {", name);
    print_fields(file, &scene->camera, CAMERA, COUNT(CAMERA));
    fprintf(file, "},\n");
    print_fields(file, scene, SCENE, COUNT(SCENE));
    fprintf(file, ".light_count = %d, .object_count = %d, ", scene->light_count,
            scene->object_count);
    print_choice(file, ".reflection", (int)scene->reflection, reflections);
    print_choice(file, ".interpolation", (int)scene->interpolation, interpolations);
    fprintf(file, "},\n");
    for (int i = 0; i < scene->light_count; i++)
        print_light(file, i, &made->lights[i]);
    for (int i = 0; i < scene->object_count; i++)
        print_object(file, i, &made->objects[i]);
    for (int i = 0; i < scene->object_count; i++)
        print_shape(file, i, &made->shapes[i]);
    fprintf(file, "};\n");
}
