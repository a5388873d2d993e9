/*
 * glsl_run: operators and functions against C's doubles, control flow, arrays, structures,
 * functions with `out`, what is undefined, loops without end, and the log of events.
 */
#include "glsl/glsl_run.h"
#include "support/testing.h"

#include <limits.h>

typedef struct Shader {
    GlslTree *tree;
    GlslCode *code;
    GlslRun *run;
} Shader;

static Shader shader_open(const char *text)
{
    Shader shader = {.tree = glsl_parse(text, GLSL_FRAGMENT, NULL)};
    if (shader.tree->message_count)
        fail_msg("%s in %s", shader.tree->messages[0].text, text);
    shader.code = glsl_compile(shader.tree);
    if (shader.code->message.text[0])
        fail_msg("%s", shader.code->message.text);
    shader.run = glsl_run_open(shader.code);
    return shader;
}

static void shader_close(Shader *shader)
{
    glsl_run_close(shader->run);
    glsl_code_free(shader->code);
    glsl_tree_free(shader->tree);
}

static double *registers(const Shader *shader, const char *name)
{
    GlslVariable found;
    if (!glsl_find(shader->code, name, &found))
        fail_msg("no %s", name);
    return shader->run->registers + found.first;
}

#define HEAD                                                                                       \
    "precision highp float; precision highp int;\n"                                                \
    "uniform float x, y, z; uniform int i; struct Light { vec3 p; float f[2]; };\n"                \
    "struct Pair { float a; vec2 b; }; uniform Light u_Light[3]; uniform sampler2D map[2];\n"      \
    "void twice(inout float v, out float w) { w = v; v *= 2.0; if (v > 1.0) return; v = 0.0; }\n"  \
    "float sum(int n) { float s = 0.0; for (int k = 0; k < 100; k++) {\n"                          \
    "    if (k >= n) return s; if (k == 2) continue; s += float(k); } return s; }\n"

/* gl_FragColor.r after statements, with x = .3, y = 1.7, z = -.6, i = 2. */
static Shader ran(const char *statements)
{
    Shader shader = shader_open(
        formatted(HEAD "void main() { float r = 0.0;\n%s\ngl_FragColor = vec4(r); }", statements));
    *registers(&shader, "x") = .3;
    *registers(&shader, "y") = 1.7;
    *registers(&shader, "z") = -.6;
    *registers(&shader, "i") = 2;
    *registers(&shader, "u_Light[2].p") = 5;
    registers(&shader, "u_Light[1].f")[1] = 7;
    registers(&shader, "map[1]")[0] = 4;
    glsl_run(shader.run);
    return shader;
}

static void gives(const char *statements, double expected)
{
    Shader shader = ran(statements);
    const double got = *registers(&shader, "gl_FragColor");
    if (!(fabs(got - expected) <= 1e-14 * fmax(1, fabs(expected))))
        fail_msg("%s gives %.17g, not %.17g", statements, got, expected);
    shader_close(&shader);
}

