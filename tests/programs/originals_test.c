/*
 * The lecture's pages and the textbook's demos in many states, drawn twice: by the programs, and as
 * the originals draw them. The judge shares nothing with common/lighting: a shader of a page, which
 * is the originals' equation written down (original.glsl), and arrays of vertices by their numbers.
 * Equal are pictures of which at most a thousandth of the pixels differ by more than 2 steps.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "core/mesh_buffer.h"
#include "core/mesh_make.h"
#include "scene/overlay.h"
#include "shapes/fox_head.h"
#include "shapes/mesh_solids.h"
#include "support/examples.h"
#include "support/picture_check.h"
#include "support/read_line.h"
#include "support/testing.h"

enum { SIZE = 200, LIGHTS = 4 };
/* What an original shows; light in eye coordinates. */
typedef struct Lamp {
    Vec3 place; /* w = 0: the direction towards it */
    double w;
    Vec3 ambient, diffuse, specular;
    bool off;
    bool spot;
    double cutoff; /* in degrees */
} Lamp;
typedef struct Original {
    Camera camera;
    double degrees[3], distance; /* as --orbit */
    Vec3 background, global;
    Lamp lamps[LIGHTS];
    Vec3 axis; /* of the spot */
    bool blinn, local, per_fragment, wrong_normals;
} Original;

static Canvas canvas;
static Shader shader;
static Overlay overlay;
static Image ours, theirs;

FIXTURE(open_all)
{
    const ShaderLoader loader = {.folder = testing_source("tests/programs")};
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message));
    SUCCEEDS(shader_open(&shader, &loader, "original", message));
    SUCCEEDS(overlay_open(&overlay, &(ShaderLoader){0}, message));
    SUCCEEDS(image_open(&ours, SIZE, SIZE, IMAGE_BYTE, message));
    SUCCEEDS(image_open(&theirs, SIZE, SIZE, IMAGE_BYTE, message));
}

FIXTURE(close_all)
{
    image_close(&ours);
    image_close(&theirs);
    overlay_close(&overlay);
    shader_close(&shader);
    canvas_close(&canvas);
}

/* Drawing as the originals do. */

static void set3(const char *name, Vec3 value)
{
    GLint location;
    SUCCEEDS(shader_uniform(&shader, name, &location, message));
    shader_set_vec3(location, value);
}

static void set3_at(const char *name, int i, Vec3 value)
{
    char element[32];
    snprintf(element, sizeof element, "%s[%d]", name, i);
    set3(element, value);
}

static void set4(const char *name, Mat4 value)
{
    GLint location;
    SUCCEEDS(shader_uniform(&shader, name, &location, message));
    shader_set_mat4(location, value);
}

/* A trackball turns the eye and up: azimuth about up, then the elevation, then the roll. */
static Mat4 eye_of(const Original *original)
{
    const Camera *camera = &original->camera;
    const Mat4 eye = mat4_look_at(camera->eye, camera->center, camera->up);
    const Vec3 up = mat4_transform_direction(eye, camera->up);
    const double distance = vec3_length(vec3_subtract(camera->eye, camera->center));
    const double far = distance * (original->distance != 0 ? original->distance : 1);
    /* About the centre, seen from the eye: up in the plane x = 0. */
    const Mat4 about = mat4_product(mat4_translate((Vec3){0, 0, distance}), eye);
    const double tilt = atan2(up.z, up.y) * 180 / PI;
    const Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    Mat4 turned = mat4_product(mat4_rotate(-tilt, x), about); /* up is y */
    turned = mat4_product(mat4_rotate(-original->degrees[0], y), turned);
    turned = mat4_product(mat4_rotate(tilt + original->degrees[1], x), turned);
    turned = mat4_product(mat4_rotate(original->degrees[2], z), turned);
    return mat4_product(mat4_translate((Vec3){0, 0, -far}), turned);
}

static Mat4 clip_of(const Original *original)
{
    const Camera *camera = &original->camera;
    const double top = camera->near * tan(camera->fovy * PI / 360);
    return mat4_frustum(-top, top, -top, top, camera->near, camera->far);
}

static void set_original(const Original *original)
{
    glUseProgram(shader.program);
    set4("u_Clip", clip_of(original));
    set3("u_Global", original->global);
    set3("u_Axis", original->axis);
    set3("u_PerVertex", (Vec3){original->per_fragment ? 0 : 1, 0, 0});
    for (int i = 0; i < LIGHTS; i++) {
        const Lamp *lamp = &original->lamps[i];
        const bool black = color_is_black(lamp->diffuse) && color_is_black(lamp->ambient);
        const double edge = lamp->spot ? cos(lamp->cutoff * PI / 180) : -2;
        set3_at("u_Place", i, black ? (Vec3){0, 0, 1} : lamp->place);
        set3_at("u_Kind", i, (Vec3){lamp->w, !lamp->off && !black, edge});
        set3_at("u_LightAmbient", i, lamp->ambient);
        set3_at("u_LightDiffuse", i, lamp->diffuse);
        set3_at("u_LightSpecular", i, lamp->specular);
    }
}

