/* Lab 3's matrices are numbers, so they are judged as numbers. A model matrix that is move * turn *
 * scale can be taken apart: its last column is the move, the lengths of the others are the scale,
 * what is left is the turn, whose axis is in its antisymmetric part and whose angle is in its
 * trace. What is true of these in all scenes are facts; a rule is a set of facts with a name. Other
 * products than the right one are formulas, which are computed and compared. */
#include "labs/diagnosis/diagnose.h"

#include "base/text.h"
#include "core/example.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static Mat4 right_world(double seconds)
{
    Mat4 move, turn, scale;
    lab_scene_world_parts(seconds, &move, &turn, &scale);
    return mat4_product(move, mat4_product(turn, scale));
}

/* By which the directions of normals differ, along x, y and z, is what the picture depends on: any
 * positive multiple is the same, one for all of the matrix. The first element that is another is in
 * *at, and what it would have to be in *wanted. */
static bool same_normals(const Mat4 *found, const Mat4 *right, int *at, double *wanted)
{
    double product = 0, square = 0;
    for (int k = 0; k < 12; k++) {
        if (k % 4 == 3)
            continue;
        product += right->m[k] * found->m[k];
        square += right->m[k] * right->m[k];
    }
    const double factor = product / square;
    for (*at = 0; *at < 12; ++*at) {
        *wanted = factor * right->m[*at];
        if (*at % 4 != 3 &&
            !(fabs(found->m[*at] - *wanted) <= 2 * MATRICES_TOLERANCE * fabs(factor)))
            return false;
    }
    return factor > 0;
}

static bool normals_are_right(const LabPictures *pictures, int i, char said[VERDICT_SENTENCE_SIZE])
{
    const Mat4 right = binding_normal_matrix(right_world(pictures->items[i].lab_scene.seconds));
    int at;
    double wanted;
    if (same_normals(&pictures->normal_matrix[i], &right, &at, &wanted))
        return true;
    if (at < 12)
        snprintf(said, VERDICT_SENTENCE_SIZE,
                 "The normal matrix after %g s: row %d, column %d is %.4g; a multiple of the right "
                 "one has %.4g there.",
                 pictures->items[i].lab_scene.seconds, at % 4, at / 4,
                 pictures->normal_matrix[i].m[at], wanted);
    return false;
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

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static Parts take_apart(const Mat4 *matrix)
{
    Parts parts = {.turns = true};
    double turn[9], cosine;
    for (int column = 0; column < 3; column++) {
        const double *m = matrix->m + 4 * column;
        parts.move[column] = matrix->m[12 + column];
        parts.scale[column] = sqrt(dot(m, m));
        for (int row = 0; row < 3; row++)
            turn[3 * column + row] = m[row] / parts.scale[column];
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < a; b++)
            parts.turns &= fabs(dot(turn + 3 * a, turn + 3 * b)) < MATRICES_TOLERANCE;
    const double axis[3] = {turn[5] - turn[7], turn[6] - turn[2], turn[1] - turn[3]};
    const double length = sqrt(dot(axis, axis));
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
        const double factor = dot(a, b) / dot(b, b);
        const double scaled[3] = {factor * b[0], factor * b[1], factor * b[2]};
        if (!is_near(a, scaled))
            return false;
        factors[column] = factor;
    }
    return true;
}

/* What is true of the matrices of all scenes. */
enum {
    COLUMNS = 1 << 0, /* the right ones, each times the same factor everywhere */
    TURNS = 1 << 1,   /* they can be taken apart */
    MOVED = 1 << 2,   /* these four are right */
    SCALED = 1 << 3,
    TURNED = 1 << 4,
    ABOUT_AXIS = 1 << 5,
    AS_FAR = 1 << 6, /* the angle is right, if not its axis */
    SAME_MOVE = 1 << 7,
    SAME_TURN = 1 << 8,
    SAME_AXIS = 1 << 9,
    LINEAR = 1 << 10, /* the angle is in proportion to the time */
    WHOLE = 1 << 11,  /* it has no fraction */
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
    note(facts, WHOLE, fabs(remainder(whole, 1)) < 0.01);
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
    enum { SCALE, TRANSLATION, AXIS, RATE, NO_NUMBERS } numbers; /* from RATE on: of the angle */
    const char *look;
} Rule;

#define ANGLE "the angle: 30 degrees times seconds"

