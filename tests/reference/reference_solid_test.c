/*
 * The basis of the exact picture: rays against solids and triangles, and the lighting equation at a
 * point. No GL.
 */
#include "reference/reference_object.h"
#include "reference/reference_shade.h"
#include "reference/reference_solid.h"
#include "reference/reference_triangles.h"
#include "shapes/mesh_solids.h"
#include "support/oracle.h"
#include "support/testing.h"

static const long SEED = 1;

static double uniform(double min, double max)
{
    return min + (max - min) * drand48();
}

static Real3 vector(double min, double max)
{
    return (Real3){uniform(min, max), uniform(min, max), uniform(min, max)};
}

FIXTURE(set_up)
{
    srand48(SEED);
    printf("seed %ld\n", SEED);
}

static const Solid CLOSED[] = {
    {.kind = SOLID_SPHERE, .radius = 1.1},
    {.kind = SOLID_BOX, .radius = 0.8},
    {.kind = SOLID_CYLINDER, .radius = 0.7, .height = 1.3, .caps = MESH_CAP_BOTH},
    {.kind = SOLID_CONE, .radius = 0.9, .height = 1.4},
    {.kind = SOLID_CONE, .radius = 1, .height = 0.2},
    {.kind = SOLID_TORUS, .radius = 1, .tube = 0.4},
    {.kind = SOLID_TORUS, .radius = 1, .tube = 0.99},
    {.kind = SOLID_TORUS, .radius = 1, .tube = 0.001},
};
/* Each closed solid is where this is not above 0; its size is about 1. */
static double outside(const Solid *solid, Real3 p)
{
    return oracle_outside(solid, (Vec3){p.x, p.y, p.z});
}

enum { CLOSED_COUNT = sizeof CLOSED / sizeof CLOSED[0], RAYS = 20000 };

/* A ray from this distance towards a point in or near a solid. */
static void random_ray(double distance, Real3 *origin, Real3 *direction)
{
    const Real3 target = vector(-1.2, 1.2);
    *origin = real3_scale(real3_unit(vector(-1, 1)), distance);
    *direction = real3_scale(real3_subtract(target, *origin), uniform(0.01, 5));
}

TEST(hits_are_on_the_surface_and_their_normals_point_outwards)
{
    for (int s = 0; s < CLOSED_COUNT; s++) {
        const Solid *solid = &CLOSED[s];
        const double smallest = solid->kind == SOLID_TORUS ? solid->tube : 1;
        double worst = 0;
        int total = 0;
        for (int i = 0; i < RAYS; i++) {
            Real3 origin, direction;
            SolidHit hits[SOLID_MAX_HITS];
            random_ray(uniform(0, 6), &origin, &direction);
            const int count = ray_solid(solid, origin, direction, hits);
            for (int h = 0; h < count; h++, total++) {
                const Real3 p = real3_along(origin, hits[h].t, direction);
                const Real3 n = solid_normal(solid, hits[h].part, p);
                assert_true(h == 0 || hits[h].t >= hits[h - 1].t);
                worst = fmax(worst, fabs(outside(solid, p)));
                assert_true(fabs(real3_length(n) - 1) < 1e-14);
                const Real step = smallest * 1e-4;
                assert_true(outside(solid, real3_along(p, step, n)) > 0);
                /* The normal points against the ray if it enters the solid. */
                if (count == 2)
                    assert_true((real3_dot(n, direction) <= 0) == (h == 0));
            }
        }
        printf("solid %d: %d hits, %.1e off the surface at most\n", solid->kind, total, worst);
        assert_true(total > (smallest < 0.01 ? 20 : RAYS / 4));
        assert_true(worst < 1e-11); /* a point 6 away is rounded to 1e-15 */
    }
}

