/*
 * The values of constant expressions, in double precision. Each node's numbers are in `values` one
 * after the other: components, columns of a matrix, fields of a structure.
 */
#include "glsl/glsl_parser.h"

#include <math.h>
#include <string.h>

/* A child's numbers; one number stands for all of a vector. */
typedef struct Operand {
    const double *values;
    int type, count;
} Operand;

static Operand operand(const GlslTree *tree, int node, int i)
{
    const int child = glsl_child(tree, node, i), type = tree->nodes[child].type;
    return (Operand){tree->values + tree->nodes[child].value, type, tree->types[type].scalars};
}

static double get(Operand from, int i)
{
    return from.values[from.count == 1 ? 0 : i];
}

/* As a type's numbers are: ints wrap around and lose their fraction. */
static double convert(double value, int scalar)
{
    if (scalar == GLSL_BOOL)
        return value != 0;
    if (scalar != GLSL_INT)
        return value;
    if (!(fabs(value) < 9e18))
        return 0;
    return (int)(unsigned)(unsigned long long)(long long)value;
}

static bool all_equal(Operand a, Operand b)
{
    for (int i = 0; i < a.count; i++)
        if (a.values[i] != b.values[i])
            return false;
    return true;
}

static double apply(int op, double a, double b)
{
    /* clang-format off */
    switch (op) {
    case GLSL_ADD: return a + b;
    case GLSL_SUBTRACT: return a - b;
    case GLSL_MULTIPLY: return a * b;
    case GLSL_DIVIDE: return a / b;
    case GLSL_LESS: return a < b;
    case GLSL_GREATER: return a > b;
    case GLSL_LESS_EQUAL: return a <= b;
    case GLSL_GREATER_EQUAL: return a >= b;
    case GLSL_AND: return a != 0 && b != 0;
    case GLSL_OR: return a != 0 || b != 0;
    default: return (a != 0) != (b != 0);
    }
    /* clang-format on */
}

/* Of matrices in columns; a vector is a row on the left and a column on the right. */
static void multiply(Operand a, Operand b, double *result)
{
    const int inner = glsl_size(glsl_is_matrix(a.type) ? a.type : b.type);
    const int rows = glsl_is_matrix(a.type) ? inner : 1,
              columns = glsl_is_matrix(b.type) ? inner : 1;
    for (int column = 0; column < columns; column++)
        for (int row = 0; row < rows; row++) {
            double sum = 0;
            for (int k = 0; k < inner; k++)
                sum += a.values[k * rows + row] * b.values[column * inner + k];
            result[column * rows + row] = sum;
        }
}

static void fold_binary(const GlslTree *tree, int node, double *result)
{
    const GlslNode *at = &tree->nodes[node];
    const Operand a = operand(tree, node, 0), b = operand(tree, node, 1);
    const bool product = at->op == GLSL_MULTIPLY && a.count > 1 && b.count > 1 &&
                         (glsl_is_matrix(a.type) || glsl_is_matrix(b.type));
    if (at->op == GLSL_EQUAL || at->op == GLSL_NOT_EQUAL)
        result[0] = all_equal(a, b) == (at->op == GLSL_EQUAL);
    else if (product)
        multiply(a, b, result);
    else
        for (int i = 0; i < tree->types[at->type].scalars; i++)
            result[i] = convert(apply(at->op, get(a, i), get(b, i)), glsl_scalar(at->type));
}

static void fold_unary(const GlslTree *tree, int node, double *result)
{
    const GlslNode *at = &tree->nodes[node];
    const Operand a = operand(tree, node, 0);
    for (int i = 0; i < a.count; i++)
        result[i] = at->op == GLSL_MINUS ? convert(-a.values[i], glsl_scalar(a.type))
                    : at->op == GLSL_NOT ? a.values[i] == 0
                                         : a.values[i];
}

/* The common columns and rows; the rest is as in the identity. */
static void fold_matrix(Operand from, int size, double *result)
{
    const int given = glsl_size(from.type);
    for (int i = 0; i < size * size; i++) {
        const int column = i / size, row = i % size;
        result[i] =
            column < given && row < given ? from.values[column * given + row] : column == row;
    }
}

