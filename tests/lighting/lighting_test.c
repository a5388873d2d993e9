/*
 * Pictures of the lighting model, and the programs that draw them. For every combination of
 * effects, the specialized program draws what the full program draws; the model itself is checked
 * against closed forms in double precision.
 */
#include "base/random.h"
#include "core/canvas.h"
#include "core/mesh_make.h"
#include "lighting/lighting.h"
#include "shapes/mesh_solids.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 64 };

static const Vec3 BACKGROUND = {0.2, 0.3, 0.4};

static Canvas canvas;
static Lighting *lighting;
static Image specialised, full; /* or any two pictures to be compared */
static Mesh sphere, smooth_sphere, cube, tube, quad;
static Mesh colored[3]; /* sphere, cube and tube, with colors */

/* Gives the vertices colors, 0 and 1 too. */
static bool add_colors(Mesh *mesh, Message *message)
{
    Random random = {mesh->vertex_count};
    if (!mesh_open_colors(mesh, message))
        return false;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        mesh->colors[i / 3][i % 3] = (float)fmin(fmax(random_between(&random, -0.1, 1.1), 0), 1);
    return true;
}

FIXTURE(open_all)
{
    require(canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, FAILURE) &&
                lighting_open(&lighting, &(ShaderLoader){0}, FAILURE) &&
                image_open(&specialised, SIZE, SIZE, IMAGE_BYTE, FAILURE) &&
                image_open(&full, SIZE, SIZE, IMAGE_BYTE, FAILURE) &&
                mesh_sphere(&sphere, 1, 24, 12, FAILURE) &&
                mesh_sphere(&smooth_sphere, 1, 320, 160, FAILURE) &&
                mesh_cube(&cube, 0.8, FAILURE) &&
                mesh_cylinder(&tube, (MeshCylinder){0.8, 1.5, 24, 4, MESH_CAP_NONE}, FAILURE) &&
                mesh_quad(&quad, 4, FAILURE),
            FAILURE);
    const Mesh *const plain[3] = {&sphere, &cube, &tube};
    for (int i = 0; i < 3; i++)
        require(mesh_copy(&colored[i], plain[i], FAILURE) && add_colors(&colored[i], FAILURE),
                FAILURE);
    return 0;
}

FIXTURE(close_all)
{
    Mesh *const meshes[] = {&quad,   &tube,   &cube,       &smooth_sphere,
                            &sphere, colored, colored + 1, colored + 2};
    for (int i = 0; i < 8; i++)
        mesh_close(meshes[i]);
    image_close(&full);
    image_close(&specialised);
    lighting_close(lighting);
    canvas_close(&canvas);
    return 0;
}

static void render(const Scene *scene, bool with_all, Image *picture)
{
    canvas_clear(&canvas, scene->background, 1);
    require(scene_check(scene, FAILURE) &&
                lighting_show(lighting,
                              &(LightingFrame){.scene = scene, .aspect = 1, .full = with_all},
                              FAILURE) &&
                canvas_read(&canvas, picture, FAILURE),
            FAILURE);
}

static unsigned char *pixel(const Image *image, int x, int y)
{
    return (unsigned char *)image->pixels + 4 * (y * SIZE + x);
}

static int levels_apart(const Image *a, const Image *b, int x, int y)
{
    int max = 0;
    for (int c = 0; c < 4; c++) {
        const int levels = abs(pixel(a, x, y)[c] - pixel(b, x, y)[c]);
        max = levels > max ? levels : max;
    }
    return max;
}

/* Whether at most `exceptions` pixels are more than one level apart; keeps the pictures if not. */
static bool pictures_agree(const char *name, const Image *a, const Image *b, int exceptions)
{
    int apart = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            apart += levels_apart(a, b, x, y) > 1;
    if (apart <= exceptions)
        return true;
    printf("%s: %d pixels more than one level apart\n", name, apart);
    picture_check_keep(name, a, b);
    return false;
}

/* Scenes by their properties. */

/* The color channels that a light and the material have in common, as bits. */
enum { AMBIENT = 1, DIFFUSE = 2, SPECULAR = 4 };

typedef enum Shape { SPHERE, CUBE, TUBE } Shape;
typedef enum Turn { RIGID, EVEN, UNEVEN, SHEARED, MIRRORED, TURNS } Turn;

/* A light's kind, with the properties that only this kind has. */
typedef struct Kind {
    LightKind kind;
    double constant, linear, exponent;
} Kind;

