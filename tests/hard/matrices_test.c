/*
 * Hard cases of model matrices: singular ones, scales of any size. First the functions' results,
 * then the pictures, in both precisions, lit at vertices and at fragments. LIGHTING_TEST_SEED in
 * the environment replaces the seed.
 */
#include "core/mesh_make.h"
#include "hard/hard.h"
#include "shapes/mesh_solids.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 64, SLICES = 48 };

static unsigned long long seed;
static Mesh sphere, cube, quad, sideways;

/* Matrices. */

static Mat4 scale(double x, double y, double z)
{
    return mat4_scale((Vec3){x, y, z});
}

static Mat4 turn(double degrees, Vec3 axis)
{
    Mat4 rotation;
    assert_true(mat4_try_rotate(degrees, axis, &rotation));
    return rotation;
}

static Mat4 random_rotation(Random *random)
{
    const Vec3 axis = hard_random_direction(random);
    return turn(random_between(random, -180, 180), axis);
}

static const Vec3 BACKGROUND = {0.2, 0.4, 0.6};

/* One object, a point light and a directional light; every color stays below 1. */
static void make_world(HardWorld *world, const Mesh *mesh, Mat4 world_from_object)
{
    hard_world(world, mesh);
    world->lights[0] = (Light){.kind = LIGHT_POINT,
                               .position = {2, 3, 4},
                               .diffuse = {0.5, 0.5, 0.5},
                               .specular = {0.3, 0.3, 0.3}};
    world->lights[1] =
        (Light){.kind = LIGHT_DIRECTIONAL, .direction = {-1, 1, 1}, .diffuse = {0.2, 0.1, 0}};
    world->objects[0] =
        (Object){.mesh = mesh,
                 .closed = mesh != &quad && mesh != &sideways,
                 .flat = mesh == &cube || mesh == &quad,
                 .world_from_object = world_from_object,
                 .front = {{1, 0.8, 0.6}, {1, 0.9, 0.5}, {1, 1, 1}, {0, 0, 0}, 1, 8},
                 .back = {{0.5, 1, 1}, {0.3, 0.6, 1}, {1, 0.5, 0.5}, {0, 0, 0}, 1, 8}};
    world->scene.camera = (Camera){{0, 1, 4}, {0, 0, 0}, {0, 1, 0}, 35, 1, 20, 0};
    world->scene.background = BACKGROUND;
    world->scene.global_ambient = (Vec3){0.2, 0.2, 0.2};
    world->scene.light_count = 2;
}

/* The picture is exact. In highp within half a step of rounding, and floats. In mediump lit at the
 * vertices in highp: the varying is rounded when written and when read. Eye and light are at most
 * 4.7 apart, no point is farther than 6 from the eye or nearer than 4.1 to the light. */
static void check_exact(const char *name, HardWorld *world, HardPrecision precision,
                        const Reference *exact)
{
    static const double REACH = 3.6;
    const double max = precision == HARD_HIGHP ? 1
                       : world->scene.interpolation == INTERPOLATION_PHONG
                           ? oracle_mediump_max(&world->scene, REACH)
                           : 255 * 2 * ORACLE_MEDIUMP_UNIT + 0.5;
    hard_check_exact(name, &world->scene, (HardBound){precision, max, 100}, exact);
}

/* And the same when drawn again. */
static void check_steady(const char *name, HardWorld *world, HardPrecision precision,
                         const Reference *exact)
{
    static unsigned char bytes[4 * SIZE * SIZE];
    static float reals[4 * SIZE * SIZE];
    const bool real = hard.real.type == IMAGE_FLOAT;
    check_exact(name, world, precision, exact);
    memcpy(bytes, hard.image.pixels, sizeof bytes);
    if (real)
        memcpy(reals, hard.real.pixels, sizeof reals);
    check_exact(name, world, precision, exact);
    assert_memory_equal(bytes, hard.image.pixels, sizeof bytes);
    assert_true(!real || memcmp(reals, hard.real.pixels, sizeof reals) == 0);
}

/* Lit at the fragments and at the vertices, in either precision; `exact` is the picture of the
 * world as given. */
