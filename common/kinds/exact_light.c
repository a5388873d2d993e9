/* One ray through the pixel's centre, and the lighting equation where it ends. */
#include "kinds/exact_light.h"

#include "base/json_writer.h"
#include "base/output_text.h"
#include "reference/reference_explain.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double RADIANS = 0.017453292519943295;

/* The equation as a text, and as members of a JSON object. */
typedef struct Writing {
    FILE *file;
    JsonWriter json;
} Writing;

/* A grey is one number of the text. */
static void put_color(Writing *to, const char *name, const char *before, Vec3 color)
{
    if (color.x == color.y && color.y == color.z)
        fprintf(to->file, "%s%.6g", before, color.x);
    else
        fprintf(to->file, "%s%.6g, %.6g, %.6g", before, color.x, color.y, color.z);
    json_write_list(&to->json, name);
    json_write_number(&to->json, NULL, color.x);
    json_write_number(&to->json, NULL, color.y);
    json_write_number(&to->json, NULL, color.z);
    json_write_end(&to->json);
}

/* "diffuse: (1) * (0.5, 0.4, 0.1) * N.L 0.8 = 0.4, 0.32, 0.08"; nothing where a factor is black.
 */
static void put_term(Writing *to, const char *name, const Vec3 factors[2], const char *rest,
                     Vec3 term)
{
    if (color_is_black(factors[0]) || color_is_black(factors[1]))
        return;
    fprintf(to->file, "%s: ", name);
    json_write_object(&to->json, name + strspn(name, " "));
    put_color(to, "light", "(", factors[0]);
    put_color(to, "material", ") * (", factors[1]);
    fprintf(to->file, ")%s", rest);
    put_color(to, "term", " = ", term);
    fputc('\n', to->file);
    json_write_end(&to->json);
}

static Vec3 put_light(Writing *to, const Explained *at, const ExplainLight *lit, int number)
{
    const Light *light = lit->light;
    const Material *material = &at->material;
    const char *of = at->phong ? "R.V" : "N.H";
    char rest[100];
    json_write_object(&to->json, NULL);
    json_write_whole(&to->json, "light", number);
    json_write_number(&to->json, "share", lit->share);
    if (lit->share <= 0) {
        fprintf(to->file, "light %d, 0 of it arrives: %s\n", number,
                lit->outside ? "outside its cone" : "too far away");
        json_write_end(&to->json);
        return (Vec3){0, 0, 0};
    }
    fprintf(to->file, "light %d, %.6g of it arrives%s:\n", number, lit->share,
            lit->hidden ? "; in shadow, which leaves the ambient term" : "");
    json_write_flag(&to->json, "hidden", lit->hidden);
    json_write_number(&to->json, "N.L", lit->n_dot_l);
    json_write_number(&to->json, of, lit->cosine);
    json_write_number(&to->json, "exponent", material->shininess);
    put_term(to, "  ambient", (Vec3[]){light->ambient, material->ambient}, "", lit->ambient);
    snprintf(rest, sizeof rest, " * N.L %.6g", lit->n_dot_l);
    put_term(to, "  diffuse", (Vec3[]){light->diffuse, material->diffuse}, rest, lit->diffuse);
    snprintf(rest, sizeof rest, " * (%s %.6g)^%.6g%s", of, lit->cosine, material->shininess,
             lit->n_dot_l > 0 ? "" : ", behind the surface");
    put_term(to, "  specular", (Vec3[]){light->specular, material->specular}, rest, lit->specular);
    json_write_end(&to->json);
    const Vec3 sum =
        lit->hidden ? lit->ambient : vec3_add(lit->ambient, vec3_add(lit->diffuse, lit->specular));
    return vec3_scale(sum, lit->share);
}

static void put_equation(const Explained *at, const Scene *scene, bool unlit, ExactPixel *exact)
{
    OutputText text, terms;
    Vec3 sum = at->base;
    output_text_open(&text);
    output_text_open(&terms);
    Writing to = {text.file, {.file = terms.file}};
    json_write_object(&to.json, NULL);
    if (!color_is_black(at->material.emission)) {
        put_color(&to, "emission", "emission: ", at->material.emission);
        fputc('\n', to.file);
    }
    if (unlit) {
        put_color(&to, "unlit", "diffuse colour, without lighting: ", at->base);
        fputc('\n', to.file);
    } else
        put_term(&to, "global ambient", (Vec3[]){scene->global_ambient, at->material.ambient}, "",
                 vec3_subtract(at->base, at->material.emission));
    json_write_list(&to.json, "lights");
    for (int i = 0; i < at->count; i++)
        sum = vec3_add(
            sum, put_light(&to, at, &at->lights[i], (int)(at->lights[i].light - scene->lights)));
    json_write_end(&to.json);
    put_color(&to, "sum", "sum: ", sum);
    fprintf(to.file, "%s\n", scene->linear ? ", which is encoded as sRGB" : "");
    json_write_end(&to.json);
    exact->equation = output_text_close(&text);
    exact->terms = output_text_close(&terms);
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
        put_equation(&said, scene, unlit, exact);
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
