/*
 * The canvas, on every backend of this machine: formats, sizes, row order, antialiasing, errors,
 * resources. Drivers that lack something are simulated by backends that hide it.
 */
#include "core/canvas.h"
#include "core/mesh_buffer.h"
#include "core/shader.h"
#include "support/picture_check.h"
#include "support/testing.h"
#include "window/backends.h"
#include "window/window.h"

#include <dlfcn.h>
#include <malloc.h>

static const Vec3 WHITE = {1, 1, 1}, RED = {1, 0, 0}, GREEN = {0, 1, 0}, BLUE = {0, 0, 1};

static const CanvasBackend *backend; /* under test */

/* Opening, reading, comparing. */

static Canvas open_canvas(CanvasOptions options)
{
    Canvas canvas;
    if (!options.backend)
        options.backend = backend;
    SUCCEEDS(canvas_open(&canvas, &options, message));
    return canvas;
}

/* The ways to antialias, by number. */
enum { ANTIALIASINGS = 4 };

static CanvasOptions antialiased(size_t way, int width, int height, bool real)
{
    static const int samples[] = {0, 4, 0, 0}, supersample[] = {0, 0, 2, 3};
    return (CanvasOptions){.width = width,
                           .height = height,
                           .samples = samples[way],
                           .supersample = supersample[way],
                           .real = real};
}

static void assert_zeroed(const Canvas *canvas)
{
    static const Canvas zero;
    assert_memory_equal(canvas, &zero, sizeof zero);
}

static void assert_refused(CanvasOptions options, const char *expected)
{
    Canvas canvas;
    memset(&canvas, 0xa5, sizeof canvas);
    if (!options.backend)
        options.backend = backend;
    FAILS(canvas_open(&canvas, &options, message), expected);
    assert_zeroed(&canvas);
}

static Image new_image(const Canvas *canvas)
{
    Image image;
    assert_true(image_open(&image, canvas->width, canvas->height,
                           canvas->real ? IMAGE_FLOAT : IMAGE_BYTE, NULL));
    return image;
}

static Image read_canvas(const Canvas *canvas)
{
    Image image = new_image(canvas);
    SUCCEEDS(canvas_read(canvas, &image, message));
    return image;
}

