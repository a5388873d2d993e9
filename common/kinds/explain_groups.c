/* Of many objects: how many have the same effects, and which in a few words. */
#include "base/memory.h"
#include "base/text.h"
#include "kinds/explain.h"

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
    } parts[] = {{terms->ambient, "ambient"},          {terms->diffuse, "diffuse"},
                 {terms->specular, "specular"},        {terms->attenuation, "attenuation"},
                 {terms->exponent, "falloff"},         {terms->shadow > 0, "shadow"},
                 {terms->at_vertex, "at the vertices"}};
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
    fputs(effects->two_sided ? ", two-sided\n" : "\n", file);
}

static void print_groups(const Group *groups, int count, int objects)
{
    printf("# %d objects with %d sets of effects\n", objects, count);
    for (int i = 0; i < count; i++) {
        char *line = NULL;
        size_t size = 0;
        FILE *file = open_memstream(&line, &size);
        if (!file)
            return;
        fprintf(file, "%d of %d objects, first object %d: ", groups[i].count, objects,
                groups[i].first);
        put_effects(&groups[i].effects, file);
        fclose(file);
        line[strcspn(line, "\n")] = '\0';
        text_wrap(stdout, line, 0, 2, 100);
        printf("\n");
        free(line);
    }
    printf("\n");
}

bool *explain_groups(const LightingPlan *plan)
{
    Group *groups = NULL;
    int count = 0, room = 0;
    bool *first = memory_new((size_t)plan->object_count + 1, sizeof *first);
    for (int i = 0; i < plan->object_count; i++) {
        const Effects effects = lighting_plan_effects(plan, i);
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
    free(groups);
    return first;
}
