#include "choose/random_command.h"

#include "core/mesh.h"
#include "scene/scene_example.h"
#include "support/testing.h"

Random randomness;

int below(int limit)
{
    return random_below(&randomness, limit);
}

static double between(double min, double max)
{
    return random_between(&randomness, min, max);
}

static const char *const MODELS[] = {"ball.obj", "facets.obj", "bent.obj"};
enum { MODEL_COUNT = sizeof MODELS / sizeof MODELS[0] };

/* A sphere of 8 x 4, with normals of the sphere or of its faces, wound the other way then. */
static void write_ball(const char *name, bool facets)
{
    CLOSED(mesh_close) Mesh mesh;
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    SUCCEEDS(mesh_sphere(&mesh, 1, 8, 4, message) && (!facets || mesh_flatten(&mesh, message)));
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        const Vec3 p = vec3_from_float(mesh.vertices[i].position);
        const Vec3 n = vec3_from_float(mesh.vertices[i].normal);
        fprintf(file, "v %.6f %.6f %.6f\nvn %.6f %.6f %.6f\n", p.x, p.y, p.z, n.x, n.y, n.z);
    }
    for (size_t i = 0; i < mesh.index_count; i += 3) {
        const uint32_t *corner = &mesh.indices[i];
        const uint32_t a = corner[facets ? 2 : 0] + 1, b = corner[1] + 1,
                       c = corner[facets ? 0 : 2] + 1;
        fprintf(file, "f %u//%u %u//%u %u//%u\n", a, a, b, b, c, c);
    }
    fclose(file);
}

void write_models(void)
{
    write_ball(MODELS[0], false);
    write_ball(MODELS[1], true);
    testing_put(MODELS[2], "v -1 0 0\nv 1 0 0\nv 0 1 0.5\nv 0 -1 0.5\nf 1 2 3\nf 2 1 4\n");
}

/* One of six is an end of the range, and one of six near its beginning. */
static double any_number(double min, double max)
{
    const int kind = below(6);
    if (kind == 0)
        return below(2) ? min : max;
    return min + (max - min) * (kind == 1 ? pow(1e-3, between(0, 1)) : between(0, 1));
}

static void any_value(const Parameter *parameter, char *line, size_t size)
{
    const char *const *choices = parameter_choices(parameter);
    char text[64] = "";
    int count = 0;
    while (choices && choices[count])
        count++;
    switch (parameter->kind) {
    case PARAMETER_NUMBER:
        snprintf(text, sizeof text, "%.3f", any_number(parameter->min, parameter->max));
        break;
    case PARAMETER_WHOLE:
        /* Not 1024 divisions: the oracle asks every triangle for every pixel. */
        snprintf(text, sizeof text, "%d",
                 (int)parameter->min + below((int)fmin(parameter->max - parameter->min, 64) + 1));
        break;
    case PARAMETER_CHOICE:
    case PARAMETER_SWITCH:
        snprintf(text, sizeof text, "%s", choices[below(count)]);
        break;
    case PARAMETER_COLOR:
        snprintf(text, sizeof text, "%.2f,%.2f,%.2f", between(parameter->min, parameter->max),
                 below(3) ? parameter->min : between(parameter->min, parameter->max),
                 between(parameter->min, parameter->max));
        break;
    case PARAMETER_TEXT:
        if (strcmp(parameter->name, "model") != 0 || below(3))
            return;
        snprintf(text, sizeof text, "%s", MODELS[below(MODEL_COUNT)]);
        break;
    case PARAMETER_FLAG:
        return;
    }
    snprintf(line, size, "--%s=%s", parameter->name, text);
}

void add(Command *command, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(command->words[command->count++], sizeof command->words[0], format, arguments);
    va_end(arguments);
}

/* Whether --error may choose this itself, if it is not given. */
static bool is_chosen(const Parameter *parameter)
{
    static const char *const names[] = {"interpolation", "viewer", "normals", "slices", "stacks"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(parameter->name, names[i]) == 0)
            return true;
    return false;
}

/* One or two terms, and perhaps one of the lights alone. */
static void any_terms(Command *command)
{
    static const char *const terms[] = {"ambient", "diffuse", "specular", "emission"};
    const int first = below(4), second = (first + 1 + below(3)) % 4;
    char text[64];
    snprintf(text, sizeof text, "%s", terms[first]);
    if (below(2))
        snprintf(text + strlen(text), sizeof text - strlen(text), ",%s", terms[second]);
    if (below(3) == 0)
        snprintf(text + strlen(text), sizeof text - strlen(text), ",0");
    add(command, "--terms=%s", text);
}

/* Places and colors of lights, and shadows. Those of light that is clamped at the vertices are
 * refused. */
static void any_light(Command *command, bool clamped)
{
    if (below(6) == 0)
        add(command, "--light-at=0,%.2f,%.2f,%.2f", between(-4, 4), between(-4, 4), between(-4, 4));
    if (below(6) == 0)
        add(command, "--light-color=0,%.2f,%.2f,%.2f", between(0, 1), between(0, 1), between(0, 1));
    if (clamped)
        add(command, "--shadows=off");
    else if (below(4) == 0) {
        /* The search takes ten times as long with shadows. */
        add(command, "--shadows=volumes");
        add(command, "--size=%dx%d", 50 + below(100), 50 + below(100));
    }
}

static const Example *any_example(bool shadows)
{
    const Example *example;
    do
        example = EXAMPLES[below(EXAMPLE_COUNT)];
    while (!shadows && example_scene(example)->shadows);
    return example;
}

Command any_command(double most, double error, bool lit)
{
    static const double errors[] = {0.6, 1, 2, 4, 8, 16, 32};
    /* The third: floats. */
    static const char *const rare[] = {"--samples=4", "--precision=mediump", "--output=x.tif",
                                       "--alpha"};
    const double any = errors[below(7)];
    Command command = {.example = any_example(lit)};
    const Parameter *own = command.example->parameters;
    add(&command, "--error=%g", error > 0 ? error : any);
    add(&command, "--size=%dx%d", (int)(50 * pow(most / 50, between(0, 1))),
        (int)(50 * pow(0.75 * most / 50, between(0, 1))));
    if (below(2))
        add(&command, "--time=%.2f", between(0, 12));
    if (below(2))
        add(&command, "--orbit=%.1f,%.1f,%.2f", between(-180, 180), between(-80, 80),
            between(0.4, 2));
    if (below(6) == 0)
        add(&command, "--linear-light");
    const bool clamped = below(8) == 0;
    if (clamped)
        add(&command, "--clamp=vertex");
    if (lit)
        any_light(&command, clamped);
    if (below(10) == 0)
        add(&command, "--full");
    if (below(10) == 0)
        add(&command, "--show-clipped");
    if (below(12) == 0)
        add(&command, "--lighting=off");
    else if (below(6) == 0)
        any_terms(&command);
    for (int i = 0; i < 4; i++)
        if (below(12) == 0 && error == 0)
            add(&command, "%s", rare[i]);
    for (; own && own->name && command.count < MAX_WORDS - 4; own++) {
        if (below(2) || (error > 0 && is_chosen(own)))
            continue;
        command.words[command.count][0] = '\0';
        any_value(own, command.words[command.count], sizeof command.words[0]);
        command.count += command.words[command.count][0] != '\0';
    }
    return command;
}
