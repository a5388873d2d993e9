#include "lighting/fixed_function_osmesa.h"

#include <dlfcn.h>
#include <GL/osmesa.h>
#include <stdlib.h>
#include <string.h>

/* Loaded, not linked: the process that draws our side must not contain OSMesa. */
#define FUNCTIONS(X)                                                                               \
    X(Clear)                                                                                       \
    X(ClearColor)                                                                                  \
    X(Color3ub)                                                                                    \
    X(ColorMaterial)                                                                               \
    X(ColorPointer)                                                                                \
    X(CullFace)                                                                                    \
    X(Disable)                                                                                     \
    X(DisableClientState)                                                                          \
    X(DrawElements)                                                                                \
    X(Enable)                                                                                      \
    X(EnableClientState)                                                                           \
    X(Finish)                                                                                      \
    X(FrontFace)                                                                                   \
    X(LightModelfv)                                                                                \
    X(LightModeli)                                                                                 \
    X(Lightf)                                                                                      \
    X(Lightfv)                                                                                     \
    X(LoadMatrixd)                                                                                 \
    X(Materialf)                                                                                   \
    X(Materialfv)                                                                                  \
    X(MatrixMode)                                                                                  \
    X(MultMatrixd)                                                                                 \
    X(NormalPointer)                                                                               \
    X(ShadeModel)                                                                                  \
    X(VertexPointer)

#define DECLARE(name) __typeof__(gl##name) *name;
static struct {
    FUNCTIONS(DECLARE)
} gl;

static struct {
    __typeof__(OSMesaCreateContextExt) *CreateContextExt;
    __typeof__(OSMesaMakeCurrent) *MakeCurrent;
    __typeof__(OSMesaGetProcAddress) *GetProcAddress;
    __typeof__(OSMesaDestroyContext) *DestroyContext;
} osmesa;

static void *library;
static OSMesaContext context;
static unsigned char *pixels; /* row 0 at the bottom */

static void *osmesa_function(const char *name, Message *message)
{
    void *function = dlsym(library, name);
    if (!function)
        message_set(message, "OSMesa: the library has no %s", name);
    return function;
}

bool fixed_function_open(int width, int height, Message *message)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    for (size_t i = 0; i < sizeof names / sizeof names[0] && !library; i++)
        library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return message_set(message, "no OSMesa here: install libosmesa6");
    osmesa.CreateContextExt =
        (__typeof__(osmesa.CreateContextExt))osmesa_function("OSMesaCreateContextExt", message);
    osmesa.MakeCurrent =
        (__typeof__(osmesa.MakeCurrent))osmesa_function("OSMesaMakeCurrent", message);
    osmesa.GetProcAddress =
        (__typeof__(osmesa.GetProcAddress))osmesa_function("OSMesaGetProcAddress", message);
    osmesa.DestroyContext =
        (__typeof__(osmesa.DestroyContext))osmesa_function("OSMesaDestroyContext", message);
    if (!osmesa.CreateContextExt || !osmesa.MakeCurrent || !osmesa.GetProcAddress ||
        !osmesa.DestroyContext)
        return false;
    pixels = malloc((size_t)width * (size_t)height * 4);
    context = osmesa.CreateContextExt(OSMESA_RGBA, 24, 0, 0, NULL);
    if (!pixels || !context ||
        !osmesa.MakeCurrent(context, pixels, GL_UNSIGNED_BYTE, width, height))
        return message_set(message, "OSMesa: no context with 24 bits of depth");
#define LOAD(name)                                                                                 \
    gl.name = (__typeof__(gl.name))osmesa.GetProcAddress("gl" #name);                              \
    if (!gl.name)                                                                                  \
        return message_set(message, "OSMesa: no gl" #name);
    FUNCTIONS(LOAD)
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_NORMALIZE);
    gl.ColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
    gl.EnableClientState(GL_VERTEX_ARRAY);
    gl.EnableClientState(GL_NORMAL_ARRAY);
    return true;
}

void fixed_function_close(void)
{
    if (context)
        osmesa.DestroyContext(context);
    free(pixels);
    context = NULL;
    pixels = NULL;
}

static const float *color(Vec3 c, double alpha, float out[4])
{
    vec3_to_float(c, out);
    out[3] = (float)alpha;
    return out;
}

static void set_light(GLenum name, const Light *light)
{
    float v[4];
    const bool directional = light->kind == LIGHT_DIRECTIONAL;
    const bool spot = light->kind == LIGHT_SPOT;
    const bool none = light->constant == 0 && light->linear == 0 && light->quadratic == 0;
    gl.Lightfv(name, GL_AMBIENT, color(light->ambient, 1, v));
    gl.Lightfv(name, GL_DIFFUSE, color(light->diffuse, 1, v));
    gl.Lightfv(name, GL_SPECULAR, color(light->specular, 1, v));
    gl.Lightfv(name, GL_POSITION,
               directional ? color(light->direction, 0, v) : color(light->position, 1, v));
    gl.Lightfv(name, GL_SPOT_DIRECTION, color(light->direction, 0, v));
    gl.Lightf(name, GL_SPOT_CUTOFF, spot ? (float)light->cutoff : 180);
    gl.Lightf(name, GL_SPOT_EXPONENT, spot ? (float)light->exponent : 0);
    gl.Lightf(name, GL_CONSTANT_ATTENUATION, none ? 1 : (float)light->constant);
    gl.Lightf(name, GL_LINEAR_ATTENUATION, (float)light->linear);
    gl.Lightf(name, GL_QUADRATIC_ATTENUATION, (float)light->quadratic);
    if (!light->off)
        gl.Enable(name);
}

