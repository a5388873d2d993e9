/* Whether gl_Position is right. Both the submission and a program that has nothing but u_Clip *
 * a_Position draw on a green ground; a pixel where only one of them is green is wrong, but for a
 * few at edges. The submission's light does not count, unless it is the green of the ground. */
#include "labs/diagnosis/diagnose.h"

/* The background is a colour that neither draws. */
static const Vec3 GREEN = {0, 1, 0};

static bool is_green(const Image *image, int pixel)
{
    const unsigned char *p = (const unsigned char *)image->pixels + 4 * (size_t)pixel;
    return p[0] == 0 && p[1] == 255 && p[2] == 0;
}

/* What draws a right outline, and the submission's. */
typedef struct Outlines {
    Shader shader;
    const Painter *painter;
    Canvas *canvas;
} Outlines;

static bool draw_right(const Outlines *of, const LabScene *lab_scene,
                       const SubmissionGeometry *geometry, Image *image, Message *message)
{
    const Shader *shader = &of->shader;
    Canvas *canvas = of->canvas;
    const GLint position = glGetAttribLocation(shader->program, "a_Position");
    const GLint clip = glGetUniformLocation(shader->program, "u_Clip");
    const double aspect = (double)lab_scene->width / lab_scene->height;
    Mat4 eye_from_world, clip_from_eye;
    LabSceneBuffers buffers;
    if (!canvas_resize(canvas, lab_scene->width, lab_scene->height, message) ||
        !scene_camera(&lab_scene->scene.camera, aspect, &eye_from_world, &clip_from_eye, message) ||
        !lab_scene_buffers_open(&buffers, lab_scene, geometry, message))
        return false;
    canvas_clear(canvas, GREEN, 1);
    glUseProgram(shader->program);
    glEnable(GL_DEPTH_TEST);
    if (buffers.cull)
        glEnable(GL_CULL_FACE);
    for (int i = 0; i < lab_scene->scene.object_count; i++) {
        const MeshBuffer *mesh = &buffers.buffers[i];
        const Mat4 eye_from_object =
            mat4_product(eye_from_world, lab_scene->objects[i].world_from_object);
        shader_set_mat4(clip, mat4_product(clip_from_eye, eye_from_object));
        mesh_buffer_bind(mesh, position, -1);
        glDrawElements(GL_TRIANGLES, mesh->index_count, mesh->index_type, NULL);
    }
    glDisable(GL_CULL_FACE);
    lab_scene_buffers_close(&buffers);
    return canvas_read(canvas, image, message);
}

/* *apart: how many pixels are covered neither as by the geometry nor as by the other one, if there
 * is one. */
static bool compare(const Outlines *of, const LabScene *original,
                    const SubmissionGeometry *geometry, const SubmissionGeometry *other, int *apart,
                    Message *message)
{
    LabScene lab_scene = *original; /* its scene's arrays are the original's */
    Image image = {0}, right = {0}, also = {0};
    lab_scene.scene.background = GREEN;
    const bool done =
        image_open(&image, lab_scene.width, lab_scene.height, IMAGE_BYTE, message) &&
        image_open(&right, lab_scene.width, lab_scene.height, IMAGE_BYTE, message) &&
        painter_draw(of->painter, &lab_scene, geometry, of->canvas, &image, message) &&
        draw_right(of, &lab_scene, geometry, &right, message) &&
        (!other || (image_open(&also, lab_scene.width, lab_scene.height, IMAGE_BYTE, message) &&
                    draw_right(of, &lab_scene, other, &also, message)));
    *apart = 0;
    for (int p = 0; p < lab_scene.width * lab_scene.height && done; p++)
        *apart += is_green(&image, p) != is_green(&right, p) &&
                  (!other || is_green(&image, p) != is_green(&also, p));
    image_close(&image);
    image_close(&right);
    image_close(&also);
    return done;
}

bool outline_check(const LabPictures *pictures, const Painter *painter, Canvas *canvas, bool *wrong,
                   Message *message)
{
    enum { ROUNDING = 6, FINE = 256 }; /* ROUNDING: pixels, at edges */
    const ShaderLoader loader = {.precision = "highp"};
    const bool budget = pictures->lab->budget;
    Outlines outlines = {.painter = painter, .canvas = canvas};
    Mesh sphere = {.vertex_count = 0};
    *wrong = false;
    if (!shader_open(&outlines.shader, &loader, "labs/outline", message))
        return false;
    /* Lab 10: a coarse mesh's outline is right, and the sphere's, which a shader can find. */
    const SubmissionGeometry fine = {.mesh = &sphere};
    bool done = !budget || mesh_sphere(&sphere, 1, FINE, FINE, message);
    for (int i = 0; i < pictures->count && !*wrong && done; i++) {
        const SubmissionGeometry geometry = lab_pictures_geometry(pictures, i);
        int apart = 0;
        done = compare(&outlines, &pictures->items[i].lab_scene, &geometry, budget ? &fine : NULL,
                       &apart, message);
        *wrong = apart > ROUNDING;
    }
    mesh_close(&sphere);
    shader_close(&outlines.shader);
    return done;
}