TEST(functions_are_c)
{
    const double x = .3, y = 1.7, z = -.6, l = sqrt(x * x + y * y + z * z);
    const struct {
        const char *text;
        double value;
    } CASES[] = {
        {"x + y * z - x / y", x + y * z - x / y},
        {"float(i / 3 + 7 / i)", 3},
        {"radians(x)", x * acos(-1) / 180},
        {"degrees(x)", x * 180 / acos(-1)},
        {"sin(x) + cos(y) + tan(z)", sin(x) + cos(y) + tan(z)},
        {"asin(x) + acos(z) + atan(y)", asin(x) + acos(z) + atan(y)},
        {"atan(y, z)", atan2(y, z)},
        {"pow(y, z)", pow(y, z)},
        {"exp(x) + log(y)", exp(x) + log(y)},
        {"exp2(z) + log2(x)", exp2(z) + log2(x)},
        {"sqrt(y)", sqrt(y)},
        {"inversesqrt(y)", 1 / sqrt(y)},
        {"abs(z) + sign(z)", .6 - 1},
        {"floor(z) + ceil(x) * 10.0 + fract(z)", -1 + 10 + .4},
        {"mod(z, x * 3.0)", .3},
        {"min(x, y) + max(x, z) + clamp(y, z, x)", .9},
        {"mix(x, y, z)", x + z * (y - x)},
        {"step(x, y) + step(y, x)", 1},
        {"smoothstep(z, y, x)", .9 / 2.3 * (.9 / 2.3) * (3 - 1.8 / 2.3)},
        {"length(vec3(x, y, z))", l},
        {"distance(vec2(x, y), vec2(z, x))", hypot(x - z, y - x)},
        {"dot(vec3(x, y, z), vec3(y, z, x))", x * y + y * z + z * x},
        {"cross(vec3(x, y, z), vec3(y, z, x)).y", z * y - x * x},
        {"normalize(vec3(x, y, z)).z", z / l},
        {"faceforward(vec2(x), vec2(y), vec2(x)).x", -x},
        {"reflect(vec2(x, y), vec2(z, x)).x", x - 2 * (x * z + y * x) * z},
        {"refract(vec2(0, -1), vec2(0, 1), y).y", -1},
        {"refract(vec2(1, 0), vec2(0, 1), y).x", 0},
        {"matrixCompMult(mat2(x), mat2(y))[1].y", x * y},
        {"(mat2(x, y, z, 1.0) * vec2(x, y)).y", y * x + y},
        {"(vec2(x, y) * mat2(x, y, z, 1.0)).y", x * z + y},
        {"(mat2(x, y, z, 1.0) * mat2(x))[0][1]", x * y},
        {"mat3(mat2(x))[2][2]", 1},
        {"all(lessThan(vec2(x, z), vec2(y))) ? 1.0 : 2.0", 1},
        {"any(not(equal(vec2(x), vec2(x)))) ? 1.0 : 2.0", 2},
        {"vec3(x) == vec3(x, x, y) ? 1.0 : 2.0", 2},
        {"float(x < y ^^ x > y) + float(int(z * 5.0))", -2},
        {"u_Light[i].p.x + u_Light[i - 1].f[i / 2]", 12},
        {"sum(6)", 13},
        {"texture2D(map[1], vec2(x)).a", 1},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof CASES[0]; k++) {
        char text[256];
        snprintf(text, sizeof text, "r = %s;", CASES[k].text);
        gives(text, CASES[k].value);
    }
}

TEST(statements_run)
{
    gives("float v = 3.0; twice(v, r); r += v;", 9);
    gives("vec3 v = vec3(1.0, 2.0, 3.0); v.xy = v.yx; v[i] = 8.0; r = v.x + v.z * 10.0;", 82);
    gives("vec3 v = vec3(1.0, 2.0, 3.0); v.zx[i - 1] = 8.0; v.yz[0] += 5.0; r = v.x + v.y * 10.0;",
          78);
    gives("vec2 a[3]; a[2] = vec2(1.0, 2.0); a[i].yx[i - 2] = 4.0; r = a[2].y * 10.0 + a[2].yx[1];",
          41);
    gives("float a[3]; for (int k = 0; k < 3; k++) a[k] = float(k); r = a[i] * 10.0 + a[1];", 21);
    gives("int k = 0; while (true) { if (k == 5) break; k++; } r = float(k--) + float(k);", 9);
    gives("int k = 0; do { k += 2; if (k == 4) continue; r += 1.0; } while (k < 7); r += float(k);",
          11);
    gives("bool b = false; if (b && (r = 5.0) > 0.0) r = 6.0; if (true || (r = 7.0) > 0.0) r++;",
          1);
    gives(
        "Pair l = Pair(x, vec2(y)); Pair k = l; k.b.x = 3.0; r = l.b.x + k.b.x + (k == l ? 1.0 : 0.0);",
        4.7);
    gives("mat2 m = mat2(0.0); m[1].x = x; m[i - 1] += vec2(1.0); r = m[1][0];", 1.3);
}

static void notes(const char *statements, int kind)
{
    Shader shader = ran(statements);
    bool found = kind == GLSL_NOTE_NONE && shader.run->note_count == 0;
    for (int k = 0; k < shader.run->note_count; k++)
        found |= shader.run->notes[k].kind == kind &&
                 shader.tree->nodes[shader.run->notes[k].node].place.line >= 2;
    if (!found)
        fail_msg("%s: not noted: %s", statements, glsl_note_text(kind));
    assert_true(shader.run->stopped == (kind == GLSL_NOTE_LOOP));
    shader_close(&shader);
}

