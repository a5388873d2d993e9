/* What uniforms are is guessed from their types and the words in their names: the first rule that
 * fits says whose value one has; what none fits is the lab's own. The starter is the solution
 * without the functions of the shader that computes the light. */
#include "labs/check/new_lab.h"

#include "base/input.h"
#include "base/json_writer.h"
#include "base/output.h"
#include "base/output_text.h"
#include "core/shader_files.h"
#include "glsl/glsl.h"
#include "labs/check/judge.h"
#include "labs/submission/lab_json.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Both words are in the name, whatever its case. `kind`: m matrix, v vector, f number. */
typedef struct Rule {
    char kind;
    const char *word, *other, *is, *meaning;
} Rule;

static const Rule RULES[] = {
#include "labs/check/uniform_rules.def"
};

enum { MAX_FOUND = LAB_MAX_UNIFORMS + 24 };

/* An attribute or uniform of the shaders; without a rule it is the lab's own. */
typedef struct Found {
    char name[LAB_NAME_SIZE];
    char type[64];
    const Rule *rule;
    int size, light; /* numbers; of structures in an array, the element, else -1 */
    bool attribute;
} Found;

typedef struct Making {
    const char *folder, *name; /* the latter of the shaders */
    char *texts[2];            /* by GlslStage */
    GlslTree *trees[2];
    Found found[MAX_FOUND];
    int count, lights;
    Message *message;
} Making;

static bool has(const char *name, const char *word)
{
    return strcasestr(name, word) != NULL;
}

static const Rule *rule_of(const char *name, char kind)
{
    for (size_t i = 0; i < sizeof RULES / sizeof *RULES; i++)
        if (RULES[i].kind == kind && (strcmp(name, RULES[i].is) == 0 ||
                                      (has(name, RULES[i].word) && has(name, RULES[i].other))))
            return &RULES[i];
    return NULL;
}

static const Found *find(const Making *making, const char *is)
{
    for (int i = 0; i < making->count; i++)
        if (making->found[i].rule && strcmp(making->found[i].rule->is, is) == 0)
            return &making->found[i];
    return NULL;
}

/* Adds a variable, or the fields of a structure; `light` as in Found. */
static bool add(Making *making, const GlslTree *tree, const char *name, int type, int light,
                bool attribute)
{
    const GlslType *of = &tree->types[type];
    char part[2 * LAB_NAME_SIZE], text[64];
    if (of->array && tree->types[of->element].fields) {
        for (int i = 0; i < of->length; i++) {
            snprintf(part, sizeof part, "%s[%d]", name, i);
            if (!add(making, tree, part, of->element, i, attribute))
                return false;
        }
        return true;
    }
    for (int i = 0; i < of->fields; i++) {
        const GlslField *field = &tree->fields[of->field + i];
        snprintf(part, sizeof part, "%.60s.%.60s", name, field->name);
        if (!add(making, tree, part, field->type, light, attribute))
            return false;
    }
    if (of->fields)
        return true;
    for (int i = 0; i < making->count; i++)
        if (strcmp(making->found[i].name, name) == 0)
            return true; /* both shaders have it */
    const int plain = of->array ? of->element : type, size = glsl_size(plain);
    const char kind = attribute               ? 'a'
                      : glsl_is_matrix(plain) ? 'm'
                      : plain == GLSL_FLOAT   ? 'f'
                      : plain <= GLSL_VEC4    ? 'v'
                                              : ' ';
    const Rule *rule = rule_of(name, kind);
    if (making->count == MAX_FOUND || strlen(name) >= LAB_NAME_SIZE)
        return message_set(making->message, "%s: too many or too long names", name);
    if (!rule && (attribute || kind == 'm' || kind == ' ' || of->array))
        return message_set(making->message, "%s %s: no lab has one; %s",
                           glsl_type_text(tree, type, text), name,
                           attribute ? "there are positions, normals and colours"
                                     : "there are matrices, lights, and numbers of your own");
    Found *found = &making->found[making->count++];
    *found = (Found){.rule = rule, .size = size, .light = light, .attribute = attribute};
    snprintf(found->name, sizeof found->name, "%s", name);
    snprintf(found->type, sizeof found->type, "%s", glsl_type_text(tree, type, text));
    if (rule && strncmp(rule->is, "u_Light", 7) == 0) {
        const int lights = of->array ? of->length : light + 1;
        making->lights = lights > making->lights ? lights : making->lights;
    }
    return true;
}

