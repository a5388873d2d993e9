/*
 * The operations of shaders: compared with counts made by hand for small shaders, with those of the
 * same written otherwise, and for the programs of random scenes. No GL.
 */
#include "hard/random_scene.h"
#include "scene/shader_cost.h"
#include "support/testing.h"

/* A shader's main function, and its cost. */
typedef struct Known {
    ShaderStage stage;
    const char *main;
    ShaderCost cost;
} Known;

static const char *const DECLARATIONS[] = {
    [SHADER_VERTEX] = "#version 100\n"
                      "#line 1 0\n"
                      "attribute vec4 a_Position;\n"
                      "uniform mat4 u_Matrix, u_Other;\n"
                      "uniform vec3 u_A, u_B, u_Array[8];\n"
                      "uniform float u_X;\n"
                      "varying vec3 v_Color;\n"
                      "vec3 twice(vec3 v) { return v + v; }\n"
                      "void main() { gl_Position = a_Position; ",
    [SHADER_FRAGMENT] = "#version 100\n"
                        "precision mediump float;\n"
                        "uniform vec3 u_A, u_B, u_Array[8];\n"
                        "uniform float u_X, u_Y;\n"
                        "uniform int u_I;\n"
                        "uniform sampler2D u_Map;\n"
                        "varying vec3 v_Color;\n"
                        "void main() { ",
};

static void count(ShaderStage stage, const char *body, ShaderCost *operations)
{
    Message message = {0};
    const char *text = formatted("%s%s }\n", DECLARATIONS[stage], body);
    if (!shader_cost(text, stage, operations, &message))
        fail_msg("%s\n%s", message.text, text);
}

static void assert_costs(const Known *known, size_t number)
{
    for (size_t i = 0; i < number; i++) {
        ShaderCost got;
        count(known[i].stage, known[i].main, &got);
        if (memcmp(&got, &known[i].cost, sizeof got) != 0)
            fail_msg("%s\n%d arithmetic, %d special; must be %d, %d", known[i].main, got.arithmetic,
                     got.special, known[i].cost.arithmetic, known[i].cost.special);
    }
}

#define ASSERT_COSTS(known) assert_costs(known, sizeof known / sizeof known[0])

#define VERTEX(text, ...)                                                                          \
    {                                                                                              \
        SHADER_VERTEX, text,                                                                       \
        {                                                                                          \
            __VA_ARGS__                                                                            \
        }                                                                                          \
    }
#define COLOR(text, ...)                                                                           \
    {                                                                                              \
        SHADER_FRAGMENT, "gl_FragColor = vec4(" text ");",                                         \
        {                                                                                          \
            __VA_ARGS__                                                                            \
        }                                                                                          \
    }

TEST(operations_are_those_on_single_numbers)
{
    static const Known known[] = {
        VERTEX("v_Color = u_A;", 0, 0),
        VERTEX("v_Color = u_A + u_B;", 3, 0),
        VERTEX("v_Color = u_A * u_X;", 3, 0),
        VERTEX("v_Color.x = u_A.x - u_B.y;", 1, 0),
        VERTEX("v_Color = vec3(dot(u_A, u_B));", 5, 0),
        VERTEX("v_Color = (u_Matrix * a_Position).xyz;", 28, 0),
        VERTEX("v_Color = (u_Matrix * vec4(u_A, 1.0)).xyz;", 28, 0),
        VERTEX("gl_Position = a_Position * u_Matrix;", 28, 0),
        VERTEX("gl_Position = (u_Matrix * u_Other)[0];", 112, 0),
        VERTEX("gl_Position = (u_Matrix * u_X)[0];", 16, 0),
        VERTEX("gl_Position = matrixCompMult(u_Matrix, u_Other)[0];", 16, 0),
        VERTEX("v_Color = u_A / u_B;", 0, 3),
        VERTEX("v_Color = u_A / 3.0;", 3, 0),
        VERTEX("v_Color = -u_A;", 3, 0),
        VERTEX("v_Color.x = float(u_A == u_B);", 5 + 1, 0),
        VERTEX("v_Color.x = float(u_A != u_B);", 5 + 1, 0),
        VERTEX("v_Color.x = float(int(u_X));", 2, 0),
        VERTEX("vec3 c = u_A; c += u_B; c++; v_Color = c;", 6, 0),
        COLOR("v_Color, 1.0", 0, 0),
        COLOR("gl_FrontFacing ? u_A : u_B, 1.0", 3, 0),
        COLOR("(gl_FrontFacing ? u_A : u_B).x", 1, 0),
        COLOR("u_Array[u_I], 1.0", 0, 0),
        COLOR("u_Array[u_I + 1], 1.0", 1, 0),
    };
    ASSERT_COSTS(known);
}

