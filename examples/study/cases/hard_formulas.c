/*
 * The cases of formulas: what each scene makes hard, and the plain form that fails on it.
 */
#include "study/cases/hard_case.h"

#include "core/mesh_make.h"

#include <string.h>

/* Half a sphere, flattened to a disc. */
static void make_singular(HardScene *made)
{
    Mesh *mesh = &made->mesh;
    size_t kept = 0;
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        double height = 0;
        for (size_t k = 0; k < 3; k++)
            height += (double)mesh->vertices[mesh->indices[i + k]].position[1];
        for (size_t k = 0; k < 3 && height > 0; k++)
            mesh->indices[kept++] = mesh->indices[i + k];
    }
    mesh->index_count = kept;
    made->scene.camera.eye = (Vec3){0, 2.5, 3};
}

static void make_uneven(HardScene *made)
{
    const Mat4 turned = mat4_rotate(35, (Vec3){0, 0, 1});
    made->objects[0].world_from_object = mat4_product(turned, made->objects[0].world_from_object);
}

static void spoil_normals(HardScene *made)
{
    made->naive_objects[0].wrong_normals = true;
}

/* The camera above the teapot, with its up vector LEAN radians from the view direction. */
static void make_look_at(HardScene *made)
{
    static const double LEAN = 1e-7;
    Vec3 behind, side;
    Camera *camera = &made->scene.camera;
    camera->eye = (Vec3){0.7, 3.1, 2.3};
    vec3_normalize(camera->eye, &behind);
    vec3_normalize(vec3_cross(vec3_cross(behind, (Vec3){0, 1, 0}), behind), &side);
    camera->up = vec3_subtract(behind, vec3_scale(side, -LEAN));
}

static void make_far(HardScene *made)
{
    static const Vec3 offset = {5000000.3, 1000000.7, -2500000.1};
    Camera *camera = &made->scene.camera;
    made->objects[0].world_from_object = mat4_translate(offset);
    made->lights[0].position = vec3_add(made->lights[0].position, offset);
    camera->eye = vec3_add(camera->eye, offset);
    camera->center = vec3_add(camera->center, offset);
}

/* Some normals are zero, as in defective model files. */
static void make_zero_normals(HardScene *made)
{
    made->scene.global_ambient = (Vec3){0.45, 0.45, 0.45};
    made->lights[0].diffuse = (Vec3){0.5, 0.5, 0.5};
    for (size_t i = 0; i < made->mesh.vertex_count; i++) {
        const float *p = made->mesh.vertices[i].position;
        if (p[0] + p[1] > 0.15F && p[0] + p[1] < 0.75F)
            memset(made->mesh.vertices[i].normal, 0, sizeof made->mesh.vertices[i].normal);
    }
}

/* A strip whose ends have opposite normals, with its middle at a pixel's center. Their sum is
 * exactly 0 there because the strip has 32 pixels, a power of two. */