/* A point of the line is inside if the number of hits before it is odd. */
TEST(no_hit_is_missed_or_made_up)
{
    for (int s = 0; s < CLOSED_COUNT; s++) {
        const Solid *solid = &CLOSED[s];
        for (int i = 0; i < RAYS; i++) {
            Real3 origin, direction;
            SolidHit hits[SOLID_MAX_HITS];
            random_ray(4, &origin, &direction);
            const int count = ray_solid(solid, origin, direction, hits);
            for (int k = 0; k < 8; k++) {
                const Real t = uniform(2, 6) / real3_length(direction);
                const double value = outside(solid, real3_along(origin, t, direction));
                int before = 0;
                for (int h = 0; h < count; h++)
                    before += hits[h].t < t;
                if (fabs(value) > 1e-9)
                    assert_int_equal(before % 2, value < 0);
            }
        }
    }
}

/* Through points of the solid, and past it; unevenly scaled, sheared and mirrored. */
TEST(what_misses_the_ball_of_an_object_misses_the_object)
{
    static const Vec3 eye = {0.3, -0.2, 5};
    const Scene scene = {.camera = {.eye = eye}};
    int missed = 0, met = 0;
    for (int i = 0; i < 20000; i++) {
        const Solid sheets[2] = {{.kind = SOLID_QUAD}, {.kind = SOLID_DISC, .radius = 1.2}};
        const int s = i % (CLOSED_COUNT + 2);
        Object object = {.solid = s < CLOSED_COUNT ? CLOSED[s] : sheets[s - CLOSED_COUNT]};
        TraceObject ready;
        for (int k = 0; k < 15; k++)
            object.world_from_object.m[k] = k % 4 == 3 ? 0 : uniform(-2, 2);
        object.world_from_object.m[15] = 1;
        assert_true(
            trace_object_open(&ready, &object, &scene, NULL, &(ReferenceOptions){.threads = 1}) &&
            ready.exact);
        const Real3 from = real3_add(ready.offset, vector(-6, 6));
        const Real3 to = trace_object_place(&ready, vector(-1, 1));
        const Real3 way = real3_scale(real3_subtract(to, from), uniform(-1, 2));
        SolidSegment segment = {.endless = i % 2};
        const Real3 start = real3_subtract(from, ready.offset);
        segment.from =
            (Real3){real3_dot(ready.inverse[0], start), real3_dot(ready.inverse[1], start),
                    real3_dot(ready.inverse[2], start)};
        segment.way = (Real3){real3_dot(ready.inverse[0], way), real3_dot(ready.inverse[1], way),
                              real3_dot(ready.inverse[2], way)};
        const bool blocks = solid_blocks(&object.solid, &segment);
        const bool passes = ball_missed(&ready.ball, from, way, segment.endless);
        assert_false(blocks && passes);
        met += blocks;
        missed += passes;
        trace_object_close(&ready);
    }
    printf("%d met, %d missed their balls\n", met, missed);
    assert_true(met > 2000 && missed > 2000);
}

TEST(rays_along_axes_and_tangents_give_finite_hits)
{
    static const double places[] = {-2, -1.1, -1, -0.8, -0.4, 0, 0.4, 0.7, 0.8, 0.9, 1, 1.1, 1.4};
    enum { PLACES = sizeof places / sizeof places[0] };
    for (int s = 0; s < CLOSED_COUNT; s++)
        for (int i = 0; i < PLACES * PLACES * 3; i++) {
            const double a = places[i % PLACES], b = places[i / PLACES % PLACES];
            const int axis = i / PLACES / PLACES;
            const Real3 origins[3] = {{-5, a, b}, {a, -5, b}, {a, b, -5}};
            const Real3 direction = {axis == 0, axis == 1, axis == 2};
            SolidHit hits[SOLID_MAX_HITS];
            const int count = ray_solid(&CLOSED[s], origins[axis], direction, hits);
            assert_in_range(count, 0, SOLID_MAX_HITS);
            for (int h = 0; h < count; h++) {
                const Real3 p = real3_along(origins[axis], hits[h].t, direction);
                const Real3 n = solid_normal(&CLOSED[s], hits[h].part, p);
                assert_true(isfinite(hits[h].t));
                /* For a tangent ray, the torus is as accurate as the root of the rounding. */
                assert_true(fabs(outside(&CLOSED[s], p)) < 1e-7);
                assert_true(fabs(real3_length(n) - 1) < 1e-14);
            }
        }
}