static void begin_original(const Original *original)
{
    canvas_clear(&canvas, original->background, 1);
    glEnable(GL_DEPTH_TEST);
    set_original(original);
}

static void draw_mesh(const Original *original, const Mesh *mesh, Mat4 world_from_object,
                      const Material *material)
{
    const Mat4 eye = mat4_product(eye_of(original), world_from_object);
    Mat4 inverse;
    GLint normal, color;
    MeshBuffer buffer;
    assert_true(mat4_inverse(eye, &inverse));
    glUseProgram(shader.program);
    set4("u_Eye", eye);
    set4("u_Normals", original->wrong_normals ? eye : mat4_transpose(inverse));
    set3("u_Ambient", material->ambient);
    set3("u_Diffuse", material->diffuse);
    set3("u_Specular", material->specular);
    set3("u_Emission", material->emission);
    set3("u_Ways", (Vec3){material->shininess, original->blinn, original->local});
    SUCCEEDS(shader_attribute(&shader, "a_Normal", &normal, message));
    SUCCEEDS(shader_attribute(&shader, "a_Color", &color, message));
    SUCCEEDS(mesh_buffer_open(&buffer, mesh, message));
    mesh_buffer_bind(&buffer, 0, normal);
    shader_set_attribute(color, (Vec3){1, 1, 1});
    mesh_buffer_bind_more(&buffer, color, -1);
    glDrawElements(GL_TRIANGLES, buffer.index_count, buffer.index_type, NULL);
    mesh_buffer_close(&buffer);
}

/* Axes of length 2 and a point of 10 pixels at each light, in the world. */
static void draw_marks(const Original *original, const Light *lights, int count)
{
    CLOSED(overlay_list_close) OverlayList lines = {.count = 0};
    CLOSED(overlay_list_close) OverlayList points = {.size = 10, .points = true};
    const Scene scene = {.camera = original->camera, .lights = lights, .light_count = count};
    overlay_add_axes(&lines, 2);
    overlay_add_lights(&points, &scene);
    SUCCEEDS(overlay_draw(&overlay, &lines, &scene, 1, message));
    SUCCEEDS(overlay_draw(&overlay, &points, &scene, 1, message));
}

static void end_original(void)
{
    SUCCEEDS(canvas_read(&canvas, &theirs, message));
}

/* The originals' meshes. */

/* A circle about z; `turn` in slices from the x axis. */
typedef struct Ring {
    double radius, z, normal_radius, normal_z, turn;
} Ring;

enum { MOST_VERTICES = 10000, MOST_INDICES = 60000 };

static void open_rings(Mesh *mesh)
{
    SUCCEEDS(mesh_open(mesh, MOST_VERTICES, MOST_INDICES, message));
    mesh->vertex_count = mesh->index_count = 0;
}

/* From bottom to top; each quadrilateral is split from its lower left to its upper right. */
static void add_rings(Mesh *mesh, const Ring *rings, int count, int slices)
{
    for (int j = 0; j < count; j++)
        for (int i = 0; i <= slices; i++) {
            const uint32_t here = (uint32_t)mesh->vertex_count++,
                           above = here + (uint32_t)slices + 1;
            const double a = 2 * PI * (i + rings[j].turn) / slices;
            const double r = rings[j].radius, n = rings[j].normal_radius;
            vec3_to_float((Vec3){r * cos(a), r * sin(a), rings[j].z},
                          mesh->vertices[here].position);
            vec3_to_float((Vec3){n * cos(a), n * sin(a), rings[j].normal_z},
                          mesh->vertices[here].normal);
            const uint32_t corners[] = {here, above + 1, above, here, here + 1, above + 1};
            for (int k = 0; k < 6 && j + 1 < count && i < slices; k++)
                mesh->indices[mesh->index_count++] = corners[k];
        }
    assert_true(mesh->vertex_count <= MOST_VERTICES && mesh->index_count <= MOST_INDICES);
}

static void add_disc(Mesh *mesh, double radius, double z, double side, int slices)
{
    add_rings(mesh, (Ring[]){{radius, z, 0, side, 0}, {0, z, 0, side, 0}}, 2, slices);
}

static void open_sphere(Mesh *mesh, double radius, int slices, int stacks)
{
    Ring rings[65];
    for (int j = 0; j <= stacks; j++) {
        const double b = PI * j / stacks - PI / 2;
        rings[j] = (Ring){radius * cos(b), radius * sin(b), cos(b), sin(b), 0};
    }
    open_rings(mesh);
    add_rings(mesh, rings, stacks + 1, slices);
}

static void open_torus(Mesh *mesh)
{
    Ring rings[33];
    for (int j = 0; j <= 32; j++) {
        const double b = 2 * PI * j / 32 - PI;
        rings[j] = (Ring){1.0 / 3 + cos(b) / 6, sin(b) / 6, cos(b), sin(b), 0};
    }
    open_rings(mesh);
    add_rings(mesh, rings, 33, 64);
}

