/*
 * Pictures of the lighting model, and the programs that draw them: the specialized program
 * draws what the full program draws. The model itself: fixed_function_test.c, and the pictures of
 * the reference, whose equation is the oracle's (reference_solid_test.c).
 */
#include "core/canvas.h"
#include "core/mesh_make.h"
#include "hard/random_scene.h"
#include "lighting/lighting.h"
#include "reference/picture_error.h"
#include "support/effects_of.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 64 };

/* The color channels that a light and the material have in common, as bits. */
enum { AMBIENT = 1, DIFFUSE = 2, SPECULAR = 4 };

typedef enum Shape { SPHERE, CUBE, TUBE } Shape;
typedef enum Turn { RIGID, EVEN, UNEVEN, SHEARED, MIRRORED, TURNS } Turn;

/* A light's kind, with the properties that only this kind has. */
typedef struct Kind {
    LightKind kind;
    double constant, linear, exponent;
} Kind;

typedef struct Case {
    int terms[3]; /* of each light */
    int kinds[3];
    int light_count;
    Shape shape;
    Turn turn;
    Interpolation interpolation;
    Reflection reflection;
    bool distant_viewer, two_sided, base, alpha;
} Case;

static Canvas canvas;
static Lighting *lighting;
static Image specialised, full; /* or any two pictures to be compared */
static Mesh sphere, cube, tube;

FIXTURE(open_all)
{
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message) &&
             lighting_open(&lighting, &(ShaderLoader){0}, message) &&
             image_open(&specialised, SIZE, SIZE, IMAGE_BYTE, message) &&
             image_open(&full, SIZE, SIZE, IMAGE_BYTE, message) &&
             mesh_sphere(&sphere, 1, 24, 12, message) && mesh_cube(&cube, 0.8, message) &&
             mesh_cylinder(&tube, (MeshCylinder){0.8, 1.5, 24, 4, MESH_CAP_NONE}, message));
}

FIXTURE(close_all)
{
    mesh_close(&tube);
    mesh_close(&cube);
    mesh_close(&sphere);
    image_close(&full);
    image_close(&specialised);
    lighting_close(lighting);
    canvas_close(&canvas);
}

/* Draws a scene, with its own program or with the full one. */
static void render(const Scene *scene, bool with_all, Image *picture)
{
    picture_draw(&canvas, lighting, &(LightingFrame){.scene = scene, .full = with_all}, picture);
}

/* Whether at most `exceptions` pixels are more than one level apart; keeps the pictures if not. */
static bool pictures_agree(const char *name, const Image *a, const Image *b, int exceptions)
{
    const int apart = pixels_apart(a->pixels, b->pixels, SIZE * SIZE, 1);
    if (apart <= exceptions)
        return true;
    printf("%s: %d pixels more than one level apart\n", name, apart);
    picture_check_keep(name, a, b);
    return false;
}

/* Scenes by their properties. */

static const Kind KINDS[] = {
    {LIGHT_DIRECTIONAL, 0, 0, 0}, {LIGHT_POINT, 0, 0, 0},    {LIGHT_POINT, 1.25, 0, 0},
    {LIGHT_POINT, 0.5, 0.2, 0},   {LIGHT_SPOT, 0, 0, 0},     {LIGHT_SPOT, 0.5, 0.2, 0},
    {LIGHT_SPOT, 0, 0, 8},        {LIGHT_SPOT, 0.5, 0.2, 8},
};
enum { KIND_COUNT = sizeof KINDS / sizeof KINDS[0] };

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
    world.object = (Object){.mesh = meshes[c->shape],
                            .flat = c->shape == CUBE,
                            .closed = c->shape != TUBE,
                            .world_from_object = turn_matrix(c->turn),
                            .front = front,
                            .two_sided = c->two_sided,
                            .back = back};
    world.scene = (Scene){
        .camera = {{0, 0.5, 4}, {0, 0, 0}, {0, 1, 0}, 40, 0.5, 20, 0},
        .background = {0.2, 0.3, 0.4},
        .global_ambient = c->base ? (Vec3){0.2, 0.15, 0.1} : (Vec3){0, 0, 0},
        .lights = world.lights,
        .light_count = c->light_count,
        .objects = &world.object,
        .object_count = 1,
        .reflection = c->reflection,
        .interpolation = c->interpolation,
        .distant_viewer = c->distant_viewer,
    };
}

/* Draws the world with its own program and with the full one. */
static void draw_both(void)
{
    render(&world.scene, false, &specialised);
    render(&world.scene, true, &full);
}

