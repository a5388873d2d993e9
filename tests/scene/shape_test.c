/*
 * The shapes of the examples: centred, upright, of the stated size, and models moved into that.
 */
#include "scene/shape.h"
#include "support/testing.h"

/* The box of what is drawn, in the world, and the largest distance from the origin. */
typedef struct Extent {
    Vec3 low, high;
    double radius;
} Extent;

static Extent extent_of(const Shape *shape)
{
    const Material material = {.alpha = 1};
    const Object object = shape_object(shape, mat4_identity(), material);
    Extent extent = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    assert_ptr_equal(object.mesh, &shape->mesh);
    for (size_t i = 0; i < shape->mesh.vertex_count; i++) {
        const Vec3 p = mat4_transform_point(object.world_from_object,
                                            vec3_from_float(shape->mesh.vertices[i].position));
        extent.low =
            (Vec3){fmin(extent.low.x, p.x), fmin(extent.low.y, p.y), fmin(extent.low.z, p.z)};
        extent.high =
            (Vec3){fmax(extent.high.x, p.x), fmax(extent.high.y, p.y), fmax(extent.high.z, p.z)};
        extent.radius = fmax(extent.radius, vec3_length(p));
    }
    return extent;
}

/* Half the extents of the lecture's along x, y and z, and of the textbook's. The spout and handle,
 * lid and base of the lecture's teapot are not the same size. */
static const struct {
    Vec3 lecture, textbook;
} HALVES[SHAPE_HEAD_FACETED] = {
    [SHAPE_CUBE] = {{1, 1, 1}, {0.5, 0.5, 0.5}},
    [SHAPE_SPHERE] = {{1, 1, 1}, {0.5, 0.5, 0.5}},
    [SHAPE_TEAPOT] = {{1.287, 0.63, 0.8}, {0.803516, 0.39375, 0.5}},
    [SHAPE_TORUS] = {{1, 1.0 / 3, 1}, {0.5, 1.0 / 6, 0.5}},
    [SHAPE_CONE] = {{0.8, 0.96, 0.8}, {0.5, 0.6, 0.5}},
    [SHAPE_CYLINDER] = {{0.8, 0.8, 0.8}, {0.5, 0.5, 0.5}},
    [SHAPE_TETRAHEDRON] = {{0.57735, 0.57735, 0.57735}, {0.288675, 0.288675, 0.288675}},
    [SHAPE_OCTAHEDRON] = {{1, 1, 1}, {0.5, 0.5, 0.5}},
    [SHAPE_DODECAHEDRON] = {{0.934172, 0.934172, 0.934172}, {0.467086, 0.467086, 0.467086}},
    [SHAPE_ICOSAHEDRON] = {{0.850651, 0.850651, 0.850651}, {0.425325, 0.425325, 0.425325}},
};

TEST(shapes_are_centred_and_of_their_size)
{
    for (int style = SHAPE_LECTURE; style <= SHAPE_TEXTBOOK; style++)
        for (int kind = 0; kind < SHAPE_HEAD_FACETED; kind++) {
            CLOSED(shape_close) Shape shape;
            SUCCEEDS(shape_open(&shape, (ShapeKind)kind, (ShapeStyle)style, NULL, message));
            const Extent extent = extent_of(&shape);
            const Vec3 half = style == SHAPE_LECTURE ? HALVES[kind].lecture : HALVES[kind].textbook;
            const double aside = kind == SHAPE_TEAPOT && style == SHAPE_LECTURE ? 0.1 : 1e-6;
            for (int k = 0; k < 3; k++) {
                const double low = (&extent.low.x)[k], high = (&extent.high.x)[k];
                assert_true(fabs(low + high) / 2 <= aside);
                assert_true(fabs((high - low) / 2 - (&half.x)[k]) < 1e-3);
            }
            assert_true(extent.radius < (style == SHAPE_LECTURE ? 1.74 : 0.87));
        }
}

