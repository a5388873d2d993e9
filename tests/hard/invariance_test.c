/*
 * What must not change a picture: random scenes are moved, turned, mirrored, scaled, their lights
 * permuted and split, their triangles reordered, the picture made wider; inside objects each stays
 * what it was. And the same scene gives the same bits, in a second run and with any number of the
 * driver's threads.
 *
 * Pictures are compared as floats. Two that are less than a step of 1/255 apart differ by one step
 * at most once both are rounded to bytes.
 *
 * HARD_SEED and HARD_SCENES in the environment choose other scenes.
 */
#include "picture_check.h"
#include "random_scene.h"
#include "testing.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cmocka.h>

/* Scenes of one kind share programs, of which each costs more than many pictures. */
enum { SIZE = 32, PER_KIND = 60, SCENES = 2500, HASHED = 24 };

static Hard hard;
static Canvas wide;
static Image wide_image, picture, other;
static RandomMeshes meshes;
static unsigned long long seed = 20260101;
static int scene_count = SCENES;

static int open_all(void **state)
{
    Message message = {0};
    const CanvasOptions options = {.width = 2 * SIZE, .height = SIZE, .real = true};
    (void)state;
    hard_open(&hard, SIZE, SIZE);
    if (canvas_open_beside(&wide, &hard.bytes, &options, &message) &&
        image_open(&wide_image, 2 * SIZE, SIZE, IMAGE_FLOAT, &message) &&
        image_open(&picture, SIZE, SIZE, IMAGE_FLOAT, &message) &&
        image_open(&other, SIZE, SIZE, IMAGE_FLOAT, &message))
        return 0;
    printf("%s\n", message.text);
    return 1;
}

static int close_all(void **state)
{
    (void)state;
    for (const RandomMesh *made = meshes.first; made; made = made->next)
        hard_forget(&hard, &made->mesh);
    random_meshes_close(&meshes);
    image_close(&other);
    image_close(&picture);
    image_close(&wide_image);
    canvas_close(&wide);
    hard_close(&hard);
    return 0;
}

static void make_scene(RandomScene *made, int number)
{
    Message message = {0};
    random_scene_make(made, seed + (unsigned long long)(number / PER_KIND),
                      (unsigned long long)number);
    require(random_scene_ready(made, &meshes, &message) && scene_check(&made->scene, &message),
            &message);
}

static void draw(const RandomScene *scene, const Canvas *canvas, Image *image)
{
    Message message = {0};
    require(scene_check(&scene->scene, &message) &&
                random_scene_draw(scene, canvas, hard.lightings[HARD_HIGHP], image, &message),
            &message);
}

/* What leaves a picture as it is. */

typedef struct Change {
    const char *name;
    /* Makes of a scene another, of the same picture. */
    void (*apply)(RandomScene *scene, HardRandom *random);
    bool mirrored;
    double most; /* steps of 1/255 that rounding to float may make of it */
} Change;

static void for_places(RandomScene *scene, Vec3 (*apply)(Vec3 place, double a, double b, double c),
                       Vec3 with)
{
    Camera *camera = &scene->scene.camera;
    camera->eye = apply(camera->eye, with.x, with.y, with.z);
    camera->center = apply(camera->center, with.x, with.y, with.z);
    for (int i = 0; i < scene->scene.light_count; i++)
        scene->lights[i].position = apply(scene->lights[i].position, with.x, with.y, with.z);
}

static Vec3 moved_place(Vec3 place, double x, double y, double z)
{
    return vec3_add(place, (Vec3){x, y, z});
}

/* Places are multiples of 2^-20: nothing is rounded up to 2^32. */
static void move(RandomScene *scene, HardRandom *random)
{
    const double far = ldexp(1, hard_random_below(random, 30));
    const Vec3 offset = {far, -far, hard_random_below(random, 2) ? far : 0};
    for_places(scene, moved_place, offset);
    for (int i = 0; i < scene->scene.object_count; i++)
        for (int k = 0; k < 3; k++)
            scene->objects[i].world_from_object.m[12 + k] += (&offset.x)[k];
}

