/*
 * The edges of faces: which there are, and that a surface drawn behind its lines leaves them whole;
 * and lines along normals.
 */
#include "core/canvas.h"
#include "core/mesh_make.h"
#include "lighting/lighting.h"
#include "scene/overlay.h"
#include "shapes/mesh_solids.h"
#include "support/picture_check.h"
#include "support/testing.h"

static const Vec3 BLACK = {0, 0, 0};

/* Closes the mesh. */
static int edges_of_made(Mesh *mesh, bool made)
{
    require(made, FAILURE);
    CLOSED(overlay_list_close) OverlayList list = {.count = 0};
    overlay_add_edges(&list, mesh, mat4_identity(), BLACK);
    assert_false(list.failed);
    assert_int_equal(list.count % 2, 0);
    const int count = list.count / 2;
    mesh_close(mesh);
    return count;
}

static OverlayList normals_of(const Object *object, Interpolation interpolation)
{
    OverlayList list = {.count = 0};
    overlay_add_normals(
        &list, &(Scene){.objects = object, .object_count = 1, .interpolation = interpolation});
    assert_false(list.failed);
    return list;
}

static Vec3 line_of(const OverlayList *list, int number)
{
    return vec3_subtract(vec3_from_float(list->vertices[2 * number + 1].position),
                         vec3_from_float(list->vertices[2 * number].position));
}

/* Whatever the object is turned and scaled by; wrong ones are not; a back has the opposite ones. */
TEST(normals_are_perpendicular_to_the_face_and_a_back_has_its_own)
{
    CLOSED(mesh_close) Mesh quad;
    SUCCEEDS(mesh_quad(&quad, 2, message));
    const Mat4 shear = {{1, 0, 0.5, 0, 0.25, 2, 0, 0, 0, 0, 3, 0, 1, 2, 3, 1}};
    Object object = {.mesh = &quad, .world_from_object = shear};
    for (int way = 0; way < 4; way++) {
        object.wrong_normals = way == 1;
        object.two_sided = way == 2;
        CLOSED(overlay_list_close)
        OverlayList list =
            normals_of(&object, way == 3 ? INTERPOLATION_FLAT : INTERPOLATION_GOURAUD);
        const int lines = way == 2 ? 18 : way == 3 ? 8 : 9; /* vertices; triangles */
        assert_int_equal(list.count, 2 * lines);
        for (int i = 0; i < lines; i++) {
            const Vec3 line = line_of(&list, i), across = {1, 0, 0.5};
            const double turned = vec3_dot(line, across) / vec3_length(line);
            assert_true(way == 1 ? turned > 0.1 : fabs(turned) < 1e-6);
            assert_true(way == 2 && i % 2 ? line.z < 0 : line.z > 0);
        }
    }
}

TEST(solids_have_the_edges_of_their_faces)
{
    Mesh m;
    assert_int_equal(edges_of_made(&m, mesh_cube(&m, 1, FAILURE)), 12);
    assert_int_equal(edges_of_made(&m, mesh_regular(&m, MESH_TETRAHEDRON, 1, FAILURE)), 6);
    assert_int_equal(edges_of_made(&m, mesh_regular(&m, MESH_OCTAHEDRON, 1, FAILURE)), 12);
    assert_int_equal(edges_of_made(&m, mesh_regular(&m, MESH_DODECAHEDRON, 1, FAILURE)),
                     30); /* of pentagons */
    assert_int_equal(edges_of_made(&m, mesh_regular(&m, MESH_ICOSAHEDRON, 1, FAILURE)), 30);
}

/* A flat square is one face, however often it is divided: of the lines within it none is an edge;
 * each side of the outline is in as many parts. */
TEST(a_divided_square_has_its_outline)
{
    Mesh m;
    for (int divisions = 1; divisions <= 8; divisions++)
        assert_int_equal(edges_of_made(&m, mesh_quad(&m, divisions, FAILURE)), 4 * divisions);
}

