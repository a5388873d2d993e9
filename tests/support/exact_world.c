/* Pictures are kept in a list until the world closes, so that tests need not close each. */
#include "support/exact_world.h"

#include "reference/reference_trace.h"
#include "support/testing.h"

World world;

enum { MAX_DRAWN = 64 };
static Reference drawn[MAX_DRAWN];
static int drawn_count;

void world_close_meshes(void)
{
    for (int i = 0; i < WORLD_MAX; i++)
        mesh_close(&world.meshes[i]);
}

void world_open(void)
{
    world_close_meshes();
    world = (World){.scene = {.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 45, 0.1, 100, 0},
                              .lights = world.lights,
                              .objects = world.objects}};
}

void world_forget(void)
{
    while (drawn_count > 0)
        reference_close(&drawn[--drawn_count]);
}

void world_close(void)
{
    world_close_meshes();
    world_forget();
    world = (World){0};
}

Object *world_add(Solid solid, int divisions, Mat4 world_from_object)
{
    const int i = world.scene.object_count++;
    assert_in_range(i, 0, WORLD_MAX - 1);
    SUCCEEDS(solid_mesh(&solid, divisions, &world.meshes[i], message));
    world.objects[i] =
        (Object){.mesh = &world.meshes[i],
                 .solid = solid,
                 .flat = solid_flat(&solid),
                 .world_from_object = world_from_object,
                 .front = {.ambient = {0.1, 0.1, 0.1}, .diffuse = {0.8, 0.5, 0.2}, .alpha = 1}};
    return &world.objects[i];
}

Reference world_trace(ReferenceOptions options)
{
    Reference picture;
    if (options.width == 0)
        options.width = options.height = WORLD_SIZE;
    SUCCEEDS(scene_check(&world.scene, message));
    SUCCEEDS(reference_open(&picture, &world.scene, &options, message));
    assert_in_range(drawn_count, 0, MAX_DRAWN - 1);
    drawn[drawn_count++] = picture;
    for (int i = 0; i < 3 * options.width * options.height; i++)
        assert_true(isfinite(picture.color[i]));
    return picture;
}

double world_difference(const Reference *a, const Reference *b)
{
    double max = 0;
    for (int i = 0; i < 3 * a->width * a->height; i++)
        max = fmax(max, 255 * fabs((double)a->color[i] - (double)b->color[i]));
    return max;
}

bool world_same(const Reference *a, const Reference *b)
{
    const size_t count = (size_t)a->width * (size_t)a->height;
    return memcmp(a->color, b->color, 3 * count * sizeof *a->color) == 0 &&
           memcmp(a->object, b->object, count * sizeof *a->object) == 0 &&
           memcmp(a->coverage, b->coverage, count * sizeof *a->coverage) == 0 &&
           memcmp(a->interior, b->interior, count) == 0;
}

void world_assert_means(const Reference *picture, int grid,
                        bool (*mixed)(const Reference *picture, int pixel), int least)
{
    const ReferenceOptions options = {.width = WORLD_SIZE, .height = WORLD_SIZE, .threads = 1};
    Trace *rays;
    double worst = 0;
    int count = 0;
    SUCCEEDS(trace_open(&rays, &world.scene, &options, message));
    for (int i = 0; i < WORLD_PIXELS; i++) {
        double sums[3] = {0, 0, 0};
        if (!mixed(picture, i))
            continue;
        for (int k = 0; k < grid * grid; k++) {
            Sample sample;
            trace_sample(rays, i % WORLD_SIZE + (k % grid + 0.5) / grid,
                         i / WORLD_SIZE + (k / grid + 0.5) / grid, &sample);
            for (int c = 0; c < 3; c++)
                sums[c] += (double)sample.color[c];
        }
        count++;
        for (int c = 0; c < 3; c++)
            worst = fmax(worst,
                         255 * fabs(sums[c] / (grid * grid) - (double)picture->color[3 * i + c]));
    }
    trace_close(rays);
    printf("%d pixels: %.3f steps from their means at most\n", count, worst);
    assert_true(count > least);
    /* Half a step asked for; half a row of so many samples may be on the wrong side. */
    assert_true(worst < 0.5 + 0.5 * 255 / grid);
}
