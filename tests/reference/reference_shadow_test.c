/*
 * Shadows in the exact picture: closed forms, what must have none, scale and place, and an
 * evaluator of this file that walks along the segment. No GL.
 */
#include "base/random.h"
#include "reference/picture_error.h"
#include "reference/reference.h"
#include "reference/reference_trace.h"
#include "shapes/mesh_solids.h"
#include "support/exact_world.h"
#include "support/oracle.h"
#include "support/testing.h"

enum { SIZE = WORLD_SIZE, PIXELS = WORLD_PIXELS };

/* The wall z = 0 fills the picture. Lit by lights that cast shadows. */
static Object *add_object(Solid solid, int divisions, Mat4 place)
{
    Object *object = world_add(solid, divisions, place);
    object->front.specular = (Vec3){0.2, 0.2, 0.2};
    object->front.shininess = 8;
    return object;
}

static Object *add_wall(void)
{
    return world_add((Solid){.kind = SOLID_QUAD}, 3, mat4_scale((Vec3){3, 3, 1}));
}

static Light *add_light(LightKind kind, Vec3 at)
{
    Light *light = &world.lights[world.scene.light_count++];
    *light = (Light){.kind = kind,
                     .position = at,
                     .direction = kind == LIGHT_SPOT ? vec3_scale(at, -1) : at,
                     .cutoff = 60,
                     .diffuse = {0.9, 0.9, 0.9},
                     .specular = {1, 1, 1},
                     .shadows = true};
    return light;
}

FIXTURE(set_up)
{
    world_open();
    world_forget();
}

FIXTURE(tear_down)
{
    world_close();
}

static void let_shadow(bool shadows)
{
    for (int i = 0; i < world.scene.light_count; i++)
        world.lights[i].shadows = shadows;
}

static Reference trace_lit(ReferenceOptions options)
{
    let_shadow(false);
    const Reference picture = world_trace(options);
    let_shadow(true);
    return picture;
}

/* Closed forms. */

/* Pixels per unit on the wall. */
static double scale(void)
{
    return SIZE / (2 * 4 * tan(PI / 8));
}

/* The number of pixels in shadow, against the same without: red of a wall lit by one light. */
static double shadow_area(const Reference *with, const Reference *without)
{
    double area = 0;
    for (int i = 0; i < PIXELS; i++)
        area += 1 - (double)with->color[3 * i] / (double)without->color[3 * i];
    return area;
}

/* The area of the shadow of a sphere behind the eye: the section of a cone, for a directional light
 * of a cylinder, with the wall. With the cone's half angle a, and b between its axis and the wall's
 * normal, in units of the light's distance from the wall, the half axes are
 * sin a cos a / (cos^2 b - sin^2 a) and sin a / sqrt(cos^2 b - sin^2 a). */
static double sphere_shadow(LightKind kind, Vec3 light, Vec3 center, double radius)
{
    const Vec3 way = kind == LIGHT_DIRECTIONAL ? light : vec3_subtract(light, center);
    const double length = vec3_length(way), cosine = way.z / length;
    if (kind == LIGHT_DIRECTIONAL)
        return PI * radius * radius / cosine;
    const double sine = radius / length, left = cosine * cosine - sine * sine;
    return PI * light.z * light.z * sine * sine * sqrt(1 - sine * sine) / (left * sqrt(left));
}

/* How far a wall's point is from the edge of that shadow, in units of the distance of its segment
 * from the sphere: negative in shadow. */
static double outside_shadow(LightKind kind, Vec3 light, Vec3 center, double radius, Vec3 place)
{
    Vec3 unit;
    vec3_normalize(kind == LIGHT_DIRECTIONAL ? light : vec3_subtract(light, place), &unit);
    const Vec3 to = vec3_subtract(center, place);
    return vec3_length(vec3_cross(to, unit)) - radius;
}