/* Circles of latitude without the poles, and meridians. */
TEST(a_sphere_has_the_sides_of_its_quadrilaterals)
{
    static const int sizes[][2] = {{3, 2}, {8, 4}, {20, 20}, {64, 32}};
    Mesh m;
    for (int i = 0; i < 4; i++) {
        const int slices = sizes[i][0], stacks = sizes[i][1];
        assert_int_equal(edges_of_made(&m, mesh_sphere(&m, 4, slices, stacks, FAILURE)),
                         slices * (stacks - 1) + slices * stacks);
    }
    SUCCEEDS(mesh_sphere(&m, 4, 8, 4, message) && mesh_flatten(&m, message));
    assert_int_equal(edges_of_made(&m, true), 56); /* triangles with vertices of their own, too */
}

TEST(an_open_cylinder_has_rings_and_lines)
{
    Mesh m;
    assert_int_equal(
        edges_of_made(&m, mesh_cylinder(&m, (MeshCylinder){4, 2.5, 16, 1, MESH_CAP_NONE}, FAILURE)),
        2 * 16 + 16);
}

/* Zero has two signs, which are one place; triangles without area have no edges. */
TEST(equal_places_are_one_corner)
{
    static const float corners[6][3] = {{0, 0, 0},     {1, 0.5F, 0}, {0, 1, 0},
                                        {-0.0F, 0, 0}, {0, 1, 0},    {-1, 0.5F, 0}};
    Mesh m;
    SUCCEEDS(mesh_open(&m, 6, 9, message));
    for (uint32_t i = 0; i < 6; i++) {
        memcpy(m.vertices[i].position, corners[i], sizeof corners[i]);
        m.indices[i] = i;
    }
    for (uint32_t i = 6; i < 9; i++)
        m.indices[i] = i % 2;
    assert_int_equal(edges_of_made(&m, true), 4);
}

/* Two faces that fold back on each other share a side, which is one. */
TEST(a_fold_is_an_edge)
{
    static const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0.5F, 1, 0}, {0.5F, 0.5F, 0}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 1, 3};
    Mesh m;
    SUCCEEDS(mesh_open(&m, 4, 6, message));
    for (uint32_t i = 0; i < 4; i++)
        memcpy(m.vertices[i].position, corners[i], sizeof corners[i]);
    memcpy(m.indices, indices, sizeof indices);
    m.indices[4] = 3, m.indices[5] = 1; /* clockwise */
    assert_int_equal(edges_of_made(&m, true), 5);
}

/* A light without a position is where its direction, as given, leads from the origin. */
TEST(lights_are_marked_where_they_are)
{
    const Light lights[] = {
        {.direction = {1, 2, 3}, .position = {9, 9, 9}},
        {.kind = LIGHT_POINT, .direction = {9, 9, 9}, .position = {4, 5, 6}},
        {.kind = LIGHT_SPOT, .direction = {0, 1, 0}, .position = {7, 8, 9}, .off = true}};
    const Scene scene = {.lights = lights, .light_count = 3};
    CLOSED(overlay_list_close) OverlayList list = {.count = 0};
    overlay_add_lights(&list, &scene);
    const Vec3 places[] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    assert_int_equal(list.count, 3);
    for (int i = 0; i < 3; i++) {
        const Vec3 place = vec3_from_float(list.vertices[i].position);
        assert_true(vec3_length(vec3_subtract(place, places[i])) == 0);
        assert_int_equal(list.vertices[i].color[0] == 1, i < 2);
    }
}

/* Drawn. */

/* The triangles that face the eye. */
static void open_facing(Mesh *facing, const Mesh *mesh, Vec3 eye)
{
    size_t count = 0;
    SUCCEEDS(mesh_copy(facing, mesh, message));
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        Vec3 normal;
        const Vec3 place = vec3_from_float(mesh->vertices[mesh->indices[i]].position);
        if (!mesh_face(mesh, i / 3, &normal) || vec3_dot(normal, vec3_subtract(eye, place)) <= 0)
            continue;
        memcpy(&facing->indices[count], &mesh->indices[i], 3 * sizeof *mesh->indices);
        count += 3;
    }
    facing->index_count = count;
}

