/*
 * shader_source: shader files made ready for the driver, and the way back from its log. No GL.
 *
 * A file is GLSL ES 1.00. Before the driver gets it,
 *   - `#include "file"` on a line of its own is replaced by that file, which is searched beside
 *     the including file, then where all shaders are. A file must not include itself, even
 *     indirectly. Includes are resolved before #if is;
 *   - `#version 100` becomes the first line, and defines follow it;
 *   - `#line` is added after these, so that the driver's messages can be mapped to files.
 */
#ifndef SHADER_SOURCE_H
#define SHADER_SOURCE_H

#include "base/message.h"

#include <limits.h>
#include <stdio.h>

typedef struct ShaderFiles ShaderFiles;

/* A file in memory: its name in #include, and its text. */
typedef struct ShaderText {
    const char *name, *text;
} ShaderText;

/* A file that replaces another in #include. */
typedef struct ShaderReplacement {
    const char *name, *by;
} ShaderReplacement;

/* Where and how shaders are loaded. Zero means default. */
typedef struct ShaderLoader {
    const char *folder;         /* searched first; NULL: none */
    const char *precision;      /* "highp" or "mediump" replaces the other in fragment shaders */
    const char *const *defines; /* "NAME" or "NAME value", ended by NULL; may be NULL */
    const ShaderText *texts;    /* searched before any folder; ended by a NULL name; may be NULL */
    bool only_texts;            /* no file is read */
    const ShaderReplacement *replacements; /* ended by a NULL name; may be NULL */
    ShaderFiles *files;                    /* caches files; NULL: read from disk each time */
    int print;                             /* which shaders to write to `printed`, as below */
    FILE *printed, *log;                   /* the latter for compile times; NULL: not written */
    bool advise;                           /* errors of the driver end with a hint */
    bool keeps;                            /* linked programs are kept, in the cache */
    Message *warning; /* where shader_locations names what a program lacks; NULL: an error */
} ShaderLoader;

enum { SHADER_PRINT_VERTEX = 1, SHADER_PRINT_FRAGMENT = 2 };

/* The text of one shader as the driver gets it, and the files of its lines. */
typedef struct ShaderSource {
    char *text;
    size_t size;  /* without the terminating zero */
    char **files; /* the path of source string number i, as #line numbers them */
    int file_count;
} ShaderSource;

typedef enum ShaderStage { SHADER_VERTEX, SHADER_FRAGMENT } ShaderStage;

/* Whether the loader's folder and that of LIGHTING_SHADERS in the environment, if set, exist. */
bool shader_loader_check(const ShaderLoader *loader, Message *message);

/* Reads `name` ("lecture/LightedCube.vert") and its includes. Searches, in this order, the loader's
 * folder and LIGHTING_SHADERS (each by path, then by file name alone), the source tree, and the
 * installation; the message lists all paths tried. No GL. `source` is zeroed on failure. */
bool shader_source_open(ShaderSource *source, const ShaderLoader *loader, const char *name,
                        ShaderStage stage, Message *message);
void shader_source_close(ShaderSource *source);

/* Maps the driver's log to files: a line that begins with a source string and line number becomes
 * "file:line: rest"; the first is followed by that line of source. Always returns false. */
bool shader_explain_log(const ShaderSource *source, const char *log, Message *message);
/* The same of a program that does not link; cuts white space off the log's end. */
bool shader_explain_link(const ShaderSource sources[2], char *log, Message *message);
/* Adds to a warning that no line of a fragment's shader has gl_FragColor or gl_FragData. */
void shader_warn_of_color(const ShaderSource *fragment, Message *warning);

/* "#line 1000003 1" is line 3 of file 1: Mesa reports the source string of syntax errors only. */
enum { SHADER_LINES_OF_FILE = 1000000 };

/* A line of a file in a text that the driver gets; NULL: it is not there. */
const char *shader_find_line(const char *text, int file, int line, int *length);

enum { SHADER_LINKING = 2 };

/* Adds a line, "  hint: ...", after the first line of the driver's message and the source quoted
 * there; with its place, unless the message begins with the same. `refused` is a stage, or
 * SHADER_LINKING. Adds nothing if the front end finds nothing wrong. */
void shader_advise(const ShaderSource sources[2], int refused, Message *message);

/* False, with a message, for a text that no driver gets: its macros grow, its arrays, or functions
 * that call each other, beyond what compilers end with; in a page, loops that would hang it. With
 * `turns_max` above 0 loops have to be as appendix A wants them, and to turn no more often for one
 * vertex or pixel. What does not parse is left to the driver. */
bool shader_bounded(const ShaderSource *source, ShaderStage stage, double turns_max,
                    Message *message);

#endif