static const Rule RULES[] = {
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
    {TURNS | MOVED | SCALED | ABOUT_AXIS | WHOLE, TURNED, "angle without its fraction",
     "The cube is always turned by whole degrees: an integer cuts the fraction off.", NO_NUMBERS,
     "the angle is a double: 30 degrees times seconds"},
    {TURNS | MOVED | SCALED | ABOUT_AXIS, TURNED, "wrong angle",
     "The cube is turned by a wrong angle.", NO_NUMBERS, ANGLE},
};

static void say(const Rule *rule, const Facts *facts, char sentence[VERDICT_SENTENCE_SIZE])
{
    const double *by = facts->factors;
    const double scale[3] = {LAB_SCALE.x * by[0], LAB_SCALE.y * by[1], LAB_SCALE.z * by[2]};
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

/* What the formula of a rotation about a unit axis makes of an axis of this length. */
static Mat4 stretched_turn(const Mat4 *turn, double length)
{
    Mat4 stretched = mat4_identity();
    const double cosine = (turn->m[0] + turn->m[5] + turn->m[10] - 1) / 2;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++) {
            const double a = turn->m[4 * column + row], b = turn->m[4 * row + column];
            const double kept = row == column ? cosine : 0;
            stretched.m[4 * column + row] =
                kept + ((a + b) / 2 - kept) * length * length + (a - b) / 2 * length;
        }
    return stretched;
}

/* A formula of matrices: matrix_forms.def says what its letters mean. */
static Mat4 form_matrix(const char *form, double seconds, const Mat4 *world)
{
    static const char LETTERS[] = "MTSWA";
    const char *const first = form;
    Mat4 parts[5], product = mat4_identity(), inverse;
    lab_scene_world_parts(seconds, &parts[0], &parts[1], &parts[2]);
    parts[3] = *world;
    parts[4] = stretched_turn(&parts[1], vec3_length(LAB_AXIS));
    for (; *form; form++) {
        const char *at = strchr(LETTERS, toupper((unsigned char)*form));
        if (at && isupper((unsigned char)*form))
            product = mat4_product(product, parts[at - LETTERS]);
        else if (at && mat4_inverse(parts[at - LETTERS], &inverse))
            product = mat4_product(product, inverse);
        else if (*form == '\'')
            product = mat4_transpose(product);
    }
    if (strchr(first, 'N'))
        product = binding_normal_matrix(product);
    return first[0] == '-' ? mat4_product(mat4_scale((Vec3){-1, -1, -1}), product) : product;
}

typedef struct Form {
    enum { MODEL, NORMAL } of;
    const char *formula, *name, *sentence, *look;
} Form;

static const Form FORMS[] = {
#include "labs/diagnosis/matrix_forms.def"
};

/* Whether a formula gives the submission's matrices in all scenes. `own`: W is its own. */
static bool has_form(const LabPictures *pictures, int of, const char *formula, bool own)
{
    bool same = true;
    for (int i = 0; i < pictures->count && same; i++) {
        const double seconds = pictures->items[i].lab_scene.seconds;
        const Mat4 right = right_world(seconds), *world = &pictures->world_from_object[i];
        const Mat4 wanted = form_matrix(formula, seconds, own ? world : &right);
        int at;
        double number;
        for (int k = 0; k < 16 && of == MODEL; k++)
            same &= fabs(world->m[k] - wanted.m[k]) <= MATRICES_TOLERANCE;
        if (of == NORMAL)
            same = same_normals(&pictures->normal_matrix[i], &wanted, &at, &number);
    }
    return same;
}

/* Whether it is right, or which form it has. *right: of its own model matrix, too. */
static const Form *find_form(const LabPictures *pictures, int of, bool *right)
{
    *right = of == MODEL
                 ? has_form(pictures, of, "MTS", false)
                 : has_form(pictures, of, "NW", false) || has_form(pictures, of, "NW", true);
    for (size_t i = 0; i < sizeof FORMS / sizeof FORMS[0] && !*right; i++)
        if ((int)FORMS[i].of == of && (has_form(pictures, of, FORMS[i].formula, false) ||
                                       has_form(pictures, of, FORMS[i].formula, true)))
            return &FORMS[i];
    return NULL;
}

/* The last line where lab_matrices uses this one of its parameters: the seconds, then its results,
 * where they were set; 0: not known. */
static int line_of(const char *code, int parameter)
{
    const char *name = code ? strstr(code, "lab_matrices") : NULL;
    int line = 1, found = 0;
    size_t length = 0;
    for (int i = 0; i <= parameter && name; i++)
        name = strpbrk(name + 1, ",)");
    while (name && !text_is_word(*name))
        name--;
    for (; name > code && text_is_word(name[-1]); length++)
        name--;
    length += name != NULL;
    for (const char *at = code; length > 0 && *at; line += *at++ == '\n')
        if (at > name && strncmp(at, name, length) == 0 && !text_is_word(at[-1]) &&
            !text_is_word(at[length]))
            found = line;
    return found;
}