TEST(open_cylinders_and_sheets_have_their_faces)
{
    SolidHit hits[SOLID_MAX_HITS];
    const Solid quad = {.kind = SOLID_QUAD}, disc = {.kind = SOLID_DISC, .radius = 2};
    Solid tube = {.kind = SOLID_CYLINDER, .radius = 1, .height = 2};
    const Real3 down = {0, 0, -1}, above = {0.5, 0.25, 5}, slanted = {0.2, 0, -1};
    for (int caps = 0; caps < 4; caps++) {
        tube.caps = (MeshCaps)caps;
        assert_int_equal(ray_solid(&tube, above, down, hits), (caps & 1) + (caps >> 1));
        if (caps & MESH_CAP_TOP) {
            assert_true(hits[0].t == 3);
            assert_int_equal(hits[0].part, PART_TOP);
        }
        if (caps & MESH_CAP_BOTTOM)
            assert_true(hits[(caps & MESH_CAP_TOP) != 0].t == 5);
    }
    /* In through the open top, to the inner side: at x = 0.5 + 0.2 t = 1. */
    tube.caps = MESH_CAP_NONE;
    assert_int_equal(ray_solid(&tube, (Real3){0.5, 0, 3.5}, slanted, hits), 1);
    assert_true(fabs(hits[0].t - 2.5) < 1e-15);
    assert_int_equal(hits[0].part, PART_SIDE);

    assert_int_equal(ray_solid(&quad, (Real3){1, -1, 3}, down, hits), 1);
    assert_true(hits[0].t == 3);
    assert_int_equal(ray_solid(&quad, (Real3){1.000001, 0, 3}, down, hits), 0);
    assert_int_equal(ray_solid(&quad, (Real3){0, 0, 3}, (Real3){1, 0, 0}, hits), 0);
    assert_int_equal(ray_solid(&disc, (Real3){0, 2, -3}, (Real3){0, 0, 2}, hits), 1);
    assert_true(hits[0].t == 1.5);
    assert_int_equal(ray_solid(&disc, (Real3){1.5, 1.5, 3}, down, hits), 0);
}

/* Triangles. */

static Triangles open_mesh(const Mesh *mesh, Real3 offset, int threads, Real3 **points)
{
    Triangles triangles;
    *points = malloc(mesh->vertex_count * sizeof **points);
    assert_non_null(*points);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->vertices[i].position;
        (*points)[i] = real3_add((Real3){(Real)p[0], (Real)p[1], (Real)p[2]}, offset);
    }
    assert_true(triangles_open(&triangles, mesh, *points, false, threads, NULL));
    return triangles;
}

static void close_mesh(Mesh *mesh, Triangles *triangles, Real3 *points)
{
    triangles_close(triangles);
    free(points);
    mesh_close(mesh);
}

/* What a ray or segment meets if every triangle is tried. */
static bool any_of_all(const Triangles *triangles, Real3 direction, TriangleHit *nearest,
                       const TriangleSegment *segment)
{
    BoundsNode node = {.children = {{0, 1}}};
    Triangles each = {.count = 1, .nodes = &node};
    bool blocked = false;
    for (int axis = 0; axis < 3; axis++)
        for (int child = 0; child < BOUNDS_WIDTH; child++) {
            node.sides[0][axis][child] = child == 0 ? -100 : INFINITY;
            node.sides[1][axis][child] = child == 0 ? 100 : -INFINITY;
        }
    for (size_t k = 0; k < triangles->count; k++) {
        each.triangles = &triangles->triangles[k];
        triangles_ray(&each, direction, 0.1, 100, nearest);
        blocked |= triangles_block(&each, segment);
    }
    return blocked;
}

