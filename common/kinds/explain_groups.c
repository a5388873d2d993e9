/* Of many objects: how many have the same effects, and which in a few words. */
#include "base/memory.h"
#include "base/output_text.h"
#include "kinds/scene_views.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Group {
    Effects effects;
    int first, count;
} Group;

static int by_count(const void *a, const void *b)
{
    const Group *one = a, *other = b;
    return one->count != other->count ? other->count - one->count : one->first - other->first;
}

/* "2 point lights (diffuse, specular, attenuation)". */
static void put_lights(const LightGroup *group, FILE *file)
{
    static const char *const kinds[] = {
        [LIGHT_DIRECTIONAL] = "directional", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot"};
    const LightTerms *terms = &group->terms;
    const struct {
        bool has;
        const char *name;
    } parts[] = {{terms->ambient, "ambient"},   {terms->diffuse, "diffuse"},
                 {terms->specular, "specular"}, {terms->attenuation, "attenuation"},
                 {terms->range, "range"},       {terms->exponent, "falloff"},
                 {terms->shadow > 0, "shadow"}, {terms->at_vertex, "at the vertices"}};
    const char *before = " (";
    fprintf(file, "%d %s light%s", group->count, kinds[terms->kind], group->count > 1 ? "s" : "");
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (parts[i].has)
            fprintf(file, "%s%s", before, parts[i].name);
        before = parts[i].has ? ", " : before;
    }
    fputs("), ", file);
}

static void put_effects(const Effects *effects, FILE *file)
{
    if (effects->group_count == 0)
        fputs("no light, ", file);
    for (int i = 0; i < effects->group_count; i++)
        put_lights(&effects->groups[i], file);
    fprintf(file, "%s%s%snormal matrix, %sculled", effects->base ? "base, " : "",
            effects->vertex_color ? "colours of vertices, " : "",
            effects->normal_matrix ? "" : "no ", effects->cull ? "" : "not ");
    fputs(effects->two_sided ? ", two-sided" : "", file);
}

static void print_groups(const Group *groups, int count, int objects)
{
    printf("# %d objects with %d sets of effects\n", objects, count);
    for (int i = 0; i < count; i++) {
        OutputText line;
        output_text_open(&line);
        fprintf(line.file, "%d of %d objects, first object %d: ", groups[i].count, objects,
                groups[i].first);
        put_effects(&groups[i].effects, line.file);
        output_text_wrap(&line, stdout, 2, 100);
        printf("\n");
    }
    printf("\n");
}

/* Of how many objects a light was left out because it does not reach them; of lights that all
 * objects may have. */
static void print_reach(const LightingPlan *plan)
{
    bool any = false;
    const bool many = plan->frame.scene->light_count > EFFECTS_MAX_LIGHTS; /* see explain_reach */
    for (int light = 0; light < plan->light_count && !many; light++) {
        static const char *const why[] = {"are beyond its range", "are missed by its cone",
                                          "turn away from it", "find it too faint"};
        int counts[4] = {0};
        float most = 0;
        for (int i = 0; i < plan->object_count; i++) {
            const ObjectFacts *facts = &plan->objects[i].facts;
            counts[0] += (int)(facts->beyond_range >> light & 1);
            counts[1] += (int)(facts->missed >> light & 1);
            counts[2] += (int)(facts->behind >> light & 1);
            counts[3] += (int)(facts->faint >> light & 1);
            most = fmaxf(most, facts->steps[light]);
        }
        for (int k = 0; k < 4; k++) {
            if (counts[k])
                printf("light %d: %d of %d objects %s", light, counts[k], plan->object_count,
                       why[k]);
            if (counts[k] && k == 3)
                printf(": at most %.1f steps", ceil(10 * (double)most) / 10);
            fputs(counts[k] ? "\n" : "", stdout);
            any |= counts[k] > 0;
        }
    }
    fputs(any ? "\n" : "", stdout);
}

void explain_reach(const LightingPlan *plan)
{
    const int lights = plan->frame.scene->light_count;
    long long counts[REACH_COUNT] = {0};
    double most = 0;
    uint8_t *why = memory_new((size_t)lights + 1, sizeof *why);
    for (int i = 0; i < plan->object_count && lighting_plan_reach(plan, i, why); i++) {
        const ObjectFacts *facts = &plan->objects[i].facts;
        const int faint = __builtin_popcount(facts->faint);
        double steps = memchr(why, REACH_MORE, (size_t)lights) ? 0 : (double)facts->spent;
        for (int light = 0; light < lights; light++)
            counts[why[light]]++;
        counts[REACH_YES] -= faint;
        counts[REACH_FAINT] += faint;
        for (int k = 0; k < EFFECTS_MAX_LIGHTS; k++)
            steps += (double)facts->steps[k];
        most = fmax(most, steps);
    }
    free(why);
    for (int k = 0; k < REACH_COUNT; k++)
        if (counts[k])
            printf("of %d lights and %d objects, %lld times: %s\n", lights, plan->object_count,
                   counts[k], EFFECTS_REACHES[k]);
    if (counts[REACH_FAINT])
        printf("those that are too faint add at most %.2f steps to any pixel\n",
               ceil(100 * most) / 100);
    fputs(lights > EFFECTS_MAX_LIGHTS ? "\n" : "", stdout);
}

bool *explain_groups(const LightingPlan *plan)
{
    Group *groups = NULL;
    int count = 0, room = 0;
    bool *first = memory_new((size_t)plan->object_count + 1, sizeof *first);
    for (int i = 0; i < plan->object_count; i++) {
        Effects effects = lighting_plan_effects(plan, i);
        for (int g = 0; g < effects.group_count; g++) /* whichever lights they are */
            memset(effects.groups[g].lights, 0, sizeof effects.groups[g].lights);
        int k = 0;
        while (k < count && memcmp(&groups[k].effects, &effects, sizeof effects) != 0)
            k++;
        if (k == count) {
            Group *added = memory_add(&groups, &count, &room, sizeof *groups);
            memcpy(&added->effects, &effects, sizeof effects);
            added->first = i;
            added->count = 0;
            first[i] = true;
        }
        groups[k].count++;
    }
    qsort(groups, (size_t)count, sizeof *groups, by_count);
    print_groups(groups, count, plan->object_count);
    print_reach(plan);
    free(groups);
    return first;
}

/* "object 12, Lid: lights 0, 3". */
PanelObject *explain_list(const LightingPlan *plan, int object, const char *name,
                          const char *effects, PanelObjects *objects)
{
    const Effects decided = lighting_plan_effects(plan, object);
    PanelObject *listed =
        memory_add(&objects->all, &objects->count, &objects->room, sizeof *listed);
    uint32_t lights = 0;
    OutputText row, same;
    output_text_open(&row);
    output_text_open(&same);
    put_effects(&decided, same.file);
    fprintf(row.file, "object %d%s%.*s", object, name[0] ? ", " : "", (int)strcspn(name, "\n"),
            name);
    for (int g = 0; g < decided.group_count; g++)
        for (int i = 0; i < decided.groups[g].count; i++)
            lights |= (uint32_t)1 << decided.groups[g].lights[i];
    for (uint32_t left = lights; left; left &= left - 1)
        fprintf(row.file, "%s%d", left == lights ? ": lights " : ", ",
                lighting_plan_facts(plan, object)->numbers[__builtin_ctz(left)]);
    fputs(lights ? "" : ": no light", row.file);
    *listed = (PanelObject){.row = output_text_close(&row),
                            .effects = memory_text(effects),
                            .same = output_text_close(&same),
                            .number = objects->count - 1};
    return listed;
}
