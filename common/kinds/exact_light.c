/* One ray through the pixel's centre, and the lighting equation where it ends. */
#include "kinds/exact_light.h"

#include "base/output_text.h"
#include "reference/reference_explain.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double RADIANS = 0.017453292519943295;

/* A grey is one number. */
static void put_color(FILE *file, const char *before, Vec3 color)
{
    if (color.x == color.y && color.y == color.z)
        fprintf(file, "%s%.6g", before, color.x);
    else
        fprintf(file, "%s%.6g, %.6g, %.6g", before, color.x, color.y, color.z);
}

/* "diffuse: (1) * (0.5, 0.4, 0.1) * N.L 0.8 = 0.4, 0.32, 0.08"; nothing where a factor is black.
 */
static void put_term(FILE *file, const char *name, const Vec3 factors[2], const char *rest,
                     Vec3 term)
{
    if (color_is_black(factors[0]) || color_is_black(factors[1]))
        return;
    fprintf(file, "%s: ", name);
    put_color(file, "(", factors[0]);
    put_color(file, ") * (", factors[1]);
    fprintf(file, ")%s", rest);
    put_color(file, " = ", term);
    fputc('\n', file);
}

static Vec3 put_light(FILE *file, const Explained *at, const ExplainLight *lit, int number)
{
    const Light *light = lit->light;
    const Material *material = &at->material;
    char rest[100];
    if (lit->share <= 0) {
        fprintf(file, "light %d, 0 of it arrives: %s\n", number,
                lit->outside ? "outside its cone" : "too far away");
        return (Vec3){0, 0, 0};
    }
    fprintf(file, "light %d, %.6g of it arrives%s:\n", number, lit->share,
            lit->hidden ? "; in shadow, which leaves the ambient term" : "");
    put_term(file, "  ambient", (Vec3[]){light->ambient, material->ambient}, "", lit->ambient);
    snprintf(rest, sizeof rest, " * N.L %.6g", lit->n_dot_l);
    put_term(file, "  diffuse", (Vec3[]){light->diffuse, material->diffuse}, rest, lit->diffuse);
    snprintf(rest, sizeof rest, " * (%s %.6g)^%.6g%s", at->phong ? "R.V" : "N.H", lit->cosine,
             material->shininess, lit->n_dot_l > 0 ? "" : ", behind the surface");
    put_term(file, "  specular", (Vec3[]){light->specular, material->specular}, rest,
             lit->specular);
    const Vec3 sum =
        lit->hidden ? lit->ambient : vec3_add(lit->ambient, vec3_add(lit->diffuse, lit->specular));
    return vec3_scale(sum, lit->share);
}

static char *equation(const Explained *at, const Scene *scene, bool unlit)
{
    OutputText text;
    Vec3 sum = at->base;
    output_text_open(&text);
    FILE *file = text.file;
    if (!color_is_black(at->material.emission)) {
        put_color(file, "emission: ", at->material.emission);
        fputc('\n', file);
    }
    if (unlit) {
        put_color(file, "diffuse colour, without lighting: ", at->base);
        fputc('\n', file);
    } else
        put_term(file, "global ambient", (Vec3[]){scene->global_ambient, at->material.ambient}, "",
                 vec3_subtract(at->base, at->material.emission));
    for (int i = 0; i < at->count; i++)
        sum = vec3_add(
            sum, put_light(file, at, &at->lights[i], (int)(at->lights[i].light - scene->lights)));
    put_color(file, "sum: ", sum);
    fprintf(file, "%s\n", scene->linear ? ", which is encoded as sRGB" : "");
    return output_text_close(&text);
}

/* What the directions are drawn with. */
typedef struct Pointer {
    const Trace *trace;
    const Explained *at;
    double size; /* of a unit vector in the world */
    int left, top;
} Pointer;

static void add_direction(ExactPixel *exact, const Pointer *pointer, const char *letter, int light,
                          Vec3 direction)
{
    if (exact->direction_count == EXACT_DIRECTIONS)
        return;
    ExactDirection *made = &exact->directions[exact->direction_count++];
    snprintf(made->name, sizeof made->name, light < 0 ? "%s" : "%s%d", letter, light % 1000);
    memcpy(made->vector, (double[]){direction.x, direction.y, direction.z}, sizeof made->vector);
    trace_place(pointer->trace,
                vec3_add(pointer->at->position, vec3_scale(direction, pointer->size)), made->to);
    made->to[0] += pointer->left;
    made->to[1] += pointer->top;
}

void exact_light_tell(ExactPixel *exact, const Trace *trace, const Scene *scene, const int place[4],
                      const double at[2], bool unlit)
{
    Explained said;
    Sample sample;
    *exact = (ExactPixel){.equation = NULL};
    trace_sample(trace, at[0], at[1], &sample);
    memcpy(exact->color, sample.color, sizeof sample.color);
    snprintf(exact->object, sizeof exact->object,
             sample.object < 0 ? "the background" : "object %d", sample.object);
    if (explain_open(&said, trace, at[0], at[1])) {
        /* A fifth of the view's height. */
        const double fovy = scene_fovy(&scene->camera, (double)place[2] / place[3]);
        const Pointer pointer = {trace, &said, 0.4 * tan(fovy / 2 * RADIANS) * said.depth, place[0],
                                 place[1]};
        exact->equation = equation(&said, scene, unlit);
        add_direction(exact, &pointer, "N", -1, said.normal);
        add_direction(exact, &pointer, "V", -1, said.viewer);
        for (int i = 0; i < said.count; i++) {
            const int number = (int)(said.lights[i].light - scene->lights);
            add_direction(exact, &pointer, "L", number, said.lights[i].direction);
            add_direction(exact, &pointer, said.phong ? "R" : "H", number, said.lights[i].mirror);
        }
    }
    explain_close(&said);
}
