#include "hard.h"

#include "picture_check.h"
#include "reference_error.h"
#include "testing.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

void hard_open(Hard *hard, int width, int height)
{
    static const char *const precisions[] = {"highp", "mediump"};
    const CanvasOptions bytes = {.width = width, .height = height};
    const CanvasOptions floats = {.width = width, .height = height, .real = true};
    Message message = {0};
    memset(hard, 0, sizeof *hard);
    require(canvas_open(&hard->bytes, &bytes, &message), &message);
    require(canvas_open_beside(&hard->floats, &hard->bytes, &floats, &message), &message);
    require(image_open(&hard->image, width, height, IMAGE_BYTE, &message), &message);
    require(image_open(&hard->real, width, height, hard->floats.real ? IMAGE_FLOAT : IMAGE_BYTE,
                       &message),
            &message);
    for (int i = 0; i < 2; i++) {
        const ShaderLoader loader = {.precision = precisions[i]};
        require(lighting_open(&hard->lightings[i], &loader, &message), &message);
    }
}

void hard_close(Hard *hard)
{
    for (int i = 0; i < 2; i++)
        lighting_close(hard->lightings[i]);
    image_close(&hard->image);
    image_close(&hard->real);
    canvas_close(&hard->floats);
    canvas_close(&hard->bytes);
}

void hard_resize(Hard *hard, int width, int height)
{
    Message message = {0};
    image_close(&hard->image);
    image_close(&hard->real);
    require(canvas_resize(&hard->bytes, width, height, &message) &&
                canvas_resize(&hard->floats, width, height, &message) &&
                image_open(&hard->image, width, height, IMAGE_BYTE, &message) &&
                image_open(&hard->real, width, height, hard->floats.real ? IMAGE_FLOAT : IMAGE_BYTE,
                           &message),
            &message);
}

void hard_forget(Hard *hard, const Mesh *mesh)
{
    for (int i = 0; i < 2; i++)
        lighting_forget(hard->lightings[i], mesh);
}

void hard_exact(const Hard *hard, const Scene *scene, bool solids, Reference *exact)
{
    Message message = {0};
    const ReferenceOptions options = {
        .width = hard->bytes.width, .height = hard->bytes.height, .meshes = !solids};
    require(scene_check(scene, &message), &message);
    require(reference_open(exact, scene, &options, &message), &message);
}

static void draw(const Canvas *canvas, Lighting *lighting, const Scene *scene, Image *image)
{
    Message message = {0};
    canvas_clear(canvas, scene->background, 1);
    require(lighting_draw(lighting, scene, (double)canvas->width / canvas->height, false, &message),
            &message);
    require(canvas_read(canvas, image, &message), &message);
}

/* Of channel `c`, counted over all pixels' four, from 0 to 1. */
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
    Message message = {0};
    const size_t count = (size_t)hard->image.width * (size_t)hard->image.height;
    require(scene_check(scene, &message), &message);
    const Reference *right = exact ? exact : &own;
    if (!exact)
        hard_exact(hard, scene, false, &own);
    draw(&hard->bytes, hard->lightings[precision], scene, &hard->image);
    draw(&hard->floats, hard->lightings[precision], scene, &hard->real);
    for (size_t i = 0; i < 4 * count; i++)
        result.not_finite += !isfinite(value_of(&hard->real, i));
    ErrorSum bytes = {0}, floats = {0};
    for (size_t i = 0; i < count; i++) {
        if (!right->interior[i]) /* a test may have no other part of the picture */
            continue;
        error_sum_add(&bytes, reference_pixel_error(&hard->image, i, right, i), i);
        error_sum_add(&floats, reference_pixel_error(&hard->real, i, right, i), i);
    }
    result.interior_pixels = (int)bytes.pixels;
    result.byte_error = bytes.maximum;
    result.float_error = floats.maximum;
    result.x = (int)(bytes.worst % (size_t)hard->image.width);
    result.y = (int)(bytes.worst / (size_t)hard->image.width);
    reference_close(&own);
    return result;
}

static void keep(const Hard *hard, const char *name, const Reference *exact)
{
    Image expected;
    if (!image_open(&expected, exact->width, exact->height, IMAGE_BYTE, NULL))
        return;
    unsigned char *to = expected.pixels;
    for (size_t i = 0; i < (size_t)exact->width * (size_t)exact->height; i++) {
        for (size_t c = 0; c < 3; c++)
            to[4 * i + c] = (unsigned char)lrintf(255 * exact->color[3 * i + c]);
        to[4 * i + 3] = 255;
    }
    picture_check_keep(name, &hard->image, &expected);
    image_close(&expected);
}

