/* Values are compared as numbers, not as names: what a submission calls l, the right program calls
 * lightDirection. */
#include "labs/diagnosis/derivation.h"
#include "labs/diagnosis/mutation_forms.h"

#include "base/memory.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whether a part of an array or a structure is what it was when the whole was assigned last. */
static bool is_kept(const Values *values, const Assigned *part)
{
    int i = values->count - 1;
    while (i >= 0 && (values->items[i].symbol != part->symbol ||
                      values->items[i].stage != part->stage || values->items[i].part != part->part))
        i--;
    return i >= 0 && memcmp(values->items[i].numbers, part->numbers, sizeof part->numbers) == 0;
}

/* Of an array or a structure each part that changes, but not what those have in turn. */
static void take_events(const PointShader *shader, GlslStage stage, Values *values)
{
    const GlslTree *tree = shader->tree;
    for (int i = 0; i < shader->run->event_count; i++) {
        const GlslEvent *event = &shader->run->events[i];
        const int whole = tree->symbols[event->symbol].type;
        const GlslType *of = &tree->types[whole];
        const bool parted = of->scalars == event->count && (of->element || of->fields);
        for (int part = 0, used = 0; used < event->count && values->count < MAX_VALUES; part++) {
            const int type = !parted       ? whole
                             : of->element ? of->element
                                           : tree->fields[of->field + part].type;
            const int size = parted ? tree->types[type].scalars : event->count;
            if (size <= 4) {
                Assigned value = {.size = size,
                                  .scalar = glsl_scalar(type),
                                  .node = event->node,
                                  .symbol = event->symbol,
                                  .part = parted ? part + 1 : 0,
                                  .stage = stage};
                memcpy(value.numbers, &shader->run->values[event->value + used],
                       (size_t)size * sizeof(double));
                if (!parted || !is_kept(values, &value))
                    values->items[values->count++] = value;
            }
            used += size;
        }
    }
}

void values_trace(const Points *points, PointShader *vertex, PointShader *fragment, int point,
                  Values *values)
{
    double numbers[POINT_NUMBERS];
    vertex->run->trace = fragment->run->trace = true;
    values->count = 0;
    if (vertex->done)
        vertex->done[point] = false;
    points_run(points, vertex, fragment, point, numbers);
    take_events(vertex, GLSL_VERTEX, values);
    take_events(fragment, GLSL_FRAGMENT, values);
    vertex->run->trace = fragment->run->trace = false;
}

bool values_in_eye(PointShader *const pair[2])
{
    return derivation_uses(pair[0]->tree, "u_ModelViewMatrix") ||
           derivation_uses(pair[0]->tree, "u_EyeNormalMatrix") ||
           derivation_uses(pair[1]->tree, "u_ModelViewMatrix") ||
           derivation_uses(pair[1]->tree, "u_EyeNormalMatrix");
}

int values_given(const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    return at->kind == GLSL_VARIABLE_NODE ? at->first : tree->nodes[at->first].next;
}

void values_trace_right(const Points *points, PointShader *const pair[2], int point, bool in_eye,
                        Values *values)
{
    const PointSetting *setting = &points->settings[points->items[point].setting];
    const float *m = points_value(setting, "u_ViewMatrix");
    values_trace(points, pair[0], pair[1], point, values);
    for (int i = 0, count = values->count; i < 2 * count && in_eye; i++) {
        const double *v = values->items[i / 2].numbers;
        if (values->items[i / 2].size < 3 || values->count == MAX_VALUES)
            continue;
        Assigned *turned = &values->items[values->count++];
        *turned = values->items[i / 2];
        for (int k = 0; k < 4; k++)
            turned->numbers[k] =
                m[k] * v[0] + m[4 + k] * v[1] + m[8 + k] * v[2] + (i % 2 ? m[12 + k] : 0);
    }
}

bool values_equal(const Values *own, int number, const Values *other, int other_number)
{
    const double *a = own->items[number].numbers, *b = other->items[other_number].numbers;
    const int size = own->items[number].size, other_size = other->items[other_number].size;
    bool same = (size == other_size || (size >= 3 && other_size >= 3)) &&
                own->items[number].scalar == other->items[other_number].scalar;
    for (int c = 0; c < size && c < other_size && same; c++)
        same = fabs(a[c] - b[c]) <= 1e-5 * (1 + fabs(a[c]));
    return same;
}

