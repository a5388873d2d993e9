/*
 * The panel over the pictures of examples: what is drawn, where, and that the examples draw the
 * same picture, bit for bit, before and after.
 */
#include "panel_draw.h"

#include "picture_check.h"
#include "stage.h"
#include "testing.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

extern const Example LightedCube, PointLightedSphere_perFragment, ShadingModels, PhongBlinn;

static const PanelHelp HELP[] = {{"space", "pauses"}, {"h", "help"}, {NULL, NULL}};

static Canvas canvas;
static Panel *panel;
static PanelDraw draw;
static Options options;

static void open_all(int width, int height)
{
    Message message = {0};
    options = (Options){.width = width, .height = height, .fps = 30, .frames = 1};
    require(stage_open(&canvas, &options, "x.png", &message), &message);
    require(panel_open(&panel, &message), &message);
    require(panel_draw_open(&draw, &options.shaders, &message), &message);
}

static void close_all(void)
{
    panel_draw_close(&draw);
    panel_draw_close(&draw); /* closed twice is closed */
    panel_draw_close(NULL);
    panel_close(panel);
    canvas_close(&canvas);
}

static Image read_picture(void)
{
    Message message = {0};
    Image image;
    require(image_open(&image, canvas.width, canvas.height, IMAGE_BYTE, &message), &message);
    require(canvas_read(&canvas, &image, &message), &message);
    return image;
}

static Image example_picture(const Example *example)
{
    Message message = {0};
    require(stage_draw(example, &canvas, &options, 0.75, &message), &message);
    return read_picture();
}

static PanelContent everything(const Example *example)
{
    return (PanelContent){.name = example->name,
                          .view = PANEL_OPEN,
                          .parameters = example->parameters,
                          .milliseconds = 2,
                          .frames_per_second = 500,
                          .effects = "# object 0\ndiffuse: both have it\nwithout a back: closed",
                          .command = "an example's command",
                          .help = HELP,
                          .errors = "shaders/some.frag:23: there is no such thing",
                          .notice = "saved some.png"};
}

static PanelDrawing panel_drawing(const PanelContent *content, double scale)
{
    const WindowInput window = {
        .width = canvas.width, .height = canvas.height, .scale = scale, .x = -1, .y = -1};
    const PanelInput input = {.window = &window, .seconds = 0.02};
    PanelResult result;
    Message message = {0};
    for (int i = 0; i < 3; i++)
        require(panel_frame(panel, &input, content, &result, &message), &message);
    return result.drawing;
}

static void draw_panel(const PanelContent *content, double scale)
{
    Message message = {0};
    const PanelDrawing drawing = panel_drawing(content, scale);
    require(panel_draw(&draw, &drawing, canvas.width, canvas.height, &message), &message);
}

static const unsigned char *pixel(const Image *image, int x, int y)
{
    return (const unsigned char *)image->pixels +
           4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static bool same_pixel(const Image *a, const Image *b, int x, int y)
{
    return memcmp(pixel(a, x, y), pixel(b, x, y), 4) == 0;
}

static void assert_same(const Image *a, const Image *b, const char *name)
{
    assert_true(picture_check_same(name, a, b, 0));
}

/* The examples that set their state once: attributes with and without arrays, depth, culling. */
static void test_an_example_draws_the_same_before_and_after(void **state)
{
    static const Example *const examples[] = {&LightedCube, &PointLightedSphere_perFragment,
                                              &ShadingModels, &PhongBlinn};
    (void)state;
    open_all(400, 300);
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
        const Example *example = examples[i];
        const PanelContent content = everything(example);
        Message message = {0};
        require(stage_enter(example, &options, &message), &message);
        Image before = example_picture(example);
        draw_panel(&content, 1);
        Image with = read_picture();
        Image after = example_picture(example);
        assert_same(&after, &before, "panel-after");
        assert_false(same_pixel(&with, &before, 30, 30));
        stage_leave(example);
        image_close(&before);
        image_close(&with);
        image_close(&after);
    }
    close_all();
}

