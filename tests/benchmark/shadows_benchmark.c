/*
 * What shadows cost: a teapot over a floor in the light of one and of three lights, and the scene
 * of Shadows, each without shadows, without again, and in each way; and how far shadow maps of each
 * size, bias and filter are from the exact picture of the same meshes.
 */
#include "benchmark/measure.h"
#include "core/canvas.h"
#include "core/example.h"
#include "reference/picture_error.h"
#include "reference/reference.h"
#include "scene/lighting.h"
#include "scene/scene_example.h"
#include "shapes/mesh_solids.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 400, ROUNDS = 21, FRAMES = 4, SCENES = 5, SMALL_MAP = 512 };

/* The first two are without shadows. */
enum { WITHOUT, AGAIN, VOLUMES, ON, MAP, MOVING_MAP, WAYS };

extern const Example Shadows;

static Canvas canvas;
static Lighting *lighting;
static Mesh teapot, plane, ball;

typedef struct Way {
    ShadowSettings shadows;
    bool moving; /* the lights */
    Light lights[3];
    Scene scene;
} Way;

typedef struct Setting {
    const char *name;
    Object objects[2];
    Way ways[WAYS];
} Setting;
static Setting settings[SCENES];

static void set_ways(Setting *setting)
{
    static const int ways[WAYS] = {SHADOWS_OFF, SHADOWS_OFF, SHADOWS_VOLUMES,
                                   SHADOWS_ON,  SHADOWS_MAP, SHADOWS_MAP};
    for (int w = 0; w < WAYS; w++) {
        Way *way = &setting->ways[w];
        way->shadows = SHADOWS_DEFAULT;
        way->shadows.way = ways[w];
        way->shadows.map_size = SMALL_MAP;
        way->moving = w == MOVING_MAP;
        for (int i = 0; i < way->scene.light_count; i++)
            way->lights[i].shadows = ways[w] != SHADOWS_OFF;
        way->scene.lights = way->lights;
    }
}

static void make_setting(Setting *setting, const char *name, const Mesh *mesh, int lights,
                         LightKind kind)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0}), large = mat4_scale((Vec3){3, 3, 3});
    const Material grey = {{0.3, 0.3, 0.3}, {0.4, 0.4, 0.4}, {0.3, 0.3, 0.3}, {0, 0, 0}, 1, 30};
    static const Vec3 places[3] = {{1.5, 3, 2}, {-2, 3, 1}, {0.5, 4, -2}};
    setting->name = name;
    setting->objects[0] = (Object){.mesh = mesh,
                                   .solid = {.kind = mesh == &ball ? SOLID_SPHERE : SOLID_TEAPOT,
                                             .radius = mesh == &ball ? 0.75 : 1},
                                   .closed = mesh == &ball,
                                   .world_from_object = mat4_identity(),
                                   .front = grey};
    setting->objects[1] =
        (Object){.mesh = &plane,
                 .solid = {.kind = SOLID_QUAD},
                 .flat = true,
                 .world_from_object =
                     mat4_product(mat4_translate((Vec3){0, -0.75, 0}), mat4_product(lying, large)),
                 .front = grey};
    for (int way = 0; way < WAYS; way++) {
        for (int i = 0; i < lights; i++)
            setting->ways[way].lights[i] = (Light){.kind = kind,
                                                   .position = places[i],
                                                   .direction = places[i],
                                                   .diffuse = {0.4, 0.4, 0.4},
                                                   .specular = {0.3, 0.3, 0.3}};
        setting->ways[way].scene =
            (Scene){.camera = {{0, 2.5, 5.5}, {0, 0, 0}, {0, 1, 0}, 40, 1, 30, 0},
                    .light_count = lights,
                    .objects = setting->objects,
                    .object_count = 2};
    }
    set_ways(setting);
}

/* The scene of the program, whose lights have shadows. */
static void make_program(Setting *setting)
{
    setting->name = "Shadows";
    for (int way = 0; way < WAYS; way++) {
        Scene *scene = &setting->ways[way].scene;
        Shadows.scene->make(0, 0, scene);
        for (int i = 0; i < scene->light_count; i++)
            setting->ways[way].lights[i] = scene->lights[i];
    }
    set_ways(setting);
}