static void open_cylinder(Mesh *mesh, double radius, double half)
{
    open_rings(mesh);
    add_rings(mesh, (Ring[]){{radius, -half, 1, 0, 0}, {radius, half, 1, 0, 0}}, 2, 64);
    add_disc(mesh, radius, half, 1, 64);
    add_disc(mesh, radius, -half, -1, 64);
}

static void open_cone(Mesh *mesh)
{
    static const double fractions[] = {0, 0.5, 0.75, 0.875, 0.9375};
    Ring rings[6];
    for (int j = 0; j < 5; j++)
        rings[j] = (Ring){0.5 * (1 - fractions[j]), 1.2 * fractions[j] - 0.6, 1.2 / 1.3, 0.5 / 1.3,
                          j % 2 == 1 ? 0.5 : 0};
    rings[5] = (Ring){0, 0.6, 1.2 / 1.3, 0.5 / 1.3, -0.5};
    open_rings(mesh);
    add_rings(mesh, rings, 6, 64);
    add_disc(mesh, 0.5, -0.6, -1, 64);
}

static double angle_between(Vec3 a, Vec3 b)
{
    return acos(fmin(fmax(vec3_dot(vec3_unit(a), vec3_unit(b)), -1), 1));
}

/* Vertices of the demos' teapot: positions and normals. */
static const Vec3 POT[][2] = {
    {{5.929688, 4.125, 0}, {-0.966742, -0.255752, 0}},
    {{-4.007656, 4.125, 6.4575}, {0.379058, -0.3593, -0.852771}},
    {{-6.042168, 4.494141, 4.900664}, {0.712664, 0.073722, -0.697621}},
    {{7.679688, -5.953125, 0}, {0.729611, -0.683863, 0}},
    {{-13.298828, 2.263184, 0.84375}, {0.161846, -0.810421, 0.563048}},
    {{10.414063, -1.728516, 2.234766}, {0.22331, 0.00654, 0.974726}},
    {{-1.070312, 7.875, 0}, {0, 1, 0}},
    {{16.070313, 4.511719, 0}, {0.888738, 0.458112, -0.016679}},
};

/* Whether a vertex of the mesh is there, with that normal, to the printed digits. */
static bool has_vertex(const Mesh *mesh, const Vec3 wanted[2])
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const Vec3 place = vec3_from_float(mesh->vertices[i].position);
        const Vec3 normal = vec3_from_float(mesh->vertices[i].normal);
        if (vec3_length(vec3_subtract(place, wanted[0])) < 3e-6)
            return vec3_length(vec3_subtract(normal, wanted[1])) < 3e-6;
    }
    return false;
}

/* Of the demos: 5 for Newell's 1, the middle of its box at the origin; normals are the mean of the
 * triangles' that meet at a place, weighted by their angles there. */
static void open_teapot(Mesh *mesh)
{
    SUCCEEDS(mesh_teapot_textbook(mesh, 10, message));
    assert_int_equal(mesh->index_count, 3 * 992);
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        const Vec3 here = vec3_from_float(mesh->vertices[v].position);
        Vec3 sum = {0, 0, 0};
        for (size_t i = 0; i < mesh->index_count; i++) {
            const uint32_t *three = mesh->indices + i - i % 3;
            const Vec3 corner = vec3_from_float(mesh->vertices[mesh->indices[i]].position);
            const Vec3 next = vec3_from_float(mesh->vertices[three[(i + 1) % 3]].position);
            const Vec3 last = vec3_from_float(mesh->vertices[three[(i + 2) % 3]].position);
            const Vec3 a = vec3_subtract(next, corner), b = vec3_subtract(last, corner);
            if (vec3_length(vec3_subtract(corner, here)) < 1e-4)
                sum = vec3_add(sum, vec3_scale(vec3_unit(vec3_cross(a, b)), angle_between(a, b)));
        }
        vec3_to_float(vec3_unit(sum), mesh->vertices[v].normal);
    }
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        const Vec3 here = vec3_from_float(mesh->vertices[v].position);
        vec3_to_float(vec3_subtract(here, (Vec3){1.0703125, 0.375, 0}), mesh->vertices[v].position);
    }
    for (size_t i = 0; i < sizeof POT / sizeof POT[0]; i++)
        assert_true(has_vertex(mesh, POT[i]));
}

/* Comparing. */

/* Draws what a line of arguments says into `ours`. */
static void draw_ours(const Example *example, const char *line)
{
    Options options;
    Renderer renderer;
    ParameterValue before[64];
    const Parameter *own = example->parameters;
    int parameters = 0;
    for (; own[parameters].name; parameters++)
        before[parameters] = parameter_save(&own[parameters]);
    const Usage usage = options_usage(example);
    if (read_line(&options, &usage, line, FAILURE) != OPTIONS_RUN)
        fail_msg("%s: %s", line, FAILURE->text);
    const DrawRequest request = options_request(&options, example);
    SUCCEEDS(renderer_open(&renderer, example, &canvas, &request, message));
    SUCCEEDS(renderer_draw(&renderer, &request, options.seconds, message));
    SUCCEEDS(canvas_read(&canvas, &ours, message));
    renderer_close(&renderer);
    for (int i = 0; i < parameters; i++)
        parameter_restore(&own[i], before[i]);
}

