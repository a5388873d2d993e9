#include "hard/hard.h"

#include "reference/picture_error.h"
#include "shapes/mesh_solids.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <math.h>
#include <string.h>

void hard_open(Hard *hard, int width, int height)
{
    static const char *const precisions[] = {"highp", "mediump"};
    const CanvasOptions bytes = {.width = width, .height = height};
    const CanvasOptions floats = {.width = width, .height = height, .real = true};
    memset(hard, 0, sizeof *hard);
    require(mesh_sphere(&hard->sphere, 1, 24, 12, FAILURE) && mesh_quad(&hard->quad, 2, FAILURE),
            FAILURE);
    require(canvas_open(&hard->bytes, &bytes, FAILURE), FAILURE);
    require(canvas_open_beside(&hard->floats, &hard->bytes, &floats, FAILURE), FAILURE);
    require(image_open(&hard->image, width, height, IMAGE_BYTE, FAILURE), FAILURE);
    require(image_open(&hard->real, width, height, hard->floats.real ? IMAGE_FLOAT : IMAGE_BYTE,
                       FAILURE),
            FAILURE);
    for (int i = 0; i < 2; i++) {
        const ShaderLoader loader = {.precision = precisions[i]};
        require(lighting_open(&hard->lightings[i], &loader, FAILURE), FAILURE);
    }
}

void hard_close(Hard *hard)
{
    for (int i = 0; i < 2; i++)
        lighting_close(hard->lightings[i]);
    image_close(&hard->image);
    image_close(&hard->real);
    mesh_close(&hard->sphere);
    mesh_close(&hard->quad);
    canvas_close(&hard->floats);
    canvas_close(&hard->bytes);
}

void hard_resize(Hard *hard, int width, int height)
{
    image_close(&hard->image);
    image_close(&hard->real);
    require(canvas_resize(&hard->bytes, width, height, FAILURE) &&
                canvas_resize(&hard->floats, width, height, FAILURE) &&
                image_open(&hard->image, width, height, IMAGE_BYTE, FAILURE) &&
                image_open(&hard->real, width, height, hard->floats.real ? IMAGE_FLOAT : IMAGE_BYTE,
                           FAILURE),
            FAILURE);
}

void hard_forget(Hard *hard, const Mesh *mesh)
{
    for (int i = 0; i < 2; i++)
        lighting_forget(hard->lightings[i], mesh);
}

void hard_exact(const Hard *hard, const Scene *scene, bool solids, Reference *exact)
{
    const ReferenceOptions options = {
        .width = hard->bytes.width, .height = hard->bytes.height, .meshes = !solids};
    require(scene_check(scene, FAILURE), FAILURE);
    require(reference_open(exact, scene, &options, FAILURE), FAILURE);
}

static void render(const Canvas *canvas, Lighting *lighting, const Scene *scene, Image *image)
{
    canvas_clear(canvas, scene->background, 1);
    require(lighting_draw(lighting, scene, (double)canvas->width / canvas->height, false, FAILURE),
            FAILURE);
    require(canvas_read(canvas, image, FAILURE), FAILURE);
}

/* The value of channel `c`, counted over all pixels, from 0 to 1. */
static double value_of(const Image *image, size_t c)
{
    return image->type == IMAGE_FLOAT ? (double)((const float *)image->pixels)[c]
                                      : ((const unsigned char *)image->pixels)[c] / 255.0;
}