typedef void Check(const char *name, HardWorld *world, HardPrecision precision,
                   const Reference *exact);
static void each_way(const char *name, HardWorld *world, Check *check)
{
    static const Interpolation ways[] = {INTERPOLATION_PHONG, INTERPOLATION_GOURAUD};
    for (int way = 0; way < 2; way++) {
        CLOSED(reference_close) Reference exact;
        world->scene.interpolation = ways[way];
        hard_exact(&world->scene, &exact);
        check(name, world, HARD_HIGHP, &exact);
        check(name, world, HARD_MEDIUMP, &exact);
    }
}

/* Singular model matrix. */

/* Rounding gives the determinant of a singular product a random sign; the picture of a flattened
 * model must not depend on it. */
TEST(singular_model_does_not_take_its_sign_from_rounding)
{
    Random random = {seed};
    for (int i = 0; i < 2000; i++) {
        const double part = pow(10, random_between(&random, -3, 0));
        const Mat4 first = random_rotation(&random), last = random_rotation(&random);
        const Mat4 flat = mat4_product(scale(1, i % 2 ? part : -part, 0), last);
        const Mat4 a = mat4_product(random_rotation(&random), mat4_product(first, flat));
        Mat4 normal;
        assert_true(mat4_determinant(a) == 0);
        assert_true(mat4_try_normal(a, &normal));
        /* A model with any thickness, however small relative to its size, has a sign. */
        const Mat4 thick = mat4_product(scale(1, part, -1e-9), last);
        assert_true(mat4_determinant(mat4_product(first, thick)) < 0);
    }
}

/* The triangles of one side of a flattened solid, counter-clockwise or clockwise as seen from the
 * eye: two layers at the same place, either of which may be drawn. */
static Mesh side_of(const HardWorld *world, bool front)
{
    const Mesh *all = world->objects[0].mesh;
    Mesh side;
    SUCCEEDS(mesh_open(&side, all->vertex_count, all->index_count, message));
    memcpy(side.vertices, all->vertices, all->vertex_count * sizeof *all->vertices);
    side.index_count = 0;
    for (size_t t = 0; t < all->index_count; t += 3) {
        Vec3 corner[3];
        for (size_t k = 0; k < 3; k++) {
            const float *p = all->vertices[all->indices[t + k]].position;
            corner[k] = mat4_transform_point(world->objects[0].world_from_object,
                                             (Vec3){(double)p[0], (double)p[1], (double)p[2]});
            corner[k] = vec3_subtract(corner[k], world->scene.camera.eye);
        }
        const double towards = vec3_dot(vec3_cross(corner[0], corner[1]), corner[2]);
        if (front ? towards < 0 : towards > 0)
            for (size_t k = 0; k < 3; k++)
                side.indices[side.index_count++] = all->indices[t + k];
    }
    return side;
}

static const struct {
    const char *name;
    Vec3 factors, eye;
} FLAT[] = {{"scale(1,1,0)", {1, 1, 0}, {0.5, 1, 4}},
            {"scale(1,0,1)", {1, 0, 1}, {0.3, 4, 1}},
            {"scale(0,1,1)", {0, 1, 1}, {4, 1, 0.3}}};

static void make_flat(HardWorld *world, const Mesh *mesh, int i)
{
    const Mat4 tilt = turn(35, (Vec3){0.3, 1, 0.2});
    make_world(world, mesh, mat4_product(mat4_scale(FLAT[i].factors), tilt));
    world->scene.camera.eye = FLAT[i].eye;
}

DRAWN_TEST(singular_model_is_drawn_flat)
{
    static const Mesh *const meshes[] = {&sphere, &cube, &quad};
    static const char *const names[] = {"sphere", "cube", "square"};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            HardWorld world, shown;
            Mesh front;
            const char *name = formatted("%s of a %s", FLAT[i].name, names[k]);
            make_flat(&world, meshes[k], i);
            if (!world.objects[0].closed) {
                each_way(name, &world, check_steady);
                continue;
            }
            /* A solid shows the side towards the eye. */
            front = side_of(&world, true);
            shown = world;
            shown.objects[0].mesh = &front;
            shown.scene.lights = shown.lights;
            shown.scene.objects = shown.objects;
            for (int way = 0; way < 2; way++) {
                CLOSED(reference_close) Reference exact;
                shown.scene.interpolation = way ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
                world.scene.interpolation = shown.scene.interpolation;
                hard_exact(&shown.scene, &exact);
                check_steady(name, &world, HARD_HIGHP, &exact);
                check_steady(name, &world, HARD_MEDIUMP, &exact);
            }
            mesh_close(&front);
        }
}