static const Kind KINDS[] = {
    {LIGHT_DIRECTIONAL, 0, 0, 0}, {LIGHT_POINT, 0, 0, 0},    {LIGHT_POINT, 1.25, 0, 0},
    {LIGHT_POINT, 0.5, 0.2, 0},   {LIGHT_SPOT, 0, 0, 0},     {LIGHT_SPOT, 0.5, 0.2, 0},
    {LIGHT_SPOT, 0, 0, 8},        {LIGHT_SPOT, 0.5, 0.2, 8},
};
enum { KIND_COUNT = sizeof KINDS / sizeof KINDS[0] };

typedef struct Case {
    int terms[3]; /* of each light */
    int kinds[3];
    int light_count;
    Shape shape;
    Turn turn;
    Interpolation interpolation;
    Reflection reflection;
    bool distant_viewer, two_sided, base, alpha, clamp_vertex, linear, show_clipped;
    bool bright; /* more than can be shown */
    bool colored, clockwise;
    bool of_viewer; /* lights, in eye coordinates */
} Case;

static struct {
    Light lights[32];
    Object object;
    Scene scene;
} world;

static Mat4 turn_matrix(Turn turn)
{
    const Mat4 turned = mat4_rotate(40, (Vec3){1, 0.5, 0.2});
    const Mat4 turned_back = mat4_rotate(-65, (Vec3){0.1, 1, 0.3});
    switch (turn) {
    case EVEN:
        return mat4_product(turned, mat4_scale((Vec3){0.7, 0.7, 0.7}));
    case UNEVEN:
        return mat4_product(turned, mat4_scale((Vec3){1.1, 0.6, 0.9}));
    case SHEARED:
        return mat4_product(mat4_scale((Vec3){1.1, 0.8, 0.6}),
                            mat4_product(turned_back, mat4_scale((Vec3){0.6, 1, 1})));
    case MIRRORED:
        return mat4_product(turned, mat4_scale((Vec3){-1, 1, 1}));
    default:
        return turned;
    }
}

static Light light_of(int number, int terms, Kind kind)
{
    static const Vec3 positions[3] = {{1.5, 1.25, 2.5}, {-2, 0.5, 1.75}, {0.5, -1.5, 3}};
    static const Vec3 colors[3] = {{0.9, 0.7, 0.5}, {0.4, 0.6, 0.8}, {0.6, 0.3, 0.7}};
    const Vec3 position = positions[number], color = colors[number], none = {0, 0, 0};
    return (Light){
        .kind = kind.kind,
        .position = position,
        .direction = kind.kind == LIGHT_SPOT ? vec3_scale(position, -1) : position,
        .ambient = terms & AMBIENT ? vec3_scale(color, 0.4) : none,
        .diffuse = terms & DIFFUSE ? color : none,
        .specular = terms & SPECULAR ? color : none,
        .cutoff = 13.7,
        .exponent = kind.exponent,
        .constant = kind.constant,
        .linear = kind.linear,
    };
}

static void make_world(const Case *c)
{
    static const Mesh *const meshes[] = {&sphere, &cube, &tube};
    const Material front = {{0.8, 0.6, 0.4}, {0.7, 0.8, 0.6},    {0.9, 0.5, 0.7},
                            {0, 0, 0},       c->alpha ? 0.6 : 1, 12};
    const Material back = {{0.3, 0.5, 0.9}, {0.5, 0.4, 0.9},    {0.4, 0.9, 0.3},
                           {0, 0, 0},       c->alpha ? 0.3 : 1, 30};
    memset(&world, 0, sizeof world);
    for (int i = 0; i < c->light_count; i++)
        world.lights[i] = light_of(i, c->terms[i], KINDS[c->kinds[i]]);
    for (int i = 0; c->bright && i < c->light_count; i++)
        world.lights[i].diffuse = vec3_scale(world.lights[i].diffuse, 2.5);
    for (int i = 0; c->of_viewer && i < c->light_count; i++) {
        world.lights[i].space = LIGHT_EYE;
        world.lights[i].position.z -= 4; /* as far from the object */
    }
    world.object = (Object){.mesh = c->colored ? &colored[c->shape] : meshes[c->shape],
                            .clockwise = c->clockwise,
                            .flat = c->shape == CUBE,
                            .closed = c->shape != TUBE,
                            .world_from_object = turn_matrix(c->turn),
                            .front = front,
                            .two_sided = c->two_sided,
                            .back = back};
    world.scene = (Scene){
        .camera = {{0, 0.5, 4}, {0, 0, 0}, {0, 1, 0}, 40, 0.5, 20, 0},
        .background = BACKGROUND,
        .global_ambient = c->base ? (Vec3){0.2, 0.15, 0.1} : (Vec3){0, 0, 0},
        .lights = world.lights,
        .light_count = c->light_count,
        .objects = &world.object,
        .object_count = 1,
        .reflection = c->reflection,
        .interpolation = c->interpolation,
        .distant_viewer = c->distant_viewer,
        .clamp_vertex = c->clamp_vertex,
        .linear = c->linear,
        .show_clipped = c->show_clipped,
    };
}

