#include "app/command_example.h"

#include "scene/scene_example.h"

static const char *const SHAPES[] = {"sphere", "cube", "tea pot", NULL};
double turn = 0.1;
static double wide = 0;
int slices = 16, shape = 1, style;
bool marks = true, sheet;
static bool always;
Vec3 color = {0.2, 0.3, 0.4};
const char *model, *title = "a title";

/* A style is a color and slices, which other options change. */
static const char *const STYLES[] = {"plain", "blue", "coarse", NULL};

static void style_changed(const Parameter *parameter)
{
    assert_ptr_equal(parameter->value, &style);
    if (style == 1)
        color = (Vec3){0, 0, 1};
    if (style == 2)
        slices = 3;
}

const Parameter PARAMETERS[] = {
    {"turn", NULL, PARAMETER_NUMBER, .value = &turn, .min = -1e300, .max = 1e300},
    {"wide", NULL, PARAMETER_NUMBER, .value = &wide, .min = 0, .max = 1},
    {"slices", NULL, PARAMETER_WHOLE, .value = &slices, .min = -9, .max = 512},
    {"shape", NULL, PARAMETER_CHOICE, .value = &shape, .choices = SHAPES},
    {"marks", NULL, PARAMETER_SWITCH, .value = &marks},
    {"sheet", NULL, PARAMETER_FLAG, .value = &sheet},
    {"always", NULL, PARAMETER_FLAG, .value = &always},
    {"color", NULL, PARAMETER_COLOR, .value = &color, .min = -1, .max = 2},
    {"model", NULL, PARAMETER_TEXT, .value = &model},
    {"title", NULL, PARAMETER_TEXT, .value = &title},
    {"style", NULL, PARAMETER_CHOICE, .value = &style, .choices = STYLES, .changed = style_changed},
    {.name = NULL},
};

ParameterValue defaults[PARAMETER_COUNT];

static void no_scene(double seconds, int view, Scene *scene)
{
    (void)seconds, (void)view, (void)scene;
}

const Example example = {.name = "Example",
                         .width = 500,
                         .kind = &SCENE_KIND,
                         .content = &(const SceneExample){.make = no_scene},
                         .parameters = PARAMETERS};

void put_back(const ParameterValue *values)
{
    for (int i = 0; i < PARAMETER_COUNT; i++)
        parameter_restore(&PARAMETERS[i], values[i]);
}

int save_defaults(void **state)
{
    (void)state;
    for (int i = 0; i < PARAMETER_COUNT; i++)
        defaults[i] = parameter_save(&PARAMETERS[i]);
    unsetenv("LIGHTING_BACKEND");
    return 0;
}

int restore_defaults(void **state)
{
    (void)state;
    put_back(defaults);
    unsetenv("LIGHTING_BACKEND");
    return 0;
}

Options plain_options(const Example *of)
{
    const Usage usage = options_usage(of);
    char name[] = "Example", *argv[] = {name, NULL};
    Options options;
    Message message = {0};
    assert_int_equal(options_read(&options, &usage, 1, argv, &message), OPTIONS_RUN);
    options.output = NULL;
    return options;
}
