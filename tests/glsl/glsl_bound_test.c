/*
 * glsl_bound: of random shaders over random pieces, the exact result is in its range and the
 * driver's within the error, in highp and in mediump; what is tight, and what has no bound.
 */
#include "base/clock.h"
#include "base/random.h"
#include "glsl/glsl_bound.h"
#include "support/testing.h"

enum { TEXT = 8000, INPUTS = 4 };

/* A shader that is written. */
typedef struct Text {
    char *text;
    size_t length;
    Random *random;
    int names; /* r0 to r(names - 1) have values */
} Text;

static void put(Text *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    to->length += (size_t)vsnprintf(to->text + to->length, TEXT - to->length, format, arguments);
    va_end(arguments);
    assert_true(to->length < TEXT);
}

static void put_number(Text *to, int depth);

static void put_vector(Text *to, int depth)
{
    static const char *const forms[] = {"normalize(", "abs(", "-(", "2.0 * ("};
    const int form = random_below(to->random, 9);
    if (depth <= 0 || form == 0) {
        put(to, random_below(to->random, 2) ? "a" : "b");
    } else if (form <= 4) {
        put(to, "%s", forms[form - 1]);
        put_vector(to, depth - 1);
        put(to, ")");
    } else if (form == 5 || form == 6) {
        put(to, form == 5 ? "reflect(a, normalize(" : "mirrored(a, (");
        put_vector(to, depth - 1);
        put(to, "))");
    } else {
        put(to, "vec3(");
        for (int i = 0; i < 3; i++) {
            put_number(to, depth - 1);
            put(to, i < 2 ? ", " : ")");
        }
    }
}

/* Of up to three operands, each number or vector. */
static void put_number(Text *to, int depth)
{
    static const char *const forms[] = {"(# + #)",
                                        "(# - #)",
                                        "(# * #)",
                                        "(# / (abs(#) + .3))",
                                        "max(#, #)",
                                        "min(#, #)",
                                        "clamp(#, -.5, 1.)",
                                        "mix(#, #, clamp(#, 0., 1.))",
                                        "step(#, #)",
                                        "abs(#)",
                                        "sqrt(abs(#))",
                                        "inversesqrt(abs(#) + .1)",
                                        "sin(#)",
                                        "cos(#)",
                                        "atan(#)",
                                        "exp2(min(#, 4.))",
                                        "floor(#)",
                                        "fract(#)",
                                        "log2(abs(#) + .2)",
                                        "pow(abs(#) + .01, 3.5)",
                                        "dot(@, @)",
                                        "length(@)",
                                        "dot(normalize(@), normalize(@))",
                                        "(# > 0. ? pow(#, 2.) : #)",
                                        "(# < # ? # : #)",
                                        "smoothstep(-.4, .7, #)",
                                        "power(#, 8.)",
                                        "pow(max(dot(normalize(@), normalize(@)), .001), 40.)",
                                        "sign(#)",
                                        "asin(clamp(#, -.9, .9))"};
    const int form = random_below(to->random, (int)(sizeof forms / sizeof *forms) + 4);
    if (form >= (int)(sizeof forms / sizeof *forms) || depth <= 0) {
        const int which = random_below(to->random, 3);
        if (which == 0)
            put(to, "%.3f", random_between(to->random, -2, 2));
        else if (which == 1 && to->names)
            put(to, "r%d", random_below(to->random, to->names));
        else
            put(to, "%s",
                (const char *[]){"a.x", "a.y", "b.x", "b.z"}[random_below(to->random, 4)]);
        return;
    }
    for (const char *at = forms[form]; *at; at++) {
        if (*at == '#')
            put_number(to, depth - 1);
        else if (*at == '@')
            put_vector(to, depth - 1);
        else
            put(to, "%c", *at);
    }
}

