/*
 * Invariances: random scenes are translated, rotated, mirrored and scaled, their far plane moved,
 * their lights permuted and split, their triangles reordered, the picture widened; interior pixels,
 * compared as floats, stay the same. HARD_SEED and HARD_SCENES in the environment choose other
 * scenes.
 */
#include "core/mesh_make.h"
#include "hard/random_scene.h"
#include "support/picture_check.h"
#include "support/testing.h"

/* Scenes of one kind share programs, because compiling one costs more than many pictures. */
enum { SIZE = 32, PER_KIND = 60, SCENES = 2500 };

static Canvas wide;
static Image wide_image, picture, other;
static RandomMeshes meshes;
static unsigned long long seed = 20260101;
static int scene_count = SCENES, step = 1;

FIXTURE(open_all)
{
    const CanvasOptions options = {.width = 2 * SIZE, .height = SIZE, .real = true};
    hard_open(SIZE, SIZE);
    SUCCEEDS(canvas_open_beside(&wide, &hard.bytes, &options, message) &&
             image_open(&wide_image, 2 * SIZE, SIZE, IMAGE_FLOAT, message) &&
             image_open(&picture, SIZE, SIZE, IMAGE_FLOAT, message) &&
             image_open(&other, SIZE, SIZE, IMAGE_FLOAT, message));
}

FIXTURE(close_all)
{
    for (const RandomMesh *made = meshes.first; made; made = made->next)
        hard_forget(&made->mesh);
    random_meshes_close(&meshes);
    image_close(&other);
    image_close(&picture);
    image_close(&wide_image);
    canvas_close(&wide);
    hard_close();
}

static void make_scene(RandomScene *made, int number)
{
    random_scene_make(made, seed + (unsigned long long)(number / PER_KIND),
                      (unsigned long long)number);
    SUCCEEDS(random_scene_ready(made, &meshes, message) && scene_check(&made->scene, message));
}

static void render(const RandomScene *scene, const Canvas *canvas, Image *image)
{
    picture_draw(canvas, hard.lightings[HARD_HIGHP], &(LightingFrame){.scene = &scene->scene},
                 image);
}

/* Changes that keep the picture. */

typedef struct Change {
    const char *name;
    /* Changes a scene into another with the same picture. */
    void (*apply)(RandomScene *scene, Random *random);
    bool mirrored;
    double max; /* difference that rounding to float may cause, in steps of 1/255 */
} Change;

/* An affine map of the whole world, and what becomes of the viewer's lights. */
static void map_world(RandomScene *scene, Mat4 map, Mat4 of_eye)
{
    Camera *camera = &scene->scene.camera;
    camera->eye = mat4_transform_point(map, camera->eye);
    camera->center = mat4_transform_point(map, camera->center);
    camera->up = mat4_transform_direction(map, camera->up);
    for (int i = 0; i < scene->scene.light_count; i++) {
        Light *light = &scene->lights[i];
        const Mat4 own = light->space == LIGHT_EYE ? of_eye : map;
        light->position = mat4_transform_point(own, light->position);
        light->direction = mat4_transform_direction(own, light->direction);
    }
    for (int i = 0; i < scene->scene.object_count; i++)
        scene->objects[i].world_from_object =
            mat4_product(map, scene->objects[i].world_from_object);
}

/* Positions are multiples of 2^-20, so that nothing is rounded below 2^32. */
static void move(RandomScene *scene, Random *random)
{
    const double far = ldexp(1, random_below(random, 30));
    const Vec3 offset = {far, -far, random_below(random, 2) ? far : 0};
    map_world(scene, mat4_translate(offset), mat4_identity());
}

static void turn(RandomScene *scene, Random *random)
{
    const double degrees = random_between(random, 0, 360);
    map_world(scene, mat4_rotate(degrees, hard_random_direction(random)), mat4_identity());
}

/* The picture has left and right exchanged. */
static void mirror(RandomScene *scene, Random *random)
{
    const Vec3 mirrors[3] = {{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}};
    map_world(scene, mat4_scale(mirrors[random_below(random, 3)]), mat4_scale(mirrors[0]));
}

static void scale(RandomScene *scene, Random *random)
{
    const double factor = ldexp(1, random_below(random, 61) - 30);
    const Mat4 map = mat4_scale((Vec3){factor, factor, factor});
    map_world(scene, map, map);
    scene->scene.camera.near *= factor;
    scene->scene.camera.far *= factor;
    for (int i = 0; i < scene->scene.light_count; i++) {
        scene->lights[i].linear /= factor;
        scene->lights[i].quadratic /= factor * factor;
    }
}

/* Depth alone changes, and nothing is beyond any of them. */
static void move_far_plane(RandomScene *scene, Random *random)
{
    static const double fars[] = {1e3, 1e9, 1e300, (double)INFINITY};
    scene->scene.camera.far = fars[random_below(random, 4)];
}