TEST_WITH(0, the_shadow_of_a_sphere_is_a_conic, set_up, tear_down)
{
    const Vec3 center = {0.2, -0.1, 5};
    const double radius = 0.3;
    add_wall();
    add_object((Solid){.kind = SOLID_SPHERE, .radius = radius}, 8, mat4_translate(center));
    for (int kind = LIGHT_DIRECTIONAL; kind <= LIGHT_SPOT; kind++) {
        const Vec3 at = kind == LIGHT_DIRECTIONAL ? (Vec3){0.1, 0.08, 1} : (Vec3){0.4, 0.3, 8};
        world.scene.light_count = 0;
        add_light((LightKind)kind, at);
        const Reference with = world_trace((ReferenceOptions){0});
        const Reference without = trace_lit((ReferenceOptions){0});
        const double area = shadow_area(&with, &without);
        const double expected =
            sphere_shadow((LightKind)kind, at, center, radius) * scale() * scale();
        printf("light %d: %.3f pixels of %.3f\n", kind, area, expected);
        /* Each pixel of its outline may be off by half a step, of 0.7 of 255. */
        assert_true(fabs(area - expected) < 8 * sqrt(expected / PI) * 0.5 / 170);
        int edges = 0;
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                int dark = 0;
                double nearest = INFINITY;
                for (int corner = 0; corner < 9; corner++) {
                    const Vec3 place = {(x + corner % 3 / 2.0 - SIZE / 2.0) / scale(),
                                        (SIZE / 2.0 - y - corner / 3 / 2.0) / scale(), 0};
                    const double out = outside_shadow((LightKind)kind, at, center, radius, place);
                    dark += out < 0;
                    nearest = fmin(nearest, fabs(out));
                }
                if (nearest < 1e-9)
                    continue;
                const size_t i = (size_t)(y * SIZE + x);
                edges += dark % 9 != 0;
                assert_int_equal(with.interior[i], dark % 9 == 0);
                if (dark == 9)
                    assert_true(with.color[3 * i] == 0);
                if (dark == 0)
                    assert_true(with.color[3 * i] == without.color[3 * i]);
            }
        assert_true(edges > 20);
        /* An edge is one however faint it is. */
        world.lights[0].diffuse = (Vec3){0.02, 0.02, 0.02};
        const Reference faint = world_trace((ReferenceOptions){0});
        assert_memory_equal(faint.interior, with.interior, PIXELS);
    }
}

/* What has no shadow. */

static Solid solid_of(SolidKind kind)
{
    return (Solid){.kind = kind,
                   .radius = kind == SOLID_TORUS || kind == SOLID_BOX ? 0.6 : 0.8,
                   .height = 1.2,
                   .tube = 0.25,
                   .caps = MESH_CAP_BOTH};
}

static Vec3 vector(Random *random, double min, double max)
{
    return (Vec3){random_between(random, min, max), random_between(random, min, max),
                  random_between(random, min, max)};
}

static Mat4 any_place(Random *random, double move)
{
    Vec3 size = vector(random, 0.6, 1.3);
    if (random_below(random, 3) == 0)
        size.x = -size.x; /* mirrored */
    return mat4_product(
        mat4_translate(vector(random, -move, move)),
        mat4_product(mat4_rotate(random_between(random, 0, 360), vector(random, -1, 1)),
                     mat4_scale(size)));
}

/* A convex closed solid, and a square, are their own N.L: bit for bit the picture without shadows,
 * from any side, and with lights that graze them. So are their meshes where they are flat. */
TEST_WITH(0, a_convex_solid_does_not_shadow_itself, set_up, tear_down)
{
    static const SolidKind kinds[] = {SOLID_SPHERE, SOLID_BOX,      SOLID_QUAD,
                                      SOLID_DISC,   SOLID_CYLINDER, SOLID_CONE};
    Random random = {testing_seed(31)};
    for (int i = 0; i < 30; i++) {
        const SolidKind kind = kinds[i % 6];
        set_up(NULL);
        Object *object = add_object(solid_of(kind), 6, any_place(&random, 0.5));
        object->two_sided = kind == SOLID_QUAD || kind == SOLID_DISC;
        object->back = object->front;
        Vec3 at = vector(&random, -4, 4), normal;
        /* On a square's plane but for 1e-9: all of it is at grazing light. */
        if (object->two_sided && i % 12 < 6) {
            const double *m = object->world_from_object.m;
            vec3_normalize((Vec3){m[8], m[9], m[10]}, &normal);
            const Vec3 out = vec3_subtract(at, (Vec3){m[12], m[13], m[14]});
            at = vec3_subtract(at, vec3_scale(normal, vec3_dot(normal, out) * (1 - 1e-9)));
        }
        add_light((LightKind)(i / 6 % 3), at);
        for (int meshes = 0; meshes <= (object->flat ? 1 : 0); meshes++) {
            const Reference with = world_trace((ReferenceOptions){.meshes = meshes});
            const Reference without = trace_lit((ReferenceOptions){.meshes = meshes});
            if (!world_same(&with, &without))
                fail_msg("solid %d, light %d: shadows of its own", (int)kind, i / 6 % 3);
        }
    }
}

