/*
 * Model files that are valid are read correctly.
 */
#include "base/plugin.h"
#include "base/random.h"
#include "base/sanitized.h"
#include "scene/model_files.h"

#include <float.h>
#include <unistd.h>

static Mesh read_sound(const char *name, Bytes bytes)
{
    Mesh mesh;
    Message message = {0};
    require(read_bytes(name, &bytes, &mesh, &message), &message);
    assert_string_equal(message.text, "");
    assert_sound(&mesh);
    return mesh;
}

static void assert_counts(const Mesh *mesh, size_t vertices, size_t triangles)
{
    assert_int_equal(mesh->vertex_count, vertices);
    assert_int_equal(mesh->index_count, 3 * triangles);
}

static void assert_bounds(const Mesh *mesh, Vec3 low, Vec3 high, double tolerance)
{
    const MeshBox box = mesh_bounds(mesh);
    assert_true(topology_distance(box.low, low) <= tolerance &&
                topology_distance(box.high, high) <= tolerance);
}

TEST(quads_without_normals_become_a_smooth_cube)
{
    CLOSED(mesh_close) Mesh mesh = read_sound("cube.obj", file("cube.obj"));
    assert_counts(&mesh, 8, 12);
    assert_bounds(&mesh, (Vec3){-1, -1, -1}, (Vec3){1, 1, 1}, 0);
    assert_true(topology_volume(&mesh) == 8 && topology_area(&mesh) == 24);
    for (size_t i = 0; i < 8; i++) /* the three faces at a corner have equal weights */
        assert_true(topology_distance(vec3_from_float(mesh.vertices[i].normal),
                                      vec3_scale(vec3_from_float(mesh.vertices[i].position),
                                                 1 / sqrt(3))) <= FLT_EPSILON);
}

TEST(normals_of_a_file_are_kept_and_normalized)
{
    CLOSED(mesh_close)
    Mesh mesh = read_sound("normals.obj", text("v 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                               "vn 0 0 5\nvn 3 0 4\nvn 0 -1e-30 0\n"
                                               "f 1//1 2//2 3//3\n"));
    assert_counts(&mesh, 3, 1);
    static const Vec3 expected[3] = {{0, 0, 1}, {0.6, 0, 0.8}, {0, -1, 0}};
    for (size_t i = 0; i < 3; i++)
        assert_true(topology_distance(vec3_from_float(mesh.vertices[mesh.indices[i]].normal),
                                      expected[i]) <= FLT_EPSILON);
}

TEST(normals_that_differ_keep_vertices_apart)
{
    static const char faces[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\n";
    const char *flat = formatted("%sf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n", faces);
    const char *sharp = formatted("%sf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n", faces);
    Mesh mesh = read_sound("flat.obj", text(flat));
    assert_counts(&mesh, 4, 2);
    mesh_close(&mesh);
    mesh = read_sound("sharp.obj", text(sharp));
    assert_counts(&mesh, 6, 2);
    mesh_close(&mesh);
}

TEST(positive_and_negative_zero_are_the_same_position)
{
    CLOSED(mesh_close)
    Mesh mesh = read_sound("zeros.obj", text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv -0 -0 -0\nv 0 1 0\n"
                                             "f 1 2 3\nf 4 3 5\n"));
    assert_counts(&mesh, 4, 2);
}

TEST(polygons_are_triangulated_and_degenerate_ones_dropped)
{
    /* An arrowhead, which is not convex; a line and a point; a collinear triangle and one with two
     * equal corners; a distant vertex that nothing uses. */
    CLOSED(mesh_close)
    Mesh mesh = read_sound("arrow.obj", text("v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nv 9 9 9\n"
                                             "v 3 0 0\nf 1 2 3 4\nl 1 2\np 3\nf 1 3 6\nf 1 1 2\n"));
    assert_counts(&mesh, 4, 2);
    assert_true(fabs(topology_area(&mesh) - 1) <= FLT_EPSILON);
    assert_bounds(&mesh, (Vec3){0, -1, 0}, (Vec3){2, 1, 0}, 0);
    for (size_t i = 0; i < 4; i++)
        assert_true(mesh.vertices[i].normal[2] == 1);
}

/* A point of a closed curve without crossings, 0 <= t < 1: a circle, a gear, rays of random
 * lengths, a band that winds up and back. */