static bool draw(void *argument)
{
    Way *way = argument;
    const Scene *scene = &way->scene;
    lighting_use_shadows(lighting, &way->shadows);
    for (int i = 0; i < FRAMES; i++) {
        for (int l = 0; l < scene->light_count && way->moving; l++) {
            way->lights[l].position.x += 1e-9;
            way->lights[l].direction.x += 1e-9;
        }
        canvas_clear(&canvas, scene->background, 1);
        if (!lighting_draw(lighting, scene, 1, false, NULL))
            return false;
    }
    glFinish();
    return true;
}

static bool measure_setting(Setting *setting, Table *table)
{
    Measured measured[WAYS];
    char cells[WAYS][48];
    for (int way = 0; way < WAYS; way++)
        measured[way] = (Measured){setting->name, draw, &setting->ways[way], NULL};
    const LightingCounts before = lighting_counts(lighting);
    bool done = draw(&setting->ways[VOLUMES]);
    const LightingCounts after = lighting_counts(lighting);
    done = done && measure_rounds(measured, WAYS, ROUNDS);
    for (int way = 0; way < WAYS && done; way++) {
        const Summary ratio = measure_ratio(&measured[way], &measured[WITHOUT], 1, ROUNDS);
        snprintf(cells[way], sizeof cells[way], "%s", measure_cell(ratio, 1, 2).text);
    }
    if (done)
        table_row(table, "%s|%s|%s|%s|%s|%s|%s|%lld", setting->name,
                  measure_cell(measure_summary(measured[0].seconds, ROUNDS), 1e3 / FRAMES, 2).text,
                  cells[AGAIN], cells[VOLUMES], cells[ON], cells[MAP], cells[MOVING_MAP],
                  (after.volume_triangles - before.volume_triangles) / FRAMES);
    measure_finish(measured, WAYS);
    return done;
}

/* How far from the exact picture. */

typedef struct Exact {
    Reference picture;
    unsigned char near[SIZE * SIZE]; /* within two pixels of a shadow's edge */
} Exact;
static Exact exact;
static Image image;

static bool is_dark(const Reference *with, const Reference *without, size_t pixel)
{
    double most = 0;
    for (size_t k = 0; k < 3; k++)
        most = fmax(
            most, fabs((double)with->color[3 * pixel + k] - (double)without->color[3 * pixel + k]));
    return most > 0.5 / 255;
}

static bool find_exact(const Setting *setting, Message *message)
{
    enum { NEAR = 2 };
    const ReferenceOptions options = {.width = SIZE, .height = SIZE, .meshes = true};
    Reference bare;
    if (!reference_open(&exact.picture, &setting->ways[VOLUMES].scene, &options, message) ||
        !reference_open(&bare, &setting->ways[WITHOUT].scene, &options, message))
        return false;
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            bool dark = false, lit = false;
            for (int v = y - NEAR; v <= y + NEAR; v++) {
                for (int u = x - NEAR; u <= x + NEAR; u++) {
                    if (u < 0 || v < 0 || u >= SIZE || v >= SIZE)
                        continue;
                    const bool here = is_dark(&exact.picture, &bare, (size_t)(v * SIZE + u));
                    dark |= here;
                    lit |= !here;
                }
            }
            exact.near[y * SIZE + x] = dark && lit;
        }
    }
    reference_close(&bare);
    return true;
}

static bool add_survey(Setting *setting, const char *name, const ShadowSettings *shadows,
                       Table *table, Message *message)
{
    static Way ways[2];
    PictureError error = {.all = {0}};
    ErrorSum near = {0};
    ways[0] = setting->ways[WITHOUT];
    ways[1] = setting->ways[VOLUMES];
    for (int w = 0; w < 2; w++)
        ways[w].scene.lights = ways[w].lights;
    ways[1].shadows = *shadows;
    Measured measured[2] = {{name, draw, &ways[0], NULL}, {name, draw, &ways[1], NULL}};
    const int rounds = ROUNDS / 2;
    bool done = measure_rounds(measured, 2, rounds) && canvas_read(&canvas, &image, message);
    if (done) {
        canvas_clear(&canvas, ways[1].scene.background, 0);
        done = lighting_draw(lighting, &ways[1].scene, 1, false, message) &&
               canvas_read(&canvas, &image, message);
    }
    if (done) {
        picture_error_add(&error, &image, 0, 0, &exact.picture, NULL, &ways[1].scene);
        for (size_t i = 0; i < SIZE * SIZE; i++)
            if (exact.near[i])
                error_sum_add(&near, pixel_error(&image, i, &exact.picture.color[3 * i]), i);
        table_row(table, "%s|%.2f|%.2f|%lld|%s", name, error_sum_rms(&error.all),
                  error_sum_rms(&near), error.interior.wrong,
                  measure_cell(measure_ratio(&measured[1], &measured[0], 1, rounds), 1, 2).text);
    }
    measure_finish(measured, 2);
    return done;
}