/* Draws the world with its own program and with the full one. */
static void draw_both(void)
{
    render(&world.scene, false, &specialised);
    render(&world.scene, true, &full);
}

static void describe(const Case *c, char text[128])
{
    int length = snprintf(text, 128, "shape%d-turn%d-interpolation%d-reflection%d", (int)c->shape,
                          (int)c->turn, (int)c->interpolation, (int)c->reflection);
    for (int i = 0; i < c->light_count; i++)
        length +=
            snprintf(text + length, 128 - (size_t)length, "-light%d:%d", c->kinds[i], c->terms[i]);
    snprintf(text + length, 128 - (size_t)length, "%s%s%s%s%s%s%s%s%s%s%s",
             c->distant_viewer ? "-distant" : "", c->two_sided ? "-two" : "",
             c->base ? "-base" : "", c->alpha ? "-alpha" : "", c->clamp_vertex ? "-clamp" : "",
             c->linear ? "-linear" : "", c->show_clipped ? "-clipped" : "",
             c->bright ? "-bright" : "", c->colored ? "-colored" : "",
             c->clockwise ? "-clockwise" : "", c->of_viewer ? "-viewers" : "");
}

static void check_case(const Case *c)
{
    char name[128];
    describe(c, name);
    make_world(c);
    draw_both();
    /* Rounding decides for pixels on a discontinuity (a spot's cone, the end of the highlight,
     * a change of sides): at most 2 here. */
    if (!pictures_agree(name, &specialised, &full, 2))
        fail();
}

/* Every set of terms of every kind of light, at both frequencies. */
TEST(each_light_draws_its_terms_as_the_full_program)
{
    int number = 0, taken = 0;
    for (int bits = 0; bits < 2 * 2 * 2 * 2; bits++) {
        for (int terms = 0; terms < 8; terms++) {
            for (int kind = 0; kind < KIND_COUNT; kind++) {
                const bool two_sided = bits & 1;
                const Case c = {
                    .terms = {terms},
                    .kinds = {kind},
                    .light_count = 1,
                    .shape = two_sided ? TUBE : SPHERE,
                    .turn = (Turn)(number++ % TURNS),
                    .interpolation = bits & 2 ? INTERPOLATION_GOURAUD : INTERPOLATION_PHONG,
                    .reflection = bits & 4 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG,
                    .distant_viewer = bits & 8,
                    .two_sided = two_sided,
                };
                if ((c.reflection == REFLECTION_BLINN_PHONG && !c.distant_viewer) ||
                    (terms & SPECULAR)) {
                    if (taken++ % testing_step(39) == 0)
                        check_case(&c);
                }
            }
        }
    }
}

TEST(each_transform_draws_as_the_full_program)
{
    static const int terms[] = {AMBIENT, DIFFUSE, DIFFUSE | SPECULAR};
    int taken = 0;
    for (int turn = 0; turn < TURNS; turn++)
        for (int shape = SPHERE; shape <= TUBE; shape++)
            for (int interpolation = 0; interpolation <= INTERPOLATION_FLAT; interpolation++)
                for (int kind = 0; kind < 2; kind++)
                    for (int t = 0; t < 3; t++)
                        for (int distant = 0; distant < (terms[t] & SPECULAR ? 2 : 1); distant++)
                            if (taken++ % testing_step(27) == 0)
                                check_case(&(Case){.terms = {terms[t]},
                                                   .kinds = {kind},
                                                   .light_count = 1,
                                                   .shape = (Shape)shape,
                                                   .turn = (Turn)turn,
                                                   .interpolation = (Interpolation)interpolation,
                                                   .distant_viewer = distant,
                                                   .two_sided = shape == TUBE});
}

