/* Of a right program all mutants are run at the same points as the submission, those first where
 * the submission is farthest from right, so that nearly all are ruled out by one or two points.
 * What is left computes the same numbers at hundreds of points. If several do, that one is named
 * which has most of the submission's values on its way: a light whose direction is reversed draws
 * what a reversed normal draws, but only one of the two is among the submission's values. */
#include "labs/diagnosis/derive.h"

#include "base/memory.h"
#include "core/shader_source.h"
#include "labs/diagnosis/mutation.h"
#include "labs/diagnosis/points.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Equal formulas differ by 1e-12; constants like 3.14159, or guards like + 0.0001, by more. A match
 * leaves at most a hundredth of the submission's error. */
static const double EQUAL = 2e-4, LEFT = 0.01, ALIKE = 1e-6;

enum { MAX_FOUND = 40, TRACED = 6, MAX_VALUES = 400 };

typedef struct Found {
    Mutation mutation;
    GlslStage stage;
    char *text;
    double apart;
    int shared; /* of the submission's values */
} Found;

typedef struct Derivation {
    const Lab *lab;
    Points points;
    PointShader own[2], right[2]; /* by GlslStage */
    ShaderSource sources[2];      /* the submission's */
    double (*wanted)[POINT_NUMBERS], (*exact)[POINT_NUMBERS];
    int *order; /* of the points: where it is farthest from right, and where it is right, in turn */
    double wrong_by;
    double numbers[MUTATION_NUMBERS];
    int number_count;
    GlslStage stage; /* that is mutated */
    Found found[MAX_FOUND];
    int found_count, tried;
} Derivation;

static bool read_source(const Lab *lab, const ShaderLoader *loader, const char *folder, int stage,
                        ShaderSource *source)
{
    char name[128];
    snprintf(name, sizeof name, "%s%s.%s", folder, lab->file, stage == 0 ? "vert" : "frag");
    return shader_source_open(source, loader, name, (ShaderStage)stage, NULL);
}

static bool open_own(Derivation *all, const SubmissionFiles *files)
{
    const ShaderLoader loader = {
        .texts = files->texts, .only_texts = true, .precision = "highp"};
    for (int i = 0; i < 2; i++)
        if (!read_source(all->lab, &loader, "", i, &all->sources[i]) ||
            !point_shader_open(&all->own[i], all->sources[i].text, (GlslStage)i))
            return false;
    return true;
}

/* The interface's uniforms that a right program does not use, but a mutant may. */
static char *declare_rest(const Points *points, const GlslTree *tree)
{
    char *text = memory_text("");
    const PointSetting *setting = &points->settings[0];
    for (int i = 0; i < setting->value_count; i++) {
        const BindingValue *value = &setting->values[i];
        bool known = value->size == 0;
        for (int k = 1; k < tree->symbol_count; k++)
            known |= strcmp(tree->symbols[k].name, value->name) == 0;
        if (known)
            continue;
        char *more = memory_format(
            "%suniform highp %s %s%s;\n", text,
            value->size == 16  ? "mat4"
            : value->size == 1 ? "float"
                               : "vec3",
            value->name, value->count > 1 ? "[2]" : "");
        free(text);
        text = more;
    }
    return text;
}

static bool open_right(Derivation *all)
{
    const ShaderLoader loader = {.precision = "highp"};
    char folder[96];
    snprintf(folder, sizeof folder, "labs/solutions/%s/", all->lab->name);
    for (int i = 0; i < 2; i++) {
        ShaderSource source;
        if (!read_source(all->lab, &loader, folder, i, &source))
            return false;
        GlslTree *tree = glsl_parse(source.text, (GlslStage)i, NULL);
        char *rest = declare_rest(&all->points, tree), *body = glsl_print(tree, tree->root);
        const int version = (int)strcspn(body, "\n") + 1; /* comes first */
        char *text = memory_format("%.*s%s%s", version, body, rest, body + version);
        const bool opened = point_shader_open(&all->right[i], text, (GlslStage)i);
        free(text);
        free(body);
        free(rest);
        glsl_tree_free(tree);
        shader_source_close(&source);
        if (!opened)
            return false;
    }
    return true;
}

/* Constants of a shader that may be a mistake's numbers: they and their reciprocals. */
static void take_number(Derivation *all, double number)
{
    number = fabs(number);
    for (int i = 0; i < all->number_count; i++)
        if (fabs(all->numbers[i] - number) <= 1e-9 * number)
            return;
    if (number > 1e-6 && number < 1e6 && number != 1 && all->number_count < MUTATION_NUMBERS)
        all->numbers[all->number_count++] = number;
}

static void take_numbers(Derivation *all, const GlslTree *tree, int node)
{
    const GlslNode *at = &tree->nodes[node];
    if (at->constant && at->type == GLSL_FLOAT)
        take_number(all, tree->values[at->value]);
    for (int i = at->first; i; i = tree->nodes[i].next)
        take_numbers(all, tree, i);
}