/* The world's color at random points of the picture, without their pixels. */
enum { POINTS = 600 };
static void sample_points(bool meshes, bool shadows, Sample samples[POINTS])
{
    Random random = {1};
    Trace *rays;
    let_shadow(shadows);
    SUCCEEDS(trace_open(
        &rays, &world.scene,
        &(ReferenceOptions){.width = SIZE, .height = SIZE, .meshes = meshes, .threads = 1},
        message));
    let_shadow(true);
    for (int i = 0; i < POINTS; i++) {
        const double x = random_between(&random, 0, SIZE), y = random_between(&random, 0, SIZE);
        trace_sample(rays, x, y, &samples[i]);
    }
    trace_close(rays);
}

/* Two surfaces in one place are as one; also if another matrix places one of them, which is the
 * same but for rounding. */
TEST_WITH(0, surfaces_in_the_same_place_do_not_shadow_each_other, set_up, tear_down)
{
    static Sample one[POINTS], both[POINTS];
    const Mat4 third = mat4_scale((Vec3){1 / 3.0, 1 / 3.0, 1 / 3.0});
    Random random = {testing_seed(32)};
    for (int i = 0; i < 42; i++) {
        const SolidKind kind = (SolidKind)(SOLID_SPHERE + i % 7);
        const Mat4 place = any_place(&random, 0.5);
        set_up(NULL);
        add_object(solid_of(kind), 12, place);
        add_light((LightKind)(i % 3), (Vec3){1.5, 2, 3});
        const bool meshes = i % 2;
        sample_points(meshes, true, one);
        for (int other = 0; other < 2; other++) {
            world.scene.object_count = 1;
            mesh_close(&world.meshes[1]);
            add_object(solid_of(kind), 12,
                       other ? mat4_product(mat4_scale((Vec3){3, 3, 3}), mat4_product(third, place))
                             : place);
            sample_points(meshes, true, both);
            for (int k = 0; k < POINTS; k++)
                assert_true(fabs(one[k].linear[0] - both[k].linear[0]) < 1e-9);
        }
    }
}

/* A sheet of two squares, back to back. */
TEST_WITH(0, a_doubled_sheet_is_lit_on_the_side_of_the_light, set_up, tear_down)
{
    for (int side = 0; side < 2; side++)
        for (int meshes = 0; meshes < 2; meshes++) {
            set_up(NULL);
            add_object((Solid){.kind = SOLID_QUAD}, 3, mat4_scale((Vec3){3, 3, 1}));
            add_object(
                (Solid){.kind = SOLID_QUAD}, 4,
                mat4_product(mat4_rotate(180, (Vec3){0, 1, 0}), mat4_scale((Vec3){3, 3, 1})));
            add_light(LIGHT_POINT, (Vec3){0.3, 0.2, side ? -2 : 2});
            world.scene.objects = world.objects;
            const Reference with = world_trace((ReferenceOptions){.meshes = meshes});
            const Reference without = trace_lit((ReferenceOptions){.meshes = meshes});
            assert_true(world_same(&with, &without));
        }
}

/* Lights on and in things. */

