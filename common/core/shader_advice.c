/*
 * Hints for learners. The driver's words are not read: the front end parses the same text, and its
 * messages know types. So the hints are the same with every driver.
 */
#include "core/shader_source.h"

#include "base/text.h"
#include "glsl/glsl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What is wrong in one stage by itself, if anything. WebGL restricts loops; other drivers that
 * refuse a text without another fault may do so, too. */
static GlslTree *read_stage(const ShaderSource *source, GlslStage stage)
{
    GlslTree *tree = glsl_parse(source->text, stage, NULL);
    if (glsl_check_whole(tree))
        glsl_check_loops(tree);
    return tree;
}

static void add_hint(const ShaderSource *source, const GlslMessage *said, Message *message)
{
    char place[PATH_MAX + 16] = "";
    const int file = said->place.file, line = said->place.line % SHADER_LINES_OF_FILE;
    if (file >= 0 && file < source->file_count)
        snprintf(place, sizeof place, "%s:%d: ", source->files[file], line);
    const char *end = message->text + strcspn(message->text, "\n");
    if (*end && text_is_quote(end + 1))
        end += 1 + strcspn(end + 1, "\n");
    Message after = {0};
    message_set(&after, "%s", end);
    const bool same = strncmp(message->text, place, strlen(place)) == 0;
    message->text[end - message->text] = '\0';
    message_add(message, "\n  hint: %s%s%s", same ? "" : place, said->text, after.text);
}

/* Of the nodes of a text with functions put where they are called, where these are most of it.
 * Mesa 22.3 does that, too, and takes 0.7 s for 25,000, 18 s for 100,000. */
enum { SIZE_MAX_OF_MAIN = 50000 };

/* Of an array: what 4096 vec4 hold, the most uniforms of common drivers. Mesa 22.3 takes about 1 ms
 * for each number of an array that is indexed, and a minute for 2^31 that are not. */
enum { NUMBERS_MAX_OF_ARRAY = 16384 };

/* Of the steps of one vertex or pixel in a page: seconds of a picture, by a slow renderer. A
 * graphics process that hangs takes the page along, also when it is loaded again. */
#ifdef __EMSCRIPTEN__
static const double STEPS_MAX = 300000;
#else
static const double STEPS_MAX = INFINITY;
#endif

static void weigh_arrays(const GlslTree *tree, GlslMessage *why)
{
    for (int i = 1; i < tree->node_count && !why->text[0]; i++) {
        const GlslNode *node = &tree->nodes[i];
        const GlslType *type = &tree->types[node->type];
        why->place = node->place;
        if (node->kind == GLSL_VARIABLE_NODE && type->array && type->scalars > NUMBERS_MAX_OF_ARRAY)
            snprintf(why->text, sizeof why->text,
                     "%.60s holds %d numbers or more; at most %d are allowed in an array",
                     tree->symbols[node->symbol].name, type->scalars, NUMBERS_MAX_OF_ARRAY);
    }
}

/* Why no driver gets a text that is whole; `text` stays empty: it may. */
static void weigh(GlslTree *tree, double turns_max, const char *unit, GlslMessage *why)
{
    const bool loops_bounded = glsl_check_loops(tree);
    if (!loops_bounded && turns_max > 0)
        *why = tree->messages[0];
    if (!loops_bounded && (turns_max > 0 || STEPS_MAX < INFINITY))
        return; /* browsers refuse it */
    const GlslWork work = glsl_count_work(tree);
    why->place = work.place;
    if (!(work.size <= SIZE_MAX_OF_MAIN + 2.0 * tree->node_count))
        snprintf(why->text, sizeof why->text,
                 "with each function put where it is called, main has %.3g operations; at most %d "
                 "are allowed: call them less often",
                 work.size, SIZE_MAX_OF_MAIN);
    else if (loops_bounded && turns_max > 0 && !(work.turns <= turns_max))
        snprintf(why->text, sizeof why->text,
                 "loops turn %.0f times or more for one %s; at most %.0f are allowed", work.turns,
                 unit, turns_max);
    else if (loops_bounded && !(work.steps <= STEPS_MAX))
        snprintf(why->text, sizeof why->text,
                 "this loop takes about %.0f steps for one %s, and would hang the page; at most "
                 "%.0f are allowed",
                 work.steps, unit, STEPS_MAX);
}

bool shader_bounded(const ShaderSource *source, ShaderStage stage, double turns_max,
                    Message *message)
{
    GlslTree *tree = glsl_parse(source->text, (GlslStage)stage, NULL);
    GlslMessage why = {.text = ""};
    if (tree->grown)
        why = tree->messages[0];
    else if (tree->message_count == 0)
        weigh_arrays(tree, &why);
    if (!why.text[0] && tree->message_count == 0 && glsl_check_whole(tree))
        weigh(tree, turns_max, stage == SHADER_VERTEX ? "vertex" : "pixel", &why);
    char log[sizeof why.text + 64];
    snprintf(log, sizeof log, "%d:%d(%d): error: %s", why.place.file, why.place.line,
             why.place.column, why.text);
    glsl_tree_free(tree);
    return !why.text[0] || shader_explain_log(source, log, message);
}

void shader_advise(const ShaderSource sources[2], int refused, Message *message)
{
    GlslTree *trees[2] = {NULL, NULL};
    int found = -1;
    if (!message || !message->text[0])
        return;
    for (int stage = 0; stage < 2; stage++)
        if (refused == SHADER_LINKING || refused == stage) {
            trees[stage] = read_stage(&sources[stage], (GlslStage)stage);
            if (found < 0 && trees[stage]->message_count)
                found = stage;
        }
    if (found < 0 && refused == SHADER_LINKING && !glsl_check_pair(trees[0], trees[1]))
        found = SHADER_FRAGMENT;
    if (found >= 0 && !trees[found]->grown)
        add_hint(&sources[found], &trees[found]->messages[0], message);
    glsl_tree_free(trees[0]);
    glsl_tree_free(trees[1]);
}