/* A linear map of the whole world that keeps angles and lengths. */
static void map_world(RandomScene *scene, Mat4 map)
{
    Camera *camera = &scene->scene.camera;
    camera->eye = mat4_transform_direction(map, camera->eye);
    camera->center = mat4_transform_direction(map, camera->center);
    camera->up = mat4_transform_direction(map, camera->up);
    for (int i = 0; i < scene->scene.light_count; i++) {
        Light *light = &scene->lights[i];
        light->position = mat4_transform_direction(map, light->position);
        light->direction = mat4_transform_direction(map, light->direction);
    }
    for (int i = 0; i < scene->scene.object_count; i++)
        scene->objects[i].world_from_object =
            mat4_product(map, scene->objects[i].world_from_object);
}

static void turn(RandomScene *scene, HardRandom *random)
{
    Mat4 rotation;
    mat4_rotate(hard_random(random, 0, 360), hard_random_direction(random), &rotation);
    map_world(scene, rotation);
}

static void mirror(RandomScene *scene, HardRandom *random)
{
    const Vec3 mirrors[3] = {{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}};
    map_world(scene, mat4_scale(mirrors[hard_random_below(random, 3)]));
}

static Vec3 scaled_place(Vec3 place, double factor, double unused, double unused_too)
{
    (void)unused, (void)unused_too;
    return vec3_scale(place, factor);
}

static void scale(RandomScene *scene, HardRandom *random)
{
    const double factor = ldexp(1, hard_random_below(random, 61) - 30);
    for_places(scene, scaled_place, (Vec3){factor, 0, 0});
    scene->scene.camera.near *= factor;
    scene->scene.camera.far *= factor;
    for (int i = 0; i < scene->scene.light_count; i++) {
        scene->lights[i].linear /= factor;
        scene->lights[i].quadratic /= factor * factor;
    }
    for (int i = 0; i < scene->scene.object_count; i++)
        for (int k = 0; k < 15; k++)
            scene->objects[i].world_from_object.m[k] *= factor;
}

static void permute_lights(RandomScene *scene, HardRandom *random)
{
    for (int i = scene->scene.light_count - 1; i > 0; i--) {
        const int k = hard_random_below(random, i + 1);
        const Light light = scene->lights[i];
        scene->lights[i] = scene->lights[k];
        scene->lights[k] = light;
    }
}

/* One light becomes two in one place: a part of it, and the rest. */
static void split_light(RandomScene *scene, HardRandom *random)
{
    Light *light = &scene->lights[hard_random_below(random, scene->scene.light_count)];
    Light *rest = &scene->lights[scene->scene.light_count++];
    const double share = hard_random_below(random, 2) ? 0.5 : hard_random(random, 0.1, 0.9);
    *rest = *light;
    light->ambient = vec3_scale(light->ambient, share);
    light->diffuse = vec3_scale(light->diffuse, share);
    light->specular = vec3_scale(light->specular, share);
    rest->ambient = vec3_subtract(rest->ambient, light->ambient);
    rest->diffuse = vec3_subtract(rest->diffuse, light->diffuse);
    rest->specular = vec3_subtract(rest->specular, light->specular);
}

/* What floats make of it. Colours: a cosine is wrong by some 2^-22, its power with a shininess of
 * 128 by 2^-15 of itself; five lights' highlights of at most 2, the colours' sRGB code up to 13
 * times as steep, are 0.1 steps. Places: the corners of triangles are rounded to 1/256 of a pixel,
 * and differently in another place; inside, samples half a pixel apart differ by 1/16 at most: two
 * pictures by 2 * 1/256 * 2 * 255/16, 0.25 steps. */
static const Change CHANGES[] = {
    {"moved", move, false, 0},
    {"turned", turn, false, 0.35},
    {"mirrored", mirror, true, 0.35},
    {"scaled", scale, false, 0.35},
    {"lights permuted", permute_lights, false, 0.1},
    {"a light split", split_light, false, 0.1},
};
enum { CHANGE_COUNT = sizeof CHANGES / sizeof CHANGES[0] };

typedef struct Tally {
    double worst;
    long long pixels;
    int scenes, grazing;
} Tally;

/* The largest difference inside objects, in steps; `mirrored`: of `other` from right to left;
 * `left`: the column of `other` that belongs to the first. */
static double largest_difference(const Image *a, const Image *b, const Reference *exact,
                                 bool mirrored, int left, long long *pixels)
{
    const float *values = a->pixels, *others = b->pixels;
    double most = 0;
    for (int y = 0; y < SIZE; y++) {
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
                most = isfinite(one) && isfinite(two) ? fmax(most, 255 * apart) : INFINITY;
            }
        }
    }
    return most;
}