/* How many pixels of `ours` and `theirs` differ by more than 2 steps. */
static int wrong_pixels(void)
{
    return pixels_apart(ours.pixels, theirs.pixels, SIZE * SIZE, 2);
}

static void assert_equal_pictures(const Example *example, const char *line)
{
    draw_ours(example, line);
    const int apart = wrong_pixels();
    if (apart * 1000 <= SIZE * SIZE)
        return;
    picture_check_keep(example->name, &ours, &theirs);
    fail_msg("%s %s: %d pixels differ", example->name, line, apart);
}

/* Fails unless the program's own picture is another than `theirs`, the line's is `theirs`, and the
 * table of examples/guide/originals.md has the line. */
static void assert_differs(const Example *example, const char *usual, const char *line)
{
    size_t size;
    char *page = testing_read(testing_source("examples/guide/originals.md"), &size);
    const char *wanted = formatted("`%s %s`", example->name, line);
    if (!strstr(page, wanted))
        fail_msg("originals.md does not have %s", wanted);
    free(page);
    assert_equal_pictures(example, line);
    draw_ours(example, usual);
    if (wrong_pixels() * 1000 <= SIZE * SIZE)
        fail_msg("%s %s: is as the original", example->name, usual);
}

/* The textbook's camera: [-s, s] both ways at the centre. */
static Camera demo_camera(Vec3 eye, double s)
{
    const double d = vec3_length(eye);
    return (Camera){.eye = eye,
                    .up = {0, 1, 0},
                    .fovy = 2 * atan(s / d) * 180 / PI,
                    .near = fmax(d - 2 * s, 0.1),
                    .far = d + 2 * s};
}

static Vec3 grey(double value)
{
    return (Vec3){value, value, value};
}

static Material surface_of(Vec3 diffuse, Vec3 specular, double shininess)
{
    return (Material){
        .ambient = diffuse, .diffuse = diffuse, .specular = specular, .shininess = shininess};
}

static const Vec3 X = {1, 0, 0}, Y = {0, 1, 0};

/* Materials. */

typedef struct MaterialState {
    const char *line;
    Vec3 diffuse, specular;
    double shininess;
    double degrees[3], distance;
} MaterialState;

static const MaterialState MATERIAL_STATES[] = {
    {"", {0.6, 0.6, 0.6}, {1, 1, 1}, 16, {0}, 1},
    {"--shininess 0", {0.6, 0.6, 0.6}, {1, 1, 1}, 0, {0}, 1},
    {"--shininess 128 --diffuse 1 --specular 0", {1, 1, 1}, {0, 0, 0}, 128, {0}, 1},
    {"--diffuse 0,1,0.3 --shininess 1 --orbit 100,-35", {0, 1, 0.3}, {1, 1, 1}, 1, {100, -35}, 1},
    {"--diffuse 0 --specular 0.3,0,1 --shininess 0 --orbit -40,70,1,30",
     {0, 0, 0},
     {0.3, 0, 1},
     0,
     {-40, 70, 30},
     1},
    {"--material black_plastic --orbit 0,0,1,-130",
     {0.01, 0.01, 0.01},
     {1, 1, 1},
     32,
     {0, 0, -130},
     1},
    {"--material brass --orbit 170,20,0.9,200",
     {0.780392, 0.568627, 0.113725},
     {0.992157, 0.941176, 0.807843},
     28,
     {170, 20, 200},
     0.9},
    {"--material jade --specular 0,0.5,1", {0.54, 0.89, 0.63}, {0, 0.5, 1}, 13, {0}, 1},
};

static void check_materials(const char *shape, const Mesh *mesh, Mat4 placed)
{
    for (size_t i = 0; i < sizeof MATERIAL_STATES / sizeof MATERIAL_STATES[0]; i++) {
        const MaterialState *state = &MATERIAL_STATES[i];
        const Material material = surface_of(state->diffuse, state->specular, state->shininess);
        Original original = {.camera = demo_camera((Vec3){2, 2, 5}, 0.8),
                             .background = {1, 1, 1},
                             .distance = state->distance};
        memcpy(original.degrees, state->degrees, sizeof original.degrees);
        original.lamps[0] =
            (Lamp){.place = {0, 0, 1}, .diffuse = {1, 1, 1}, .specular = {0.4, 0.4, 0.4}};
        begin_original(&original);
        draw_mesh(&original, mesh, placed, &material);
        end_original();
        assert_equal_pictures(&Materials, formatted("--shape %s %s", shape, state->line));
    }
}

