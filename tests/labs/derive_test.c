/* Mutants of the labs' solutions, handed in as submissions: each that changes what is computed is
 * explained by itself, or by another that computes the same. */
#include "labs/diagnosis/diagnose.h"

#include "labs/diagnosis/mutation.h"
#include "core/shader_source.h"
#include "base/memory.h"
#include "support/testing.h"

#include <stdlib.h>
#include <string.h>

enum { EVERY = 397 }; /* of all mutants */

typedef struct Trial {
    const Lab *lab;
    LabPictures pictures;
    char *texts[2];
    int stage, seen; /* stage: that is mutated */
    int tried, named;
} Trial;

static char *read_solution(const Lab *lab, int stage)
{
    const ShaderLoader loader = {.precision = "highp"};
    ShaderSource source;
    SUCCEEDS(shader_source_open(
        &source, &loader,
        formatted("labs/solutions/%s/%s.%s", lab->name, lab->file, stage == 0 ? "vert" : "frag"),
        (ShaderStage)stage, message));
    GlslTree *tree = glsl_parse(source.text, (GlslStage)stage, NULL);
    char *text = glsl_print(tree, tree->root);
    glsl_tree_free(tree);
    shader_source_close(&source);
    return text;
}

/* After its first line, which the loader writes itself. */
static void add_file(SubmissionFiles *files, const Lab *lab, int stage, const char *text)
{
    const char *body = strchr(text, '\n') + 1;
    const char *name = formatted("%s.%s", lab->file, stage == 0 ? "vert" : "frag");
    assert_true(submission_files_add(files, name, body, strlen(body) + 1, NULL) ||
                submission_files_add(files, name, body, strlen(body), NULL));
}

static void try(Trial *trial, const Mutation *mutation, const char *text)
{
    static Verdict verdict;
    SubmissionFiles files = {.count = 0};
    verdict = (Verdict){.seed = 1};
    for (int i = 0; i < 2; i++)
        add_file(&files, trial->lab, i, i == trial->stage ? text : trial->texts[i]);
    SUCCEEDS(diagnose(&trial->pictures, NULL, &files, &verdict, NULL, message));
    submission_files_close(&files);
    if (strcmp(verdict.message, "Unknown mistake") ==
        0) /* it computes what is right, or is no text */
        return;
    const bool named = verdict.mistake_count > 0;
    trial->tried++;
    trial->named += named;
    if (!named)
        printf("%s: without a name: %s\n", trial->lab->file, mutation->name);
}

static bool take(void *context, const Mutation *mutation, const char *text)
{
    Trial *trial = context;
    if (trial->seen++ % EVERY == EVERY / 2)
        try(trial, mutation, text);
    return true;
}

static void test_lab(const Lab *lab, Trial *sum)
{
    static Trial trial;
    const double numbers[] = {0.4};
    trial = (Trial){.lab = lab};
    SUCCEEDS(lab_pictures_open(&trial.pictures, lab, 1, message));
    for (int i = 0; i < 2; i++)
        trial.texts[i] = read_solution(lab, i);
    for (trial.stage = 0; trial.stage < 2; trial.stage++) {
        GlslTree *tree = glsl_parse(trial.texts[trial.stage], (GlslStage)trial.stage, NULL);
        trial.seen = 0;
        mutations_each(tree, NULL, numbers, 1, take, &trial);
        glsl_tree_free(tree);
    }
    for (int i = 0; i < 2; i++)
        free(trial.texts[i]);
    lab_pictures_close(&trial.pictures);
    sum->tried += trial.tried;
    sum->named += trial.named;
}

TEST(test_mutants)
{
    static Trial sum;
    for (int i = 0; i < LAB_COUNT; i += testing_step(2))
        if (!LABS[i].given && !LABS[i].budget && !LABS[i].shadow) /* the last needs a driver */
            test_lab(&LABS[i], &sum);
    assert_true(sum.tried > 0);
    assert_int_equal(sum.named, sum.tried);
}

/* At all points they are more numbers than an int counts. */
TEST(test_many_outputs)
{
    static Trial trial;
    static Verdict verdict;
    SubmissionFiles files = {.count = 0};
    trial = (Trial){.lab = &LABS[6 - 1]};
    SUCCEEDS(lab_pictures_open(&trial.pictures, trial.lab, 1, message));
    for (int i = 0; i < 2; i++) {
        trial.texts[i] = read_solution(trial.lab, i);
        char *text = memory_format("%svarying vec4 v_Many[%d];\n", trial.texts[i], 200000);
        add_file(&files, trial.lab, i, text);
        free(trial.texts[i]);
        free(text);
    }
    verdict = (Verdict){.seed = 1};
    SUCCEEDS(diagnose(&trial.pictures, NULL, &files, &verdict, NULL, message));
    assert_string_equal(verdict.message, "Unknown mistake");
    submission_files_close(&files);
    lab_pictures_close(&trial.pictures);
}