static double run_all(Derivation *all, PointShader pair[2], double (*numbers)[POINT_NUMBERS],
                      const double (*wanted)[POINT_NUMBERS])
{
    double sum = 0;
    for (int i = 0; i < all->points.count; i++) {
        points_run(&all->points, &pair[0], &pair[1], i, numbers[i]);
        sum += wanted ? points_apart(numbers[i], wanted[i]) : 0;
    }
    return sum;
}

static bool run_right(Derivation *all)
{
    const double (*wanted)[POINT_NUMBERS] = (const double (*)[POINT_NUMBERS])all->wanted;
    const double corners = run_all(all, all->right, all->exact, wanted);
    if (!all->lab->either)
        return true;
    /* Light at the vertices or not: whichever is nearer. */
    memset(all->right[0].done, 0, (size_t)all->points.count * sizeof(bool));
    all->right[0].at_once = true;
    if (run_all(all, all->right, all->exact, wanted) < corners)
        return true;
    memset(all->right[0].done, 0, (size_t)all->points.count * sizeof(bool));
    all->right[0].at_once = false;
    run_all(all, all->right, all->exact, NULL);
    return true;
}

typedef struct Apart {
    double apart;
    int point;
} Apart;

static int farthest_first(const void *a, const void *b)
{
    const Apart *p = a, *q = b;
    return p->apart != q->apart ? (p->apart < q->apart) - (p->apart > q->apart)
                                : p->point - q->point;
}

static void sort_points(Derivation *all)
{
    const int count = all->points.count;
    Apart *list = memory_new((size_t)count, sizeof *list);
    for (int i = 0; i < count; i++)
        list[i] = (Apart){points_apart(all->wanted[i], all->exact[i]), i};
    qsort(list, (size_t)count, sizeof *list, farthest_first);
    all->wrong_by = list[0].apart;
    for (int i = 0; i < count; i++)
        all->order[i] = list[i % 2 ? count - 1 - i / 2 : i / 2].point;
    free(list);
}

static double limit_of(const Derivation *all)
{
    return fmax(EQUAL, LEFT * fmin(all->wrong_by, 0.4));
}

/* How far the pair is from the submission; more than the limit: it is not looked at further. */
static double distance(Derivation *all, PointShader *vertex, PointShader *fragment)
{
    const double limit = limit_of(all);
    double most = 0, numbers[POINT_NUMBERS];
    for (int i = 0; i < all->points.count && most <= limit; i++) {
        const int point = all->order[i];
        points_run(&all->points, vertex, fragment, point, numbers);
        most = fmax(most, points_apart(numbers, all->wanted[point]));
    }
    return most;
}

static bool try_mutant(void *context, const Mutation *mutation, const char *text)
{
    Derivation *all = context;
    PointShader shader;
    all->tried++;
    if (!point_shader_open(&shader, text, all->stage))
        return true;
    shader.at_once = all->stage == GLSL_VERTEX && all->right[0].at_once;
    const double apart = all->stage == GLSL_VERTEX ? distance(all, &shader, &all->right[1])
                                                   : distance(all, &all->right[0], &shader);
    if (apart <= limit_of(all))
        all->found[all->found_count++] =
            (Found){*mutation, all->stage, memory_text(text), apart, 0};
    point_shader_close(&shader);
    return all->found_count < MAX_FOUND;
}

/* Values on the way. */

typedef struct Values {
    double numbers[MAX_VALUES][4];
    int sizes[MAX_VALUES], lines[MAX_VALUES], count;
} Values;

static void take_events(Values *values, GlslRun *run)
{
    for (int i = 0; i < run->event_count && values->count < MAX_VALUES; i++) {
        const GlslEvent *event = &run->events[i];
        if (event->count > 4)
            continue;
        values->sizes[values->count] = event->count;
        values->lines[values->count] = run->code->tree->nodes[event->node].place.line;
        memcpy(values->numbers[values->count++], &run->values[event->value],
               (size_t)event->count * sizeof(double));
    }
}

/* What both shaders assign at a point: at its last corner, and there. */
static void trace(Derivation *all, PointShader *vertex, PointShader *fragment, int point,
                  Values *values)
{
    double numbers[POINT_NUMBERS];
    vertex->run->trace = fragment->run->trace = true;
    values->count = 0;
    points_run(&all->points, vertex, fragment, point, numbers);
    if (vertex->done)
        vertex->done[point] = false;
    points_run(&all->points, vertex, fragment, point, numbers);
    take_events(values, vertex->run);
    take_events(values, fragment->run);
    vertex->run->trace = fragment->run->trace = false;
}

static bool same_value(const Values *a, int i, const Values *b, int k)
{
    if (a->sizes[i] != b->sizes[k] && (a->sizes[i] < 3 || b->sizes[k] < 3))
        return false;
    for (int c = 0; c < a->sizes[i] && c < b->sizes[k]; c++)
        if (!(fabs(a->numbers[i][c] - b->numbers[k][c]) <= 1e-5 * (1 + fabs(a->numbers[i][c]))))
            return false;
    return true;
}

