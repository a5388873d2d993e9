#include "reference/lit_world.h"

#include "support/testing.h"

/* Colors are floats of 0..1. */
static const double ROUNDED = 6e-8;

int set_up(void **state)
{
    (void)state;
    world_open();
    world.lights[0] = (Light){.direction = {0, 0, 1}, .diffuse = {1, 1, 1}};
    world.scene.light_count = 1;
    world.scene.background = (Vec3){0.1, 0.2, 0.3};
    return 0;
}

int tear_down(void **state)
{
    (void)state;
    world_close();
    return 0;
}

Object *add_object(Solid solid, int divisions)
{
    return world_add(solid, divisions, mat4_identity());
}

size_t pixel_at(const Reference *picture, int x, int y)
{
    return (size_t)y * (size_t)picture->width + (size_t)x;
}

size_t pixel_count(const Reference *picture)
{
    return (size_t)picture->width * (size_t)picture->height;
}

double channel(const Reference *picture, size_t pixel, size_t k)
{
    return (double)picture->color[3 * pixel + k];
}

void assert_color(const Reference *picture, size_t pixel, double red, double green, double blue)
{
    const double expected[3] = {red, green, blue};
    for (size_t k = 0; k < 3; k++)
        assert_true(fabs(channel(picture, pixel, k) - expected[k]) < ROUNDED);
}

double covered(const Reference *picture)
{
    double sum = 0;
    for (size_t i = 0; i < pixel_count(picture); i++)
        sum += picture->object[i] == 0 ? (double)picture->coverage[i]
                                       : 1 - (double)picture->coverage[i];
    return sum;
}

double pixels_at_one(int height)
{
    return height / (2 * tan(PI / 8));
}
