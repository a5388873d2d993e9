/* A right program is one of many: light at the vertices or not, another bias, another fitted
 * exponent. Mutants are made of the one that is nearest to the submission; what a task leaves open
 * is no mistake, but all that is compared would differ by it. */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool derivation_read(const Lab *lab, const ShaderLoader *loader, const char *folder, int stage,
                     const char *ending, ShaderSource *source)
{
    char name[PATH_MAX + 64];
    snprintf(name, sizeof name, "%s%s%s.%s", folder, lab->file, ending,
             stage == 0 ? "vert" : "frag");
    return shader_source_open(source, loader, name, (ShaderStage)stage, NULL);
}

static bool normalizes(const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    const int id = at->kind == GLSL_BUILT_IN ? GLSL_FUNCTIONS[at->symbol].id : -1;
    bool found = id == GLSL_NORMALIZE || id == GLSL_LENGTH || id == GLSL_INVERSESQRT;
    for (int i = at->first; i && !found; i = tree->nodes[i].next)
        found = normalizes(tree, i);
    return found;
}

/* A name that may be put into the tree, as if it were declared. */
static void add_symbol(GlslTree *tree, const BindingValue *value, int type)
{
    int array = value->count > 1 ? GLSL_TYPES : 0;
    while (array && array < tree->type_count &&
           (tree->types[array].element != type || tree->types[array].length != value->count))
        array++;
    if (array == tree->type_count)
        *(GlslType *)memory_add(&tree->types, &tree->type_count, &tree->type_room,
                                sizeof(GlslType)) =
            (GlslType){.name = tree->types[type].name, .element = type, .length = value->count};
    *(GlslSymbol *)memory_add(&tree->symbols, &tree->symbol_count, &tree->symbol_room,
                              sizeof(GlslSymbol)) = (GlslSymbol){.name = value->name,
                                                                 .kind = GLSL_VARIABLE,
                                                                 .storage = GLSL_UNIFORM,
                                                                 .type = array ? array : type};
}

/* 0: none. */
static int symbol_named(const GlslTree *tree, const char *name)
{
    int found = 0;
    for (int i = 1; i < tree->symbol_count && !found; i++)
        found = strcmp(tree->symbols[i].name, name) == 0 ? i : 0;
    return found;
}

char *right_undeclared(const Points *points, GlslTree *tree, const GlslTree *other)
{
    char *text = memory_text("");
    const PointSetting *setting = &points->settings[0];
    for (int i = 0; i < setting->value_count; i++) {
        const BindingValue *value = &setting->values[i];
        if (value->size == 0 || strpbrk(value->name, " .[") || symbol_named(tree, value->name))
            continue;
        const int twin = other ? symbol_named(other, value->name) : 0;
        const int type = twin && other->symbols[twin].type == GLSL_VEC4 ? GLSL_VEC4
                         : value->size == 16                            ? GLSL_MAT4
                         : value->size == 1                             ? GLSL_FLOAT
                                                                        : GLSL_VEC3;
        char *more = memory_format("%suniform highp %s %s%s;\n", text, tree->types[type].name,
                                   value->name, value->count > 1 ? "[2]" : "");
        if (type != GLSL_MAT4) /* too alike */
            add_symbol(tree, value, type);
        free(text);
        text = more;
    }
    return text;
}

char *right_declare(const char *declarations, const char *text)
{
    const int version = (int)strcspn(text, "\n") + 1; /* comes first */
    return memory_format("%.*s%s%s", version, text, declarations, text + version);
}

/* What differs from the tree's text: uniforms that are declared, and a vertex shader whose normals
 * are normalized in the fragment shader only, if the submission's are. */
static char *make_text(const Derivation *all, GlslTree *tree)
{
    char *rest = right_undeclared(&all->points, tree, NULL), *body = glsl_print(tree, tree->root);
    char *at = strstr(body, "v_Normal = normalize(");
    if (tree->stage == GLSL_VERTEX && at && !normalizes(all->own[0].tree, all->own[0].tree->root))
        memcpy(at + strlen("v_Normal = "), "         ", strlen("normalize"));
    char *text = right_declare(rest, body);
    free(rest);
    free(body);
    return text;
}

bool right_open(Derivation *all, const char *ending)
{
    /* A lab that is read from its folder has its own. */
    const bool own = all->lab->solution_count > 0;
    const ShaderLoader loader = {.precision = "highp",
                                 .texts = own ? all->lab->solutions[0].texts : NULL,
                                 .only_texts = own};
    char folder[PATH_MAX] = "";
    if (!own)
        snprintf(folder, sizeof folder, "labs/solutions/%s/", all->lab->name);
    for (int i = 0; i < 2; i++) {
        ShaderSource source;
        if (!derivation_read(all->lab, &loader, folder, i, i == 0 ? "" : ending, &source))
            return false;
        GlslTree *tree = glsl_parse(source.text, (GlslStage)i, NULL);
        char *text = make_text(all, tree);
        const bool opened = point_shader_open(&all->right[i], text, (GlslStage)i);
        free(text);
        glsl_tree_free(tree);
        shader_source_close(&source);
        if (!opened)
            return false;
    }
    return true;
}