static void put_shader(Text *to, bool narrow)
{
    const int lines = 1 + random_below(to->random, 4);
    put(to, "precision %s float;\nuniform vec3 a, b;\n", narrow ? "mediump" : "highp");
    put(to, "float power(float base, float exponent) {\n    return base > 0.0 ? pow(base, exponent)"
            " : 0.0;\n}\nvec3 mirrored(vec3 l, vec3 v) {\n"
            "    vec3 n = v * inversesqrt(max(dot(v, v), .01));\n"
            "    return 2. * dot(n, l) * n - l;\n}\nvoid main() {\n");
    for (int i = 0; i < lines; i++) {
        const int kind = random_below(to->random, 4);
        put(to, "    float r%d = ", i);
        put_number(to, 3);
        put(to, ";\n");
        to->names = i + 1;
        if (kind == 0) {
            put(to, "    if (r%d > ", i);
            put_number(to, 1);
            put(to, ") r%d = ", i);
            put_number(to, 2);
            put(to, "; else r%d *= .5;\n", i);
        } else if (kind == 1) {
            put(to, "    for (int i = 0; i < 3; i++) { if (r%d > 2.) break; r%d += ", i, i);
            put_number(to, 1);
            put(to, "; }\n");
        }
    }
    put(to, "    gl_FragColor = vec4(r%d);\n}\n", lines - 1);
}

/* Every operation correctly rounded, but for the inverse square root, whose root is, too. */
static GlslErrors rounded_errors(void)
{
    GlslErrors errors = {.numbers = GLSL_LLVMPIPE};
    errors.numbers.mesa = false;
    for (int i = 0; i <= GLSL_HIGHP; i++) {
        for (int k = 0; k < GLSL_UNITS; k++)
            errors.units[i][k] = k == GLSL_UNITS_INVERSE_SQRT ? 1.6 : .5;
        for (int k = 0; k < 16; k++)
            errors.pow[i][k] = ldexp(.5, 1 - errors.numbers.of[i].bits);
    }
    return errors;
}

typedef struct Shader {
    GlslTree *tree;
    GlslCode *code;
    GlslRun *run;
    GlslBoundRun *bounds;
    GlslVariable inputs[2], color;
} Shader;

static Shader shader_open(const char *text, const GlslErrors *errors)
{
    Shader shader = {.tree = glsl_parse(text, GLSL_FRAGMENT, NULL)};
    if (shader.tree->message_count)
        fail_msg("%s in %s", shader.tree->messages[0].text, text);
    shader.code = glsl_compile(shader.tree);
    shader.run = glsl_run_open(shader.code);
    shader.bounds = glsl_bound_open(shader.code, errors);
    glsl_find(shader.code, "a", &shader.inputs[0]);
    glsl_find(shader.code, "b", &shader.inputs[1]);
    assert_true(glsl_find(shader.code, "gl_FragColor", &shader.color));
    return shader;
}

static void shader_close(Shader *shader)
{
    glsl_run_close(shader->run);
    glsl_bound_close(shader->bounds);
    glsl_code_free(shader->code);
    glsl_tree_free(shader->tree);
}

static void choose_inputs(Shader *shader, Random *random)
{
    const double radius = random_below(random, 3) ? 0 : random_between(random, 0, .2);
    for (int k = 0; k < GLSL_WAYS; k++)
        shader->bounds->radius[k] = k < 2 || random_below(random, 2) ? radius : 0;
    for (int i = 0; i < 6; i++) {
        GlslInput *input = &shader->bounds->inputs[shader->inputs[i / 3].first + i % 3];
        *input = (GlslInput){.middle = random_between(random, -1.5, 1.5),
                             .error = ldexp(1, -random_below(random, 18) - 5)};
        for (int k = 0; k < GLSL_WAYS; k++) {
            const double slope = random_between(random, -1, 1);
            input->slope[k] = (GlslRange){slope, slope};
        }
        if (random_below(random, 4) == 0)
            input->middle = rint(input->middle); /* conditions that just hold */
    }
}