HardResult hard_draw(Hard *hard, const Scene *scene, HardPrecision precision,
                     const Reference *exact)
{
    HardResult result = {.interior_pixels = 0};
    Reference own = {.width = 0};
    const size_t count = (size_t)hard->image.width * (size_t)hard->image.height;
    require(scene_check(scene, FAILURE), FAILURE);
    const Reference *right = exact ? exact : &own;
    if (!exact)
        hard_exact(hard, scene, false, &own);
    render(&hard->bytes, hard->lightings[precision], scene, &hard->image);
    render(&hard->floats, hard->lightings[precision], scene, &hard->real);
    for (size_t i = 0; i < 4 * count; i++)
        result.not_finite += !isfinite(value_of(&hard->real, i));
    ErrorSum bytes = {0}, floats = {0};
    for (size_t i = 0; i < count; i++) {
        if (!right->interior[i]) /* only the insides of objects are compared */
            continue;
        error_sum_add(&bytes, pixel_error(&hard->image, i, &right->color[3 * i]), i);
        error_sum_add(&floats, pixel_error(&hard->real, i, &right->color[3 * i]), i);
    }
    result.interior_pixels = (int)bytes.pixels;
    result.byte_error = bytes.maximum;
    result.float_error = floats.maximum;
    result.x = (int)(bytes.worst % (size_t)hard->image.width);
    result.y = (int)(bytes.worst / (size_t)hard->image.width);
    reference_close(&own);
    return result;
}

void hard_check_exact(Hard *hard, const char *name, const Scene *scene, HardPrecision precision,
                      double max, int min_pixels, const Reference *exact)
{
    const HardResult result = hard_draw(hard, scene, precision, exact);
    hard->worst[precision] = fmax(hard->worst[precision], result.byte_error);
    hard->max[precision] = fmax(hard->max[precision], max);
    hard->checked++;
    if (result.not_finite == 0 && result.byte_error <= max && result.interior_pixels >= min_pixels)
        return;
    picture_check_keep_exact(name, &hard->image, exact);
    fail_msg("%s, %s, lit at %s: largest error %.3f of %.3f at (%d, %d), %d pixels inside, %lld "
             "values not finite",
             name, precision == HARD_HIGHP ? "highp" : "mediump",
             scene->interpolation == INTERPOLATION_PHONG ? "fragments" : "vertices",
             result.byte_error, max, result.x, result.y, result.interior_pixels, result.not_finite);
}

void hard_check(Hard *hard, const char *name, const Scene *scene, HardPrecision precision,
                double max, int min_pixels)
{
    Reference exact;
    hard_exact(hard, scene, false, &exact);
    for (int i = 0; hard->skip_diagonal && i < exact.height; i++)
        exact.interior[(exact.height - 1 - i) * exact.width + i] = 0;
    hard_check_exact(hard, name, scene, precision, max, min_pixels, &exact);
    reference_close(&exact);
}

void hard_report(Hard *hard, const char *name)
{
    print_message("%s: %d pictures, largest error %.2f of %.2f in highp, %.2f of %.2f in mediump\n",
                  name, hard->checked, hard->worst[HARD_HIGHP], hard->max[HARD_HIGHP],
                  hard->worst[HARD_MEDIUMP], hard->max[HARD_MEDIUMP]);
    for (int i = 0; i < 2; i++)
        hard->worst[i] = hard->max[i] = 0;
    hard->checked = 0;
}

void hard_world(HardWorld *world, const Mesh *mesh)
{
    memset(world, 0, sizeof *world);
    world->lights[0] = (Light){.kind = LIGHT_POINT,
                               .position = {1.5, 2, 3.5},
                               .ambient = {0.1, 0.1, 0.1},
                               .diffuse = {1, 0.9, 0.8},
                               .specular = {1, 1, 1}};
    world->objects[0] =
        (Object){.mesh = mesh,
                 .world_from_object = mat4_identity(),
                 .front = {{0.5, 0.5, 0.5}, {0.5, 0.4, 0.3}, {0.4, 0.4, 0.3}, {0, 0, 0}, 1, 8},
                 .back = {{0.5, 0.5, 0.5}, {0.2, 0.4, 0.5}, {0.3, 0.4, 0.4}, {0, 0, 0}, 1, 4}};
    world->scene = (Scene){.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40, 0.5, 20, 0},
                           .background = {0.2, 0.3, 0.4},
                           .global_ambient = {0.1, 0.1, 0.1},
                           .lights = world->lights,
                           .light_count = 1,
                           .objects = world->objects,
                           .object_count = 1};
}

