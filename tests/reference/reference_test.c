/*
 * The exact picture: closed forms, and meshes against solids. No GL.
 */
#include "core/mesh_make.h"
#include "reference/lit_world.h"
#include "support/testing.h"

/* How far two pictures are apart where both are interior, in steps of 1/255. */
static double interior_difference(const Reference *a, const Reference *b)
{
    double max = 0;
    int count = 0;
    for (size_t i = 0; i < pixel_count(a); i++) {
        if (!a->interior[i] || !b->interior[i])
            continue;
        count++;
        for (size_t k = 0; k < 3; k++)
            max = fmax(max, 255 * fabs(channel(a, i, k) - channel(b, i, k)));
    }
    assert_true(count > 100);
    return max;
}

/* Colors of vertices are of the mesh, as its triangles are; on a square that is left as it is, of
 * one color from left to right, it is linear. */
TEST_WITH(0, colors_of_vertices_are_linear_between_them, set_up, tear_down)
{
    Object *quad = add_object((Solid){.kind = SOLID_QUAD}, 3);
    Mesh *mesh = &world.meshes[0];
    SUCCEEDS(mesh_open_colors(mesh, message));
    for (size_t i = 0; i < mesh->vertex_count; i++)
        mesh->colors[i][1] = 0.5F + 0.5F * mesh->vertices[i].position[0];
    world.scene.global_ambient = (Vec3){0.25, 0.25, 0.25};
    for (int meshes = 0; meshes < 2; meshes++)
        for (int way = 0; way < 2; way++) {
            world.scene.interpolation = way ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG;
            const Reference picture = world_trace((ReferenceOptions){.meshes = meshes});
            for (int x = SIZE / 3; x < SIZE * 2 / 3; x++) {
                const double across = 4 * tan(PI / 8) * ((x + 0.5) / SIZE * 2 - 1);
                /* Ambient light and the directional one, straight on: 0.25 and 1. Positions of the
                 * mesh are floats. */
                assert_true(fabs(channel(&picture, pixel_at(&picture, x, SIZE / 2), 1) -
                                 fmin(1.25 * (0.5 + 0.5 * across), 1)) < 1e-6);
            }
        }
    assert_true(quad->solid.kind == SOLID_QUAD);
}

TEST_WITH(0, a_sphere_has_its_depth_color_and_area, set_up, tear_down)
{
    add_object((Solid){.kind = SOLID_SPHERE, .radius = 1}, 8);
    for (int size = 33; size < 400; size = 3 * size - 2) {
        Reference picture = world_trace((ReferenceOptions){.width = size, .height = size});
        const size_t middle = pixel_at(&picture, size / 2, size / 2);
        assert_true(fabs(picture.depth[middle] - 3) < 1e-15);
        assert_color(&picture, middle, 0.8, 0.5, 0.2);
        assert_int_equal(picture.interior[middle], 1);
        assert_int_equal(picture.object[0], -1);
        assert_true(picture.depth[0] == INFINITY);
        assert_int_equal(picture.interior[0], 0);
        assert_true(picture.coverage[0] == 1);
        assert_color(&picture, 0, 0.1, 0.2, 0.3);
        /* A ray touches it at the angle asin(1/4): tan = 1 / sqrt(15). */
        const double radius = pixels_at_one(size) / sqrt(15), area = PI * radius * radius;
        const double error = fabs(covered(&picture) - area);
        printf("%d: area %.4f, of %.4f\n", size, covered(&picture), area);
        /* Each pixel of the outline, 8 radius of them, may be wrong by 0.5 / 255, always to the
         * same side. */
        assert_true(error < 8 * radius * 0.5 / 255);
    }
}

/* Of the segment from a to b, how much lies within [i, i + 1]. */
static double share(double a, double b, int i)
{
    return fmax(0, fmin(b, i + 1) - fmax(a, i));
}

