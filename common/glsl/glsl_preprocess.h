/*
 * glsl_preprocess: what the preprocessor's two files share.
 */
#ifndef GLSL_PREPROCESS_H
#define GLSL_PREPROCESS_H

#include "glsl/glsl.h"

/* The lexer and the preprocessor of glsl. */

/* Kinds of tokens; an operator of one character is that character. */
enum {
    TOKEN_END,
    TOKEN_LINE,
    TOKEN_NAME,
    TOKEN_INT,
    TOKEN_FLOAT,
    TOKEN_BAD,
    TOKEN_PARAMETER,
    TOKEN_LEFT = 128, /* << and so on, which only #if has */
    TOKEN_RIGHT,
    TOKEN_LESS_EQUAL,
    TOKEN_GREATER_EQUAL,
    TOKEN_EQUAL,
    TOKEN_NOT_EQUAL,
    TOKEN_AND,
    TOKEN_OR,
    TOKEN_XOR,
    TOKEN_INCREMENT,
    TOKEN_DECREMENT,
    TOKEN_ADD,
    TOKEN_SUBTRACT,
    TOKEN_MULTIPLY,
    TOKEN_DIVIDE,
    TOKEN_LATER, /* %= and so on, which the language reserves */
};

typedef struct Token {
    const char *text;
    int length;
    int name; /* which name; of TOKEN_PARAMETER, which parameter */
    GlslPlace place;
    unsigned char kind;
    bool spaced;  /* a blank or comment is before it */
    bool painted; /* a macro's name that is not to be expanded again */
} Token;

/* All names of a text, each once; a name is an index. Index 0 is none. */
typedef struct Name {
    const char *text;
    int length, next; /* of the same hash */
    int symbol;       /* what it means where the parser is, 0: nothing */
    int macro;        /* its definition, 0: none */
    int function;     /* of GLSL_FUNCTIONS: the first of this name and 1; 0: none */
    const char *kept; /* its text, ended by a zero, as long as the tree is */
} Name;

typedef struct Names {
    Name *items;
    int count, room;
    int *hashed; /* the first name of each hash */
} Names;

void names_open(Names *names);
void names_copy(Names *names, const Names *from);
void names_close(Names *names);
int names_find(Names *names, const char *text, int length);

typedef struct Lexer {
    const char *at;
    const char *line_start;
    int file, line;
    bool unended; /* a comment does not end; its line is `comment` */
    int comment;
} Lexer;

/* The next token; names are found in `names`. Lines end with TOKEN_LINE. It is written where it
 * stays: reading bytes just written as a whole takes as long as finding the next token. */
void lexer_next(Lexer *lexer, Names *names, Token *token);

/* Makes tokens of a text. False: it is in error after these; `message` says how. */
typedef struct Tokens {
    Token *items;
    int count, room;
} Tokens;
bool preprocess(GlslTree *tree, Names *names, const char *text, Tokens *tokens,
                GlslMessage *message);

void tokens_add(Tokens *tokens, Token token);

/* Of TOKEN_INT; more than 32 bits are -1. */
long long token_integer(const Token *token);

/* What #if asks: macros are expanded, `defined` is replaced, and TOKEN_END ends it. */
typedef struct Condition {
    const Token *tokens;
    int at, depth;
    int unused;        /* operands that && or || do not need: an undefined name there is none */
    const char *error; /* NULL: none yet */
} Condition;
bool condition_holds(Condition *condition);

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
void preprocess_text(Preprocessor *all, Token *token);

#endif
