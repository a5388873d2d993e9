#include "hard/hard.h"

#include "reference/picture_error.h"
#include "shapes/mesh_solids.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

Hard hard;

void hard_open(int width, int height)
{
    static const char *const precisions[] = {"highp", "mediump"};
    const CanvasOptions bytes = {.width = width, .height = height};
    const CanvasOptions floats = {.width = width, .height = height, .real = true};
    memset(&hard, 0, sizeof hard);
    SUCCEEDS(mesh_sphere(&hard.sphere, 1, 24, 12, message) && mesh_quad(&hard.quad, 2, message));
    SUCCEEDS(canvas_open(&hard.bytes, &bytes, message));
    SUCCEEDS(canvas_open_beside(&hard.floats, &hard.bytes, &floats, message));
    SUCCEEDS(image_open(&hard.image, width, height, IMAGE_BYTE, message));
    SUCCEEDS(image_open(&hard.real, width, height, hard.floats.real ? IMAGE_FLOAT : IMAGE_BYTE,
                        message));
    for (int i = 0; i < 2; i++) {
        const ShaderLoader loader = {.precision = precisions[i]};
        SUCCEEDS(lighting_open(&hard.lightings[i], &loader, message));
    }
}

void hard_close(void)
{
    for (int i = 0; i < 2; i++)
        lighting_close(hard.lightings[i]);
    image_close(&hard.image);
    image_close(&hard.real);
    mesh_close(&hard.sphere);
    mesh_close(&hard.quad);
    canvas_close(&hard.floats);
    canvas_close(&hard.bytes);
}

void hard_resize(int width, int height)
{
    image_close(&hard.image);
    image_close(&hard.real);
    SUCCEEDS(canvas_resize(&hard.bytes, width, height, message) &&
             canvas_resize(&hard.floats, width, height, message) &&
             image_open(&hard.image, width, height, IMAGE_BYTE, message) &&
             image_open(&hard.real, width, height, hard.floats.real ? IMAGE_FLOAT : IMAGE_BYTE,
                        message));
}

void hard_forget(const Mesh *mesh)
{
    for (int i = 0; i < 2; i++)
        lighting_forget(hard.lightings[i], mesh);
}

void hard_exact(const Scene *scene, Reference *exact)
{
    const ReferenceOptions options = {
        .width = hard.bytes.width, .height = hard.bytes.height, .meshes = true};
    SUCCEEDS(scene_check(scene, message));
    SUCCEEDS(reference_open(exact, scene, &options, message));
}

/* The value of channel `c`, counted over all pixels, from 0 to 1. */
static double value_of(const Image *image, size_t c)
{
    return image->type == IMAGE_FLOAT ? (double)((const float *)image->pixels)[c]
                                      : ((const unsigned char *)image->pixels)[c] / 255.0;
}

HardResult hard_draw(const Scene *scene, HardPrecision precision, const Reference *exact)
{
    HardResult result = {.interior_pixels = 0};
    Reference own = {.width = 0};
    const size_t count = (size_t)hard.image.width * (size_t)hard.image.height;
    SUCCEEDS(scene_check(scene, message));
    const Reference *right = exact ? exact : &own;
    if (!exact)
        hard_exact(scene, &own);
    const LightingFrame frame = {.scene = scene};
    picture_draw(&hard.bytes, hard.lightings[precision], &frame, &hard.image);
    picture_draw(&hard.floats, hard.lightings[precision], &frame, &hard.real);
    for (size_t i = 0; i < 4 * count; i++)
        result.not_finite += !isfinite(value_of(&hard.real, i));
    ErrorSum bytes = {0};
    for (size_t i = 0; i < count; i++) {
        if (!right->interior[i]) /* only the insides of objects are compared */
            continue;
        error_sum_add(&bytes, pixel_error(&hard.image, i, &right->color[3 * i]), i);
    }
    result.interior_pixels = (int)bytes.pixels;
    result.byte_error = bytes.maximum;
    result.x = (int)(bytes.worst % (size_t)hard.image.width);
    result.y = (int)(bytes.worst / (size_t)hard.image.width);
    reference_close(&own);
    return result;
}

void hard_check_exact(const char *name, const Scene *scene, HardBound bound, const Reference *exact)
{
    const HardPrecision precision = bound.precision;
    const HardResult result = hard_draw(scene, precision, exact);
    hard.worst[precision] = fmax(hard.worst[precision], result.byte_error);
    hard.max[precision] = fmax(hard.max[precision], bound.max);
    hard.checked++;
    if (result.not_finite == 0 && result.byte_error <= bound.max &&
        result.interior_pixels >= bound.min_pixels)
        return;
    picture_check_keep_exact(name, &hard.image, exact);
    fail_msg("%s, %s, lit at %s: largest error %.3f of %.3f at (%d, %d), %d pixels inside, %lld "
             "values not finite",
             name, precision == HARD_HIGHP ? "highp" : "mediump",
             scene->interpolation == INTERPOLATION_PHONG ? "fragments" : "vertices",
             result.byte_error, bound.max, result.x, result.y, result.interior_pixels,
             result.not_finite);
}

void hard_check(const char *name, const Scene *scene, HardPrecision precision, double max,
                int min_pixels)
{
    CLOSED(reference_close) Reference exact;
    hard_exact(scene, &exact);
    hard_check_exact(name, scene, (HardBound){precision, max, min_pixels}, &exact);
}

void hard_report(const char *name)
{
    print_message("%s: %d pictures, largest error %.2f of %.2f in highp, %.2f of %.2f in mediump\n",
                  name, hard.checked, hard.worst[HARD_HIGHP], hard.max[HARD_HIGHP],
                  hard.worst[HARD_MEDIUMP], hard.max[HARD_MEDIUMP]);
    for (int i = 0; i < 2; i++)
        hard.worst[i] = hard.max[i] = 0;
    hard.checked = 0;
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

static void check_ways(const char *name, const Scene *scene, double reach, int min_pixels)
{
    static const Interpolation ways[] = {INTERPOLATION_PHONG, INTERPOLATION_GOURAUD};
    static const double COLORS_ONLY = 1.5;
    Scene way = *scene;
    for (int i = 0; i < 2; i++) {
        CLOSED(reference_close) Reference exact;
        way.interpolation = ways[i];
        const double max = i ? COLORS_ONLY : oracle_mediump_max(scene, reach);
        hard_exact(&way, &exact);
        hard_check_exact(name, &way, (HardBound){HARD_HIGHP, 1, min_pixels}, &exact);
        hard_check_exact(name, &way, (HardBound){HARD_MEDIUMP, max, min_pixels}, &exact);
    }
}

void hard_check_reflections(const char *name, HardWorld *world, double reach, int min_pixels)
{
    for (int reflection = 0; reflection < 2; reflection++) {
        world->scene.reflection = (Reflection)reflection;
        check_ways(name, &world->scene, reach, min_pixels);
    }
}

void hard_draw_finite(const Scene *scene, HardPrecision precision)
{
    static unsigned char none[256 * 256]; /* of the pixels is inside */
    const Reference nothing = {.interior = none};
    assert_int_equal(hard_draw(scene, precision, &nothing).not_finite, 0);
}

Vec3 hard_random_direction(Random *random)
{
    const double z = random_between(random, -1, 1), a = random_between(random, 0, 2 * acos(-1));
    const double r = sqrt(1 - z * z);
    return (Vec3){r * cos(a), r * sin(a), z};
}