TEST_WITH(0, a_square_covers_the_exact_part_of_each_pixel, set_up, tear_down)
{
    Object *quad = add_object((Solid){.kind = SOLID_QUAD}, 4);
    for (int i = 0; i < 8; i++) {
        const double half = 0.3 + 0.13 * i, x = 0.011 * i, y = -0.017 * i;
        quad->world_from_object =
            mat4_product(mat4_translate((Vec3){x, y, 0}), mat4_scale((Vec3){half, half, 1}));
        Reference picture = world_trace((ReferenceOptions){.meshes = i % 2});
        const double scale = pixels_at_one(SIZE) / 4;
        double worst = 0;
        for (int row = 0; row < SIZE; row++)
            for (int column = 0; column < SIZE; column++) {
                const size_t pixel = pixel_at(&picture, column, row);
                const double part =
                    share(SIZE / 2.0 + scale * (x - half), SIZE / 2.0 + scale * (x + half),
                          column) *
                    share(SIZE / 2.0 - scale * (y + half), SIZE / 2.0 - scale * (y - half), row);
                const double found = picture.object[pixel] == 0
                                         ? (double)picture.coverage[pixel]
                                         : 1 - (double)picture.coverage[pixel];
                worst = fmax(worst, fabs(found - part));
                worst = fmax(worst,
                             fabs(channel(&picture, pixel, 0) - (part * 0.8 + (1 - part) * 0.1)));
                if (part > 0 && part < 1)
                    assert_int_equal(picture.interior[pixel], 0);
                if (part == 1)
                    assert_int_equal(picture.interior[pixel], 1);
            }
        assert_true(worst < 0.5 / 255);
    }
}

/* As a driver draws without antialiasing: no pixel has a mean of square and background. */
TEST_WITH(0, colors_at_centers_are_not_mixed, set_up, tear_down)
{
    Object *quad = add_object((Solid){.kind = SOLID_QUAD}, 4);
    quad->world_from_object = mat4_scale((Vec3){0.43, 0.71, 1});
    Reference sharp = world_trace((ReferenceOptions){.centers = true});
    int inside = 0, partial = 0;
    for (size_t pixel = 0; pixel < (size_t)SIZE * SIZE; pixel++) {
        const bool covered = sharp.object[pixel] == 0;
        assert_float_equal(channel(&sharp, pixel, 0), (covered ? 0.8F : 0.1F), 1e-6F);
        inside += covered;
        partial += sharp.coverage[pixel] < 1;
    }
    assert_true(inside > 0 && partial > 0); /* the coverage is still there */
}

/* One triangle in perspective, colors at its corners. */
TEST_WITH(0, colors_are_interpolated_by_place_on_the_triangle, set_up, tear_down)
{
    /* N.L at the corners: 1, 0.6, 0. */
    MeshVertex vertices[3] = {{{-1, -1, 1.5F}, {0, 0, 1}},
                              {{1, -0.5F, -2}, {0.8F, 0, 0.6F}},
                              {{-0.25F, 1, 0}, {0, 1, 0}}};
    static const double cosines[3] = {1, 0.6F, 0};
    uint32_t indices[3] = {0, 1, 2};
    Mesh mesh = {.vertices = vertices, .indices = indices, .vertex_count = 3, .index_count = 3};
    Object *object = add_object((Solid){.kind = SOLID_QUAD}, 3);
    object->mesh = &mesh;
    object->solid = (Solid){.kind = SOLID_NONE};
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    Reference picture = world_trace((ReferenceOptions){.meshes = true});
    Vec3 v[3];
    int count = 0;
    for (int k = 0; k < 3; k++)
        v[k] = (Vec3){(double)vertices[k].position[0], (double)vertices[k].position[1],
                      (double)vertices[k].position[2] - 4};
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const size_t pixel = pixel_at(&picture, x, y);
            if (!picture.interior[pixel])
                continue;
            count++;
            /* d t = a v0 + b v1 + c v2: by Cramer's rule, up to a factor. */
            const double scale = 1 / pixels_at_one(SIZE);
            const Vec3 d = {(x + 0.5 - SIZE / 2.0) * scale, (SIZE / 2.0 - y - 0.5) * scale, -1};
            const double a = vec3_dot(d, vec3_cross(v[1], v[2]));
            const double b = vec3_dot(d, vec3_cross(v[2], v[0]));
            const double c = vec3_dot(d, vec3_cross(v[0], v[1]));
            const double light = (a * cosines[0] + b * cosines[1] + c * cosines[2]) / (a + b + c);
            assert_color(&picture, pixel, 0.8 * light, 0.5 * light, 0.2 * light);
        }
    assert_true(count > 200);
}

/* Meshes and solids. */

/* Exact and mesh pictures, of solids that are curved: the difference falls with the square of the
 * divisions. */