TEST(boxes_contain_their_triangles)
{
    Mesh mesh;
    Real3 *points;
    int blocked = 0;
    assert_true(mesh_teapot(&mesh, 1, 9, NULL));
    Triangles triangles = open_mesh(&mesh, (Real3){0.1, -0.2, -4}, 1, &points);
    for (int i = 0; i < 1000; i++) {
        const Real3 direction = {uniform(-0.5, 0.5), uniform(-0.3, 0.3), -1};
        const TriangleSegment segment = {
            .from = {uniform(-2, 2), uniform(-1, 1), uniform(-5, -3)},
            /* Some along an axis, where what the boxes are met by is infinite. */
            .way = {i % 4 == 0 ? 0 : uniform(-3, 3), i % 8 == 0 ? -0.0 : uniform(-3, 3), 1},
            .endless = i % 2,
            .own = TRIANGLES_NONE};
        TriangleHit hit = {.t = INFINITY}, nearest = {.t = INFINITY};
        const bool met = triangles_ray(&triangles, direction, 0.1, 100, &hit);
        const bool any = any_of_all(&triangles, direction, &nearest, &segment);
        assert_int_equal(met, nearest.t < INFINITY);
        assert_true(hit.t == nearest.t);
        assert_int_equal(triangles_block(&triangles, &segment), any);
        blocked += any;
    }
    assert_in_range(blocked, 200, 800);
    close_mesh(&mesh, &triangles, points);
}

/* The same triangles in the same boxes, whose numbers differ. */
TEST(threads_build_the_same_hierarchy)
{
    Mesh mesh;
    Real3 *points, *same;
    assert_true(mesh_teapot(&mesh, 1, 24, NULL));
    Triangles one = open_mesh(&mesh, (Real3){0, 0, -4}, 1, &points);
    Triangles many = open_mesh(&mesh, (Real3){0, 0, -4}, 5, &same);
    assert_int_equal(one.count, many.count);
    assert_memory_equal(one.triangles, many.triangles, one.count * sizeof *one.triangles);
    for (int i = 0; i < 1000; i++) {
        const Real3 direction = {uniform(-0.5, 0.5), uniform(-0.3, 0.3), -1};
        TriangleHit hit = {.t = INFINITY}, other = {.t = INFINITY};
        assert_int_equal(triangles_ray(&one, direction, 0.1, 100, &hit),
                         triangles_ray(&many, direction, 0.1, 100, &other));
        assert_true(hit.t == other.t && hit.index == other.index);
    }
    triangles_close(&many);
    free(same);
    close_mesh(&mesh, &one, points);
}

/* At the corners and on the sides of triangles, as seen from the eye. */
TEST(no_ray_passes_between_triangles)
{
    Mesh mesh;
    Real3 *points;
    assert_true(mesh_sphere(&mesh, 1, 24, 16, NULL));
    Triangles triangles = open_mesh(&mesh, (Real3){0, 0, -3}, 1, &points);
    for (size_t i = 0; i < mesh.index_count; i++) {
        const Real3 a = points[mesh.indices[i]];
        const Real3 b = points[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]];
        const Real3 on_side = real3_along(a, uniform(0, 1), real3_subtract(b, a));
        TriangleHit hit = {.t = INFINITY};
        /* The outline's own points may be missed; it is at z = -3 + 1/3. */
        if (a.z < -2.6 || b.z < -2.6)
            continue;
        assert_true(triangles_ray(&triangles, a, 0.1, 100, &hit));
        hit.t = INFINITY;
        assert_true(triangles_ray(&triangles, on_side, 0.1, 100, &hit));
        assert_true(fabs(hit.t - 1) < 1e-12);
        assert_true(fabs(hit.weights[0] + hit.weights[1] + hit.weights[2] - 1) < 1e-15);
    }
    close_mesh(&mesh, &triangles, points);
}

