/* Lab 3's matrices are numbers, so they are judged as numbers. A model matrix that is move * turn *
 * scale can be taken apart: its last column is the move, the lengths of the others are the scale,
 * what is left is the turn, whose axis is in its antisymmetric part and whose angle is in its
 * trace. What is true of these in all scenes are facts; a rule is a set of facts with a name. */
#include "labs/diagnosis/diagnose.h"

#include "core/example.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static Mat4 right_world(double seconds)
{
    Mat4 move, turn, scale;
    lab_scene_world_parts(seconds, &move, &turn, &scale);
    return mat4_product(move, mat4_product(turn, scale));
}

/* The directions of the normals along x, y and z are what the picture depends on. */
static bool normals_are_right(const LabPictures *pictures, int i, char said[VERDICT_SENTENCE_SIZE])
{
    const Mat4 right = binding_normal_matrix(right_world(pictures->items[i].lab_scene.seconds));
    /* Any positive multiple is right, the same for all of the matrix. */
    double product = 0, square = 0;
    for (int k = 0; k < 12; k++) {
        if (k % 4 == 3)
            continue;
        product += right.m[k] * pictures->normal_matrix[i].m[k];
        square += right.m[k] * right.m[k];
    }
    const double factor = product / square;
    for (int k = 0; k < 12; k++) {
        const double wanted = factor * right.m[k], found = pictures->normal_matrix[i].m[k];
        if (k % 4 == 3 || fabs(found - wanted) <= 2 * MATRICES_TOLERANCE * fabs(factor))
            continue;
        snprintf(said, VERDICT_SENTENCE_SIZE,
                 "The normal matrix after %g s: row %d, column %d is %.4g; a multiple of the right "
                 "one has %.4g there.",
                 pictures->items[i].lab_scene.seconds, k % 4, k / 4, found, wanted);
        return false;
    }
    return factor > 0;
}

bool matrices_are_right(const LabPictures *pictures, char said[VERDICT_SENTENCE_SIZE])
{
    said[0] = '\0';
    for (int i = 0; i < pictures->count; i++) {
        const double seconds = pictures->items[i].lab_scene.seconds;
        const Mat4 right = right_world(seconds);
        for (int k = 15; k >= 0; k--) {
            const double found = pictures->world_from_object[i].m[k];
            if (fabs(found - right.m[k]) <= MATRICES_TOLERANCE)
                continue;
            snprintf(said, VERDICT_SENTENCE_SIZE,
                     "The model matrix after %g s: row %d, column %d is %.4g; right is %.4g.",
                     seconds, k % 4, k / 4, found, right.m[k]);
            return false;
        }
        if (!normals_are_right(pictures, i, said))
            return false;
    }
    return true;
}

/* A model matrix taken apart as move * turn * scale. */
typedef struct Parts {
    double move[3], scale[3];
    double axis[3], degrees; /* of the turn; 0 to 180 */
    bool turns;              /* what is left is a rotation */
} Parts;

static Parts take_apart(const Mat4 *matrix)
{
    Parts parts = {.turns = true};
    double turn[9], cosine;
    for (int column = 0; column < 3; column++) {
        const double *m = matrix->m + 4 * column;
        parts.move[column] = matrix->m[12 + column];
        parts.scale[column] = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
        for (int row = 0; row < 3; row++)
            turn[3 * column + row] = m[row] / parts.scale[column];
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < a; b++)
            parts.turns &= fabs(turn[3 * a] * turn[3 * b] + turn[3 * a + 1] * turn[3 * b + 1] +
                                turn[3 * a + 2] * turn[3 * b + 2]) < MATRICES_TOLERANCE;
    const double axis[3] = {turn[5] - turn[7], turn[6] - turn[2], turn[1] - turn[3]};
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    cosine = fmin(fmax((turn[0] + turn[4] + turn[8] - 1) / 2, -1), 1);
    parts.degrees = atan2(length / 2, cosine) * 180 / acos(-1);
    for (int i = 0; i < 3; i++)
        parts.axis[i] = length > 0 ? axis[i] / length : 0;
    return parts;
}