TEST_WITH(0, finer_meshes_converge_to_the_solid, set_up, tear_down)
{
    static const Solid solids[] = {
        {.kind = SOLID_SPHERE, .radius = 1},
        {.kind = SOLID_CYLINDER, .radius = 0.7, .height = 1, .caps = MESH_CAP_TOP},
        {.kind = SOLID_TORUS, .radius = 0.8, .tube = 0.35},
        {.kind = SOLID_DISC, .radius = 1},
        {.kind = SOLID_CONE, .radius = 0.8, .height = 1.2},
    };
    const Mat4 turn = mat4_rotate(-55, (Vec3){1, 0.3, 0.1});
    world.lights[0] = (Light){
        .kind = LIGHT_POINT, .position = {1, 2, 4}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}};
    for (size_t s = 0; s < sizeof solids / sizeof solids[0]; s++) {
        double errors[3];
        for (int i = 0; i < 3; i++) {
            world.scene.object_count = 0;
            world_close_meshes();
            Object *object = add_object(solids[s], 32 << i);
            object->front.specular = (Vec3){0.5, 0.5, 0.5};
            object->front.shininess = 4;
            object->world_from_object = mat4_product(turn, mat4_scale((Vec3){1, 0.8, 1.1}));
            Reference exact = world_trace((ReferenceOptions){.meshes = false});
            Reference mesh = world_trace((ReferenceOptions){.meshes = true});
            errors[i] = interior_difference(&exact, &mesh);
        }
        printf("solid %d: %.3f, %.3f, %.4f steps at 32, 64, 128 divisions\n", (int)solids[s].kind,
               errors[0], errors[1], errors[2]);
        /* At a pixel where the error is greatest, which moves, the ratio is about 4. A disc's
         * interior is the same however it is cut; a cone's normals are linear but for its apex. */
        assert_true(errors[2] < 2);
        assert_true(solids[s].kind == SOLID_DISC ? errors[2] < 1e-4 : errors[2] < 0.45 * errors[1]);
    }
}

TEST_WITH(0, flat_solids_are_their_meshes, set_up, tear_down)
{
    const Mat4 turn = mat4_rotate(40, (Vec3){1, 0.7, 0.2});
    world.lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {1, 1, 3},
                              .direction = {-1, -1, -3},
                              .cutoff = 15,
                              .exponent = 3,
                              .diffuse = {1, 1, 1},
                              .specular = {1, 1, 1}};
    for (SolidKind kind = SOLID_BOX; kind <= SOLID_QUAD; kind++) {
        world.scene.object_count = 0;
        world_close_meshes();
        Object *object = add_object((Solid){.kind = kind, .radius = 0.7}, 4);
        object->front.specular = (Vec3){1, 1, 1};
        object->front.shininess = 20;
        object->world_from_object = turn;
        Reference exact = world_trace((ReferenceOptions){.meshes = false});
        Reference mesh = world_trace((ReferenceOptions){.meshes = true});
        /* The corners of the mesh are floats, 3e-8 off; the highlight is 20 times as steep. */
        assert_true(world_difference(&exact, &mesh) < 0.5);
        assert_true(interior_difference(&exact, &mesh) < 2e-3);
        assert_memory_equal(exact.object, mesh.object, pixel_count(&exact) * sizeof *exact.object);
        assert_memory_equal(exact.interior, mesh.interior, pixel_count(&exact));
    }
}

TEST_WITH(0, colors_are_clamped_at_vertices_on_request, set_up, tear_down)
{
    Object *quad = add_object((Solid){.kind = SOLID_QUAD}, 3);
    quad->front.emission = (Vec3){0.5, 0.25, 0};
    Reference picture = world_trace((ReferenceOptions){0});
    assert_color(&picture, MIDDLE, 1, 0.75, 0.2);
    world.scene.show_clipped = true;
    picture = world_trace((ReferenceOptions){0});
    assert_color(&picture, MIDDLE, 1, 0, 1);
    world.scene.clamp_vertex = true;
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    picture = world_trace((ReferenceOptions){0}); /* lit at every point */
    assert_color(&picture, MIDDLE, 1, 0, 1);
    picture = world_trace((ReferenceOptions){.meshes = true});
    assert_color(&picture, MIDDLE, 1, 0.75, 0.2);
    world.scene.linear = true;
    world.scene.show_clipped = false;
    picture = world_trace((ReferenceOptions){0});
    assert_color(&picture, MIDDLE, 1, 1.055 * pow(0.75, 1 / 2.4) - 0.055,
                 1.055 * pow(0.2, 1 / 2.4) - 0.055);
}