void hard_check(Hard *hard, const char *name, const Scene *scene, HardPrecision precision,
                double most, int least_pixels)
{
    Reference exact;
    hard_exact(hard, scene, false, &exact);
    const HardResult result = hard_draw(hard, scene, precision, &exact);
    const bool right = result.not_finite == 0 && result.byte_error <= most &&
                       result.interior_pixels >= least_pixels;
    if (!right)
        keep(hard, name, &exact);
    reference_close(&exact);
    hard->worst[precision] = fmax(hard->worst[precision], result.byte_error);
    hard->most[precision] = fmax(hard->most[precision], most);
    hard->checked++;
    if (!right)
        fail_msg(
            "%s, %s: largest error %.3f of %.3f at (%d, %d), %d pixels inside, %lld values not "
            "finite",
            name, precision == HARD_HIGHP ? "highp" : "mediump", result.byte_error, most, result.x,
            result.y, result.interior_pixels, result.not_finite);
}

void hard_report(Hard *hard, const char *name)
{
    print_message("%s: %d pictures, largest error %.2f of %.2f in highp, %.2f of %.2f in mediump\n",
                  name, hard->checked, hard->worst[HARD_HIGHP], hard->most[HARD_HIGHP],
                  hard->worst[HARD_MEDIUMP], hard->most[HARD_MEDIUMP]);
    for (int i = 0; i < 2; i++)
        hard->worst[i] = hard->most[i] = 0;
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
    world->scene = (Scene){.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40, 0.5, 20},
                           .background = {0.2, 0.3, 0.4},
                           .global_ambient = {0.1, 0.1, 0.1},
                           .lights = world->lights,
                           .light_count = 1,
                           .objects = world->objects,
                           .object_count = 1};
}

/* With 11 significant bits every result is off by u = 2^-11 of itself at most. To first order, with
 * all vectors but those of the light about unit, and errors as lengths of vectors:
 *   a vector made unit     3.5 u: its square 3 u, halved by the root; the root, the product, u each
 *   normal, viewer         4.5 u: rounded as a varying, then made unit
 *   direction to a light   (reach + 3.5) u: light, point and difference rounded, over d; made unit
 *   a dot product          the errors of both, and 3 u
 *   half vector            the errors of light and viewer, over |L + V|, at least 1.58 where they
 *                          lie at most 75 degrees apart; 4.5 u for the sum and to make it unit
 *   reflection             2 (N.L) N - L: twice those of N.L and N, that of L, and 3 u
 * The power s of a cosine that is 1 + e is off by exp(s e) - 1 at most. The power function itself,
 * exp2(s log2(x)), adds less than 2 u. Products with colours, shares and sums: 4 u for each light.
 * Where N.L turns negative the highlight stops: a pixel for which the signs differ is off by all of
 * it, sin(37.5 degrees)^s for Blinn and 0^s for Phong. Rounding to bytes makes 0.5. */
double hard_mediump_most(const Scene *scene, double reach)
{
    static const double U = 0x1p-11;
    const bool phong = scene->reflection == REFLECTION_PHONG;
    const double normal = 4.5 * U, viewer = 4.5 * U, light = (reach + 3.5) * U;
    const double cosine = normal + light + 3 * U;
    const double half = (light + viewer) / 1.58 + 4.5 * U;
    const double reflected = 2 * (cosine + normal) + light + 3 * U;
    const double angle = (phong ? reflected + viewer : half + normal) + 3 * U;
    double most = 0;
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
        most = fmax(most, sum);
    }
    return fmin(0.5 + 255 * (most + U), 255);
}

void hard_check_ways(Hard *hard, const char *name, const Scene *scene, double reach,
                     int least_pixels)
{
    static const double COLORS_ONLY = 1.5;
    Scene way = *scene;
    way.interpolation = INTERPOLATION_PHONG;
    hard_check(hard, name, &way, HARD_HIGHP, 1, least_pixels);
    hard_check(hard, name, &way, HARD_MEDIUMP, hard_mediump_most(scene, reach), least_pixels);
    way.interpolation = INTERPOLATION_GOURAUD;
    hard_check(hard, name, &way, HARD_HIGHP, 1, least_pixels);
    hard_check(hard, name, &way, HARD_MEDIUMP, COLORS_ONLY, least_pixels);
}

void hard_check_reflections(Hard *hard, const char *name, HardWorld *world, double reach,
                            int least_pixels)
{
    for (int reflection = 0; reflection < 2; reflection++) {
        world->scene.reflection = (Reflection)reflection;
        hard_check_ways(hard, name, &world->scene, reach, least_pixels);
    }
}

static unsigned long long next(HardRandom *random)
{
    unsigned long long z = random->state += 0x9E3779B97F4A7C15ULL;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ z >> 27) * 0x94D049BB133111EBULL;
    return z ^ z >> 31;
}

double hard_random(HardRandom *random, double least, double most)
{
    return least + (most - least) * ((double)(next(random) >> 11) * 0x1p-53);
}

int hard_random_below(HardRandom *random, int limit)
{
    return (int)(next(random) % (unsigned long long)limit);
}

Vec3 hard_random_direction(HardRandom *random)
{
    const double z = hard_random(random, -1, 1), a = hard_random(random, 0, 2 * acos(-1));
    const double r = sqrt(1 - z * z);
    return (Vec3){r * cos(a), r * sin(a), z};
}