static bool read_shader(Making *making, const char *path, GlslStage stage)
{
    size_t size;
    making->texts[stage] =
        input_read(AT_FDCWD, path, path, SHADER_FILE_MAX, &size, making->message);
    if (!making->texts[stage])
        return false;
    GlslTree *tree = making->trees[stage] = glsl_parse(making->texts[stage], stage, NULL);
    if (tree->message_count || !glsl_check_whole(tree))
        return message_set(making->message, "%s:%d:%d: %s", path, tree->messages[0].place.line,
                           tree->messages[0].place.column, tree->messages[0].text);
    for (int i = 1; i < tree->symbol_count; i++) {
        const GlslSymbol *symbol = &tree->symbols[i];
        const bool attribute = symbol->storage == GLSL_ATTRIBUTE;
        if (symbol->kind == GLSL_VARIABLE && symbol->global && !symbol->built_in &&
            (attribute || symbol->storage == GLSL_UNIFORM) &&
            !add(making, tree, symbol->name, symbol->type, -1, attribute))
            return false;
    }
    return true;
}

static void put_scene(JsonWriter *json, const Making *making, bool spot)
{
#define ONE "{\"place\": [2, 2.5, 2.5], \"color\": [0.6, 0.55, 0.5]}"
    static const char *const lights[] = {
        "[" ONE "]", "[" ONE ", {\"place\": [-3, 1, 2], \"color\": [0.2, 0.3, 0.45]}]"};
    json_write_object(json, "scene");
    json_write_text(json, "shape", "ball");
    json_write_number(json, "scale", 1);
    json_write_value(json, "eye", "[0, 0, 6]");
    json_write_value(json, "lights", lights[making->lights - 1]);
    if (spot)
        json_write_value(
            json, "spot",
            "{\"at\": [0.1, 0.2, 0.3], \"cutoff\": 14, \"exponent\": 10, \"attenuation\": [0.7, 0.05, 0.02]}");
    json_write_value(json, "color", "[1, 0.5, 0.2]");
    if (find(making, "u_Shininess") || find(making, "u_SpecularColor"))
        json_write_number(json, "shininess", 20);
    json_write_end(json);
}

/* All have other values, so that none can stand for another. */
static void put_own(JsonWriter *json, const Found *found, int number)
{
    static const char *const names[] = {"value", "min", "max"};
    static const double factors[] = {1, 0.5, 1.5};
    json_write_object(json, found->name);
    for (int k = 0; k < 3; k++) {
        if (found->size > 1)
            json_write_list(json, names[k]);
        for (int i = 0; i < found->size; i++)
            json_write_number(json, found->size > 1 ? NULL : names[k],
                              factors[k] * (0.2 + 0.1 * ((3 * number + 2 * i) % 5)));
        if (found->size > 1)
            json_write_end(json);
    }
    json_write_end(json);
}

/* Those that the labs do not name so. */
static void put_uniforms(JsonWriter *json, const Making *making, bool attributes)
{
    json_write_object(json, attributes ? "attributes" : "uniforms");
    for (int i = 0; i < making->count; i++) {
        const Found *found = &making->found[i];
        const bool same = found->rule && (strcmp(found->name, found->rule->is) == 0 ||
                                          (attributes && strncmp(found->name, "a_", 2) == 0 &&
                                           strcasecmp(found->name + 2, found->rule->is) == 0));
        if (found->attribute != attributes || same)
            continue;
        if (attributes) {
            json_write_text(json, found->rule->is, found->name);
        } else if (!found->rule) {
            put_own(json, found, i);
        } else if (found->light < 0 || !strstr(found->rule->is, "u_Light")) {
            json_write_text(json, found->name, found->rule->is);
        } else {
            json_write_object(json, found->name);
            json_write_text(json, "is", found->rule->is);
            json_write_whole(json, "light", found->light);
            json_write_end(json);
        }
    }
    json_write_end(json);
}