typedef struct Queried {
    GLint integers[16];
    GLint attribute[2][6];
    GLfloat value[2][4];
    GLboolean mask[4], enabled[6];
} Queried;

static Queried query(void)
{
    static const GLenum names[] = {
        GL_CURRENT_PROGRAM,      GL_ARRAY_BUFFER_BINDING, GL_ELEMENT_ARRAY_BUFFER_BINDING,
        GL_ACTIVE_TEXTURE,       GL_BLEND_SRC_RGB,        GL_BLEND_DST_RGB,
        GL_BLEND_SRC_ALPHA,      GL_BLEND_DST_ALPHA,      GL_BLEND_EQUATION_RGB,
        GL_BLEND_EQUATION_ALPHA, GL_UNPACK_ALIGNMENT,     GL_TEXTURE_BINDING_2D};
    static const GLenum attributes[] = {
        GL_VERTEX_ATTRIB_ARRAY_ENABLED, GL_VERTEX_ATTRIB_ARRAY_SIZE,
        GL_VERTEX_ATTRIB_ARRAY_TYPE,    GL_VERTEX_ATTRIB_ARRAY_NORMALIZED,
        GL_VERTEX_ATTRIB_ARRAY_STRIDE,  GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING};
    static const GLenum capabilities[] = {GL_BLEND,        GL_CULL_FACE,
                                          GL_DEPTH_TEST,   GL_SAMPLE_ALPHA_TO_COVERAGE,
                                          GL_SCISSOR_TEST, GL_STENCIL_TEST};
    Queried queried;
    memset(&queried, 0, sizeof queried);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        glGetIntegerv(names[i], &queried.integers[i]);
    for (GLuint k = 0; k < 2; k++) {
        for (size_t i = 0; i < 6; i++)
            glGetVertexAttribiv(k, attributes[i], &queried.attribute[k][i]);
        if (k > 0 || !gl_desktop()) /* where attribute 0 has no value */
            glGetVertexAttribfv(k, GL_CURRENT_VERTEX_ATTRIB, queried.value[k]);
    }
    glGetBooleanv(GL_COLOR_WRITEMASK, queried.mask);
    for (size_t i = 0; i < 6; i++)
        queried.enabled[i] = glIsEnabled(capabilities[i]);
    return queried;
}

/* State of kinds that no example has yet. */
static void test_all_state_is_as_before(void **state)
{
    GLint box[4], view[4];
    GLuint buffer, textures[2];
    (void)state;
    open_all(300, 300);
    const PanelContent content = everything(&LightedCube);
    glGenBuffers(1, &buffer);
    glGenTextures(2, textures);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, draw.indices);
    glVertexAttribPointer(0, 3, GL_SHORT, GL_FALSE, 24, (const void *)(uintptr_t)8);
    glEnableVertexAttribArray(0);
    glVertexAttrib3fv(1, (const GLfloat[]){0.25F, 0.5F, 0.75F});
    glBindTexture(GL_TEXTURE_2D, textures[0]);
    glActiveTexture(GL_TEXTURE0 + 3);
    glBindTexture(GL_TEXTURE_2D, textures[1]);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    glBlendFuncSeparate(GL_ONE, GL_ZERO, GL_DST_COLOR, GL_SRC_COLOR);
    glBlendEquationSeparate(GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glEnable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glViewport(1, 2, 3, 4);
    glScissor(5, 6, 7, 8);
    const Queried before = query();
    draw_panel(&content, 1);
    const Queried after = query();
    assert_memory_equal(&after, &before, sizeof before);
    glGetIntegerv(GL_SCISSOR_BOX, box);
    glGetIntegerv(GL_VIEWPORT, view);
    assert_memory_equal(box, ((GLint[]){5, 6, 7, 8}), sizeof box);
    assert_memory_equal(view, ((GLint[]){1, 2, 3, 4}), sizeof view);
    glActiveTexture(GL_TEXTURE0);
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    assert_int_equal(bound, textures[0]);
    glDeleteTextures(2, textures);
    glDeleteBuffers(1, &buffer);
    close_all();
}

