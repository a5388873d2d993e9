/*
 * scene_fuzz: no scene may do harm, whatever its numbers.
 *
 * The first bytes are the seeds of a random scene, for what there is in it; then come changes: the
 * number of a number, what it becomes, and where that is "these bits", eight bytes. What
 * scene_check accepts has effects that can be explained and an exact picture, as solids and as
 * meshes, all of whose colours are colours.
 */
#include "fuzz/fuzz.h"
#include "hard/random_scene.h"
#include "reference/reference.h"
#include "support/effects_of.h"

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static RandomMeshes meshes;

typedef struct Input {
    const uint8_t *data;
    size_t size;
} Input;

/* Zeros beyond the end. */
static uint64_t take(Input *input, size_t count)
{
    uint64_t value = 0;
    for (size_t i = 0; i < count && input->size > 0; i++, input->data++, input->size--)
        value |= (uint64_t)*input->data << (8 * i);
    return value;
}

static double taken_number(Input *input, double old)
{
    static const double values[] = {0,       1,    -1,    0.5,   1e-30,   1e30,     5e-324,
                                    DBL_MIN, 1e15, 1e-15, 90,    128,     FLT_MIN,  FLT_MAX,
                                    1e-7,    180,  1e6,   1e-38, DBL_MAX, INFINITY, NAN};
    enum { COUNT = sizeof values / sizeof values[0] };
    const uint64_t choice = take(input, 1), bits = choice >= 200 ? take(input, 8) : 0;
    double number;
    memcpy(&number, &bits, sizeof number);
    return choice < COUNT ? values[choice]
           : choice < 40  ? -old
           : choice < 120 ? ldexp(old, (int)choice - 80)
           : choice < 200 ? old + ldexp(1, (int)choice - 180)
                          : number;
}

static void render(const Scene *scene, bool as_meshes)
{
    Reference picture;
    Message message = {0};
    const ReferenceOptions options = {
        .width = 2, .height = 1, .meshes = as_meshes, .edge_error = 255, .threads = 1};
    require(reference_open(&picture, scene, &options, &message));
    for (int i = 0; i < picture.width * picture.height; i++) {
        for (int c = 0; c < 3; c++)
            require(picture.color[3 * i + c] >= 0 && picture.color[3 * i + c] <= 1);
        require(picture.depth[i] > 0 && picture.coverage[i] >= 0 && picture.coverage[i] <= 1);
    }
    reference_close(&picture);
}

/* No light is in two groups, and every decision has something to say. */
static void decide(const Scene *scene)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return;
    for (int i = 0; i < scene->object_count; i++) {
        const Effects one = effects_of(scene, &scene->objects[i]);
        int lights = 0;
        for (int g = 0; g < one.group_count; g++)
            lights += one.groups[g].count;
        require(lights <= scene->light_count);
        effects_explain(scene, &scene->objects[i], file);
    }
    fclose(file);
    require(scene->object_count == 0 || size > 0);
    free(text);
}

static void change_choices(RandomScene *made, uint64_t bits)
{
    made->scene.object_count = made->scene.object_count > 1 ? 2 : 1;
    for (int i = 0; i < made->scene.object_count; i++) {
        RandomShape *shape = &made->shapes[i];
        /* Few triangles, many executions; of a teapot the exact picture has very many. */
        shape->divisions = 3 + (int)(bits >> (4 * i) & 1);
        if (shape->solid.kind == SOLID_TEAPOT)
            shape->solid.kind = SOLID_SPHERE;
        if (bits >> (30 + i) & 1)
            made->objects[i].wrong_normals = true;
    }
    if (bits >> 40 & 1)
        made->scene.light_count = 0;
    if (bits >> 41 & 1) /* one too many */
        made->scene.interpolation = (Interpolation)(int)((bits >> 42 & 3) + (bits >> 45 & 1));
}

/* Where the numbers of a scene are: of its structs those from one field to another, which are all
 * doubles. */
typedef struct Numbers {
    double *at[512];
    int count;
} Numbers;

static void add_numbers(Numbers *to, void *of, size_t first, size_t last)
{
    for (size_t at = first; at <= last; at += sizeof(double))
        to->at[to->count++] = (double *)(void *)((char *)of + at);
}

#define ADD_NUMBERS(to, of, Type, first, last)                                                     \
    add_numbers(to, of, offsetof(Type, first), offsetof(Type, last))

FUZZ(data, size)
{
    Input input = {data, size};
    RandomScene made;
    Numbers numbers = {.count = 0};
    Message message = {0};
    const uint64_t kind = take(&input, 2), values = take(&input, 1);
    random_scene_make(&made, kind, values);
    const uint64_t choices = take(&input, 6);
    change_choices(&made, choices);
    ADD_NUMBERS(&numbers, &made.scene.camera, Camera, eye, aspect);
    ADD_NUMBERS(&numbers, &made.scene, Scene, global_ambient.x, global_ambient.z);
    for (int i = 0; i < made.scene.light_count; i++)
        ADD_NUMBERS(&numbers, &made.lights[i], Light, position, range);
    for (int i = 0; i < made.scene.object_count; i++) {
        Object *object = &made.objects[i];
        ADD_NUMBERS(&numbers, &object->world_from_object, Mat4, m[0], m[15]);
        ADD_NUMBERS(&numbers, &object->front, Material, ambient, shininess);
        ADD_NUMBERS(&numbers, &object->back, Material, ambient, shininess);
        ADD_NUMBERS(&numbers, &made.shapes[i].solid, Solid, radius, tube);
    }
    while (input.size > 0) {
        double *value = numbers.at[take(&input, 2) % (uint64_t)numbers.count];
        *value = taken_number(&input, *value);
    }
    if (meshes.count > 64)
        random_meshes_close(&meshes);
    if (!random_scene_ready(&made, &meshes, &message)) {
        require(message.text[0]);
        return 0;
    }
    const bool sound = scene_check(&made.scene, &message);
    require(sound == !message.text[0]);
    if (!sound)
        return 0;
    decide(&made.scene);
    render(&made.scene, choices >> 44 & 1);
    return 0;
}