static void curve_point(int kind, double t, Random *chance, double at[2])
{
    const double turn = 6.283185307179586, gear = fmod(400 * t, 1) < 0.5 ? 1 : 1.3;
    const double back = t < 0.5 ? 2 * t : 2 - 2 * t;
    const double radius[] = {1, gear, random_between(chance, 0.3, 1.3),
                             0.1 + 0.9 * back + (t < 0.5 ? 0 : 0.04)};
    const double angle = turn * (kind == 3 ? 10 * back : t);
    at[0] = radius[kind] * cos(angle);
    at[1] = radius[kind] * sin(angle);
}

/* Overlapping and turned triangles would have more area together; a file of this size is refused
 * if that takes the square of the number of corners. */
TEST(polygons_of_many_corners_keep_their_area)
{
    static const int counts[] = {1000, 10000, 100000};
    /* AddressSanitizer takes more time for the others than is allowed. */
    const int sizes = ADDRESS_SANITIZER ? 1 : testing_step(3) > 4 ? 2 : 3;
    for (int i = 0; i < 4 * sizes; i++) {
        const int count = counts[i % sizes], kind = i / sizes;
        Random chance = {(uint64_t)i};
        double area = 0, at[2], before[2] = {0, 0}, first[2] = {0, 0};
        FILE *obj = fopen("many.obj", "w");
        assert_non_null(obj);
        for (int k = 0; k < count; k++) {
            curve_point(kind, (k + 0.5) / count, &chance, at);
            area += before[0] * at[1] - before[1] * at[0];
            memcpy(before, at, sizeof before);
            if (k == 0)
                memcpy(first, at, sizeof first);
            fprintf(obj, "v %.9f %.9f %.9f\n", at[0], at[1], at[0] + at[1] / 2);
        }
        area += before[0] * first[1] - before[1] * first[0];
        fprintf(obj, "f");
        for (int k = 1; k <= count; k++)
            fprintf(obj, " %d", k);
        assert_int_equal(fclose(obj), 0);
        CLOSED(mesh_close) Mesh mesh;
        Message message = {0};
        if (!model_read("many.obj", MODEL_UP_FILE, &mesh, &message))
            fail_msg("%s", message.text);
        const double expected = fabs(area) / 2 * 1.5; /* the normal is (-1, -1/2, 1) */
        if (!(fabs(topology_area(&mesh) - expected) <= 1e-5 * expected))
            fail_msg("kind %d, %d corners: area %g, not %g", kind, count, topology_area(&mesh),
                     expected);
    }
    assert_int_equal(unlink("many.obj"), 0);
}

TEST(a_ply_file_is_read_as_text_and_as_bytes)
{
    Mesh mesh = read_sound("octahedron.ply", file("octahedron.ply"));
    assert_counts(&mesh, 6, 8);
    assert_true(fabs(topology_volume(&mesh) - 4.0 / 3) < 1e-15); /* sixths: exact terms */
    for (size_t i = 0; i < 6; i++)
        assert_true(topology_distance(vec3_from_float(mesh.vertices[i].normal),
                                      vec3_from_float(mesh.vertices[i].position)) <= FLT_EPSILON);
    mesh_close(&mesh);
    mesh = read_sound("square.ply", file("square_bytes.ply"));
    assert_counts(&mesh, 4, 2);
    assert_true(topology_area(&mesh) == 1);
    for (size_t i = 0; i < 4; i++)
        assert_true(topology_distance(vec3_from_float(mesh.vertices[i].normal),
                                      (Vec3){0, 0.6, 0.8}) <= FLT_EPSILON);
    mesh_close(&mesh);
}

TEST(an_stl_file_is_read_as_text_and_as_bytes)
{
    for (int binary = 0; binary < 2; binary++) {
        CLOSED(mesh_close)
        Mesh mesh = read_sound("square.stl", file(binary ? "square_bytes.stl" : "square.stl"));
        assert_counts(&mesh, 4, 2);
        assert_true(topology_area(&mesh) == 1);
        assert_bounds(&mesh, (Vec3){0, 2, -1}, (Vec3){1, 2, 0}, 0); /* z is up */
        for (size_t i = 0; i < 4; i++)
            assert_true(mesh.vertices[i].normal[1] == 1);
    }
}

/* A pyramid whose box has corners (-1, -2, 0) and (1, 2, 4), in every format that has an axis of
 * its own. */

static Bytes pyramid_collada(char up)
{
    TemplateValues *values = template_values();
    template_set(values, "up", "%c", up);
    return filled("pyramid.dae", values);
}

