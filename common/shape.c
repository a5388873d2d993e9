#include "shape.h"

#include "model.h"

const char *const SHAPE_NAMES[SHAPE_COUNT + 1] = {
    "cube",        "sphere",     "teapot",       "torus",       "cone", "cylinder",
    "tetrahedron", "octahedron", "dodecahedron", "icosahedron", NULL,
};

/* Moves the middle of the model's box to the origin, and scales its diagonal to 2. */
static bool open_model(Mesh *mesh, const char *path, Message *message)
{
    Vec3 low, high;
    if (!model_read(path, mesh, message))
        return false;
    mesh_bounds(mesh, &low, &high);
    const Vec3 diagonal = vec3_subtract(high, low);
    const Vec3 middle = vec3_add(low, vec3_scale(diagonal, 0.5));
    const double scale = 2 / vec3_length(diagonal);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *p = mesh->vertices[i].position;
        const Vec3 at = {(double)p[0], (double)p[1], (double)p[2]};
        vec3_to_float(vec3_scale(vec3_subtract(at, middle), scale), p);
    }
    return true;
}

bool shape_open(Shape *shape, ShapeKind kind, const char *model, Message *message)
{
    Mesh *mesh = &shape->mesh;
    *shape = (Shape){.closed = !model};
    if (model)
        return open_model(mesh, model, message);
    switch (kind) {
    case SHAPE_CUBE:
        shape->solid = (Solid){.kind = SOLID_BOX, .radius = 1};
        shape->flat = true;
        return mesh_cube(mesh, 1, message);
    case SHAPE_SPHERE:
        shape->solid = (Solid){.kind = SOLID_SPHERE, .radius = 1};
        return mesh_sphere(mesh, 1, 20, 20, message);
    case SHAPE_TEAPOT:
        shape->solid = (Solid){.kind = SOLID_TEAPOT, .radius = 1};
        shape->closed = false; /* there is a gap under its lid */
        return mesh_teapot(mesh, 1, 10, message);
    case SHAPE_TORUS:
        shape->solid = (Solid){.kind = SOLID_TORUS, .radius = 1 / 1.5, .tube = 0.5 / 1.5};
        return mesh_torus(mesh, 0.5 / 1.5, 1 / 1.5, 32, 64, message);
    case SHAPE_CONE:
        shape->solid = (Solid){.kind = SOLID_CONE, .radius = 1, .height = 2};
        return mesh_cone(mesh, 1, 2, 64, 16, message);
    case SHAPE_CYLINDER:
        shape->solid =
            (Solid){.kind = SOLID_CYLINDER, .radius = 0.75, .height = 1.5, .caps = MESH_CAP_BOTH};
        return mesh_cylinder(mesh, 0.75, 1.5, 64, 16, MESH_CAP_BOTH, message);
    case SHAPE_TETRAHEDRON:
        shape->flat = true;
        return mesh_tetrahedron(mesh, 1, message);
    case SHAPE_OCTAHEDRON:
        shape->flat = true;
        return mesh_octahedron(mesh, 1, message);
    case SHAPE_DODECAHEDRON:
        shape->flat = true;
        return mesh_dodecahedron(mesh, 1, message);
    case SHAPE_ICOSAHEDRON:
        shape->flat = true;
        return mesh_icosahedron(mesh, 1, message);
    case SHAPE_COUNT:
        break;
    }
    return message_set(message, "shape %d: there is none", (int)kind);
}

Object shape_object(const Shape *shape, Mat4 world_from_object, Material material)
{
    return (Object){.mesh = &shape->mesh,
                    .solid = shape->solid,
                    .flat = shape->flat,
                    .closed = shape->closed,
                    .world_from_object = world_from_object,
                    .front = material};
}

void shape_close(Shape *shape)
{
    if (shape)
        mesh_close(&shape->mesh);
}