static unsigned char *pixel(const Image *image, int x, int y)
{
    return (unsigned char *)image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static void set_pixel(Image *image, int x, int y, Vec3 color)
{
    unsigned char *p = pixel(image, x, y);
    p[0] = (unsigned char)(255 * color.x);
    p[1] = (unsigned char)(255 * color.y);
    p[2] = (unsigned char)(255 * color.z);
    p[3] = 255;
}

/* Every value lies within its range; otherwise the pictures are written to files. */
static void assert_between(const Image *got, const Image *min, const Image *max, const char *name)
{
    for (int y = 0; y < got->height; y++)
        for (int x = 0; x < got->width; x++)
            for (int c = 0; c < 4; c++) {
                const int value = pixel(got, x, y)[c];
                const int low = pixel(min, x, y)[c], high = pixel(max, x, y)[c];
                if (value >= low && value <= high)
                    continue;
                picture_check_keep(name, got, min);
                fail_msg("%s: pixel (%d, %d), channel %d is %d, not %d to %d", name, x, y, c, value,
                         low, high);
            }
}

/* A program that draws in one colour: the last of the lecture's cubes with ambient light only, so
 * that the colour is a uniform of the fragment shader. */
typedef struct Flat {
    Shader shader;
    GLint clip_from_model, color;
} Flat;

static void set_matrix(const Shader *shader, const char *name, Mat4 matrix)
{
    GLint location;
    assert_true(shader_uniform(shader, name, &location, NULL));
    shader_set_mat4(location, matrix);
}

static void close_flat(Flat *flat)
{
    shader_close(&flat->shader);
}

static Flat open_flat(void)
{
    static const float unit[3] = {0, 0, 1}, white[3] = {1, 1, 1};
    const ShaderLoader loader = {.precision = "highp"};
    Flat flat;
    GLint light = -1, color = -1, normal = -1;
    Message message = {0};
    if (!shader_open(&flat.shader, &loader, "lecture/PointLightedCube_perFragment", &message) ||
        !shader_uniform(&flat.shader, "u_MvpMatrix", &flat.clip_from_model, &message) ||
        !shader_uniform(&flat.shader, "u_AmbientLight", &flat.color, &message) ||
        !shader_uniform(&flat.shader, "u_LightPosition", &light, &message) ||
        !shader_attribute(&flat.shader, "a_Color", &color, &message) ||
        !shader_attribute(&flat.shader, "a_Normal", &normal, &message))
        fail_msg("%s", message.text);
    glUseProgram(flat.shader.program);
    glVertexAttrib3fv((GLuint)color, white);
    glVertexAttrib3fv((GLuint)normal, unit);
    /* The light is black but needs a direction. */
    shader_set_vec3(light, (Vec3){0, 0, 1e6});
    set_matrix(&flat.shader, "u_ModelMatrix", mat4_identity());
    set_matrix(&flat.shader, "u_NormalMatrix", mat4_identity());
    return flat;
}

static void draw_mesh(const Flat *flat, const Mesh *mesh, Mat4 clip_from_model, Vec3 color)
{
    CLOSED(mesh_buffer_close) MeshBuffer buffer;
    SUCCEEDS(mesh_buffer_open(&buffer, mesh, message));
    mesh_buffer_bind(&buffer, 0, -1);
    shader_set_mat4(flat->clip_from_model, clip_from_model);
    shader_set_vec3(flat->color, color);
    glDrawElements(GL_TRIANGLES, buffer.index_count, buffer.index_type, NULL);
}

/* In clip coordinates: x to the right, y up, -1..1. */
typedef struct Sides {
    double left, bottom, right, top;
} Sides;

static void draw_rectangle(const Flat *flat, Sides at, double z, Vec3 color)
{
    const double x[2] = {at.left, at.right}, y[2] = {at.bottom, at.top};
    static const uint32_t indices[] = {0, 1, 3, 0, 3, 2};
    MeshVertex vertices[4];
    for (int i = 0; i < 4; i++)
        vertices[i] = (MeshVertex){{(float)x[i % 2], (float)y[i / 2], (float)z}, {0, 0, 1}};
    const Mesh mesh = {
        .vertices = vertices, .indices = (uint32_t *)indices, .vertex_count = 4, .index_count = 6};
    draw_mesh(flat, &mesh, mat4_identity(), color);
}

static void clear(double red, double green, double blue, double alpha)
{
    glClearColor((float)red, (float)green, (float)blue, (float)alpha);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/* Formats. */

TEST(a_canvas_has_8_bits_for_each_channel_and_24_of_depth)
{
    for (size_t i = 0; i < ANTIALIASINGS; i++) {
        CLOSED(canvas_close) Canvas canvas = open_canvas(antialiased(i, 40, 30, false));
        GLint bits[4] = {0, 0, 0, 0};
        glGetIntegerv(GL_RED_BITS, &bits[0]);
        glGetIntegerv(GL_GREEN_BITS, &bits[1]);
        glGetIntegerv(GL_BLUE_BITS, &bits[2]);
        glGetIntegerv(GL_ALPHA_BITS, &bits[3]);
        assert_true(bits[0] == 8 && canvas.red_bits == 8);
        assert_true(bits[1] == 8 && canvas.green_bits == 8);
        assert_true(bits[2] == 8 && canvas.blue_bits == 8);
        assert_true(bits[3] == 8 && canvas.alpha_bits == 8);
        assert_true(canvas.depth_bits >= 24);
        assert_ptr_equal(canvas.backend, backend);
        assert_true(canvas.renderer[0] && canvas.version[0] && canvas.platform[0]);
        assert_true(canvas.width == 40 && canvas.height == 30 && !canvas.real);
    }
}

TEST(depths_four_steps_apart_are_distinguished_in_either_order)
{
    static const int samples[] = {0, 4};
    for (size_t s = 0; s < 2; s++)
        for (int near_first = 0; near_first < 2; near_first++) {
            CLOSED(canvas_close)
            Canvas canvas =
                open_canvas((CanvasOptions){.width = 32, .height = 32, .samples = samples[s]});
            CLOSED(close_flat) Flat flat = open_flat();
            CLOSED(image_close) Image expected = new_image(&canvas);
            clear(0, 0, 0, 1);
            glEnable(GL_DEPTH_TEST);
            for (int i = 0; i < 2; i++) {
                const bool near = i != near_first;
                /* Depth runs from -1 to 1 in clip coordinates, so that a step is 2^-23; a float
                 * near 0.5 has steps of 2^-25. */
                draw_rectangle(&flat, (Sides){-1, -1, 1, 1}, near ? -0.5 : -0.5 + 4 * 0x1p-23,
                               near ? GREEN : RED);
            }
            for (int y = 0; y < 32; y++)
                for (int x = 0; x < 32; x++)
                    set_pixel(&expected, x, y, GREEN);
            CLOSED(image_close) Image got = read_canvas(&canvas);
            assert_between(&got, &expected, &expected, "canvas-depth");
        }
}

static void assert_colors(const Canvas *canvas, const float color[4], double tolerance)
{
    CLOSED(image_close) Image image = read_canvas(canvas);
    const float *values = image.pixels;
    for (int i = 0; i < 4 * image.width * image.height; i++) {
        const float expected = color[i % 4];
        if (isnan(expected))
            assert_true(isnan(values[i]));
        else if (isinf(expected))
            assert_true(values[i] == expected);
        else
            assert_true(fabs(values[i] - expected) <= tolerance * fabs(expected));
    }
}

TEST(a_float_canvas_keeps_what_is_above_1_below_0_and_not_finite)
{
    static const float colors[][4] = {{2.5F, -1, 0.1F, 1},
                                      {1e30F, -1e-30F, 65536.125F, 1},
                                      {INFINITY, -INFINITY, NAN, 1},
                                      {0, 1, 1.0F / 3, 1}};
    for (size_t w = 0; w < ANTIALIASINGS; w++) {
        CLOSED(canvas_close) Canvas canvas = open_canvas(antialiased(w, 5, 3, true));
        if (!canvas.real) {
            print_message("%s draws no floats\n", canvas.renderer);
            canvas_close(&canvas);
            skip();
        }
        assert_int_equal(canvas.red_bits, 32);
        CLOSED(close_flat) Flat flat = open_flat();
        for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++) {
            const float *c = colors[i];
            /* The mean of equal values, summed as floats: an error of 2^-24 for each of three sums
             * of four; in double, none. */
            const double tolerance = canvas.samples ? 0x3p-24 : 0;
            clear(c[0], c[1], c[2], c[3]);
            assert_colors(&canvas, c, tolerance);
            clear(0, 0, 0, 1);
            draw_rectangle(&flat, (Sides){-1, -1, 1, 1}, 0, (Vec3){c[0], c[1], c[2]});
            assert_colors(&canvas, c, tolerance);
        }
    }
}

TEST(each_of_the_256_levels_of_a_clear_color_is_read_back_exactly)
{
    for (size_t w = 0; w < ANTIALIASINGS; w++) {
        CLOSED(canvas_close) Canvas canvas = open_canvas(antialiased(w, 7, 5, false));
        for (int level = 0; level < 256; level += testing_step(15)) {
            const int levels[4] = {level, 255 - level, (level + 85) % 256, (level + 170) % 256};
            canvas_begin(&canvas);
            clear(levels[0] / 255.0, levels[1] / 255.0, levels[2] / 255.0, levels[3] / 255.0);
            CLOSED(image_close) Image image = read_canvas(&canvas);
            const unsigned char *values = image.pixels;
            for (int i = 0; i < 4 * 7 * 5; i++)
                assert_int_equal(values[i], levels[i % 4]);
        }
    }
}

/* Rows, columns and sizes. */

/* Rectangles that no rotation or reflection maps to each other. */
static void assert_right_way_up(CanvasOptions options)
{
    CLOSED(canvas_close) Canvas canvas = open_canvas(options);
    CLOSED(close_flat) Flat flat = open_flat();
    CLOSED(image_close) Image expected = new_image(&canvas);
    const int width = canvas.width, height = canvas.height;
    clear(0, 0, 0, 1);
    draw_rectangle(&flat, (Sides){-1, 0, 0, 1}, 0, RED);   /* the upper left quarter */
    draw_rectangle(&flat, (Sides){0, 0, 1, 1}, 0, GREEN);  /* the upper right quarter */
    draw_rectangle(&flat, (Sides){-1, -1, 0, 0}, 0, BLUE); /* the lower left quarter */
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            /* The sizes are even, so no pixel centre is on a border. */
            const bool left = 2 * x + 1 < width, upper = 2 * y + 1 < height;
            set_pixel(&expected, x, y,
                      upper ? (left ? RED : GREEN) : (left ? BLUE : (Vec3){0, 0, 0}));
        }
    CLOSED(image_close) Image got = read_canvas(&canvas);
    assert_between(&got, &expected, &expected, "canvas-quarters");
}