TEST(materials_has_the_demos_pictures)
{
    CLOSED(mesh_close) Mesh teapot, cube, cone, cylinder, torus, sphere;
    const Mat4 lying = mat4_rotate(-90, X);
    open_teapot(&teapot);
    SUCCEEDS(mesh_cube(&cube, 0.5, message));
    open_cone(&cone);
    open_cylinder(&cylinder, 0.5, 0.5);
    open_torus(&torus);
    open_sphere(&sphere, 0.5, 128, 64);
    check_materials("teapot", &teapot, mat4_scale((Vec3){0.05, 0.05, 0.05}));
    check_materials("cube", &cube, lying);
    check_materials("cone", &cone, lying);
    check_materials("cylinder", &cylinder, lying);
    check_materials("torus", &torus, lying);
    check_materials("sphere", &sphere, lying);
}

/* SmoothFlat. */

/* The demo's flat sphere: four vertices for each quadrilateral, with one normal; or, rightly, the
 * normal of its face. */
static void open_flat_sphere(Mesh *mesh, int slices, int stacks, bool slip)
{
    open_rings(mesh);
    for (int j = 0; j < stacks; j++)
        for (int i = 0; i < slices; i++) {
            const uint32_t first = (uint32_t)mesh->vertex_count;
            const uint32_t corners[] = {first, first + 1, first + 3, first, first + 3, first + 2};
            Vec3 p[4], sum = {0, 0, 0};
            for (int k = 0; k < 4;
                 k++) { /* (lon1, lat1), (lon1, lat2), (lon2, lat1), (lon2, lat2) */
                const double a = 2 * PI * (i + k / 2) / slices;
                const double b = PI * (j + k % 2) / stacks - PI / 2;
                p[k] = (Vec3){cos(a) * cos(b), sin(a) * cos(b), sin(b)};
                sum = vec3_add(sum, vec3_scale(p[k], k == 3 ? 0.25 : 1));
            }
            if (!slip) /* the diagonals' */
                sum = vec3_cross(vec3_subtract(p[3], p[0]), vec3_subtract(p[1], p[2]));
            for (int k = 0; k < 4; k++) {
                MeshVertex *vertex = &mesh->vertices[mesh->vertex_count++];
                vec3_to_float(vec3_scale(p[k], 4), vertex->position);
                vec3_to_float(vec3_unit(sum), vertex->normal);
            }
            for (int k = 0; k < 6; k++)
                mesh->indices[mesh->index_count++] = corners[k];
        }
}

TEST(smooth_flat_has_the_demos_pictures)
{
    static const int sizes[][2] = {{8, 4}, {3, 2}, {64, 32}, {5, 12}};
    static const char *const kinds[] = {"smooth", "original", "flat"};
    const Material material = surface_of(grey(0.7), grey(0.2), 16);
    Original original = {
        .camera = demo_camera((Vec3){0, 0, 30}, 5), .global = grey(0.2), .degrees = {0, 0, 0}};
    original.lamps[0] = (Lamp){.place = {0, 0, 1}, .diffuse = grey(1), .specular = grey(1)};
    for (int i = 0; i < 24; i++) {
        const int *size = sizes[i / 6];
        const char *kind = kinds[i % 3], *orbit = i / 3 % 2 ? "--orbit 30,-50,1,10" : "";
        CLOSED(mesh_close) Mesh mesh;
        if (i % 3 == 0)
            open_sphere(&mesh, 4, size[0], size[1]);
        else
            open_flat_sphere(&mesh, size[0], size[1], i % 3 == 1);
        memcpy(original.degrees, i / 3 % 2 ? (double[]){30, -50, 10} : (double[]){0, 0, 0},
               sizeof original.degrees);
        begin_original(&original);
        draw_mesh(&original, &mesh, mat4_rotate(-90, X), &material);
        end_original();
        assert_equal_pictures(&SmoothFlat, formatted("--normals %s --slices %d --stacks %d %s",
                                                     kind, size[0], size[1], orbit));
        if (i == 1)
            assert_differs(&SmoothFlat, "--normals flat", "--normals original");
    }
}

/* FourLights. */

static Vec3 hue(double degrees)
{
    const double sector = degrees / 60, up = 0.6 * fmod(sector, 1), down = 0.6 - up;
    const Vec3 colors[] = {{0.6, up, 0},   {down, 0.6, 0}, {0, 0.6, up},
                           {0, down, 0.6}, {up, 0, 0.6},   {0.6, 0, down}};
    return colors[(int)sector];
}

/* Bits: viewpoint, red, green, blue, global ambient, base. */
static void make_four(Original *original, double frame, unsigned on)
{
    const double angles[] = {-frame, 0.8743 * (frame + 100), 1.3057 * (frame - 100)};
    static const Vec3 starts[] = {{10, 7, 0}, {9, 8, 0}, {9.5, 7.5, 0}};
    *original = (Original){.camera = demo_camera((Vec3){5, 10, 30}, 15), .local = true};
    original->global = grey(on & 16 ? 0.15 : 0);
    original->lamps[0] =
        (Lamp){.place = {0, 0, 1}, .diffuse = grey(0.5), .specular = grey(0.5), .off = !(on & 1)};
    for (int i = 0; i < 3; i++) {
        const Vec3 color = {i == 0, i == 1, i == 2};
        const Vec3 place = mat4_transform_point(mat4_rotate(angles[i], Y), starts[i]);
        original->lamps[1 + i] = (Lamp){.place = place,
                                        .w = 1,
                                        .ambient = vec3_scale(color, 0.1),
                                        .diffuse = vec3_scale(color, 0.5),
                                        .specular = vec3_scale(color, 0.5),
                                        .off = !(on >> (1 + i) & 1)};
    }
}

