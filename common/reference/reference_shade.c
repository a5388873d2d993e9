/*
 * A light's part of the sum is computed by itself, with what of it a shadow would leave: who knows
 * of shadows (reference_shadow.h) decides between the two.
 *
 * The sum jumps where a light's cone ends, and where N.L turns positive while there is a highlight.
 * Such a jump is an edge of the picture, which samples on its two sides must be told apart by, even
 * if their colors are close: hence the bits of ShadeSides.
 */
#include "reference/reference_shade.h"

/* What of a positional light arrives at distance d. */
static Real attenuation(const Light *light, Real d)
{
    Real left = 1; /* within its range */
    if (light->range > 0) {
        const Real near = d * d / (light->range * light->range);
        left = real_max(1 - near * near, 0);
    }
    if (light->constant == 0 && light->linear == 0 && light->quadratic == 0)
        return left;
    /* On the light itself the sum may be 0, and the share is not a number but large. */
    return left /
           real_max(light->constant + light->linear * d + light->quadratic * d * d, (Real)1e-30);
}

/* The cosine whose power is the highlight. */
static Real highlight_cosine(const Shading *shading, Real3 n, Real3 l, Real3 v)
{
    if (shading->reflection_phong) {
        const Real3 r = real3_subtract(real3_scale(n, 2 * real3_dot(n, l)), l);
        return real_max(real3_dot(r, v), 0);
    }
    return real_max(real3_dot(n, real3_unit(real3_add(l, v))), 0);
}

LightSample shade_light(const Shading *shading, const ShadePoint *point, int number)
{
    const ShadeLight *shade = &shading->lights[number];
    const Light *light = shade->light;
    const Material *material = point->material;
    LightSample sample = {.in_cone = true};
    Real3 l = shade->direction;
    Real share = 1; /* of the light that arrives */
    if (light->kind != LIGHT_DIRECTIONAL) {
        const Real3 way = real3_subtract(shade->position, point->position);
        l = real3_unit(way);
        share = attenuation(light, real3_length(way));
    }
    if (light->kind == LIGHT_SPOT) {
        const Real along = -real3_dot(l, shade->direction);
        sample.in_cone = along >= shade->cosine_cutoff;
        share *= real_pow(real_max(along, 0), light->exponent);
    }
    const Real n_dot_l = real3_dot(point->normal, l);
    Real3 highlight = real3_product(real3(light->specular), real3(material->specular));
    if (real3_largest(highlight) > 0) {
        const Real3 v =
            shading->distant_viewer ? shading->view : real3_unit(real3_scale(point->position, -1));
        const Real cosine = highlight_cosine(shading, point->normal, l, v);
        highlight = real3_scale(highlight, share * real_pow(cosine, material->shininess));
    }
    const Real3 ambient = real3_product(real3(light->ambient), real3(material->ambient));
    const Real3 diffuse = real3_product(real3(light->diffuse), real3(material->diffuse));
    sample.ambient = real3_scale(ambient, share);
    const Real arriving = shading->signed_dots && !light->shadows ? n_dot_l : real_max(n_dot_l, 0);
    sample.sum = real3_scale(real3_add(ambient, real3_scale(diffuse, arriving)), share);
    /* Behind the surface there is no highlight. */
    sample.faces = n_dot_l > 0;
    if (sample.faces)
        sample.sum = real3_add(sample.sum, highlight);
    sample.highlight = real3_largest(highlight);
    return sample;
}

Real shade_arriving(const LightSample *sample)
{
    return sample->in_cone && sample->faces
               ? real3_largest(real3_subtract(sample->sum, sample->ambient))
               : 0;
}

Real3 shade_base(const Shading *shading, const ShadePoint *point)
{
    return real3_add(real3(point->material->emission),
                     real3_product(shading->global_ambient, real3(point->material->ambient)));
}

void shade_add(const Shading *shading, int number, const LightSample *sample, Real3 *color,
               ShadeSides *sides)
{
    shade_note_side(sides, 2 * number + 1, sample->faces, sample->in_cone ? sample->highlight : 0);
    if (shading->lights[number].light->kind == LIGHT_SPOT)
        shade_note_side(
            sides, 2 * number, sample->in_cone,
            real_max(real3_largest(sample->sum), real3_largest(real3_scale(sample->sum, -1))));
    if (sample->in_cone)
        *color = real3_add(*color, sample->sum);
}

Real3 shade_point(const Shading *shading, const ShadePoint *point, ShadeSides *sides)
{
    Real3 color = shade_base(shading, point);
    *sides = (ShadeSides){.bits = 0};
    for (int i = 0; i < shading->light_count; i++) {
        const LightSample sample = shade_light(shading, point, i);
        shade_add(shading, i, &sample, &color, sides);
    }
    return color;
}