static void set_material(GLenum face, const Material *material)
{
    float v[4];
    gl.Materialfv(face, GL_AMBIENT, color(material->ambient, 1, v));
    gl.Materialfv(face, GL_DIFFUSE, color(material->diffuse, material->alpha, v));
    gl.Materialfv(face, GL_SPECULAR, color(material->specular, 1, v));
    gl.Materialfv(face, GL_EMISSION, color(material->emission, 1, v));
    gl.Materialf(face, GL_SHININESS, (float)material->shininess);
}

/* The camera, and an empty picture. */
static void begin(const Scene *scene, Vec3 background, const Image *picture)
{
    Mat4 eye_from_world, clip_from_eye;
    scene_camera(&scene->camera, (double)picture->width / picture->height, &eye_from_world,
                 &clip_from_eye, NULL);
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadMatrixd(clip_from_eye.m);
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadMatrixd(eye_from_world.m);
    gl.ClearColor((float)background.x, (float)background.y, (float)background.z, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/* The object's matrix and arrays. */
static void place_object(const Scene *scene, const Object *object)
{
    Mat4 eye_from_world, clip_from_eye;
    const Mesh *mesh = object->mesh;
    scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL);
    gl.LoadMatrixd(eye_from_world.m);
    gl.MultMatrixd(object->world_from_object.m);
    const bool mirrored = mat4_determinant(object->world_from_object) < 0;
    gl.FrontFace(mirrored != object->clockwise ? GL_CW : GL_CCW);
    gl.VertexPointer(3, GL_FLOAT, sizeof(MeshVertex), mesh->vertices[0].position);
    gl.NormalPointer(GL_FLOAT, sizeof(MeshVertex), mesh->vertices[0].normal);
}

static void draw_object(const Scene *scene, const Object *object)
{
    const Mesh *mesh = object->mesh;
    place_object(scene, object);
    gl.DrawElements(GL_TRIANGLES, (GLsizei)mesh->index_count, GL_UNSIGNED_INT, mesh->indices);
}

/* With the colors of the vertices, if there are any; their alpha is that of the diffuse material.
 */
static void draw_colored(const Scene *scene, const Object *object)
{
    const Mesh *mesh = object->mesh;
    float(*colors)[4] = mesh->colors ? malloc(mesh->vertex_count * sizeof *colors) : NULL;
    if (colors) {
        for (size_t i = 0; i < mesh->vertex_count; i++)
            color(vec3_from_float(mesh->colors[i]), object->front.alpha, colors[i]);
        gl.ColorPointer(4, GL_FLOAT, 0, colors);
        gl.EnableClientState(GL_COLOR_ARRAY);
        gl.Enable(GL_COLOR_MATERIAL);
    }
    draw_object(scene, object);
    gl.DisableClientState(GL_COLOR_ARRAY);
    gl.Disable(GL_COLOR_MATERIAL);
    free(colors);
}

/* Each triangle in a color of its own, with this red. */
static void draw_triangles(const Scene *scene, const Object *object, GLubyte red)
{
    const Mesh *mesh = object->mesh;
    place_object(scene, object);
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        gl.Color3ub(red, (GLubyte)(i / 3), (GLubyte)(i / 768));
        gl.DrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, mesh->indices + i);
    }
}

static void read_back(Image *picture)
{
    const size_t row = image_row_size(picture), height = (size_t)picture->height;
    gl.Finish();
    for (size_t y = 0; y < height; y++)
        memcpy((unsigned char *)picture->pixels + y * row, pixels + (height - 1 - y) * row, row);
}

void fixed_function_draw(const Scene *scene, Image *picture)
{
    float v[4];
    begin(scene, scene->background, picture);
    gl.Enable(GL_LIGHTING);
    gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, color(scene->global_ambient, 1, v));
    gl.LightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, !scene->distant_viewer);
    gl.ShadeModel(scene->interpolation == INTERPOLATION_CONSTANT ? GL_FLAT : GL_SMOOTH);
    /* The light of the viewer is set while the model-view matrix is the identity. */
    Mat4 eye_from_world, clip_from_eye;
    const Mat4 identity = mat4_identity();
    scene_camera(&scene->camera, 1, &eye_from_world, &clip_from_eye, NULL);
    for (GLenum i = 0; i < 8; i++)
        gl.Disable(GL_LIGHT0 + i);
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        gl.LoadMatrixd(light->space == LIGHT_EYE ? identity.m : eye_from_world.m);
        set_light(GL_LIGHT0 + (GLenum)i, light);
    }
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, object->two_sided);
        set_material(GL_FRONT, &object->front);
        set_material(GL_BACK, &object->back);
        draw_colored(scene, object);
    }
    read_back(picture);
}

void fixed_function_draw_sides(const Scene *scene, Image *picture)
{
    begin(scene, (Vec3){0, 0, 0}, picture);
    gl.Disable(GL_LIGHTING);
    gl.Enable(GL_CULL_FACE);
    for (int i = 0; i < 2 * scene->object_count; i++) {
        const GLubyte red = (GLubyte)(i + 1);
        const Object *object = &scene->objects[i / 2];
        gl.CullFace(i % 2 ? GL_FRONT : GL_BACK);
        gl.Color3ub(red, 0, 0);
        if (scene->interpolation == INTERPOLATION_CONSTANT)
            draw_triangles(scene, object, red);
        else
            draw_object(scene, object);
    }
    gl.Disable(GL_CULL_FACE);
    read_back(picture);
}