TEST(row_0_is_the_top_and_column_0_the_left)
{
    assert_right_way_up((CanvasOptions){.width = 64, .height = 48});
    assert_right_way_up((CanvasOptions){.width = 64, .height = 48, .samples = 4});
    assert_right_way_up((CanvasOptions){.width = 64, .height = 48, .supersample = 3});
    assert_right_way_up((CanvasOptions){.width = 2, .height = 2});
}

static int max_side(void)
{
    Canvas canvas = open_canvas((CanvasOptions){.width = 1, .height = 1});
    GLint buffer = 0, viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    canvas_close(&canvas);
    assert_int_equal(viewport[0], viewport[1]);
    return buffer < viewport[0] ? buffer : viewport[0];
}

TEST(a_canvas_is_as_small_as_one_pixel_and_as_long_as_the_driver_allows)
{
    static const Vec3 black = {0, 0, 0};
    const int max = max_side();
    assert_true(max >= 2048); /* the minimum of OpenGL ES 3 */
    const int sizes[][2] = {{1, 1}, {max, 1}, {1, max}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        CLOSED(canvas_close)
        Canvas canvas = open_canvas((CanvasOptions){.width = sizes[s][0], .height = sizes[s][1]});
        CLOSED(close_flat) Flat flat = open_flat();
        CLOSED(image_close) Image expected = new_image(&canvas);
        clear(0, 0, 0, 1);
        /* The first quarter from the left, or from the top; all of a single pixel. */
        draw_rectangle(&flat,
                       (Sides){-1, canvas.height > 1 ? 0.5 : -1, canvas.width > 1 ? -0.5 : 1, 1}, 0,
                       WHITE);
        for (int y = 0; y < canvas.height; y++)
            for (int x = 0; x < canvas.width; x++)
                set_pixel(&expected, x, y,
                          4 * x < canvas.width && 4 * y < canvas.height ? WHITE : black);
        CLOSED(image_close) Image got = read_canvas(&canvas);
        assert_between(&got, &expected, &expected, "canvas-long");
    }
}