TEST(each_output_mode_draws_as_the_full_program)
{
    for (int bits = 0; bits < 1 << 6; bits += testing_step(33))
        for (int interpolation = 0; interpolation < 2; interpolation++)
            for (int lights = 0; lights < 3; lights += 2)
                check_case(&(Case){.terms = {DIFFUSE, DIFFUSE | SPECULAR},
                                   .kinds = {1, 0},
                                   .light_count = lights,
                                   .shape = TUBE,
                                   .interpolation = (Interpolation)interpolation,
                                   .two_sided = bits & 1,
                                   .base = bits & 2,
                                   .alpha = bits & 4,
                                   .clamp_vertex = bits & 8,
                                   .linear = bits & 16,
                                   .show_clipped = bits & 32,
                                   .bright = true});
}

static Random random_state;

static int below(int limit)
{
    return random_below(&random_state, limit);
}

/* Everything together, with three lights that share code or do not. */
TEST(random_combinations_draw_as_the_full_program)
{
    random_state.state = testing_seed(20240611);
    Random more = {~random_state.state};
    for (int i = 0; i < 100; i += testing_step(21)) {
        Case c = {
            .light_count = below(4),
            .shape = (Shape)below(3),
            .turn = (Turn)below(TURNS),
            .interpolation = (Interpolation)below(3),
            .reflection = (Reflection)below(2),
            .distant_viewer = below(2),
            .two_sided = below(2),
            .base = below(2),
            .alpha = below(2),
            .clamp_vertex = below(2),
            .linear = below(2),
            .show_clipped = below(2),
            .bright = below(2),
        };
        for (int k = 0; k < c.light_count; k++) {
            const bool again = k > 0 && below(2);
            c.terms[k] = again ? c.terms[k - 1] : below(8);
            c.kinds[k] = again ? c.kinds[k - 1] : below(KIND_COUNT);
        }
        if (random_below(&more, 4) == 0)
            c.interpolation = INTERPOLATION_CONSTANT;
        c.colored = random_below(&more, 2);
        c.clockwise = random_below(&more, 4) == 0;
        c.of_viewer = random_below(&more, 3) == 0;
        check_case(&c);
    }
}

/* Guards. */

/* Whether the program guards the attenuation; all other guards are always there. */
static bool is_guarded(const Scene *scene, bool with_all)
{
    ShaderSource sources[2];
    require(lighting_sources(lighting, scene, scene->objects, with_all, sources, FAILURE), FAILURE);
    bool found = false;
    for (int stage = 0; stage < 2; stage++) {
        found |= strstr(sources[stage].text, "#define GUARD_ATTENUATION") != NULL;
        shader_source_close(&sources[stage]);
    }
    return found;
}

static double between(double min, double max)
{
    return min + (max - min) * below(1 << 20) / (1 << 20);
}

static Vec3 random_direction(void)
{
    Vec3 unit = {0, 0, 0};
    while (!vec3_normalize((Vec3){between(-1, 1), between(-1, 1), between(-1, 1)}, &unit))
        ;
    return unit;
}

/* Lights on and near the object, the object between light and eye, the eye near the object. */
TEST(guarded_cases_draw_as_the_full_program)
{
    int guarded = 0, unguarded = 0;
    random_state.state = 20240612;
    for (int i = 0; i < 150; i += testing_step(3)) {
        Case c = {.terms = {7},
                  .kinds = {below(KIND_COUNT)},
                  .light_count = 1,
                  .shape = (Shape)below(3),
                  .turn = (Turn)below(TURNS),
                  .interpolation = (Interpolation)below(2),
                  .distant_viewer = below(2)};
        make_world(&c);
        Camera *camera = &world.scene.camera;
        Light *light = &world.lights[0];
        camera->eye = vec3_scale(random_direction(), between(1.4, 5));
        camera->near = 0.01;
        light->position = vec3_scale(random_direction(), between(0.6, 3));
        if (below(3) == 0)
            light->position = vec3_scale(camera->eye, -between(0.4, 2));
        light->direction = vec3_scale(light->position, light->kind == LIGHT_SPOT ? -1 : 1);
        light->cutoff = 60;
        light->constant = below(4) == 0;
        /* Bounded so that rounding moves no pixel by more than a level. */
        light->diffuse = light->specular = (Vec3){0.3, 0.3, 0.3};
        if (is_guarded(&world.scene, false))
            guarded++;
        else
            unguarded++;
        draw_both();
        if (!pictures_agree("guards", &specialised, &full, 4))
            fail_msg("scene %d", i);
    }
    print_message("%d guarded, %d unguarded\n", guarded, unguarded);
    const int enough = testing_step(3) == 1 ? 30 : 0; /* of a dozen, any */
    assert_true(guarded > enough && unguarded > enough);
}