static int count_shared(const Values *own, const Values *other)
{
    int shared = 0;
    for (int i = 0; i < own->count; i++) {
        bool found = false;
        for (int k = 0; k < other->count && !found; k++)
            found = same_value(own, i, other, k);
        shared += found;
    }
    return shared;
}

/* Opens a mutant again, beside the right program's other stage. */
static bool open_found(Derivation *all, const Found *found, PointShader *shader)
{
    if (!point_shader_open(shader, found->text, found->stage))
        return false;
    shader->at_once = found->stage == GLSL_VERTEX && all->right[0].at_once;
    return true;
}

static void compare_values(Derivation *all)
{
    static Values own, other; /* too large for a stack */
    for (int i = 0; i < all->found_count; i++) {
        Found *found = &all->found[i];
        PointShader shader;
        if (!open_found(all, found, &shader))
            continue;
        const bool vertex = found->stage == GLSL_VERTEX;
        for (int k = 0; k < TRACED && k < all->points.count; k++) {
            const int point = all->order[2 * k % all->points.count];
            trace(all, &all->own[0], &all->own[1], point, &own);
            trace(all, vertex ? &shader : &all->right[0], vertex ? &all->right[1] : &shader, point,
                  &other);
            found->shared += count_shared(&own, &other);
        }
        point_shader_close(&shader);
    }
}

static const Found *choose(Derivation *all)
{
    const Found *best = NULL;
    double least = 2;
    for (int i = 0; i < all->found_count; i++)
        least = fmin(least, all->found[i].apart);
    compare_values(all);
    for (int i = 0; i < all->found_count; i++) {
        const Found *found = &all->found[i];
        if (found->apart > fmax(4 * least, ALIKE))
            continue;
        if (!best || found->shared > best->shared ||
            (found->shared == best->shared && found->mutation.rank < best->mutation.rank))
            best = found;
    }
    return best;
}

static void say(Derivation *all, const Found *found, Verdict *verdict)
{
    char name[64], sentence[VERDICT_SENTENCE_SIZE];
    const Mutation *mutation = &found->mutation;
    snprintf(name, sizeof name, "%s", mutation->name);
    snprintf(sentence, sizeof sentence,
             "%s%sIt draws what the right program draws with %s instead of %s.",
             mutation->sentence, mutation->sentence[0] ? " " : "",
             mutation->by[0] ? mutation->by : "nothing", mutation->was);
    verdict_add_mistake(verdict, name, sentence, mutation->was, 0.9);
    snprintf(verdict->message, sizeof verdict->message, "%s", mutation->name);
    (void)all;
}

static bool search(Derivation *all)
{
    for (int i = 0; i < 2; i++)
        take_numbers(all, all->own[i].tree, all->own[i].tree->root);
    for (int i = 0, count = all->number_count; i < count; i++)
        take_number(all, 1 / all->numbers[i]);
    all->stage = GLSL_FRAGMENT;
    mutations_each(all->right[1].tree, all->numbers, all->number_count, try_mutant, all);
    all->stage = GLSL_VERTEX;
    if (all->found_count < MAX_FOUND)
        mutations_each(all->right[0].tree, all->numbers, all->number_count, try_mutant, all);
    return all->found_count > 0;
}

static void close_all(Derivation *all)
{
    for (int i = 0; i < 2; i++) {
        point_shader_close(&all->own[i]);
        point_shader_close(&all->right[i]);
        shader_source_close(&all->sources[i]);
    }
    for (int i = 0; i < all->found_count; i++)
        free(all->found[i].text);
    points_close(&all->points);
    free(all->wanted);
    free(all->exact);
    free(all->order);
    free(all);
}

bool derive_name(const LabPictures *pictures, const SubmissionFiles *files, Verdict *verdict,
                 bool *named, Message *message)
{
    Derivation *all = memory_new(1, sizeof *all);
    all->lab = pictures->lab;
    *named = false;
    const bool done = points_open(&all->points, pictures, message);
    if (done && open_own(all, files) && open_right(all)) {
        const size_t count = (size_t)all->points.count;
        all->wanted = memory_new(count, sizeof *all->wanted);
        all->exact = memory_new(count, sizeof *all->exact);
        all->order = memory_new(count, sizeof *all->order);
        run_all(all, all->own, all->wanted, NULL);
        run_right(all);
        sort_points(all);
        if (all->wrong_by > 4 * EQUAL && search(all)) {
            say(all, choose(all), verdict);
            *named = true;
        }
        if (getenv("DERIVE"))
            fprintf(stderr, "derive: %d points, wrong by %g, %d mutants, %d found, %d numbers\n",
                    all->points.count, all->wrong_by, all->tried, all->found_count,
                    all->number_count);
        for (int i = 0; i < all->found_count && getenv("DERIVE"); i++)
            fprintf(stderr, "  %g shared %d rank %d: %s | %s -> %s\n", all->found[i].apart,
                    all->found[i].shared, all->found[i].mutation.rank, all->found[i].mutation.name,
                    all->found[i].mutation.was, all->found[i].mutation.by);
    }
    close_all(all);
    return done;
}
