/*
 * glsl_run with the driver's arithmetic against the driver: how many results of each operation and
 * function are the same float, and how far the others are. On llvmpipe all but those of
 * trigonometric functions have to be the same in highp.
 */
#include "glsl/glsl_run.h"
#include "study/arithmetic/arithmetic.h"
#include "support/testing.h"

enum { COUNT = 4096 };
static Meter meter;

FIXTURE(open)
{
    SUCCEEDS(meter_open(&meter, NULL, message));
}

FIXTURE(close)
{
    meter_close(&meter);
}

static const struct {
    const char *code;
    bool near; /* not the same bits */
} CASES[] = {
    {"a + b", false},
    {"a - b", false},
    {"a * b", false},
    {"a / b", false},
    {"-a * b + 0.1 * b.yzwx", false},
    {"sqrt(abs(a))", false},
    {"inversesqrt(abs(a))", false},
    {"vec4(dot(a.xy, b.xy), dot(a.xyz, b.xyz), dot(a, b), 1.0)", false},
    {"vec4(length(a.xy), length(a.xyz), distance(a, b), 1.0)", false},
    {"vec4(normalize(a.xyz), 1.0)", false},
    {"normalize(a)", false},
    {"vec4(cross(a.xyz, b.xyz), 1.0)", false},
    {"vec4(reflect(a.xyz, b.xyz), 1.0)", false},
    {"vec4(faceforward(a.xyz, b.xyz, a.yzw), 1.0)", false},
    {"vec4(refract(a.xyz, normalize(b.xyz), b.w), 1.0)", false},
    {"pow(abs(a), b)", false},
    {"exp2(a)", false},
    {"log2(abs(a))", false},
    {"exp(a)", false},
    {"log(abs(a))", false},
    {"abs(a) + sign(b)", false},
    {"floor(a) + ceil(b)", false},
    {"fract(a)", false},
    {"mod(a, b)", false},
    {"min(a, b) + max(a, b)", false},
    {"clamp(a, b, b + 1.0)", false},
    {"mix(a, b, a.x)", false},
    {"step(a, b)", false},
    {"smoothstep(-1.0, 1.5, a)", false},
    {"mat4(a, a.yxwz, a.zwxy, a.wzyx) * b", false},
    {"b * mat4(a, a.yxwz, a.zwxy, a.wzyx)", false},
    {"radians(a) + degrees(b)", false},
    {"sin(a)", true},
    {"cos(a)", true},
    {"tan(a)", true},
    {"asin(clamp(a, -1.0, 1.0))", true},
    {"acos(clamp(a, -1.0, 1.0))", true},
    {"atan(a)", true},
    {"atan(a, b)", true},
};

static GlslRun *run_open(const char *code)
{
    static const char *const TEXT = "precision highp float; uniform vec4 u_A, u_B;\n"
                                    "uniform float u_One;\n"
                                    "void main() { vec4 a = u_A, b = u_B; a *= u_One;\n"
                                    "b *= u_One; gl_FragColor = u_One * (%s); }";
    const char *text = formatted(TEXT, code);
    GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
    require(tree->message_count == 0, &(Message){.text = "not parsed"});
    GlslRun *run = glsl_run_open(glsl_compile(tree));
    run->arithmetic = &GLSL_LLVMPIPE;
    return run;
}

static void run_close(GlslRun *run)
{
    GlslCode *code = (GlslCode *)run->code;
    GlslTree *tree = (GlslTree *)code->tree;
    glsl_run_close(run);
    glsl_code_free(code);
    glsl_tree_free(tree);
}

static void run_one(GlslRun *run, const float a[4], const float b[4], double color[4])
{
    GlslVariable at[4];
    static const char *const NAMES[] = {"u_A", "u_B", "u_One", "gl_FragColor"};
    for (int i = 0; i < 4; i++)
        assert_true(glsl_find(run->code, NAMES[i], &at[i]));
    for (int i = 0; i < 4; i++) {
        run->registers[at[0].first + i] = (double)a[i];
        run->registers[at[1].first + i] = (double)b[i];
    }
    run->registers[at[2].first] = 1;
    assert_true(glsl_run(run));
    memcpy(color, run->registers + at[3].first, 4 * sizeof(double));
}

static bool check(const char *code, bool near, const float (*a)[4], const float (*b)[4])
{
    static float results[COUNT][4];
    const GLuint program = meter_program(code, METER_FRAGMENT, METER_HIGHP, FAILURE);
    require(program != 0, FAILURE);
    SUCCEEDS(meter_run(&meter, program, METER_FRAGMENT, results, COUNT, message));
    glDeleteProgram(program);
    GlslRun *run = run_open(code);
    int same = 0, worst = 0, worst_part = 0;
    double most = 0;
    for (int i = 0; i < COUNT; i++) {
        double color[4];
        run_one(run, a[i], b[i], color);
        for (int k = 0; k < 4; k++) {
            const double got = (double)results[i][k];
            const double error = fabs(color[k] - got) / fmax(1, fabs(got));
            const bool equal = color[k] == got || (isnan(color[k]) && isnan(got));
            same += equal;
            if (!equal && !(error <= most)) {
                most = error;
                worst = i;
                worst_part = k;
            }
        }
    }
    const bool right = near ? most < 1e-3 : same == 4 * COUNT;
    print_message("%-60s %8.4f%% the same, others within %.3g%s\n", code, same / 40.96 / 4, most,
                  right ? "" : "  WRONG");
    if (!right) {
        double color[4];
        run_one(run, a[worst], b[worst], color);
        print_message("  a %.9g %.9g b %.9g %.9g: %.9g is %.9g\n", (double)a[worst][0],
                      (double)a[worst][worst_part], (double)b[worst][0],
                      (double)b[worst][worst_part], color[worst_part],
                      (double)results[worst][worst_part]);
    }
    run_close(run);
    return right;
}

TEST(results_are_the_drivers)
{
    static float a[COUNT][4], b[COUNT][4];
    unsigned seed = 1;
    bool right = true;
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 8; k++) {
            seed = seed * 1664525U + 1013904223U;
            const float value = (float)((int)(seed >> 8) - (1 << 23)) / (float)(1 << 23);
            (k < 4 ? a : b)[i][k % 4] = i % 3 == 0 ? value : 9 * value * value * value;
        }
    meter_load(&meter, (const float(*)[4])a, (const float(*)[4])b, COUNT);
    if (!strstr(meter.canvas.renderer, "llvmpipe"))
        skip();
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++)
        right &= check(CASES[i].code, CASES[i].near, (const float(*)[4])a, (const float(*)[4])b);
    assert_true(right);
}

TEST_MAIN("glsl driver", open, close)