static bool put_json(const Making *making)
{
    OutputText out;
    bool spot = false;
    for (int i = 0; i < making->count; i++)
        spot |= making->found[i].rule && (strstr(making->found[i].rule->is, "u_Spot") ||
                                          strstr(making->found[i].rule->is, "u_Attenuation"));
    output_text_open(&out);
    JsonWriter json = {.file = out.file, .lines = 3};
    json_write_object(&json, NULL);
    json_write_text(&json, "summary", "to do: one line");
    json_write_text(&json, "shaders", making->name);
    json_write_text(&json, "light",
                    spot                               ? "spot"
                    : find(making, "u_LightDirection") ? "directional"
                                                       : "point");
    json_write_flag(&json, "ambient", find(making, "u_AmbientLight"));
    if (find(making, "u_BackColor"))
        json_write_flag(&json, "two_sided", true);
    if (find(making, "u_Shininess") || find(making, "u_SpecularColor"))
        json_write_text(&json, "highlight", "Phong");
    put_scene(&json, making, spot);
    put_uniforms(&json, making, true);
    put_uniforms(&json, making, false);
    json_write_value(&json, "points", "{\"most\": 10, \"drawn\": 1, \"scenes\": 8}");
    json_write_end(&json);
    return output_text_put(&out, making->folder, "lab.json", making->message);
}

static bool put_task(const Making *making)
{
    OutputText out;
    output_text_open(&out);
    fprintf(out.file, "# To do: the title\n\n![what is expected, after 1 s](expected.png)\n\n"
                      "To do: what it is about, and the formula.\n\n"
                      "## What there is\n\n| name | type | what it is |\n|---|---|---|\n");
    for (int i = 0; i < making->count; i++) {
        const Found *found = &making->found[i];
        fprintf(out.file, "| `%s` | %s %s | %s |\n", found->name,
                found->attribute ? "attribute" : "uniform", found->type,
                found->rule ? found->rule->meaning : "to do");
    }
    fprintf(out.file,
            "\n## What to do\n\n1. To do: the steps.\n\n## Check\n\n"
            "Copy this folder, edit `%s.vert` and `%s.frag` in the copy, and\n\n"
            "```sh\ncheck --lab %s mine --pictures found\n```\n",
            making->name, making->name, making->folder);
    return output_text_put(&out, making->folder, "TASK.md", making->message);
}

/* How much of a text comes before its first function. */
static int before_functions(const Making *making, GlslStage stage)
{
    const GlslTree *tree = making->trees[stage];
    const char *at = making->texts[stage];
    int first = 0;
    for (int i = 1; i < tree->symbol_count; i++) {
        const GlslSymbol *symbol = &tree->symbols[i];
        if (symbol->kind == GLSL_FUNCTION && !symbol->built_in && symbol->node &&
            (!first || symbol->place.line < first))
            first = symbol->place.line;
    }
    const char *end = at; /* of the last line of code: comments before a function go with it */
    for (int line = 1; line < first && *at; line++) { /* by a #line there may be fewer */
        const bool code = strncmp(at, "//", 2) != 0 && *at != '\n';
        at += strcspn(at, "\n");
        at += *at == '\n';
        end = code ? at : end;
    }
    return (int)(end - making->texts[stage]);
}

/* gl_Position as simply as the names allow. */
static void put_position(const Making *making, FILE *file)
{
    static const char *const ways[][3] = {{"u_MvpMatrix"},
                                          {"u_ViewProjMatrix", "u_ModelMatrix"},
                                          {"u_ProjMatrix", "u_ModelViewMatrix"},
                                          {"u_ProjMatrix", "u_ViewMatrix", "u_ModelMatrix"}};
    const Found *position = find(making, "position");
    for (int w = 0; w < 4 && position; w++) {
        bool all = true;
        for (int k = 0; k < 3 && ways[w][k]; k++)
            all &= find(making, ways[w][k]) != NULL;
        if (!all)
            continue;
        fprintf(file, "    gl_Position = ");
        for (int k = 0; k < 3 && ways[w][k]; k++)
            fprintf(file, "%s * ", find(making, ways[w][k])->name);
        fprintf(file, position->size == 4 ? "%s;\n" : "vec4(%s, 1.0);\n", position->name);
        return;
    }
}

