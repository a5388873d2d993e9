#include "probe/stages.h"

#include "base/memory.h"

#include <stdlib.h>

static bool compile(Stages *stages, int stage, Message *message)
{
    const char *name = stage ? "fragment" : "vertex";
    if (!stages->sources[stage])
        return message_set(message, "a program without its sources was drawn with");
    GlslTree *tree = stages->trees[stage] =
        glsl_parse(stages->sources[stage], stage ? GLSL_FRAGMENT : GLSL_VERTEX, NULL);
    if (tree->message_count)
        return message_set(message, "%s shader: line %d: %s", name, tree->messages[0].place.line,
                           tree->messages[0].text);
    if (!glsl_check_whole(tree))
        return message_set(message, "%s shader: %s", name, tree->messages[0].text);
    const GlslMessage *said = &(stages->codes[stage] = glsl_compile(tree))->message;
    return !said->text[0] ||
           message_set(message, "%s shader: line %d: %s", name, said->place.line, said->text);
}

/* The varyings that both stages have. */
static void link_stages(Stages *stages)
{
    const GlslCode *fragment = stages->codes[1];
    stages->links = memory_new((size_t)fragment->variable_count + 1, sizeof *stages->links);
    for (int k = 0; k < fragment->variable_count; k++) {
        const GlslVariable *to = &fragment->variables[k];
        GlslVariable from;
        if (to->storage != GLSL_VARYING || !glsl_find(stages->codes[0], to->name, &from))
            continue;
        const int count = to->count < from.count ? to->count : from.count;
        stages->links[stages->link_count++] =
            (StageLink){to->first, from.first, count, stages->handed, to->name};
        stages->handed += count;
    }
}

bool stages_open(Stages *stages, const CaptureDraw *draw, Message *message)
{
    *stages = (Stages){.sources = {draw->sources[0], draw->sources[1]}};
    if (!compile(stages, 0, message) || !compile(stages, 1, message))
        return false;
    link_stages(stages);
    return true;
}

void stages_close(Stages *stages)
{
    for (int i = 0; i < 2; i++) {
        if (stages->codes[i])
            glsl_code_free(stages->codes[i]);
        if (stages->trees[i])
            glsl_tree_free(stages->trees[i]);
    }
    free(stages->links);
    *stages = (Stages){.link_count = 0};
}

bool stages_uniform(const GlslCode *code, const CaptureUniform *uniform, int element,
                    GlslVariable *found)
{
    char *name = memory_format(uniform->length > 1 ? "%s[%d]" : "%s", uniform->name, element);
    const bool has = glsl_find(code, name, found);
    free(name);
    return has;
}
