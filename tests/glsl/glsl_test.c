/*
 * glsl: messages, constants, places, printing, what linking asks, and texts that are too much. What
 * is accepted is compared with other compilers in judges_test.py.
 */
#include "glsl/glsl.h"
#include "support/testing.h"

#define FRAGMENT "precision mediump float;\n"

static void says(const char *text, int line, const char *expected)
{
    GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
    if (tree->message_count == 0)
        fail_msg("accepted: %s", text);
    assert_string_equal(tree->messages[0].text, expected);
    assert_int_equal(tree->messages[0].place.line, line);
    glsl_tree_free(tree);
}

/* In the body of a function that knows some variables, from line 4 on. */
static void body_says(const char *statement, const char *expected)
{
    char text[1024];
    snprintf(
        text, sizeof text,
        FRAGMENT
        "uniform mat4 m; uniform sampler2D map; varying vec3 v_Normal; float own(vec3 p, float q);\n"
        "void main() { float x = 1.0; int i = 1; bool b = true; vec3 v = vec3(x); vec4 w;\n"
        "%s\n}",
        statement);
    says(text, 4, expected);
}

TEST(messages_know_types)
{
    body_says("max(x, 0);", "max(x, 0): x is a float, 0 an int: write 0.0");
    body_says("x = x * 2;", "x * 2: x is a float, 2 an int: write 2.0");
    body_says("x = i;", "x is a float, i an int: write float(i)");
    body_says("x = i + 1;", "x is a float, i + 1 an int: write float(i + 1)");
    body_says("v = w;", "v is a vec3, w a vec4: write .xyz of it");
    body_says("w = v;", "w is a vec4, v a vec3: write vec4(v, 1.0), or 0.0 for a direction");
    body_says("x = v;", "x is a float, v a vec3: write one component (.x), or dot or length");
    body_says("v = x;", "v is a vec3, x a float: write vec3(x)");
    body_says("v = v * m;",
              "v * m: v is a vec3, m a mat4: write vec4(v, 1.0), or 0.0 for a direction");
    body_says("v = v + w;",
              "v + w: v is a vec3, w a vec4: use .xyz of the longer one, or vec4(..., 1.0)");
    body_says("if (x) x = 1.0;", "a condition must be a bool; x is a float: compare it");
    body_says("v_Normal = v;",
              "v_Normal is read-only here: copy the value to a variable of your own");
    body_says("x = own(v, 1);", "own(v, 1): v is a vec3, 1 an int: write 1.0");
    body_says("v = normalise(v);", "there is no function normalise: did you mean normalize?");
    body_says("v = v_normal;", "v_normal is not declared: did you mean v_Normal?");
    body_says("x = saturate(x);", "GLSL ES 1.00 has no saturate here: write clamp(x, 0.0, 1.0)");
    body_says("w = vec4(v);",
              "vec4(v): a vec4 needs 4 numbers, not 3: add one, as in vec4(..., 1.0)");
    body_says("x = x.y;", "x is a float, which has no component .y: only vectors have components");
    body_says("v.xx = w.xy;", "v.xx: each component can be set only once");
    body_says("x = v[3];", "v[3]: the elements are 0 to 2");
    body_says("x = 1.0f;", "1.0f is no number of GLSL ES 1.00: it has no suffixes such as f");
    body_says("i = i % 2;",
              "GLSL ES 1.00 has no operator %: write mod(x, y), or a - a / b * b for ints");
    body_says(
        "x = max(x);",
        "max(x): x is a float; there is max(float or vec, the same), max(float or vec, float)");
    body_says("x = own(v);", "own(v): v is a vec3; there is own(vec3, float)");
    body_says("x = dot(v, w);",
              "dot(v, w): v is a vec3, w a vec4; there is dot(float or vec, the same)");
    body_says(
        "w = texture2D(v, w.xy);",
        "texture2D(v, w.xy): v is a vec3, w.xy a vec2; there is texture2D(sampler2D, vec2), texture2D(sampler2D, vec2, float)");
    body_says(
        "x = max();",
        "max(): there are no arguments; there is max(float or vec, the same), max(float or vec, float)");
    body_says("float3 n = v;", "GLSL ES 1.00 has no float3: write vec3");
    body_says("vce3 n = v;", "vce3 is no type: did you mean vec3?");
    body_says("double d = x;", "double has no meaning here in GLSL ES 1.00; write float");
    body_says("w = texture(map, v.xy);",
              "GLSL ES 1.00 has no texture here: write texture2D(sampler, point)");
    body_says("const float c = x;", "c is const: its value must be a constant expression");
}