static void exact_picture(const RandomScene *scene, Reference *exact)
{
    Message message = {0};
    /* Edges need not be exact, only known. */
    const ReferenceOptions options = {
        .width = SIZE, .height = SIZE, .meshes = true, .edge_error = 255};
    require(reference_open(exact, &scene->scene, &options, &message), &message);
}

/* Fails where the difference is too large, unless rounding decides there. */
static void judge(const char *name, int number, const RandomScene *scene, double difference,
                  double most, Tally *tally)
{
    tally->scenes++;
    if (difference > most && random_scene_grazes(scene)) {
        tally->grazing++;
        return;
    }
    tally->worst = fmax(tally->worst, difference);
    if (difference <= most)
        return;
    random_scene_print(scene, "CHANGED", stdout);
    fail_msg("scene %d of seed %llu, %s: %g steps apart, of %g", number, seed, name, difference,
             most);
}

static void report(const char *name, const Tally *tally)
{
    print_message("%s: %d scenes, %lld pixels, at most %.4f steps apart; %d at a jump\n", name,
                  tally->scenes, tally->pixels, tally->worst, tally->grazing);
    /* Of what is left out there must be little. */
    assert_true(tally->grazing * 50 <= tally->scenes);
    assert_true(tally->pixels > 100LL * tally->scenes);
}

static void changes_leave_the_picture(void **state)
{
    Tally tallies[CHANGE_COUNT] = {{0}};
    (void)state;
    for (int i = 0; i < scene_count; i++) {
        RandomScene scene;
        Reference exact;
        make_scene(&scene, i);
        exact_picture(&scene, &exact);
        draw(&scene, &hard.floats, &picture);
        for (int k = 0; k < CHANGE_COUNT; k++) {
            Message message = {0};
            HardRandom random = {seed ^ (unsigned long long)i};
            RandomScene changed = scene;
            CHANGES[k].apply(&changed, &random);
            require(random_scene_ready(&changed, &meshes, &message), &message);
            draw(&changed, &hard.floats, &other);
            judge(CHANGES[k].name, i, &scene,
                  largest_difference(&picture, &other, &exact, CHANGES[k].mirrored, 0,
                                     &tallies[k].pixels),
                  CHANGES[k].most, &tallies[k]);
        }
        reference_close(&exact);
    }
    for (int k = 0; k < CHANGE_COUNT; k++)
        report(CHANGES[k].name, &tallies[k]);
}

/* The same triangles: in another order, each begun at another corner, of vertices in another
 * order. */
static void reorder(const Mesh *from, Mesh *to, HardRandom *random)
{
    Message message = {0};
    const size_t triangles = from->index_count / 3;
    require(mesh_open(to, from->vertex_count, from->index_count, &message), &message);
    uint32_t *place = malloc((from->vertex_count + triangles + 1) * sizeof *place);
    assert_non_null(place);
    uint32_t *order = place + from->vertex_count;
    for (uint32_t i = 0; i < from->vertex_count; i++) {
        const uint32_t k = (uint32_t)hard_random_below(random, (int)i + 1);
        place[i] = place[k];
        place[k] = i;
    }
    for (uint32_t i = 0; i < triangles; i++) {
        const uint32_t k = (uint32_t)hard_random_below(random, (int)i + 1);
        order[i] = order[k];
        order[k] = i;
    }
    for (size_t i = 0; i < from->vertex_count; i++)
        to->vertices[place[i]] = from->vertices[i];
    for (size_t i = 0; i < triangles; i++) {
        const int first = hard_random_below(random, 3);
        for (int k = 0; k < 3; k++)
            to->indices[3 * i + (size_t)k] =
                place[from->indices[3 * order[i] + (size_t)((first + k) % 3)]];
    }
    free(place);
}

static void the_order_of_triangles_does_not_matter(void **state)
{
    Tally tally = {0};
    (void)state;
    for (int i = 0; i < scene_count / 2; i++) {
        RandomScene scene, changed;
        Reference exact;
        Mesh reordered[RANDOM_MOST_OBJECTS];
        HardRandom random = {seed ^ (unsigned long long)i};
        make_scene(&scene, i);
        exact_picture(&scene, &exact);
        draw(&scene, &hard.floats, &picture);
        changed = scene;
        changed.scene.objects = changed.objects;
        for (int k = 0; k < scene.scene.object_count; k++) {
            reorder(scene.objects[k].mesh, &reordered[k], &random);
            changed.objects[k].mesh = &reordered[k];
        }
        draw(&changed, &hard.floats, &other);
        judge("triangles reordered", i, &scene,
              largest_difference(&picture, &other, &exact, false, 0, &tally.pixels), 0.35, &tally);
        for (int k = 0; k < scene.scene.object_count; k++) {
            hard_forget(&hard, &reordered[k]);
            mesh_close(&reordered[k]);
        }
        reference_close(&exact);
    }
    report("triangles reordered", &tally);
}