TEST_WITH(0, a_light_on_a_wall_is_not_shadowed_by_it, set_up, tear_down)
{
    for (int meshes = 0; meshes < 2; meshes++) {
        set_up(NULL);
        add_object((Solid){.kind = SOLID_SPHERE, .radius = 0.7}, 32,
                   mat4_translate((Vec3){0, 0, 1}));
        const Mat4 turned = mat4_product(
            mat4_translate((Vec3){1.31, 0.23, 0.1}),
            mat4_product(mat4_rotate(70, (Vec3){0.3, 1, 0.2}), mat4_scale((Vec3){0.21, 0.7, 1})));
        add_light(LIGHT_POINT, mat4_transform_point(turned, (Vec3){0.13, 0.37, 0}));
        const Reference alone = world_trace((ReferenceOptions){.meshes = meshes});
        /* Elsewhere in the wall, and in an edge of its triangles; rounding decides the side. */
        for (int i = 0; i < 2; i++) {
            world.scene.object_count = 1;
            mesh_close(&world.meshes[1]);
            Object *wall = add_wall();
            wall->world_from_object =
                mat4_product(turned, mat4_translate(i ? (Vec3){0.13, 0.37, 0} : (Vec3){0, 0, 0}));
            const Reference picture = world_trace((ReferenceOptions){.meshes = meshes});
            for (int k = 0; k < PIXELS; k++)
                if (picture.object[k] == 0 && picture.interior[k] && alone.interior[k])
                    assert_true(picture.color[3 * k] == alone.color[3 * k]);
        }
    }
}

TEST_WITH(0, a_light_in_a_closed_object_lights_its_inside_only, set_up, tear_down)
{
    for (int kind = SOLID_SPHERE; kind <= SOLID_TORUS; kind++)
        for (int meshes = 0; meshes < 2; meshes++) {
            if (kind == SOLID_QUAD || kind == SOLID_DISC)
                continue;
            set_up(NULL);
            add_wall();
            const Solid solid = solid_of((SolidKind)kind);
            Object *object =
                add_object(solid, 16, mat4_translate((Vec3){0, 0, kind == SOLID_TORUS ? 1 : 0.9}));
            object->two_sided = true;
            object->back = object->front;
            add_light(LIGHT_POINT, (Vec3){kind == SOLID_TORUS ? 0.6 : 0.1, 0.01, 1.1});
            const Reference outside = world_trace((ReferenceOptions){.meshes = meshes});
            for (int k = 0; k < 3 * PIXELS; k++)
                assert_true(outside.color[k] == 0);
            if (kind == SOLID_TORUS)
                continue;
            /* From within, everything is lit. */
            world.scene.camera.eye = (Vec3){-0.1, -0.1, 1.05};
            world.scene.camera.center = (Vec3){-0.3, 0.1, 0.9};
            world.scene.camera.near = 1e-3;
            const Reference inside = world_trace((ReferenceOptions){.meshes = meshes});
            const Reference without = trace_lit((ReferenceOptions){.meshes = meshes});
            assert_true(world_same(&inside, &without));
            assert_true(inside.color[0] > 0);
        }
}

/* On the surface of a sphere: what lies beyond its tangent plane is lit, the rest in its shadow. */
TEST_WITH(0, a_light_on_a_sphere_shines_away_from_it, set_up, tear_down)
{
    add_wall();
    add_object((Solid){.kind = SOLID_SPHERE, .radius = 0.5}, 8, mat4_translate((Vec3){0, 0, 5}));
    /* The tangent plane at the light meets the wall in a line. */
    const Vec3 normal = {0.6, 0, -0.8};
    add_light(LIGHT_POINT, vec3_add((Vec3){0, 0, 5}, vec3_scale(normal, 0.5)));
    const Vec3 at = world.lights[0].position;
    const Reference picture = world_trace((ReferenceOptions){0});
    int lit = 0, dark = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const size_t i = (size_t)(y * SIZE + x);
            const Vec3 place = {(x + 0.5 - SIZE / 2.0) / scale(), 0, 0};
            const double out = vec3_dot(normal, vec3_subtract(place, at));
            if (fabs(out) < 1 / scale())
                continue;
            assert_int_equal(picture.color[3 * i] > 0, out > 0);
            *(out > 0 ? &lit : &dark) += 1;
        }
    assert_true(lit + dark > PIXELS / 2);
}

/* Scale and place. */