/* Lamps' places from the world to the eye. */
static void to_eye(Original *original)
{
    const Mat4 eye = eye_of(original);
    for (int i = 0; i < LIGHTS; i++) {
        Lamp *lamp = &original->lamps[i];
        const Vec4 place =
            mat4_transform(eye, (Vec4){lamp->place.x, lamp->place.y, lamp->place.z, lamp->w});
        lamp->place = (Vec3){place.x, place.y, place.z};
    }
}

/* `original` gets the lamps in eye coordinates. */
static void draw_four(double frame, unsigned on, const double degrees[3], Original *world,
                      Original *original)
{
    CLOSED(mesh_close) Mesh teapot, base;
    const Mat4 up = mat4_translate((Vec3){0, 0.68, 0}), low = mat4_translate((Vec3){0, -5, 0});
    const Mat4 flat = mat4_product(mat4_rotate(-90, X), mat4_scale((Vec3){10, 10, 0.5}));
    const Material gray = surface_of(grey(0.7), grey(0.2), 32);
    const Material own = surface_of(grey(1), grey(0), 32);
    open_teapot(&teapot);
    open_cylinder(&base, 1, 1);
    SUCCEEDS(mesh_open_colors(&base, message));
    for (size_t i = 0; i < base.vertex_count; i++) {
        const float *p = base.vertices[i].position;
        const bool rim = hypot((double)p[0], (double)p[1]) > 0.5;
        vec3_to_float(rim ? hue(359 * (double)(i % 65) / 64) : grey(1), base.colors[i]);
    }
    make_four(world, frame, on);
    memcpy(world->degrees, degrees, sizeof world->degrees);
    *original = *world;
    to_eye(original);
    original->lamps[0].place = (Vec3){0, 0, 1}; /* at the viewer */
    begin_original(original);
    draw_mesh(original, &teapot, mat4_product(up, mat4_scale(grey(0.65))), &gray);
    if (on & 32)
        draw_mesh(original, &base, mat4_product(low, flat), &own);
    CLOSED(mesh_close) Mesh marker;
    open_sphere(&marker, 0.5, 16, 8);
    for (int i = 1; i < 4; i++) {
        Material material = surface_of(grey(0.5), grey(0), 32);
        if (!world->lamps[i].off)
            material.emission = world->lamps[i].diffuse;
        draw_mesh(original, &marker, mat4_translate(world->lamps[i].place), &material);
    }
    end_original();
}

TEST(four_lights_has_the_demos_pictures)
{
    static const struct {
        int frame;
        unsigned on;
        double degrees[3];
        const char *line;
    } states[] = {
        {0, 63, {0}, ""},
        {50, 63, {0}, ""},
        {201, 63, {60, 20, -15}, "--orbit 60,20,1,-15"},
        {-400, 0, {0}, "--viewpoint off --red off --green off --blue off --ambient off --base off"},
        {100, 1 + 32, {0}, "--red off --green off --blue off --ambient off"},
        {100, 2 + 16, {0}, "--viewpoint off --green off --blue off --base off"},
        {33, 4 + 32, {0}, "--viewpoint off --red off --blue off --ambient off"},
        {77, 8 + 4 + 16 + 32, {0}, "--viewpoint off --red off"},
    };
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++) {
        Original world, original;
        char line[256];
        draw_four(states[i].frame, states[i].on, states[i].degrees, &world, &original);
        snprintf(line, sizeof line, "--time %.2f %s", 0.03 * states[i].frame, states[i].line);
        assert_equal_pictures(&FourLights, line);
    }
}

/* The lecture's pages. */

static const Material GOLD = {.ambient = {0.24725, 0.1995, 0.0745},
                              .diffuse = {0.75164, 0.60648, 0.22648},
                              .specular = {0.628281, 0.555802, 0.366065},
                              .shininess = 51.2};

/* The four pairs of reflection model and interpolation. */
static const char *set_pair(Original *original, int pair)
{
    static const char *const pairs[] = {"--reflection phong --interpolation phong",
                                        "--reflection phong --interpolation gouraud",
                                        "--reflection blinn-phong --interpolation phong",
                                        "--reflection blinn-phong --interpolation gouraud"};
    original->local = true;
    original->blinn = pair >= 2;
    original->per_fragment = pair % 2 == 0;
    return pairs[pair];
}

static Vec3 turned(Vec3 place, double seconds)
{
    return mat4_transform_point(mat4_rotate(30 * seconds, Y), place);
}

static void open_lecture_shape(Mesh *mesh, bool cube)
{
    if (cube)
        SUCCEEDS(mesh_cube(mesh, 1, message));
    else
        SUCCEEDS(mesh_sphere_lecture(mesh, 20, message));
}