static void permute_lights(RandomScene *scene, Random *random)
{
    for (int i = scene->scene.light_count - 1; i > 0; i--) {
        const int k = random_below(random, i + 1);
        const Light light = scene->lights[i];
        scene->lights[i] = scene->lights[k];
        scene->lights[k] = light;
    }
}

/* Splits one light into two at the same place, a fraction and the rest. */
static void split_light(RandomScene *scene, Random *random)
{
    Light *light = &scene->lights[random_below(random, scene->scene.light_count)];
    Light *rest = &scene->lights[scene->scene.light_count++];
    const double share = random_below(random, 2) ? 0.5 : random_between(random, 0.1, 0.9);
    *rest = *light;
    light->ambient = vec3_scale(light->ambient, share);
    light->diffuse = vec3_scale(light->diffuse, share);
    light->specular = vec3_scale(light->specular, share);
    rest->ambient = vec3_subtract(rest->ambient, light->ambient);
    rest->diffuse = vec3_subtract(rest->diffuse, light->diffuse);
    rest->specular = vec3_subtract(rest->specular, light->specular);
}

/* The effect of floats. Colors: a cosine has an error of about 2^-22, its power with a shininess of
 * 128 one of 2^-15 of its value; with the highlights of five lights, at most 2 each, and the sRGB
 * curve, up to 13 times as steep, these are 0.1 steps. Positions: corners of triangles are rounded
 * to 1/256 of a pixel, and differently at another place; inside, samples half a pixel apart differ
 * by at most 1/16, so two pictures differ by 2 * 1/256 * 2 * 255/16 = 0.25 steps. */
static const Change CHANGES[] = {
    {"moved", move, false, 0},
    {"turned", turn, false, 0.35},
    {"mirrored", mirror, true, 0.35},
    {"scaled", scale, false, 0.35},
    {"far plane moved", move_far_plane, false, 0},
    {"lights permuted", permute_lights, false, 0.1},
    {"a light split", split_light, false, 0.1},
};
enum { CHANGE_COUNT = sizeof CHANGES / sizeof CHANGES[0] };

typedef struct Tally {
    double worst;
    long long pixels;
    int scenes, grazing;
} Tally;

/* The largest difference inside objects, in steps; `mirrored`: `other` is read from right to left;
 * `left`: the column of `other` that corresponds to the first. */
static double largest_difference(const Image *a, const Image *b, const Reference *exact,
                                 bool mirrored, int left, long long *pixels)
{
    const float *values = a->pixels, *others = b->pixels;
    double max = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const size_t here = (size_t)(y * SIZE + x);
            const size_t there = (size_t)(y * b->width + left + (mirrored ? SIZE - 1 - x : x));
            if (!exact->interior[here])
                continue;
            ++*pixels;
            for (size_t c = 0; c < 3; c++) {
                const double one = (double)values[4 * here + c];
                const double two = (double)others[4 * there + c];
                const double apart = fabs(fmax(0, fmin(1, one)) - fmax(0, fmin(1, two)));
                max = isfinite(one) && isfinite(two) ? fmax(max, 255 * apart) : INFINITY;
            }
        }
    return max;
}

static void exact_picture(const RandomScene *scene, Reference *exact)
{
    /* Edges need not be exact, only known. */
    const ReferenceOptions options = {
        .width = SIZE, .height = SIZE, .meshes = true, .edge_error = 255};
    SUCCEEDS(reference_open(exact, &scene->scene, &options, message));
}

/* Fails if the difference is too large, unless rounding decides there. */
static void judge(const char *name, int number, const RandomScene *scene, double difference,
                  double max, Tally *tally)
{
    tally->scenes++;
    if (difference > max && random_scene_grazes(scene)) {
        tally->grazing++;
        return;
    }
    tally->worst = fmax(tally->worst, difference);
    if (difference <= max)
        return;
    fail_msg("scene %d of seed %llu, %s: %g steps apart, of %g", number, seed, name, difference,
             max);
}

static void report(const char *name, const Tally *tally)
{
    print_message("%s: %d scenes, %lld pixels, at most %.4f steps apart; %d at a jump\n", name,
                  tally->scenes, tally->pixels, tally->worst, tally->grazing);
    /* At most a fiftieth of the scenes is left out, rounded up. */
    assert_true(tally->grazing * 50 <= tally->scenes + 49);
    assert_true(tally->pixels > 100LL * tally->scenes);
}