TEST(undefined_is_noted)
{
    notes("r = x; float q; q = r; r = q;", GLSL_NOTE_NONE);
    notes("while (x < y) r += 1.0;", GLSL_NOTE_LOOP);
    notes("float q; r = q;", GLSL_NOTE_UNSET);
    notes("float a[2]; a[0] = x; r = a[i - 1];", GLSL_NOTE_UNSET);
    notes("r = (x - x) / (y - y);", GLSL_NOTE_ZERO);
    notes("r = normalize(vec3(x - x)).x;", GLSL_NOTE_ZERO);
    notes("r = pow(z, 2.0);", GLSL_NOTE_POW);
    notes("r = pow(x - x, y - y);", GLSL_NOTE_POW);
    notes("r = sqrt(z);", GLSL_NOTE_ROOT);
    notes("r = log(z);", GLSL_NOTE_LOG);
    notes("r = acos(y);", GLSL_NOTE_ARC);
    notes("r = smoothstep(x, x, y);", GLSL_NOTE_EDGES);
    notes("vec3 v = vec3(x); r = v[i + 1];", GLSL_NOTE_INDEX);
    notes("r = 1.0 / (x - x); r = r - r;", GLSL_NOTE_NAN);
}

/* The sum of 1 and 1e-9 is lost in a driver's arithmetic, unless it is exact from before it on. */
TEST(events_say_where_digits_are_lost)
{
    Shader shader = ran("float a = x + 1.0;\nfloat b = a - 1.0;\nr = b - x;");
    GlslRun *run = shader.run;
    run->trace = true;
    glsl_run(run);
    assert_int_equal(run->event_count, 5);
    assert_string_equal(shader.tree->symbols[run->events[1].symbol].name, "a");
    assert_true(run->values[glsl_last(run, "b")->value] == .3 + 1 - 1);
    double errors[4];
    run->arithmetic = &GLSL_LLVMPIPE;
    for (int from = 0; from < 4; from++) {
        *registers(&shader, "x") = (float).3;
        run->exact_from = from - 1;
        glsl_run(run);
        errors[from] = *registers(&shader, "gl_FragColor");
    }
    assert_true(fabs(errors[1]) < 1e-15 && fabs(errors[2]) > 1e-9);
    shader_close(&shader);
}

typedef struct Each {
    Shader *shader;
    double results[64];
    int count, same;
} Each;

static void note_each(GlslRun *run, int event, bool same, void *context)
{
    Each *each = context;
    (void)run;
    each->results[event] =
        same ? each->results[event - 1] : *registers(each->shader, "gl_FragColor");
    each->count++;
    each->same += same;
}

TEST(what_runs_before_each_event_runs_once)
{
    Shader shader = ran("mediump float a = x;\nfor (int k = 0; k < 5; k++) {\na = a * y + z;\n"
                        "if (a > 1.5) a -= 1.0;\nfloat c = 2.0;\nr += a * c / 3.0;\n}");
    GlslRun *run = shader.run;
    run->arithmetic = &GLSL_LLVMPIPE;
    run->trace = true;
    glsl_run(run);
    const int last = run->event_count - 1;
    for (int step = 1; step < 4; step++) {
        Each each = {.shader = &shader};
        glsl_run_each(run, 0, last, step, note_each, &each);
        assert_int_equal(each.count, 1 + (last + step - 1) / step);
        assert_true(step == 1 ? each.same > 5 : each.same == 0);
        for (int i = 0; i <= last; i = i < last && i + step > last ? last : i + step) {
            run->exact_from = i;
            glsl_run(run);
            assert_true(*registers(&shader, "gl_FragColor") == each.results[i]);
        }
        run->exact_from = INT_MAX;
    }
    shader_close(&shader);
}

TEST(a_devices_numbers_are_read_as_they_are_printed)
{
    static const char *const texts[] = {"highp=24,-126,127;mediump=11,-14,15,kept",
                                        "highp=24,-126,127,kept;mediump=9,-14,15,cut;bytes=12"};
    for (int i = 0; i < 2; i++) {
        GlslArithmetic read;
        char printed[128];
        assert_true(glsl_arithmetic_read(texts[i], &read));
        assert_int_equal(read.color_bits, i ? 12 : 0);
        glsl_arithmetic_print(&read, printed, sizeof printed);
        assert_string_equal(printed, texts[i]);
    }
    GlslArithmetic none;
    assert_false(glsl_arithmetic_read("highp=24,-126,127;mediump=11,-14,15;bytes=99", &none));
}

/* In 11 bits x is 1229/4096, whose root is 1121.83/2048; 1 / 19 is 1724.6/32768; x * x is 1475.04
 * of 1/16384, with 1026 of them 1250.52/8192: as much as 1250 if the product is rounded before. */