static void draw_page(Original *original, const Light *lights, int count, bool cube, double turn)
{
    CLOSED(mesh_close) Mesh mesh;
    open_lecture_shape(&mesh, cube);
    original->background = grey(0.2);
    begin_original(original);
    draw_mesh(original, &mesh, mat4_rotate(turn, Y), &GOLD);
    draw_marks(original, lights, count);
    end_original();
}

static void spot_original(Original *original, Light *light, double seconds, double cutoff)
{
    *original = (Original){
        .camera = {.eye = {3, 3, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100}};
    *light = (Light){.kind = LIGHT_POINT, .position = turned((Vec3){0, 0, 1.5}, seconds)};
    original->lamps[0] = (Lamp){.place = light->position,
                                .w = 1,
                                .ambient = grey(0.1),
                                .diffuse = grey(1),
                                .specular = grey(1),
                                .spot = true,
                                .cutoff = cutoff};
    to_eye(original);
    original->axis =
        mat4_transform_direction(eye_of(original), vec3_unit(vec3_scale(light->position, -1)));
}

TEST(spot_light_has_the_pages_pictures)
{
    static const double cutoffs[] = {30, 0, 7, 55, 90}, times[] = {0, 1.3, 4, 9.5};
    for (int i = 0; i < 40; i++) {
        const double cutoff = cutoffs[i % 5], seconds = times[i / 5 % 4];
        const bool cube = i / 20;
        Original original;
        Light light;
        spot_original(&original, &light, seconds, cutoff);
        const char *line = formatted("--shape %s --cutoff %g -t %g %s", cube ? "cube" : "sphere",
                                     cutoff, seconds, set_pair(&original, i / 5 % 4));
        draw_page(&original, &light, 1, cube, 0);
        assert_equal_pictures(&SpotLight, line);
    }
    draw_ours(&SpotLight, "--ambient-cone on"); /* as OpenGL 1.1 has it: black beside the cone */
    assert_true(wrong_pixels() > SIZE * SIZE / 10);
}

/* A page with one point light and the camera of two of them. */
static void point_original(Original *original, Light *light, Vec3 place, double ambient)
{
    *original = (Original){
        .camera = {.eye = {3, 2, 3}, .up = {0, 1, 0}, .fovy = 60, .near = 1, .far = 100}};
    *light = (Light){.kind = LIGHT_POINT, .position = place};
    original->lamps[0] = (Lamp){
        .place = place, .w = 1, .ambient = grey(ambient), .diffuse = grey(1), .specular = grey(1)};
    to_eye(original);
}

TEST(normal_matrix_has_the_pages_pictures)
{
    CLOSED(mesh_close) Mesh mesh;
    open_lecture_shape(&mesh, false);
    for (int i = 0; i < 16; i++) {
        const double seconds = 2.9 * (i / 2);
        Original original;
        Light light;
        point_original(&original, &light, turned((Vec3){1.5, 1, 0}, seconds), 0.5);
        original.background = grey(0.2);
        original.wrong_normals = i % 2;
        const char *line = formatted("--matrix %s -t %g %s", i % 2 ? "wrong" : "right", seconds,
                                     set_pair(&original, i / 2 % 4));
        begin_original(&original);
        draw_mesh(&original, &mesh, mat4_scale((Vec3){2, 0.7, 0.7}), &GOLD);
        draw_marks(&original, &light, 1);
        end_original();
        assert_equal_pictures(&NormalMatrix, line);
    }
}

/* The back has the opposite normal and its own material. */
TEST(two_sided_lighting_has_the_pages_pictures)
{
    static const Material silver = {.ambient = {0.19225, 0.19225, 0.19225},
                                    .diffuse = {0.50754, 0.50754, 0.50754},
                                    .specular = {0.508273, 0.508273, 0.508273},
                                    .shininess = 51.2};
    for (int i = 0; i < 16; i++) {
        const double seconds = 1.4 * i;
        const Vec3 front = turned((Vec3){0, 0, 1}, seconds);
        const bool back = vec3_dot(front, (Vec3){3, 2, 3}) < 0;
        CLOSED(mesh_close) Mesh quad;
        Original original;
        Light light;
        SUCCEEDS(mesh_quad(&quad, 1, message));
        for (size_t v = 0; v < quad.vertex_count && back; v++)
            quad.vertices[v].normal[2] = -1;
        point_original(&original, &light, (Vec3){0, 0.5, 0.5}, 0.2);
        original.background = grey(0.5);
        const char *line = formatted("-t %g %s", seconds, set_pair(&original, i % 4));
        begin_original(&original);
        draw_mesh(&original, &quad, mat4_rotate(30 * seconds, Y), back ? &silver : &GOLD);
        draw_marks(&original, &light, 1);
        end_original();
        assert_equal_pictures(&TwoSidedLighting, line);
    }
}

/* A state of the shading page: two lights, each on or off, directional or a point light. */
typedef struct ShadingState {
    double seconds;
    bool point[2], off[2];
} ShadingState;

static void shading_original(Original *original, Light lights[2], const ShadingState *state,
                             double distance)
{
    const Vec3 places[] = {{0, 1.5, 1.5}, turned((Vec3){1.5, 1.5, 0}, state->seconds)};
    *original = (Original){
        .camera = {.eye = {2, 1, 3}, .up = {0, 1, 0}, .fovy = 50, .near = 1, .far = 100}};
    original->camera.eye = vec3_scale(original->camera.eye, distance);
    for (int k = 0; k < 2; k++) {
        lights[k] = (Light){.kind = LIGHT_POINT, .position = places[k], .off = state->off[k]};
        original->lamps[k] = (Lamp){.place = places[k],
                                    .w = state->point[k],
                                    .ambient = grey(0.1),
                                    .diffuse = grey(1),
                                    .specular = grey(1),
                                    .off = state->off[k]};
    }
    to_eye(original);
}

static const char *kind_name(bool point)
{
    return point ? "point" : "directional";
}

static const char *switch_name(bool off)
{
    return off ? "off" : "on";
}

TEST(shading_models_has_the_pages_pictures)
{
    static const double times[] = {0, 2.2, 7, 10.1};
    for (int i = 0; i < 32; i++) {
        const ShadingState now = {times[i % 4], {i % 2, i / 2 % 2}, {i % 5 == 3, i % 5 == 2}};
        const bool cube = i / 16, rotating = i % 3 == 1;
        Original original;
        Light lights[2];
        char line[256];
        shading_original(&original, lights, &now, cube ? 1.15 : 1);
        snprintf(
            line, sizeof line,
            "--shape %s --rotating %s -t %g --fixed-kind %s --turning-kind %s --fixed-light %s "
            "--turning-light %s %s",
            cube ? "cube" : "sphere", switch_name(!rotating), now.seconds, kind_name(now.point[0]),
            kind_name(now.point[1]), switch_name(now.off[0]), switch_name(now.off[1]),
            set_pair(&original, i / 4 % 4));
        draw_page(&original, lights, 2, cube, rotating ? -30 * now.seconds : 0);
        assert_equal_pictures(&ShadingModels, line);
    }
}

/* What differs: the table of examples/guide/originals.md. */

/* A page as at its beginning, with a head instead of its monkey. */
static void draw_head(Original *original, const Light *lights, int count)
{
    CLOSED(mesh_close) Mesh head;
    SUCCEEDS(mesh_head(&head, HEAD_SMOOTH, message));
    original->background = grey(0.2);
    begin_original(original);
    draw_mesh(original, &head, mat4_identity(), &GOLD);
    draw_marks(original, lights, count);
    end_original();
}

TEST(the_shading_page_differs_as_the_guide_says)
{
    const ShadingState first = {0, {true, true}, {false, false}};
    Original original;
    Light lights[2];
    shading_original(&original, lights, &first, 1);
    (void)set_pair(&original, 3);
    draw_head(&original, lights, 2);
    assert_differs(&ShadingModels, "",
                   "--shape head-smooth --reflection blinn-phong --interpolation gouraud");
    draw_page(&original, lights, 2, false, 0);
    assert_differs(&ShadingModels, "--reflection phong --interpolation gouraud",
                   "--reflection original --interpolation gouraud");
    (void)set_pair(&original, 0);
    draw_page(&original, lights, 2, true, 0);
    assert_differs(&ShadingModels, "--shape cube", "--shape cube --orbit 0,0,0.869565");
}

TEST(the_spot_lights_page_differs_as_the_guide_says)
{
    Original original;
    Light light;
    spot_original(&original, &light, 0, 30);
    (void)set_pair(&original, 0);
    draw_head(&original, &light, 1);
    assert_differs(&SpotLight, "", "--shape head-smooth");
}

/* The demo's spheres are lit by the lights of the frame before, as far as they are not yet placed,
 * and by its global ambient light: in the first frame by none. Only their pixels differ. */
TEST(the_spheres_of_four_lights_differ_as_the_guide_says)
{
    CLOSED(mesh_close) Mesh marker;
    Original world, original;
    open_sphere(&marker, 0.5, 16, 8);
    for (int first = 0; first < 2; first++) {
        draw_four(0, 63, (double[]){0, 0, 0}, &world, &original);
        for (int i = 1; i < 4; i++) {
            Material material = surface_of(grey(0.5), grey(0), 32);
            Original frame = original;
            material.emission = world.lamps[i].diffuse;
            for (int k = i + 1; k < 4; k++)
                frame.lamps[k].off = first;
            frame.global = grey(first ? 0 : 0.15);
            set_original(&frame);
            glDepthFunc(GL_LEQUAL);
            draw_mesh(&frame, &marker, mat4_translate(world.lamps[i].place), &material);
            glDepthFunc(GL_LESS);
        }
        end_original();
        draw_ours(&FourLights, "");
        assert_true((wrong_pixels() * 1000 > SIZE * SIZE) == first);
        assert_true(wrong_pixels() < SIZE * SIZE / 200);
    }
}

int main(void)
{
    return picture_check_run("originals", open_all, close_all);
}
