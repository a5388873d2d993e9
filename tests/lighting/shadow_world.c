/* What the tests of shadows draw, and how their pictures are judged: by the exact picture of the
 * same meshes. */
#include "lighting/shadow_world.h"

#include "core/mesh_make.h"
#include "reference/picture_error.h"
#include "support/picture_check.h"
#include "support/testing.h"

static const double MOST = 1; /* step of 1/255 */

Canvas canvas;
Lighting *lighting;
Image image;

void use_way(ShadowWay way)
{
    ShadowSettings settings = SHADOWS_DEFAULT;
    settings.way = (int)way;
    lighting_use_shadows(lighting, &settings);
}

int open_all(void **state)
{
    (void)state;
    const CanvasOptions options = {.width = WIDTH, .height = HEIGHT};
    SUCCEEDS(canvas_open(&canvas, &options, message));
    SUCCEEDS(lighting_open(&lighting, &(ShaderLoader){.precision = "highp"}, message));
    SUCCEEDS(image_open(&image, WIDTH, HEIGHT, IMAGE_BYTE, message));
    use_way(SHADOWS_VOLUMES);
    return 0;
}

int close_all(void **state)
{
    (void)state;
    image_close(&image);
    lighting_close(lighting);
    canvas_close(&canvas);
    return 0;
}

void draw(const Scene *scene, bool full)
{
    picture_draw(&canvas, lighting, &(LightingFrame){.scene = scene, .full = full}, &image);
}

/* Whether at most so many pixels inside an object are farther than a step from the exact picture.
 */
bool check_wrong(const char *name, const Scene *scene, long long most)
{
    const ReferenceOptions options = {.width = WIDTH, .height = HEIGHT, .meshes = true};
    Reference exact;
    PictureError error = {.all = {0}};
    draw(scene, false);
    SUCCEEDS(reference_open(&exact, scene, &options, message));
    picture_error_add(&error, &image, &(ExactView){.exact = &exact, .scene = scene});
    const bool right = error.interior.pixels > 100 && error.interior.wrong <= most &&
                       (most > 0 || error.interior.maximum <= MOST);
    print_message("%-40s %6lld pixels inside, largest error %.3f, %lld wrong\n", name,
                  error.interior.pixels, error.interior.maximum, error.interior.wrong);
    if (!right) {
        printf("%s: at column %zu, row %zu\n", name, error.interior.worst % WIDTH,
               error.interior.worst / WIDTH);
        picture_check_keep_exact(name, &image, &exact);
    }
    reference_close(&exact);
    return right;
}

bool check(const char *name, const Scene *scene)
{
    return check_wrong(name, scene, 0);
}

Mesh ball, coarse_ring, pipe_mesh, box, plane, pot, doubled, with_t;
ShadowWorld world;

int open_meshes(void **state)
{
    (void)state;
    SUCCEEDS(mesh_sphere(&ball, 1, 24, 12, message));
    SUCCEEDS(mesh_torus(&coarse_ring, 0.35, 0.8, 7, 10, message));
    SUCCEEDS(mesh_cylinder(&pipe_mesh, (MeshCylinder){0.7, 1.5, 24, 2, MESH_CAP_NONE}, message));
    SUCCEEDS(mesh_cube(&box, 0.8, message));
    SUCCEEDS(mesh_quad(&plane, 1, message));
    SUCCEEDS(mesh_teapot(&pot, 0.8, 5, message));
    /* A square of three triangles, at one side of which a vertex lies on the others' edge; and
     * twice the same triangle, once turned over. */
    static const float places[5][3] = {
        {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0.1F, 0.1F, 0}};
    static const uint32_t of_t[9] = {0, 1, 2, 0, 4, 3, 4, 2, 3}, of_doubled[6] = {0, 1, 2, 0, 2, 1};
    SUCCEEDS(mesh_open(&with_t, 5, 9, message));
    SUCCEEDS(mesh_open(&doubled, 3, 6, message));
    for (size_t i = 0; i < 5; i++) {
        const MeshVertex vertex = {{places[i][0], places[i][1], places[i][2]}, {0, 0, 1}};
        with_t.vertices[i] = vertex;
        if (i < 3)
            doubled.vertices[i] = vertex;
    }
    memcpy(with_t.indices, of_t, sizeof of_t);
    memcpy(doubled.indices, of_doubled, sizeof of_doubled);
    return 0;
}

int close_meshes(void **state)
{
    (void)state;
    Mesh *const all[] = {&ball, &coarse_ring, &pipe_mesh, &box, &plane, &pot, &doubled, &with_t};
    for (int i = 0; i < 8; i++)
        mesh_close(all[i]);
    lighting_forget(lighting, NULL);
    return 0;
}

void make_world(const Mesh *mesh)
{
    const Material grey = {{0.3, 0.3, 0.3}, {0.6, 0.6, 0.5}, {0.2, 0.2, 0.2}, {0, 0, 0}, 1, 10};
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    memset(&world, 0, sizeof world);
    world.lights[0] = (Light){.kind = LIGHT_POINT,
                              .shadows = true,
                              .position = {1.1, 3.2, 1.7},
                              .ambient = {0.1, 0.1, 0.1},
                              .diffuse = {1, 0.9, 0.8},
                              .specular = {0.3, 0.3, 0.3}};
    world.objects[0] = (Object){.mesh = mesh,
                                .closed = mesh == &ball || mesh == &box || mesh == &coarse_ring,
                                .flat = mesh == &box || mesh == &doubled || mesh == &with_t,
                                .world_from_object = mat4_identity(),
                                .front = grey,
                                .back = grey};
    if (mesh == &ball)
        world.objects[0].solid = (Solid){.kind = SOLID_SPHERE, .radius = 1};
    world.objects[1] = (Object){.mesh = &plane,
                                .solid = {.kind = SOLID_QUAD},
                                .flat = true,
                                .world_from_object =
                                    mat4_product(mat4_translate((Vec3){0, -1.2, 0}),
                                                 mat4_product(lying, mat4_scale((Vec3){4, 4, 4}))),
                                .front = grey};
    world.scene = (Scene){.camera = {{0.3, 2.4, 5}, {0, -0.2, 0}, {0, 1, 0}, 45, 0.5, 30, 0},
                          .background = {0.1, 0.2, 0.3},
                          .global_ambient = {0.2, 0.2, 0.2},
                          .lights = world.lights,
                          .light_count = 1,
                          .objects = world.objects,
                          .object_count = 2};
}

void turn_first(Mat4 matrix)
{
    world.objects[0].world_from_object = matrix;
}

void make_eight_lights(void)
{
    make_world(&ball);
    world.objects[2] = world.objects[0];
    world.objects[2].world_from_object =
        mat4_product(mat4_translate((Vec3){-0.5, 1.4, -0.9}), mat4_scale((Vec3){0.4, 0.4, 0.4}));
    world.scene.object_count = 3;
    world.scene.light_count = 8;
    for (int i = 0; i < 8; i++) {
        world.lights[i] = world.lights[0];
        world.lights[i].position = (Vec3){3 - 0.8 * i, 4, 1.5};
        world.lights[i].diffuse = (Vec3){0.1, 0.02 * i, 0.1};
    }
}
