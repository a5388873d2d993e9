/*
 * The plan of a frame: made once, and again only where what it depends on has changed; a picture
 * drawn from a plan that was refreshed is the one that a new plan draws, byte by byte. In a frame
 * without decisions nothing is allocated, no program's text written, and nothing looked up by name.
 */
#include "base/random.h"
#include "core/canvas.h"
#include "lighting/lighting.h"
#include "shapes/mesh_solids.h"
#include "support/testing.h"

enum { SIZE = 48, OBJECTS = 4, LIGHTS = 3, PIXELS = 4 * SIZE * SIZE };

static Canvas canvas;
static Lighting *lighting;
static Image image;
static Mesh ball, cube, floor_mesh;
static LightingPlan plan;

static struct {
    Light lights[LIGHTS];
    Object objects[OBJECTS];
    Scene scene;
} world;

/* The linker sends this program's own calls here: those of the driver are not counted. */
static long long allocations, lookups;
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);

void *__wrap_malloc(size_t size)
{
    allocations++;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    allocations++;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *block, size_t size)
{
    allocations++;
    return __real_realloc(block, size);
}

static PFNGLGETUNIFORMLOCATIONPROC real_uniform;
static PFNGLGETATTRIBLOCATIONPROC real_attribute;

static GLint GL_APIENTRY counted_uniform(GLuint program, const GLchar *name)
{
    lookups++;
    return real_uniform(program, name);
}

static GLint GL_APIENTRY counted_attribute(GLuint program, const GLchar *name)
{
    lookups++;
    return real_attribute(program, name);
}

FIXTURE(open_all)
{
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message) &&
             lighting_open(&lighting, &(ShaderLoader){0}, message) &&
             image_open(&image, SIZE, SIZE, IMAGE_BYTE, message) &&
             mesh_sphere(&ball, 0.5, 16, 8, message) && mesh_cube(&cube, 0.4, message) &&
             mesh_quad(&floor_mesh, 1, message));
    real_uniform = glGetUniformLocation;
    real_attribute = glGetAttribLocation;
    glGetUniformLocation = counted_uniform;
    glGetAttribLocation = counted_attribute;
}

FIXTURE(close_all)
{
    lighting_plan_close(&plan);
    image_close(&image);
    lighting_close(lighting);
    mesh_close(&ball);
    mesh_close(&cube);
    mesh_close(&floor_mesh);
    canvas_close(&canvas);
}

/* A ball and two boxes over a floor, in the light of a point, a spot and the sun. */
FIXTURE(make_world)
{
    const Material grey = {{0.2, 0.2, 0.2}, {0.5, 0.4, 0.3}, {0.3, 0.3, 0.3}, {0, 0, 0}, 1, 20};
    memset(&world, 0, sizeof world);
    for (int i = 0; i < OBJECTS; i++)
        world.objects[i] = (Object){
            .mesh = i == 0 ? &ball : &cube,
            .solid = {.kind = i == 0 ? SOLID_SPHERE : SOLID_BOX, .radius = i == 0 ? 0.5 : 0.4},
            .closed = true,
            .flat = i > 0,
            .world_from_object = mat4_translate((Vec3){1.2 * i - 1, 0, 0}),
            .front = grey};
    world.objects[3] =
        (Object){.mesh = &floor_mesh,
                 .solid = {.kind = SOLID_QUAD},
                 .flat = true,
                 .world_from_object = mat4_product(
                     mat4_translate((Vec3){0, -0.8, 0}),
                     mat4_product(mat4_rotate(-90, (Vec3){1, 0, 0}), mat4_scale((Vec3){4, 4, 4}))),
                 .front = grey};
    world.lights[0] = (Light){.kind = LIGHT_POINT, .position = {1, 3, 2}};
    world.lights[1] = (Light){.kind = LIGHT_SPOT,
                              .position = {-1, 4, 0},
                              .direction = {0.2, -1, 0},
                              .cutoff = 40,
                              .linear = 0.1,
                              .constant = 1};
    world.lights[2] = (Light){.direction = {1, 1, 1}, .ambient = {0.1, 0.1, 0.1}};
    for (int i = 0; i < LIGHTS; i++)
        world.lights[i].diffuse = world.lights[i].specular = (Vec3){0.4, 0.4, 0.4};
    world.scene = (Scene){.camera = {{0, 2, 5}, {0, 0, 0}, {0, 1, 0}, 50, 1, 30, 0},
                          .lights = world.lights,
                          .light_count = LIGHTS,
                          .objects = world.objects,
                          .object_count = OBJECTS};
}

static void use_shadows(ShadowWay way)
{
    ShadowSettings settings = SHADOWS_DEFAULT;
    settings.way = (int)way;
    settings.map_size = 64;
    lighting_use_shadows(lighting, &settings);
    for (int i = 0; i < LIGHTS; i++)
        world.lights[i].shadows = way != SHADOWS_OFF;
}