void hard_world_scale(HardWorld *world, double factor)
{
    Camera *camera = &world->scene.camera;
    camera->eye = vec3_scale(camera->eye, factor);
    camera->center = vec3_scale(camera->center, factor);
    camera->near *= factor;
    camera->far *= factor;
    for (int i = 0; i < world->scene.light_count; i++) {
        Light *light = &world->lights[i];
        light->position = vec3_scale(light->position, factor);
        light->linear /= factor;
        light->quadratic /= factor * factor;
    }
}

void hard_world_settle(HardWorld *world)
{
    world->scene.lights = world->lights;
    world->scene.objects = world->objects;
}

enum { SHININESS = 8 };
static const double DIFFUSE = 0.5, SPECULAR = 0.3; /* of the point light */

void hard_two_lights(HardWorld *world, const Mesh *mesh, Mat4 world_from_object)
{
    hard_world(world, mesh);
    world->lights[0] = (Light){.kind = LIGHT_POINT,
                               .position = {2, 3, 4},
                               .diffuse = {DIFFUSE, DIFFUSE, DIFFUSE},
                               .specular = {SPECULAR, SPECULAR, SPECULAR}};
    world->lights[1] =
        (Light){.kind = LIGHT_DIRECTIONAL, .direction = {-1, 1, 1}, .diffuse = {0.2, 0.1, 0}};
    world->objects[0] =
        (Object){.mesh = mesh,
                 .world_from_object = world_from_object,
                 .front = {{1, 0.8, 0.6}, {1, 0.9, 0.5}, {1, 1, 1}, {0, 0, 0}, 1, SHININESS},
                 .back = {{0.5, 1, 1}, {0.3, 0.6, 1}, {1, 0.5, 0.5}, {0, 0, 0}, 1, SHININESS}};
    world->scene.camera = (Camera){{0, 1, 4}, {0, 0, 0}, {0, 1, 0}, 35, 1, 20, 0};
    world->scene.background = (Vec3){0.2, 0.4, 0.6};
    world->scene.global_ambient = (Vec3){0.2, 0.2, 0.2};
    world->scene.light_count = 2;
}

/*
 * highp: half a step of rounding, and floats.
 *
 * mediump: half precision, u = 2^-11. Lit at the fragments, each worst error in units of u:
 *   N: the varying 1; its length 3 (sum of squares), halved by the root, and 1 there; the product
 *      1: 4.5;
 *   L: both positions rounded, 1 each of at most 6 where the light is at least 4 away: 3, and 1 of
 *      the difference; normalized 3.5: 7.5; V likewise 1 + 3.5 = 4.5;
 *   N.L: 4.5 + 7.5, and the sum 3: 15;
 *   H: (7.5 + 4.5) / |L + V|, which is at least 1.4 within 90 degrees, 1 of that sum,
 *      normalized 3.5: 13.1; N.H: 4.5 + 13.1 + 3 = 20.6;
 *   (N.H)^s: s times that, and 4 of logarithm, product and power;
 *   the directional light, 0.2: 4.5 + 1 + 3 for N.L, less than 2 in colour; its highlight is none;
 *   four sums of colours below 1: 4.
 * By colour, plus half a step. Lit at the vertices in highp: the varying and a copy, 2 u, and half
 * a step.
 */
double hard_two_lights_max(const Scene *scene, HardPrecision precision)
{
    const double u = 0x1p-11;
    if (precision == HARD_HIGHP)
        return 1;
    if (scene->interpolation != INTERPOLATION_PHONG)
        return 255 * 2 * u + 0.5;
    return 255 * u * (15 * DIFFUSE + (20.6 * SHININESS + 4) * SPECULAR + 2 + 4) + 0.5;
}

