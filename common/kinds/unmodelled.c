/* What the lighting model leaves out of this very scene, found by the exact picture's rays: from
 * some hundred points of each surface, spread evenly (Roberts' sequence), segments to each light;
 * where another object is in between there would be a shadow. Some hundred points miss small
 * shadows, which is good enough for a sentence about the scene.
 */
#include "kinds/scene_views.h"

#include "base/memory.h"
#include "reference/reference_triangles.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 200, FEW_OBJECTS = 24 };

static const char *name_of(const Object *object)
{
    static const char *const names[] = {
        [SOLID_NONE] = "a mesh",   [SOLID_SPHERE] = "a sphere", [SOLID_BOX] = "a box",
        [SOLID_QUAD] = "a square", [SOLID_DISC] = "a disc",     [SOLID_CYLINDER] = "a cylinder",
        [SOLID_CONE] = "a cone",   [SOLID_TORUS] = "a torus",   [SOLID_TEAPOT] = "a teapot",
    };
    return names[object->solid.kind];
}

/* An object in world coordinates. */
typedef struct Placed {
    const Object *object;
    Real3 *vertices;
    Triangles triangles;
} Placed;

static void placed_close(Placed *placed, int count)
{
    for (int i = 0; i < count; i++) {
        triangles_close(&placed[i].triangles);
        free(placed[i].vertices);
    }
    free(placed);
}

/* False: not enough memory. */
static bool place(Placed *placed, const Object *object)
{
    const Mesh *mesh = object->mesh;
    placed->object = object;
    placed->vertices = malloc((mesh->vertex_count + 1) * sizeof *placed->vertices);
    for (size_t k = 0; placed->vertices && k < mesh->vertex_count; k++)
        placed->vertices[k] = real3(mat4_transform_point(
            object->world_from_object, vec3_from_float(mesh->vertices[k].position)));
    return placed->vertices &&
           triangles_open(&placed->triangles, mesh, placed->vertices, true, 1, NULL);
}

/* The way from a point to the light; for a directional one, out of a scene of this size. */
static Vec3 way_to(const Light *light, Vec3 from, double size)
{
    Vec3 unit;
    if (light->kind != LIGHT_DIRECTIONAL)
        return vec3_subtract(light->position, from);
    vec3_normalize(light->direction, &unit);
    return vec3_scale(unit, size);
}

/* Point number `sample` on the surface, spread over all triangles, and its normal. (Roberts, The
 * Unreasonable Effectiveness of Quasirandom Sequences, 2018) */
static Vec3 surface_point(const Placed *placed, int sample, Vec3 *normal)
{
    const Mesh *mesh = placed->object->mesh;
    const size_t count = mesh->index_count / 3;
    const size_t triangle =
        count < SAMPLES ? (size_t)sample % count : (size_t)sample * (count / SAMPLES);
    double u = fmod(0.5 + 0.7548776662466927 * sample, 1);
    double v = fmod(0.5 + 0.5698402909980532 * sample, 1);
    Vec3 corners[3];
    for (size_t k = 0; k < 3; k++)
        corners[k] = real3_round(placed->vertices[mesh->indices[3 * triangle + k]]);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const Vec3 ab = vec3_subtract(corners[1], corners[0]);
    const Vec3 ac = vec3_subtract(corners[2], corners[0]);
    const uint32_t vertex = mesh->indices[3 * triangle];
    *normal = mat4_transform_direction(mat4_normal(placed->object->world_from_object),
                                       vec3_from_float(mesh->vertices[vertex].normal));
    return vec3_add(corners[0], vec3_add(vec3_scale(ab, u), vec3_scale(ac, v)));
}

/* Whether some point of the receiver that faces the light is hidden from it. */
static bool throws_shadow(const Placed *occluder, const Placed *receiver, const Light *light,
                          double size)
{
    static const double END = 1e-3;
    for (int sample = 0; sample < SAMPLES; sample++) {
        Vec3 normal;
        const Vec3 from = surface_point(receiver, sample, &normal);
        const Vec3 way = way_to(light, from, size);
        /* Not at the ends, where surfaces touch. */
        const double error = END * vec3_length(way);
        const TriangleSegment segment = {.from = real3(from),
                                         .way = real3(way),
                                         .own = TRIANGLES_NONE,
                                         .error = error,
                                         .light_error = error};
        /* At a grazing angle a mesh's own facets are in the way. */
        if (vec3_dot(normal, way) > 0.3 * vec3_length(normal) * vec3_length(way) &&
            triangles_block(&occluder->triangles, &segment))
            return true;
    }
    return false;
}