/* A torus and a box before a wall: each shadows itself or the others. */
static void open_group(Random *random, int object_count)
{
    static const SolidKind kinds[] = {SOLID_TORUS, SOLID_BOX, SOLID_CONE};
    set_up(NULL);
    add_wall();
    for (int i = 0; i < object_count; i++) {
        Mat4 place = any_place(random, 0.7);
        place.m[14] += 0.8;
        add_object(solid_of(kinds[i]), 12, place);
    }
    for (int kind = LIGHT_DIRECTIONAL; kind <= LIGHT_SPOT; kind++) {
        Light *light = add_light((LightKind)kind, vector(random, -2, 2));
        if (kind == LIGHT_DIRECTIONAL)
            light->direction.z = 2;
        light->position.z = 3.5;
        light->diffuse = light->specular = vector(random, 0.1, 0.4);
    }
}

/* All lengths times `size`, then all places moved. */
static void change_world(const World *before, double size, Vec3 move)
{
    Camera *camera = &world.scene.camera;
    world.scene = before->scene;
    camera->eye = vec3_add(vec3_scale(camera->eye, size), move);
    camera->center = vec3_add(vec3_scale(camera->center, size), move);
    camera->near *= size;
    camera->far *= size;
    for (int i = 0; i < world.scene.object_count; i++) {
        world.objects[i] = before->objects[i];
        world.objects[i].world_from_object =
            mat4_product(mat4_translate(move), mat4_product(mat4_scale((Vec3){size, size, size}),
                                                            before->objects[i].world_from_object));
    }
    for (int i = 0; i < world.scene.light_count; i++) {
        world.lights[i] = before->lights[i];
        world.lights[i].position = vec3_add(vec3_scale(before->lights[i].position, size), move);
    }
}

/* The same points are in shadow, but for those so near an edge that rounding of the places, a
 * millionth part of a unit's 2^-52 a million units away, moves them across. */
TEST_WITH(0, size_and_place_of_a_scene_do_not_change_its_shadows, set_up, tear_down)
{
    static const double sizes[] = {1e-6, 1e-3, 1, 1e3, 1e6};
    static Sample here[POINTS], there[POINTS];
    Random random = {testing_seed(33)};
    int shadowed = 0;
    for (int i = 0; i < 10; i++) {
        open_group(&random, 3);
        const World before = world;
        const bool meshes = i % 2;
        sample_points(meshes, false, there);
        sample_points(meshes, true, here);
        for (int k = 0; k < POINTS; k++)
            shadowed += here[k].linear[0] < there[k].linear[0];
        for (size_t s = 0; s < 5; s++)
            for (int moved = 0; moved < 2; moved++) {
                int apart = 0;
                const double far = moved ? 1e6 * sizes[s] : 0;
                change_world(&before, sizes[s], (Vec3){far, -far, far});
                sample_points(meshes, true, there);
                for (int k = 0; k < POINTS; k++)
                    apart += fabs(here[k].linear[0] - there[k].linear[0]) > 1e-6;
                assert_int_equal(apart, 0);
            }
    }
    assert_in_range(shadowed, POINTS, 9 * POINTS);
}

/* A walk along the segment, in steps, by how far outside a solid's surface a point is. */

/* The least of that between two points, the first STEPS / 100 of which are left out on the way from
 * an object's own surface. */
enum { STEPS = 3000 };
static double least_outside(const Object *object, Vec3 from, Vec3 to, bool own)
{
    Mat4 inverse;
    assert_true(mat4_inverse(object->world_from_object, &inverse));
    const Vec3 a = mat4_transform_point(inverse, from), b = mat4_transform_point(inverse, to);
    const Vec3 way = vec3_subtract(b, a);
    double least = INFINITY;
    for (int i = own ? STEPS / 100 : 0; i <= STEPS; i++)
        least = fmin(
            least, oracle_outside(&object->solid, vec3_add(a, vec3_scale(way, (double)i / STEPS))));
    return least;
}

