/*
 * derivation: what derive.c and its parts share: a submission and a right program at points.
 */
#ifndef DERIVATION_H
#define DERIVATION_H

#include "core/shader_source.h"
#include "labs/diagnosis/diagnose.h"
#include "labs/diagnosis/mutation.h"
#include "labs/diagnosis/points.h"
#include "labs/submission/verdict.h"

enum { TRACED = 6, SHOWN_POINTS = 12, MAX_VALUES = 400, MAX_RIGHTS = 8, MAX_GIVEN = 4 };

/* Equal formulas differ by 1e-12, with attributes in floats by 1e-7, with constants like 3.14159 by
 * more. A highlight that nearly vanishes is 1e-4 from one that does. */
#define DERIVATION_EQUAL 5e-5

/* What a pair of shaders draws at each point. */
typedef double (*Numbers)[POINT_NUMBERS];

/* One mutation, or the second of two. */
typedef struct Found {
    Mutation mutation;
    const struct Found *first; /* NULL: one */
    GlslStage stage;
    char *text;
    char where[MUTATION_TEXT]; /* of a right program's: on which condition, or "" */
    double apart;
    int shared; /* of the submission's values */
    int other;  /* operations and names that the submission has more or less often */
    bool there; /* of the submission's changes: it changes the first wrong value, no right one */
    bool needs_undeclared; /* a uniform that the submission does not declare */
} Found;

/* A value of the submission at a point, and the right one. */
typedef struct Shown {
    int point, size; /* 0: none is known */
    GlslStage stage;
    int node; /* where to look */
    char name[64];
    double is[4], should[4];
} Shown;

typedef struct Derivation {
    const Lab *lab;
    const LabPictures *pictures;
    Canvas *canvas;   /* what mends is drawn on it; NULL: it is not */
    double tolerance; /* of what is right, at points */
    int drawn;        /* how many changes were */
    Points points;
    const SubmissionFiles *files;
    PointShader own[2], right[2]; /* by GlslStage */
    ShaderSource sources[2];      /* the submission's */
    Numbers wanted, exact;        /* the submission's, and those of the right program */
    Numbers rights[MAX_RIGHTS];   /* those of all right programs */
    int right_count;
    int *order; /* of the points: where it is farthest from right, and where it is right, in turn */
    double nearest_right; /* the sum of how far it is from the right program */
    bool nearest_light;   /* at the points, where that is not asked for */
    char *nearest_text;   /* of its fragment shader, if it has other numbers */
    double wrong_by;
    bool noted;             /* the submission does what is undefined */
    bool reads_map, in_eye; /* in_eye: its values may be in eye space */
    double numbers[MUTATION_NUMBERS];
    int number_count, own_number_count; /* as they are in the submission */
    double right_numbers[MUTATION_NUMBERS];
    int right_number_count;
    int given[2][MAX_GIVEN], given_count[2]; /* functions of the submission, the starter's */
    char *undeclared[2];                     /* uniforms that the submission's stages lack */
    GlslStage stage;                         /* that is mutated */
    Found best;    /* of those that compute the same; its text is NULL: none does */
    bool unique;   /* no other has as many of the submission's values */
    Found mending; /* the change of the submission that makes it right, if `mended` */
    bool mended;   /* within the tolerance */
    Found second;  /* of two changes, if `two_found`: of the submission, or of a right program */
    bool two_found, mended_twice;
    int place_node; /* of the submission, in place_stage: the first wrong value; 0: not known */
    GlslStage place_stage;
    Shown shown; /* what is wrong first */
} Derivation;

/* A submission at points. NULL: it cannot be run, or, with a message, the driver failed. */
Derivation *derivation_open(const LabPictures *pictures, const SubmissionFiles *files,
                            Message *message);
void derivation_close(Derivation *all); /* NULL is fine */

/* Reads a lab's shader of a stage from a folder that ends in a slash, or "". `ending`: of its name.
 */