static bool is_near(const double *a, const double *b)
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(a[i] - b[i]) <= MATRICES_TOLERANCE))
            return false;
    return true;
}

/* By which the right matrix's columns are multiplied in the one found; false: it is no such. */
static bool column_factors(const Mat4 *found, const Mat4 *right, double factors[3])
{
    for (int column = 0; column < 3; column++) {
        const double *a = found->m + 4 * column, *b = right->m + 4 * column;
        const double factor =
            (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
        const double scaled[3] = {factor * b[0], factor * b[1], factor * b[2]};
        if (!is_near(a, scaled))
            return false;
        factors[column] = factor;
    }
    return true;
}

static bool is_identity(const Mat4 *matrix)
{
    const Mat4 identity = mat4_identity();
    for (int i = 0; i < 16; i++)
        if (!(fabs(matrix->m[i] - identity.m[i]) <= MATRICES_TOLERANCE))
            return false;
    return true;
}

/* What is true of the matrices of all scenes. */
enum {
    NEVER_SET = 1 << 0,
    COLUMNS = 1 << 1, /* the right ones, each times the same factor everywhere */
    TURNS = 1 << 2,   /* they can be taken apart */
    MOVED = 1 << 3,   /* these four are right */
    SCALED = 1 << 4,
    TURNED = 1 << 5,
    ABOUT_AXIS = 1 << 6,
    AS_FAR = 1 << 7, /* the angle is right, if not its axis */
    SAME_MOVE = 1 << 8,
    SAME_TURN = 1 << 9,
    SAME_AXIS = 1 << 10,
    LINEAR = 1 << 11, /* the angle is in proportion to the time */
};

typedef struct Facts {
    unsigned true_of_all;
    double factors[3]; /* of the columns */
    Parts first;       /* of the first scene's */
    double rate;       /* degrees per second */
} Facts;

static void note(Facts *facts, unsigned fact, bool holds)
{
    if (!holds)
        facts->true_of_all &= ~fact;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Near 0 and 180 degrees the axis cannot be told. */
static void add_turn(Facts *facts, const Parts *found, double seconds, bool is_first)
{
    Vec3 unit;
    if (found->degrees < 3 || found->degrees > 177)
        return;
    vec3_normalize(LAB_AXIS, &unit);
    const double axis[3] = {unit.x, unit.y, unit.z}, own = dot(found->axis, axis);
    const double sign = dot(found->axis, facts->first.axis) < 0 ? -1 : 1;
    const double flipped[3] = {sign * found->axis[0], sign * found->axis[1], sign * found->axis[2]};
    const double whole = own < 0 ? 360 - found->degrees : found->degrees;
    if (is_first)
        facts->rate = whole / seconds;
    const double apart = remainder(facts->rate * seconds - whole, 360);
    note(facts, SAME_AXIS, is_near(flipped, facts->first.axis));
    note(facts, ABOUT_AXIS, fabs(fabs(own) - 1) < 1e-5);
    note(facts, TURNED, fabs(remainder(whole - DEGREES_PER_SECOND * seconds, 360)) < 0.06);
    note(facts, LINEAR, fabs(apart) < 0.1 + 0.002 * seconds);
}

static Facts gather_facts(const LabPictures *pictures)
{
    Facts facts = {.true_of_all = ~0u, .factors = {1, 1, 1}};
    double now[3] = {0};
    for (int i = 0; i < pictures->count; i++) {
        const double seconds = pictures->items[i].lab_scene.seconds;
        const Mat4 *matrix = &pictures->world_from_object[i], wanted = right_world(seconds);
        const Parts found = take_apart(matrix), right = take_apart(&wanted);
        if (i == 0)
            facts.first = found;
        note(&facts, COLUMNS,
             column_factors(matrix, &wanted, now) && (i == 0 || is_near(now, facts.factors)));
        memcpy(facts.factors, now, sizeof now);
        note(&facts, NEVER_SET, is_identity(matrix));
        note(&facts, TURNS, found.turns);
        note(&facts, MOVED, is_near(found.move, right.move));
        note(&facts, SCALED, is_near(found.scale, right.scale));
        note(&facts, AS_FAR, fabs(found.degrees - right.degrees) < 0.06);
        note(&facts, SAME_MOVE, is_near(found.move, facts.first.move));
        note(&facts, SAME_TURN, fabs(found.degrees - facts.first.degrees) < 0.06);
        add_turn(&facts, &found, seconds, i == 0);
    }
    return facts;
}

/* The first rule all of whose facts hold, and none of the others, names the mistake. */
typedef struct Rule {
    unsigned all, none;
    const char *name;
    const char *sentence; /* followed by the numbers, if there are any */
    enum { NO_NUMBERS, SCALE, TRANSLATION, AXIS, RATE } numbers;
    const char *look;
} Rule;

#define ANGLE "the angle: 30 degrees times seconds"

static const Rule RULES[] = {
    {NEVER_SET, 0, "model matrix never set", "The model matrix is still the identity.", NO_NUMBERS,
     "the assignment to *world_from_model"},
    {COLUMNS | MOVED, SCALED, "wrong scale", "The scale", SCALE,
     "the numbers of the scale: (2, 0.7, 1.2); in C 7 / 10 is 0"},
    {TURNS | TURNED | ABOUT_AXIS | SCALED | SAME_MOVE, MOVED, "wrong translation",
     "The translation", TRANSLATION, "the numbers of the translation: (0.5, 0.3, -0.8)"},
    {TURNS | MOVED | SCALED | AS_FAR | SAME_AXIS, ABOUT_AXIS, "wrong axis", "The axis, normalized,",
     AXIS, "the numbers of the axis: (1, 2, 0.5)"},
    {TURNS | MOVED | SCALED | ABOUT_AXIS | SAME_TURN, TURNED, "a constant angle",
     "The cube is turned, but always by the same angle.", NO_NUMBERS, ANGLE},
    {TURNS | MOVED | SCALED | ABOUT_AXIS | LINEAR, TURNED, "wrong angle", "The cube turns by", RATE,
     ANGLE},
    {TURNS | MOVED | SCALED | ABOUT_AXIS, TURNED, "wrong angle",
     "The cube is turned by a wrong angle.", NO_NUMBERS, ANGLE},
};

static void say(const Rule *rule, const Facts *facts, char sentence[VERDICT_SENTENCE_SIZE])
{
    const double scale[3] = {2 * facts->factors[0], 0.7 * facts->factors[1],
                             1.2 * facts->factors[2]};
    const double *numbers[] = {
        [SCALE] = scale, [TRANSLATION] = facts->first.move, [AXIS] = facts->first.axis};
    if (rule->numbers == NO_NUMBERS)
        snprintf(sentence, VERDICT_SENTENCE_SIZE, "%s", rule->sentence);
    else if (rule->numbers == RATE)
        snprintf(sentence, VERDICT_SENTENCE_SIZE, "%s %.4g degrees per second.", rule->sentence,
                 facts->rate);
    else
        snprintf(sentence, VERDICT_SENTENCE_SIZE, "%s is (%.3g, %.3g, %.3g).", rule->sentence,
                 numbers[rule->numbers][0], numbers[rule->numbers][1], numbers[rule->numbers][2]);
}

bool matrices_name(const LabPictures *pictures, Verdict *verdict)
{
    char sentence[VERDICT_SENTENCE_SIZE];
    const Facts facts = gather_facts(pictures);
    for (size_t i = 0; i < sizeof RULES / sizeof RULES[0]; i++) {
        const Rule *rule = &RULES[i];
        if ((facts.true_of_all & rule->all) != rule->all || (facts.true_of_all & rule->none))
            continue;
        say(rule, &facts, sentence);
        verdict_add_mistake(verdict, rule->name, sentence, rule->look, 0.9);
        snprintf(verdict->message, sizeof verdict->message, "%s", rule->name);
        return true;
    }
    return false;
}