static bool survey(Setting *setting, Message *message)
{
    static const struct {
        const char *name;
        Vec3 bias;
    } biases[] = {{"without bias", {0, 0, 0}},
                  {"constant bias of 2", {2, 0, 0}},
                  {"slope-scaled bias of 1", {0.5, 1, 0}},
                  {"along the normal by 1", {0.5, 0, 1}}};
    char title[96], name[64];
    Table table;
    ShadowSettings shadows = SHADOWS_DEFAULT;
    if (!find_exact(setting, message))
        return false;
    snprintf(title, sizeof title, "%s, against the exact picture", setting->name);
    table_open(&table, "|error, all pixels|near shadows' edges|wrong inside|time over none");
    shadows.way = SHADOWS_VOLUMES;
    bool done = add_survey(setting, "volumes", &shadows, &table, message);
    shadows.way = SHADOWS_PLANAR;
    done = done && add_survey(setting, "planar", &shadows, &table, message);
    shadows.way = SHADOWS_MAP;
    for (int size = 64; size <= 4096 && done; size *= 2) {
        for (int smooth = 0; smooth < 2 && done; smooth++) {
            shadows.map_size = size;
            shadows.smooth = smooth;
            snprintf(name, sizeof name, "map:%d%s", size, smooth ? ", 2x2" : "");
            done = add_survey(setting, name, &shadows, &table, message);
        }
    }
    shadows = (ShadowSettings){.way = SHADOWS_MAP, .map_size = SHADOWS_DEFAULT.map_size};
    for (size_t i = 0; i < sizeof biases / sizeof biases[0] && done; i++) {
        shadows.bias = biases[i].bias;
        snprintf(name, sizeof name, "map:%d %s", shadows.map_size, biases[i].name);
        done = add_survey(setting, name, &shadows, &table, message);
    }
    reference_close(&exact.picture);
    measure_print_table(title, &table);
    return done;
}

static bool measure_all(Message *message)
{
    Table table;
    bool done = true;
    make_setting(&settings[0], "a teapot over a floor, directional light", &teapot, 1,
                 LIGHT_DIRECTIONAL);
    make_setting(&settings[1], "the same, a point light", &teapot, 1, LIGHT_POINT);
    make_setting(&settings[2], "the same, three point lights", &teapot, 3, LIGHT_POINT);
    make_setting(&settings[3], "a sphere over a floor, a point light", &ball, 1, LIGHT_POINT);
    make_program(&settings[4]);
    table_open(&table, "|without shadows, ms|again, over that|volumes|on|map:512|map:512, lights "
                       "move|triangles of volumes");
    for (int i = 0; i < SCENES; i++)
        done = done && measure_setting(&settings[i], &table);
    measure_print_table("shadows", &table);
    return done && survey(&settings[3], message) && survey(&settings[4], message);
}

int main(int argc, char *argv[])
{
    Message message = {0};
    measure_begin(&argc, argv);
    const bool done =
        canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, &message) &&
        lighting_open(&lighting, &(ShaderLoader){0}, &message) &&
        image_open(&image, SIZE, SIZE, IMAGE_BYTE, &message) &&
        mesh_teapot(&teapot, 1, 10, &message) && mesh_quad(&plane, 1, &message) &&
        mesh_sphere(&ball, 0.75, 48, 24, &message) && Shadows.init(&(ShaderLoader){0}, &message);
    if (done)
        measure_print_machine(canvas.renderer, canvas.version);
    const bool measured = done && measure_all(&message);
    if (!measured)
        fprintf(stderr, "shadows_benchmark: %s\n", message.text);
    if (done)
        Shadows.finish();
    lighting_close(lighting);
    image_close(&image);
    mesh_close(&teapot);
    mesh_close(&plane);
    mesh_close(&ball);
    canvas_close(&canvas);
    return measured ? 0 : 1;
}
