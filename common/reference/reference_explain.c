/* Each term is what shade_light computes of a material that has this term alone; the share, of a
 * white ambient term. */
#include "reference/reference_explain.h"

#include "base/memory.h"

#include <stdlib.h>

static const Vec3 WHITE = {1, 1, 1};

static Vec3 lit(const Shading *shading, const ShadePoint *point, Material only, int number)
{
    const ShadePoint part = {&only, point->position, point->normal};
    return real3_round(shade_light(shading, &part, number).sum);
}

static ExplainLight explain_light(const TracePoint *point, Vec3 viewer, int number)
{
    const Shading *shading = point->shading;
    const Material *material = &point->material;
    const Vec3 normal = real3_round(point->point.normal);
    ShadeLight white = shading->lights[number];
    Light light = *white.light;
    Shading whole = *shading;
    const Real3 way = light.kind == LIGHT_DIRECTIONAL
                          ? white.direction
                          : real3_subtract(white.position, point->point.position);
    ExplainLight said = {.light = white.light, .direction = real3_round(real3_unit(way))};
    light.ambient = WHITE;
    white.light = &light;
    whole.lights = &white;
    said.share = lit(&whole, &point->point, (Material){.ambient = WHITE}, 0).x;
    said.outside = !shade_light(shading, &point->point, number).in_cone;
    if (said.outside)
        said.share = 0;
    const double unit = said.share > 0 ? 1 / said.share : 0;
    said.ambient = vec3_scale(
        lit(shading, &point->point, (Material){.ambient = material->ambient}, number), unit);
    said.diffuse = vec3_scale(
        lit(shading, &point->point, (Material){.diffuse = material->diffuse}, number), unit);
    said.specular = vec3_scale(
        lit(shading, &point->point,
            (Material){.specular = material->specular, .shininess = material->shininess}, number),
        unit);
    const double dot = vec3_dot(normal, said.direction);
    said.mirror = shading->reflection_phong
                      ? vec3_subtract(vec3_scale(normal, 2 * dot), said.direction)
                      : vec3_unit(vec3_add(said.direction, viewer));
    said.n_dot_l = shading->signed_dots ? dot : fmax(dot, 0);
    said.cosine = fmax(vec3_dot(said.mirror, shading->reflection_phong ? viewer : normal), 0);
    return said;
}

bool explain_open(Explained *explained, const Trace *trace, double x, double y)
{
    TracePoint point;
    Sample sample;
    *explained = (Explained){.count = 0};
    if (!trace_point(trace, x, y, &point))
        return false;
    trace_sample(trace, x, y, &sample);
    const Shading *shading = point.shading;
    *explained = (Explained){
        .material = point.material,
        .position = sample.position,
        .depth = sample.depth,
        .normal = real3_round(point.point.normal),
        .viewer = shading->distant_viewer ? real3_round(shading->view)
                                          : vec3_unit(vec3_scale(sample.position, -1)),
        .base = real3_round(shade_base(shading, &point.point)),
        .lights = memory_new((size_t)shading->light_count + 1, sizeof *explained->lights),
        .count = shading->light_count,
        .phong = shading->reflection_phong,
    };
    for (int i = 0; i < explained->count; i++) {
        explained->lights[i] = explain_light(&point, explained->viewer, i);
        explained->lights[i].hidden = sample.lights >> (2 * i & 31) & 1;
    }
    return true;
}

void explain_close(Explained *explained)
{
    free(explained->lights);
    *explained = (Explained){.lights = NULL};
}