static void make_cancelling(HardScene *made)
{
    static const double FOVY = 80.31199924983865; /* 27 pixels are 27/16 high at distance 1 */
    made->scene.camera = (Camera){{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, FOVY, 0.1, 10, 0};
    made->scene.global_ambient = (Vec3){0.6, 0.6, 0.6};
    made->lights[0].diffuse = (Vec3){0.5, 0.5, 0.5};
    for (size_t i = 0; i < 4; i++) {
        MeshVertex *v = &made->mesh.vertices[i];
        v->normal[0] = v->position[0] < 0 ? 1 : -1;
        v->normal[1] = v->normal[2] = 0;
    }
}

static void make_pow(HardScene *made)
{
    made->scene.reflection = REFLECTION_PHONG;
    made->objects[0].front.shininess = 0;
}

/* With light from the side R.V is negative on the far side although N.L > 0. */
static void make_negative(HardScene *made)
{
    made->scene.reflection = REFLECTION_PHONG;
}

static void make_unit(HardScene *made)
{
    made->objects[0].front.diffuse = (Vec3){0.6, 0.35, 0.2};
}

static void spoil_unit(HardScene *made)
{
    made->naive.skip_renormalization = true;
}

static void make_leak(HardScene *made)
{
    made->lights[0].specular = (Vec3){1, 1, 1};
    made->objects[0].front.shininess = 3;
}

/* The lower half of a sphere, seen from inside. */
static void make_bowl(Mesh *mesh)
{
    size_t kept = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        MeshVertex *v = &mesh->vertices[i];
        for (int k = 0; k < 3; k++)
            v->normal[k] *= -1;
        if (v->position[1] < -0.9999F) /* the pole, without rounding of the sine */
            *v = (MeshVertex){{0, -1, 0}, {0, 1, 0}};
    }
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        const uint32_t a = mesh->indices[i], b = mesh->indices[i + 1], c = mesh->indices[i + 2];
        if (mesh->vertices[a].position[1] > 0.01F || mesh->vertices[b].position[1] > 0.01F ||
            mesh->vertices[c].position[1] > 0.01F)
            continue;
        mesh->indices[kept++] = a;
        mesh->indices[kept++] = c;
        mesh->indices[kept++] = b;
    }
    mesh->index_count = kept;
}

/* A bowl that opens towards the eye, with light from straight behind: at its middle vertex light
 * and viewer are opposite. Specular reflection is small. */
static void make_opposite(HardScene *made)
{
    make_bowl(&made->mesh);
    made->objects[0].world_from_object = mat4_rotate(90, (Vec3){1, 0, 0});
    made->scene.camera.eye = (Vec3){0, 0, 3};
    made->scene.interpolation = INTERPOLATION_GOURAUD;
    made->scene.global_ambient = (Vec3){0.6, 0.6, 0.6};
    made->lights[0].kind = LIGHT_DIRECTIONAL;
    made->lights[0].direction = (Vec3){0, 0, -1};
    made->lights[0].specular = (Vec3){0.02, 0.02, 0.02};
}

/* A bowl with a light at its bottom vertex. */
static void make_touching(HardScene *made)
{
    make_bowl(&made->mesh);
    made->scene.camera = (Camera){{0, 3, 0}, {0, 0, 0}, {0, 0, -1}, 42, 1, 20, 0};
    made->scene.interpolation = INTERPOLATION_GOURAUD;
    made->lights[0].linear = 1.2;
    made->lights[0].specular = (Vec3){0, 0, 0};
}

static void make_spot(HardScene *made)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    made->objects[0].world_from_object = mat4_product(lying, made->objects[0].world_from_object);
    made->objects[0].front.specular = (Vec3){0, 0, 0};
    made->scene.camera.eye = (Vec3){0, 3, 3};
    made->lights[0] = (Light){.kind = LIGHT_SPOT,
                              .position = {-4, 12, 3},
                              .direction = {4, -12, -3},
                              .cutoff = 4.5,
                              .diffuse = {0.8, 0.8, 0.75}};
}

static void make_highlight(HardScene *made)
{
    made->scene.reflection = REFLECTION_PHONG;
    made->scene.camera.center = (Vec3){-0.25, 0.3, 0.9};
    made->lights[0].specular = (Vec3){1, 1, 1};
    made->objects[0].front.diffuse = (Vec3){0.5, 0.3, 0.15};
    made->objects[0].front.specular = (Vec3){0.7, 0.7, 0.7};
    made->objects[0].front.shininess = 128;
}

static void make_wide(HardScene *made)
{
    const double size = 300; /* of the sphere */
    Camera *camera = &made->scene.camera;
    camera->eye = vec3_scale(camera->eye, size);
    camera->near *= size;
    camera->far *= size;
    made->lights[0].position = vec3_scale(made->lights[0].position, size);
}

static void make_indices(HardScene *made)
{
    made->objects[0].world_from_object = mat4_rotate(-50, (Vec3){1, 0, 0});
}