TEST(a_size_beyond_the_driver_is_refused_and_the_limit_named)
{
    const int max = max_side();
    const struct {
        int width, height, supersample;
    } bad[] = {{max + 1, 1, 0},     {1, max + 1, 0},   {0, 1, 0},         {1, 0, 0},
               {-5, 7, 0},          {INT32_MAX, 1, 0}, {1, INT32_MIN, 0}, {max / 2 + 1, 1, 2},
               {1, max / 3 + 1, 3}, {0, 4, 2}};
    Canvas canvas = open_canvas((CanvasOptions){.width = 1, .height = 1});
    const char *renderer = formatted("%s", canvas.renderer);
    canvas_close(&canvas);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const int side = bad[i].supersample;
        char expected[512];
        if (side)
            snprintf(expected, sizeof expected,
                     "size %dx%d: %s with %dx%d supersampling draws 1x1 to %dx%d", bad[i].width,
                     bad[i].height, renderer, side, side, max / side, max / side);
        else
            snprintf(expected, sizeof expected, "size %dx%d: %s draws 1x1 to %dx%d", bad[i].width,
                     bad[i].height, renderer, max, max);
        assert_refused(
            (CanvasOptions){.width = bad[i].width, .height = bad[i].height, .supersample = side},
            expected);
    }
}

/* Opening, closing, errors. */

TEST(a_canvas_opened_50_times_keeps_no_file_no_thread_and_no_memory)
{
    enum { WARM = 25, TIMES = 50, SIDE = 64 };
    int files = 0, threads = 0;
    size_t heap = 0;
    for (int i = 0; i < WARM + TIMES; i++) {
        if (i == WARM) {
            files = testing_open_files();
            threads = testing_entries("/proc/self/task");
            heap = mallinfo2().uordblks + mallinfo2().hblkhd;
        }
        CLOSED(canvas_close)
        Canvas canvas = open_canvas((CanvasOptions){.width = SIDE, .height = SIDE});
        clear(1, 0, 0, 1);
        CLOSED(image_close) Image image = read_canvas(&canvas);
        assert_int_equal(pixel(&image, SIDE - 1, SIDE - 1)[0], 255);
    }
    const double now = (double)(mallinfo2().uordblks + mallinfo2().hblkhd);
    const double grown = (now - (double)heap) / TIMES;
    print_message("for each canvas %.1f bytes more\n", grown);
    /* Threads of the driver and the cache's have a file open now and then. */
    assert_true(testing_open_files() <= files + 3);
    assert_true(testing_entries("/proc/self/task") <= threads);
    /* Mesa 22.3 leaks some: 130 to 170 bytes for an EGL canvas, up to 300 for an OSMesa one, none
     * for a window; Mesa 25.0 up to 1030 for each of the first hundred OSMesa canvases. A canvas's
     * colour and depth buffers have 32 KiB. AddressSanitizer does not report its heap. */
    assert_true(grown < 2048);
}

TEST(a_canvas_may_be_closed_twice_and_nothing_may_be_closed)
{
    Canvas canvas = {0};
    canvas_close(NULL);
    canvas_close(&canvas);
    canvas = open_canvas((CanvasOptions){.width = 3, .height = 3});
    canvas_close(&canvas);
    assert_zeroed(&canvas);
    canvas_close(&canvas);
    assert_zeroed(&canvas);
}