TEST(messages_name_the_line)
{
    says("float f;", 1,
         "floats have no default precision here: add `precision highp float;` at the top");
    says(FRAGMENT "in vec3 v;", 2, "in has no meaning here in GLSL ES 1.00; write varying");
    says(FRAGMENT "out vec4 color;", 2,
         "out has no meaning here in GLSL ES 1.00; set gl_FragColor");
    says(FRAGMENT "unifrom vec3 v;", 2, "unifrom is no type: did you mean uniform?");
    says(FRAGMENT "layout(location = 0) varying vec3 v;", 2,
         "GLSL ES 1.00 has no layout: remove it and its parentheses");
    says(FRAGMENT "void main() {\n  float x = 1.0\n  x = 2.0;\n}", 4,
         "a semicolon is missing, probably at the end of line 3");
    says(FRAGMENT "void main {\n}", 2, "() is missing after a function's name: void main() {");
    says(
        FRAGMENT "#line 40 2\nint a = b;", 40,
        "b is not declared: check its spelling and case; declare a varying or uniform in each shader that uses it");
    says(FRAGMENT "#if LIGHTS > 1\n#endif", 2,
         "#if: a name here must be a macro: ask #ifdef, or defined(NAME) &&, first");
    says(FRAGMENT "#define M(a) \\\n a", 2,
         "GLSL ES 1.00 cannot continue a line by \\: write it as one line");
    says(FRAGMENT "float f() {\n#define\n", 3, "a name must follow");
    says("/*\n*/ #error no light\n", 2, "#error no light");
}

/* The value of a constant expression. */
static double value_of(const char *expression)
{
    char text[512];
    snprintf(
        text, sizeof text,
        FRAGMENT
        "struct S { float a; vec3 b; };\nconst vec3 v = vec3(1.0, 2.0, 3.0);\nconst float result = float(%s);",
        expression);
    GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
    if (tree->message_count)
        fail_msg("%s: %s", expression, tree->messages[0].text);
    const double value = tree->values[tree->symbols[tree->symbol_count - 1].value];
    glsl_tree_free(tree);
    return value;
}

TEST(constant_expressions_have_their_values)
{
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"1 + 2 * 3 - 8 / 3", 5},
        {"7 - 2 - 1", 4},
        {"-(-2.5)", 2.5},
        {"0x7fffffff + 1", -2147483648.0},
        {"010", 8},
        {"int(-2.7)", -2},
        {"true ? 0.25 : 1.0", 0.25},
        {"bool(3) && !(2.0 < 1.0)", 1},
        {"v.zyx[0] + v.b", 6},
        {"(v * 2.0).y", 4},
        {"dot(v, vec3(1.0, -1.0, 2.0))", 5},
        {"cross(v, vec3(0.0, 0.0, 1.0)).y", -1},
        {"length(vec2(3.0, 4.0))", 5},
        {"distance(vec2(1.0), vec2(4.0, 5.0))", 5},
        {"normalize(vec2(3.0, 4.0)).y", 0.8},
        {"reflect(vec2(1.0, -1.0), vec2(0.0, 1.0)).y", 1},
        {"refract(vec2(0.0, -1.0), vec2(0.0, 1.0), 0.5).y", -1},
        {"faceforward(vec2(1.0, 2.0), vec2(1.0), vec2(1.0)).x", -1},
        {"mod(-1.0, 3.0)", 2},
        {"fract(-0.25)", 0.75},
        {"clamp(5.0, 0.0, 1.0)", 1},
        {"mix(vec2(0.0, 2.0), vec2(1.0, 4.0), 0.5).y", 3},
        {"step(1.0, v).x", 1},
        {"smoothstep(0.0, 2.0, 1.0)", 0.5},
        {"pow(2.0, 10.0)", 1024},
        {"atan(1.0, -1.0) / atan(1.0)", 3},
        {"any(lessThan(v, vec3(2.0))) && !all(lessThan(v, vec3(2.0)))", 1},
        {"mat2(1.0, 2.0, 3.0, 4.0)[1][0]", 3},
        {"(mat2(1.0, 2.0, 3.0, 4.0) * vec2(1.0, 0.0)).y", 2},
        {"(vec2(1.0, 0.0) * mat2(1.0, 2.0, 3.0, 4.0)).y", 3},
        {"(mat2(1.0, 2.0, 3.0, 4.0) * mat2(0.0, 1.0, 1.0, 0.0))[0].x", 3},
        {"mat3(mat2(5.0))[2][2] + mat3(mat2(5.0))[1][1]", 6},
        {"mat3(2.0)[0][1]", 0},
        {"S(1.0, v).b.z", 3},
        {"S(1.0, v) == S(1.0, v)", 1},
        {"v != vec3(1.0)", 1},
        {"vec4(vec2(7.0), ivec2(8)).w", 8},
        {"gl_MaxDrawBuffers", 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double value = value_of(cases[i].text);
        if (!(fabs(value - cases[i].value) <= 1e-14 * fabs(cases[i].value))) /* a few roundings */
            fail_msg("%s: %.17g, not %.17g", cases[i].text, value, cases[i].value);
    }
}