TEST(faces_of_a_cube_are_pieces_and_a_sphere_is_one)
{
    Mesh mesh;
    Real3 *points;
    assert_true(solid_mesh(&(Solid){.kind = SOLID_BOX, .radius = 1}, 4, &mesh, NULL));
    Triangles triangles = open_mesh(&mesh, (Real3){0, 0, -4}, 1, &points);
    for (size_t i = 0; i < triangles.count; i++)
        for (size_t k = 0; k < triangles.count; k++) {
            const Triangle *a = &triangles.triangles[i], *b = &triangles.triangles[k];
            assert_int_equal(a->piece == b->piece, a->number / 32 == b->number / 32);
        }
    close_mesh(&mesh, &triangles, points);
    assert_true(mesh_sphere(&mesh, 1, 12, 12, NULL)); /* with a seam, and copies of its poles */
    triangles = open_mesh(&mesh, (Real3){0, 0, -4}, 1, &points);
    for (size_t i = 0; i < triangles.count; i++)
        assert_int_equal(triangles.triangles[i].piece, triangles.triangles[0].piece);
    close_mesh(&mesh, &triangles, points);
}

/* The equation, at (0, 0, -4) seen from the origin. */

static Scene one_light;
static Light light;
static Object lit;

static Real3 shade(Real3 normal)
{
    const ShadeLight ready = {&light, real3(light.position), real3_unit(real3(light.direction)),
                              cos(light.cutoff * 3.141592653589793 / 180)};
    const Shading shading = {.lights = &ready,
                             .light_count = 1,
                             .global_ambient = real3(one_light.global_ambient),
                             .reflection_phong = one_light.reflection == REFLECTION_PHONG};
    ShadeSides sides;
    return shade_point(&shading, &(ShadePoint){&lit.front, {0, 0, -4}, normal}, &sides);
}

static Vec3 any(double min, double max)
{
    return (Vec3){uniform(min, max), uniform(min, max), uniform(min, max)};
}

/* One normal of eight is zero. */
TEST(the_equation_is_that_of_the_oracle)
{
    int compared = 0;
    for (int i = 0; i < 5000; i++) {
        one_light = (Scene){.global_ambient = any(0, 1),
                            .lights = &light,
                            .light_count = 1,
                            .reflection = i % 2 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG};
        light = (Light){.kind = (LightKind)(i % 3),
                        .position = any(-6, 6),
                        .direction = any(-1, 1),
                        .ambient = any(0, 1),
                        .diffuse = any(0, 1),
                        .specular = any(0, 1),
                        .cutoff = uniform(0, 90),
                        .exponent = i % 5 ? uniform(0, 8) : 0};
        if (i % 4)
            light.constant = uniform(0, 1), light.linear = uniform(0, 1), light.quadratic = 0.1;
        lit.front =
            (Material){any(0, 1), any(0, 1), any(0, 1), any(0, 1), 1, i % 7 ? uniform(0, 20) : 0};
        OraclePoint at = {.object = &lit,
                          .point = {0, 0, -4},
                          .normal = i % 8 ? vec3_unit(any(-1, 1)) : (Vec3){0, 0, 0},
                          .viewer = {0, 0, 1}};
        const Vec3 expected = oracle_light(&one_light, &at);
        const Real3 color = shade(real3(at.normal));
        if (at.from_jump < 1e-9 && i % 8)
            continue;
        compared++;
        /* A dozen roundings of numbers near 1, and the powers of cosines. */
        assert_true(fabs(color.x - expected.x) < 1e-13 && fabs(color.y - expected.y) < 1e-13 &&
                    fabs(color.z - expected.z) < 1e-13);
    }
    assert_true(compared > 4500);
}

TEST(a_light_on_the_surface_gives_finite_colors)
{
    for (int i = 0; i < 4; i++) {
        one_light = (Scene){.reflection = i % 2 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG};
        light = (Light){.kind = i < 2 ? LIGHT_POINT : LIGHT_SPOT,
                        .position = {0, 0, -4},
                        .direction = {0, 0, -1},
                        .diffuse = {1, 1, 1},
                        .specular = {1, 1, 1},
                        .cutoff = 90,
                        .quadratic = i / 2};
        lit.front = (Material){.emission = {0.3125, 0.125, 0}, .diffuse = {1, 1, 1}, .alpha = 1};
        const Real3 color = shade((Real3){0, 0, 1});
        assert_true(color.x == 0.3125 && color.y == 0.125 && color.z == 0);
    }
}

TEST_MAIN("reference solid", set_up, NULL)
