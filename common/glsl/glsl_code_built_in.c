/*
 * Compiling built-in functions, in the forms and the order of operations that Mesa's compiler has:
 * normalize(v) is v * inversesqrt(dot(v, v)), mix(x, y, a) is x + a * (y - x), and so on.
 */
#include "glsl/glsl_code.h"

static int op(Compiler *compiler, int what, int a, int b)
{
    return compute(compiler, what, a, b);
}

/* From the last product on; the last sum has their number (see fused_dot in glsl_execute.c). */
static int dot(Compiler *compiler, Value a, Value b)
{
    int sum = -1;
    for (int i = a.count - 1; i >= 0; i--) {
        const int product =
            op(compiler, OP_MULTIPLY, register_of(compiler, a, i), register_of(compiler, b, i));
        sum = i < a.count - 1 ? op(compiler, OP_ADD, sum, product) : product;
    }
    if (a.count > 1 && !compiler->code->message.text[0])
        compiler->code->instructions[compiler->code->instruction_count - 1].n = a.count;
    return sum;
}

/* Of each number: up to three arguments, of which scalars serve all. */
static int each_1(Compiler *compiler, int id, int x)
{
    /* clang-format off */
    switch (id) {
    case GLSL_RADIANS: return op(compiler, OP_MULTIPLY, x, number(compiler, 0.017453292519943295));
    case GLSL_DEGREES: return op(compiler, OP_MULTIPLY, x, number(compiler, 57.29577951308232));
    case GLSL_SIN: return op(compiler, OP_SIN, x, 0);
    case GLSL_COS: return op(compiler, OP_COS, x, 0);
    case GLSL_TAN:
        return op(compiler, OP_DIVIDE, op(compiler, OP_SIN, x, 0), op(compiler, OP_COS, x, 0));
    case GLSL_ASIN: return op(compiler, OP_ASIN, x, 0);
    case GLSL_ACOS: return op(compiler, OP_ACOS, x, 0);
    case GLSL_ATAN: return op(compiler, OP_ATAN, x, 0);
    case GLSL_EXP:
        return op(compiler, OP_EXP2, op(compiler, OP_MULTIPLY, x, number(compiler, 1.4426950408889634)),
                  0);
    case GLSL_LOG:
        return op(compiler, OP_MULTIPLY, op(compiler, OP_LOG2, x, 0),
                  number(compiler, 0.6931471805599453));
    case GLSL_EXP2: return op(compiler, OP_EXP2, x, 0);
    case GLSL_LOG2: return op(compiler, OP_LOG2, x, 0);
    case GLSL_SQRT: return op(compiler, OP_SQRT, x, 0);
    case GLSL_INVERSESQRT: return op(compiler, OP_INVERSE_SQRT, x, 0);
    case GLSL_ABS: return op(compiler, OP_ABS, x, 0);
    case GLSL_SIGN: return op(compiler, OP_SIGN, x, 0);
    case GLSL_FLOOR: return op(compiler, OP_FLOOR, x, 0);
    case GLSL_CEIL: return op(compiler, OP_CEIL, x, 0);
    case GLSL_FRACT: return op(compiler, OP_SUBTRACT, x, op(compiler, OP_FLOOR, x, 0));
    default: return op(compiler, OP_NOT, x, 0);
    }
    /* clang-format on */
}

static int smoothstep(Compiler *compiler, int low, int high, int x)
{
    emit(compiler, OP_EDGES, 0, low, high);
    int t = op(compiler, OP_DIVIDE, op(compiler, OP_SUBTRACT, x, low),
               op(compiler, OP_SUBTRACT, high, low));
    t = op(compiler, OP_MIN, op(compiler, OP_MAX, t, number(compiler, 0)), number(compiler, 1));
    const int slope = op(compiler, OP_SUBTRACT, number(compiler, 3),
                         op(compiler, OP_MULTIPLY, number(compiler, 2), t));
    return op(compiler, OP_MULTIPLY, t, op(compiler, OP_MULTIPLY, t, slope));
}