TEST(attenuation_is_guarded_only_without_a_constant_coefficient)
{
    const Case c = {.terms = {7, 7},
                    .kinds = {0, 7},
                    .light_count = 2,
                    .turn = UNEVEN,
                    .base = true,
                    .alpha = true};
    make_world(&c);
    assert_false(is_guarded(&world.scene, false));
    assert_true(is_guarded(&world.scene, true));
    check_case(&c);
    world.lights[1].constant = 0;
    assert_true(is_guarded(&world.scene, false));
}

/* With multisampling a pixel may be shaded at a point outside the triangle: no other program is
 * needed, because guards do not depend on where the object is. */
TEST(multisampling_uses_the_same_program)
{
    Canvas samples;
    Message message = {0};
    const CanvasOptions options = {.width = SIZE, .height = SIZE, .samples = 4};
    if (!canvas_open_beside(&samples, &canvas, &options, &message)) {
        print_message("%s\n", message.text);
        skip();
    }
    make_world(&(Case){.terms = {7}, .kinds = {7}, .light_count = 1});
    render(&world.scene, false, &specialised);
    const int before = lighting_counts(lighting).programs;
    canvas_begin(&samples);
    assert_true(
        lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1}, &message));
    assert_int_equal(lighting_counts(lighting).programs, before);
    canvas_close(&samples);
}

/* Programs are shared. */

static const Case RICH = {.terms = {7, 7, 7},
                          .kinds = {0, 3, 7},
                          .light_count = 3,
                          .shape = TUBE,
                          .turn = UNEVEN,
                          .two_sided = true,
                          .base = true,
                          .alpha = true};

static int programs(void)
{
    return lighting_counts(lighting).programs;
}

TEST(changing_a_value_compiles_nothing)
{
    make_world(&RICH);
    render(&world.scene, false, &specialised);
    const int before = programs();
    world.lights[0].diffuse = (Vec3){0.1, 0.9, 0};
    world.lights[0].direction = (Vec3){-3, 1, 1};
    world.lights[1].position.x = -1;
    world.lights[1].quadratic = 0.3;
    world.lights[2].cutoff = 20;
    world.lights[2].exponent = 3;
    world.object.front = (Material){{0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {1, 0, 0}, 0.5, 99};
    world.object.world_from_object.m[0] *= 1.25;
    world.scene.camera.eye.x = 0.5;
    world.scene.global_ambient = (Vec3){0, 0, 0};
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before);
    assert_memory_not_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    world.lights[2].exponent = 0;
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before + 1);
    world.lights[2].exponent = 2;
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before + 1);
}

TEST(a_light_that_is_off_adds_nothing_and_compiles_nothing)
{
    make_world(&RICH);
    world.scene.light_count = 2;
    render(&world.scene, false, &specialised);
    const int before = programs();
    world.scene.light_count = 3;
    world.lights[2].off = true;
    render(&world.scene, false, &full);
    assert_int_equal(programs(), before);
    assert_memory_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    render(&world.scene, true, &full);
    assert_true(pictures_agree("light off", &specialised, &full, 4));
}

/* Invariances. */

TEST(the_order_of_lights_does_not_matter)
{
    for (int flip = 0; flip < 2; flip++) {
        make_world(&RICH);
        world.scene.light_count = 8;
        for (int i = 0; i < 8; i++) {
            const int at = flip ? 7 - i : i;
            world.lights[at] = light_of(i % 3, 7, KINDS[i]);
            world.lights[at].position.x += 0.3 * i;
            world.lights[at].diffuse = vec3_scale(world.lights[at].diffuse, 0.3);
        }
        render(&world.scene, false, flip ? &full : &specialised);
    }
    /* Sums in another order. */
    assert_true(pictures_agree("order", &specialised, &full, 0));
}

static Vec3 mirror(Vec3 v)
{
    return (Vec3){-v.x, v.y, v.z};
}

TEST(a_mirrored_scene_draws_the_mirrored_picture)
{
    for (int shape = SPHERE; shape <= TUBE; shape++) {
        Case c = RICH;
        c.shape = (Shape)shape;
        make_world(&c);
        render(&world.scene, false, &specialised);
        for (int i = 0; i < 3; i++) {
            world.lights[i].position = mirror(world.lights[i].position);
            world.lights[i].direction = mirror(world.lights[i].direction);
        }
        world.object.world_from_object =
            mat4_product(mat4_scale((Vec3){-1, 1, 1}), world.object.world_from_object);
        render(&world.scene, false, &full);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE / 2; x++) {
                unsigned char kept[4];
                memcpy(kept, pixel(&full, x, y), 4);
                memcpy(pixel(&full, x, y), pixel(&full, SIZE - 1 - x, y), 4);
                memcpy(pixel(&full, SIZE - 1 - x, y), kept, 4);
            }
        }
        /* Pixels on the cone's edge, and those whose centre is on the silhouette. */
        assert_true(pictures_agree("mirror", &specialised, &full, 6));
    }
}