bool values_have(const Values *values, const Values *of, int number)
{
    bool found = false;
    for (int i = 0; i < values->count && !found; i++)
        found = values_equal(of, number, values, i);
    return found;
}

int values_shared(const Values *own, const Values *other)
{
    int shared = 0;
    for (int i = 0; i < own->count; i++)
        shared += values_have(other, own, i);
    return shared;
}

bool values_is_wrong(const Values *own, int number, const Values *mutant, const Values *right)
{
    return values_have(mutant, own, number) && !values_have(right, own, number);
}

bool values_differ(const Values *own, int number, const Values *other, int other_number)
{
    const double *a = own->items[number].numbers, *b = other->items[other_number].numbers;
    bool differ = false;
    for (int i = 0; i < own->items[number].size; i++)
        differ |= fabs(a[i] - b[i]) > 1e-4 * fmax(1, fabs(b[i]));
    return differ;
}

enum { BAG = 1024 };

static void fill_bag(const GlslTree *tree, int node, int bag[BAG], int by)
{
    const GlslNode *at = &tree->nodes[node];
    char text[64] = "";
    if (at->kind == GLSL_BUILT_IN)
        snprintf(text, sizeof text, "%d()", GLSL_FUNCTIONS[at->symbol].id);
    else if (at->kind == GLSL_BINARY || at->kind == GLSL_UNARY || at->kind == GLSL_SWIZZLE)
        snprintf(text, sizeof text, "%d %d", at->kind, at->op);
    else if (at->kind == GLSL_LITERAL)
        snprintf(text, sizeof text, "%g", tree->values[at->value]);
    else if (at->kind == GLSL_NAME && tree->symbols[at->symbol].storage >= GLSL_ATTRIBUTE &&
             tree->symbols[at->symbol].storage <= GLSL_UNIFORM)
        snprintf(text, sizeof text, "%.60s", tree->symbols[at->symbol].name);
    if (text[0])
        bag[text_hash(text, strlen(text)) % BAG] += by;
    for (int i = at->first; i; i = tree->nodes[i].next)
        fill_bag(tree, i, bag, by);
}

int values_count_other(const GlslTree *a, const GlslTree *b)
{
    int bag[BAG] = {0}, sum = 0;
    fill_bag(a, a->root, bag, 1);
    fill_bag(b, b->root, bag, -1);
    for (int i = 0; i < BAG; i++)
        sum += abs(bag[i]);
    return sum;
}

/* What a sentence shows: of a number, which alone says nothing, the expression that it is in. */
static int shown_at(const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    const int above = at->kind == GLSL_LITERAL ? forms_parent(tree, node) : 0;
    return at->kind == GLSL_VARIABLE_NODE || at->kind == GLSL_EXPRESSION ? at->first
           : above > 0 && tree->nodes[above].kind <= GLSL_CONSTRUCT      ? above
                                                                         : node;
}

bool derivation_uses(const GlslTree *tree, const char *name)
{
    bool found = false;
    for (int i = 1; i < tree->node_count && !found; i++)
        found = tree->nodes[i].kind == GLSL_NAME &&
                strcmp(tree->symbols[tree->nodes[i].symbol].name, name) == 0;
    return found;
}

void derivation_place(const Derivation *all, GlslStage stage, int node, char *text, size_t size)
{
    const GlslTree *tree = all->own[stage].tree;
    const GlslNode *at = &tree->nodes[node];
    const ShaderSource *source = &all->sources[stage];
    const int file =
        at->place.file >= 0 && at->place.file < source->file_count ? at->place.file : 0;
    const char *path = source->file_count ? source->files[file] : "", *slash = strrchr(path, '/');
    char code[512];
    const bool named = at->kind == GLSL_VARIABLE_NODE;
    glsl_expression_text(tree, shown_at(tree, node), code, sizeof code);
    text_shorten(code, 76);
    snprintf(text, size, "line %d of %s: %s%s%s", at->place.line, slash ? slash + 1 : path,
             named ? tree->symbols[at->symbol].name : "", named ? " = " : "", code);
}

/* Lines that a backslash continues, which drivers accept, become one; what follows keeps its
 * number, and the text its length. */
static void join_lines(char *text)
{
    int joined = 0;
    char *to = text;
    for (const char *at = text; *at; at++) {
        if (at[0] == '\\' && at[1] == '\n') {
            *to++ = ' ';
            at++, joined++;
            continue;
        }
        *to++ = *at;
        for (; *at == '\n' && joined > 0; joined--)
            *to++ = '\n';
    }
    *to = '\0';
}