bool derivation_read(const Lab *lab, const ShaderLoader *loader, const char *folder, int stage,
                     const char *ending, ShaderSource *source);

/* Lab 11: whether the submission reads the shadow map for nothing: no shadow is there, or all is in
 * shadow with any map. The right program has to be open. */
bool derivation_wastes_map(Derivation *all);

/* Runs a pair at all points; the sum of how far it is from `wanted`, which may be NULL. */
double derivation_run(Derivation *all, PointShader pair[2], Numbers numbers, Numbers wanted);

/* The lab's solution, or one that is written in another way; false: it has none. */
bool right_open(Derivation *all, const char *ending);

void right_close(Derivation *all);

/* Where light at the vertices is as right. */
typedef enum LitAt { LIT_NEAREST, LIT_AT_VERTICES, LIT_AT_POINTS } LitAt;

/* Makes it the right program that is nearest to the submission, and runs it. */
void right_run(Derivation *all, LitAt lit);

/* Opens and runs all right programs: with light at the vertices or not, and with each number that a
 * task leaves open. False: there is none. */
bool right_run_all(Derivation *all);

/* The declarations of the interface's uniforms that a text lacks, but a change of it may use, as it
 * may their names, which the tree gets; a text with them. As in the other stage (NULL: none), which
 * may have them with four components. For free(). */
char *right_undeclared(const Points *points, GlslTree *tree, const GlslTree *other);
char *right_declare(const char *declarations, const char *text);

/* Adds the mistake, or two, of which a change (mutation.h) makes the submission right, or a right
 * program compute the same; less sure if others do, too, and are as near to the submission's text.
 * False: none is found. */
bool derive_mistake(Derivation *all, Verdict *verdict);

/* Runs the lab's right program of this ending; false: it has none. `order` begins where the
 * submission is farthest from it, and `wrong_by` says how far. */
bool derive_use_right(Derivation *all, const char *ending, LitAt lit);

/* Finds the one change of the submission, if any, that makes it right. True: to the last digit. */
bool mend_find(Derivation *all);

/* As mend_find, of numbers that no rule has: one of the submission is another, or a value lacks one
 * as a factor. */
void fit_find(Derivation *all);

/* Takes a change of the stage as the one that mends, if it makes all right and none that did is
 * better. */
bool mend_try(Derivation *all, const Mutation *mutation, const char *text);

/* Opens the stage's mutant: of the submission (`own`), with what it does not declare, or of the
 * right program. */
bool mend_open(const Derivation *all, const char *text, bool own, PointShader *shader);

/* How far the pair is from the right program that it is nearest to; above `most`: far. */
double mend_apart(Derivation *all, PointShader *const pair[2], double most);

/* Whether light is negative in it where it is not in the submission, so that it may be right by
 * chance: what is added three times is also right with one of them subtracted. */
bool mend_takes_light(Derivation *all, PointShader *const mended[2]);

/* Whether the submission with these texts, NULL: its own, is right in the submission's scenes, by
 * the lab's own verdict. */
bool mend_passes(Derivation *all, const char *const texts[2]);

/* Whether a node is another, or below it. */
bool mend_holds(const GlslTree *tree, int node, int wanted);

/* Whether a change of the submission is one of what the starter gave, which is right. */
bool mend_is_given(const Derivation *all, const Mutation *mutation);

/* Whether a change makes of a submission what no right program is, but of a lab of one's own. */
bool mend_is_odd(const Derivation *all, const Mutation *mutation);

/* Finds how many of the submission's values a mutant of the right program has on its way, and how
 * alike the texts are. */
void derive_compare_values(Derivation *all, Found *found);

/* Whether the pair computes what the submission does. */
bool derive_is_same(Derivation *all, PointShader *const pair[2]);

/* Finds two changes, if any: of the submission that make it right together, or of the right program
 * that is open, likely ones or any. */
typedef enum TwoOf { TWO_MEND, TWO_LIKELY, TWO_ANY } TwoOf;
bool two_find(Derivation *all, TwoOf of);