static void spoil_indices(HardScene *made)
{
    if (mesh_copy(&made->naive_mesh, &made->mesh, NULL))
        made->naive_objects[0].mesh = &made->naive_mesh;
    for (size_t i = 0; i < made->naive_mesh.index_count; i++)
        made->naive_mesh.indices[i] &= 0xffff;
}

/* A sheet, and another a hundredth of a unit above it. */
static void make_depth(HardScene *made)
{
    const Mat4 lying = mat4_rotate(-90, (Vec3){1, 0, 0});
    made->objects[1] = made->objects[0];
    made->objects[0].world_from_object = mat4_product(lying, mat4_scale((Vec3){1.4, 1.4, 1}));
    made->objects[1].world_from_object = mat4_product(
        mat4_translate((Vec3){0, 0.01, 0}), mat4_product(lying, mat4_scale((Vec3){0.9, 0.9, 1})));
    made->objects[1].front.ambient = made->objects[1].front.diffuse = (Vec3){0.2, 0.4, 0.8};
    made->objects[0].front.specular = made->objects[1].front.specular = (Vec3){0, 0, 0};
    made->scene.object_count = 2;
    made->scene.camera.eye = (Vec3){0, 2.4, 3.6};
}

static void spoil_near(HardScene *made)
{
    made->naive.camera.near = 3e-5;
}

/* A bowl of few facets, seen from slightly above its rim. */
static void make_two_sided(HardScene *made)
{
    make_bowl(&made->mesh);
    made->objects[0].world_from_object = mat4_translate((Vec3){0, 0.5, 0});
    made->objects[0].two_sided = true;
    made->objects[0].back = made->objects[0].front;
    made->objects[0].back.ambient = made->objects[0].back.diffuse = (Vec3){0.2, 0.5, 0.9};
    made->scene.camera.eye = (Vec3){0, 1.9, 3.6};
}

/* Without any max, because max(NaN, b) is b and would hide the NaN. */
#define NOT_GUARDED                                                                                \
    {                                                                                              \
        {"lighting/guards.glsl", "study/unguarded.glsl"},                                          \
        {                                                                                          \
            "lighting/highlight.glsl", "study/highlight_squares.glsl"                              \
        }                                                                                          \
    }