TEST(an_image_of_another_size_or_type_is_refused)
{
    static const struct {
        int width, height;
        ImageType type;
        bool real;
        const char *message;
    } bad[] = {
        {11, 20, IMAGE_BYTE, false, "canvas: a 11x20 byte image cannot take a 10x20 byte picture"},
        {10, 19, IMAGE_BYTE, false, "canvas: a 10x19 byte image cannot take a 10x20 byte picture"},
        {20, 10, IMAGE_BYTE, false, "canvas: a 20x10 byte image cannot take a 10x20 byte picture"},
        {10, 20, IMAGE_FLOAT, false,
         "canvas: a 10x20 float image cannot take a 10x20 byte picture"},
        {10, 20, IMAGE_BYTE, true, "canvas: a 10x20 byte image cannot take a 10x20 float picture"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CLOSED(canvas_close)
        Canvas canvas =
            open_canvas((CanvasOptions){.width = 10, .height = 20, .real = bad[i].real});
        if (canvas.real == bad[i].real) {
            CLOSED(image_close) Image image;
            assert_true(image_open(&image, bad[i].width, bad[i].height, bad[i].type, NULL));
            FAILS(canvas_read(&canvas, &image, message), bad[i].message);
        }
    }
}

TEST(a_gl_error_is_reported_once_by_the_next_read)
{
    for (int supersample = 1; supersample <= 2; supersample++) {
        CLOSED(canvas_close)
        Canvas canvas =
            open_canvas((CanvasOptions){.width = 9, .height = 8, .supersample = supersample});
        CLOSED(image_close) Image image = new_image(&canvas);
        glEnable(0xFFFF);
        FAILS_WITH(canvas_read(&canvas, &image, message), "GL_INVALID_ENUM");
        assert_true(canvas_read(&canvas, &image, NULL));
        glViewport(0, 0, -1, -1);
        FAILS_WITH(canvas_read(&canvas, &image, message), "GL_INVALID_VALUE");
    }
}

/* Drivers that lack something: the backend under test with some answers hidden. */

static struct {
    const char *version, *extensions; /* NULL: unchanged */
    GLenum integer;                   /* glGetIntegerv of this name returns `value` */
    GLint value;
    GLenum reset;        /* the reset status; 0: unchanged */
    const char *missing; /* a function's name or prefix */
} hidden;

static const GLubyte *GL_APIENTRY hiding_get_string(GLenum name)
{
    if (name == GL_VERSION && hidden.version)
        return (const GLubyte *)hidden.version;
    if (name == GL_EXTENSIONS && hidden.extensions)
        return (const GLubyte *)hidden.extensions;
    return ((PFNGLGETSTRINGPROC)backend->address("glGetString"))(name);
}

static void GL_APIENTRY hiding_get_integers(GLenum name, GLint *values)
{
    ((PFNGLGETINTEGERVPROC)backend->address("glGetIntegerv"))(name, values);
    if (hidden.integer && name == hidden.integer)
        *values = hidden.value;
}

static GLenum GL_APIENTRY hiding_get_reset_status(void)
{
    return hidden.reset;
}

static GlFunction hiding_address(const char *name)
{
    if (hidden.reset && strncmp(name, "glGetGraphicsResetStatus", 24) == 0)
        return (GlFunction)hiding_get_reset_status;
    if (hidden.missing && strncmp(name, hidden.missing, strlen(hidden.missing)) == 0)
        return NULL;
    if (strcmp(name, "glGetString") == 0)
        return (GlFunction)hiding_get_string;
    if (strcmp(name, "glGetIntegerv") == 0)
        return (GlFunction)hiding_get_integers;
    return backend->address(name);
}

static CanvasBackend hiding_backend(void)
{
    CanvasBackend hiding = *backend;
    memset(&hidden, 0, sizeof hidden);
    hiding.address = hiding_address;
    hiding.presents = false; /* a window needs more than drawing does */
    return hiding;
}

TEST(a_driver_without_a_function_is_refused_and_the_function_named)
{
    const CanvasBackend hiding = hiding_backend();
    hidden.missing = "glUniformMatrix4fv";
    assert_refused((CanvasOptions){.backend = &hiding, .width = 4, .height = 4},
                   "OpenGL ES 2: the driver has no glUniformMatrix4fv");
}

TEST(a_driver_that_gives_fewer_bits_than_asked_is_refused_and_they_are_named)
{
    const CanvasBackend hiding = hiding_backend();
    const CanvasOptions options = {.backend = &hiding, .width = 4, .height = 4};
    hidden.integer = GL_DEPTH_BITS;
    hidden.value = 16;
    assert_refused(options, "canvas: asked for RGBA 8 8 8 8 and depth 24, the driver gave 8 8 8 8 "
                            "and 16");
    hidden.integer = GL_GREEN_BITS;
    Canvas canvas;
    FAILS_WITH(canvas_open(&canvas, &options, message), "the driver gave 8 16 8 8 and");
}

TEST(a_driver_of_opengl_es_2_alone_draws_with_what_it_has)
{
    CanvasBackend hiding = hiding_backend();
    CanvasOptions options = {
        .backend = &hiding, .width = 8, .height = 8, .samples = 4, .real = true};
    hidden.version = "OpenGL ES 2.0 hidden";
    hidden.extensions = "GL_OES_depth24 GL_OES_rgb8_rgba8";
    Canvas canvas = open_canvas(options);
    assert_false(canvas.real);
    assert_int_equal(canvas.samples, 0);
    assert_int_equal(canvas.supersample, 2);

    Mesh mesh;
    MeshBuffer buffer;
    assert_true(mesh_sphere(&mesh, 1, 256, 255, NULL));
    FAILS(mesh_buffer_open(&buffer, &mesh, message),
          "mesh: 65792 vertices: this driver indexes at most 65536 (it "
          "lacks GL_OES_element_index_uint); use fewer divisions");
    mesh_close(&mesh);
    canvas_close(&canvas);

    hidden.extensions = "GL_OES_depth24 GL_OES_rgb8_rgba8_and_more";
    FAILS_WITH(canvas_open(&canvas, &options, message),
               "cannot draw to 8-bit RGBA (GL_OES_rgb8_rgba8)");

    hiding.presents = true;
    FAILS_WITH(canvas_open(&canvas, &options, message), "cannot copy to it (OpenGL ES 3 or "
                                                        "GL_ANGLE_framebuffer_blit)");
}

/* Software never resets, and softpipe has no extension for it: both are simulated. */
TEST(a_driver_reset_is_reported_and_nothing_is_read)
{
    static const struct {
        GLenum status;
        const char *said;
    } resets[] = {{GL_GUILTY_CONTEXT_RESET_EXT, "was reset (by this program)"},
                  {GL_INNOCENT_CONTEXT_RESET_EXT, "was reset (by another program)"},
                  {GL_UNKNOWN_CONTEXT_RESET_EXT, "was reset (cause unknown)"}};
    const CanvasBackend hiding = hiding_backend();
    hidden.extensions = "GL_OES_depth24 GL_OES_rgb8_rgba8 GL_EXT_robustness";
    for (size_t i = 0; i < sizeof resets / sizeof resets[0]; i++) {
        Message message = {0};
        hidden.reset = resets[i].status;
        CLOSED(canvas_close)
        Canvas canvas = open_canvas((CanvasOptions){.backend = &hiding, .width = 4, .height = 4});
        CLOSED(image_close) Image image = new_image(&canvas);
        assert_false(canvas_read(&canvas, &image, &message));
        assert_non_null(strstr(message.text, resets[i].said));
        assert_non_null(strstr(message.text, canvas.renderer));
    }
}

static void assert_lost(const Canvas *canvas)
{
    CLOSED(image_close) Image image = new_image(canvas);
    assert_false(canvas_check(canvas, NULL));
    FAILS(canvas_read(canvas, &image, message),
          "canvas: its context is no longer current; what was drawn is lost");
}

TEST(a_context_unbound_by_others_is_reported_and_can_be_closed)
{
    Canvas canvas = open_canvas((CanvasOptions){.width = 4, .height = 4, .samples = 4});
    assert_true(canvas_check(&canvas, NULL));
    /* Other code in the process takes the context from the canvas. */
    if (backend == &CANVAS_OSMESA) {
        unsigned char (*make)(void *, void *, GLenum, GLsizei, GLsizei);
        void *library = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_NOLOAD);
        assert_non_null(library);
        *(void **)&make = dlsym(library, "OSMesaMakeCurrent");
        make(NULL, NULL, 0, 0, 0);
        dlclose(library);
    } else {
        typedef void *(*Get)(void);
        typedef unsigned (*Make)(void *, void *, void *, void *);
        void *display = ((Get)backend->address("eglGetCurrentDisplay"))();
        assert_int_equal(((Make)backend->address("eglMakeCurrent"))(display, NULL, NULL, NULL), 1);
    }
    assert_lost(&canvas);
    /* Drawing does not crash. */
    clear(1, 0, 0, 1);
    canvas_begin(&canvas);
    if (backend == &CANVAS_WINDOW)
        canvas_present(&canvas, (const int[4]){0, 0, 4, 4});
    assert_lost(&canvas);
    canvas_close(&canvas);
    canvas = open_canvas((CanvasOptions){.width = 4, .height = 4});
    assert_true(canvas_check(&canvas, NULL));
    canvas_close(&canvas);
}