static int each_3(Compiler *compiler, int id, int x, int y, int z)
{
    /* clang-format off */
    switch (id) {
    case GLSL_ATAN: return op(compiler, OP_ATAN2, x, y);
    case GLSL_POW: return op(compiler, OP_POW, x, y);
    case GLSL_MOD:
        return op(compiler, OP_SUBTRACT, x,
                  op(compiler, OP_MULTIPLY, y,
                     op(compiler, OP_FLOOR, op(compiler, OP_DIVIDE, x, y), 0)));
    case GLSL_MIN: return op(compiler, OP_MIN, x, y);
    case GLSL_MAX: return op(compiler, OP_MAX, x, y);
    case GLSL_CLAMP: return op(compiler, OP_MIN, op(compiler, OP_MAX, x, y), z);
    case GLSL_MIX:
        return op(compiler, OP_ADD, x, op(compiler, OP_MULTIPLY, z, op(compiler, OP_SUBTRACT, y, x)));
    case GLSL_STEP: return op(compiler, OP_LESS_EQUAL, x, y);
    case GLSL_SMOOTHSTEP: return smoothstep(compiler, x, y, z);
    case GLSL_LESS_THAN: return op(compiler, OP_LESS, x, y);
    case GLSL_LESS_THAN_EQUAL: return op(compiler, OP_LESS_EQUAL, x, y);
    case GLSL_GREATER_THAN: return op(compiler, OP_LESS, y, x);
    case GLSL_GREATER_THAN_EQUAL: return op(compiler, OP_LESS_EQUAL, y, x);
    case GLSL_EQUAL_TO: return op(compiler, OP_EQUAL, x, y);
    case GLSL_NOT_EQUAL_TO: return op(compiler, OP_NOT_EQUAL, x, y);
    default: return op(compiler, OP_MULTIPLY, x, y); /* matrixCompMult */
    }
    /* clang-format on */
}

/* a * x + b * y for each number of two vectors; b -1: y alone. */
static Value combine(Compiler *compiler, int a, Value x, int b, Value y, int what)
{
    const Value result = value_at(reserve(compiler, y.count), y.count);
    for (int i = 0; i < y.count && !compiler->code->message.text[0]; i++) {
        int left = register_of(compiler, x, i), right = register_of(compiler, y, i);
        left = a < 0 ? left : op(compiler, OP_MULTIPLY, a, left);
        right = b < 0 ? right : op(compiler, OP_MULTIPLY, b, right);
        emit(compiler, what, result.base + i, left, right);
    }
    return result;
}

static Value normalize(Compiler *compiler, Value x)
{
    const int scale = op(compiler, OP_INVERSE_SQRT, dot(compiler, x, x), 0);
    const Value result = value_at(reserve(compiler, x.count), x.count);
    for (int i = 0; i < x.count && !compiler->code->message.text[0]; i++)
        emit(compiler, OP_MULTIPLY, result.base + i, register_of(compiler, x, i), scale);
    return result;
}

static Value cross(Compiler *compiler, Value a, Value b)
{
    const Value result = value_at(reserve(compiler, 3), 3);
    for (int i = 0; i < 3 && !compiler->code->message.text[0]; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const int left =
            op(compiler, OP_MULTIPLY, register_of(compiler, a, j), register_of(compiler, b, k));
        const int right =
            op(compiler, OP_MULTIPLY, register_of(compiler, a, k), register_of(compiler, b, j));
        emit(compiler, OP_SUBTRACT, result.base + i, left, right);
    }
    return result;
}

/* d = a or b by the condition c */
static int choose(Compiler *compiler, int condition, int a, int b)
{
    const int d = reserve(compiler, 1), at = emit(compiler, OP_SELECT, d, condition, a);
    if (!compiler->code->message.text[0])
        compiler->code->instructions[at].c = b;
    return d;
}

static Value refract(Compiler *compiler, Value incident, Value normal, int eta)
{
    const int one = number(compiler, 1), zero = number(compiler, 0);
    const int cosine = dot(compiler, normal, incident);
    const int rest = op(compiler, OP_SUBTRACT, one, op(compiler, OP_MULTIPLY, cosine, cosine));
    const int k = op(compiler, OP_SUBTRACT, one,
                     op(compiler, OP_MULTIPLY, eta, op(compiler, OP_MULTIPLY, eta, rest)));
    const int none = op(compiler, OP_LESS, k, zero);
    const int root = op(compiler, OP_SQRT, op(compiler, OP_MAX, k, zero), 0);
    const int scale = op(compiler, OP_ADD, op(compiler, OP_MULTIPLY, eta, cosine), root);
    const Value ray = combine(compiler, eta, incident, scale, normal, OP_SUBTRACT);
    const Value result = value_at(reserve(compiler, ray.count), ray.count);
    for (int i = 0; i < ray.count && !compiler->code->message.text[0]; i++)
        emit(compiler, OP_SET, result.base + i, choose(compiler, none, zero, ray.base + i), 0);
    return result;
}