static void blame(Verdict *verdict, const Lab *lab, const char *code, int parameter,
                  const Form *what)
{
    char look[VERDICT_SENTENCE_SIZE];
    const int line = line_of(code, parameter);
    snprintf(look, sizeof look, "line %d of %s: %s", line, lab->code, what->look);
    verdict_add_mistake(verdict, what->name, what->sentence, line ? look : what->look, 0.9);
}

/* The model matrix taken apart. */
static bool name_facts(const LabPictures *pictures, const char *code, Verdict *verdict)
{
    char sentence[VERDICT_SENTENCE_SIZE];
    const Facts facts = gather_facts(pictures);
    for (size_t i = 0; i < sizeof RULES / sizeof RULES[0]; i++) {
        const Rule *rule = &RULES[i];
        if ((facts.true_of_all & rule->all) != rule->all || (facts.true_of_all & rule->none))
            continue;
        say(rule, &facts, sentence);
        blame(verdict, pictures->lab, code, rule->numbers < RATE,
              &(Form){.name = rule->name, .sentence = sentence, .look = rule->look});
        return true;
    }
    return false;
}

/* The scale whose inverse the normal matrix has in all scenes, beside the right turn; false: there
 * is none. Any multiple is the same: that one is told which agrees most with the right scale. */
static bool inverted_scale(const LabPictures *pictures, double scale[3])
{
    const double wanted[3] = {LAB_SCALE.x, LAB_SCALE.y, LAB_SCALE.z};
    double first[3], now[3];
    int most = 0;
    for (int i = 0; i < pictures->count; i++) {
        const Mat4 right = binding_normal_matrix(right_world(pictures->items[i].lab_scene.seconds));
        if (!column_factors(&pictures->normal_matrix[i], &right, now) ||
            !(now[0] * now[1] * now[2] != 0))
            return false;
        for (int k = 0; k < 3; k++)
            now[k] /= now[2];
        if (i == 0)
            memcpy(first, now, sizeof first);
        if (!is_near(now, first))
            return false;
    }
    for (int of = 0; of < 3; of++) {
        double other[3];
        int same = 0;
        for (int k = 0; k < 3; k++) {
            other[k] = wanted[k] * first[of] / first[k];
            same += fabs(other[k] - wanted[k]) <= MATRICES_TOLERANCE;
        }
        if (same > most)
            memcpy(scale, other, sizeof other), most = same;
    }
    return most > 0;
}

static bool name_normal_scale(const LabPictures *pictures, const char *code, Verdict *verdict)
{
    char sentence[VERDICT_SENTENCE_SIZE];
    double scale[3];
    if (!inverted_scale(pictures, scale))
        return false;
    snprintf(sentence, sizeof sentence,
             "The normal matrix is turned rightly, but is the inverse of a scale by (%.3g, %.3g, "
             "%.3g).",
             scale[0], scale[1], scale[2]);
    blame(verdict, pictures->lab, code, 1 + NORMAL,
          &(Form){.name = "wrong scale of the normal matrix",
                  .sentence = sentence,
                  .look = "the numbers that are inverted: (2, 0.7, 1.2)"});
    return true;
}

void matrices_name(const LabPictures *pictures, const char *code, Verdict *verdict)
{
    bool model, normal;
    const Form *const of_model = find_form(pictures, MODEL, &model);
    const Form *const of_normal = find_form(pictures, NORMAL, &normal);
    const bool told = model || of_model || name_facts(pictures, code, verdict);
    if (of_model)
        blame(verdict, pictures->lab, code, 1 + MODEL, of_model);
    if (of_normal && told)
        blame(verdict, pictures->lab, code, 1 + NORMAL, of_normal);
    const bool of_scale =
        told && !normal && !of_normal && name_normal_scale(pictures, code, verdict);
    const VerdictMistake *said = verdict->mistakes;
    const char *const unknown = normal || of_normal || of_scale
                                    ? "Unknown mistake in the model matrix"
                                : told ? "Unknown mistake in the normal matrix"
                                       : "Unknown mistake in both matrices";
    snprintf(verdict->message, sizeof verdict->message, "%s%s%s%s",
             verdict->mistake_count > 1 ? "Two mistakes: " : "",
             verdict->mistake_count > 0 ? said[0].name : unknown,
             verdict->mistake_count > 1 ? "; " : "",
             verdict->mistake_count > 1 ? said[1].name : "");
}
