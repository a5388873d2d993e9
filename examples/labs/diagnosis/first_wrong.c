/* The submission and what it becomes by the change that makes it right run at the point where it is
 * most wrong. The first assignment whose value is another is where the mistake shows first. */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_numbers(const double *numbers, int count, char text[80])
{
    for (int i = 0, used = 0; i < count; i++)
        used += snprintf(text + used, 80 - (size_t)used, "%s%.4g", i ? ", " : "", numbers[i]);
}

/* Where the point is in its picture, if its scene is the same for every seed. */
static void put_place(const Derivation *all, int point, char text[100])
{
    const PointSetting *setting = &all->points.settings[all->points.items[point].setting];
    double place[3];
    points_place(&all->points, point, place);
    if (setting->scene)
        snprintf(text, 100, ", in scene %s (known), column %d, row %d from the top", setting->scene,
                 (int)(setting->width * (place[0] + 1) / 2),
                 (int)(setting->height * (1 - place[1]) / 2));
}

static const char *name_of(PointShader *const pair[2], const Values *values, int number)
{
    return pair[values->items[number].stage]->tree->symbols[values->items[number].symbol].name;
}

/* What a submission and a right program assign on their way. */
typedef struct Ways {
    PointShader *own_pair[2], *pair[2];
    Values own, right;
} Ways;

static bool is_same_variable(const Ways *ways, int number)
{
    return ways->own.items[number].stage == ways->right.items[number].stage &&
           strcmp(name_of(ways->own_pair, &ways->own, number),
                  name_of(ways->pair, &ways->right, number)) == 0;
}

/* The first value that differs; -1: none. Where one goes on elsewhere than the other only the
 * results are left, which are the last. */
static int first_apart(Ways *ways)
{
    const int last = ways->own.count - 1, right_last = ways->right.count - 1;
    int i = 0;
    for (; i <= last && i <= right_last && is_same_variable(ways, i); i++)
        if (values_differ(&ways->own, &ways->right, i))
            return i;
    if (i >= last || i > right_last)
        return -1;
    ways->right.items[last] = ways->right.items[right_last];
    return is_same_variable(ways, last) && values_differ(&ways->own, &ways->right, last) ? last
                                                                                         : -1;
}

/* Says it; returns its name. */
static const char *tell(const Derivation *all, const Ways *ways, int number, Verdict *verdict)
{
    const char *name = name_of(ways->own_pair, &ways->own, number);
    const int size = ways->own.items[number].size, node = ways->own.items[number].node;
    char place[VERDICT_SENTENCE_SIZE], where[100] = "", is[80], should[80];
    put_place(all, all->order[0], where);
    put_numbers(ways->own.items[number].numbers, size, is);
    put_numbers(ways->right.items[number].numbers, size, should);
    derivation_place(all, ways->own.items[number].stage, node, place, sizeof place);
    verdict_add_symptom(verdict, "Wrong first, where it is worst%s: %s is %s; right is %s. See %s.",
                        where, name, is, should, place);
    return name;
}

/* Two changes of one stage are both in the second's text. */
void first_wrong_find(Derivation *all, Verdict *verdict, FirstWrong *first)
{
    const Found *changes[2] = {&all->mending, all->mended_twice ? &all->second : NULL};
    PointShader opened[2] = {{.setting = -1}, {.setting = -1}};
    Ways *ways = memory_new(1, sizeof *ways);
    const char *text = NULL;
    for (int i = 0; i < 2; i++)
        ways->pair[i] = ways->own_pair[i] = &all->own[i];
    for (int i = 0; i < 2 && changes[i]; i++) {
        all->stage = changes[i]->stage;
        if (mend_open(all, changes[i]->text, true, &opened[i]))
            ways->pair[all->stage] = &opened[i];
        text = changes[i]->text;
    }
    values_trace(&all->points, ways->own_pair[0], ways->own_pair[1], all->order[0], &ways->own);
    values_trace(&all->points, ways->pair[0], ways->pair[1], all->order[0], &ways->right);
    const int found = first_apart(ways);
    const char *name = found >= 0 ? tell(all, ways, found, verdict) : NULL;
    /* A colour is seen anyway; and where two shaders change, no single one is right. */
    if (name && strncmp(name, "gl_", 3) != 0 &&
        !(changes[1] && changes[0]->stage != changes[1]->stage)) {
        *first = (FirstWrong){.stage = (int)all->stage,
                              .right = right_declare(all->undeclared[all->stage], text)};
        snprintf(first->name, sizeof first->name, "%s", name);
    }
    point_shader_close(&opened[0]);
    point_shader_close(&opened[1]);
    free(ways);
}
