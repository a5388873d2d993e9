/*
 * The operations of shaders, counted by tools: compared with counts made by hand for small shaders,
 * and for the programs of random scenes. No GL.
 */
#include "hard/random_scene.h"
#include "scene/shader_cost.h"
#include "support/testing.h"

#include <dirent.h>
#include <limits.h>

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
                      "uniform mat4 u_Matrix;\n"
                      "uniform vec3 u_A, u_B, u_Array[8];\n"
                      "uniform float u_X;\n"
                      "varying vec3 v_Color;\n"
                      "vec3 twice(vec3 v) { return v + v; }\n"
                      "void main() { gl_Position = a_Position; ",
    [SHADER_FRAGMENT] = "#version 100\n"
                        "precision mediump float;\n"
                        "uniform vec3 u_A, u_B, u_Array[8];\n"
                        "uniform float u_X, u_Y;\n"
                        "varying vec3 v_Color;\n"
                        "void main() { ",
};

static void count(ShaderStage stage, const char *body, ShaderCost *operations)
{
    char text[2048];
    Message message = {0};
    snprintf(text, sizeof text, "%s%s }\n", DECLARATIONS[stage], body);
    if (!shader_cost(text, stage, operations, &message))
        fail_msg("%s\n%s", message.text, text);
}

static void assert_costs(const Known *known, size_t number)
{
    for (size_t i = 0; i < number; i++) {
        ShaderCost got;
        count(known[i].stage, known[i].main, &got);
        if (memcmp(&got, &known[i].cost, sizeof got) != 0)
            fail_msg("%s\n%d arithmetic, %d special, %d branches; must be %d, %d, %d",
                     known[i].main, got.arithmetic, got.special, got.branches,
                     known[i].cost.arithmetic, known[i].cost.special, known[i].cost.branches);
    }
}

#define ASSERT_COSTS(known) assert_costs(known, sizeof known / sizeof known[0])

TEST(operations_are_those_on_single_numbers)
{
    static const Known known[] = {
        {SHADER_VERTEX, "v_Color = u_A;", {0}},
        {SHADER_VERTEX, "v_Color = u_A + u_B;", {.arithmetic = 3}},
        {SHADER_VERTEX, "v_Color = u_A * u_X;", {.arithmetic = 3}},
        {SHADER_VERTEX, "v_Color.x = u_A.x - u_B.y;", {.arithmetic = 1}},
        {SHADER_VERTEX, "v_Color = vec3(dot(u_A, u_B));", {.arithmetic = 5}},
        {SHADER_VERTEX, "v_Color = max(u_A, 0.0);", {.arithmetic = 3}},
        {SHADER_VERTEX, "v_Color = clamp(u_A, 0.0, 1.0);", {.arithmetic = 6}},
        {SHADER_VERTEX, "v_Color = cross(u_A, u_B);", {.arithmetic = 9}},
        {SHADER_VERTEX, "v_Color = reflect(u_A, u_B);", {.arithmetic = 12}}, /* a - 2 (a.b) b */
        {SHADER_VERTEX, "v_Color = (u_Matrix * a_Position).xyz;", {.arithmetic = 28}},
        {SHADER_VERTEX, "gl_Position = a_Position * u_Matrix;", {.arithmetic = 28}},
        {SHADER_VERTEX, "v_Color = u_A / u_B;", {.special = 3}},
        {SHADER_VERTEX, "v_Color.x = sqrt(u_X);", {.special = 1}},
        {SHADER_VERTEX, "v_Color = normalize(u_A);", {.arithmetic = 8, .special = 1}},
        {SHADER_VERTEX, "v_Color.x = length(u_A);", {.arithmetic = 5, .special = 1}},
        {SHADER_FRAGMENT, "gl_FragColor = vec4(v_Color, 1.0);", {0}},
        {SHADER_FRAGMENT, "gl_FragColor = vec4(pow(u_X, u_Y));", {.special = 1}},
        {SHADER_FRAGMENT,
         "gl_FragColor = vec4(gl_FrontFacing ? u_A : u_B, 1.0);",
         {.arithmetic = 3}},
    };
    ASSERT_COSTS(known);
}

TEST(a_loop_costs_each_of_its_turns)
{
    for (int turns = 1; turns <= 8; turns++) {
        char body[256];
        snprintf(body, sizeof body,
                 "vec3 sum = u_A; for (int i = 0; i < %d; i++) sum += u_X * u_Array[i]; "
                 "v_Color = sum;",
                 turns);
        const Known known = {SHADER_VERTEX, body, {.arithmetic = 6 * turns}};
        assert_costs(&known, 1);
    }
}

TEST(functions_cost_each_of_their_calls)
{
    static const Known known[] = {
        {SHADER_VERTEX, "v_Color = twice(u_A);", {.arithmetic = 3}},
        {SHADER_VERTEX, "v_Color = twice(u_A) * twice(u_B);", {.arithmetic = 9}},
    };
    ASSERT_COSTS(known);
}

TEST(dead_code_costs_nothing)
{
    static const Known known[] = {
        {SHADER_VERTEX, "vec3 unused = normalize(u_A); v_Color = u_B;", {0}},
        {SHADER_VERTEX, "v_Color = vec3(0.0) + 1.0 * u_A;", {0}},
        {SHADER_VERTEX, "float one = 1.0; v_Color = one * twice(u_A);", {.arithmetic = 3}},
        {SHADER_VERTEX, "if (false) v_Color = normalize(u_A);", {0}},
    };
    ASSERT_COSTS(known);
}

