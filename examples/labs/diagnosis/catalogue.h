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

/* The choices besides 0. shaders/labs/catalogue has the numbers of UNIT_, COSINE_, AMBIENT_, GATE_,
 * POWER_, FADE_ and FACING_. */
enum {
    STAGE_OTHER = 1, /* at the vertices, in labs where that is right too */
    STAGE_VERTICES,  /* at the vertices, where that is wrong */

    FIT_LEAST_SQUARES = 1,
    FIT_FOUR, /* four times Phong's */

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
    WORLD_IDENTITY,

    CLIP_UPSIDE_DOWN = 1,
    CLIP_SWAPPED,
    CLIP_ASPECT,
    CLIP_TRANSPOSED,
    CLIP_FLAT,
    CLIP_REVERSED,
    CLIP_NO_MODEL,
    CLIP_MODEL_TWICE,
    CLIP_VIEW_LAST, /* view * projection * model */
    CLIP_NO_VIEW,
    CLIP_NO_PROJECTION,

    PLACE_OBJECT = 1,
    PLACE_W_0,
    PLACE_EYE,
    PLACE_TRANSPOSED,
    PLACE_CLIP, /* gl_Position */
    PLACE_NORMAL_MATRIX,
    PLACE_UNIT,       /* normalized */
    PLACE_NOT_TO_EYE, /* left in world space, while all else is in eye space */

    NORMAL_OBJECT = 1,
    NORMAL_MODEL,
    NORMAL_MODEL_W_1,
    NORMAL_INVERSE,
    NORMAL_TRANSPOSE,
    NORMAL_EYE,
    NORMAL_TURN,
    NORMAL_UNTURNED,
    NORMAL_POSITION, /* a_Position for a_Normal */
    NORMAL_XZY,      /* components swapped */
    NORMAL_YXZ,
    NORMAL_ZYX,
    NORMAL_WORLD_POSITION,
    NORMAL_CLIP, /* by the whole projection */
    NORMAL_VIEW, /* by the view matrix alone */
    NORMAL_NOT_TO_EYE,
    NORMAL_REVERSED, /* of scale * turn */

    UNIT_NEVER = 1,
    UNIT_AT_VERTICES,
    UNIT_WITH_W = 4,
    UNIT_AT_BOTH = 3, /* as right as only at the fragments if all normals are equally long */

    SIGN_REVERSED = 1,
    SIGN_MIRRORED,       /* of the normal, by u_Mirrored */
    AXIS_NOT_TO_EYE = 2, /* of the cone: left in world space, while all else is in eye space */
    AXIS_TO_EYE,
    AXIS_W_1, /* transformed to eye space like a point, where all else is too */
    AXIS_W_1_UNIT,

    LIGHT_FROM_CENTER = 1,
    LIGHT_FROM_ORIGIN,

    LIGHT_SPACE_EYE = 1,
    LIGHT_SPACE_MODEL,
    LIGHT_SPACE_NORMAL,
    LIGHT_SPACE_MODEL_W_1,
    LIGHT_SPACE_UNIT, /* normalized */
    LIGHT_SPACE_W_0,  /* in eye space, where all else is too */
    LIGHT_SPACE_NOT_TO_EYE,

    LIGHTS_FIRST = 1,
    LIGHTS_SECOND,
    LIGHTS_MEAN,
    LIGHTS_SWAPPED, /* the colours */
    LIGHTS_FIRST_PLACE,
    LIGHTS_SECOND_PLACE,
    LIGHTS_FIRST_COLOR,
    LIGHTS_SECOND_COLOR,
    LIGHTS_PRODUCT,
    LIGHTS_LARGER,
    LIGHTS_FIRST_REVERSED,
    LIGHTS_SECOND_REVERSED,

    LIGHT_COLOR_IGNORED = 1,
    LIGHT_COLOR_SQUARED,
    LIGHT_COLOR_RED,
    LIGHT_COLOR_SWAPPED, /* red and blue */