/* From behind, at 60 degrees: emission less half of the diffuse color. */
TEST_WITH(0, a_light_behind_takes_light_away_on_request, set_up, tear_down)
{
    Object *quad = add_object((Solid){.kind = SOLID_QUAD}, 3);
    quad->front.emission = (Vec3){0.9, 0.5, 0.05};
    world.lights[0].direction = (Vec3){sqrt(3), 0, -1};
    Reference picture = world_trace((ReferenceOptions){0});
    assert_color(&picture, MIDDLE, 0.9, 0.5, 0.05);
    world.scene.signed_dots = true;
    picture = world_trace((ReferenceOptions){0});
    assert_color(&picture, MIDDLE, 0.5, 0.25, 0);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    world.scene.clamp_vertex = true;
    picture = world_trace((ReferenceOptions){.meshes = true});
    assert_color(&picture, MIDDLE, 0.5, 0.25, 0);
    world.lights[0].shadows = true; /* none of it arrives */
    picture = world_trace((ReferenceOptions){0});
    assert_color(&picture, MIDDLE, 0.9, 0.5, 0.05);
}

TEST_WITH(0, flattened_objects_have_finite_colors, set_up, tear_down)
{
    static const Vec3 scales[] = {{1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {1e-8, 1, 1}, {1, 1, 1e-9}};
    const Mat4 turn = mat4_rotate(20, (Vec3){0.1, 1, 0.2});
    for (SolidKind kind = SOLID_SPHERE; kind <= SOLID_TEAPOT; kind++)
        for (size_t s = 0; s < sizeof scales / sizeof scales[0]; s++) {
            set_up(NULL);
            Object *object = add_object(
                (Solid){
                    .kind = kind, .radius = 0.7, .height = 1, .tube = 0.2, .caps = MESH_CAP_BOTH},
                16);
            object->world_from_object = mat4_product(turn, mat4_scale(scales[s]));
            Reference picture = world_trace((ReferenceOptions){.width = 16, .height = 16});
            for (size_t i = 0; i < 3 * pixel_count(&picture); i++)
                assert_true(picture.color[i] >= 0 && picture.color[i] <= 1);
            /* It is flat already, and lit as before. */
            if (s == 0 && kind == SOLID_QUAD)
                assert_true(fabs(channel(&picture, 8 * 16 + 8, 0) / 0.8 - turn.m[10]) < 1e-6);
        }
}

TEST_WITH(0, only_objects_between_near_and_far_are_visible, set_up, tear_down)
{
    Object *sphere = add_object((Solid){.kind = SOLID_SPHERE, .radius = 1}, 64);
    sphere->two_sided = true;
    sphere->back = (Material){.emission = {0, 1, 0}, .alpha = 1};
    for (int meshes = 0; meshes < 2; meshes++) {
        world.scene.camera.near = 3.5; /* the front is at 3: cut open */
        Reference picture = world_trace((ReferenceOptions){.meshes = meshes});
        assert_true(fabs(picture.depth[MIDDLE] - 5) < 0.01);
        assert_color(&picture, MIDDLE, 0, 1, 0);
        world.scene.camera.near = 0.1;
        world.scene.camera.far = 2.9;
        picture = world_trace((ReferenceOptions){.meshes = meshes});
        assert_int_equal(picture.object[MIDDLE], -1);
        world.scene.camera.far = 3.5; /* only a cap; from a pixel at its rim on, background */
        picture = world_trace((ReferenceOptions){.meshes = meshes});
        assert_int_equal(picture.object[MIDDLE], 0);
        /* At depth 3.5 the sphere's circle has the radius sqrt(3) / 2. */
        const double radius = pixels_at_one(SIZE) * sqrt(0.75) / 3.5;
        assert_true(fabs(covered(&picture) - PI * radius * radius) < (meshes ? 3 : 0.1));
        world.scene.camera.far = 100;
    }
}

TEST_WITH(0, the_first_of_equally_near_objects_is_seen, set_up, tear_down)
{
    for (int i = 0; i < 3; i++)
        add_object((Solid){.kind = SOLID_QUAD}, 3)->front.emission = (Vec3){0, 0, 0.1 * i};
    for (int meshes = 0; meshes < 2; meshes++) {
        Reference picture = world_trace((ReferenceOptions){.meshes = meshes});
        for (size_t i = 0; i < pixel_count(&picture); i++)
            assert_true(picture.object[i] <= 0);
    }
}

TEST_MAIN("reference", NULL, NULL)