/* Rank 1 or 0. */

/* Whether a pixel of the last pictures has exactly this color. */
static bool pixel_is(int pixel, Vec3 color)
{
    const unsigned char *byte = (const unsigned char *)hard.image.pixels + 4 * pixel;
    return byte[0] == lrint(255 * color.x) && byte[1] == lrint(255 * color.y) &&
           byte[2] == lrint(255 * color.z);
}

/* The object's color with ambient light alone. */
static const Vec3 AMBIENT = {0.2, 0.16, 0.12};

static int count_ambient(const char *name, HardWorld *world, HardPrecision precision,
                         const Reference *exact)
{
    int count = 0;
    const HardResult result = hard_draw(&world->scene, precision, exact);
    if (result.not_finite)
        fail_msg("%s: %lld values not finite", name, result.not_finite);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const bool ambient = pixel_is(i, AMBIENT);
        count += ambient;
        if (!ambient && !pixel_is(i, BACKGROUND))
            fail_msg("%s: pixel %d, %d is neither ambient nor background", name, i % SIZE,
                     i / SIZE);
    }
    return count;
}

static void check_some_ambient(const char *name, HardWorld *world, HardPrecision precision,
                               const Reference *exact)
{
    check_exact(name, world, precision, exact);
    if (count_ambient(name, world, precision, exact) < 100)
        fail_msg("%s: not drawn", name);
}

/* A line or a point: rounding may make it one pixel wide. */
static void check_ambient_line(const char *name, HardWorld *world, HardPrecision precision,
                               const Reference *exact)
{
    if (count_ambient(name, world, precision, exact) > 2 * SIZE)
        fail_msg("%s: wider than a line", name);
}

DRAWN_TEST(rank_1_or_0_is_ambient)
{
    const Mat4 lost[] = {scale(1, 0, 0), scale(0, 1, 0), scale(0, 0, 1), scale(0, 0, 0)};
    HardWorld world;
    for (int i = 0; i < 4; i++) {
        make_world(&world, i % 2 ? &sphere : &cube,
                   mat4_product(turn(i * 20, (Vec3){0.3, 1, 0.2}), lost[i]));
        each_way("rank 1 or 0", &world, check_ambient_line);
        world.objects[0].two_sided = true;
        world.objects[0].closed = false;
        world.objects[0].back = world.objects[0].front;
        each_way("rank 1 or 0, two-sided", &world, check_ambient_line);
    }
    /* A flattened square that keeps its area, with normals in its plane: all become zero. */
    make_world(&world, &sideways, scale(1, 1, 0));
    each_way("normals that a flat model loses", &world, check_some_ambient);
    /* With the wrong matrix for normals, those of the plane itself become zero too. */
    make_world(&world, &quad, scale(1, 1, 0));
    world.objects[0].wrong_normals = true;
    each_way("normals that the wrong matrix loses", &world, check_some_ambient);
}

/* Tiny or huge scale. */

/* Changes the unit of length: positions of lights and camera, attenuation, near and far plane; not
 * the objects. */
static void scale_world(HardWorld *world, double factor)
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

static void make_scaled(HardWorld *world, double s)
{
    make_world(world, &sphere, mat4_product(turn(35, (Vec3){0.3, 1, 0.2}), scale(0.9, -0.7, 1.1)));
    world->lights[0].constant = 0.5;
    world->lights[0].linear = 0.05;
    world->lights[0].quadratic = 0.01;
    scale_world(world, s);
    world->objects[0].world_from_object =
        mat4_product(scale(s, s, s), world->objects[0].world_from_object);
}