/* Prints a text, and what the print parses to. */
static void prints(const char *text, const char *expected)
{
    GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
    char *printed = glsl_print(tree, tree->root);
    assert_int_equal(tree->message_count, 0);
    assert_string_equal(printed, expected);
    free(printed);
    glsl_tree_free(tree);
}

TEST(a_tree_prints_as_a_text)
{
    prints(
        "precision highp float;\n"
        "#define TWICE(x) ((x) + (x))\n"
        "struct Light { vec3 p[2]; lowp float k; } a, b[3];\n"
        "invariant varying vec4 v;\n"
        "float f(const in vec3 p, out float q) { q = TWICE(p.x) * (1.0 - -q); return q++; }\n"
        "void main() { for (int i = 0; i < 2; ++i) { if (i == 1) continue; else discard; } }\n",
        "#version 100\n"
        "precision highp float;\n"
        "struct Light {\n    vec3 p[2];\n    lowp float k;\n} a, b[3];\n"
        "invariant varying vec4 v;\n"
        "float f(const vec3 p, out float q)\n"
        "{\n    q = (p.x + p.x) * (1.0 - -q);\n    return q++;\n}\n"
        "void main()\n"
        "{\n    for (int i = 0; i < 2; ++i) {\n        if (i == 1) continue; else discard;\n    }\n}\n");
}

TEST(nodes_have_their_places)
{
    GlslTree *tree = glsl_parse("#line 7 3\nint a = 1 +\n  (2 - 3);\n", GLSL_VERTEX, NULL);
    const int variable = glsl_child(tree, glsl_child(tree, tree->root, 0), 0);
    const int sum = glsl_child(tree, variable, 0), right = glsl_child(tree, sum, 1);
    assert_int_equal(tree->nodes[sum].place.file, 3);
    assert_int_equal(tree->nodes[sum].place.line, 7);
    assert_int_equal(tree->nodes[sum].place.column, 9);
    assert_int_equal(tree->nodes[right].place.line, 8);
    assert_int_equal(tree->nodes[right].place.column, 4);
    glsl_tree_free(tree);
}

static void whole_says(bool loops, const char *text, const char *expected)
{
    GlslTree *tree = glsl_parse(text, GLSL_FRAGMENT, NULL);
    assert_int_equal(tree->message_count, 0);
    assert_int_equal(loops ? glsl_check_loops(tree) : glsl_check_whole(tree), !expected);
    if (expected)
        assert_string_equal(tree->messages[0].text, expected);
    glsl_tree_free(tree);
}