/* What shaders assign on their way, in order. */
typedef struct Assigned {
    double numbers[4];
    int size, scalar, node, symbol; /* scalar: their type, GLSL_FLOAT or another */
    int part; /* of an array or a structure: which, from 1 on; 0: it is whole */
    GlslStage stage;
} Assigned;
typedef struct Values {
    Assigned items[MAX_VALUES];
    int count;
} Values;

/* Of both shaders at a point: at its last corner, and there. */
void values_trace(const Points *points, PointShader *vertex, PointShader *fragment, int point,
                  Values *values);

/* Whether a pair has other matrices than those to world space. */
bool values_in_eye(PointShader *const pair[2]);

/* Those of a right program or its mutant; `in_eye`: all vectors in eye space, too, as directions
 * and as points. */
void values_trace_right(const Points *points, PointShader *const pair[2], int point, bool in_eye,
                        Values *values);

/* The expression that a declaration or an assignment gives a variable. */
int values_given(const GlslTree *tree, int node);

/* How many of `own` are among the others. */
int values_shared(const Values *own, const Values *other);

/* Whether two values are the same: a vec4 and its first three numbers are. */
bool values_equal(const Values *own, int number, const Values *other, int other_number);

/* Whether the value of this number is among others. */
bool values_have(const Values *values, const Values *of, int number);

/* Whether the other one, of the same shape, is another than rounding explains. */
bool values_differ(const Values *own, int number, const Values *other, int other_number);

/* Whether the submission's value of this number is the mutant's and not the right program's. */
bool values_is_wrong(const Values *own, int number, const Values *mutant, const Values *right);

/* How often operations, built-in functions, uniforms and numbers occur more in one than in the
 * other. */
int values_count_other(const GlslTree *a, const GlslTree *b);

/* Says what was found. */
void change_say(Derivation *all, Verdict *verdict);

/* Whether an expression has a variable of this name. */
bool derivation_uses(const GlslTree *tree, const char *name);

/* "line 14 of lab06.frag, float d = dot(n, l)". */
void derivation_place(const Derivation *all, GlslStage stage, int node, char *text, size_t size);

/* Adds the mistake of a submission that computes at the vertices what has to be computed at each
 * fragment; false: it does not. */
bool at_vertices_explain(Derivation *all, Verdict *verdict);

/* The same of one of its own varyings. */
bool at_vertices_explain_own(Derivation *all, Verdict *verdict);

/* What of the light is seen with `without` and not with `beside`: POINTS_NO_. */
typedef struct Term {
    char name[40];
    int without, beside;
} Term;
enum { MAX_TERMS = 7 };
int wrong_part_list(const Lab *lab, Term terms[MAX_TERMS]);
PartState wrong_part_judge(Derivation *all, const Term *term);

/* Points where it is wrong: of known scenes the worst, then others; then the worst of all. */
int first_wrong_points(const Derivation *all, int list[SHOWN_POINTS]);

/* Keeps what is shown. */
void first_wrong_take(Derivation *all, const Values *own, int number, const Values *right,
                      int other, int point);

/* Keeps the submission's first value that is wrong as that of the right program's mutant. True: the
 * right program alone assigns another. */
bool first_wrong_compare(Derivation *all, PointShader *const mutant[2]);

/* Says what is wrong first. Of a submission that is mended: fills it in, unless it is the result.
 */
void first_wrong_find(Derivation *all, Verdict *verdict, FirstWrong *first);

/* The terms that are wrong. */
typedef struct WrongParts {
    bool told;      /* which, if any */
    bool all_right; /* each by itself, so that they are combined wrongly */
    char names[256];
    Term first;
} WrongParts;

/* Says which terms are right or wrong. */
WrongParts wrong_part_say(Derivation *all, Verdict *verdict);

/* The same and, if one value alone explains all, which. */
void wrong_part_describe(Derivation *all, Verdict *verdict);

#endif