    COSINE_UNCLAMPED = 1,
    COSINE_ABSOLUTE,
    COSINE_NONE,
    COSINE_WRAPPED,
    COSINE_SUM_CLAMPED,
    COSINE_SQUARED,
    COSINE_SINE,
    COSINE_ANGLE,
    COSINE_STEP,
    COSINE_MIN,
    COSINE_FLOOR,
    COSINE_SATURATED,
    COSINE_STEP_REVERSED,
    COSINE_PLUS_ONE,
    COSINE_UNCLAMPED_FIRST,
    COSINE_UNCLAMPED_SECOND,
    COSINE_INVERTED, /* 1 minus the cosine */

    COLOR_SQUARED = 1,
    COLOR_IGNORED,
    COLOR_ADDED,
    COLOR_SWAPPED,
    COLOR_RBG,
    COLOR_GRB,
    COLOR_LIT_IGNORED, /* these: only where it is lit, not in the ambient term */
    COLOR_LIT_SQUARED,
    COLOR_LIT_SWAPPED,

    AMBIENT_MISSING = 1,
    AMBIENT_PER_LIGHT,
    AMBIENT_COSINE,
    AMBIENT_PLAIN,
    AMBIENT_LIGHT_COLOR,
    AMBIENT_LARGER,
    AMBIENT_WHITE, /* the colour alone */
    AMBIENT_SQUARED,
    AMBIENT_FRONT,    /* also on the back */
    AMBIENT_NOT_LIT,  /* not where a light shines */
    AMBIENT_NOT_CONE, /* not within the cone */
    AMBIENT_ONLY_LIT,
    AMBIENT_NOT_BACK,

    REFLECTION_NONE = 1,
    REFLECTION_SIGN,
    REFLECTION_OTHER,
    REFLECTION_OTHER_FITTED, /* with that model's exponent */
    REFLECTION_HALF_RAW,
    REFLECTION_SUM, /* L + V, not normalized */
    REFLECTION_HALF_DIFFERENCE,
    REFLECTION_N_V,
    REFLECTION_L_V,
    REFLECTION_H_V,
    REFLECTION_SWAPPED,
    REFLECTION_SWAPPED_SIGN,
    REFLECTION_RAW_HALF, /* normalized, of L and V that are not */
    REFLECTION_R_H,
    REFLECTION_ONE, /* R = (N . L) N - L */

    VIEW_WORLD_ORIGIN = 1, /* -point, in world space */
    VIEW_EYE_SPACE,        /* -point, in eye space */
    VIEW_FIXED_EYE,        /* the eye's position, for every point */
    VIEW_FIXED_Z,
    VIEW_FIXED_AXIS,
    VIEW_FIXED_CENTER, /* from the object's centre */
    VIEW_RAW,
    VIEW_REVERSED,
    VIEW_NEGATED_EYE, /* the same for every point, from the eye */
    VIEW_OBJECT_SPACE,
    VIEW_NOT_TO_EYE, /* from the eye's position in world space to the point in eye space */

    GATE_OPEN = 1,
    GATE_COSINE,

    POWER_ANY = 1,
    POWER_ABSOLUTE,
    POWER_SWAPPED,
    POWER_FACTOR,
    POWER_CLAMPED_LATE,
    POWER_SATURATED,
    POWER_SCHLICK,

    EXPONENT_PLAIN = 1,
    EXPONENT_ONE,
    EXPONENT_QUARTER,
    EXPONENT_SQUARED,

    HIGHLIGHT_TINTED = 1,
    HIGHLIGHT_WHITE_LIGHT,
    HIGHLIGHT_WHITE,
    HIGHLIGHT_ENERGY_2, /* times (n + 2) / 2 pi */
    HIGHLIGHT_ENERGY_8, /* times (n + 8) / 8 pi */

    FADE_MISSING = 1,
    FADE_INVERTED,
    FADE_SQUARED,
    FADE_SWAPPED,
    FADE_NO_LINEAR,
    FADE_NO_QUADRATIC,
    FADE_NO_CONSTANT,
    FADE_UNIT,
    FADE_INVERSE_SQUARE,
    FADE_INVERSE,
    FADE_ONE_PLUS_SQUARE,
    FADE_ALL_LINEAR,
    FADE_ALL_SQUARED,
    FADE_EYE, /* by the distance to the eye */
    FADE_TWICE,
    FADE_TUTORIAL, /* 1 / (1 + 0.09 d + 0.032 d d) */

