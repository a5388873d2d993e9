/*
 * glsl_fuzz: no bytes may do harm to the front end of the shaders' language, and what it accepts
 * prints as a text that parses, and prints as the same text again; what could be linked is compiled
 * and runs.
 *
 * The first byte is the stage. Seeds: the files of shaders/.
 */
#include "fuzz/fuzz.h"
#include "glsl/glsl_run.h"

#include <string.h>

static void run(const GlslTree *tree)
{
    GlslCode *code = glsl_compile(tree);
    require(code->message.text[0] || code->instruction_count > 0);
    GlslRun *run = glsl_run_open(code);
    run->loops = 100;
    run->trace = true;
    glsl_run(run);
    run->arithmetic = &GLSL_LLVMPIPE;
    run->exact_from = 3;
    glsl_run(run);
    glsl_run_close(run);
    glsl_code_free(code);
}

FUZZ(data, size)
{
    char *text = strndup((const char *)data + (size > 0), size ? size - 1 : 0);
    const GlslStage stage = size && data[0] & 1 ? GLSL_FRAGMENT : GLSL_VERTEX;
    GlslTree *tree = glsl_parse(text, stage, NULL);
    if (tree->message_count == 0) {
        char *printed = glsl_print(tree, tree->root);
        GlslTree *again = glsl_parse(printed, stage, NULL);
        char *twice = glsl_print(again, again->root);
        require(again->message_count == 0 && strcmp(printed, twice) == 0);
        glsl_check_loops(tree);
        if (glsl_check_whole(again))
            run(again);
        free(twice);
        free(printed);
        glsl_tree_free(again);
    } else {
        require(tree->messages[0].text[0] && !glsl_check_whole(tree));
    }
    glsl_tree_free(tree);
    free(text);
    return 0;
}
