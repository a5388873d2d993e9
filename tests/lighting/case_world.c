#include "lighting/case_world.h"

#include "support/picture_check.h"

Canvas canvas;
Lighting *lighting;
Image specialised, full;
Mesh sphere, cube, tube;
CaseWorld world;
Random random_state;

int open_all(void **state)
{
    (void)state;
    SUCCEEDS(canvas_open(&canvas, &(CanvasOptions){.width = SIZE, .height = SIZE}, message) &&
             lighting_open(&lighting, &(ShaderLoader){0}, message) &&
             image_open(&specialised, SIZE, SIZE, IMAGE_BYTE, message) &&
             image_open(&full, SIZE, SIZE, IMAGE_BYTE, message) &&
             mesh_sphere(&sphere, 1, 24, 12, message) && mesh_cube(&cube, 0.8, message) &&
             mesh_cylinder(&tube, (MeshCylinder){0.8, 1.5, 24, 4, MESH_CAP_NONE}, message));
    return 0;
}

int close_all(void **state)
{
    (void)state;
    mesh_close(&tube);
    mesh_close(&cube);
    mesh_close(&sphere);
    image_close(&full);
    image_close(&specialised);
    lighting_close(lighting);
    canvas_close(&canvas);
    return 0;
}

const Kind KINDS[KIND_COUNT] = {
    {LIGHT_DIRECTIONAL, 0, 0, 0}, {LIGHT_POINT, 0, 0, 0},    {LIGHT_POINT, 1.25, 0, 0},
    {LIGHT_POINT, 0.5, 0.2, 0},   {LIGHT_SPOT, 0, 0, 0},     {LIGHT_SPOT, 0.5, 0.2, 0},
    {LIGHT_SPOT, 0, 0, 8},        {LIGHT_SPOT, 0.5, 0.2, 8},
};

const Case RICH = {.terms = {7, 7, 7},
                   .kinds = {0, 3, 7},
                   .light_count = 3,
                   .shape = TUBE,
                   .turn = UNEVEN,
                   .two_sided = true,
                   .base = true,
                   .alpha = true};

void render(const Scene *scene, bool with_all, Image *picture)
{
    picture_draw(&canvas, lighting, &(LightingFrame){.scene = scene, .full = with_all}, picture);
}

bool pictures_agree(const char *name, const Image *a, const Image *b, int exceptions)
{
    const int apart = pixels_apart(a->pixels, b->pixels, SIZE * SIZE, 1);
    if (apart <= exceptions)
        return true;
    printf("%s: %d pixels more than one level apart\n", name, apart);
    picture_check_keep(name, a, b);
    return false;
}

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

void draw_both(void)
{
    render(&world.scene, false, &specialised);
    render(&world.scene, true, &full);
}

int below(int limit)
{
    return random_below(&random_state, limit);
}

double between(double min, double max)
{
    return min + (max - min) * below(1 << 20) / (1 << 20);
}

Vec3 random_direction(void)
{
    Vec3 unit = {0, 0, 0};
    while (!vec3_normalize((Vec3){between(-1, 1), between(-1, 1), between(-1, 1)}, &unit))
        ;
    return unit;
}

Vec3 random_color(double most)
{
    return vec3_scale((Vec3){between(0, 1), between(0, 1), between(0, 1)}, most);
}