/* Closing the other one terminates EGL's display and all its contexts. */
TEST(a_context_replaced_or_destroyed_by_others_is_reported_and_can_be_closed)
{
    void *other;
    const char *platform;
    Canvas canvas = open_canvas((CanvasOptions){.width = 4, .height = 4});
    SUCCEEDS(backend->open(&other, &(CanvasOptions){.width = 1, .height = 1}, &platform, message));
    assert_lost(&canvas);
    backend->close(other);
    assert_lost(&canvas);
    canvas_close(&canvas);
    canvas = open_canvas((CanvasOptions){.width = 4, .height = 4});
    clear(0, 1, 0, 1);
    CLOSED(image_close) Image image = read_canvas(&canvas);
    assert_int_equal(pixel(&image, 3, 3)[1], 255);
    canvas_close(&canvas);
}

TEST(more_samples_than_there_are_is_refused_and_the_most_named)
{
    Canvas canvas = open_canvas((CanvasOptions){.width = 4, .height = 4, .samples = 2});
    GLint max = 0;
    glGetIntegerv(GL_MAX_SAMPLES_ANGLE, &max);
    if (max <= 1) {
        assert_int_equal(canvas.supersample, 2);
        return canvas_close(&canvas);
    }
    assert_true(canvas.samples >= 2);
    const char *expected = formatted("%d samples: must be 0 to %d, the most that %s has",
                                     (int)max + 1, (int)max, canvas.renderer);
    canvas_close(&canvas);
    assert_refused((CanvasOptions){.width = 4, .height = 4, .samples = (int)max + 1}, expected);
}