/* The shader that has the light's uniforms loses its functions. */
static bool put_starter(const Making *making, GlslStage stage, bool cut)
{
    OutputText out;
    char name[LAB_NAME_SIZE + 8];
    const char *text = making->texts[stage];
    output_text_open(&out);
    if (!cut) {
        fputs(text, out.file);
    } else {
        fprintf(out.file, "%.*s\nvoid main() {\n    // To do.\n", before_functions(making, stage),
                text);
        if (stage == GLSL_VERTEX)
            put_position(making, out.file);
        else
            fputs("    gl_FragColor = vec4(0.5, 0.5, 0.5, 1.0);\n", out.file);
        fputs("}\n", out.file);
    }
    snprintf(name, sizeof name, "%s%s", making->name, stage == GLSL_VERTEX ? ".vert" : ".frag");
    return output_text_put(&out, making->folder, name, making->message);
}

static bool uses_light(const GlslTree *tree)
{
    bool found = false;
    for (int i = 1; i < tree->symbol_count; i++)
        found |= tree->symbols[i].storage == GLSL_UNIFORM && has(tree->symbols[i].name, "light");
    return found;
}

/* What one name means may depend on the others. */
static void guess_again(Making *making)
{
    const bool outer = find(making, "cosine of u_SpotCutoff");
    const bool place = find(making, "u_LightPosition") || find(making, "eye u_LightPosition");
    for (int i = 0; i < making->count; i++) {
        const Rule **rule = &making->found[i].rule;
        const char *is = *rule ? (*rule)->is : "";
        if (outer && strcmp(is, "u_SpotCutoff") == 0)
            *rule = rule_of("innerCutoff", 'f');
        if (place && strcmp(is, "u_LightDirection") == 0)
            *rule = rule_of("u_SpotDirection", 'v');
    }
}

static void tell_guesses(const Making *making)
{
    for (int i = 0; i < making->count; i++) {
        const Found *found = &making->found[i];
        printf("%s: %s%s%s\n", found->name, found->rule ? found->rule->is : "nothing fits",
               found->rule ? ", " : "; a value of the lab's own: set its range in lab.json",
               found->rule ? found->rule->meaning : "");
    }
}

static bool put_files(Making *making)
{
    char solution[PATH_MAX], expected[PATH_MAX], name[LAB_NAME_SIZE + 8];
    static const char *const endings[] = {".vert", ".frag"};
    const bool at_vertices = uses_light(making->trees[GLSL_VERTEX]);
    Message *message = making->message;
    if (mkdir(making->folder, 0777) != 0)
        return message_set(message, "%s: %s", making->folder, strerror(errno));
    if (!output_path(solution, making->folder, "solution", message) ||
        !output_folder(solution, message) ||
        !output_path(expected, making->folder, "expected.png", message))
        return false;
    bool done = true;
    for (int stage = 0; stage < 2 && done; stage++) {
        OutputText out;
        output_text_open(&out);
        fputs(making->texts[stage], out.file);
        snprintf(name, sizeof name, "%s%s", making->name, endings[stage]);
        done = output_text_put(&out, solution, name, message) &&
               put_starter(making, (GlslStage)stage, (stage == GLSL_VERTEX) == at_vertices);
    }
    if (!done || !put_json(making) || !put_task(making))
        return false;
    tell_guesses(making);
    const Lab *lab = lab_open(making->folder, message);
    if (lab && judge_expected(lab, expected, message))
        return true;
    message_add(message, "; the rest is written: edit lab.json");
    return false;
}

bool new_lab_write(const char *folder, const char *vertex, const char *fragment, Message *message)
{
    char name[LAB_NAME_SIZE];
    Making making = {.folder = folder, .name = name, .lights = 1, .message = message};
    const char *base = strrchr(folder, '/');
    snprintf(name, sizeof name, "%.40s", base ? base + 1 : folder);
    name[strcspn(name, "_")] = '\0';
    for (char *at = name; *at; at++)
        *at = isalnum((unsigned char)*at) ? (char)tolower((unsigned char)*at) : '-';
    bool done = name[0] || message_set(message, "%s: must end in the lab's name", folder);
    done = done && read_shader(&making, vertex, GLSL_VERTEX) &&
           read_shader(&making, fragment, GLSL_FRAGMENT);
    if (done && making.lights > LAB_MAX_LIGHTS)
        done =
            message_set(message, "%d lights; a lab has at most %d", making.lights, LAB_MAX_LIGHTS);
    guess_again(&making);
    done = done && put_files(&making);
    for (int stage = 0; stage < 2; stage++) {
        free(making.texts[stage]);
        if (making.trees[stage])
            glsl_tree_free(making.trees[stage]);
    }
    return done;
}
