/* A scene of one object by its properties, and pictures of it that are compared. */
#include "lighting/lighting_world.h"

#include "support/picture_check.h"
#include "support/testing.h"

const Vec3 BACKGROUND = {0.2, 0.3, 0.4};

Canvas canvas;
Lighting *lighting;
Image specialised, full;
Mesh sphere, smooth_sphere, cube, tube, quad;

int open_all(void **state)
{
    (void)state;
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message) &&
             lighting_open(&lighting, &(ShaderLoader){0}, message) &&
             image_open(&specialised, SIZE, SIZE, IMAGE_BYTE, message) &&
             image_open(&full, SIZE, SIZE, IMAGE_BYTE, message) &&
             mesh_sphere(&sphere, 1, 24, 12, message) &&
             mesh_sphere(&smooth_sphere, 1, 320, 160, message) && mesh_cube(&cube, 0.8, message) &&
             mesh_cylinder(&tube, (MeshCylinder){0.8, 1.5, 24, 4, MESH_CAP_NONE}, message) &&
             mesh_quad(&quad, 4, message));
    return 0;
}

int close_all(void **state)
{
    (void)state;
    Mesh *const meshes[] = {&quad, &tube, &cube, &smooth_sphere, &sphere};
    for (int i = 0; i < 5; i++)
        mesh_close(meshes[i]);
    image_close(&full);
    image_close(&specialised);
    lighting_close(lighting);
    canvas_close(&canvas);
    return 0;
}

void render(const Scene *scene, bool with_all, Image *picture)
{
    picture_draw(&canvas, lighting, &(LightingFrame){.scene = scene, .full = with_all}, picture);
}

unsigned char *pixel(const Image *image, int x, int y)
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
bool pictures_agree(const char *name, const Image *a, const Image *b, int exceptions)
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

const Kind KINDS[] = {
    {LIGHT_DIRECTIONAL, 0, 0, 0}, {LIGHT_POINT, 0, 0, 0},    {LIGHT_POINT, 1.25, 0, 0},
    {LIGHT_POINT, 0.5, 0.2, 0},   {LIGHT_SPOT, 0, 0, 0},     {LIGHT_SPOT, 0.5, 0.2, 0},
    {LIGHT_SPOT, 0, 0, 8},        {LIGHT_SPOT, 0.5, 0.2, 8},
};
LightingWorld world;

Mat4 turn_matrix(Turn turn)
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

Light light_of(int number, int terms, Kind kind)
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

void make_world(const Case *c)
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
        .background = BACKGROUND,
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
void draw_both(void)
{
    render(&world.scene, false, &specialised);
    render(&world.scene, true, &full);
}
