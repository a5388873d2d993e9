/*
 * catalogue: the mistakes that are known, as data. No GL.
 *
 * A program is described by one choice in each slot; zero is right everywhere. A mistake is a
 * change of one slot or a few, in one or several forms that are the same mistake to a student.
 * Two mistakes whose forms touch no slot in common can be made at once.
 */
#ifndef CATALOGUE_H
#define CATALOGUE_H

#include "lab.h"

typedef enum Slot {
    SLOT_STAGE, /* where light is computed */
    SLOT_FIT,   /* which exponent, lab 7: that between the two that are right, or one of them */
    SLOT_ORDER, /* lab 3's model matrix: the product, */
    SLOT_MOVE,  /* its parts, */
    SLOT_TURN,
    SLOT_TURN_SIGN,
    SLOT_AXIS,
    SLOT_SCALE,
    SLOT_WORLD,  /* and what becomes of it */
    SLOT_CLIP,   /* where it is drawn */
    SLOT_PLACE,  /* the point that is lit, in the world */
    SLOT_NORMAL, /* the normal's matrix */
    SLOT_NORMAL_UNIT,
    SLOT_NORMAL_SIGN,
    SLOT_LIGHT, /* what the direction to the light is */
    SLOT_LIGHT_UNIT,
    SLOT_LIGHT_SIGN,
    SLOT_LIGHT_SPACE,
    SLOT_LIGHTS, /* how many count */
    SLOT_LIGHT_COLOR,
    SLOT_COSINE,
    SLOT_COLOR,
    SLOT_AMBIENT,
    SLOT_REFLECTION,
    SLOT_VIEW,
    SLOT_GATE,
    SLOT_POWER,
    SLOT_EXPONENT,
    SLOT_HIGHLIGHT_COLOR,
    SLOT_FADE,
    SLOT_FADE_ON,
    SLOT_CONE,
    SLOT_CONE_SIGN,
    SLOT_CONE_FALL_OFF,
    SLOT_CONE_ON,
    SLOT_FACING,
    SLOT_BACK,
    SLOT_CULL,
    SLOT_OUTPUT,
    SLOT_COUNT,
} Slot;

/* The choices besides 0. */
enum {
    STAGE_OTHER = 1, /* the vertices, where both are right */
    STAGE_VERTICES,  /* where that is wrong */

    FIT_LEAST = 1, /* the fitted one */
    FIT_FOUR,      /* four times Phong's */

    ORDER_MOVED_FIRST = 1,
    ORDER_SCALED_LAST,
    ORDER_REVERSED,

    PART_MISSING = 1, /* of move, turn and scale */
    PART_INVERSE,
    TURN_RADIANS,
    TURN_DEGREES,

    AXIS_X = 1,
    AXIS_Y,
    AXIS_Z,

    WORLD_TRANSPOSED = 1,
    WORLD_INVERSE,

    CLIP_UPSIDE_DOWN = 1,
    CLIP_SWAPPED,
    CLIP_ASPECT,
    CLIP_TRANSPOSED,
    CLIP_FLAT,
    CLIP_REVERSED,
    CLIP_NO_MODEL,

    PLACE_OBJECT = 1,
    PLACE_W_0,
    PLACE_EYE,
    PLACE_TRANSPOSED,

    NORMAL_OBJECT = 1,
    NORMAL_MODEL,
    NORMAL_MODEL_W_1,
    NORMAL_INVERSE,
    NORMAL_TRANSPOSE,
    NORMAL_EYE,
    NORMAL_TURN,
    NORMAL_UNTURNED,

    UNIT_NEVER = 1,
    UNIT_AT_VERTICES,
    UNIT_AT_BOTH, /* as right as at the fragments alone, where all normals are equally long */

    SIGN_REVERSED = 1,

    LIGHT_FROM_CENTER = 1,
    LIGHT_FROM_ORIGIN,

    LIGHT_SPACE_EYE = 1,

    LIGHTS_FIRST = 1,
    LIGHTS_SECOND,
    LIGHTS_MEAN,

    LIGHT_COLOR_IGNORED = 1,
    LIGHT_COLOR_SQUARED,

