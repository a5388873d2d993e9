/*
 * glsl_run: runs a GLSL ES 1.00 shader: exactly, as a driver does, or from some event on exactly.
 *
 * A tree without messages is compiled to flat code over registers that hold one number each:
 * functions inlined, vectors and matrices (by columns) taken apart. Code is constant and may be run
 * by many threads, each with a GlslRun of its own. Ints, bools (0 and 1) and samplers (the number
 * of the texture unit) are numbers, too.
 */
#ifndef GLSL_RUN_H
#define GLSL_RUN_H

#include "glsl/glsl.h"

/* A global variable that is the shader's input or output, or a part of one, by GL's name:
 * "u_Light[2].position", "gl_FragColor". */
typedef struct GlslVariable {
    char name[128];
    int symbol, type, storage; /* storage: GLSL_UNIFORM, GLSL_OUT, ... */
    int first, count;          /* its registers */
} GlslVariable;

typedef struct GlslInstruction {
    unsigned char op, precision;
    int d, a, b, c, n; /* what they mean, the operation says: see glsl_code.h */
    int node;
} GlslInstruction;

typedef struct GlslCode {
    const GlslTree *tree;
    GlslInstruction *instructions;
    double *start; /* what the registers hold before a run */
    GlslVariable *variables;
    int instruction_count, instruction_room, register_count, register_room, variable_count,
        variable_room;
    GlslMessage message; /* why it cannot be compiled; its text is empty: it is */
} GlslCode;

/* Never NULL. The tree has to have a main and to live as long as the code. */
GlslCode *glsl_compile(const GlslTree *tree);
void glsl_code_free(GlslCode *code);

/* Variables that are global, not constant and not structures or arrays of these are in the list;
 * this finds elements of arrays in it, too: "a[2]", and "a" as "a[0]" does. False: there is none.
 */
bool glsl_find(const GlslCode *code, const char *name, GlslVariable *found);

/* The variable that an instruction logs as assigned; 0: it is another instruction. */
int glsl_event_symbol(const GlslCode *code, int instruction);

/* Significant bits, and the least and largest exponent of 2 of a normal number. 53 bits: as double.
 */
typedef struct GlslNumbers {
    int bits, least, most;
    bool denormals; /* smaller numbers are kept */
    /* As NVIDIA's 16 bits: roots, logarithms, powers of 2 and reciprocals are cut, not rounded, dot
     * products are fused from x on, and what is only copied keeps its bits. */
    bool cut;
} GlslNumbers;

/* A driver's numbers, for each precision (see GLSL_HIGHP). Ints have the first, without precision.
 */
typedef struct GlslArithmetic {
    GlslNumbers of[GLSL_HIGHP + 1];
    bool mesa;      /* exp2, log2 and what is made of them by gallivm's polynomials */
    bool fused;     /* in which products are added with one rounding */
    int color_bits; /* bits that a colour is cut to before it becomes a byte; 0: none is lost */
} GlslArithmetic;
extern const GlslArithmetic GLSL_EXACT, GLSL_LLVMPIPE;

typedef struct GlslDevice {
    const char *name;
    const GlslArithmetic *arithmetic;
} GlslDevice;
extern const GlslDevice GLSL_DEVICES[]; /* the last has no name */

/* A device's name, or any text that holds "highp=24,-126,127;mediump=11,-14,15,kept": bits, least
 * and largest exponent, "kept" with denormals, "cut" with functions that are; "llvmpipe" in it:
 * with Mesa's functions; "bytes=12": `color_bits`. False: neither. */
bool glsl_arithmetic_read(const char *text, GlslArithmetic *arithmetic);
void glsl_arithmetic_print(const GlslArithmetic *arithmetic, char *text, size_t size);

/* What is undefined or suspicious, once for each place and run. */
/* clang-format off */
enum {
    GLSL_NOTE_NONE, GLSL_NOTE_LOOP, GLSL_NOTE_UNSET, GLSL_NOTE_NAN, GLSL_NOTE_POW, GLSL_NOTE_ROOT,
    GLSL_NOTE_LOG, GLSL_NOTE_ZERO, GLSL_NOTE_ARC, GLSL_NOTE_EDGES, GLSL_NOTE_INDEX
};
/* clang-format on */
typedef struct GlslNote {
    int kind, node;
} GlslNote;
enum { GLSL_NOTES = 16 };

/* "pow of a negative number, or of 0 to the power of 0 or less". */
const char *glsl_note_text(int kind);

/* An assignment, a declaration with a value, or what is computed for a parameter of a function that
 * has such, that was executed; what it assigned is in `values`. With `details`, also what a
 * condition or a return computes; its symbol is 0. */
typedef struct GlslEvent {
    int node, symbol, first, count;
    int value; /* the first in `values` */
} GlslEvent;

/* `function` is GLSL_TEXTURE_2D or another of these; `coordinates` are its arguments after the
 * sampler, `count` numbers. */
typedef void GlslTexture(void *context, int unit, int function, const double *coordinates,
                         int count, double color[4]);

typedef struct GlslRun {
    const GlslCode *code;
    const GlslArithmetic *arithmetic; /* GLSL_EXACT at first */
    int exact_from;       /* the event after which the numbers are exact; INT_MAX at first: none */
    int loops;            /* iterations in one run; 100,000 at first */
    GlslTexture *texture; /* NULL: opaque black */
    void *context;
    bool trace, details;
    /* After each assignment; may change the numbers that were assigned. NULL: none. */
    void (*assigned)(struct GlslRun *run, const GlslEvent *event, void *observer);
    void *observer;
    /* Set inputs here before a run, and read results after it. Registers of local variables and
     * globals without storage begin with what `start` says; inputs keep what they hold. */
    double *registers;
    bool discarded, stopped;                              /* stopped: a loop does not end */
    long long operations;                                 /* of all runs */
    int event_count, event_room, value_count, value_room; /* of the last run */
    GlslEvent *events;                                    /* with `trace` */
    double *values;
    GlslNote notes[GLSL_NOTES];
    int note_count;
    const GlslArithmetic *prepared; /* whose constants the registers hold */
} GlslRun;

/* Never NULL; `registers` begin with 0 in all inputs. */
GlslRun *glsl_run_open(const GlslCode *code);
void glsl_run_close(GlslRun *run);

/* False if it stopped. */
bool glsl_run(GlslRun *run);

/* As glsl_run with exact_from the event `first`, every `step`-th after it and `last`, but what runs
 * before an event runs once. Calls `each` after each; `same`: its results are those of the call
 * before, and not in the registers. */
typedef void GlslEach(GlslRun *run, int event, bool same, void *context);
void glsl_run_each(GlslRun *run, int first, int last, int step, GlslEach *each, void *context);

/* Whether a run did what a note of this kind is of. */
bool glsl_noted(const GlslRun *run, int kind);

/* The last of the events of a variable so named, NULL: it has none. */
const GlslEvent *glsl_last(const GlslRun *run, const char *name);

#endif
