#include "reference/reference_shade.h"

/* What of a positional light arrives at distance d. */
static Real attenuation(const Light *light, Real d)
{
    if (light->constant == 0 && light->linear == 0 && light->quadratic == 0)
        return 1;
    /* On the light itself the sum may be 0, and the share is not a number but large. */
    return 1 /
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

/* Without what a shadow keeps off. At its edge all of that would change; outside the light's cone
 * nothing does, but at the cone's edge, about which the points inside tell. `sum` is the light's.
 */
static Real3 shadowed(const Shading *shading, const struct ShadowPoint *shadows, int number,
                      const Real3 *ambient, bool in_cone, bool faces, Real highlight, Real3 sum,
                      ShadeSides *sides)
{
    const Real arriving = real3_largest(real3_subtract(sum, *ambient));
    const bool reaches = in_cone && faces;
    const bool hidden = reaches && arriving > 0 && shading->shadow_falls(shadows, number);
    const Real3 left = hidden ? *ambient : sum;
    if (reaches && arriving > 0)
        shade_note_light(sides, number, hidden);
    shade_note_side(sides, 2 * number + 1, reaches && !hidden,
                    hidden    ? arriving
                    : in_cone ? highlight
                              : 0);
    shade_note_side(sides, 2 * number, in_cone, in_cone ? real3_largest(left) : 0);
    return left;
}

Real3 shade_point(const Shading *shading, const Material *material, Real3 position, Real3 normal,
                  const struct ShadowPoint *shadows, ShadeSides *sides)
{
    const Real3 ambient = real3(material->ambient), diffuse = real3(material->diffuse);
    const Real3 specular = real3(material->specular);
    const Real3 v = shading->distant_viewer ? shading->view : real3_unit(real3_scale(position, -1));
    Real3 color =
        real3_add(real3(material->emission), real3_product(shading->global_ambient, ambient));
    *sides = (ShadeSides){.bits = 0};
    for (int i = 0; i < shading->light_count; i++) {
        const ShadeLight *shade = &shading->lights[i];
        const Light *light = shade->light;
        Real3 l = shade->direction;
        Real share = 1; /* of the light that arrives */
        bool in_cone = true;
        if (light->kind != LIGHT_DIRECTIONAL) {
            const Real3 way = real3_subtract(shade->position, position);
            l = real3_unit(way);
            share = attenuation(light, real3_length(way));
        }
        if (light->kind == LIGHT_SPOT) {
            const Real along = -real3_dot(l, shade->direction);
            in_cone = along >= shade->cosine_cutoff;
            share *= real_pow(real_max(along, 0), light->exponent);
        }
        const Real n_dot_l = real3_dot(normal, l);
        Real3 highlight = real3_product(real3(light->specular), specular);
        if (real3_largest(highlight) > 0)
            highlight =
                real3_scale(highlight, share * real_pow(highlight_cosine(shading, normal, l, v),
                                                        material->shininess));
        /* Behind the surface there is no highlight. */
        const bool faces = n_dot_l > 0;
        Real3 sum = real3_add(
            real3_product(real3(light->ambient), ambient),
            real3_scale(real3_product(real3(light->diffuse), diffuse), real_max(n_dot_l, 0)));
        sum = real3_scale(sum, share);
        if (faces)
            sum = real3_add(sum, highlight);
        if (shadows && light->shadows) {
            const Real3 kept = real3_scale(real3_product(real3(light->ambient), ambient), share);
            sum = shadowed(shading, shadows, i, &kept, in_cone, faces, real3_largest(highlight),
                           sum, sides);
        } else {
            shade_note_side(sides, 2 * i + 1, faces, in_cone ? real3_largest(highlight) : 0);
            if (light->kind == LIGHT_SPOT)
                shade_note_side(sides, 2 * i, in_cone, real3_largest(sum));
        }
        if (in_cone)
            color = real3_add(color, sum);
    }
    return color;
}