/* From a plan; the canvas is not read. */
static void draw(LightingPlan *from)
{
    const LightingFrame frame = {.scene = &world.scene, .aspect = 1};
    canvas_clear(&canvas, world.scene.background, 1);
    SUCCEEDS(scene_check(&world.scene, message));
    SUCCEEDS(lighting_plan(from, lighting, &frame, message) &&
             lighting_draw(from, &frame, message));
}

static void read_pixels(unsigned char pixels[PIXELS])
{
    SUCCEEDS(canvas_read(&canvas, &image, message));
    memcpy(pixels, image.pixels, PIXELS);
}

/* The refreshed plan's picture is that of a new one, which decides as much. */
static void assert_as_new(const char *what)
{
    static unsigned char pixels[2][PIXELS];
    LightingPlan fresh = {.lighting = NULL};
    draw(&plan);
    read_pixels(pixels[0]);
    draw(&fresh);
    read_pixels(pixels[1]);
    if (memcmp(pixels[0], pixels[1], PIXELS) != 0)
        fail_msg("%s: another picture than that of a new plan", what);
    assert_int_equal(plan.object_count, fresh.object_count);
    assert_int_equal(plan.pairs.all, fresh.pairs.all);
    for (int i = 0; i < plan.object_count; i++) {
        assert_ptr_equal(plan.objects[i].variant, fresh.objects[i].variant);
        assert_int_equal(plan.pairs.throws[i], fresh.pairs.throws[i]);
        assert_memory_equal(&plan.objects[i].facts, &fresh.objects[i].facts,
                            sizeof fresh.objects[i].facts);
    }
    lighting_plan_close(&fresh);
}

/* Values that change in every frame of an animation. */
static void move_on(int step)
{
    const double turned = 0.01 * step;
    world.scene.camera.eye.x += turned;
    world.lights[0].position.x -= turned;
    world.lights[1].direction.x += turned;
    world.lights[2].diffuse.x = 0.3 + turned;
    world.objects[0].front.diffuse.y = 0.3 + turned;
    world.objects[0].world_from_object = mat4_product(
        mat4_translate((Vec3){-1 + turned, turned, 0}), mat4_rotate(step, (Vec3){0, 1, 0}));
}

TEST_WITH(0, values_decide_nothing_and_cost_nothing, make_world, NULL)
{
    static const ShadowWay ways[] = {SHADOWS_OFF, SHADOWS_VOLUMES, SHADOWS_MAP};
    for (int way = 0; way < 3; way++) {
        make_world(NULL);
        use_shadows(ways[way]);
        draw(&plan);
        move_on(1);
        draw(&plan);
        const long long decisions = plan.decisions, before = lookups, blocks = allocations;
        const long long texts = lighting_counts(lighting).texts;
        for (int step = 2; step < 8; step++) {
            move_on(step);
            draw(&plan);
        }
        assert_int_equal(allocations, blocks);
        assert_int_equal(lookups, before);
        assert_int_equal(plan.decisions, decisions);
        assert_int_equal(lighting_counts(lighting).texts, texts);
        assert_as_new(SHADOW_NAMES[ways[way]]);
    }
}

/* Each change of a fact decides the objects anew that it concerns: `decided`. */
TEST_WITH(0, facts_decide, make_world, NULL)
{
    use_shadows(SHADOWS_OFF);
    draw(&plan);
    for (int change = 0; change < 12; change++) {
        Object *first = &world.objects[0];
        const long long before = plan.decisions;
        int decided = 1;
        switch (change) {
        case 0:
            first->front.specular = (Vec3){0, 0, 0};
            break;
        case 1:
            first->world_from_object.m[0] *= 1.5;
            break;
        case 2:
            first->front.alpha = 0.5;
            break;
        case 3:
            first->front.emission.z = 0.1;
            break;
        case 4:
            first->two_sided = true, first->closed = false;
            break;
        case 5:
            first->mesh = &cube;
            break;
        case 6:
            world.lights[2].off = true, decided = OBJECTS;
            break;
        case 7:
            world.scene.reflection = REFLECTION_PHONG, decided = OBJECTS;
            break;
        case 8:
            world.scene.interpolation = INTERPOLATION_FLAT, decided = OBJECTS;
            break;
        case 9:
            world.lights[1].position.x = 30, decided = OBJECTS;
            break; /* misses all */
        case 10:
            world.scene.object_count--, decided = OBJECTS - 1;
            break;
        default:
            lighting_forget(lighting, &cube), decided = OBJECTS - 1;
            break;
        }
        draw(&plan);
        if (plan.decisions != before + decided)
            fail_msg("change %d: %lld objects decided anew, not %d", change,
                     plan.decisions - before, decided);
        assert_as_new("a fact");
    }
}