TEST(a_device_may_cut_roots_and_reciprocals_and_fuse_dot_products)
{
    static const char *const texts[] = {"highp=11,-14,15;mediump=11,-14,15",
                                        "highp=11,-14,15,cut;mediump=11,-14,15"};
    Shader root = ran("r = sqrt(x);"), quotient = ran("r = 2.0 / y;");
    Shader product = ran("r = dot(vec2(1.0, x), vec2(y, x));");
    *registers(&product, "y") = 1026 / 16384.0;
    for (int i = 0; i < 2; i++) {
        GlslArithmetic arithmetic;
        assert_true(glsl_arithmetic_read(texts[i], &arithmetic));
        root.run->arithmetic = quotient.run->arithmetic = product.run->arithmetic = &arithmetic;
        glsl_run(root.run);
        assert_true(*registers(&root, "gl_FragColor") == (1122 - i) / 2048.0);
        glsl_run(product.run);
        assert_true(*registers(&product, "gl_FragColor") == (1250 + i) / 8192.0);
        *registers(&quotient, "y") = 19;
        glsl_run(quotient.run);
        assert_true(*registers(&quotient, "gl_FragColor") == 2 * (1725 - i) / 32768.0);
    }
    shader_close(&root);
    shader_close(&quotient);
    shader_close(&product);
}

/* Results of float arithmetic in C, which is what the driver's highp is, to the last bit. */
TEST(single_is_c)
{
    Shader shader = ran("vec3 v = normalize(vec3(x, y, z)); r = v.x / 3.0 + sqrt(v.y) * x;");
    shader.run->arithmetic = &GLSL_LLVMPIPE;
    for (int k = 0; k < 1000; k++) {
        const float x = (float)k * .37F + .1F, y = (float)(k % 29) * .73F + .2F,
                    z = (float)(k % 17) * 1.3F;
        *registers(&shader, "x") = x;
        *registers(&shader, "y") = y;
        *registers(&shader, "z") = z;
        glsl_run(shader.run);
        const float xx = x * x, yy = y * y, zz = z * z, two = zz + yy, all = two + xx;
        const float length = sqrtf(all), scale = 1 / length, vx = x * scale, vy = y * scale;
        const float third = vx / 3, root = sqrtf(vy), product = root * x, sum = third + product;
        assert_true(*registers(&shader, "gl_FragColor") == sum);
    }
    shader_close(&shader);
}

/* Calls that double forty times end with one message. */
TEST(too_large_is_said)
{
    char text[4096] = "void f0() { }\n";
    for (int k = 1; k <= 40; k++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "void f%d() { f%d(); f%d(); }\n",
                 k, k - 1, k - 1);
    strcat(text, "void main() { f40(); }");
    GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
    GlslCode *code = glsl_compile(tree);
    assert_non_null(strstr(code->message.text, "too large"));
    glsl_code_free(code);
    glsl_tree_free(tree);
}

/* Structures that double forty times are compared, and refused, in no time. */
TEST(doubled_structures_end)
{
    static const char *const INNERMOST[] = {"struct A0 { sampler2D s; };\n",
                                            "struct A0 { lowp float s; };\n"};
    for (int i = 0; i < 2; i++) {
        char text[4096];
        snprintf(text, sizeof text, "%s", INNERMOST[i]);
        for (int k = 1; k <= 40; k++)
            snprintf(text + strlen(text), sizeof text - strlen(text), "struct A%d { A%d a, b; };\n",
                     k, k - 1);
        strcat(text, "uniform A40 u; void main() { }");
        GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
        GlslCode *code = glsl_compile(tree);
        assert_non_null(strstr(code->message.text, "too large"));
        assert_true(glsl_check_pair(tree, tree));
        glsl_code_free(code);
        glsl_tree_free(tree);
    }
}

/* Loops that do not end within a second are not run, and not counted, to their end. */
TEST(long_loops_end)
{
    Shader shader = ran("for (int i = 0; i < 90000; i++) { float a[900000]; a[3] = x; r = a[3]; }");
    assert_true(shader.run->stopped);
    shader_close(&shader);
    static const char LOOP[] = "for (int i = 0; i < 999999999; i++) ;\n";
    enum { LOOPS = 10000 };
    char *text = calloc(1, LOOPS * sizeof LOOP + 100);
    char *end = text + sprintf(text, "void main() {\n");
    for (int i = 0; i < LOOPS; i++)
        end = stpcpy(end, LOOP);
    strcpy(end, "}");
    GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
    const GlslWork work = glsl_count_work(tree);
    assert_true(work.turns == (double)LOOPS * GLSL_TURNS_MAX);
    assert_int_equal(work.place.line, 2);
    glsl_tree_free(tree);
    free(text);
}

TEST_MAIN("glsl run", NULL, NULL)