static bool is_lit(const Object *object)
{
    return object->mesh->colors || !color_is_black(object->front.diffuse) ||
           !color_is_black(object->front.specular);
}

/* The lights, by number, in whose light the occluder casts a shadow on the receiver. */
static int shadow_lights(const Scene *scene, const Placed *occluder, const Placed *receiver,
                         double size, int lights[SAMPLES])
{
    int count = 0;
    for (int l = 0; l < scene->light_count && count < SAMPLES; l++) {
        const Light light = scene_world_light(scene, l);
        const bool on = !light.off && !light.shadows &&
                        !(color_is_black(light.diffuse) && color_is_black(light.specular));
        if (on && throws_shadow(occluder, receiver, &light, size))
            lights[count++] = l;
    }
    return count;
}

static int explain_shadows(const Scene *scene, const Placed *placed, FILE *file)
{
    int lines = 0;
    /* The diameter of the box around everything, doubled. */
    double largest = 0;
    for (int i = 0; i < scene->object_count; i++)
        for (size_t k = 0; k < placed[i].object->mesh->vertex_count; k++)
            largest = fmax(largest, vec3_length(real3_round(placed[i].vertices[k])));
    const double size = 4 * largest;
    for (int o = 0; o < scene->object_count; o++)
        for (int r = 0; r < scene->object_count; r++) {
            int lights[SAMPLES];
            const Object *receiver = &scene->objects[r];
            const int count =
                is_lit(receiver) ? shadow_lights(scene, &placed[o], &placed[r], size, lights) : 0;
            if (!count)
                continue;
            fprintf(file, "object %d, %s, would cast a shadow on ", o, name_of(&scene->objects[o]));
            if (o == r)
                fprintf(file, "itself (");
            else
                fprintf(file, "object %d, %s (", r, name_of(receiver));
            for (int i = 0; i < count; i++)
                fprintf(file, "%s%d", i ? ", " : count > 1 ? "lights " : "light ", lights[i]);
            fprintf(file, ")\n");
            lines++;
        }
    return lines;
}

/* Of many objects how many: pairs of them would be many lines, and take long to find. */
static void explain_many(const Scene *scene, FILE *file)
{
    int emitting = 0, clear = 0, unshadowed = 0;
    for (int i = 0; i < scene->object_count; i++) {
        emitting += !color_is_black(scene->objects[i].front.emission);
        clear += scene->objects[i].front.alpha < 1;
    }
    for (int i = 0; i < scene->light_count; i++)
        unshadowed += !scene->lights[i].off && !scene->lights[i].shadows;
    if (unshadowed)
        fprintf(file, "objects would cast shadows on each other, in %d of %d lights\n", unshadowed,
                scene->light_count);
    if (emitting)
        fprintf(file, "%d objects emit, and would light other surfaces too\n", emitting);
    if (clear)
        fprintf(file, "%d objects would let light through, and refract it\n", clear);
    fprintf(file, "surfaces would light each other with what they reflect; ambient light stands "
                  "for it\n");
}

bool unmodelled_explain(const Scene *scene, FILE *file, Message *message)
{
    if (scene->object_count > FEW_OBJECTS) {
        explain_many(scene, file);
        return true;
    }
    Placed *placed = memory_new((size_t)scene->object_count, sizeof *placed);
    bool done = true;
    for (int i = 0; i < scene->object_count && done; i++)
        done = place(&placed[i], &scene->objects[i]);
    int reflecting = 0, lines = done ? explain_shadows(scene, placed, file) : 0;
    placed_close(placed, scene->object_count);
    if (!done)
        return message_set(message, "scene: not enough memory to look for shadows");
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        reflecting += is_lit(object);
        const bool emits = !color_is_black(object->front.emission), clear = object->front.alpha < 1;
        lines += emits + clear;
        if (emits)
            fprintf(file, "object %d, %s, emits, and would light other surfaces too\n", i,
                    name_of(object));
        if (clear)
            fprintf(file, "object %d, %s, would let light through, and refract it\n", i,
                    name_of(object));
    }
    if (reflecting > 1)
        fprintf(file, "surfaces would light each other with what they reflect; ambient light "
                      "stands for it\n");
    else if (lines == 0)
        fprintf(file, "nothing: one surface, whose every lit point sees its lights\n");
    return true;
}