/* Functions that the submission has as they are in the starter. */
static void find_given(Derivation *all, int stage)
{
    char folder[PATH_MAX];
    const ShaderLoader loader = {.folder = folder, .precision = "highp"};
    const GlslTree *own = all->own[stage].tree;
    ShaderSource source;
    if (!lab_folder(all->lab, folder, NULL) ||
        !derivation_read(all->lab, &loader, "", stage, "", &source))
        return;
    GlslTree *starter = glsl_parse(source.text, (GlslStage)stage, NULL);
    char *whole = glsl_print(starter, starter->root);
    for (int i = own->nodes[own->root].first; i && all->given_count[stage] < MAX_GIVEN;
         i = own->nodes[i].next) {
        char *text = glsl_print(own, i);
        const bool function = own->nodes[i].kind == GLSL_FUNCTION_NODE;
        if (function && own->nodes[i].symbol != own->main && strstr(whole, text))
            all->given[stage][all->given_count[stage]++] = i;
        free(text);
    }
    free(whole);
    glsl_tree_free(starter);
    shader_source_close(&source);
}

static bool open_own(Derivation *all, const SubmissionFiles *files)
{
    const ShaderLoader loader = {.texts = files->texts, .only_texts = true, .precision = "highp"};
    for (int i = 0; i < 2; i++) {
        if (!derivation_read(all->lab, &loader, "", i, "", &all->sources[i]))
            return false;
        join_lines(all->sources[i].text);
        if (!point_shader_open(&all->own[i], all->sources[i].text, (GlslStage)i))
            return false;
        find_given(all, i);
    }
    return true;
}

/* Whether the pair draws at all points, with a map of this byte, what the submission draws. */
static bool is_same_with_map(Derivation *all, PointShader pair[2], int byte)
{
    const size_t size = (size_t)LAB_SHADOW_MAP_SIZE * LAB_SHADOW_MAP_SIZE * 4;
    unsigned char *map = memset(memory_new(size, 1), byte, size);
    bool same = true;
    for (int i = 0; i < all->points.count && same; i++) {
        double numbers[POINT_NUMBERS];
        PointSetting *setting = &all->points.settings[all->points.items[i].setting];
        unsigned char *was = setting->map;
        setting->map = map;
        points_run(&all->points, &pair[0], &pair[1], i, numbers);
        setting->map = was;
        same = points_apart(numbers, all->wanted[i]) <= DERIVATION_EQUAL;
    }
    free(map);
    return same;
}

bool derivation_wastes_map(Derivation *all)
{
    return all->reads_map &&
           (is_same_with_map(all, all->right, 255) ||
            (is_same_with_map(all, all->own, 255) && is_same_with_map(all, all->own, 0)));
}

Derivation *derivation_open(const LabPictures *pictures, const SubmissionFiles *files,
                            Message *message)
{
    Derivation *all = memory_new(1, sizeof *all);
    all->lab = pictures->lab;
    all->files = files;
    all->pictures = pictures;
    /* Half a step is for rounding. A shadow is all or nothing. */
    all->tolerance = pictures->lab->shadow ? DERIVATION_EQUAL
                                           : (lab_pictures_tolerance(pictures, 0) - 0.5) / 255;
    if (!points_open(&all->points, pictures, message) || !open_own(all, files)) {
        derivation_close(all);
        return NULL;
    }
    const size_t count = (size_t)all->points.count;
    all->wanted = memory_new(count, sizeof *all->wanted);
    all->exact = memory_new(count, sizeof *all->exact);
    all->order = memory_new(count, sizeof *all->order);
    derivation_run(all, all->own, all->wanted, NULL);
    all->in_eye = values_in_eye((PointShader *[]){&all->own[0], &all->own[1]});
    for (int i = 0; i < all->points.setting_count; i++)
        all->reads_map |= all->points.settings[i].map_read;
    return all;
}

void derivation_close(Derivation *all)
{
    if (!all)
        return;
    right_close(all);
    for (int i = 0; i < 2; i++) {
        point_shader_close(&all->own[i]);
        shader_source_close(&all->sources[i]);
    }
    for (int i = 0; i < all->right_count; i++)
        free(all->rights[i]);
    free(all->undeclared[0]);
    free(all->undeclared[1]);
    free(all->best.text);
    free(all->mending.text);
    free(all->second.text);
    points_close(&all->points);
    free(all->wanted);
    free(all->exact);
    free(all->order);
    free(all);
}