/* With divisions, a shape that has a formula has its mesh of that fineness. */
TEST(shapes_are_refined)
{
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        CLOSED(shape_close) Shape usual, fine, fewest;
        CLOSED(mesh_close) Mesh mesh;
        SUCCEEDS(shape_open(&usual, (ShapeKind)kind, SHAPE_TEXTBOOK, NULL, message));
        SUCCEEDS(shape_open(&fine, (ShapeKind)kind, SHAPE_TEXTBOOK, &(ShapeModel){NULL, 0, 48},
                            message));
        SUCCEEDS(shape_open(&fewest, (ShapeKind)kind, SHAPE_TEXTBOOK, &(ShapeModel){NULL, 0, 1},
                            message));
        mesh = (Mesh){.vertices = NULL};
        if (usual.solid.kind != SOLID_NONE)
            SUCCEEDS(solid_mesh(&usual.solid, 48, &mesh, message));
        assert_int_equal(fine.mesh.index_count,
                         mesh.index_count ? mesh.index_count : usual.mesh.index_count);
        assert_true(fewest.mesh.index_count <= fine.mesh.index_count);
        assert_memory_equal(&fine.placed, &usual.placed, sizeof fine.placed);
    }
}

/* The axis of a cone points up: its apex is on top, and its base below. */
TEST(shapes_are_upright)
{
    CLOSED(shape_close) Shape cone;
    SUCCEEDS(shape_open(&cone, SHAPE_CONE, SHAPE_LECTURE, NULL, message));
    for (size_t i = 0; i < cone.mesh.vertex_count; i++) {
        const Vec3 p =
            mat4_transform_point(cone.placed, vec3_from_float(cone.mesh.vertices[i].position));
        const double radius = 0.8 * (0.96 - p.y) / 1.92; /* of the mantle */
        assert_true(hypot(p.x, p.z) < radius + 1e-6);
    }
    assert_true(mat4_determinant(cone.placed) > 0); /* not mirrored */
}

/* What is said of the shape is so: three equal normals, or a mesh on the solid's surface. */
TEST(flat_shapes_and_solids_are_what_they_say)
{
    for (int kind = 0; kind < SHAPE_HEAD_FACETED; kind++) {
        CLOSED(shape_close) Shape shape;
        SUCCEEDS(shape_open(&shape, (ShapeKind)kind, SHAPE_TEXTBOOK, NULL, message));
        const Mesh *mesh = &shape.mesh;
        bool equal = true;
        for (size_t i = 0; i < mesh->index_count; i++) {
            const float *n = mesh->vertices[mesh->indices[i]].normal;
            const float *first = mesh->vertices[mesh->indices[i - i % 3]].normal;
            equal &= n[0] == first[0] && n[1] == first[1] && n[2] == first[2];
        }
        assert_true(equal == shape.flat);
        assert_true(shape.solid.kind == SOLID_NONE || shape.solid.radius > 0);
        assert_true(shape.closed == (kind != SHAPE_TEAPOT));
    }
}

/* Wherever the model is, and however large. */
FOLDER_TEST(a_model_fills_the_sphere)
{
    static const char text[] = "v 100 200 300\nv 700 200 300\nv 100 500 300\nv 100 200 500\n"
                               "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    for (int i = 0; i < 4; i++) {
        const ShapeStyle style = i % 2 ? SHAPE_TEXTBOOK : SHAPE_LECTURE;
        const bool open = i > 1; /* the last triangle is left out */
        CLOSED(shape_close) Shape shape;
        Message message = {0};
        testing_write("model.obj", text, sizeof text - 1 - (open ? 8 : 0));
        if (!shape_open(&shape, SHAPE_CUBE, style, &(ShapeModel){"model.obj", 0, 0}, &message)) {
            print_message("%s\n", message.text); /* built without Assimp */
            skip();
        }
        const double half = style == SHAPE_LECTURE ? 1 : 0.5; /* of the diagonal, 600, 300, 200 */
        const Extent extent = extent_of(&shape);
        assert_true(fabs(extent.high.x - half * 6 / 7) < 1e-6);
        assert_true(fabs(extent.high.y - half * 3 / 7) < 1e-6);
        assert_true(fabs(extent.low.z + half * 2 / 7) < 1e-6);
        assert_true(extent.radius < half + 1e-6);
        assert_true(shape.closed != open && !shape.flat);
    }
    Shape shape;
    Message message = {0};
    assert_false(
        shape_open(&shape, SHAPE_CUBE, SHAPE_LECTURE, &(ShapeModel){"none.obj", 0, 0}, &message));
    assert_true(message.text[0]);
}

TEST(a_kind_that_does_not_exist_is_refused)
{
    Shape shape;
    FAILS(shape_open(&shape, SHAPE_COUNT, SHAPE_LECTURE, NULL, message), "shape 13: there is none");
    shape_close(NULL);
}

TEST_MAIN("shape", NULL, NULL)