TEST(a_driver_without_samples_takes_more_pixels_instead_up_to_4_by_4)
{
    static const int sides[][2] = {{2, 2}, {4, 2}, {5, 3}, {9, 3}, {10, 4}, {16, 4}};
    const CanvasBackend hiding = hiding_backend();
    CanvasOptions options = {.backend = &hiding, .width = 4, .height = 4};
    for (int with_functions = 0; with_functions <= 1; with_functions++) {
        hidden.missing = with_functions ? NULL : "glRenderbufferStorageMultisample";
        hidden.integer = with_functions ? GL_MAX_SAMPLES_ANGLE : 0;
        hidden.value = 1;
        for (size_t i = 0; i < sizeof sides / sizeof sides[0]; i++) {
            options.samples = sides[i][0];
            CLOSED(canvas_close) Canvas canvas = open_canvas(options);
            assert_int_equal(canvas.samples, 0);
            assert_int_equal(canvas.supersample, sides[i][1]);
            assert_int_equal(canvas_max_samples(&canvas), 16);
        }
        Canvas canvas;
        options.samples = 17;
        FAILS_WITH(canvas_open(&canvas, &options, message), "17 samples: must be 0 to 16, ");
        options.samples = INT_MAX;
        assert_false(canvas_open(&canvas, &options, NULL));
    }
}

/* Meshes. */

/* The unit sphere seen along z: a disc of radius 0.8 of half the canvas. Pixels within one pixel of
 * its edge may be either. */
static void assert_disc(const Mesh *mesh, GLenum index_type)
{
    enum { SIDE = 200 };
    const double radius = 0.8 * SIDE / 2;
    CLOSED(canvas_close)
    Canvas canvas = open_canvas((CanvasOptions){.width = SIDE, .height = SIDE});
    CLOSED(close_flat) Flat flat = open_flat();
    CLOSED(image_close) Image min = new_image(&canvas), max = new_image(&canvas);
    MeshBuffer buffer;
    assert_true(mesh_buffer_open(&buffer, mesh, NULL));
    assert_int_equal(buffer.index_type, index_type);
    assert_int_equal(buffer.index_count, mesh->index_count);
    mesh_buffer_close(&buffer);
    clear(0, 0, 0, 1);
    draw_mesh(&flat, mesh, mat4_scale((Vec3){0.8, 0.8, -0.8}), WHITE);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const double r = hypot(x + 0.5 - SIDE / 2.0, y + 0.5 - SIDE / 2.0);
            set_pixel(&min, x, y, r < radius - 1 ? WHITE : (Vec3){0, 0, 0});
            set_pixel(&max, x, y, r < radius + 1 ? WHITE : (Vec3){0, 0, 0});
        }
    CLOSED(image_close) Image got = read_canvas(&canvas);
    assert_between(&got, &min, &max, "canvas-disc");
}

TEST(a_mesh_of_more_than_65536_vertices_is_drawn_completely)
{
    static const struct {
        int slices, stacks;
        GLenum index_type;
    } spheres[] = {{100, 100, GL_UNSIGNED_SHORT},
                   {255, 255, GL_UNSIGNED_SHORT}, /* 65536 vertices */
                   {256, 255, GL_UNSIGNED_INT},
                   {400, 400, GL_UNSIGNED_INT}};
    for (size_t i = 0; i < sizeof spheres / sizeof spheres[0]; i++) {
        CLOSED(mesh_close) Mesh mesh;
        assert_true(mesh_sphere(&mesh, 1, spheres[i].slices, spheres[i].stacks, NULL));
        assert_disc(&mesh, spheres[i].index_type);
    }
}

