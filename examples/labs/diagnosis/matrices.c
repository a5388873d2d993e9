#include "labs/diagnosis/matrices.h"

#include "app/options.h"
#include "core/example.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static Mat4 right_world(double seconds)
{
    Mat4 move, turn, scale;
    probe_world_parts(seconds, &move, &turn, &scale);
    return mat4_product(move, mat4_product(turn, scale));
}

/* The directions of the normals along x, y and z are what the picture depends on. */
static bool normals_are_right(const Shots *shots, int i, char said[VERDICT_SENTENCE_SIZE])
{
    const Mat4 right = binding_normal_matrix(right_world(shots->shots[i].probe.seconds));
    /* Any positive multiple is right, the same for all of the matrix. */
    double product = 0, square = 0;
    for (int k = 0; k < 12; k++) {
        if (k % 4 == 3)
            continue;
        product += right.m[k] * shots->normal_matrix[i].m[k];
        square += right.m[k] * right.m[k];
    }
    const double factor = product / square;
    for (int k = 0; k < 12; k++) {
        const double wanted = factor * right.m[k], found = shots->normal_matrix[i].m[k];
        if (k % 4 == 3 || fabs(found - wanted) <= 2 * MATRICES_TOLERANCE * fabs(factor))
            continue;
        snprintf(said, VERDICT_SENTENCE_SIZE,
                 "The normal matrix after %g s: row %d, column %d is %.4g; a multiple of the right "
                 "one has %.4g there.",
                 shots->shots[i].probe.seconds, k % 4, k / 4, found, wanted);
        return false;
    }
    return factor > 0;
}

bool matrices_are_right(const Shots *shots, char said[VERDICT_SENTENCE_SIZE])
{
    said[0] = '\0';
    for (int i = 0; i < shots->count; i++) {
        const double seconds = shots->shots[i].probe.seconds;
        const Mat4 right = right_world(seconds);
        for (int k = 15; k >= 0; k--) {
            const double found = shots->world_from_object[i].m[k];
            if (fabs(found - right.m[k]) <= MATRICES_TOLERANCE)
                continue;
            snprintf(said, VERDICT_SENTENCE_SIZE,
                     "The model matrix after %g s: row %d, column %d is %.4g; right is %.4g.",
                     seconds, k % 4, k / 4, found, right.m[k]);
            return false;
        }
        if (!normals_are_right(shots, i, said))
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

static bool blame(Verdict *verdict, const char *name, const char *sentence, const char *look)
{
    verdict_add_mistake(verdict, name, sentence, look, 0.9);
    snprintf(verdict->message, sizeof verdict->message, "%s", name);
    return true;
}

static bool blame_numbers(Verdict *verdict, const char *name, const char *what, const double *found,
                          const char *look)
{
    char sentence[VERDICT_SENTENCE_SIZE];
    snprintf(sentence, sizeof sentence, "%s is (%.3g, %.3g, %.3g).", what, found[0], found[1],
             found[2]);
    return blame(verdict, name, sentence, look);
}

bool matrices_name(const Shots *shots, Verdict *verdict)
{
    bool turns = true, moved = true, scaled = true, turned = true, same_move = true;
    bool same_axis = true, about_axis = true, same_turn = true, linear = true;
    bool as_far = true, never_set = true, columns = true;
    double factors[3] = {1, 1, 1}, now[3];
    Parts first = {.turns = false};
    double axis[3], rate = 0;
    Vec3 unit;
    vec3_normalize(PROBE_AXIS, &unit);
    axis[0] = unit.x, axis[1] = unit.y, axis[2] = unit.z;
    for (int i = 0; i < shots->count; i++) {
        const double seconds = shots->shots[i].probe.seconds;
        const Mat4 wanted = right_world(seconds);
        const Parts found = take_apart(&shots->world_from_object[i]), right = take_apart(&wanted);
        if (i == 0)
            first = found;
        columns = columns && column_factors(&shots->world_from_object[i], &wanted, now) &&
                  (i == 0 || is_near(now, factors));
        memcpy(factors, now, sizeof factors);
        never_set &= is_identity(&shots->world_from_object[i]);
        turns &= found.turns;
        moved &= is_near(found.move, right.move);
        scaled &= is_near(found.scale, right.scale);
        as_far &= fabs(found.degrees - right.degrees) < 0.06;
        same_move &= is_near(found.move, first.move);
        same_turn &= fabs(found.degrees - first.degrees) < 0.06;
        /* Near 0 and 180 degrees the axis cannot be told. */
        if (found.degrees < 3 || found.degrees > 177)
            continue;
        const double sign = found.axis[0] * first.axis[0] + found.axis[1] * first.axis[1] +
                                        found.axis[2] * first.axis[2] <
                                    0
                                ? -1
                                : 1;
        const double flipped[3] = {sign * found.axis[0], sign * found.axis[1],
                                   sign * found.axis[2]};
        same_axis &= is_near(flipped, first.axis);
        const double own =
            found.axis[0] * axis[0] + found.axis[1] * axis[1] + found.axis[2] * axis[2];
        about_axis &= fabs(fabs(own) - 1) < 1e-5;
        const double whole = own < 0 ? 360 - found.degrees : found.degrees;
        if (i == 0)
            rate = whole / seconds;
        const double apart = remainder(rate * seconds - whole, 360);
        turned &= fabs(remainder(whole - DEGREES_PER_SECOND * seconds, 360)) < 0.06;
        linear &= fabs(apart) < 0.1 + 0.002 * seconds;
    }
    const bool good_turn = turned && about_axis;
    if (never_set)
        return blame(verdict, "model matrix never set", "The model matrix is still the identity.",
                     "the assignment to *world_from_model");
    if (columns && moved && !scaled) {
        const double found[3] = {2 * factors[0], 0.7 * factors[1], 1.2 * factors[2]};
        return blame_numbers(verdict, "wrong scale", "The scale", found,
                             "the numbers of the scale: (2, 0.7, 1.2); in C 7 / 10 is 0");
    }
    if (!turns)
        return false;
    if (good_turn && scaled && !moved && same_move)
        return blame_numbers(verdict, "wrong translation", "The translation", first.move,
                             "the numbers of the translation: (0.5, 0.3, -0.8)");
    if (moved && scaled && as_far && !about_axis && same_axis)
        return blame_numbers(verdict, "wrong axis", "The axis, normalized,", first.axis,
                             "the numbers of the axis: (1, 2, 0.5)");
    if (moved && scaled && about_axis && !turned && same_turn)
        return blame(verdict, "a constant angle",
                     "The cube is turned, but always by the same angle.",
                     "the angle: 30 degrees times seconds");
    if (moved && scaled && about_axis && !turned && linear) {
        char sentence[VERDICT_SENTENCE_SIZE];
        snprintf(sentence, sizeof sentence, "The cube turns by %.4g degrees per second.", rate);
        return blame(verdict, "wrong angle", sentence, "the angle: 30 degrees times seconds");
    }
    if (moved && scaled && about_axis && !turned)
        return blame(verdict, "wrong angle", "The cube is turned by a wrong angle.",
                     "the angle: 30 degrees times seconds");
    return false;
}
