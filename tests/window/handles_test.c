/*
 * The points of lights in a picture: where they are, and where the lights go that are dragged.
 */
#include "support/testing.h"
#include "window/handles.h"

static const int PLACE[4] = {40, 10, 300, 200};
static Light lights[4];
static Scene scene;

static void set_up(void)
{
    lights[0] = (Light){.kind = LIGHT_POINT, .position = {0, 1, 1.5}};
    lights[1] = (Light){.kind = LIGHT_DIRECTIONAL, .direction = {1, 1, 0.5}};
    lights[2] = (Light){.kind = LIGHT_POINT, .space = LIGHT_EYE, .position = {0, 0, -1}};
    lights[3] = (Light){.kind = LIGHT_SPOT, .position = {4, 2, 6.1}}; /* behind the eye */
    scene =
        (Scene){.camera = {.eye = {2, 1, 3}, .up = {0, 1, 0}, .fovy = 50, .near = 1, .far = 100},
                .lights = lights,
                .light_count = 4};
}

/* By the matrices of the camera that draws. */
static void pixel_of(Vec3 point, double *x, double *y)
{
    Mat4 eye_from_world, clip_from_eye;
    SUCCEEDS(scene_camera(&scene.camera, (double)PLACE[2] / PLACE[3], &eye_from_world,
                          &clip_from_eye, message));
    const Vec4 clip = mat4_transform(mat4_product(clip_from_eye, eye_from_world),
                                     (Vec4){point.x, point.y, point.z, 1});
    *x = PLACE[0] + (1 + clip.x / clip.w) / 2 * PLACE[2];
    *y = PLACE[1] + (1 - clip.y / clip.w) / 2 * PLACE[3];
}

static double depth_of(Vec3 point)
{
    return vec3_dot(vec3_subtract(scene.camera.eye, point), vec3_unit(scene.camera.eye));
}

TEST(handles_are_where_lights_are_drawn)
{
    Handle handles[HANDLES_MAX];
    set_up();
    assert_int_equal(handles_add(handles, 0, &scene, 5, PLACE), 2);
    for (int i = 0; i < 2; i++) {
        double x, y;
        pixel_of(i == 0 ? lights[0].position : lights[1].direction, &x, &y);
        assert_int_equal(handles[i].light, i);
        assert_int_equal(handles[i].view, 5);
        float ring[3];
        handles_ring(&scene.camera, PLACE,
                     (Sphere){i ? lights[1].direction : lights[0].position, 1}, ring);
        assert_true(fabs((double)ring[0] - x) + fabs((double)ring[1] - y) < 1e-3 && ring[2] > 0);
        assert_true(fabs(handles[i].x - x) < 1e-9 && fabs(handles[i].y - y) < 1e-9);
        assert_ptr_equal(handles_find(handles, 2, x + 3, y - 4, 5.001), &handles[i]);
        assert_null(handles_find(handles, 2, x + 3, y - 4, 4.999));
    }
    assert_int_equal(handles_add(handles, HANDLES_MAX - 1, &scene, 5, PLACE), HANDLES_MAX);
    scene.camera.up = scene.camera.eye;
    assert_int_equal(handles_add(handles, 3, &scene, 5, PLACE), 3);
}

TEST(a_point_light_follows_the_pointer_in_a_plane)
{
    set_up();
    for (int i = 0; i < 2; i++) { /* near, and a million times as far */
        const double far = i == 0 ? 1 : 1e6;
        scene.camera.eye = vec3_scale((Vec3){2, 1, 3}, far);
        scene.camera.far = 100 * far;
        lights[0].position = vec3_scale((Vec3){0, 1, 1.5}, far);
        for (double x = 45; x < 340; x += 17)
            for (double y = 12; y < 210; y += 13) {
                double seen_x, seen_y;
                Vec3 at;
                assert_true(handle_drag(&scene, PLACE, 0, x, y, &at));
                pixel_of(at, &seen_x, &seen_y);
                assert_true(fabs(seen_x - x) < 1 && fabs(seen_y - y) < 1);
                assert_true(fabs(depth_of(at) - depth_of(lights[0].position)) < 0.01 * far);
                assert_true(fabs(at.x * 100 - round(at.x * 100)) < 1e-9 || far > 1);
            }
    }
}

TEST(a_directional_light_turns)
{
    int followed = 0;
    set_up();
    for (double x = 45; x < 340; x += 17)
        for (double y = 12; y < 210; y += 13) {
            double seen_x, seen_y;
            Vec3 at;
            assert_true(handle_drag(&scene, PLACE, 1, x, y, &at));
            assert_true(fabs(vec3_length(at) - 1.5) < 0.01);
            pixel_of(at, &seen_x, &seen_y);
            followed += fabs(seen_x - x) < 1.5 && fabs(seen_y - y) < 1.5;
            /* The hemisphere that it was in, towards the eye. */
            assert_true(depth_of(at) < depth_of((Vec3){0, 0, 0}) + 0.05);
        }
    assert_true(followed > 100);
}

TEST(what_has_no_handle_is_not_dragged)
{
    Vec3 at;
    set_up();
    assert_false(handle_drag(&scene, PLACE, -1, 100, 100, &at));
    assert_false(handle_drag(&scene, PLACE, 4, 100, 100, &at));
    assert_false(handle_drag(&scene, PLACE, 2, 100, 100, &at)); /* the viewer's */
    assert_false(handle_drag(&scene, PLACE, 3, 100, 100, &at)); /* behind the eye */
    assert_false(handle_drag(&scene, PLACE, 0, NAN, 100, &at));
    lights[0].position = scene.camera.eye;
    assert_false(handle_drag(&scene, PLACE, 0, 100, 100, &at));
}

int main(void)
{
    return testing_run(0, "handles", NULL, NULL);
}