/* One light at a time, white, and matte objects: color tells. */
TEST_WITH(0, shadows_are_those_of_a_walk_to_the_light, set_up, tear_down)
{
    static Sample points[POINTS], lit[POINTS];
    Random random = {testing_seed(34)};
    int counts[2] = {0, 0}, own[2] = {0, 0};
    for (int i = 0; i < 9; i++) {
        open_group(&random, 3);
        world.lights[0] = world.lights[i % 3];
        world.scene.light_count = 1;
        Light *light = &world.lights[0];
        if (i >= 3) { /* a large torus and a low light, so that it shadows itself */
            world.objects[1].world_from_object = mat4_product(mat4_translate((Vec3){0, 0, 0.5}),
                                                              mat4_rotate(8 * i, (Vec3){1, 1, 0}));
            world.scene.object_count = 2;
            light->position = (Vec3){2.5, 0.3 * i, 1.2};
            light->direction = i % 3 ? (Vec3){-2.5, -0.3 * i, -0.5} : light->position;
        }
        for (int k = 0; k < 4; k++)
            world.objects[k].front.specular = (Vec3){0, 0, 0};
        sample_points(false, true, points);
        sample_points(false, false, lit);
        for (int k = 0; k < POINTS; k += 2) {
            const int object = points[k].object;
            if (object < 0 || lit[k].linear[0] < 1e-3)
                continue;
            const Vec3 from = vec3_add(points[k].position, world.scene.camera.eye);
            Vec3 to = light->position, unit;
            if (light->kind == LIGHT_DIRECTIONAL) {
                vec3_normalize(light->direction, &unit);
                to = vec3_add(from, vec3_scale(unit, 8));
            }
            double least = INFINITY, of_own = INFINITY;
            for (int other = 1; other < world.scene.object_count; other++) {
                const double out = least_outside(&world.objects[other], from, to, other == object);
                least = fmin(least, out);
                of_own = other == object ? out : of_own;
            }
            /* A convex solid's own point, and what a step may miss. */
            const double doubt = 0.02;
            if (fabs(least) < doubt)
                continue;
            const bool dark = points[k].linear[0] == 0;
            if (dark != (least < 0))
                fail_msg("group %d, point %d of object %d: %s, but %g outside", i, k, object,
                         dark ? "dark" : "lit", least);
            counts[dark]++;
            own[of_own < -doubt] += object == 1;
        }
    }
    printf("%d lit, %d dark; of the torus %d by itself\n", counts[0], counts[1], own[1]);
    assert_true(counts[0] > 300 && counts[1] > 200 && own[1] > 5);
}

/* Triangles, one by one. (Moeller and Trumbore, 1997) */
static double mesh_crossing(const Object *object, Vec3 from, Vec3 way, bool *doubtful)
{
    const Mesh *mesh = object->mesh;
    double first = INFINITY;
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        Vec3 v[3];
        for (size_t k = 0; k < 3; k++)
            v[k] = mat4_transform_point(
                object->world_from_object,
                vec3_from_float(mesh->vertices[mesh->indices[i + k]].position));
        const Vec3 ab = vec3_subtract(v[1], v[0]), ac = vec3_subtract(v[2], v[0]);
        const Vec3 p = vec3_cross(way, ac), s = vec3_subtract(from, v[0]), q = vec3_cross(s, ab);
        const double determinant = vec3_dot(ab, p);
        if (determinant == 0)
            continue;
        const double u = vec3_dot(s, p) / determinant, w = vec3_dot(way, q) / determinant;
        const double t = vec3_dot(ac, q) / determinant, edge = fmin(u, fmin(w, 1 - u - w));
        if (t < 1e-9 || t > 1 - 1e-9 || edge < -1e-9)
            continue;
        *doubtful |= edge < 1e-9 || t < 1e-7;
        first = fmin(first, t);
    }
    return first;
}