static void check_case(const Case *c)
{
    char name[64];
    snprintf(name, sizeof name, "light%d:%d-%d%d%d%d", c->kinds[0], c->terms[0], c->interpolation,
             c->reflection, c->distant_viewer, c->two_sided);
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

/* Everything together, with lights that share code or do not. */
TEST(random_scenes_draw_as_the_full_program)
{
    const unsigned long long seed = testing_seed(20240611);
    RandomMeshes meshes = {.first = NULL};
    int drawn = 0;
    for (int i = 0; drawn < testing_part(150, 10); i++) {
        RandomScene made;
        Random random = {seed + (unsigned)i};
        random_scene_make(&made, random.state, seed);
        made.scene.signed_dots = random_below(&random, 3) == 0;
        for (int k = 0; k < made.scene.object_count; k++) {
            made.objects[k].front.alpha = random_below(&random, 2) ? 1 : 0.6;
            made.objects[k].back.alpha = random_below(&random, 2) ? 1 : 0.3;
        }
        SUCCEEDS(random_scene_ready(&made, &meshes, message));
        if (random_scene_grazes(&made))
            continue;
        render(&made.scene, false, &specialised);
        render(&made.scene, true, &full);
        drawn++;
        if (!pictures_agree("random", &specialised, &full, 2))
            fail_msg("scene %d", i);
    }
    lighting_forget(lighting, NULL);
    random_meshes_close(&meshes);
}

static Random random_state;

static int below(int limit)
{
    return random_below(&random_state, limit);
}

/* Guards. */

/* Whether the program guards the attenuation; all other guards are always there. */
static bool is_guarded(const Scene *scene, bool with_all)
{
    ShaderSource sources[2];
    SUCCEEDS(lighting_sources(lighting, scene, scene->objects, with_all, sources, message));
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

/* Lights that do not reach an object. */

/* A square sheet, flat or bent, so that its normals lie in a cone. */
static void make_sheet(Mesh *mesh, double bend)
{
    enum { SIDE = 8 };
    require(mesh_open(mesh, (SIDE + 1) * (SIDE + 1), mesh_grid_size(SIDE, SIDE, MESH_POLE_NONE),
                      FAILURE),
            FAILURE);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const double x = (double)(i % (SIDE + 1)) / (SIDE / 2) - 1;
        const double y = 1 - (double)(i / (SIDE + 1)) / (SIDE / 2);
        vec3_to_float((Vec3){x, y, -bend * (x * x + y * y)}, mesh->vertices[i].position);
    }
    mesh_grid(mesh->indices, 0, SIDE, SIDE, MESH_POLE_NONE);
    require(mesh_compute_normals(mesh, MESH_WEIGHT_ANGLE, false, FAILURE), FAILURE);
}

static Vec3 random_color(double most)
{
    return vec3_scale((Vec3){between(0, 1), between(0, 1), between(0, 1)}, most);
}

/* Lights of all brightnesses around the object: most of those on the other side are behind it, and
 * many of the others too faint. No spots: their edges are where rounding has them. */
static void make_dim_world(const Mesh *sheet)
{
    make_world(&(Case){.turn = (Turn)below(TURNS),
                       .interpolation = (Interpolation)below(3),
                       .reflection = (Reflection)below(2),
                       .distant_viewer = below(2)});
    world.scene.light_count = 12;
    world.scene.linear = below(2);
    world.scene.signed_dots = below(4) == 0;
    world.scene.camera.eye = vec3_scale(random_direction(), 4);
    world.object.mesh = sheet;
    world.object.closed = false;
    world.object.two_sided = below(4) == 0;
    world.object.front = world.object.back =
        (Material){random_color(1), random_color(1), random_color(1), {0, 0, 0}, 1, between(1, 60)};
    for (int i = 0; i < world.scene.light_count; i++) {
        const double bright = pow(10, between(-4, -0.5));
        world.lights[i] = (Light){.kind = below(4) ? LIGHT_POINT : LIGHT_DIRECTIONAL,
                                  .position = vec3_scale(random_direction(), between(0.3, 9)),
                                  .direction = random_direction(),
                                  .ambient = random_color(below(4) ? 0 : bright),
                                  .diffuse = random_color(bright),
                                  .specular = random_color(bright),
                                  .constant = below(2),
                                  .linear = between(0, 1),
                                  .quadratic = below(2) * between(0, 1),
                                  .range = below(3) ? 0 : between(5, 15)};
    }
}

static void draw_floats(const Canvas *floats, bool with_all, Image *picture)
{
    const LightingFrame frame = {.scene = &world.scene, .aspect = 1, .full = with_all};
    canvas_begin(floats);
    canvas_clear(floats, world.scene.background, 1);
    require(scene_check(&world.scene, FAILURE) && lighting_show(lighting, &frame, FAILURE) &&
                canvas_read(floats, picture, FAILURE),
            FAILURE);
}

/* The largest difference of two pictures; of the exact one, if there is one, inside objects. */
static double farthest(const Image *a, const Image *b, const Reference *exact)
{
    double most = 0;
    for (size_t i = 0; i < SIZE * SIZE; i++)
        for (size_t k = 0; k < 3 && (!exact || exact->interior[i]); k++) {
            const double one = (double)((const float *)a->pixels)[4 * i + k];
            const double other = exact ? (double)exact->color[3 * i + k]
                                       : (double)((const float *)b->pixels)[4 * i + k];
            most = fmax(most, fabs((exact ? fmin(fmax(one, 0), 1) : one) - other));
        }
    return most;
}

/* As floats, before they are rounded to bytes. */
TEST(lights_that_are_left_out_change_no_pixel_by_more_than_half_a_step)
{
    /* Of 12 lights in floats, encoded as sRGB; and highlights to the power of 60. */
    const double half = 0.5 / 255, evaluated = 0.1 / 255;
    const CanvasOptions options = {.width = SIZE, .height = SIZE, .real = true};
    Message message = {0};
    Canvas floats;
    CLOSED(mesh_close) Mesh flat = {.vertices = NULL}, bent = {.vertices = NULL};
    CLOSED(image_close) Image with = {.width = 0}, without = {.width = 0};
    int behind = 0, faint = 0;
    double worst[2] = {0, 0};
    random_state.state = testing_seed(20261124);
    if (!canvas_open_beside(&floats, &canvas, &options, &message)) {
        print_message("%s\n", message.text);
        skip();
    }
    make_sheet(&flat, 0);
    make_sheet(&bent, 0.4);
    require(image_open(&with, SIZE, SIZE, IMAGE_FLOAT, FAILURE) &&
                image_open(&without, SIZE, SIZE, IMAGE_FLOAT, FAILURE),
            FAILURE);
    for (int i = 0; i < testing_part(400, 40); i++) {
        Reference exact;
        make_dim_world(below(2) ? &flat : &bent);
        draw_floats(&floats, true, &with);
        draw_floats(&floats, false, &without);
        require(reference_open(&exact, &world.scene,
                               &(ReferenceOptions){
                                   .width = SIZE, .height = SIZE, .meshes = true, .centers = true},
                               FAILURE),
                FAILURE);
        const double apart = farthest(&without, &with, NULL);
        worst[0] = fmax(worst[0], apart);
        worst[1] = fmax(worst[1], farthest(&without, NULL, &exact));
        reference_close(&exact);
        const ObjectFacts facts = effects_facts(&world.scene, &world.object);
        behind += __builtin_popcount(facts.behind);
        faint += __builtin_popcount(facts.faint);
        double bound = 0.01;
        for (int k = 0; k < world.scene.light_count; k++)
            bound += (double)facts.steps[k];
        if (255 * apart > bound || bound > 0.51 || worst[1] > half + evaluated)
            fail_msg("scene %d: %g steps from the full program, of %g; %g from the exact picture",
                     i, 255 * apart, bound, 255 * worst[1]);
    }
    print_message("%d lights behind, %d too faint; %.3f steps at most, %.3f from exact pictures\n",
                  behind, faint, 255 * worst[0], 255 * worst[1]);
    assert_true(behind > 0 && faint > 0);
    lighting_forget(lighting, NULL);
    canvas_close(&floats);
    canvas_begin(&canvas);
}

/* The model-view matrix instead of the normal matrix. */
TEST(wrong_normals_differ_only_where_the_scale_is_uneven)
{
    for (int turn = 0; turn < TURNS; turn++) {
        make_world(&(Case){.terms = {7}, .light_count = 1, .turn = (Turn)turn, .base = true});
        render(&world.scene, false, &full);
        world.object.wrong_normals = true;
        render(&world.scene, false, &specialised);
        const bool same = memcmp(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4) == 0;
        assert_int_equal(same, turn != UNEVEN && turn != SHEARED);
        render(&world.scene, true, &full);
        assert_true(pictures_agree("wrong normals", &specialised, &full, 4));
    }
}

TEST(flat_is_gouraud_with_the_normals_of_triangles)
{
    CLOSED(mesh_close) Mesh flat;
    SUCCEEDS(mesh_copy(&flat, &sphere, message) && mesh_flatten(&flat, message));
    make_world(&(Case){.terms = {7}, .kinds = {1}, .light_count = 1, .turn = UNEVEN});
    world.scene.interpolation = INTERPOLATION_FLAT;
    render(&world.scene, false, &specialised);
    world.scene.interpolation = INTERPOLATION_GOURAUD;
    render(&world.scene, false, &full);
    assert_memory_not_equal(specialised.pixels, full.pixels, (size_t)SIZE * SIZE * 4);
    world.object.mesh = &flat;
    world.object.flat = true;
    render(&world.scene, false, &full);
    assert_true(pictures_agree("flat", &specialised, &full, 0));
    lighting_forget(lighting, &flat);
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

/* Limits and failures. */

/* Of more lights than a program has, 25 balls get those that reach them by range and cone; a
 * program each. */
TEST(of_many_lights_each_object_gets_those_that_reach_it)
{
    enum { SIDE = 5, LIGHTS = 100 };
    const int side = testing_step(2) == 1 ? SIDE : 2;
    static Light lights[LIGHTS];
    static Object objects[SIDE * SIDE];
    Reference exact;
    make_world(&RICH);
    random_state.state = testing_seed(20261127);
    for (int i = 0; i < side * side; i++) {
        const Vec3 at = {2.2 * (i % side) - 4.4, 2.2 * (i / side) - 4.4, 0};
        objects[i] = world.object;
        objects[i].mesh = &sphere;
        objects[i].solid.kind = SOLID_NONE;
        objects[i].world_from_object = mat4_translate(at);
    }
    for (int i = 0; i < LIGHTS; i++) {
        const double bright = i < 3 ? 0.1 : between(0.1, 0.6);
        lights[i] = (Light){.kind = i < 3      ? LIGHT_DIRECTIONAL
                                    : below(2) ? LIGHT_POINT
                                               : LIGHT_SPOT,
                            .position = {between(-6, 6), between(-6, 6), between(1, 2)},
                            .direction = {between(-1, 1), between(-1, 1), i < 3 ? 1 : -1},
                            .ambient = random_color(i % 5 ? 0 : 0.02),
                            .diffuse = random_color(bright),
                            .specular = random_color(bright),
                            .cutoff = between(20, 70),
                            .exponent = below(2) * between(1, 9),
                            .range = i < 3 ? 0 : between(0.5, 2.5)};
    }
    world.scene.camera = (Camera){{0, 0, 30}, {0, 0, 0}, {0, 1, 0}, 22, 5, 60, 0};
    world.scene.lights = lights;
    world.scene.light_count = LIGHTS;
    world.scene.objects = objects;
    world.scene.object_count = side * side;
    draw_both();
    assert_true(pictures_agree("many lights", &specialised, &full, 8));
    SUCCEEDS(reference_open(
        &exact, &world.scene,
        &(ReferenceOptions){.width = SIZE, .height = SIZE, .meshes = true, .centers = true},
        message));
    int inside = 0, apart = 0;
    for (size_t i = 0; i < SIZE * SIZE; i++) {
        const bool whole = exact.object[i] >= 0 && exact.coverage[i] > 0.999F;
        inside += whole;
        /* Half a step is left out, and half is rounded; where a cone ends, the driver rounds. */
        apart += whole && pixel_error(&specialised, i, &exact.color[3 * i]).largest > 1.1;
    }
    reference_close(&exact);
    assert_true(inside > 20 * side * side);
    assert_in_range(apart, 0, 8);
}

TEST(the_maximum_of_lights_is_drawn_and_one_more_casts_no_shadow)
{
    Light lights[EFFECTS_MAX_LIGHTS + 1];
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
    world.scene.light_count++; /* the brightest of which are drawn */
    draw_both();
    assert_true(pictures_agree("one more", &specialised, &full, 8));
    lights[EFFECTS_MAX_LIGHTS].shadows = true;
    FAILS(lighting_show(lighting, &(LightingFrame){.scene = &world.scene, .aspect = 1}, message),
          "scene: light 32: only the first 32 may cast shadows");
}

TEST(a_broken_shader_is_reported_with_its_line_and_not_counted)
{
    char folder[] = "/tmp/lighting_test_XXXXXX", path[64], beginning[80];
    Lighting *broken;
    Message message = {0};
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/group.glsl", folder);
    snprintf(beginning, sizeof beginning, "%s:3:", path);
    testing_write(path, "// One,\n// two,\nthree.\n", 23);
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