/* gl_FragColor at a place of the piece: exactly, and the driver's. */
static double run_at(Shader *shader, Random *random, const double place[GLSL_WAYS],
                     const GlslErrors *errors, double *driver)
{
    double results[2], exact[6];
    for (int way = 0; way < 2; way++) {
        for (int i = 0; i < 6; i++) {
            const int at = shader->inputs[i / 3].first + i % 3;
            const GlslInput *input = &shader->bounds->inputs[at];
            exact[i] = input->middle;
            for (int k = 0; k < GLSL_WAYS; k++)
                exact[i] += place[k] * input->slope[k].low;
            const double off = input->error - fabs(exact[i]) * 0x1p-23;
            shader->run->registers[at] =
                way == 0 ? exact[i] : (double)(float)(exact[i] + random_between(random, -off, off));
        }
        shader->run->arithmetic = way ? &errors->numbers : &GLSL_EXACT;
        glsl_run(shader->run);
        results[way] = shader->run->registers[shader->color.first];
    }
    *driver = results[1];
    return results[0];
}

static double check_shader(Random *random, bool narrow, const GlslErrors *errors)
{
    char text[TEXT];
    Text to = {.text = text, .random = random};
    double most = 0;
    put_shader(&to, narrow);
    Shader shader = shader_open(text, errors);
    choose_inputs(&shader, random);
    const bool ran = glsl_bound_run(shader.bounds);
    const GlslBound bound = glsl_bound(shader.bounds, shader.color.first);
    for (int i = 0; i < 40 && ran && isfinite(bound.error); i++) {
        double place[GLSL_WAYS], driver;
        for (int k = 0; k < GLSL_WAYS; k++)
            place[k] = shader.bounds->radius[k] * random_between(random, -1, 1);
        const double exact = run_at(&shader, random, place, errors, &driver);
        if (isnan(exact) || isnan(driver))
            fail_msg("not a number, in\n%s", text);
        if (!(exact >= bound.exact.low && exact <= bound.exact.high) ||
            !(fabs(driver - exact) <= bound.error))
            fail_msg("%.17g is not in %.17g to %.17g, or %.9g farther from it than %g, in\n%s",
                     exact, bound.exact.low, bound.exact.high, driver, bound.error, text);
        most = fmax(most, fabs(driver - exact));
    }
    shader_close(&shader);
    return ran && isfinite(bound.error) ? bound.error / fmax(most, 1e-30) : (double)INFINITY;
}

TEST(results_are_within_their_bounds)
{
    const GlslErrors errors = rounded_errors();
    Random random = {testing_seed(28)};
    const int count = testing_part(40000, 10);
    double *ratios = calloc((size_t)count, sizeof *ratios);
    int bounded = 0;
    for (int i = 0; i < count; i++) {
        ratios[i] = check_shader(&random, i % 2, &errors);
        bounded += isfinite(ratios[i]);
    }
    qsort(ratios, (size_t)count, sizeof *ratios, clock_compare);
    print_message("%d shaders, %d bounded; of these half within %.2f of the error found\n", count,
                  bounded, ratios[bounded / 2]);
    assert_true(bounded > count * 9 / 10);
    free(ratios);
}

/* gl_FragColor.r of statements at a = (x, 0, 0), with an error of 1e-3. */
static GlslBound bound_of(const char *statements, double x, const double pixel[2][2], int *stopped,
                          bool *edges)
{
    const GlslErrors errors = rounded_errors();
    Shader shader = shader_open(
        formatted("precision highp float; uniform vec3 a;\nvoid main() {\n%s\n}", statements),
        &errors);
    GlslInput *input = &shader.bounds->inputs[shader.inputs[0].first];
    *input = (GlslInput){.middle = x, .error = 1e-3, .slope = {{1, 1}, {0, 0}}};
    memcpy(shader.bounds->pixel, pixel, sizeof shader.bounds->pixel);
    const bool ran = glsl_bound_run(shader.bounds);
    const GlslBound bound = glsl_bound(shader.bounds, shader.color.first);
    *stopped = ran ? 0 : shader.tree->nodes[shader.bounds->node].place.line;
    *edges = shader.bounds->edges;
    shader_close(&shader);
    return bound;
}

