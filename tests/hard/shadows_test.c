/*
 * Hard cases of shadows: those of examples/study, drawn in every way, and what they depend on,
 * varied: where the eye and the far plane are, how wide a slit and how coarse a sphere is, how far
 * the origin is, how the object is mirrored.
 */
#include "hard/hard.h"
#include "study/cases/hard_case.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 40, MIN_PIXELS = 200 };

/* Of light, eye and surface: see oracle_mediump_max. The nearest light is 1.3 from a surface, which
 * is within 8 of the eye. */
static const double REACH = 16;

static HardScene made;

static void open_scene(const char *name)
{
    for (int i = 0; i < HARD_SHADOW_COUNT; i++) {
        if (strcmp(HARD_SHADOWS[i].name, name) != 0)
            continue;
        SUCCEEDS(hard_scene_open(&made, &HARD_SHADOWS[i], message));
        return;
    }
    fail_msg("%s: no hard case of shadows", name);
}

FIXTURE(close_scene)
{
    hard_forget(NULL);
    hard_scene_close(&made);
}

/* Pixels in parts of which a light arrives otherwise: the exact picture's nine samples may miss a
 * corner of a facet that is in its own shadow (reference_pixel.h), and the driver, whose corners
 * lie on a grid, may see that at the center. */
static void leave_out_edges(const Scene *scene, unsigned char unsure[SIZE * SIZE])
{
    enum { PARTS = 3 };
    const ReferenceOptions options = {
        .width = PARTS * SIZE, .height = PARTS * SIZE, .meshes = true, .centers = true};
    CLOSED(reference_close) Reference fine;
    SUCCEEDS(reference_open(&fine, scene, &options, message));
    memset(unsure, 0, SIZE * SIZE);
    for (int y = 0; y < fine.height; y++)
        for (int x = 0; x < fine.width; x++) {
            const int pixel = y / PARTS * SIZE + x / PARTS;
            const int center = (y / PARTS * PARTS + 1) * fine.width + x / PARTS * PARTS + 1;
            unsure[pixel] |= fine.lights[y * fine.width + x] != fine.lights[center];
        }
}

static unsigned char unsure[SIZE * SIZE]; /* of the scene that is checked */

static void check_way(const char *name, Interpolation interpolation, HardPrecision precision,
                      double max)
{
    CLOSED(reference_close) Reference exact;
    made.scene.interpolation = interpolation;
    hard_exact(&made.scene, &exact);
    for (int i = 0; i < SIZE * SIZE; i++)
        exact.interior[i] &= !unsure[i];
    hard_check_exact(name, &made.scene, (HardBound){precision, max, MIN_PIXELS}, &exact);
}

/* By volumes: without the highlight, whose error in mediump depends on angles, in both precisions
 * at the vertices and the fragments; with it in highp. See hard_check_reflections for the bounds.
 */
static void check(const char *name)
{
    leave_out_edges(&made.scene, unsure);
    check_way(name, INTERPOLATION_PHONG, HARD_HIGHP, 1);
    for (int i = 0; i < made.scene.object_count; i++)
        made.objects[i].front.specular = made.objects[i].back.specular = (Vec3){0, 0, 0};
    const double most = oracle_mediump_max(&made.scene, REACH);
    check_way(name, INTERPOLATION_PHONG, HARD_MEDIUMP, most);
    check_way(name, INTERPOLATION_GOURAUD, HARD_HIGHP, 1);
    check_way(name, INTERPOLATION_GOURAUD, HARD_MEDIUMP, 1.5);
}

TEST_WITH(0, every_case_is_exact_in_every_way, NULL, close_scene)
{
    for (int i = 0; i < HARD_SHADOW_COUNT; i++) {
        open_scene(HARD_SHADOWS[i].name);
        check(HARD_SHADOWS[i].name);
        close_scene(NULL);
    }
    hard_report("shadows");
}

/* One more picture of a case that was changed. */
static void check_varied(const char *name, double value)
{
    char full_name[64];
    snprintf(full_name, sizeof full_name, "%s %g", name, value);
    ShadowSettings settings = SHADOWS_DEFAULT;
    settings.way = SHADOWS_VOLUMES;
    for (int i = 0; i < 2; i++)
        lighting_use_shadows(hard.lightings[i], &settings);
    leave_out_edges(&made.scene, unsure);
    check_way(name, INTERPOLATION_PHONG, HARD_HIGHP, 1);
}

/* Out of the roof's shadow into it; the near plane is on its edge before the eye is. */
TEST_WITH(0, the_eye_may_be_anywhere_about_a_volume, NULL, close_scene)
{
    const int step = testing_step(3);
    open_scene("eye-in-shadow");
    for (int i = 0; i <= 12; i += step) {
        made.scene.camera.eye = (Vec3){0.4 * i, 1.6 + 0.1 * i, 4.6 + 0.05 * i};
        made.scene.camera.near = i % 2 ? 1 : 0.05;
        check_varied("eye", i);
    }
}

/* Before and behind what the volume ends at; before that of the floor, which it cuts, too. */
TEST_WITH(0, the_far_plane_may_be_anywhere, NULL, close_scene)
{
    static const double all[] = {6, 7, 8.5, 12, 30, 1000};
    open_scene("far-plane");
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        made.scene.camera.far = all[i];
        check_varied("far plane", all[i]);
    }
}

/* Down to a width that floats still tell apart, and none. */
TEST_WITH(0, a_slit_may_have_any_width, NULL, close_scene)
{
    static const double widths[] = {0.3, 0.08, 0.01, 1e-4, 1e-6, 0};
    open_scene("slit");
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        for (int k = 0; k < 2; k++)
            made.objects[2 * k].world_from_object.m[12] = (k ? 0.5 : -0.5) * (1 + widths[i]);
        check_varied("slit", widths[i]);
    }
}

TEST_WITH(0, a_plate_may_be_as_thin_and_as_near_as_floats_tell, NULL, close_scene)
{
    static const double sizes[] = {0.08, 1e-3, 1e-6};
    open_scene("peter-panning");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        made.objects[0].world_from_object.m[10] = sizes[i];
        made.objects[0].world_from_object.m[13] = sizes[i];
        check_varied("plate", sizes[i]);
    }
}

/* From light that comes from above to light that is parallel to the floor, nearly. */
TEST_WITH(0, light_may_graze, NULL, close_scene)
{
    static const double heights[] = {1, 0.3, 0.1, 0.03, 0.01, 1e-4};
    const size_t step = (size_t)testing_step(3);
    open_scene("acne");
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i += step) {
        made.lights[0].direction.y = heights[i];
        check_varied("height", heights[i]);
    }
}

/* Mirrored by any axis and turned over; seen and lit from either side. */
TEST_WITH(0, occluders_may_be_mirrored_and_open, NULL, close_scene)
{
    static const char *const names[] = {"sheet", "turned"};
    const int step = testing_step(3);
    for (int n = 0; n < 2; n++) {
        open_scene(names[n]);
        const Mat4 usual = made.objects[0].world_from_object;
        for (int way = n; way < 8; way += step) {
            made.objects[0].world_from_object =
                mat4_product(usual, mat4_scale((Vec3){way & 1 ? -1 : 1, 1, way & 2 ? -1 : 1}));
            made.objects[0].clockwise = way & 4;
            if (way & 4) { /* its mesh is not: then back faces are seen */
                made.objects[0].closed = false;
                made.objects[0].back = made.objects[0].front;
                made.objects[0].two_sided = true;
            }
            check_varied(names[n], way);
        }
        close_scene(NULL);
    }
}

HARD_TEST_MAIN("hard shadows", SIZE)
