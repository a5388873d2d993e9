/*
 * Hard cases of normals: zero, very short and very long ones, normals that cancel between the
 * corners, point the wrong way, turn over at silhouettes, or are mirrored.
 */
#include "core/mesh_make.h"
#include "hard/hard.h"
#include "shapes/mesh_solids.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 48, SEED = 20140101 };

/* (|light| + |point| + d) / d on a unit sphere, or on a quad of that size, in hard_world. */
static const double REACH = 4;

static HardWorld world;
static Mesh made; /* of the current test, until forget */

FIXTURE(forget_made)
{
    hard_forget(&made);
    mesh_close(&made);
    if (hard.bytes.width != SIZE)
        hard_resize(SIZE, SIZE);
}

/* `made`, a copy, in the world. */
static void make_copy(const Mesh *mesh)
{
    forget_made(NULL);
    assert_true(mesh_open(&made, mesh->vertex_count, mesh->index_count, NULL));
    memcpy(made.vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    memcpy(made.indices, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    hard_world(&world, &made);
}

static void scale_normal(MeshVertex *vertex, float factor)
{
    for (int axis = 0; axis < 3; axis++)
        vertex->normal[axis] *= factor;
}

static void scale_normals(float factor)
{
    for (size_t i = 0; i < made.vertex_count; i++)
        scale_normal(&made.vertices[i], factor);
}

static void check(const char *name, int min_pixels)
{
    hard_check_reflections(name, &world, REACH, min_pixels);
}

TEST_WITH(0, a_zero_normal_gives_exactly_ambient_light, NULL, forget_made)
{
    make_copy(&hard.sphere);
    scale_normals(0);
    world.lights[0].ambient = (Vec3){0.25, 0.5, 0};
    world.scene.global_ambient = (Vec3){0, 0, 0};
    world.objects[0].front.ambient = (Vec3){1, 1, 1};
    world.objects[0].front.emission = (Vec3){0, 0, 0.75};
    check("zero normals", SIZE * SIZE / 4);
    for (HardPrecision precision = HARD_HIGHP; precision <= HARD_MEDIUMP; precision++)
        for (int way = 0; way < 3; way++) {
            world.scene.interpolation = way == 1 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            world.objects[0].world_from_object =
                mat4_scale(way == 2 ? (Vec3){1, 0.5, 2} : (Vec3){1, 1, 1});
            hard_draw_finite(&world.scene, precision);
            const unsigned char *middle =
                (unsigned char *)hard.image.pixels + 4 * (SIZE / 2 * SIZE + SIZE / 2);
            assert_int_equal(middle[0], 64);  /* 63.75 */
            assert_int_equal(middle[1], 128); /* 127.5 is rounded to even */
            assert_int_equal(middle[2], 191); /* 191.25 */
        }
    hard_report("normals of no length");
}

TEST_WITH(0, the_length_of_normals_does_not_matter, NULL, forget_made)
{
    for (int exponent = -20; exponent <= 20; exponent += 4) {
        make_copy(&hard.sphere);
        scale_normals(powf(10, (float)exponent));
        check("normals' lengths", SIZE * SIZE / 8);
        world.objects[0].world_from_object = mat4_scale((Vec3){1, 0.6, 0.8});
        check("normals' lengths, scaled", SIZE * SIZE / 8);
    }
    hard_report("normals of lengths 1e-20 to 1e20");
}

/* Another length at each vertex must not change the interpolated direction. */
TEST_WITH(0, different_lengths_at_the_vertices_do_not_matter, NULL, forget_made)
{
    Random random = {SEED};
    printf("seed %d\n", SEED);
    make_copy(&hard.sphere);
    for (size_t i = 0; i < made.vertex_count; i++)
        scale_normal(&made.vertices[i], (float)pow(10, random_between(&random, -3, 3)));
    check("lengths that differ", SIZE * SIZE / 8);
    hard_report("normals of differing lengths");
}

/* A sphere flattened in its mesh and restored by its transform. */
TEST_WITH(0, a_transform_may_stretch_by_any_factor, NULL, forget_made)
{
    for (int exponent = -14; exponent <= 14; exponent += 4) {
        const double factor = pow(10, exponent);
        make_copy(&hard.sphere);
        for (size_t i = 0; i < made.vertex_count; i++) {
            MeshVertex *vertex = &made.vertices[i];
            const float *n = vertex->normal;
            Vec3 normal;
            vec3_normalize((Vec3){(double)n[0] * factor, (double)n[1], (double)n[2]}, &normal);
            vec3_to_float(normal, vertex->normal);
            vertex->position[0] = (float)((double)vertex->position[0] / factor);
        }
        world.objects[0].world_from_object = mat4_scale((Vec3){factor, 1, 1});
        check(formatted("transform that stretches by 1e%d", exponent), SIZE * SIZE / 8);
    }
    hard_report("transforms that stretch by 1e-14 to 1e14");
}

/* Opposite normals at the left and right of a quad: in the middle they cancel. */
TEST_WITH(0, normals_that_cancel_stay_finite_at_every_width, NULL, forget_made)
{
    make_copy(&hard.quad);
    for (size_t i = 0; i < made.vertex_count; i++)
        scale_normal(&made.vertices[i], made.vertices[i].position[0] > 0 ? -1 : 1);
    for (int width = 1; width <= 128; width += testing_step(9)) {
        hard_resize(width, 8);
        check("normals that cancel", width >= 32 ? width / 16 : 0);
    }
    hard_report("normals that cancel, widths 1 to 128");
}

/* Where three random normals nearly cancel, the direction changes from pixel to pixel by more than
 * the color of an interior pixel may. The other pixels are right. */
TEST_WITH(0, random_normals_stay_finite, NULL, forget_made)
{
    Random random = {SEED + 1};
    printf("seed %d\n", SEED + 1);
    for (int i = 0; i < 24; i++) {
        make_copy(&hard.quad);
        for (size_t v = 0; v < made.vertex_count; v++)
            vec3_to_float(hard_random_direction(&random), made.vertices[v].normal);
        world.objects[0].two_sided = i % 2;
        check("random normals", SIZE / 2);
    }
    hard_report("random normals");
}

TEST_WITH(0, normals_that_point_inwards_are_lit_as_given, NULL, forget_made)
{
    make_copy(&hard.sphere);
    scale_normals(-1);
    for (int way = 0; way < 4; way++) {
        world.objects[0].two_sided = way & 1;
        world.objects[0].closed = way & 2;
        check("inward normals", SIZE * SIZE / 8);
    }
    hard_report("inward normals");
}

/* Inside and outside of an open tube: at its silhouettes N.V changes sign within triangles, and
 * choosing the side by that sign would leave spots. */
TEST_WITH(0, sides_turn_over_with_the_triangle_not_with_the_normal, NULL, forget_made)
{
    CLOSED(mesh_close) Mesh tube;
    Random random = {SEED + 2};
    SUCCEEDS(mesh_cylinder(&tube, (MeshCylinder){0.8, 1.6, 24, 4, MESH_CAP_NONE}, message));
    printf("seed %d\n", SEED + 2);
    for (int i = 0; i < 12; i++) {
        hard_world(&world, i % 3 == 2 ? &hard.quad : &tube);
        world.objects[0].two_sided = true;
        /* The tube in any orientation; the quad within 70 degrees of facing the eye or facing
         * away. */
        if (i % 3 == 2)
            world.objects[0].world_from_object =
                mat4_rotate(180 * (i & 1) + random_between(&random, -70, 70), (Vec3){1, 1, 0});
        else
            world.objects[0].world_from_object =
                mat4_rotate(random_between(&random, 0, 360), hard_random_direction(&random));
        check("two sides", SIZE / 2);
    }
    hard_forget(&tube);
    hard_report("two sides");
}

HARD_TEST_MAIN("hard normals", SIZE)