static const double UNITS[] = {1e-14, 1e-12, 1e-9, 1e-4, 1e4, 1e9, 1e12, 1e14};

DRAWN_TEST(tiny_or_huge_scale_draws_the_same_picture)
{
    HardWorld world;
    for (int way = 0; way < 2; way++) {
        CLOSED(reference_close) Reference exact;
        make_scaled(&world, 1);
        world.scene.interpolation = way ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
        hard_exact(&world.scene, &exact);
        for (int i = 0; i < 8; i++) {
            make_scaled(&world, UNITS[i]);
            world.scene.interpolation = way ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            const char *name =
                formatted("units of %g, lit at %s", UNITS[i], way ? "vertices" : "fragments");
            check_exact(name, &world, HARD_HIGHP, &exact);
            if (way)
                check_exact(name, &world, HARD_MEDIUMP, &exact);
        }
    }
}

/* In mediump a fragment holds lengths from 2^-7 to 255: their squares are from 2^-14, below which a
 * half loses digits, to 65504, its largest number. Light and viewer are 3 to 7 units away in this
 * scene, so it is right for units of 2^-8 to 2^5 only. With everything at infinity no length is
 * computed, and any unit is right. */
DRAWN_TEST(tiny_or_huge_scale_has_its_limits_in_mediump)
{
    HardWorld world;
    Reference exact, distant;
    make_scaled(&world, 1);
    hard_exact(&world.scene, &exact);
    for (int e = -8; e <= 5; e++) {
        make_scaled(&world, ldexp(1, e));
        check_exact("units that mediump holds", &world, HARD_MEDIUMP, &exact);
    }
    /* The square of the distance is infinite and its inverse root 0: the light is lost (unless the
     * driver computes mediump with more digits), and the sum stays finite. */
    for (int e = -30; e <= 30; e++) {
        make_scaled(&world, ldexp(1, e));
        assert_true(hard_draw(&world.scene, HARD_MEDIUMP, &exact).not_finite == 0);
    }
    reference_close(&exact);
    for (int i = 0; i < 8; i++) {
        make_scaled(&world, UNITS[i]);
        world.lights[0].kind = LIGHT_DIRECTIONAL;
        world.lights[0].direction = (Vec3){2, 3, 4};
        world.scene.distant_viewer = true;
        if (i == 0)
            hard_exact(&world.scene, &distant);
        check_exact("units, all at infinity", &world, HARD_MEDIUMP, &distant);
    }
    reference_close(&distant);
}

/* Beyond the range of floats: nothing is visible, and every value is finite. */
DRAWN_TEST(tiny_or_huge_scale_beyond_floats_is_finite)
{
    static const double sizes[] = {1e-300, 1e-150, 1e-40, 1e20, 1e37, 1e40, 1e150, 1e300};
    HardWorld world;
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 4; k++) {
            const double s = sizes[i];
            make_world(&world, k % 2 ? &cube : &sphere, scale(s, k < 2 ? s : 1, -s));
            for (HardPrecision p = HARD_HIGHP; p <= HARD_MEDIUMP; p++)
                hard_draw_finite(&world.scene, p);
        }
}

FIXTURE(open_all)
{
    hard_open(SIZE, SIZE);
    SUCCEEDS(mesh_sphere(&sphere, 1, SLICES, SLICES, message) && mesh_cube(&cube, 0.6, message) &&
             mesh_quad(&quad, 4, message) && mesh_quad(&sideways, 4, message));
    for (size_t i = 0; i < sideways.vertex_count; i++)
        memcpy(sideways.vertices[i].normal, (const float[]){1, 0, 0}, sizeof(float[3]));
}

FIXTURE(close_all)
{
    Mesh *const meshes[] = {&sphere, &cube, &quad, &sideways};
    hard_close();
    for (int i = 0; i < 4; i++)
        mesh_close(meshes[i]);
}

int main(void)
{
    seed = testing_seed(20240607);
    const int failed = testing_run(0, "matrices", NULL, NULL);
    if (!picture_check_driver("hard matrices"))
        return failed ? failed : EXIT_SKIPPED;
    return failed + testing_run(1, "matrices, drawn", open_all, close_all);
}
