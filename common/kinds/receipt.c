/* The program is assembled twice, with an effect and without. What the parser keeps of the texts,
 * behind all #ifdef, has places; a line is the effect's if only the first text has something there,
 * or as a macro has it more or fewer operations. So nobody has to know which define an effect sets,
 * and what follows from it is on the receipt, too: without the only light with a diffuse term no
 * normal is needed.
 */
#include "kinds/scene_views.h"

#include "base/memory.h"
#include "base/output_text.h"
#include "glsl/glsl.h"
#include "probe/place.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* As effects_decide names them; `at` is in Effects, or in LightGroup. */
typedef struct Effect {
    const char *name;
    size_t at, size;
} Effect;

#define OF_OBJECT(name, member) name, offsetof(Effects, member), sizeof(bool)
#define OF_LIGHT(name, member)                                                                     \
    "  " name, offsetof(LightGroup, member), sizeof(((LightGroup *)0)->member)
static const Effect EFFECTS[] = {
    {OF_OBJECT("two-sided", two_sided)},
    {OF_OBJECT("base", base)},
    {OF_OBJECT("alpha", alpha)},
    {OF_OBJECT("vertex colours", vertex_color)},
    {OF_OBJECT("local viewer", local_viewer)},
    {OF_OBJECT("normal matrix", normal_matrix)},
    {OF_OBJECT("normals normalized at the vertices", normalize_vertex)},
    {OF_OBJECT("normals normalized at the fragments", normalize_fragment)},
    {OF_OBJECT("clamping at the vertices", clamp_vertex)},
    {OF_OBJECT("overexposed pixels highlighted", show_clipped)},
    {OF_OBJECT("sRGB encoding", linear)},
    {OF_OBJECT("colours limited", limit)},
    {OF_LIGHT("ambient", terms.ambient)},
    {OF_LIGHT("diffuse", terms.diffuse)},
    {OF_LIGHT("specular", terms.specular)},
    {OF_LIGHT("half vector", terms.half_vector)},
    {OF_LIGHT("attenuation", terms.attenuation)},
    {OF_LIGHT("range", terms.range)},
    {OF_LIGHT("spot", terms.kind)},
    {OF_LIGHT("shadow", terms.shadow)},
    {OF_LIGHT("dot products not clamped", terms.signed_dots)},
    {OF_LIGHT("guard of the attenuation", guard_attenuation)},
};
enum { EFFECT_COUNT = sizeof EFFECTS / sizeof EFFECTS[0] };

static Effects without(Effects effects, const Effect *effect)
{
    if (effect->name[0] != ' ')
        memset((char *)&effects + effect->at, 0, effect->size);
    for (int g = 0; effect->name[0] == ' ' && g < effects.group_count; g++) {
        LightTerms *terms = &effects.groups[g].terms;
        if (effect->at != offsetof(LightGroup, terms.kind))
            memset((char *)&effects.groups[g] + effect->at, 0, effect->size);
        else if (terms->kind == LIGHT_SPOT)
            terms->kind = LIGHT_POINT;
        terms->exponent &= terms->kind == LIGHT_SPOT;
    }
    return effects;
}

static int compare(const void *a, const void *b)
{
    const GlslPlace *one = a, *other = b;
    return one->file != other->file ? one->file - other->file : one->line - other->line;
}

/* "group.glsl:117  float n_dot_l = dot(normal, to_light);" for each line of a text, after a tab how
 * much the parser has of it. What is in no file, because lighting_text writes it, is "written". */
static void list_lines(const char *source, GlslStage stage, FILE *file)
{
    GlslTree *tree = glsl_parse(source, stage, NULL);
    GlslPlace *places = memory_new((size_t)tree->node_count + 1, sizeof *places);
    for (int i = 1; i < tree->node_count; i++)
        places[i] = tree->nodes[i].place;
    qsort(places, (size_t)tree->node_count, sizeof *places, compare);
    for (int i = 1, next; i < tree->node_count; i = next) {
        char name[PLACE_TEXT], line[PLACE_TEXT];
        for (next = i + 1; next < tree->node_count && compare(&places[i], &places[next]) == 0;)
            next++;
        if (places[i].line == 0)
            continue;
        place_name(source, places[i], name);
        place_line(source, places[i], line);
        fprintf(file, "      %s  %s\t%d\n", strncmp(name, "file ", 5) == 0 ? "written" : name, line,
                next - i);
    }
    free(places);
    glsl_tree_free(tree);
}

/* The lines of both stages; for free(). */
static char *program_lines(const LightingPlan *plan, int object, const Effects *effects)
{
    ShaderSource sources[2];
    OutputText text;
    output_text_open(&text);
    fputc('\n', text.file);
    if (lighting_plan_sources_of(plan, object, effects, sources, NULL))
        for (int stage = 0; stage < 2; stage++)
            list_lines(sources[stage].text, (GlslStage)stage, text.file);
    shader_source_close(&sources[0]);
    shader_source_close(&sources[1]);
    return output_text_close(&text);
}

/* The lines of one text that another has not, each once: group.glsl is in it for each group. */
static void put_difference(const char *lines, const char *other, FILE *file)
{
    OutputText own;
    output_text_open(&own);
    fputc('\n', own.file);
    for (lines++; *lines; lines += strcspn(lines, "\n") + 1) {
        char *line = memory_format("\n%.*s\n", (int)strcspn(lines, "\n"), lines);
        fflush(own.file);
        if (!strstr(other, line) && !strstr(own.text, line))
            fputs(line + 1, own.file);
        free(line);
    }
    char *text = output_text_close(&own);
    for (const char *line = text + 1; *line; line += strcspn(line, "\n") + 1)
        fprintf(file, "%.*s\n", (int)strcspn(line, "\t"), line);
    free(text);
}

void receipt_write(const LightingPlan *plan, int object, const char *effects, FILE *file)
{
    const Effects has =
        effects_decide(lighting_plan_facts(plan, object), &plan->objects[object].facts, NULL);
    bool said[EFFECT_COUNT] = {false};
    char *lines = program_lines(plan, object, &has);
    for (; *effects; effects += strcspn(effects, "\n") + 1) {
        fprintf(file, "%.*s\n", (int)strcspn(effects, "\n"), effects);
        const size_t length = strcspn(effects, ":");
        for (int i = 0; i < EFFECT_COUNT; i++) {
            if (said[i] || strlen(EFFECTS[i].name) != length ||
                strncmp(EFFECTS[i].name, effects, length) != 0)
                continue;
            const Effects less = without(has, &EFFECTS[i]);
            char *others = program_lines(plan, object, &less);
            put_difference(lines, others, file);
            free(others);
            said[i] = true;
        }
    }
    free(lines);
}