/* The panel lies where its commands say, its rows from the top, and is see-through. */
static void test_it_is_drawn_where_it_is(void **state)
{
    PanelContent content = everything(&LightedCube);
    (void)state;
    content.help = NULL;
    content.errors = content.notice = NULL;
    open_all(1000, 700);
    canvas_clear(&canvas, (Vec3){1, 1, 1}, 1);
    draw_panel(&content, 1);
    Image image = read_picture();
    for (int y = 0; y < 700; y++) {
        for (int x = 0; x < 1000; x++) {
            assert_int_equal(pixel(&image, x, y)[3], 255); /* what was opaque is opaque */
            if (x < 8 || y < 8 || x >= 8 + 340)
                assert_int_equal(pixel(&image, x, y)[0], 255);
        }
    }
    /* Between the rows: white that shines through. */
    const unsigned char *through = pixel(&image, 340, 100);
    assert_true(through[0] > 255 / 20 && through[0] < 255 / 4);
    assert_true(pixel(&image, 100, 600)[0] == 255);
    image_close(&image);
    close_all();
}

static void test_every_size_and_scale(void **state)
{
    static const struct {
        int width, height;
        double scale;
    } cases[] = {{400, 400, 1}, {1000, 700, 1}, {1600, 1200, 2}, {1, 1, 1},
                 {16, 16, 1},   {16, 400, 4},   {2000, 16, 1.5}, {333, 250, 0.5}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Message message = {0};
        open_all(cases[i].width, cases[i].height);
        require(stage_enter(&ShadingModels, &options, &message), &message);
        Image before = example_picture(&ShadingModels);
        const PanelContent content = everything(&ShadingModels);
        draw_panel(&content, cases[i].scale);
        Image with = read_picture(), after = example_picture(&ShadingModels);
        assert_same(&after, &before, "panel-size");
        stage_leave(&ShadingModels);
        image_close(&before);
        image_close(&with);
        image_close(&after);
        close_all();
    }
}

/* Another size and scale within one window, as when it goes to another screen. */
static void test_the_atlas_follows_the_scale(void **state)
{
    const PanelContent content = everything(&LightedCube);
    Message message = {0};
    (void)state;
    open_all(500, 500);
    canvas_begin(&canvas);
    glClear(GL_COLOR_BUFFER_BIT);
    draw_panel(&content, 1);
    Image first = read_picture();
    require(canvas_resize(&canvas, 1000, 800, &message), &message);
    canvas_begin(&canvas);
    draw_panel(&content, 2);
    require(canvas_resize(&canvas, 500, 500, &message), &message);
    canvas_begin(&canvas);
    glClear(GL_COLOR_BUFFER_BIT);
    draw_panel(&content, 1);
    Image again = read_picture();
    assert_same(&again, &first, "panel-again");
    image_close(&first);
    image_close(&again);
    close_all();
}

static void test_nothing_to_show_draws_nothing(void **state)
{
    const PanelContent content = {.name = "nothing"};
    (void)state;
    open_all(64, 64);
    canvas_clear(&canvas, (Vec3){0.2, 0.4, 0.6}, 1);
    Image before = read_picture();
    draw_panel(&content, 1);
    Image after = read_picture();
    assert_same(&after, &before, "panel-nothing");
    image_close(&before);
    image_close(&after);
    close_all();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_example_draws_the_same_before_and_after),
        cmocka_unit_test(test_all_state_is_as_before),
        cmocka_unit_test(test_it_is_drawn_where_it_is),
        cmocka_unit_test(test_every_size_and_scale),
        cmocka_unit_test(test_the_atlas_follows_the_scale),
        cmocka_unit_test(test_nothing_to_show_draws_nothing),
    };
    if (!picture_check_driver("panel_draw") || !panel_doctor())
        return EXIT_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
