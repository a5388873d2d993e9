/*
 * The panel over the pictures of examples: what is drawn, where, and that the examples draw the
 * same picture, bit for bit, before and after.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "scene/scene_example.h"
#include "support/picture_check.h"
#include "support/testing.h"
#include "window/panel_draw.h"

extern const Example LightedCube, PointLightedSphere_perFragment, ShadingModels, PhongBlinn;

static const PanelHelp HELP[] = {{"space", "pauses"}, {"h", "help"}, {NULL, NULL}};

static Canvas canvas;
static Renderer renderer;
static Panel *panel;
static PanelDraw draw;
static Options options;
static DrawRequest request;

static void open_all(int width, int height)
{
    options = (Options){.width = width, .height = height, .fps = 30, .frames = 1};
    request = options_request(&options, &LightedCube);
    SUCCEEDS(options_open_canvas(&canvas, &options, "x.png", message));
    SUCCEEDS(panel_open(&panel, message));
    SUCCEEDS(panel_draw_open(&draw, &options.shaders, message));
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
    Image image;
    SUCCEEDS(image_open(&image, canvas.width, canvas.height, IMAGE_BYTE, message));
    SUCCEEDS(canvas_read(&canvas, &image, message));
    return image;
}

static Image example_picture(void)
{
    SUCCEEDS(renderer_draw(&renderer, &request, 0.75, message));
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

static void draw_panel(const PanelContent *content, double scale)
{
    const WindowInput window = {
        .width = canvas.width, .height = canvas.height, .scale = scale, .x = -1, .y = -1};
    const PanelInput input = {.window = &window, .seconds = 0.02};
    PanelResult result;
    for (int i = 0; i < 3; i++)
        SUCCEEDS(panel_frame(panel, &input, content, &result, message));
    const PanelDrawing drawing = result.drawing;
    SUCCEEDS(panel_draw(&draw, &drawing, canvas.width, canvas.height, message));
}

static const unsigned char *pixel(const Image *image, int x, int y)
{
    return (const unsigned char *)image->pixels +
           4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

/* The examples that set their state once: attributes with and without arrays, depth, culling. */
TEST(test_an_example_draws_the_same_before_and_after)
{
    static const Example *const examples[] = {&LightedCube, &PointLightedSphere_perFragment,
                                              &ShadingModels, &PhongBlinn};
    open_all(400, 300);
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
        const Example *example = examples[i];
        const PanelContent content = everything(example);
        SUCCEEDS(renderer_open(&renderer, example, &canvas, &request, message));
        CLOSED(image_close) Image before = example_picture();
        draw_panel(&content, 1);
        CLOSED(image_close) Image with = read_picture();
        CLOSED(image_close) Image after = example_picture();
        assert_true(picture_check_same("panel-after", &after, &before, 0));
        assert_false(memcmp(pixel(&with, 30, 30), pixel(&before, 30, 30), 4) == 0);
        renderer_close(&renderer);
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
        if (k > 0 || !gl_desktop()) /* in which attribute 0 has no value */
            glGetVertexAttribfv(k, GL_CURRENT_VERTEX_ATTRIB, queried.value[k]);
    }
    glGetBooleanv(GL_COLOR_WRITEMASK, queried.mask);
    for (size_t i = 0; i < 6; i++)
        queried.enabled[i] = glIsEnabled(capabilities[i]);
    return queried;
}

/* State that no example sets yet. */
TEST(test_all_state_is_as_before)
{
    GLint box[4], view[4];
    GLuint buffer, textures[2];
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

/* The panel is at the place that its commands give, its first row on top, and transparent. */
TEST(test_it_is_drawn_at_its_position)
{
    enum { LEFT = 1000 - 8 - 340 };
    PanelContent content = everything(&LightedCube);
    content.help = NULL;
    content.errors = content.notice = NULL;
    open_all(1000, 700);
    canvas_clear(&canvas, (Vec3){1, 1, 1}, 1);
    draw_panel(&content, 1);
    CLOSED(image_close) Image image = read_picture();
    for (int y = 0; y < 700; y++)
        for (int x = 0; x < 1000; x++) {
            assert_int_equal(pixel(&image, x, y)[3], 255); /* what was opaque is opaque */
            if (x < LEFT || y < 8 || x >= LEFT + 340)
                assert_int_equal(pixel(&image, x, y)[0], 255);
        }
    /* Between the rows: the white behind shines through. */
    const unsigned char *through = pixel(&image, LEFT + 332, 100);
    assert_true(through[0] > 255 / 20 && through[0] < 255 / 4);
    assert_true(pixel(&image, LEFT + 100, 690)[0] == 255);
    close_all();
}

TEST(test_every_size_and_scale)
{
    static const struct {
        int width, height;
        double scale;
    } cases[] = {{400, 400, 1}, {1000, 700, 1}, {1600, 1200, 2}, {1, 1, 1},
                 {16, 16, 1},   {16, 400, 4},   {2000, 16, 1.5}, {333, 250, 0.5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        open_all(cases[i].width, cases[i].height);
        SUCCEEDS(renderer_open(&renderer, &ShadingModels, &canvas, &request, message));
        CLOSED(image_close) Image before = example_picture();
        const PanelContent content = everything(&ShadingModels);
        draw_panel(&content, cases[i].scale);
        CLOSED(image_close) Image with = read_picture(), after = example_picture();
        assert_true(picture_check_same("panel-size", &after, &before, 0));
        renderer_close(&renderer);
        close_all();
    }
}

/* Another size and scale within one window, as when it moves to another screen. */
TEST(test_the_atlas_follows_the_scale)
{
    const PanelContent content = everything(&LightedCube);
    open_all(500, 500);
    canvas_begin(&canvas);
    glClear(GL_COLOR_BUFFER_BIT);
    draw_panel(&content, 1);
    CLOSED(image_close) Image first = read_picture();
    SUCCEEDS(canvas_resize(&canvas, 1000, 800, message));
    canvas_begin(&canvas);
    draw_panel(&content, 2);
    SUCCEEDS(canvas_resize(&canvas, 500, 500, message));
    canvas_begin(&canvas);
    glClear(GL_COLOR_BUFFER_BIT);
    draw_panel(&content, 1);
    CLOSED(image_close) Image again = read_picture();
    assert_true(picture_check_same("panel-again", &again, &first, 0));
    close_all();
}

TEST(test_nothing_to_show_draws_nothing)
{
    const PanelContent content = {.name = "nothing"};
    open_all(64, 64);
    canvas_clear(&canvas, (Vec3){0.2, 0.4, 0.6}, 1);
    CLOSED(image_close) Image before = read_picture();
    draw_panel(&content, 1);
    CLOSED(image_close) Image after = read_picture();
    assert_true(picture_check_same("panel-nothing", &after, &before, 0));
    close_all();
}

int main(void)
{
    if (!picture_check_driver("panel_draw") || !panel_probe(NULL))
        return EXIT_SKIPPED;
    return testing_run(0, "panel draw", NULL, NULL);
}