TEST(what_linking_and_appendix_a_ask_is_asked_apart)
{
    whole_says(false, "void f() {} void main() { f(); }", NULL);
    whole_says(false, "void f() {}", "a function `void main()` is missing");
    whole_says(false, "void f(); void main() { f(); }", "f has no body: { ... } is missing");
    whole_says(false, "void f(); void g() { f(); } void f() { g(); } void main() {}",
               "f calls itself: a GLSL function must not: use a loop");
    whole_says(false, "void main() { gl_FragColor = vec4(0.0); gl_FragData[0] = vec4(0.0); }",
               "set gl_FragColor or gl_FragData, not both");
    whole_says(true, "void main() { for (int i = 0; i < 3; i += 2) {} }", NULL);
    whole_says(
        true, "void main() { int n = 3; for (int i = 0; i < n; i++) {} }",
        "write loops like for (int i = 0; i < 2; i++), with constant bounds (GLSL ES 1.00, appendix A)");
    whole_says(true, "void main() { for (int i = 0; i < 3; i++) { i = 2; } }",
               "i counts a loop: only its head may change it (GLSL ES 1.00, appendix A)");
    whole_says(true, "void main() { int a[2]; for (int i = 0; i < 2; i++) a[1 - i] = i; }", NULL);
    whole_says(true, "void main() { int a[2], k = 0; a[k] = 1; }",
               "an index here must be constant or count a loop (GLSL ES 1.00, appendix A)");
}

/* `before`, `count` times `part`, and `after`: one message at most, and at once: what is not
 * stopped by a count takes longer than this test may, and grows beyond memory. */
static void endures(const char *before, const char *part, int count, const char *after, bool good)
{
    const size_t size = strlen(before) + strlen(part) * (size_t)count + strlen(after) + 1;
    char *text = malloc(size), *end = text + sprintf(text, "%s", before);
    for (int i = 0; i < count; i++, end += strlen(part))
        memcpy(end, part, strlen(part));
    strcpy(end, after);
    GlslTree *tree = glsl_parse(text, GLSL_VERTEX, NULL);
    if (tree->message_count != !good)
        fail_msg("%s %s...: %d messages: %s", before, part, tree->message_count,
                 tree->messages[0].text);
    glsl_tree_free(tree);
    free(text);
}

TEST(texts_that_are_too_much_are_one_message_at_once)
{
    endures("int a = 1;", " ", 10000000, "", true);
    endures("/*", "x\n", 5000000, "*/ int a;", true);
    endures("", "int;\n", 1500000, "", false);
    endures("int ", "abcdefghij", 1000000, ";", true);
    endures("int a = ", "(", 10000, "", false);
    endures("int a = ", "-", 10000, "1;", false);
    endures("int a = 1", " + 1", 100000, ";", false);
    endures("int a = 1", " ? 1 : 1", 10000, ";", false);
    endures("void main() ", "{", 10000, "", false);
    endures("void main() { ", "if (true) ; else ", 10000, ";}", false);
    endures("void main() { int a; ", "a = ", 10000, "1;}", false);
    endures("", "#if 1\n", 10000, "", false);
    endures("#if ", "(", 10000, "1\n#endif\n", false);
    endures("#if ", "!", 10000, "1\n#endif\n", false);
    endures("#define f(x) x\nint a = ", "f(", 10000, "1", false);
    endures("#define a(x) x x\nint b = ", "a(", 40, "1", false);
    endures("struct S { float a", "[2]", 10000, "; };", false);
    endures("", "\xff", 100000, "", false);
}

TEST(macros_that_grow_are_one_message_at_once)
{
    char doubling[4096] = "#define M0 1 +\n", empty[4096] = "#define M0\n";
    for (int i = 1; i < 64; i++) {
        sprintf(doubling + strlen(doubling), "#define M%d M%d M%d\n", i, i - 1, i - 1);
        sprintf(empty + strlen(empty), "#define M%d M%d M%d\n", i, i - 1, i - 1);
    }
    endures(doubling, "int a = M63", 1, "1;", false);
    endures(empty, "int a = M63", 1, "1;", false);
    endures(empty, "\n#if M63 1\n#endif", 1, "\nint a;", false);
}

TEST(ten_messages_are_the_most)
{
    GlslTree *tree = glsl_parse(
        "int a = b, c = d, e = f, g = h, i = j, k = l, m = n, o = p, q = r, s = t, u = v;",
        GLSL_VERTEX, NULL);
    assert_int_equal(tree->message_count, GLSL_MESSAGES);
    glsl_tree_free(tree);
}

TEST_MAIN("glsl", NULL, NULL)
