/*
 * glsl_parser: what the parser's files share.
 */
#ifndef GLSL_PARSER_H
#define GLSL_PARSER_H

#include "glsl/glsl_preprocess.h"

/* The first names are those of types, in the order of the types; then words in this order. */
/* clang-format off */
enum {
    WORD_CONST = GLSL_TYPES, WORD_ATTRIBUTE, WORD_UNIFORM, WORD_VARYING, WORD_IN, WORD_OUT,
    WORD_INOUT, WORD_LOWP, WORD_MEDIUMP, WORD_HIGHP, WORD_PRECISION, WORD_INVARIANT,
    WORD_STRUCT, WORD_IF, WORD_ELSE, WORD_FOR, WORD_WHILE, WORD_DO, WORD_RETURN, WORD_BREAK,
    WORD_CONTINUE, WORD_DISCARD, WORD_TRUE, WORD_FALSE, WORD_RESERVED
};
/* clang-format on */

typedef struct Parser {
    GlslTree *tree;
    Names names;
    Tokens tokens;
    int at, depth;
    int words;     /* names from here on are free */
    bool stopped;  /* a syntax error: nothing more is read */
    bool broken;   /* the preprocessor stopped where the tokens end */
    bool cut;      /* and the parser there, too */
    int *declared; /* symbols of the scopes that are open */
    int declared_count, declared_room;
    int scope;                            /* where the innermost one begins in these */
    unsigned char precisions[GLSL_TYPES]; /* the defaults */
    int function;                         /* whose body this is, 0: none */
    bool returns;                         /* it has a return statement */
    int loops;
} Parser;

/* A list of nodes that grows at its end. */
typedef struct List {
    int first, last;
} List;

/* Reading tokens; after a syntax error only TOKEN_END comes. */
const Token *peek(const Parser *parser, int ahead);
const Token *take(Parser *parser);
bool at_word(const Parser *parser, int word);
bool take_if(Parser *parser, int kind);
bool take_word(Parser *parser, int word);
bool expect(Parser *parser, int kind, const char *what);
bool deeper(Parser *parser);

/* Adds a message. */
void complain(Parser *parser, GlslPlace place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void syntax_error(Parser *parser, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Building the tree. */
int node_new(Parser *parser, int kind, int type, GlslPlace place);
void list_add(Parser *parser, List *list, int node);
void set_children(Parser *parser, int node, List list);
GlslNode *node_at(const Parser *parser, int node);
int values_new(GlslTree *tree, int count);
int type_array(GlslTree *tree, int element, int length);
int type_struct(GlslTree *tree, const char *name);
void type_add_field(GlslTree *tree, int type, const char *name, int field, int precision);
const char *keep_name(Parser *parser, int name);

/* Scopes: what is declared until the end. */
typedef struct Scope {
    int scope;
    unsigned char precisions[GLSL_TYPES];
} Scope;
Scope scope_open(Parser *parser);
void scope_close(Parser *parser, Scope outer);
int symbol_new(Parser *parser, int name, GlslPlace place, int kind);
int symbol_bind(Parser *parser, int symbol); /* its name means it from here on; returns it */
int symbol_of(const Parser *parser, int name);
bool name_is_free(Parser *parser, const Token *token);
void open_words(Parser *parser);
void declare_built_ins(Parser *parser);

/* Parsing. */
int parse_unit(Parser *parser);
int parse_expression(Parser *parser);
int parse_assignment(Parser *parser);
int parse_conditional(Parser *parser); /* neither = nor a comma */
int parse_block(Parser *parser);
bool at_declaration(const Parser *parser);
int parse_declaration(Parser *parser, bool global);
int parse_condition_variable(Parser *parser);

/* What is said before a name. */
typedef struct Specifier {
    GlslPlace place;
    bool invariant;
    int storage, said, precision; /* the declaration's, and what holds */
    int type;
    int structure; /* the symbol of the structure that it defines */
} Specifier;
void parse_type(Parser *parser, Specifier *specifier);
int parse_array_type(Parser *parser, int type); /* the brackets after a name, if any */
int parse_function(Parser *parser, const Specifier *specifier);

/* What an expression is, from what its parts are; complains of those that do not fit. */
void check_unary(Parser *parser, int node);
void check_binary(Parser *parser, int node);
void check_assign(Parser *parser, int node);
void check_conditional(Parser *parser, int node);
void check_index(Parser *parser, int node);
void check_construct(Parser *parser, int node);
void check_call(Parser *parser, int node, int name);
/* Of GLSL_FUNCTIONS: its index and 1; 0: there is none for these types. */
int find_built_in(const Parser *parser, int name, const int *types, int count);
bool check_writable(Parser *parser, int node);
bool check_initial(Parser *parser, int symbol, int value, GlslPlace place);
void undeclared(Parser *parser, const Token *name,
                int symbol); /* no variable, but perhaps a symbol */
/* What GLSL ES 1.00 has in the place of a word of C, HLSL or a later GLSL; NULL: unknown. */
const char *replacement_for(const Parser *parser, const char *name);
/* A name in scope or of the language that is similar: GLSL_VARIABLE, GLSL_FUNCTION, or GLSL_STRUCT
 * for types; NULL: none. */
const char *nearest(Parser *parser, const char *name, int kind);
int select_field(Parser *parser, int base, const Token *name);

/* Computes what a constant expression is. */
void fold(GlslTree *tree, int node);

/* For messages: "a float", "an int", "a vec3". */
typedef struct Phrase {
    char text[96];
} Phrase;
Phrase type_phrase(const Parser *parser, int type);
Phrase text_phrase(const Parser *parser, int node);
typedef struct Sentence {
    char text[160];
} Sentence;
/* Of a word that the language reserves, "layout belongs to ...". */
Sentence reserved(Parser *parser, int word);
/* How a value becomes of another type: "write 2.0", or "". */
Phrase conversion(const Parser *parser, int node, int type);

#endif