TEST(a_scene_a_million_units_away_draws_the_same_picture)
{
    static const Vec3 offsets[] = {{1e6, 0, 0}, {-1e6, 1e6, 1e6}, {1e9, -1e9, 1e9}};
    make_world(&RICH);
    render(&world.scene, false, &specialised);
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; i++) {
        const Vec3 by = offsets[i];
        make_world(&RICH);
        for (int k = 0; k < 3; k++)
            world.lights[k].position = vec3_add(world.lights[k].position, by);
        world.object.world_from_object =
            mat4_product(mat4_translate(by), world.object.world_from_object);
        world.scene.camera.eye = vec3_add(world.scene.camera.eye, by);
        world.scene.camera.center = vec3_add(world.scene.camera.center, by);
        render(&world.scene, false, &full);
        assert_true(pictures_agree("far away", &full, &specialised, 0));
    }
}

/* Closed forms: the colour of each pixel by support/oracle.h, on shapes that have a formula. */

/* False: no closed form here, or near what jumps: an edge, a light's, or the silhouette, where the
 * mesh lies inside the sphere. */
static bool closed_form(const Scene *scene, int x, int y, double expected[3])
{
    OraclePoint hit;
    if (!oracle_trace(scene, SIZE, SIZE, x, y, &hit) || hit.steepness < 0.15 ||
        (hit.object->mesh == &quad && fmax(fabs(hit.place.x), fabs(hit.place.y)) > 0.98))
        return false;
    const Vec3 sum = oracle_light(scene, &hit);
    const double max = fmax(sum.x, fmax(sum.y, sum.z));
    oracle_show(scene, sum, expected);
    return hit.from_jump >= 1e-3 && !(scene->show_clipped && fabs(max - 1) < 1e-3);
}

/* Compares every pixel that has a closed form, and reports how many. */
static int assert_closed_form(const Scene *scene, const char *name)
{
    int compared = 0, wrong = 0;
    render(scene, false, &specialised);
    memcpy(full.pixels, specialised.pixels, (size_t)SIZE * SIZE * 4);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            double expected[3];
            if (!closed_form(scene, x, y, expected))
                continue;
            compared++;
            for (int c = 0; c < 3; c++) {
                /* Half a level for rounding to bytes. The mesh of the sphere is within 1e-4 of the
                 * sphere, which changes the steepest highlight here by less than half a level. */
                wrong += fabs(pixel(&specialised, x, y)[c] - expected[c]) > 1;
                pixel(&full, x, y)[c] = (unsigned char)lround(expected[c]);
            }
        }
    }
    if (wrong) {
        picture_check_keep(name, &specialised, &full);
        fail_msg("%s: %d values more than one level from the closed form", name, wrong);
    }
    return compared;
}

static const Material SHINY = {
    {0.3, 0.2, 0.1}, {0.6, 0.5, 0.3}, {0.5, 0.6, 0.7}, {0.05, 0, 0.02}, 1, 24};
static const Material DULL = {
    {0.1, 0.2, 0.4}, {0.2, 0.5, 0.6}, {0.3, 0.1, 0.2}, {0, 0.05, 0.1}, 1, 6};

static void closed_form_world(const Mesh *mesh, Turn turn)
{
    memset(&world, 0, sizeof world);
    world.object =
        (Object){.mesh = mesh,
                 .solid = {.kind = mesh == &quad ? SOLID_QUAD : SOLID_SPHERE, .radius = 1},
                 .closed = mesh != &quad,
                 .world_from_object = turn_matrix(turn),
                 .front = SHINY,
                 .back = DULL};
    world.scene = (Scene){
        .camera = {{0.25, 0.5, 4}, {0, 0, 0}, {0.1, 1, 0}, 32, 0.5, 20, 0},
        .background = BACKGROUND,
        .global_ambient = {0.2, 0.15, 0.1},
        .lights = world.lights,
        .light_count = 1,
        .objects = &world.object,
        .object_count = 1,
    };
}