/* A matrix of one number has it in its diagonal. */
static void fold_construct(const GlslTree *tree, int node, double *result)
{
    const GlslNode *at = &tree->nodes[node];
    const int wanted = tree->types[at->type].scalars, scalar = glsl_scalar(at->type);
    const Operand only = operand(tree, node, 0);
    int count = 0;
    for (int i = at->first; i; i = tree->nodes[i].next) {
        const GlslNode *part = &tree->nodes[i];
        for (int k = 0; k < tree->types[part->type].scalars && count < wanted; k++)
            result[count++] = convert(tree->values[part->value + k], scalar);
    }
    if (glsl_is_matrix(at->type) && glsl_is_matrix(only.type))
        fold_matrix(only, glsl_size(at->type), result);
    if (tree->types[at->type].fields || only.count > 1 || tree->nodes[at->first].next)
        return;
    for (int i = 0; i < wanted; i++)
        result[i] = glsl_is_matrix(at->type) && i % (glsl_size(at->type) + 1)
                        ? 0
                        : convert(only.values[0], scalar);
}

static double dot(Operand a, Operand b)
{
    double sum = 0;
    for (int i = 0; i < a.count; i++)
        sum += a.values[i] * b.values[i];
    return sum;
}

static double function_1(int id, double x)
{
    static const double DEGREE = 0.017453292519943295769;
    /* clang-format off */
    switch (id) {
    case GLSL_RADIANS: return x * DEGREE;
    case GLSL_DEGREES: return x / DEGREE;
    case GLSL_SIN: return sin(x);
    case GLSL_COS: return cos(x);
    case GLSL_TAN: return tan(x);
    case GLSL_ASIN: return asin(x);
    case GLSL_ACOS: return acos(x);
    case GLSL_ATAN: return atan(x);
    case GLSL_EXP: return exp(x);
    case GLSL_LOG: return log(x);
    case GLSL_EXP2: return exp2(x);
    case GLSL_LOG2: return log2(x);
    case GLSL_SQRT: return sqrt(x);
    case GLSL_INVERSESQRT: return 1 / sqrt(x);
    case GLSL_ABS: return fabs(x);
    case GLSL_SIGN: return (x > 0) - (x < 0);
    case GLSL_FLOOR: return floor(x);
    case GLSL_CEIL: return ceil(x);
    case GLSL_FRACT: return x - floor(x);
    default: /* GLSL_NOT_EACH */ return x == 0;
    }
    /* clang-format on */
}

static double function_3(int id, double x, double y, double z)
{
    /* clang-format off */
    switch (id) {
    case GLSL_ATAN: return atan2(x, y);
    case GLSL_POW: return pow(x, y);
    case GLSL_MOD: return x - y * floor(x / y);
    case GLSL_MIN: return y < x ? y : x;
    case GLSL_MAX: return x < y ? y : x;
    case GLSL_CLAMP: return x < y ? y : z < x ? z : x;
    case GLSL_MIX: return x * (1 - z) + y * z;
    case GLSL_STEP: return y < x ? 0 : 1;
    case GLSL_SMOOTHSTEP: {
        const double t = fmin(fmax((z - x) / (y - x), 0), 1);
        return t * t * (3 - 2 * t);
    }
    /* clang-format on */
    case GLSL_LESS_THAN:
        return x < y;
    case GLSL_LESS_THAN_EQUAL:
        return x <= y;
    case GLSL_GREATER_THAN:
        return x > y;
    case GLSL_GREATER_THAN_EQUAL:
        return x >= y;
    case GLSL_EQUAL_TO:
        return x == y;
    case GLSL_NOT_EQUAL_TO:
        return x != y;
    default: /* GLSL_MATRIX_COMP_MULT */
        return x * y;
    }
}

/* Of whole vectors to a number; false: it is no such function. */
static bool fold_to_number(int id, Operand a, Operand b, double *result)
{
    double sum = 0, count = 0;
    for (int i = 0; i < a.count; i++) {
        const double difference = id == GLSL_DISTANCE ? a.values[i] - b.values[i] : a.values[i];
        sum += difference * difference;
        count += a.values[i] != 0;
    }
    switch (id) {
    case GLSL_LENGTH:
    case GLSL_DISTANCE:
        *result = sqrt(sum);
        return true;
    case GLSL_DOT:
        *result = dot(a, b);
        return true;
    case GLSL_ANY:
        *result = count > 0;
        return true;
    case GLSL_ALL:
        *result = count == a.count;
        return true;
    default:
        return false;
    }
}