static void a_wider_picture_has_the_same_middle(void **state)
{
    Tally tally = {0};
    (void)state;
    for (int i = 0; i < scene_count / 2; i++) {
        RandomScene scene;
        Reference exact;
        make_scene(&scene, i);
        exact_picture(&scene, &exact);
        draw(&scene, &hard.floats, &picture);
        draw(&scene, &wide, &wide_image);
        judge("twice as wide", i, &scene,
              largest_difference(&picture, &wide_image, &exact, false, SIZE / 2, &tally.pixels),
              0.35, &tally);
        reference_close(&exact);
    }
    report("twice as wide", &tally);
}

/* Bits. */

/* FNV-1a. */
static unsigned long long hash_image(unsigned long long hash, const Image *image)
{
    const unsigned char *bytes = image->pixels;
    for (size_t i = 0; i < image_row_size(image) * (size_t)image->height; i++)
        hash = (hash ^ bytes[i]) * 0x100000001B3ULL;
    return hash;
}

static unsigned long long hash_pictures(void)
{
    unsigned long long hash = 0xCBF29CE484222325ULL;
    for (int i = 0; i < HASHED; i++) {
        RandomScene scene;
        make_scene(&scene, i * PER_KIND);
        Message message = {0};
        Lighting *lighting = hard.lightings[HARD_HIGHP];
        require(random_scene_draw(&scene, &hard.bytes, lighting, &hard.image, &message) &&
                    random_scene_draw(&scene, &hard.floats, lighting, &hard.real, &message),
                &message);
        hash = hash_image(hash_image(hash, &hard.image), &hard.real);
    }
    return hash;
}

/* What a process of its own, with so many of the driver's threads, makes of the same scenes. */
static unsigned long long hash_of_child(const char *threads)
{
    int ends[2], status;
    char text[32] = "", *end = text, seed_text[24];
    assert_int_equal(pipe(ends), 0);
    snprintf(seed_text, sizeof seed_text, "%llu", seed);
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        setenv("LP_NUM_THREADS", threads, 1);
        execl("/proc/self/exe", "invariance_test", "--hash", seed_text, (char *)NULL);
        _exit(1);
    }
    close(ends[1]);
    FILE *from = fdopen(ends[0], "r");
    assert_non_null(from);
    assert_non_null(fgets(text, sizeof text, from));
    fclose(from);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    const unsigned long long hash = strtoull(text, &end, 16);
    assert_true(end != text);
    return hash;
}

static void runs_and_threads_make_the_same_bits(void **state)
{
    (void)state;
    const unsigned long long first = hash_pictures();
    assert_true(hash_pictures() == first);
    assert_true(hash_of_child("1") == first);
    assert_true(hash_of_child("1") == first);
    assert_true(hash_of_child("2") == first);
    print_message("%d scenes, in bytes and floats: %016llx\n", HASHED, first);
}

static int main_hash(const char *seed_text)
{
    seed = strtoull(seed_text, NULL, 10);
    if (open_all(NULL) != 0)
        return 1;
    printf("%016llx\n", hash_pictures());
    return close_all(NULL);
}

int main(int count, char *arguments[])
{
    const char *given = getenv("HARD_SEED"), *scenes = getenv("HARD_SCENES");
    if (count == 3 && strcmp(arguments[1], "--hash") == 0)
        return main_hash(arguments[2]);
    if (!picture_check_driver("hard invariance"))
        return EXIT_SKIPPED;
    seed = given ? strtoull(given, NULL, 10) : seed;
    scene_count = scenes ? atoi(scenes) : scene_count;
    print_message("HARD_SEED=%llu HARD_SCENES=%d\n", seed, scene_count);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changes_leave_the_picture),
        cmocka_unit_test(the_order_of_triangles_does_not_matter),
        cmocka_unit_test(a_wider_picture_has_the_same_middle),
        cmocka_unit_test(runs_and_threads_make_the_same_bits),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