TEST(each_light_reflection_and_viewer_has_its_closed_form)
{
    for (int flat = 0; flat < 2; flat++) {
        for (int kind = 0; kind < KIND_COUNT; kind++) {
            for (int bits = 0; bits < 4; bits++) {
                char name[64];
                snprintf(name, sizeof name, "closed-form-%s-light%d-%d", flat ? "quad" : "sphere",
                         kind, bits);
                closed_form_world(flat ? &quad : &smooth_sphere, (Turn)((kind + bits) % TURNS));
                world.lights[0] = light_of(0, 7, KINDS[kind]);
                world.scene.reflection = bits & 1 ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG;
                world.scene.distant_viewer = bits & 2;
                assert_true(assert_closed_form(&world.scene, name) > SIZE * SIZE / 8);
            }
        }
    }
}

TEST(several_lights_have_the_sum_of_their_closed_forms)
{
    for (int turn = 0; turn < TURNS; turn++) {
        closed_form_world(&smooth_sphere, (Turn)turn);
        world.scene.light_count = 3;
        for (int i = 0; i < 3; i++)
            world.lights[i] = light_of(i, 7, KINDS[3 * i]);
        assert_true(assert_closed_form(&world.scene, "closed-form-three") > SIZE * SIZE / 8);
    }
}

TEST(attenuation_has_its_closed_form)
{
    static const Vec3 factors[] = {{0, 0, 0}, {2, 0, 0}, {0, 0.5, 0}, {0, 0, 0.2}, {0.3, 0.2, 0.1}};
    for (size_t i = 0; i < sizeof factors / sizeof factors[0]; i++) {
        closed_form_world(&quad, RIGID);
        world.lights[0] = light_of(1, 7, (Kind){LIGHT_POINT, factors[i].x, factors[i].y, 0});
        world.lights[0].quadratic = factors[i].z;
        assert_closed_form(&world.scene, "closed-form-attenuation");
    }
}

/* The quad is seen from the front, from behind, and from behind with two sides. */
TEST(both_sides_of_a_quad_have_their_closed_forms)
{
    for (int bits = 0; bits < 4; bits++) {
        for (int turn = 0; turn < TURNS; turn++) {
            closed_form_world(&quad, (Turn)turn);
            world.lights[0] = light_of(0, 7, KINDS[3]);
            const Mat4 about = mat4_rotate(bits & 1 ? 180 : 0, (Vec3){0, 1, 0});
            world.object.world_from_object = mat4_product(about, world.object.world_from_object);
            world.object.two_sided = bits & 2;
            world.scene.camera.up = (Vec3){0, 1, 0};
            assert_true(assert_closed_form(&world.scene, "closed-form-side") > SIZE * SIZE / 16);
        }
    }
}

TEST(linear_light_and_clipping_have_their_closed_forms)
{
    for (int bits = 1; bits < 4; bits++) {
        closed_form_world(&smooth_sphere, RIGID);
        world.lights[0] = light_of(0, 7, KINDS[0]);
        world.lights[0].diffuse = (Vec3){1.5, 1.25, 1};
        world.scene.linear = bits & 1;
        world.scene.show_clipped = bits & 2;
        assert_true(assert_closed_form(&world.scene, "closed-form-output") > SIZE * SIZE / 8);
    }
}

/* On a plane under a distant light, lighting at the vertices is lighting everywhere; a sphere of
 * many triangles has the closed form at its vertices, and little else in between. */
TEST(gouraud_has_the_closed_form_where_triangles_are_small)
{
    for (int kind = 0; kind < 4; kind++) {
        closed_form_world(&smooth_sphere, (Turn)kind);
        world.lights[0] = light_of(0, 7, KINDS[kind]);
        world.scene.interpolation = INTERPOLATION_GOURAUD;
        assert_true(assert_closed_form(&world.scene, "closed-form-gouraud") > SIZE * SIZE / 8);
    }
}

TEST(flat_is_gouraud_with_the_normals_of_triangles)
{
    Mesh flat;
    assert_true(mesh_sphere(&flat, 1, 24, 12, NULL));
    assert_true(mesh_flatten(&flat, NULL));
    closed_form_world(&sphere, UNEVEN);
    world.lights[0] = light_of(0, 7, KINDS[1]);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    render(&world.scene, false, &full);
    world.scene.interpolation = INTERPOLATION_FLAT;
    render(&world.scene, false, &specialised);
    assert_memory_not_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    world.object.mesh = &flat;
    world.object.flat = true;
    render(&world.scene, false, &full);
    assert_true(pictures_agree("flat", &specialised, &full, 0));
    lighting_forget(lighting, &flat);
    mesh_close(&flat);
}

