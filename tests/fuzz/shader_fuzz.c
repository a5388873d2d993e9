/*
 * shader_fuzz: no bytes of a shader file, and none of a driver's log, may do harm.
 *
 * The input is a shader, a zero, and a log; includes are looked for in a folder with a few files
 * that include each other. Seeds: the files of shaders/.
 */
#include "core/shader.h"
#include "fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char folder[] = "/tmp/shader_fuzz-XXXXXX";

static void remove_folder(void)
{
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0)
        fprintf(stderr, "%s: left behind\n", folder);
}

static void make_folder(void)
{
    static const char *const files[][2] = {
        {"a", "int a;\n#include \"b\"\n#line 9 9\nint after;"},
        {"b", "/* no\n#include \"a\"\n*/ varying vec4 v_B;\n"},
        {"cycle", "#include \"a\"\n#include \"through\"\n"},
        {"through", "#include \"cycle\"\n"},
        {"version", "#version 300 es\n"},
        {"empty", ""},
        {"zero", "\x01"},
        {"twice", "#include \"a\"\r#include \"a\"\r\n"},
    };
    require(mkdtemp(folder));
    atexit(remove_folder);
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        char path[64];
        snprintf(path, sizeof path, "%s/%s", folder, files[i][0]);
        FILE *file = fopen(path, "w");
        require(file && fputs(files[i][1], file) >= 0 && fclose(file) == 0);
    }
}

FUZZ(data, size)
{
    static bool made;
    if (!made)
        make_folder();
    made = true;

    char *text = strndup((const char *)data, size);
    const size_t used = strlen(text) + 1; /* a zero divides the text from the log */
    char *log = used < size ? strndup((const char *)data + used, size - used) : strdup("");
    /* The first byte also chooses what is added. */
    static const char *const defines[] = {"FOG", "LIGHTS 3", NULL};
    const unsigned choice = size ? data[0] : 0;
    const ShaderText texts[] = {{"main.frag", text}, {NULL, NULL}};
    const ShaderLoader loader = {.texts = texts,
                                 .folder = folder,
                                 .precision = choice & 1 ? "highp" : NULL,
                                 .defines = choice & 2 ? defines : NULL};
    ShaderSource source;
    Message message = {0};
    if (shader_source_open(&source, &loader, "main.frag", SHADER_FRAGMENT, &message)) {
        require(!message.text[0] && strlen(source.text) == source.size &&
                strncmp(source.text, "#version 100\n", 13) == 0);
        require(!shader_explain_log(&source, log, &message));
        shader_source_close(&source);
    } else {
        require(message.text[0] && !source.text && !source.files);
    }
    free(text);
    free(log);
    return 0;
}