    ON_AMBIENT = 1,
    ON_NO_HIGHLIGHT,

    CONE_DEGREES = 1,
    CONE_ANGLE,
    CONE_ANGLE_DEGREES,
    CONE_NONE,
    CONE_WHOLE,
    CONE_OUTSIDE,
    CONE_DEGREES_TWICE,
    CONE_HARD_COSINE, /* the cosine of the cutoff, in degrees, as it is */
    CONE_RADIANS_TWICE,

    FALL_OFF_NONE = 1,
    FALL_OFF_ONE,
    FALL_OFF_LINEAR,
    FALL_OFF_SMOOTH,
    FALL_OFF_SHININESS,
    FALL_OFF_LINEAR_POWER,

    FACING_NONE = 1,
    FACING_UNMIRRORED,
    FACING_SWAPPED,
    FACING_LIGHT,
    FACING_BACK,
    FACING_VIEW, /* by the angle to the eye: as right as 0 */
    FACING_VIEW_SWAPPED,
    FACING_AXIS,     /* by the angle to the camera's axis */
    FACING_MIRRORED, /* always taken as mirrored */
    FACING_ORIGIN,   /* by the angle to the world's origin */
    FACING_EYE,      /* by that to the eye's position as a direction */

    BACK_FRONT_COLOR = 1,
    BACK_NOT_REVERSED,
    BACK_PRODUCT, /* of both colours */
    BACK_COLORS_SWAPPED,
    BACK_COLORS_MIRRORED, /* swapped in a mirror */
    BACK_NEVER_MIRRORED,  /* the back has the front's colour in a mirror */

    CULL_FRONT = 1,
    CULL_BACK,

    OUTPUT_GAMMA = 1,
    OUTPUT_ROOT,
    OUTPUT_POWER,
    OUTPUT_SQUARE,
    OUTPUT_INVERTED,
    OUTPUT_SWAPPED,
    OUTPUT_GREY,
    OUTPUT_BLACK,
    OUTPUT_WHITE,

    LIMIT_ALL = 1,
    LIMIT_DIFFUSE,
    LIMIT_EACH,

    HIGHLIGHT_LIGHTS_FIRST = 1,
    HIGHLIGHT_LIGHTS_SECOND,

    MAP_PLACE_NO_W = 1, /* not divided by w */
    MAP_PLACE_NO_RANGE, /* -1 to 1, as it is */
    MAP_PLACE_NO_RANGE_DEPTH,
    MAP_PLACE_NO_RANGE_XY,
    MAP_PLACE_FLIPPED,
    MAP_PLACE_MIRRORED,
    MAP_PLACE_OBJECT,     /* of the object's vertex */
    MAP_PLACE_NO_W_RANGE, /* neither */
    MAP_PLACE_YXZ,        /* components swapped */
    MAP_PLACE_XZY,
    MAP_PLACE_VERTICES, /* divided by w there */
    MAP_PLACE_CLIP,     /* the eye's clip space */
    MAP_PLACE_ORDER,    /* the two matrices in the wrong order */

    MAP_DEPTH_RED = 1, /* one channel of three */
    MAP_DEPTH_BGR,

    MAP_BIAS_NONE = 1,
    MAP_BIAS_REVERSED,
    MAP_BIAS_SMALL, /* right, but beside the map, if that is not asked for, others are dark */
    MAP_BIAS_MIDDLE,
    MAP_BIAS_LARGE,

    MAP_TEST_INVERTED = 1,
    MAP_TEST_NEVER, /* no shadow */
    MAP_TEST_ALWAYS,
    MAP_TEST_ALL_INVERTED, /* also beside the map */

    MAP_OUTSIDE_CLAMPED = 1, /* as its nearest edge */
    MAP_OUTSIDE_DARK,
    MAP_OUTSIDE_UNHALVED, /* asks for 0 to 1 of what goes from -1 to 1 */
    MAP_OUTSIDE_HALVED,   /* asks for -1 to 1 of what goes from 0 to 1 */

    SHADOW_ON_ALL = 1,
    SHADOW_ON_AMBIENT, /* alone */
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
 * frees the array; NULL: out of memory. */
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