double derivation_run(Derivation *all, PointShader pair[2], Numbers numbers, Numbers wanted)
{
    double sum = 0;
    for (int i = 0; i < all->points.count; i++) {
        points_run(&all->points, &pair[0], &pair[1], i, numbers[i]);
        all->noted |= !wanted && pair[0].run->note_count + pair[1].run->note_count > 0;
        sum += wanted ? points_apart(numbers[i], wanted[i]) : 0;
    }
    return sum;
}

/* Numbers that a right program may choose: what a task leaves open. A name is none. */
static bool is_free(const Lab *lab, const Mutation *mutation, double *number)
{
    const char *was = mutation->was, *by = mutation->by + (mutation->by[0] == '(');
    char *end;
    *number = strtod(by, &end);
    return end > by && (!*end || *end == ')') &&
           ((lab->fitted && strcmp(was, "1.3") == 0 &&
             (*number == 0 || (*number > 0.5 && *number < 2))) ||
            (lab->shadow && strcmp(was, "0.002") == 0 && *number > 0.0004 && *number < 0.0065));
}

/* Whether the text adds or subtracts the number. */
static bool adds(const GlslTree *tree, double number)
{
    bool found = false;
    for (int i = 1; i < tree->node_count && !found; i++) {
        const GlslNode *at = &tree->nodes[i];
        const bool sum = at->kind == GLSL_BINARY && (at->op == GLSL_ADD || at->op == GLSL_SUBTRACT);
        for (int k = sum ? at->first : 0; k && !found; k = tree->nodes[k].next)
            found = tree->nodes[k].constant && tree->nodes[k].type == GLSL_FLOAT &&
                    fabs(tree->values[tree->nodes[k].value] - number) < 1e-9;
    }
    return found;
}

/* A number that the submission adds is its own; else 0, as if it were left out. */
static double expected(const Derivation *all, double number)
{
    return number == 0                                                        ? 1e6
           : adds(all->own[0].tree, number) || adds(all->own[1].tree, number) ? 2e6
                                                                              : 0;
}

/* Keeps a right program with another of these numbers if it is nearer to the submission. */
static bool try_right(void *context, const Mutation *mutation, const char *text)
{
    Derivation *all = context;
    PointShader pair[2] = {all->right[0], {.setting = -1}};
    double number;
    if (!is_free(all->lab, mutation, &number) || expected(all, number) == 0 ||
        !point_shader_open(&pair[1], text, GLSL_FRAGMENT))
        return true;
    const double apart = derivation_run(all, pair, all->exact, all->wanted) - expected(all, number);
    const double was =
        all->nearest_right - (all->nearest_text ? 0 : expected(all, atof(mutation->was)));
    if (apart < was) {
        all->nearest_right = apart;
        free(all->nearest_text);
        all->nearest_text = memory_text(text);
    }
    point_shader_close(&pair[1]);
    return true;
}

/* Light at the point itself, or interpolated from the corners. */
static void light_at_once(Derivation *all, bool at_once)
{
    if (all->right[0].done) /* else it has not run */
        memset(all->right[0].done, 0, (size_t)all->points.count * sizeof(bool));
    all->right[0].at_once = at_once;
}

static void add_right(Derivation *all, PointShader pair[2])
{
    if (all->right_count == MAX_RIGHTS)
        return;
    Numbers numbers = memory_new((size_t)all->points.count, sizeof *numbers);
    derivation_run(all, pair, numbers, all->wanted);
    all->rights[all->right_count++] = numbers;
}

static bool add_free(void *context, const Mutation *mutation, const char *text)
{
    Derivation *all = context;
    PointShader pair[2] = {all->right[0], {.setting = -1}};
    double number;
    if (is_free(all->lab, mutation, &number) && point_shader_open(&pair[1], text, GLSL_FRAGMENT)) {
        add_right(all, pair);
        point_shader_close(&pair[1]);
    }
    return true;
}

bool right_run_all(Derivation *all)
{
    if (!right_open(all, ""))
        return false;
    for (int at_once = 0; at_once <= (int)all->lab->either; at_once++) {
        light_at_once(all, at_once);
        add_right(all, all->right);
    }
    if (all->lab->fitted || all->lab->shadow)
        mutations_each(all->right[1].tree, NULL, all->numbers, all->number_count, add_free, all);
    return true;
}

void right_run(Derivation *all, LitAt lit)
{
    all->nearest_right = INFINITY;
    for (int at_once = 0; at_once <= (int)all->lab->either; at_once++) {
        light_at_once(all, at_once);
        const double apart = derivation_run(all, all->right, all->exact, all->wanted);
        if (lit == LIT_NEAREST && apart < all->nearest_right) {
            all->nearest_right = apart;
            all->nearest_light = at_once;
        }
    }
    if (lit != LIT_NEAREST)
        all->nearest_light = lit == LIT_AT_POINTS;
    light_at_once(all, all->nearest_light);
    all->nearest_right = derivation_run(all, all->right, all->exact, all->wanted);
    if (all->lab->fitted || all->lab->shadow)
        mutations_each(all->right[1].tree, NULL, all->numbers, all->number_count, try_right, all);
    if (all->nearest_text) {
        point_shader_close(&all->right[1]);
        point_shader_open(&all->right[1], all->nearest_text, GLSL_FRAGMENT);
    }
    derivation_run(all, all->right, all->exact, NULL);
}

void right_close(Derivation *all)
{
    for (int i = 0; i < 2; i++)
        point_shader_close(&all->right[i]);
    free(all->nearest_text);
    all->nearest_text = NULL;
}
