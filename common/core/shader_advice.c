/*
 * Hints for learners. The driver's words are not read: the front end parses the same text, and its
 * messages know types. So the hints are the same with every driver.
 */
#include "core/shader_advice.h"

#include "base/text.h"
#include "glsl/glsl.h"

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

bool shader_bounded(const ShaderSource *source, ShaderStage stage, Message *message)
{
    GlslTree *tree = glsl_parse(source->text, (GlslStage)stage, NULL);
    const bool bounded = !tree->grown;
    const GlslMessage *said = &tree->messages[0];
    char log[sizeof said->text + 64];
    snprintf(log, sizeof log, "%d:%d(%d): error: %s", said->place.file, said->place.line,
             said->place.column, said->text);
    glsl_tree_free(tree);
    return bounded || shader_explain_log(source, log, message);
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