/* Of solutions: what stands there instead, and is named so. */
static const struct {
    int lab, stage;
    const char *was, *by, *name;
} CASES[] = {
    {8, 1, "u_Attenuation.y * distance + u_Attenuation.z * distance * distance",
     "u_Attenuation.z * distance + u_Attenuation.y * distance * distance",
     "swapped: u_Attenuation.z and u_Attenuation.y"},
    {8, 1, "vec3 color = u_AmbientLight * v_Color.rgb;",
     "float fade = 1.0 / (u_Attenuation.x + u_Attenuation.y * distance + u_Attenuation.z * "
     "distance * distance); vec3 color = u_AmbientLight * v_Color.rgb * fade;",
     "factor too many: fade"},
    {8, 1, "u_SpecularColor * pow(rDotV, u_Shininess)",
     "pow(u_SpecularColor * rDotV, vec3(u_Shininess))",
     "to the power of vec3(u_Shininess), too: u_SpecularColor"},
    {8, 1, "u_Attenuation.y * distance", "u_Attenuation.y * distance * 0.4 * 3.0", "3.0 for 2.5"},
    {8, 1, "u_Attenuation.y * distance", "u_Attenuation.x * distance",
     "u_Attenuation.x for u_Attenuation.y"},
    {8, 1, "pow(rDotV, u_Shininess)", "(rDotV * rDotV)", "a product for a power: rDotV * rDotV"},
    {7, 1, "pow(nDotH, shininess)", "4.0 * pow(nDotH, u_Shininess)",
     "on the power, not on its exponent: 4.0"},
    {5, 1, "light += ", "if (nDotL <= 0.0) break; light += ", "break for continue"},
    {9, 1, "color = u_BackColor;", "} color = u_BackColor; {",
     "outside the braces of if (!front): color = u_BackColor"},
    {9, 1, "u_AmbientLight + u_LightColor * nDotL", "max(u_AmbientLight, u_LightColor * nDotL)",
     "the larger, not the sum: u_AmbientLight, u_LightColor * nDotL"},
    {6, 1, "reflect(-lightDirection", "reflect(lightDirection", "sign of lightDirection reversed"},
    {5, 1, "normalize(v_Normal)", "v_Normal", "not normalized: v_Normal"},
    {5, 0, "vec3(u_ModelMatrix * a_Position)", "gl_Position.xyz",
     "gl_Position for the point in world space"},
    {1, 0, "normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)))",
     "vec3(normalize(u_NormalMatrix * a_Normal))",
     "normalized with its w: u_NormalMatrix * a_Normal"},
    {8, 1, "(u_Attenuation.x + u_Attenuation.y * distance + u_Attenuation.z * distance * distance)",
     "u_Attenuation.x + u_Attenuation.y * distance + u_Attenuation.z * distance * distance",
     "parentheses missing: u_Attenuation.x + u_Attenuation.y * distance + u_Attenuation.z * ..."},
    {9, 1, "gl_FrontFacing == u_Mirrored > 0.0", "(gl_FrontFacing || u_Mirrored < 0.0)",
     "gl_FrontFacing || u_Mirrored < 0.0 for gl_FrontFacing != u_Mirrored < 0.0"},
    {5, 1, "int i = 0", "int i = 1", "loop begins at 1, not at 0"},
    {7, 1, "lightDirection + viewDirection",
     "(u_LightPosition[i] - v_Position) + (u_EyePosition - v_Position)",
     "not normalized: u_LightPosition[i] - v_Position and u_EyePosition - v_Position"},
    {6, 1, "vec4(color, v_Color.a)", "vec4(pow(color, vec3(1.0 / 2.2)), v_Color.a)",
     "power too many: vec3(1.0 / 2.2)"},
    {8, 1,
     "1.0 / (u_Attenuation.x + u_Attenuation.y * distance + u_Attenuation.z * distance * distance)",
     "1.0 / u_Attenuation.x + 1.0 / (u_Attenuation.y * distance) + 1.0 / (u_Attenuation.z * "
     "distance * distance)",
     "each divided, not the sum: u_Attenuation.x + u_Attenuation.y * distance + ..."},
    {5, 1, "vec3 light = u_AmbientLight;",
     "vec3 sum; for (int k = 0; k < 2; k++) sum = u_LightColor[k] * max(dot(normal, "
     "normalize(u_LightPosition[k] - v_Position)), 0.0); gl_FragColor = vec4((u_AmbientLight + "
     "sum) * v_Color.rgb, v_Color.a); if (true) return; vec3 light = u_AmbientLight;",
     "= for +=: sum"},
    {7, 1, "vec3 halfway = normalize(lightDirection + viewDirection);",
     "struct Ways { vec3 v, h; } w; w.h = normalize(lightDirection + viewDirection); w.v = "
     "viewDirection; vec3 halfway = w.v;",
     "halfway for w.h"},
    {9, 1, "normalize(v_Normal)", "u_Mirrored * normalize(v_Normal)",
     "factor too many: u_Mirrored"},
};

TEST(test_names)
{
    static Trial trial;
    static Verdict verdict;
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i += (size_t)testing_step(2)) {
        SubmissionFiles files = {.count = 0};
        trial = (Trial){.lab = &LABS[CASES[i].lab - 1]};
        SUCCEEDS(lab_pictures_open(&trial.pictures, trial.lab, 1, message));
        for (int k = 0; k < 2; k++) {
            char *text = read_solution(trial.lab, k);
            const char *at = strstr(text, CASES[i].was);
            if (k != CASES[i].stage) {
                add_file(&files, trial.lab, k, text);
            } else {
                assert_non_null(at);
                char *wrong = memory_format("%.*s%s%s", (int)(at - text), text, CASES[i].by,
                                            at + strlen(CASES[i].was));
                add_file(&files, trial.lab, k, wrong);
                free(wrong);
            }
            free(text);
        }
        verdict = (Verdict){.seed = 1};
        SUCCEEDS(diagnose(&trial.pictures, NULL, &files, &verdict, NULL, message));
        submission_files_close(&files);
        lab_pictures_close(&trial.pictures);
        assert_int_equal(verdict.mistake_count, 1);
        assert_string_equal(verdict.mistakes[0].name, CASES[i].name);
    }
}

int main(void)
{
    return testing_run(0, "derive", NULL, NULL);
}