    COSINE_UNCLAMPED = 1,
    COSINE_ABSOLUTE,
    COSINE_NONE,
    COSINE_WRAPPED,

    COLOR_SQUARED = 1,
    COLOR_IGNORED,

    AMBIENT_MISSING = 1,
    AMBIENT_PER_LIGHT,
    AMBIENT_COSINE,
    AMBIENT_PLAIN,
    AMBIENT_LIGHT_COLOR,
    AMBIENT_LARGER,

    REFLECTION_NONE = 1,
    REFLECTION_SIGN,
    REFLECTION_OTHER,
    REFLECTION_OTHER_FITTED, /* with the exponent that would go with it */
    REFLECTION_HALF_RAW,

    VIEW_WORLD_ORIGIN = 1, /* -place, in the world */
    VIEW_EYE_SPACE,        /* -place, in eye coordinates */
    VIEW_FIXED_EYE,        /* the eye's place, whatever the point */
    VIEW_FIXED_Z,
    VIEW_FIXED_AXIS,
    VIEW_FIXED_CENTER, /* from the object's centre */
    VIEW_RAW,

    GATE_OPEN = 1,
    GATE_COSINE,

    POWER_ANY = 1,
    POWER_ABSOLUTE,

    EXPONENT_PLAIN = 1,
    EXPONENT_ONE,
    EXPONENT_QUARTER,

    HIGHLIGHT_TINTED = 1,
    HIGHLIGHT_WHITE_LIGHT,
    HIGHLIGHT_WHITE,

    FADE_MISSING = 1,
    FADE_INVERTED,
    FADE_SQUARED,
    FADE_SWAPPED,
    FADE_NO_LINEAR,
    FADE_NO_QUADRATIC,
    FADE_NO_CONSTANT,
    FADE_UNIT,
    FADE_INVERSE_SQUARE,

    ON_AMBIENT = 1,
    ON_NO_HIGHLIGHT,

    CONE_DEGREES = 1,
    CONE_ANGLE,
    CONE_ANGLE_DEGREES,
    CONE_NONE,
    CONE_WHOLE,
    CONE_OUTSIDE,

    FALL_OFF_NONE = 1,
    FALL_OFF_ONE,

    FACING_NONE = 1,
    FACING_UNMIRRORED,
    FACING_SWAPPED,
    FACING_LIGHT,

    BACK_FRONT_COLOR = 1,
    BACK_NOT_REVERSED,

    CULL_FRONT = 1,

    OUTPUT_GAMMA = 1,
};

typedef struct Change {
    Slot slot;
    int choice; /* 0: ends a list */
} Change;

enum { MISTAKE_MOST_FORMS = 4, MISTAKE_MOST_CHANGES = 3 };

typedef struct Mistake {
    const char *name;
    unsigned labs; /* bit n: it can be made, and shows, in lab n */
    Change forms[MISTAKE_MOST_FORMS][MISTAKE_MOST_CHANGES];
    const char *sentence; /* what is wrong, and how it shows */
    const char *look;     /* "Look at ...": the place in the program */
} Mistake;

extern const Mistake MISTAKES[];
extern const int MISTAKE_COUNT;

/* What a program does. */
typedef struct Choices {
    int of[SLOT_COUNT];
} Choices;

/* One or two forms of mistakes. */
typedef struct Suspect {
    int mistakes[2]; /* numbers in MISTAKES; the second -1 for one alone */
    Choices choices;
} Suspect;

/* All single mistakes of a lab, in each form and with each stage and exponent that is right. The
 * array is malloc'ed; NULL where memory runs out. */
Suspect *catalogue_singles(const Lab *lab, int *count);

/* Makes both; false where they touch the same slot, are one mistake, or go with different truths.
 */
bool catalogue_pair(const Suspect *a, const Suspect *b, Suspect *pair);

/* Whether the suspect draws the object elsewhere: its outline differs. Not for lab 3, where the
 * outline also follows the submission's C. */
bool catalogue_moves(const Suspect *suspect);

/* -1 where there is none of that name. */
int catalogue_find(const char *name);

#endif
