/*
 * What the project's front end and the driver say of shaders.
 *
 * usage: glsl_judge [--ours] < PATHS
 *
 * Reads a path a line, whose ending is .vert or .frag, and prints for each "PATH\tOURS\tDRIVER":
 * "ok", or the line of the first error and what is said, in one line. If a text is valid and does
 * not print as one that parses to the same tree, OURS is "differs". --ours: without the driver.
 * Exit status 77 if there is none.
 */
#include "app/options.h"
#include "base/input.h"
#include "core/canvas.h"
#include "glsl/glsl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The trees are equal but for their places. */
static bool same(const GlslTree *a, int x, const GlslTree *b, int y)
{
    const GlslNode *m = &a->nodes[x], *n = &b->nodes[y];
    if (m->kind != n->kind || m->type != n->type || m->op != n->op ||
        m->precision != n->precision || m->constant != n->constant || m->symbol != n->symbol)
        return false;
    for (int i = 0; m->constant && i < a->types[m->type].scalars; i++)
        if (memcmp(&a->values[m->value + i], &b->values[n->value + i], sizeof(double)) != 0)
            return false;
    int i = m->first, k = n->first;
    for (; i && k; i = a->nodes[i].next, k = b->nodes[k].next)
        if (!same(a, i, b, k))
            return false;
    return !i && !k;
}

static bool prints_as_itself(const GlslTree *tree)
{
    char *text = glsl_print(tree, tree->root);
    GlslTree *again = glsl_parse(text, tree->stage, &tree->limits);
    const bool equal = again->message_count == 0 && same(tree, tree->root, again, again->root);
    glsl_tree_free(again);
    free(text);
    return equal;
}

static void ours(const char *text, GlslStage stage)
{
    GlslTree *tree = glsl_parse(text, stage, NULL);
    if (tree->message_count)
        printf("\t%d %s", tree->messages[0].place.line, tree->messages[0].text);
    else
        printf("\t%s", prints_as_itself(tree) ? "ok" : "differs");
    glsl_tree_free(tree);
}

/* Mesa: "0:12(3): error: ...". */
static void driver(const char *text, GlslStage stage)
{
    const GLuint shader =
        glCreateShader(stage == GLSL_VERTEX ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
    GLint compiled = GL_FALSE;
    char log[4096] = "";
    glShaderSource(shader, 1, (const GLchar *const *)&text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    glDeleteShader(shader);
    const char *error = strstr(log, "error");
    while (error && error > log && error[-1] != '\n')
        error--;
    int line = 0;
    if (!compiled && error && sscanf(error, "%*d:%d", &line) != 1)
        line = 0;
    if (compiled)
        printf("\tok\n");
    else
        printf("\t%d %.*s\n", line, error ? (int)strcspn(error, "\n") : 0, error ? error : "");
}

int main(int argc, char *argv[])
{
    const bool alone = argc > 1 && strcmp(argv[1], "--ours") == 0;
    const CanvasOptions options = {.width = 1, .height = 1};
    Canvas canvas;
    Message message = {0};
    char path[4096];
    if (!alone && !canvas_open(&canvas, &options, &message))
        return options_fail("glsl_judge", &message, 77);
    while (fgets(path, sizeof path, stdin)) {
        path[strcspn(path, "\n")] = '\0';
        size_t size;
        char *text = input_whole(path, &size, &message);
        if (!text)
            return options_fail(path, &message, 1);
        const GlslStage stage = strstr(path, ".vert") ? GLSL_VERTEX : GLSL_FRAGMENT;
        printf("%s", path);
        ours(text, stage);
        if (alone)
            printf("\t\n");
        else
            driver(text, stage);
        free(text);
    }
    if (!alone)
        canvas_close(&canvas);
    return 0;
}