TEST(changes_that_keep_the_picture_keep_it)
{
    Tally tallies[CHANGE_COUNT] = {{0}};
    for (int i = 0; i < scene_count; i += step) {
        RandomScene scene;
        CLOSED(reference_close) Reference exact;
        make_scene(&scene, i);
        exact_picture(&scene, &exact);
        render(&scene, &hard.floats, &picture);
        for (int k = 0; k < CHANGE_COUNT; k++) {
            Random random = {(uint64_t)seed ^ (uint64_t)i};
            RandomScene changed = scene;
            CHANGES[k].apply(&changed, &random);
            SUCCEEDS(random_scene_ready(&changed, &meshes, message));
            render(&changed, &hard.floats, &other);
            judge(CHANGES[k].name, i, &scene,
                  largest_difference(&picture, &other, &exact, CHANGES[k].mirrored, 0,
                                     &tallies[k].pixels),
                  CHANGES[k].max, &tallies[k]);
        }
    }
    for (int k = 0; k < CHANGE_COUNT; k++)
        report(CHANGES[k].name, &tallies[k]);
}

/* The same triangles: in another order, each begun at another corner unless it has the color of its
 * last, of vertices in another order. */
static void reorder(const Mesh *from, Mesh *to, bool constant, Random *random)
{
    const size_t triangles = from->index_count / 3;
    SUCCEEDS(mesh_open(to, from->vertex_count, from->index_count, message) &&
             (!from->colors || mesh_open_colors(to, message)));
    uint32_t *place = malloc((from->vertex_count + triangles + 1) * sizeof *place);
    assert_non_null(place);
    uint32_t *order = place + from->vertex_count;
    for (uint32_t i = 0; i < from->vertex_count; i++) {
        const uint32_t k = (uint32_t)random_below(random, (int)i + 1);
        place[i] = place[k];
        place[k] = i;
    }
    for (uint32_t i = 0; i < triangles; i++) {
        const uint32_t k = (uint32_t)random_below(random, (int)i + 1);
        order[i] = order[k];
        order[k] = i;
    }
    for (size_t i = 0; i < from->vertex_count; i++) {
        to->vertices[place[i]] = from->vertices[i];
        if (from->colors)
            memcpy(to->colors[place[i]], from->colors[i], sizeof from->colors[i]);
    }
    for (size_t i = 0; i < triangles; i++) {
        const int first = constant ? 0 : random_below(random, 3);
        for (int k = 0; k < 3; k++)
            to->indices[3 * i + (size_t)k] =
                place[from->indices[3 * order[i] + (size_t)((first + k) % 3)]];
    }
    free(place);
}

TEST(the_order_of_triangles_does_not_matter)
{
    Tally tally = {0};
    for (int i = 0; i < scene_count; i += 2 * step) {
        RandomScene scene, changed;
        CLOSED(reference_close) Reference exact;
        Mesh reordered[RANDOM_MAX_OBJECTS];
        Random random = {(uint64_t)seed ^ (uint64_t)i};
        make_scene(&scene, i);
        exact_picture(&scene, &exact);
        render(&scene, &hard.floats, &picture);
        changed = scene;
        changed.scene.objects = changed.objects;
        for (int k = 0; k < scene.scene.object_count; k++) {
            reorder(scene.objects[k].mesh, &reordered[k],
                    scene.scene.interpolation == INTERPOLATION_CONSTANT, &random);
            changed.objects[k].mesh = &reordered[k];
        }
        render(&changed, &hard.floats, &other);
        judge("triangles reordered", i, &scene,
              largest_difference(&picture, &other, &exact, false, 0, &tally.pixels), 0.35, &tally);
        for (int k = 0; k < scene.scene.object_count; k++) {
            hard_forget(&reordered[k]);
            mesh_close(&reordered[k]);
        }
    }
    report("triangles reordered", &tally);
}

TEST(a_wider_picture_has_the_same_middle)
{
    Tally tally = {0};
    for (int i = 0; i < scene_count; i += 2 * step) {
        RandomScene scene;
        CLOSED(reference_close) Reference exact;
        make_scene(&scene, i);
        exact_picture(&scene, &exact);
        render(&scene, &hard.floats, &picture);
        render(&scene, &wide, &wide_image);
        judge("twice as wide", i, &scene,
              largest_difference(&picture, &wide_image, &exact, false, SIZE / 2, &tally.pixels),
              0.35, &tally);
    }
    report("twice as wide", &tally);
}

int main(void)
{
    const char *given = getenv("HARD_SEED"), *scenes = getenv("HARD_SCENES");
    if (!picture_check_driver("hard invariance"))
        return EXIT_SKIPPED;
    seed = given ? strtoull(given, NULL, 10) : seed;
    scene_count = scenes ? atoi(scenes) : SCENES;
    step = scenes ? 1 : testing_step(60);
    print_message("HARD_SEED=%llu HARD_SCENES=%d\n", seed, scene_count);
    return testing_run(0, "invariance", open_all, close_all);
}