static void refract(Operand incident, Operand normal, double eta, double *result)
{
    const double cosine = dot(normal, incident), k = 1 - eta * eta * (1 - cosine * cosine);
    for (int i = 0; i < incident.count; i++)
        result[i] =
            k < 0 ? 0 : eta * incident.values[i] - (eta * cosine + sqrt(k)) * normal.values[i];
}

/* Of whole vectors to a vector. */
static bool fold_to_vector(int id, const Operand *a, double *result)
{
    const double factor = id == GLSL_NORMALIZE     ? 1 / sqrt(dot(a[0], a[0]))
                          : id == GLSL_FACEFORWARD ? (dot(a[2], a[1]) < 0 ? 1 : -1)
                                                   : 0;
    if (id == GLSL_REFRACT)
        refract(a[0], a[1], a[2].values[0], result);
    else if (id == GLSL_NORMALIZE || id == GLSL_FACEFORWARD)
        for (int i = 0; i < a[0].count; i++)
            result[i] = a[0].values[i] * factor;
    else if (id == GLSL_REFLECT)
        for (int i = 0; i < a[0].count; i++)
            result[i] = a[0].values[i] - 2 * dot(a[1], a[0]) * a[1].values[i];
    else if (id == GLSL_CROSS)
        for (int i = 0; i < 3; i++)
            result[i] = a[0].values[(i + 1) % 3] * a[1].values[(i + 2) % 3] -
                        a[0].values[(i + 2) % 3] * a[1].values[(i + 1) % 3];
    else
        return false;
    return true;
}

static void fold_built_in(const GlslTree *tree, int node, double *result)
{
    const GlslNode *at = &tree->nodes[node];
    const GlslFunction *function = &GLSL_FUNCTIONS[at->symbol];
    const int count = (int)strlen(function->types) - 1;
    Operand a[3];
    for (int i = 0; i < 3; i++)
        a[i] = operand(tree, node, i < count ? i : 0);
    if (fold_to_number(function->id, a[0], a[1], result) || fold_to_vector(function->id, a, result))
        return;
    for (int i = 0; i < tree->types[at->type].scalars; i++)
        result[i] = count == 1 ? function_1(function->id, get(a[0], i))
                               : function_3(function->id, get(a[0], i), get(a[1], i), get(a[2], i));
}

/* Parts of a value. */
static void fold_part(const GlslTree *tree, int node, double *result)
{
    const GlslNode *at = &tree->nodes[node];
    const Operand base = operand(tree, node, 0);
    const int count = tree->types[at->type].scalars;
    int offset = 0;
    if (at->kind == GLSL_INDEX)
        offset = (int)operand(tree, node, 1).values[0] * count;
    else if (at->kind == GLSL_FIELD)
        for (int i = 0; i < at->symbol; i++)
            offset += tree->types[tree->fields[tree->types[base.type].field + i].type].scalars;
    for (int i = 0; i < count; i++)
        result[i] = base.values[at->kind == GLSL_SWIZZLE ? glsl_swizzle(at->op, i) : offset + i];
}

void fold(GlslTree *tree, int node)
{
    const int count = tree->types[tree->nodes[node].type].scalars;
    const int value = values_new(tree, count);
    double *result = tree->values + value;
    switch (tree->nodes[node].kind) {
    case GLSL_UNARY:
        fold_unary(tree, node, result);
        break;
    case GLSL_BINARY:
        if (tree->nodes[node].op != GLSL_COMMA)
            fold_binary(tree, node, result);
        break;
    case GLSL_CONDITIONAL: {
        const Operand chosen = operand(tree, node, operand(tree, node, 0).values[0] != 0 ? 1 : 2);
        memcpy(result, chosen.values, (size_t)count * sizeof *result);
        break;
    }
    case GLSL_INDEX:
    case GLSL_FIELD:
    case GLSL_SWIZZLE:
        fold_part(tree, node, result);
        break;
    case GLSL_CONSTRUCT:
        fold_construct(tree, node, result);
        break;
    case GLSL_BUILT_IN:
        fold_built_in(tree, node, result);
        break;
    default:
        break;
    }
    tree->nodes[node].value = value;
}