const HardCase HARD_FORMULAS[HARD_FORMULA_COUNT] = {
    {"singular", "scale (1.3, 0, 1.3), which has no inverse, for the normals",
     "no inverse: old matrix", "cofactors", .slices = 64, .stacks = 32, .scale = {1.3, 0, 1.3},
     .make = make_singular, .normal_matrix = naive_inverse_transpose},
    {"mirror", "a mirrored teapot, scale (-1, 1, 1)", "cofactors", "times sign of det",
     .shape = HARD_TEAPOT, .size = 0.9, .scale = {-1, 1, 1}, .fovy = 30,
     .normal_matrix = naive_cofactors},
    {"uneven", "an uneven scale, (1.4, 0.35, 1)", "model-view for normals", "normal matrix",
     .slices = 96, .stacks = 48, .scale = {1.4, 0.35, 1}, .make = make_uneven,
     .spoil = spoil_normals},
    {"tiny", "a model in small units, scale 1e-16", "float inverse", "cofactors in double",
     .shape = HARD_TEAPOT, .size = 1e16, .scale = {1e-16, 0.8e-16, 1e-16}, .fovy = 30,
     .normal_matrix = naive_float_inverse_transpose},
    {"look-at", "up nearly along the view, 1e-7 radians away", "float, as usual",
     "double, made orthogonal", .shape = HARD_TEAPOT, .size = 0.9, .fovy = 32, .make = make_look_at,
     .transforms = naive_float_look_at},
    {"far", "a world five million units from the origin", "float, view x model",
     "relative to the eye", .shape = HARD_TEAPOT, .size = 0.9, .fovy = 30, .make = make_far,
     .transforms = naive_float_lecture},
    {"unit", "interpolated normals may be shorter than 1", "as interpolated", "normalized again",
     .slices = 10, .stacks = 5, .fovy = 30, .light = {-1, 2, 4}, .make = make_unit,
     .spoil = spoil_unit},
    {"zero-normals", "a mesh without some of its normals: normalize(0)", "normalize(n)",
     "guarded: ambient stays", .slices = 48, .stacks = 24, .fovy = 30, .light = {-1, 2, 4},
     .make = make_zero_normals, .replaced = NOT_GUARDED},
    {"cancelling", "opposite normals, interpolated: exactly 0 in the middle", "normalize(n)",
     "guarded: ambient stays", .shape = HARD_QUAD, .scale = {1, 0.55, 1}, .light = {0, 0, 0.7},
     .make = make_cancelling, .replaced = NOT_GUARDED, .width = 35, .height = 27},
    {"pow", "shininess 0: pow(0, 0) where R.V is not positive", "pow(max(k, 0), s)",
     "1, as for any k", .slices = 96, .stacks = 48, .fovy = 30, .light = {-4, 2, 1},
     .make = make_pow, .replaced = {{"lighting/guards.glsl", "study/unguarded_pow.glsl"}}},
    {"negative", "a highlight without max: the power of a negative", "pow(R.V, s)",
     "0 where R.V <= 0", .slices = 96, .stacks = 48, .fovy = 30, .light = {-4, 2, 2.5},
     .make = make_negative,
     .replaced = {{"lighting/highlight.glsl", "study/highlight_plain.glsl"}}},
    {"leak", "a highlight where no light arrives, N.L < 0", "pow(N.H, s)", "0 where N.L <= 0",
     .slices = 96, .stacks = 48, .fovy = 30, .light = {-4, 2, -2.5}, .make = make_leak,
     .replaced = {{"lighting/guards.glsl", "study/unguarded_facing.glsl"}}},
    {"opposite", "light straight behind the object: L + V = 0 at a vertex", "normalize(L + V)",
     "guarded", .slices = 16, .stacks = 12, .fovy = 42, .make = make_opposite,
     .replaced = NOT_GUARDED},
    {"touching", "a light on the surface: distance 0 at a vertex", "1 / 0", "1 / max(d, tiny)",
     .slices = 16, .stacks = 12, .light = {0, -1, 0}, .make = make_touching,
     .replaced = NOT_GUARDED},
    {"spot", "the edge of a narrow spot, by its angle in mediump", "acos in mediump",
     "cosines in highp", .shape = HARD_QUAD, .scale = {2, 2, 1}, .fovy = 34, .make = make_spot,
     .replaced = {{"lighting/cone.glsl", "study/cone_acos.glsl"}}, .precision = "mediump"},
    {"highlight", "a small highlight, shininess 128, in mediump", "mediump", "highp", .slices = 192,
     .stacks = 96, .fovy = 9, .light = {-2, 2, 4}, .make = make_highlight, .precision = "mediump"},
    {"wide", "a scene 600 units wide in mediump: squares overflow", "mediump", "highp", .size = 300,
     .slices = 96, .stacks = 48, .fovy = 30, .make = make_wide, .precision = "mediump"},
    {"indices", "a mesh of 100651 vertices with indices of 16 bits", "16 bits: wrapped", "32 bits",
     .slices = 400, .stacks = 250, .fovy = 30, .make = make_indices, .spoil = spoil_indices},
    {"depth", "two sheets 0.01 apart, and where the near plane is", "near 0.00003", "near 1",
     .shape = HARD_QUAD, .make = make_depth, .spoil = spoil_near},
    {"two-sided", "which side is seen, of a bowl with few facets", "by N.V > 0", "gl_FrontFacing",
     .slices = 8, .stacks = 5, .fovy = 32, .make = make_two_sided,
     .replaced = {{"lighting/side.glsl", "study/side_by_normal.glsl"}}},
};