/* All three axes, as exporters write them, or the one that is up alone. */
static Bytes pyramid_fbx(int axis, int sign, bool all)
{
    TemplateValues *values = template_values();
    template_set(values, "axis", "%d", axis);
    template_set(values, "sign", "%d", sign);
    template_set(values, "front", "%d", (axis + 1) % 3);
    template_set(values, "side", "%d", (axis + 2) % 3);
    template_set(values, "all", "%s", all ? "yes" : "");
    return filled("pyramid.fbx", values);
}

/* Where the box of the pyramid lies after the axis was turned up. */
static const struct {
    Vec3 low, high;
} UPRIGHT[] = {[MODEL_UP_X] = {{-2, -1, 0}, {2, 1, 4}},
               [MODEL_UP_Y] = {{-1, -2, 0}, {1, 2, 4}},
               [MODEL_UP_Z] = {{-1, 0, -2}, {1, 4, 2}}};

TEST(models_stand_upright)
{
    const struct {
        const char *name;
        Bytes bytes;
        ModelUp own;
    } files[] = {
        {"p.stl", file("pyramid.stl"), MODEL_UP_Z},
        {"p.3ds", file("pyramid.3ds"), MODEL_UP_Z},
        {"p.dae", pyramid_collada('X'), MODEL_UP_X},
        {"p.dae", pyramid_collada('Y'), MODEL_UP_Y},
        {"p.dae", pyramid_collada('Z'), MODEL_UP_Z},
        {"p.fbx", pyramid_fbx(0, 1, true), MODEL_UP_X},
        {"p.fbx", pyramid_fbx(1, 1, true), MODEL_UP_Y},
        {"p.fbx", pyramid_fbx(2, 1, true), MODEL_UP_Z},
        {"p.obj", file("pyramid.obj"), MODEL_UP_Y},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        for (ModelUp up = MODEL_UP_FILE; up <= MODEL_UP_Z; up++) {
            CLOSED(mesh_close) Mesh mesh;
            const ModelUp is = up == MODEL_UP_FILE ? files[i].own : up;
            testing_write(files[i].name, files[i].bytes.data, files[i].bytes.size);
            SUCCEEDS(model_read(files[i].name, up, &mesh, message));
            assert_int_equal(unlink(files[i].name), 0);
            assert_bounds(&mesh, UPRIGHT[is].low, UPRIGHT[is].high, 0);
            assert_true(topology_volume(&mesh) > 0); /* turned, not mirrored */
        }
    CLOSED(mesh_close)
    Mesh mesh = read_sound("p.fbx", pyramid_fbx(2, -1, false));
    assert_bounds(&mesh, (Vec3){-1, -4, -2}, (Vec3){1, 0, 2}, 0);
}

TEST(an_off_file_is_read)
{
    CLOSED(mesh_close)
    Mesh mesh = read_sound("corner.off", text("OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                              "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"));
    assert_counts(&mesh, 4, 4);
    assert_true(fabs(topology_volume(&mesh) - 1.0 / 6) < 1e-15);
}

TEST(the_nodes_of_a_gltf_file_transform_its_meshes)
{
    /* All are rounded to float in the file and once more: a few FLT_EPSILON of 5. */
    const double tolerance = 16 * FLT_EPSILON;
    static const struct {
        const char *nodes;
        size_t copies;
        Vec3 low, high;
        double volume;
    } known[] = {
        {"[{\"mesh\":0}]", 1, {0, 0, 0}, {1, 1, 1}, 1.0 / 6},
        {"[{\"mesh\":0,\"translation\":[1,2,3]}]", 1, {1, 2, 3}, {2, 3, 4}, 1.0 / 6},
        /* A quarter turn about z: x to y, y to -x. */
        {"[{\"mesh\":0,\"rotation\":[0,0,0.70710678,0.70710678]}]",
         1,
         {-1, 0, 0},
         {0, 1, 1},
         1.0 / 6},
        {"[{\"mesh\":0,\"scale\":[2,3,4]}]", 1, {0, 0, 0}, {2, 3, 4}, 4},
        /* Mirrored, and the outside is still outside. */
        {"[{\"mesh\":0,\"scale\":[-2,1,1]}]", 1, {-2, 0, 0}, {0, 1, 1}, 1.0 / 3},
        /* The child's transform, then its parent's; both are drawn. */
        {"[{\"mesh\":0,\"scale\":[2,2,2],\"children\":[1]},{\"mesh\":0,\"translation\":[2,0,0]}]",
         2,
         {0, 0, 0},
         {6, 2, 2},
         8.0 / 3},
        {"[{\"matrix\":[0,1,0,0,0,0,1,0,1,0,0,0,5,6,7,1],\"children\":[1]},{\"mesh\":0}]",
         1,
         {5, 6, 7},
         {6, 7, 8},
         1.0 / 6},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        for (int normals = 0; normals < 2; normals++) {
            CLOSED(mesh_close)
            Mesh mesh = read_sound("nodes.gltf",
                                   gltf(known[i].nodes, normals ? POSITION_AND_NORMAL : POSITION));
            /* Without normals each triangle has its own (glTF 2.0, 3.7.2.1). */
            assert_counts(&mesh, (normals ? 4 : 12) * known[i].copies, 4 * known[i].copies);
            assert_bounds(&mesh, known[i].low, known[i].high, tolerance);
            assert_true(fabs(topology_volume(&mesh) - known[i].volume) <= tolerance);
        }
}

TEST(normals_follow_the_inverse_transpose)
{
    static const struct {
        const char *nodes;
        Vec3 first; /* of (-1, -1, -1), the normal at the origin */
    } known[] = {
        {"[{\"mesh\":0}]", {-1, -1, -1}},
        {"[{\"mesh\":0,\"scale\":[1,2,4]}]", {-1, -0.5, -0.25}},
        {"[{\"mesh\":0,\"scale\":[-1,1,1]}]", {1, -1, -1}},
        {"[{\"mesh\":0,\"rotation\":[0,0,0.70710678,0.70710678]}]", {1, -1, -1}},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        CLOSED(mesh_close)
        Mesh mesh = read_sound("normals.gltf", gltf(known[i].nodes, POSITION_AND_NORMAL));
        Vec3 expected;
        vec3_normalize(known[i].first, &expected);
        for (size_t v = 0; v < mesh.vertex_count; v++)
            if (vec3_length(vec3_from_float(mesh.vertices[v].position)) == 0)
                assert_true(topology_distance(vec3_from_float(mesh.vertices[v].normal), expected) <=
                            4 * FLT_EPSILON);
    }
}

TEST(only_missing_normals_are_computed)
{
    /* Two squares that meet at x = 1 like a roof. The normals of the second are zero, except one
     * that points up. */
    CLOSED(mesh_close)
    Mesh mesh = read_sound("roof.obj", text("v 0 0 0\nv 1 0 1\nv 1 1 1\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                                            "vn 0 0 1\nvn 0 0 0\n"
                                            "g a\nf 2 5 6 3\ng b\nf 1//2 2//1 3//1 4//1\n"));
    const double half = sqrt(0.5);
    assert_counts(&mesh, 8, 4);
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        const float *p = mesh.vertices[i].position;
        const Vec3 normal = vec3_from_float(mesh.vertices[i].normal);
        const bool zero = p[0] == 0 && p[1] == 0;
        const bool up = topology_distance(normal, (Vec3){0, 0, 1}) == 0;
        const bool left = topology_distance(normal, (Vec3){-half, 0, half}) <= FLT_EPSILON;
        const bool right = topology_distance(normal, (Vec3){half, 0, half}) <= FLT_EPSILON;
        assert_true(p[0] == 0 ? (zero ? left : up) : p[0] == 2 ? right : up || right);
    }
}

TEST(a_model_keeps_the_size_in_its_file)
{
    /* Not so small that vertices coincide, not so large that areas overflow. */
    static const char *const sizes[] = {"1e-20", "1e-6", "1e6", "1e18"};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const char *s = sizes[i];
        const double size = strtod(s, NULL);
        CLOSED(mesh_close)
        Mesh mesh =
            read_sound("size.obj", text(formatted("v 0 0 0\nv %s 0 0\nv 0 %s 0\nf 1 2 3\n", s, s)));
        assert_counts(&mesh, 3, 1);
        assert_bounds(&mesh, (Vec3){0, 0, 0}, (Vec3){size, size, 0}, size * 2 * FLT_EPSILON);
        assert_true(mesh.vertices[0].normal[2] == 1);
    }
}

int main(void)
{
    Plugin plugin = {PLUGIN_MODELS};
    if (!plugin_probe(&plugin, NULL))
        return EXIT_SKIPPED;
    return testing_run(0, "model", testing_enter_folder, testing_leave_empty_folder);
}