TEST(a_uniform_scale_of_any_size_has_the_same_lighting)
{
    static const double sizes[] = {1e-6, 1e-3, 1e3, 1e6};
    closed_form_world(&smooth_sphere, RIGID);
    world.lights[0] = light_of(0, 7, KINDS[0]);
    render(&world.scene, false, &specialised);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const double s = sizes[i];
        closed_form_world(&smooth_sphere, RIGID);
        world.lights[0] = light_of(0, 7, KINDS[0]);
        world.object.world_from_object =
            mat4_product(mat4_scale((Vec3){s, s, s}), world.object.world_from_object);
        Camera *camera = &world.scene.camera;
        camera->eye = vec3_scale(camera->eye, s);
        camera->near *= s;
        camera->far *= s;
        render(&world.scene, false, &full);
        assert_true(pictures_agree("scale", &full, &specialised, 0));
    }
}

/* The model-view matrix instead of the normal matrix. */
TEST(wrong_normals_differ_only_where_the_scale_is_uneven)
{
    for (int turn = 0; turn < TURNS; turn++) {
        closed_form_world(&sphere, (Turn)turn);
        world.lights[0] = light_of(0, 7, KINDS[0]);
        render(&world.scene, false, &full);
        world.object.wrong_normals = true;
        render(&world.scene, false, &specialised);
        const bool same = memcmp(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4) == 0;
        assert_int_equal(same, turn != UNEVEN && turn != SHEARED);
        render(&world.scene, true, &full);
        assert_true(pictures_agree("wrong normals", &specialised, &full, 4));
    }
}

TEST(nearer_objects_occlude_those_behind)
{
    Object objects[2];
    closed_form_world(&smooth_sphere, RIGID);
    world.scene.light_count = 0;
    world.scene.objects = objects;
    world.scene.object_count = 2;
    for (int order = 0; order < 2; order++) {
        objects[0] = objects[1] = world.object;
        objects[order].front.emission = (Vec3){1, 0, 0};
        objects[order].world_from_object = mat4_scale((Vec3){0.5, 0.5, 0.5});
        objects[order].world_from_object.m[14] = 1.5;
        render(&world.scene, false, &specialised);
        assert_int_equal(pixel(&specialised, SIZE / 2, SIZE / 2)[0], 255);
        assert_int_not_equal(pixel(&specialised, SIZE / 2, SIZE / 8)[0], 255);
    }
}

/* Limits and failures. */

TEST(the_maximum_of_lights_is_drawn_and_one_more_is_rejected)
{
    Light lights[EFFECTS_MAX_LIGHTS + 1];
    Message message = {0};
    make_world(&RICH);
    world.scene.lights = lights;
    for (int i = 0; i <= EFFECTS_MAX_LIGHTS; i++) {
        lights[i] = light_of(i % 3, 7, KINDS[i % KIND_COUNT]);
        lights[i].position.y += 0.1 * i;
        lights[i].diffuse = vec3_scale(lights[i].diffuse, 0.1);
        lights[i].specular = lights[i].ambient = vec3_scale(lights[i].ambient, 0.05);
    }
    world.scene.light_count = EFFECTS_MAX_LIGHTS;
    draw_both();
    assert_true(pictures_agree("most lights", &specialised, &full, 8));
    world.scene.light_count++;
    assert_false(
        lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1}, &message));
    assert_string_equal(message.text, "scene: 33 lights: at most 32 fit into one program");
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

TEST(a_broken_shader_is_reported_with_its_line_and_not_counted)
{
    char folder[] = "/tmp/lighting_test_XXXXXX", path[64], beginning[80];
    Lighting *broken;
    Message message = {0};
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/group.glsl", folder);
    snprintf(beginning, sizeof beginning, "%s:3:", path);
    write_file(path, "// One,\n// two,\nthree.\n");
    make_world(&RICH);
    assert_true(lighting_open(&broken, &(ShaderLoader){.folder = folder}, &message));
    assert_false(
        lighting_show(broken, &(LightingFrame){.scene = &world.scene, .aspect = 1}, &message));
    remove(path);
    remove(folder);
    if (strncmp(message.text, beginning, strlen(beginning)) != 0)
        fail_msg("\"%s\" does not begin with \"%s\"", message.text, beginning);
    assert_int_equal(lighting_counts(broken).programs, 0);
    lighting_close(broken);
}

PICTURE_TEST_MAIN("lighting", open_all, close_all)