TEST(functions_of_the_language_have_their_prices)
{
    static const Known known[] = {
        COLOR("radians(u_X)", 1, 0),
        COLOR("degrees(u_X)", 1, 0),
        COLOR("sin(u_X) + cos(u_Y)", 1, 2),
        COLOR("tan(u_X)", 0, 1),
        COLOR("asin(u_X) + acos(u_X)", 1, 2),
        COLOR("atan(u_X) + atan(u_X, u_Y)", 1, 2),
        COLOR("pow(u_X, u_Y)", 0, 1),
        COLOR("pow(u_A, u_B), 1.0", 0, 3),
        COLOR("exp(u_X) + log(u_Y)", 1, 2),
        COLOR("exp2(u_X) + log2(u_Y)", 1, 2),
        COLOR("sqrt(u_X) + inversesqrt(u_Y)", 1, 2),
        COLOR("abs(u_A) + sign(u_B), 1.0", 9, 0),
        COLOR("floor(u_A) + ceil(u_B), 1.0", 9, 0),
        COLOR("fract(u_A), 1.0", 6, 0),
        COLOR("mod(u_A, u_X), 1.0", 0, 3),
        COLOR("max(u_A, 0.0), 1.0", 3, 0),
        COLOR("min(u_A, u_B), 1.0", 3, 0),
        COLOR("clamp(u_A, 0.0, 1.0), 1.0", 6, 0),
        COLOR("mix(u_A, u_B, u_X), 1.0", 9, 0),
        COLOR("step(u_A, u_B), 1.0", 3, 0),
        COLOR("smoothstep(u_X, u_Y, v_Color.x)", 8, 1),
        COLOR("length(u_A)", 5, 1),
        COLOR("distance(u_A, u_B)", 8, 1),
        COLOR("cross(u_A, u_B), 1.0", 9, 0),
        COLOR("normalize(u_A), 1.0", 8, 1),
        COLOR("normalize(u_A.xy), 1.0, 1.0", 5, 1),
        COLOR("faceforward(u_A, u_B, v_Color), 1.0", 5 + 1 + 3 + 3, 0),
        COLOR("reflect(u_A, u_B), 1.0", 12, 0), /* a - 2 (a.b) b */
        COLOR("refract(u_A, u_B, u_X), 1.0", 5 + 2 + 3 + 1 + 1 + 2 + 9 + 3, 1),
        COLOR("float(any(lessThan(u_A, u_B)))", 3 + 2 + 1, 0),
        COLOR("float(all(not(greaterThanEqual(u_A, u_B))))", 3 + 3 + 2 + 1, 0),
        COLOR("texture2D(u_Map, u_A.xy).rgb * u_B, 1.0", 3, 1),
        COLOR("texture2DProj(u_Map, u_A)", 0, 1),
    };
    ASSERT_COSTS(known);
}

TEST(a_loop_costs_each_of_its_turns)
{
    for (int turns = 1; turns <= 8; turns++) {
        const Known known = {
            SHADER_VERTEX,
            formatted("vec3 sum = u_A; for (int i = 0; i < %d; i++) sum += u_X * u_Array[i]; "
                      "v_Color = sum;",
                      turns),
            {.arithmetic = 6 * turns}};
        assert_costs(&known, 1);
    }
}

TEST(functions_cost_each_of_their_calls)
{
    static const Known known[] = {
        VERTEX("v_Color = twice(u_A);", 3, 0),
        VERTEX("v_Color = twice(u_A) * twice(u_B);", 9, 0),
    };
    ASSERT_COSTS(known);
}