static Value geometry(Compiler *compiler, int id, const Value *given)
{
    const Value a = given[0], b = given[1];
    /* clang-format off */
    switch (id) {
    case GLSL_LENGTH: return value_at(op(compiler, OP_SQRT, dot(compiler, a, a), 0), 1);
    case GLSL_DISTANCE: {
        const Value way = combine(compiler, -1, a, -1, b, OP_SUBTRACT);
        return value_at(op(compiler, OP_SQRT, dot(compiler, way, way), 0), 1);
    }
    case GLSL_DOT: return value_at(dot(compiler, a, b), 1);
    case GLSL_CROSS: return cross(compiler, a, b);
    case GLSL_NORMALIZE: return normalize(compiler, a);
    case GLSL_REFRACT: return refract(compiler, a, b, register_of(compiler, given[2], 0));
    case GLSL_REFLECT: {
        const int twice = op(compiler, OP_MULTIPLY, number(compiler, 2), dot(compiler, b, a));
        return combine(compiler, -1, a, twice, b, OP_SUBTRACT);
    }
    default: break;
    }
    /* clang-format on */
    const int away = op(compiler, OP_LESS, dot(compiler, given[2], b), number(compiler, 0));
    const Value result = value_at(reserve(compiler, a.count), a.count);
    for (int i = 0; i < a.count && !compiler->code->message.text[0]; i++) {
        const int x = register_of(compiler, a, i);
        const int turned = op(compiler, OP_NEGATE, x, 0);
        emit(compiler, OP_SET, result.base + i, choose(compiler, away, x, turned), 0);
    }
    return result;
}

static Value texture(Compiler *compiler, int id, const Value *given, int count)
{
    int numbers = 0;
    const Value color = value_at(reserve(compiler, 4), 4);
    for (int i = 1; i < count; i++)
        numbers += given[i].count;
    const int first = reserve(compiler, numbers);
    for (int i = 1, to = first; i < count && !compiler->code->message.text[0]; i++)
        for (int k = 0; k < given[i].count; k++)
            emit(compiler, OP_SET, to++, register_of(compiler, given[i], k), 0);
    const int at =
        emit(compiler, OP_TEXTURE, color.base, register_of(compiler, given[0], 0), first);
    if (!compiler->code->message.text[0]) {
        compiler->code->instructions[at].c = id;
        compiler->code->instructions[at].n = numbers;
    }
    return color;
}

Value compile_built_in(Compiler *compiler, int node)
{
    const GlslTree *tree = compiler->tree;
    const int id = GLSL_FUNCTIONS[tree->nodes[node].symbol].id;
    Value given[4] = {{0}};
    int count = 0;
    for (int i = tree->nodes[node].first; i && count < 4; i = tree->nodes[i].next)
        given[count++] = compile_read(compiler, i);
    if (compiler->code->message.text[0])
        return given[0];
    if (id >= GLSL_TEXTURE_2D)
        return texture(compiler, id, given, count);
    if (id >= GLSL_DFDX && id <= GLSL_FWIDTH)
        cannot(compiler, "dFdx, dFdy and fwidth need the pixels beside this one: not run here");
    if (id >= GLSL_LENGTH && id <= GLSL_REFRACT)
        return geometry(compiler, id, given);
    if (id == GLSL_ANY || id == GLSL_ALL) {
        int sum = register_of(compiler, given[0], 0);
        for (int i = 1; i < given[0].count; i++)
            sum = op(compiler, id == GLSL_ANY ? OP_OR : OP_AND, sum,
                     register_of(compiler, given[0], i));
        return value_at(sum, 1);
    }
    const int size = scalars_of(tree, tree->nodes[node].type);
    const Value result = value_at(reserve(compiler, size), size);
    for (int i = 0; i < size && !compiler->code->message.text[0]; i++) {
        int x[3] = {0};
        for (int k = 0; k < count && k < 3; k++)
            x[k] = register_of(compiler, given[k], given[k].count > 1 ? i : 0);
        emit(compiler, OP_SET, result.base + i,
             count > 1 ? each_3(compiler, id, x[0], x[1], x[2]) : each_1(compiler, id, x[0]), 0);
    }
    return result;
}