TEST_WITH(0, a_shadow_is_planned_when_it_falls, make_world, NULL)
{
    static const ShadowWay ways[] = {SHADOWS_VOLUMES, SHADOWS_MAP};
    for (int way = 0; way < 2; way++) {
        make_world(NULL);
        use_shadows(ways[way]);
        world.scene.light_count = 1;
        draw(&plan);
        assert_true(plan.pairs.receives[3] & 1 && plan.pairs.throws[0] & 1);
        assert_int_equal(plan.lights[0].way, ways[way]);
        world.lights[0].position = (Vec3){1, -3, 2}; /* below the floor */
        assert_as_new("below");
        assert_false(plan.pairs.receives[3] & 1);
        assert_true(plan.pairs.receives[0] & 1);
        world.scene.object_count = 1; /* the ball alone is convex */
        assert_as_new("alone");
        assert_int_equal(plan.pairs.all, 0);
        assert_int_equal(plan.lights[0].way, SHADOWS_OFF);
        world.objects[0].solid.kind = SOLID_NONE;
        assert_as_new("not convex");
        assert_true(plan.pairs.all & 1);
    }
    use_shadows(SHADOWS_OFF);
}

/* In parts each object is drawn with lights and materials of its own. */
TEST_WITH(0, parts_have_their_own_facts, make_world, NULL)
{
    static unsigned char pixels[2][PIXELS];
    static Light lights[OBJECTS][LIGHTS];
    Scene parts[OBJECTS];
    use_shadows(SHADOWS_VOLUMES);
    for (int i = 0; i < OBJECTS; i++) {
        memcpy(lights[i], world.lights, sizeof lights[i]);
        parts[i] = world.scene;
        parts[i].lights = lights[i];
        parts[i].objects = &world.objects[i];
        parts[i].object_count = 1;
    }
    const LightingFrame frame = {.scene = &world.scene, .parts = parts, .aspect = 1};
    for (int off = 0; off < 2; off++) {
        canvas_clear(&canvas, world.scene.background, 1);
        lights[0][1].off = off == 1;
        lights[3][0].diffuse.y = off ? 0.9 : 0.4;
        const long long before = plan.decisions;
        SUCCEEDS(lighting_plan(&plan, lighting, &frame, message) &&
                 lighting_draw(&plan, &frame, message));
        read_pixels(pixels[off]);
        assert_int_equal(plan.decisions, before + (off ? 1 : OBJECTS));
    }
    assert_memory_not_equal(pixels[0], pixels[1], PIXELS);
    assert_true(lighting_plan_effects(&plan, 0).group_count <
                lighting_plan_effects(&plan, 1).group_count);
}

/* Spheres rule out no pair that boxes do not, and one partner for each object is enough. */
TEST(pairs_are_those_of_all_objects_with_all)
{
    enum { COUNT = 30 };
    static Object objects[COUNT];
    Light light = {.shadows = true, .diffuse = {1, 1, 1}};
    Scene scene = {.camera = {{0, 0, 90}, {0, 0, 0}, {0, 1, 0}, 40, 1, 100, 0},
                   .lights = &light,
                   .light_count = 1,
                   .objects = objects,
                   .object_count = COUNT};
    Random random = {testing_seed(3)};
    ShadowPairs pairs = {.count = 0};
    SUCCEEDS(shadow_pairs_open(&pairs, COUNT, message));
    for (int turn = 0; turn < 60; turn++) {
        light.kind = turn % 2 ? LIGHT_POINT : LIGHT_DIRECTIONAL;
        light.position = light.direction =
            (Vec3){random_between(&random, -9, 9), random_between(&random, -9, 9), 9};
        for (int i = 0; i < COUNT; i++) {
            const double size = random_between(&random, 0.1, turn % 3 ? 1 : 4);
            objects[i] = (Object){.mesh = &cube, .solid = {.kind = SOLID_BOX}, .closed = true};
            objects[i].lamp = random_below(&random, 8) == 0;
            objects[i].world_from_object = mat4_product(
                mat4_translate((Vec3){random_between(&random, -9, 9),
                                      random_between(&random, -9, 9),
                                      random_between(&random, -9, 9)}),
                mat4_product(mat4_rotate(random_between(&random, 0, 360), (Vec3){1, 2, 3}),
                             mat4_scale((Vec3){size, 1, 0.2})));
            pairs.boxes[i] = mesh_bounds(&cube);
            pairs.placed[i] = placed_box(&pairs.boxes[i], objects[i].world_from_object);
        }
        shadow_pairs_find(&pairs, &scene);
        for (int i = 0; i < COUNT; i++) {
            bool throws = false, receives = false;
            for (int k = 0; k < COUNT; k++) {
                if (k == i)
                    continue;
                throws |= !objects[i].lamp &&
                          may_come_between(&pairs.placed[i], &pairs.placed[k], light_place(&light));
                receives |= !objects[k].lamp && may_come_between(&pairs.placed[k], &pairs.placed[i],
                                                                 light_place(&light));
            }
            if (throws != (pairs.throws[i] & 1) || receives != (pairs.receives[i] & 1))
                fail_msg("turn %d, object %d: throws %d, receives %d", turn, i, throws, receives);
        }
    }
    shadow_pairs_close(&pairs);
}

TEST_MAIN("plan", open_all, close_all)
