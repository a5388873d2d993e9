/*
 * glsl_preprocess: what the preprocessor's two files share.
 */
#ifndef GLSL_PREPROCESS_H
#define GLSL_PREPROCESS_H

#include "glsl/glsl_tokens.h"

enum { NO_NUMBER = -1, LINE_NUMBER = -2, FILE_NUMBER = -3 };

typedef struct Macro {
    Tokens body;
    int parameters; /* -1: it takes none, and no parentheses */
    int number;     /* of a predefined one: its value */
    bool active;    /* it is being expanded */
} Macro;

typedef struct Source {
    Tokens tokens;
    int at;
    int macro;    /* that these are from, 0: none */
    bool barrier; /* what is under it is not read */
} Source;

/* An #if: whether its present group is read, whether one of its groups has been, and #else. */
typedef struct Group {
    GlslPlace place;
    bool read, done, last;
} Group;

typedef struct Preprocessor {
    GlslTree *tree;
    Names *names;
    GlslMessage *message;
    Lexer lexer;
    Macro *macros;
    Source *sources;
    Group *conditions;
    int macro_count, macro_room, source_count, source_room, condition_count, condition_room;
    int predefined; /* macros */
    int expanded;   /* tokens that came out of macros */
    int depth;      /* of macros' calls in each other's arguments */
    bool fresh;     /* at the beginning of a line */
    bool started;   /* a directive or token was read: no #version any more */
    bool said;      /* a token was read: no #extension any more */
    bool failed;
} Preprocessor;

typedef struct Extension {
    const char *name;
    int bit;
} Extension;
enum { EXTENSION_COUNT = 3 };
extern const Extension EXTENSIONS[EXTENSION_COUNT];

/* The first message counts. */
void preprocess_fail(Preprocessor *all, GlslPlace place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* A line whose macros are expanded; takes the line. */
Tokens preprocess_line(Preprocessor *all, Tokens line);

/* The next token of the text itself, after its directives. */
Token preprocess_text(Preprocessor *all);

#endif
