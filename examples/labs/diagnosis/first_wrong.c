/* The submission and what it becomes by the change that makes it right run at the point where it is
 * most wrong. The first assignment whose value is another is where the mistake shows first. */
#include "labs/diagnosis/derivation.h"

#include "base/memory.h"

#include <math.h>
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

/* Two changes of one stage are both in the second's text. */
void first_wrong_find(Derivation *all, Verdict *verdict, FirstWrong *first)
{
    const Found *changes[2] = {&all->mending, all->mended_twice ? &all->second : NULL};
    PointShader opened[2] = {{.setting = -1}, {.setting = -1}};
    PointShader *pair[2] = {&all->own[0], &all->own[1]};
    Values *own = memory_new(2, sizeof *own), *right = own + 1;
    const char *text = NULL;
    bool other = false;
    for (int i = 0; i < 2 && changes[i]; i++) {
        all->stage = changes[i]->stage;
        if (mend_open(all, changes[i]->text, true, &opened[i]))
            pair[all->stage] = &opened[i];
        text = changes[i]->text;
    }
    values_trace(&all->points, &all->own[0], &all->own[1], all->order[0], own);
    values_trace(&all->points, pair[0], pair[1], all->order[0], right);
    for (int i = 0; i < own->count && i < right->count && !other; i++) {
        const GlslStage stage = own->items[i].stage;
        const char *name = all->own[stage].tree->symbols[own->items[i].symbol].name;
        const int size = own->items[i].size;
        const PointShader *mended = pair[stage];
        char place[VERDICT_SENTENCE_SIZE], where[100] = "", is[80], should[80];
        /* It went on elsewhere: the result is left, which is the last. */
        if (strcmp(name, mended->tree->symbols[right->items[i].symbol].name) != 0) {
            const int last = own->count - 1;
            right->items[last] = right->items[right->count - 1];
            right->count = i < last ? own->count : 0;
            i = i < last ? last - 1 : i;
            continue;
        }
        other = values_differ(own, right, i);
        if (!other)
            continue;
        put_place(all, all->order[0], where);
        put_numbers(own->items[i].numbers, size, is);
        put_numbers(right->items[i].numbers, size, should);
        derivation_place(all, stage, own->items[i].node, place, sizeof place);
        verdict_add_symptom(verdict,
                            "Wrong first, where it is worst%s: %s is %s; right is %s. See %s.",
                            where, name, is, should, place);
        /* A colour is seen anyway; and where two shaders change, no single one is right. */
        if (strncmp(name, "gl_", 3) == 0 || (changes[1] && changes[0]->stage != changes[1]->stage))
            continue;
        *first = (FirstWrong){.stage = (int)all->stage,
                              .right = right_declare(all->undeclared[all->stage], text)};
        snprintf(first->name, sizeof first->name, "%s", name);
    }
    point_shader_close(&opened[0]);
    point_shader_close(&opened[1]);
    free(own);
}