static void draw_lines(const Canvas *canvas, const Overlay *overlay, const Mesh *mesh,
                       const Scene *scene, Image *image)
{
    CLOSED(overlay_list_close) OverlayList list = {.count = 0};
    overlay_add_edges(&list, mesh, mat4_identity(), BLACK);
    SUCCEEDS(overlay_draw(overlay, &list, scene, 1, message) &&
             canvas_read(canvas, image, message));
}

static bool is_black(const Image *image, int i)
{
    const unsigned char *p = (const unsigned char *)image->pixels + 4 * i;
    return p[0] == 0 && p[1] == 0 && p[2] == 0;
}

/* SmoothFlat's sphere and camera. Each pixel that a facing edge covers where nothing hides it is
 * black where the surface is. */
static void check_size(int size, int slices, int stacks, bool offset, int *covered, int *missing)
{
    CLOSED(canvas_close) Canvas canvas;
    CLOSED(overlay_close) Overlay overlay;
    CLOSED(image_close) Image edges = {.width = 0};
    CLOSED(image_close) Image picture = {.width = 0};
    CLOSED(mesh_close) Mesh mesh;
    CLOSED(mesh_close) Mesh facing;
    Lighting *lighting = NULL;
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = size, .height = size}, message) &&
             overlay_open(&overlay, &(ShaderLoader){0}, message) &&
             lighting_open(&lighting, &(ShaderLoader){0}, message) &&
             image_open(&edges, size, size, IMAGE_BYTE, message) &&
             image_open(&picture, size, size, IMAGE_BYTE, message) &&
             mesh_sphere(&mesh, 4, slices, stacks, message));
    const Object object = {.mesh = &mesh,
                           .closed = true,
                           .behind_lines = offset,
                           .world_from_object = mat4_identity(),
                           .front = {.emission = {0.5, 0.5, 0.5}, .alpha = 1}};
    const Scene scene = {
        .camera = {.eye = {6, 11, 27}, .up = {0, 1, 0}, .fovy = 18.9, .near = 20, .far = 40},
        .objects = &object,
        .object_count = 1};
    open_facing(&facing, &mesh, scene.camera.eye);
    canvas_clear(&canvas, (Vec3){1, 1, 1}, 1);
    glDisable(GL_DEPTH_TEST);
    draw_lines(&canvas, &overlay, &facing, &scene, &edges);
    canvas_clear(&canvas, (Vec3){1, 1, 1}, 1);
    SUCCEEDS(lighting_show(lighting, &(LightingFrame){.scene = &scene, .aspect = 1}, message));
    draw_lines(&canvas, &overlay, &mesh, &scene, &picture);
    *covered = *missing = 0;
    for (int i = 0; i < size * size; i++) {
        *covered += is_black(&edges, i);
        *missing += is_black(&edges, i) && !is_black(&picture, i);
    }
    lighting_close(lighting);
}

TEST(edges_have_no_gaps)
{
    static const int sizes[] = {64, 150, 300, 400, 777};
    int covered, missing;
    if (!picture_check_driver("overlay"))
        skip();
    for (int i = 0; i < 5; i++) {
        check_size(sizes[i], 8, 4, true, &covered, &missing);
        assert_true(covered > 5 * sizes[i]);
        assert_int_equal(missing, 0);
    }
    check_size(300, 24, 12, true, &covered, &missing);
    assert_int_equal(missing, 0);
    /* Without the offset there are gaps: this test sees them. */
    check_size(300, 8, 4, false, &covered, &missing);
    assert_true(missing > covered / 20);
}

TEST_MAIN("overlay", NULL, NULL)