/* With 11 significant bits every result is off by u = 2^-11 of itself at most. To first order, with
 * all vectors but the light's about unit length, and errors as lengths of vectors:
 *   normalizing a vector   3.5 u: its square 3 u, halved by the root; the root, the product, u each
 *   normal, viewer         4.5 u: rounded as a varying, then normalized
 *   direction to a light   (reach + 3.5) u: light, point and difference rounded, over d; normalized
 *   a dot product          the errors of both, and 3 u
 *   half vector            the errors of light and viewer, over |L + V|, at least 1.58 where they
 *                          lie at most 75 degrees apart; 4.5 u for the sum and its length
 *   reflection             2 (N.L) N - L: twice those of N.L and N, that of L, and 3 u
 * The power s of a cosine that is 1 + e is off by exp(s e) - 1 at most. The power function itself,
 * exp2(s log2(x)), adds less than 2 u. Products with colours, shares and sums: 4 u for each light.
 * Where N.L turns negative the highlight stops: a pixel for which the signs differ is off by all of
 * it, sin(37.5 degrees)^s for Blinn and 0^s for Phong. Rounding to bytes makes 0.5. */
double hard_mediump_max(const Scene *scene, double reach)
{
    static const double U = 0x1p-11;
    const bool phong = scene->reflection == REFLECTION_PHONG;
    const double normal = 4.5 * U, viewer = 4.5 * U, light = (reach + 3.5) * U;
    const double cosine = normal + light + 3 * U;
    const double half = (light + viewer) / 1.58 + 4.5 * U;
    const double reflected = 2 * (cosine + normal) + light + 3 * U;
    const double angle = (phong ? reflected + viewer : half + normal) + 3 * U;
    double max = 0;
    for (int i = 0; i < 2 * scene->object_count; i++) {
        const Object *object = &scene->objects[i / 2];
        const Material *material = i % 2 ? &object->back : &object->front;
        double sum = 0;
        for (int k = 0; k < scene->light_count; k++) {
            const Light *from = &scene->lights[k];
            const double diffuse = fmax(
                from->diffuse.x * material->diffuse.x,
                fmax(from->diffuse.y * material->diffuse.y, from->diffuse.z * material->diffuse.z));
            const double specular = fmax(from->specular.x * material->specular.x,
                                         fmax(from->specular.y * material->specular.y,
                                              from->specular.z * material->specular.z));
            const double stops = pow(phong ? 0 : sin(37.5 * acos(-1) / 180), material->shininess);
            if (!from->off)
                sum += diffuse * cosine + 4 * U +
                       specular * fmax(expm1(material->shininess * angle) + 2 * U, stops);
        }
        max = fmax(max, sum);
    }
    return fmin(0.5 + 255 * (max + U), 255);
}

void hard_check_ways(Hard *hard, const char *name, const Scene *scene, double reach, int min_pixels)
{
    static const double COLORS_ONLY = 1.5;
    Scene way = *scene;
    way.interpolation = INTERPOLATION_PHONG;
    hard_check(hard, name, &way, HARD_HIGHP, 1, min_pixels);
    hard_check(hard, name, &way, HARD_MEDIUMP, hard_mediump_max(scene, reach), min_pixels);
    way.interpolation = INTERPOLATION_GOURAUD;
    hard_check(hard, name, &way, HARD_HIGHP, 1, min_pixels);
    hard_check(hard, name, &way, HARD_MEDIUMP, COLORS_ONLY, min_pixels);
}

void hard_check_reflections(Hard *hard, const char *name, HardWorld *world, double reach,
                            int min_pixels)
{
    for (int reflection = 0; reflection < 2; reflection++) {
        world->scene.reflection = (Reflection)reflection;
        hard_check_ways(hard, name, &world->scene, reach, min_pixels);
    }
}

HardResult hard_draw_finite(Hard *hard, const Scene *scene, HardPrecision precision)
{
    const HardResult result = hard_draw(hard, scene, precision, NULL);
    assert_int_equal(result.not_finite, 0);
    return result;
}

void hard_check_refused(const Scene *scene, const char *beginning)
{
    Message message = {0};
    assert_false(scene_check(scene, &message));
    if (strncmp(message.text, beginning, strlen(beginning)) != 0 || strchr(message.text, '\n'))
        fail_msg("\"%s\" instead of one line \"%s...\"", message.text, beginning);
}

Vec3 hard_random_direction(Random *random)
{
    const double z = random_between(random, -1, 1), a = random_between(random, 0, 2 * acos(-1));
    const double r = sqrt(1 - z * z);
    return (Vec3){r * cos(a), r * sin(a), z};
}