/* One that another program left enabled may point to a buffer that is gone. */
TEST(binding_a_mesh_disables_the_attributes_that_it_does_not_use)
{
    CLOSED(canvas_close) Canvas canvas = open_canvas((CanvasOptions){.width = 8, .height = 8});
    CLOSED(mesh_close) Mesh cube;
    CLOSED(mesh_buffer_close) MeshBuffer buffer;
    SUCCEEDS(mesh_cube(&cube, 2, message));
    SUCCEEDS(mesh_buffer_open(&buffer, &cube, message));
    for (GLuint i = 0; i < 8; i++)
        glEnableVertexAttribArray(i);
    mesh_buffer_bind(&buffer, 5, -1);
    for (GLuint i = 0; i < 8; i++) {
        GLint enabled = -1;
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled);
        assert_int_equal(enabled, i == 5);
        glDisableVertexAttribArray(i);
    }
}

TEST(a_mesh_buffer_may_be_closed_twice_and_nothing_may_be_closed)
{
    CLOSED(canvas_close) Canvas canvas = open_canvas((CanvasOptions){.width = 1, .height = 1});
    Mesh mesh;
    MeshBuffer buffer = {0};
    mesh_buffer_close(NULL);
    mesh_buffer_close(&buffer);
    assert_true(mesh_cube(&mesh, 1, NULL));
    assert_true(mesh_buffer_open(&buffer, &mesh, NULL));
    mesh_close(&mesh);
    mesh_buffer_close(&buffer);
    assert_true(!buffer.vertices && !buffer.indices && !buffer.index_count);
    mesh_buffer_close(&buffer);
}

/* Antialiasing. */

/* Upright and level edges between two columns of samples, and a quarter of a column beside: a pixel
 * has the part of its samples that is inside. Those of a grid have as many columns and rows as it;
 * four samples lie in four of each (D3D11_STANDARD_MULTISAMPLE_PATTERN, which drivers use too). */
static void assert_smooth(CanvasOptions options, const char *name)
{
    enum { SIDE = 16 };
    options.width = options.height = SIDE;
    CLOSED(canvas_close) Canvas canvas = open_canvas(options);
    CLOSED(close_flat) Flat flat = open_flat();
    const int columns = canvas.supersample * (canvas.samples > 1 ? 4 : 1);
    for (int i = 0; i < 6 * (columns + 1); i++) {
        const bool upright = i % 2;
        const double inside = i / 6, at = (inside + 0.25 * (i / 2 % 3 - 1)) / columns;
        const double edge = 2 * at / SIDE; /* of the pixel in the middle */
        clear(0, 0, 0, 1);
        draw_rectangle(&flat, upright ? (Sides){-1, -1, edge, 1} : (Sides){-1, -edge, 1, 1}, 0,
                       WHITE);
        CLOSED(image_close) Image got = read_canvas(&canvas);
        const int value = pixel(&got, upright ? SIDE / 2 : 3, upright ? 3 : SIDE / 2)[0];
        if (fabs(value - 255 * inside / columns) > 1)
            fail_msg("%s: %d of %d columns inside: %d", name, (int)inside, columns, value);
    }
}

TEST(samples_have_the_mean_of_what_they_see)
{
    const CanvasBackend hiding = hiding_backend();
    const struct {
        CanvasOptions options;
        const char *name;
    } kinds[] = {{{.samples = 0}, "no samples"},
                 {{.samples = 1}, "one sample"},
                 {{.samples = 4}, "4 samples"},
                 {{.supersample = 2}, "2x2"},
                 {{.supersample = 3}, "3x3"},
                 {{.supersample = 4}, "4x4"},
                 {{.samples = 4, .supersample = 2}, "4 samples in 2x2"},
                 {{.samples = 4, .backend = &hiding}, "a driver without samples, asked for 4"}};
    hidden.missing = "glBlitFramebuffer";
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        assert_smooth(kinds[i].options, kinds[i].name);
}

int main(void)
{
    int failed = 0, tested = 0;
    for (int i = 0; BACKENDS[i]; i++) {
        void *context;
        const char *platform;
        Message message = {0};
        backend = BACKENDS[i];
        if (!backend->open(&context, &(CanvasOptions){.width = 1, .height = 1}, &platform,
                           &message)) {
            printf("canvas_test: %s skipped: %s\n", backend->name, message.text);
            continue;
        }
        backend->close(context);
        tested++;
        failed += testing_run(0, backend->name, NULL, NULL);
    }
    return tested ? failed : EXIT_SKIPPED;
}