TEST_WITH(0, shadows_of_meshes_are_those_of_their_triangles, set_up, tear_down)
{
    static Sample points[POINTS], lit[POINTS];
    Random random = {testing_seed(35)};
    int counts[2] = {0, 0}, own_facet = 0;
    for (int i = 0; i < 9; i++) {
        open_group(&random, 3);
        world.lights[0] = world.lights[i % 3];
        world.scene.light_count = 1;
        for (int k = 0; k < 4; k++)
            world.objects[k].front.specular = (Vec3){0, 0, 0};
        sample_points(true, true, points);
        sample_points(true, false, lit);
        const Light *light = &world.lights[0];
        for (int k = 0; k < POINTS; k += 2) {
            if (points[k].object < 0 || lit[k].linear[0] < 1e-3)
                continue;
            const Vec3 from = vec3_add(points[k].position, world.scene.camera.eye);
            const Vec3 way = light->kind == LIGHT_DIRECTIONAL
                                 ? vec3_scale(light->direction, 100)
                                 : vec3_subtract(light->position, from);
            /* The surface's own normal is the triangle's, which the view sees from outside. */
            const double facing = vec3_dot(way, points[k].normal) *
                                  (vec3_dot(points[k].normal, points[k].position) < 0 ? 1 : -1);
            bool doubtful = fabs(facing) < 1e-6, hidden = facing < 0;
            own_facet += hidden;
            for (int other = 0; other < 4; other++)
                hidden |= mesh_crossing(&world.objects[other], from, way, &doubtful) < INFINITY;
            if (doubtful)
                continue;
            assert_int_equal(points[k].linear[0] == 0, hidden);
            counts[hidden]++;
        }
    }
    printf("%d lit, %d dark, %d of these by their own facet\n", counts[0], counts[1], own_facet);
    assert_true(counts[0] > 300 && counts[1] > 200 && own_facet > 5);
}

/* What else holds. */

/* With light computed at the corners: a picture without each set of lights, chosen point by point
 * by the shadows, which the interpolation does not move. */
TEST_WITH(0, shadows_of_gouraud_shading_take_lights_away_per_point, set_up, tear_down)
{
    static Sample points[POINTS], mask[3][POINTS], sets[8][POINTS];
    Random random = {testing_seed(36)};
    for (int i = 0; i < 8; i++) {
        open_group(&random, 2);
        world.scene.interpolation = (Interpolation)(i % 4);
        world.scene.clamp_vertex = i >= 4;
        for (int k = 0; k < 3; k++) {
            world.lights[k].ambient = (Vec3){0.2, 0.1, 0.3};
            world.lights[k].diffuse = vec3_scale(world.lights[k].diffuse, i >= 4 ? 4 : 1);
        }
        const World all = world;
        sample_points(true, true, points);
        for (int set = 0; set < 8; set++) {
            for (int k = 0; k < 3; k++)
                if (set >> k & 1)
                    world.lights[k].diffuse = world.lights[k].specular = (Vec3){0, 0, 0};
            sample_points(true, false, sets[set]);
            world = all;
        }
        for (int light = 0; light < 3; light++) {
            world.lights[(light + 1) % 3].off = world.lights[(light + 2) % 3].off = true;
            world.lights[light].ambient = (Vec3){0, 0, 0};
            world.scene.clamp_vertex = false;
            sample_points(true, true, mask[light]);
            world = all;
        }
        for (int k = 0; k < POINTS; k++) {
            int set = 0;
            for (int light = 0; light < 3; light++)
                set |= (mask[light][k].linear[0] == 0) << light;
            assert_true(fabs(points[k].linear[0] - sets[set][k].linear[0]) < 1e-12);
        }
    }
}

TEST_WITH(0, what_casts_needs_no_opacity_and_no_place_in_view, set_up, tear_down)
{
    add_wall();
    Object *sphere = add_object((Solid){.kind = SOLID_SPHERE, .radius = 0.3}, 16,
                                mat4_translate((Vec3){0.5, 0.5, 3.95}));
    add_light(LIGHT_POINT, (Vec3){0.6, 0.6, 5});
    const Reference opaque = world_trace((ReferenceOptions){0});
    sphere->front.alpha = 0;
    sphere->two_sided = sphere->clockwise = true;
    world.scene.camera.near = 1; /* before which the sphere lies */
    const Reference other = world_trace((ReferenceOptions){0});
    assert_true(world_same(&opaque, &other));
    world.lights[0].shadows = false;
    const Reference without = world_trace((ReferenceOptions){0});
    assert_true(world_difference(&without, &opaque) > 100);
    /* Ambient light has no shadow. */
    world.lights[0].ambient = (Vec3){1, 1, 1};
    world.lights[0].diffuse = world.lights[0].specular = (Vec3){0, 0, 0};
    const Reference ambient = world_trace((ReferenceOptions){0});
    world.lights[0].shadows = true;
    const Reference kept = world_trace((ReferenceOptions){0});
    assert_true(world_same(&ambient, &kept));
}

