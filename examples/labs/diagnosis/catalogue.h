/*
 * catalogue: the known mistakes, as data. No GL.
 *
 * A program is one choice per slot; 0 is right. A mistake changes one slot or several, in one or
 * several forms that are the same mistake to a student. Two mistakes whose forms share no slot can
 * be combined.
 */
#ifndef CATALOGUE_H
#define CATALOGUE_H

#include "labs/program/lab.h"

typedef enum Slot {
    SLOT_STAGE, /* where light is computed */
    SLOT_FIT,   /* lab 7's exponent: between the two right ones, or one of them */

    /* Lab 3's model matrix: product, parts, and what is done with it. */
    SLOT_ORDER,
    SLOT_MOVE,
    SLOT_TURN,
    SLOT_TURN_SIGN,
    SLOT_AXIS,
    SLOT_SCALE,
    SLOT_WORLD,

    SLOT_CLIP,        /* gl_Position */
    SLOT_PLACE,       /* the lit point, in world space */
    SLOT_NORMAL,      /* the matrix for normals */
    SLOT_NORMAL_UNIT, /* where normals are normalized */
    SLOT_NORMAL_SIGN,
    SLOT_LIGHT, /* where the direction to the light starts */
    SLOT_LIGHT_UNIT,
    SLOT_LIGHT_SIGN,
    SLOT_LIGHT_SPACE,
    SLOT_LIGHTS, /* which lights are summed */
    SLOT_LIGHT_COLOR,
    SLOT_COSINE,
    SLOT_COLOR,
    SLOT_AMBIENT,
    SLOT_REFLECTION,
    SLOT_VIEW,
    SLOT_GATE, /* if the highlight needs N.L > 0 */
    SLOT_POWER,
    SLOT_EXPONENT,
    SLOT_HIGHLIGHT_COLOR,
    SLOT_FADE, /* attenuation */
    SLOT_FADE_ON,
    SLOT_CONE,
    SLOT_CONE_SIGN,
    SLOT_CONE_FALL_OFF,
    SLOT_CONE_ON,
    SLOT_FACING,
    SLOT_BACK,
    SLOT_CULL,
    SLOT_OUTPUT,
    SLOT_LIMIT, /* of the light, before it is multiplied by the colour */
    SLOT_HIGHLIGHT_LIGHTS,
    SLOT_MAP_PLACE, /* lab 11: the place on the shadow map */
    SLOT_MAP_DEPTH, /* what is read there */
    SLOT_MAP_BIAS,
    SLOT_MAP_TEST,    /* the comparison */
    SLOT_MAP_OUTSIDE, /* what is not on the map */
    SLOT_SHADOW_ON,   /* what a shadow keeps off */
    SLOT_NUMBER,      /* of Factor: any value, found by trying */
    SLOT_COUNT,
} Slot;

/* The choices besides 0. */
enum {
    CHOICE_NONE,
#define CHOICES(group)                                                                             \
    }                                                                                              \
    ;                                                                                              \
    enum { group##_RIGHT,
#define CHOICE(name) name,
#include "labs/diagnosis/catalogue_choices.def"
#undef CHOICES
#undef CHOICE
};

typedef struct Change {
    Slot slot;
    int choice; /* 0: ends a list */
} Change;

enum { MISTAKE_MAX_FORMS = 8, MISTAKE_MAX_CHANGES = 3 };

/* A number that a mistake may have wrong: any factor, 0.01 to 100, or a number that is added. */
typedef enum Factor {
    FACTOR_NONE,
    FACTOR_DIFFUSE,
    FACTOR_AMBIENT,
    FACTOR_SPECULAR,
    FACTOR_EXPONENT,
    FACTOR_CUTOFF,
    FACTOR_SPOT_EXPONENT,
    FACTOR_ALL,
    FACTOR_GAMMA,
    FACTOR_PLUS_LIGHT, /* added to the light */
    FACTOR_PLUS_COLOR, /* added to the colour */
    FACTOR_LINEAR,
    FACTOR_QUADRATIC,
    FACTOR_CONSTANT,
    FACTOR_LIMIT,
    FACTOR_COSINE, /* the cosine's maximum */
    FACTOR_COSINE_POWER,
    FACTOR_FIRST, /* of the first light */
    FACTOR_SECOND,
    FACTOR_AMBIENT_VALUE, /* these are constants instead of a uniform */
    FACTOR_SPECULAR_VALUE,
    FACTOR_EXPONENT_VALUE,
    FACTOR_LIGHT_VALUE,
    FACTOR_CUTOFF_VALUE,
    FACTOR_SPOT_EXPONENT_VALUE,
    FACTOR_PLUS_EXPONENT, /* 20 times this is added to the exponent */
    FACTOR_RESULT,        /* the picture's maximum */
    FACTOR_FADE_LINEAR,   /* 1 / (1 + this d), where nothing is attenuated */
    FACTOR_FADE_SQUARE,   /* 1 / (1 + this d d) */
    /* Lab 11; the biases are 0.016 / (1 + this) before the division by w, 0.004 and this / 512,
     * 0.0005 / (1 + this), less 0, and by the slope. */
    FACTOR_BIAS_CLIP,
    FACTOR_BIAS_LARGE,
    FACTOR_BIAS_SMALL,
    FACTOR_BIAS_REVERSED,
    FACTOR_BIAS_SLOPE,
    FACTOR_SHADOW,       /* the light in a shadow */
    FACTOR_SHADOW_ALL,   /* and the ambient light there */
    FACTOR_SHADOW_BELOW, /* less than none */
    FACTOR_MAP_LIGHT,    /* of what the map shows in light */
    FACTOR_COUNT,
} Factor;

typedef struct Mistake {
    const char *name;
    unsigned labs; /* bit n: possible and visible in lab n */
    Change forms[MISTAKE_MAX_FORMS][MISTAKE_MAX_CHANGES];
    const char *sentence; /* what is wrong, and how it shows */
    const char *look;     /* completes "Look at ...": the place in the program */
} Mistake;

extern const Mistake MISTAKES[];

typedef struct Choices {
    int of[SLOT_COUNT];
    Factor factor; /* FACTOR_NONE: none */
    double value;  /* of the factor */
} Choices;

/* One or two forms of mistakes. */
typedef struct Suspect {
    int mistakes[2]; /* indices into MISTAKES; the second is -1 for a single mistake */
    Choices choices;
    double apart; /* from the submission: squares, summed over all scenes compared so far */
    double own;   /* from the right picture */
} Suspect;

/* All single mistakes of a lab, in each form and with each right stage and exponent. The caller
 * frees the array. */
Suspect *catalogue_singles(const Lab *lab, int *count);

/* The mistakes of a lab that are one wrong number, in each form and with each right stage, with the
 * value 1. As catalogue_singles. */
Suspect *catalogue_numbers(const Lab *lab, int *count);

/* Combines both; false if they share a slot, are the same mistake, or belong to different right
 * stages or exponents. */
bool catalogue_pair(const Suspect *a, const Suspect *b, Suspect *pair);

/* Whether the outline differs from the right one. Not for lab 3, whose outline also depends on the
 * submission's C. */
bool catalogue_moves(const Suspect *suspect);

/* What a number is: the value of its factor, in the units that a student writes. */
double factor_value(const Choices *choices);

/* The index of a name; -1: none. */
int catalogue_find(const char *name);

#endif