TEST(what_is_known_not_needed_or_repeated_costs_nothing)
{
    static const Known known[] = {
        VERTEX("vec3 unused = normalize(u_A); v_Color = u_B;", 0, 0),
        VERTEX("v_Color = vec3(0.0) + 1.0 * u_A;", 0, 0),
        VERTEX("v_Color = (vec4(u_A, 1.0) * vec4(u_X)).xyz;", 4, 0), /* not all its components */
        VERTEX("float one = 1.0; v_Color = one * twice(u_A);", 3, 0),
        VERTEX("if (false) v_Color = normalize(u_A);", 0, 0),
        VERTEX("v_Color = normalize(u_A) * dot(normalize(u_A), u_B);", 8 + 5 + 3, 1),
        VERTEX("v_Color = u_A + u_B; gl_PointSize = dot(u_B + u_A, u_A);", 3 + 5, 0),
        VERTEX("v_Color.x = dot(u_A, vec3(0.0, 1.0, 0.0));", 0, 0),
        VERTEX("v_Color = pow(4.0, 0.5) * u_A;", 3, 0),
        VERTEX("vec3 c[2]; c[0] = u_A; for (int i = 0; i < 2; i++) c[i] = c[0]; v_Color = c[1];", 0,
               0),
    };
    ASSERT_COSTS(known);
}

TEST(every_branch_counts)
{
    static const Known known[] = {
        {SHADER_FRAGMENT,
         "vec3 c; if (u_X > 0.5) c = normalize(u_A); else c = u_A * u_B; gl_FragColor.rgb = c;",
         {1 + 8 + 3, 1}},
        {SHADER_FRAGMENT,
         "gl_FragColor = vec4(u_X); if (u_X > 0.5) discard; if (u_Y > 0.5) return; gl_FragColor.rgb = u_A * u_B;",
         {1 + 1 + 3, 0}},
        {SHADER_FRAGMENT,
         "vec3 c = u_A; for (int i = 0; i < 4; i++) { if (c.x > u_X) break; c *= u_B; } "
         "gl_FragColor.rgb = c;",
         {4 * 1 + 4 * 3 + 4 * 0, 0}},
        /* In both ways the same: neither comes before the other. */
        {SHADER_FRAGMENT,
         "vec3 c = u_A; if (u_X > 0.5) c = sqrt(u_A); else if (u_Y > 0.5) c = sqrt(u_A); "
         "gl_FragColor.rgb = c;",
         {2, 6}},
    };
    ASSERT_COSTS(known);
}

static void assert_refused(const char *body, const char *reason)
{
    ShaderCost operations = {1, 2};
    Message message = {0};
    const char *text = formatted("%s%s }\n", DECLARATIONS[SHADER_VERTEX], body);
    assert_false(shader_cost(text, SHADER_VERTEX, &operations, &message));
    if (!strstr(message.text, reason) || strchr(message.text, '\n'))
        fail_msg("\"%s\" has no \"%s\", or several lines", message.text, reason);
    assert_int_equal(operations.arithmetic + operations.special, 0);
}

TEST(uncountable_shaders_are_refused_in_one_line)
{
    assert_refused("v_Color = nonsense;", "operations: line 7: nonsense");
    assert_refused("while (v_Color.x < u_X) v_Color += u_A;",
                   "operations: line 7: cannot unroll a loop");
    assert_refused("while (true) v_Color += u_A;", "operations: too many to count");
}

/* Ten sums, products and so on of what was before, of which some are not needed: in main, or each
 * in a function with other names. */