TEST(every_branch_counts)
{
    static const Known known[] = {
        {SHADER_FRAGMENT,
         "vec3 c; if (u_X > 0.5) c = normalize(u_A); else c = u_A * u_B; gl_FragColor.rgb = c;",
         {.arithmetic = 1 + 8 + 3, .special = 1, .branches = 1}},
    };
    ASSERT_COSTS(known);
}

static void assert_refused(const char *body, const char *reason)
{
    char text[2048];
    ShaderCost operations = {1, 2, 3};
    Message message = {0};
    snprintf(text, sizeof text, "%s%s }\n", DECLARATIONS[SHADER_VERTEX], body);
    assert_false(shader_cost(text, SHADER_VERTEX, &operations, &message));
    if (!strstr(message.text, reason) || strchr(message.text, '\n'))
        fail_msg("\"%s\" has no \"%s\", or several lines", message.text, reason);
    assert_int_equal(operations.arithmetic + operations.special + operations.branches, 0);
}

TEST(uncountable_shaders_are_refused_in_one_line)
{
    assert_refused("v_Color = nonsense;",
                   "operations: glslangValidator: ERROR: 0:7: 'nonsense' : undeclared");
    assert_refused("for (int i = 0; i < 8; i++) { if (u_Array[i].x > u_X) break; "
                   "v_Color += u_Array[i]; }",
                   "operations: cannot unroll a loop");
}

TEST(a_missing_tool_is_named_with_its_package)
{
    char *path = strdup(getenv("PATH"));
    assert_non_null(path);
    setenv("PATH", "/nowhere", 1);
    assert_refused("", "glslangValidator: not found; install the package glslang-tools");
    setenv("PATH", path, 1);
    free(path);
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
    require(lighting_open(&lighting, &loader, FAILURE), FAILURE);
    for (int i = 0; i < SCENES; i += testing_step(9)) {
        RandomScene made;
        ShaderCost mine[2], full[2];
        random_scene_make(&made, seed + (unsigned)i, seed);
        made.scene.interpolation %= 2; /* the others move light to the vertices, as flat does */
        require(random_scene_ready(&made, &meshes, FAILURE), FAILURE);
        made.objects[0].flat = false;
        count_program(lighting, &made.scene, false, mine);
        count_program(lighting, &made.scene, true, full);
        for (int stage = 0; stage < 2; stage++) {
            if (mine[stage].arithmetic > full[stage].arithmetic ||
                mine[stage].special > full[stage].special ||
                mine[stage].branches > full[stage].branches)
                fail_msg("scene %d, %s: %d, %d, %d; in the full program %d, %d, %d", i,
                         stage == SHADER_VERTEX ? "vertex" : "fragment", mine[stage].arithmetic,
                         mine[stage].special, mine[stage].branches, full[stage].arithmetic,
                         full[stage].special, full[stage].branches);
        }
    }
    lighting_close(lighting);
    random_meshes_close(&meshes);
}

static int entries_that_begin(const char *folder, const char *name)
{
    int count = 0;
    DIR *listing = opendir(folder);
    assert_non_null(listing);
    for (const struct dirent *entry; (entry = readdir(listing)) != NULL;)
        count += strncmp(entry->d_name, name, strlen(name)) == 0;
    closedir(listing);
    return count;
}

/* How often the tools have run: each leaves a file. */
static int runs_of_count(void)
{
    ShaderCost cost;
    count(SHADER_VERTEX, "v_Color = u_A + u_B;", &cost);
    assert_int_equal(cost.arithmetic, 3);
    return entries_that_begin(".", "ran.");
}

TEST_WITH(0, a_count_is_kept_for_the_same_tools, testing_enter_cache, testing_leave_cache)
{
    char path[2 * PATH_MAX], *usual = strdup(getenv("PATH"));
    assert_non_null(usual);
    testing_shell("mkdir bin; for tool in glslangValidator spirv-opt; do "
                  "printf '#!/bin/sh\n: >%s/ran.$$\nexec %s \"$@\"\n' \"$PWD\" "
                  "\"$(command -v $tool)\" >bin/$tool; chmod +x bin/$tool; done");
    snprintf(path, sizeof path, "%s/bin:%s", testing_folder, usual);
    setenv("PATH", path, 1);
    assert_int_equal(runs_of_count(), 3);
    assert_int_equal(entries_that_begin("lighting", "cost-"), 1);
    assert_int_equal(runs_of_count(), 3);
    testing_shell("touch -d 2001-01-01 bin/spirv-opt"); /* another one */
    assert_int_equal(runs_of_count(), 6);
    testing_shell("for file in lighting/cost-*; do "
                  "printf 'xxxx' | dd of=$file bs=1 seek=17 conv=notrunc status=none; done");
    assert_int_equal(runs_of_count(), 9);
    setenv("PATH", usual, 1);
    free(usual);
}

int main(void)
{
    ShaderCost operations;
    Message message = {0};
    setenv("XDG_CACHE_HOME", "/dev/null", 1); /* what counts now is tested, not what was kept */
    if (!shader_cost("void main() { gl_Position = vec4(0.0); }", SHADER_VERTEX, &operations,
                     &message) &&
        strstr(message.text, "not found")) {
        printf("skipped: %s\n", message.text);
        return EXIT_SKIPPED;
    }
    return testing_run(0, "shader cost", NULL, NULL);
}
