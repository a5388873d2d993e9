/* The solids of the examples: for each its mesh, its exact shape, and how it is put upright. */
#include "scene/shape.h"

#include "shapes/fox_head.h"
#include "shapes/mesh_solids.h"
#include "scene/model.h"

const char *const SHAPE_NAMES[SHAPE_COUNT + 1] = {
    "cube",         "sphere",      "teapot",     "torus",        "cone",
    "cylinder",     "tetrahedron", "octahedron", "dodecahedron", "icosahedron",
    "head-faceted", "head-smooth", "head",       NULL,
};

const char *const SHAPE_UP_NAMES[] = {"file", "x", "y", "z", NULL};

/* Moves the middle of the model's box to the origin, and scales its diagonal to 2. */
static bool open_model(Mesh *mesh, const ShapeModel *model, Message *message)
{
    if (!model_read(model->path, (ModelUp)model->up, mesh, message))
        return false;
    const MeshBox box = mesh_bounds(mesh);
    const Vec3 diagonal = vec3_subtract(box.high, box.low);
    const Vec3 middle = vec3_add(box.low, vec3_scale(diagonal, 0.5));
    const double scale = 2 / vec3_length(diagonal);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *p = mesh->vertices[i].position;
        const Vec3 at = {(double)p[0], (double)p[1], (double)p[2]};
        vec3_to_float(vec3_scale(vec3_subtract(at, middle), scale), p);
    }
    return true;
}

/* Solids of revolution stand on z = 0 along z. */
static Mat4 stand(double height)
{
    return mat4_product(mat4_rotate(-90, (Vec3){1, 0, 0}),
                        mat4_translate((Vec3){0, 0, -height / 2}));
}

static bool open_teapot(Shape *shape, bool textbook, Message *message)
{
    const double radius = textbook ? 0.5 : 0.8;
    shape->solid = (Solid){.kind = SOLID_TEAPOT, .radius = radius};
    shape->closed = false; /* there is a gap under its lid */
    if (!textbook)
        return mesh_teapot(&shape->mesh, radius, 10, message);
    /* The middle of its mesh's box at the origin. */
    shape->placed = mat4_translate((Vec3){-0.053515625, -0.01875, 0});
    return mesh_teapot_textbook(&shape->mesh, radius, message);
}

static bool open_usual(Shape *shape, ShapeKind kind, ShapeStyle style, const ShapeModel *model,
                       Message *message)
{
    const bool textbook = style == SHAPE_TEXTBOOK;
    const double size = textbook ? 0.5 : 1;
    const double radius = textbook ? 0.5 : 0.8; /* of a cone and a cylinder */
    const double tube = size / 3, ring = 2 * tube;
    const int slices = textbook ? 128 : 20, stacks = textbook ? 64 : 20; /* of a sphere */
    const int along = textbook ? 1 : 16; /* parts of a cylinder along its axis */
    Mesh *mesh = &shape->mesh;
    const bool file = model && model->path;
    *shape = (Shape){.closed = !file, .placed = mat4_identity()};
    if (file) {
        shape->placed = mat4_scale((Vec3){size, size, size});
        if (!open_model(mesh, model, message))
            return false;
        shape->closed = scene_file_is_closed(mesh);
        return true;
    }
    switch (kind) {
    case SHAPE_CUBE:
        shape->solid = (Solid){.kind = SOLID_BOX, .radius = size};
        shape->flat = true;
        return mesh_cube(mesh, size, message);
    case SHAPE_SPHERE:
        shape->solid = (Solid){.kind = SOLID_SPHERE, .radius = size};
        return mesh_sphere(mesh, size, slices, stacks, message);
    case SHAPE_TEAPOT:
        return open_teapot(shape, textbook, message);
    case SHAPE_TORUS:
        shape->solid = (Solid){.kind = SOLID_TORUS, .radius = ring, .tube = tube};
        shape->placed = stand(0);
        return mesh_torus(mesh, tube, ring, 32, 64, message);
    case SHAPE_CONE:
        shape->solid = (Solid){.kind = SOLID_CONE, .radius = radius, .height = 2.4 * radius};
        shape->placed = stand(2.4 * radius);
        return mesh_cone(mesh, radius, 2.4 * radius, 64, textbook ? MESH_CONE_HALVING : 16,
                         message);
    case SHAPE_CYLINDER:
        shape->solid = (Solid){
            .kind = SOLID_CYLINDER, .radius = radius, .height = 2 * radius, .caps = MESH_CAP_BOTH};
        shape->placed = stand(2 * radius);
        return mesh_cylinder(mesh, (MeshCylinder){radius, 2 * radius, 64, along, MESH_CAP_BOTH},
                             message);
    case SHAPE_TETRAHEDRON:
    case SHAPE_OCTAHEDRON:
    case SHAPE_DODECAHEDRON:
    case SHAPE_ICOSAHEDRON:
        shape->flat = true;
        return mesh_regular(mesh, (MeshRegular)(kind - SHAPE_TETRAHEDRON), size, message);
    case SHAPE_HEAD_FACETED:
    case SHAPE_HEAD_SMOOTH:
    case SHAPE_HEAD:
        shape->placed = mat4_scale((Vec3){size, size, size});
        return mesh_head(mesh, (HeadStyle)(kind - SHAPE_HEAD_FACETED), message);
    case SHAPE_COUNT:
        break;
    }
    return message_set(message, "shape %d: there is none", (int)kind);
}

bool shape_open(Shape *shape, ShapeKind kind, ShapeStyle style, const ShapeModel *model,
                Message *message)
{
    if (!open_usual(shape, kind, style, model, message))
        return false;
    if (!model || !model->divisions || shape->solid.kind == SOLID_NONE)
        return true;
    mesh_close(&shape->mesh);
    return solid_mesh(&shape->solid, model->divisions > 2 ? model->divisions : SOLID_MIN_DIVISIONS,
                      &shape->mesh, message);
}

Object shape_object(const Shape *shape, Mat4 world_from_object, Material material)
{
    return (Object){.mesh = &shape->mesh,
                    .solid = shape->solid,
                    .flat = shape->flat,
                    .closed = shape->closed,
                    .world_from_object = mat4_product(world_from_object, shape->placed),
                    .front = material};
}

void shape_close(Shape *shape)
{
    if (shape)
        mesh_close(&shape->mesh);
}