/* A matrix that flattens, to a plane, a line or a point, leaves what casts that shadow. */
TEST_WITH(0, flattened_objects_cast_the_shadow_that_is_left_of_them, set_up, tear_down)
{
    static const Vec3 sizes[] = {{1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 1e-300}};
    for (int i = 0; i < 4; i++)
        for (int meshes = 0; meshes < 2; meshes++) {
            set_up(NULL);
            add_wall();
            add_object((Solid){.kind = SOLID_DISC, .radius = 0.2}, 64,
                       mat4_product(mat4_translate((Vec3){0, 0, 4.5}), mat4_scale(sizes[i])));
            add_light(LIGHT_DIRECTIONAL, (Vec3){0, 0, 1});
            const Reference with = world_trace((ReferenceOptions){.meshes = meshes});
            const Reference without = trace_lit((ReferenceOptions){.meshes = meshes});
            const double expected = i % 3 ? 0 : 32 * sin(2 * PI / 64) * 0.04 * scale() * scale();
            const double area = shadow_area(&with, &without);
            if (!(fabs(area - expected) < 0.1))
                fail_msg("matrix %d: %.3f pixels of %.3f", i, area, expected);
            tear_down(NULL);
        }
}

static bool is_mixed(const Reference *picture, int i)
{
    return !picture->interior[i] && picture->object[i] == 0 && i % 7 == 0;
}

TEST_WITH(0, edges_of_shadows_are_the_means_of_their_pixels, set_up, tear_down)
{
    Random random = {testing_seed(37)};
    open_group(&random, 2);
    const Reference picture = world_trace((ReferenceOptions){0});
    world_assert_means(&picture, 128, is_mixed, 10);
}

/* A square's shadow on the wall instead of a circle's: between the two the whole light is missing
 * or too much, without an edge in the exact picture; elsewhere nothing is wrong. */
TEST_WITH(0, between_the_shadows_of_a_solid_and_its_mesh_is_an_edge, set_up, tear_down)
{
    add_wall();
    add_object((Solid){.kind = SOLID_DISC, .radius = 0.4}, 4,
               mat4_translate((Vec3){-0.7, 0.3, 0.8}));
    add_light(LIGHT_DIRECTIONAL, (Vec3){-0.9, 0.2, 1});
    const Reference exact = world_trace((ReferenceOptions){.meshes = false});
    const Reference meshes = world_trace((ReferenceOptions){.meshes = true, .centers = true});
    PictureError without = {.all = {0}}, with = {.all = {0}};
    Image image;
    int on_wall = 0;
    SUCCEEDS(image_open(&image, SIZE, SIZE, IMAGE_FLOAT, message));
    for (int i = 0; i < PIXELS; i++) {
        float *pixel = (float *)image.pixels + 4 * i;
        memcpy(pixel, &meshes.color[3 * i], 3 * sizeof *pixel);
        pixel[3] = exact.object[i] == 0; /* what the disc's outline uncovers is another matter */
        on_wall += exact.interior[i] && exact.object[i] == 0 && meshes.object[i] == 0 &&
                   reference_lights_differ(exact.lights[i], meshes.lights[i]);
    }
    picture_error_add(&without, &image, &(ExactView){.exact = &exact, .scene = &world.scene});
    picture_error_add(&with, &image,
                      &(ExactView){.exact = &exact, .scene = &world.scene, .drawn = &meshes});
    image_close(&image);
    assert_true(on_wall > 5);
    assert_int_equal(with.interior.pixels + on_wall, without.interior.pixels);
    assert_int_equal(with.edges.pixels - on_wall, without.edges.pixels);
    assert_true(without.interior.maximum > 100);
    printf("%d pixels; elsewhere %.3f\n", on_wall, with.interior.maximum);
    assert_true(with.interior.maximum < 0.01);
}

TEST_MAIN("reference shadow", NULL, NULL)