static void write_random(unsigned long long seed, bool functions, char *text, size_t size)
{
    static const char *const FORMS[] = {"%s + %s",
                                        "%s * %s",
                                        "%s - 2.0 * %s",
                                        "cross(%s, %s)",
                                        "normalize(%s) + %s",
                                        "dot(%s, u_A) * %s",
                                        "mix(%s, u_B, %s)",
                                        "max(%s, %s)",
                                        "%s / (1.0 + %s)"};
    enum { STEPS = 10, FORM_NUMBER = sizeof FORMS / sizeof FORMS[0] };
    char body[2048] = "vec3 c0 = u_A; vec3 c1 = u_B;", made[2048] = "";
    for (int i = 2; i < STEPS; i++) {
        char a[16], b[16], form[64], own[64], *end = body + strlen(body);
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        snprintf(a, sizeof a, "c%d", (int)(seed >> 33) % i);
        snprintf(b, sizeof b, "c%d", (int)(seed >> 43) % i);
        const char *chosen = FORMS[(seed >> 53) % FORM_NUMBER];
        snprintf(form, sizeof form, chosen, a, b);
        snprintf(own, sizeof own, chosen, "left", "right");
        if (functions) {
            snprintf(made + strlen(made), sizeof made - strlen(made),
                     "vec3 step%d(vec3 left, vec3 right) { vec3 result = %s; return result; }\n", i,
                     own);
            snprintf(form, sizeof form, "step%d(%s, %s)", i, a, b);
        }
        snprintf(end, sizeof body - (size_t)(end - body), " vec3 c%d = %s;", i, form);
    }
    snprintf(text, size,
             "precision highp float;\nuniform vec3 u_A, u_B;\n%svoid main() { %s "
             "gl_FragColor = vec4(c%d, 1.0); }\n",
             made, body, STEPS - 1);
}

TEST(functions_and_names_change_no_count)
{
    const unsigned long long seed = testing_seed(1);
    for (unsigned i = 0; i < 300; i++) {
        char texts[2][8192];
        ShaderCost costs[2];
        for (int k = 0; k < 2; k++) {
            write_random(seed + i, k, texts[k], sizeof texts[k]);
            SUCCEEDS(shader_cost(texts[k], SHADER_FRAGMENT, &costs[k], message));
        }
        if (memcmp(&costs[0], &costs[1], sizeof costs[0]) != 0)
            fail_msg("%d + %d and %d + %d\n%s\n%s", costs[0].arithmetic, costs[0].special,
                     costs[1].arithmetic, costs[1].special, texts[0], texts[1]);
    }
}

static void count_program(Lighting *lighting, const Scene *scene, bool full,
                          ShaderCost operations[2])
{
    Message message = {0};
    ShaderSource sources[2];
    if (!lighting_sources(lighting, scene, scene->objects, full, sources, &message))
        fail_msg("%s", message.text);
    for (int stage = 0; stage < 2; stage++) {
        if (!shader_cost(sources[stage].text, (ShaderStage)stage, &operations[stage], &message))
            fail_msg("%s\n%s", message.text, sources[stage].text);
        shader_source_close(&sources[stage]);
    }
}

TEST(no_scene_costs_more_than_the_full_program)
{
    enum { SCENES = 12 };
    const ShaderLoader loader = {.folder = NULL};
    const unsigned long long seed = testing_seed(1);
    Lighting *lighting;
    RandomMeshes meshes = {.first = NULL};
    SUCCEEDS(lighting_open(&lighting, &loader, message));
    for (int i = 0; i < SCENES; i += testing_step(9)) {
        RandomScene made;
        ShaderCost mine[2], full[2];
        random_scene_make(&made, seed + (unsigned)i, seed);
        made.scene.interpolation %= 2; /* the others move light to the vertices, as flat does */
        SUCCEEDS(random_scene_ready(&made, &meshes, message));
        made.objects[0].flat = false;
        count_program(lighting, &made.scene, false, mine);
        count_program(lighting, &made.scene, true, full);
        for (int stage = 0; stage < 2; stage++) {
            if (mine[stage].arithmetic > full[stage].arithmetic ||
                mine[stage].special > full[stage].special)
                fail_msg("scene %d, %s: %d, %d; in the full program %d, %d", i,
                         stage == SHADER_VERTEX ? "vertex" : "fragment", mine[stage].arithmetic,
                         mine[stage].special, full[stage].arithmetic, full[stage].special);
        }
    }
    lighting_close(lighting);
    random_meshes_close(&meshes);
}

int main(void)
{
    return testing_run(0, "shader cost", NULL, NULL);
}