TEST(errors_depend_on_each_other)
{
    static const double none[2][2] = {{0, 0}, {0, 0}}, pixel[2][2] = {{.1, 0}, {0, .1}};
    int line;
    bool edges;
    assert_true(bound_of("gl_FragColor = vec4(a.x - a.x);", .7, none, &line, &edges).error < 1e-5);
    /* 1e-3 relative to .7, squared, and a few times that: what is not known of the slope. */
    const char *const unit = "gl_FragColor = vec4(length(normalize(a)));";
    const GlslBound length = bound_of(unit, .7, none, &line, &edges);
    if (!(length.error < 3e-5))
        fail_msg("%g", length.error);
    /* Near to a condition's change the driver may be on its other side, or an edge runs there. */
    const char *const step = "gl_FragColor = vec4(a.x > .7 ? .5 : .25);";
    assert_true(bound_of(step, .7005, none, &line, &edges).error == .25 && !edges);
    assert_true(bound_of(step, .7005, pixel, &line, &edges).error == 0 && edges);
    assert_true(bound_of(step, .702, none, &line, &edges).error == 0 && !edges);
    /* There it has 0 + .7005 instead of -.6995 + .6995. */
    const char *const other = "gl_FragColor = vec4((a.x > .7 ? 0. : -a.x) + a.x);";
    assert_true(bound_of(other, .6995, none, &line, &edges).error >= .7004);
    /* What has no bound, and the line. */
    bound_of("gl_FragColor = vec4(1.);\nif (a.x > .7) discard;", .7, none, &line, &edges);
    assert_int_equal(line, 4);
    bound_of("float s = 0.;\nwhile (a.x > s * 0.)\ns += 1.;", .7, none, &line, &edges);
    assert_true(line >= 3);
    const GlslBound root = bound_of("float s = a.x;\ns = inversesqrt(s);\n"
                                    "gl_FragColor = vec4(s);",
                                    .0005, none, &line, &edges);
    assert_true(line == 0 && isinf(root.error));
    const char *const no_number = "gl_FragColor = vec4(1. / (.3 + abs(cos(inversesqrt(a.x)))));";
    assert_true(isinf(bound_of(no_number, .0005, none, &line, &edges).error));
}

/* Of vectors whose numbers are known to a half, and lengths by how they are computed. */
TEST(a_dot_product_is_at_most_the_lengths)
{
    static const struct {
        const char *dot;
        double most;
    } CASES[] = {{"dot(n, l)", 1},
                 {"dot(-n, 3. * l)", 3},
                 {"dot(reflect(l, n), n)", 1},
                 {"dot(2. * dot(l, n) * n - l, n)", 1}};
    const GlslErrors errors = rounded_errors();
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        char text[TEXT];
        snprintf(text, sizeof text,
                 "precision highp float; uniform vec3 a, b;\nvoid main() {\n"
                 "vec3 n = normalize(a), l = b * inversesqrt(max(dot(b, b), 1e-9));\n"
                 "gl_FragColor = vec4(%s);\n}",
                 CASES[i].dot);
        Shader shader = shader_open(text, &errors);
        shader.bounds->radius[0] = .5;
        for (int k = 0; k < 3; k++)
            for (int v = 0; v < 2; v++)
                shader.bounds->inputs[shader.inputs[v].first + k] =
                    (GlslInput){.middle = 1, .slope = {{1, 1}, {0, 0}}};
        assert_true(glsl_bound_run(shader.bounds));
        const GlslBound bound = glsl_bound(shader.bounds, shader.color.first);
        if (!(bound.exact.high <= CASES[i].most + 1e-9 && bound.exact.low >= -CASES[i].most - 1e-9))
            fail_msg("%s: %g to %g", CASES[i].dot, bound.exact.low, bound.exact.high);
        shader_close(&shader);
    }
}

TEST_MAIN("glsl_bound", NULL, NULL)
