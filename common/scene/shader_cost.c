/* glslangValidator compiles to SPIR-V, a list of instructions for values that are assigned once;
 * spirv-opt inlines, unrolls and removes until no instruction is there for nothing. Then the cost
 * of a shader is a sum over its instructions: each has a rule, by the number of components of what
 * it makes and of what it takes. The module is read as words, of which only types, constants and
 * the one function matter. */
#include "scene/shader_cost.h"

#include "base/cache.h"
#include "base/memory.h"
#include "base/process.h"
#include "base/text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The cost of an instruction whose result has n components, and whose largest operand has m:
 * arithmetic n * each + m * operand + once, special n * special_each + special. */
typedef struct Rule {
    const char *name;
    int number, each, operand, once, special_each, special;
    bool uncounted;
} Rule;

/* Added to the number of a function of GLSL, an operand of OpExtInst. */
enum { GLSL = 1000 };

/* What GLSL ES 1.00 can become. (SPIR-V specification, section 3.42; SPIR-V extended instructions
 * for GLSL, section 2) */
static const Rule RULES[] = {
    {.name = "OpFNegate", .number = 127, .each = 1},
    {.name = "OpFAdd", .number = 129, .each = 1},
    {.name = "OpFSub", .number = 131, .each = 1},
    {.name = "OpFMul", .number = 133, .each = 1},
    {.name = "OpFDiv", .number = 136, .special_each = 1},
    {.name = "OpFMod", .number = 141, .special_each = 1},
    {.name = "OpSNegate", .number = 126, .each = 1},
    {.name = "OpIAdd", .number = 128, .each = 1},
    {.name = "OpISub", .number = 130, .each = 1},
    {.name = "OpIMul", .number = 132, .each = 1},
    {.name = "OpSDiv", .number = 135, .special_each = 1},
    {.name = "OpVectorTimesScalar", .number = 142, .each = 1},
    {.name = "OpMatrixTimesScalar", .number = 143, .each = 1},
    {.name = "OpMatrixTimesVector", .number = 145, .each = -1, .operand = 2},
    {.name = "OpVectorTimesMatrix", .number = 144, .each = -1, .operand = 2},
    {.name = "OpDot", .number = 148, .operand = 2, .once = -1},
    {.name = "OpConvertFToS", .number = 110, .each = 1},
    {.name = "OpConvertSToF", .number = 111, .each = 1},
    {.name = "OpSelect", .number = 169, .each = 1},
    {.name = "OpAny", .number = 154, .operand = 1, .once = -1},
    {.name = "OpAll", .number = 155, .operand = 1, .once = -1},
    {.name = "OpLogicalNot", .number = 168, .each = 1},
    {.name = "OpLogicalAnd", .number = 167, .each = 1},
    {.name = "OpLogicalOr", .number = 166, .each = 1},
    {.name = "OpLogicalEqual", .number = 164, .each = 1},
    {.name = "OpLogicalNotEqual", .number = 165, .each = 1},
    {.name = "OpIEqual", .number = 170, .each = 1},
    {.name = "OpINotEqual", .number = 171, .each = 1},
    {.name = "OpSLessThan", .number = 177, .each = 1},
    {.name = "OpSLessThanEqual", .number = 179, .each = 1},
    {.name = "OpSGreaterThan", .number = 173, .each = 1},
    {.name = "OpSGreaterThanEqual", .number = 175, .each = 1},
    {.name = "OpFOrdEqual", .number = 180, .each = 1},
    {.name = "OpFOrdNotEqual", .number = 182, .each = 1},
    {.name = "OpFUnordNotEqual", .number = 183, .each = 1},
    {.name = "OpFOrdLessThan", .number = 184, .each = 1},
    {.name = "OpFOrdLessThanEqual", .number = 188, .each = 1},
    {.name = "OpFOrdGreaterThan", .number = 186, .each = 1},
    {.name = "OpFOrdGreaterThanEqual", .number = 190, .each = 1},
    {.name = "FAbs", .number = GLSL + 4, .each = 1},
    {.name = "FSign", .number = GLSL + 6, .each = 1},
    {.name = "Floor", .number = GLSL + 8, .each = 1},
    {.name = "Ceil", .number = GLSL + 9, .each = 1},
    {.name = "Fract", .number = GLSL + 10, .each = 2},
    {.name = "FMin", .number = GLSL + 37, .each = 1},
    {.name = "FMax", .number = GLSL + 40, .each = 1},
    {.name = "FClamp", .number = GLSL + 43, .each = 2},
    {.name = "FMix", .number = GLSL + 46, .each = 3},
    {.name = "Fma", .number = GLSL + 50, .each = 2},
    {.name = "Step", .number = GLSL + 48, .each = 1},
    {.name = "SmoothStep", .number = GLSL + 49, .each = 8, .special_each = 1},
    {.name = "Cross", .number = GLSL + 68, .each = 3},
    {.name = "Length", .number = GLSL + 66, .operand = 2, .once = -1, .special = 1},
    {.name = "Distance", .number = GLSL + 67, .operand = 3, .once = -1, .special = 1},
    {.name = "Normalize", .number = GLSL + 69, .each = 1, .operand = 2, .once = -1, .special = 1},
    {.name = "Reflect", .number = GLSL + 71, .each = 2, .operand = 2},
    {.name = "FaceForward", .number = GLSL + 70, .each = 1, .operand = 2},
    {.name = "Sqrt", .number = GLSL + 31, .special_each = 1},
    {.name = "InverseSqrt", .number = GLSL + 32, .special_each = 1},
    {.name = "Pow", .number = GLSL + 26, .special_each = 1},
    {.name = "Exp", .number = GLSL + 27, .special_each = 1},
    {.name = "Exp2", .number = GLSL + 29, .special_each = 1},
    {.name = "Log", .number = GLSL + 28, .special_each = 1},
    {.name = "Log2", .number = GLSL + 30, .special_each = 1},
    {.name = "Sin", .number = GLSL + 13, .special_each = 1},
    {.name = "Cos", .number = GLSL + 14, .special_each = 1},
    {.name = "Tan", .number = GLSL + 15, .special_each = 1},
    {.name = "Asin", .number = GLSL + 16, .special_each = 1},
    {.name = "Acos", .number = GLSL + 17, .special_each = 1},
    {.name = "Atan", .number = GLSL + 18, .special_each = 1},
    {.name = "Atan2", .number = GLSL + 25, .special_each = 1},
    {.name = "OpImageSampleImplicitLod", .number = 87, .special = 1},
    /* Moves and bookkeeping. */
    {.name = "OpLoad", .number = 61},
    {.name = "OpStore", .number = 62},
    {.name = "OpAccessChain", .number = 65},
    {.name = "OpCompositeConstruct", .number = 80},
    {.name = "OpCompositeExtract", .number = 81},
    {.name = "OpCompositeInsert", .number = 82},
    {.name = "OpVectorExtractDynamic", .number = 77},
    {.name = "OpVectorInsertDynamic", .number = 78},
    {.name = "OpVectorShuffle", .number = 79},
    {.name = "OpCopyObject", .number = 83},
    {.name = "OpUndef", .number = 1},
    {.name = "OpVariable", .number = 59},
    {.name = "OpPhi", .number = 245},
    {.name = "OpFunction", .number = 54},
    {.name = "OpFunctionEnd", .number = 56},
    {.name = "OpLabel", .number = 248},
    {.name = "OpSelectionMerge", .number = 247},
    {.name = "OpBranch", .number = 249},
    {.name = "OpBranchConditional", .number = 250}, /* counted apart */
    {.name = "OpSwitch",
     .number = 251}, /* spirv-opt's way of leaving a block; the language has none */
    {.name = "OpReturn", .number = 253},
    {.name = "OpKill", .number = 252},
    {.name = "OpUnreachable", .number = 255},
    /* Not counted, but known by name. */
    {.name = "OpMatrixTimesMatrix", .number = 146, .uncounted = true},
    {.name = "OpImageSampleProjImplicitLod", .number = 91, .uncounted = true},
    {.name = "Radians", .number = GLSL + 11, .uncounted = true},
    {.name = "Degrees", .number = GLSL + 12, .uncounted = true},
    {.name = "Refract", .number = GLSL + 72, .uncounted = true},
};

static const Rule *find_rule(int number)
{
    for (size_t i = 0; i < sizeof RULES / sizeof RULES[0]; i++)
        if (RULES[i].number == number)
            return &RULES[i];
    return NULL;
}

/* Of instructions, by the specification's section 3.42. */
enum {
    OP_UNDEF = 1,
    OP_EXT_INST = 12,
    OP_TYPE_BOOL = 20,
    OP_TYPE_INT,
    OP_TYPE_FLOAT,
    OP_TYPE_VECTOR,
    OP_TYPE_MATRIX,
    OP_FIRST_CONSTANT = 41,
    OP_CONSTANT = 43,
    OP_FUNCTION = 54,
    OP_FUNCTION_END = 56,
    OP_STORE = 62,
    OP_DECORATE = 71,
    OP_LAST_DECORATE = 76,
    OP_VECTOR_TIMES_SCALAR = 142,
    OP_LOOP_MERGE = 246,
    OP_BRANCH_CONDITIONAL = 250,
};

/* Whether an instruction begins with the ids of its type and its result. */
static bool is_typed(int op)
{
    return op == OP_UNDEF || op == OP_EXT_INST ||
           (op >= OP_FIRST_CONSTANT && op < OP_LOOP_MERGE && op != OP_FUNCTION_END &&
            op != OP_STORE && (op < OP_DECORATE || op > OP_LAST_DECORATE));
}

/* What is known of a module so far. */
typedef struct Module {
    unsigned bound;            /* ids of types and values are less */
    unsigned char *components; /* of each; 0 if not a number */
    unsigned real, one;        /* the type float, and its constant 1.0 */
    bool function;             /* the shader's only one has begun */
} Module;

/* The components of an instruction's result, which it notes; 0: it has none. */
static int note_result(Module *module, int op, const uint32_t *operands, int count)
{
    static const uint32_t ONE = 0x3F800000;
    const uint32_t first = count > 0 && operands[0] < module->bound ? operands[0] : 0;
    const uint32_t second = count > 1 && operands[1] < module->bound ? operands[1] : 0;
    unsigned char *components = module->components;
    if (op == OP_TYPE_FLOAT || op == OP_TYPE_INT || op == OP_TYPE_BOOL)
        components[first] = 1;
    else if ((op == OP_TYPE_VECTOR || op == OP_TYPE_MATRIX) && count > 2)
        components[first] = (unsigned char)(components[second] * operands[2]);
    if (op == OP_TYPE_FLOAT)
        module->real = first;
    if (!is_typed(op))
        return 0;
    components[second] = components[first];
    if (op == OP_CONSTANT && first == module->real && count > 2 && operands[2] == ONE)
        module->one = second;
    return components[second];
}

/* Adds what one instruction costs. */
static bool count_instruction(Module *module, int op, const uint32_t *operands, int count,
                              ShaderCost *cost, Message *message)
{
    const int each = note_result(module, op, operands, count);
    const uint32_t last = count > 0 ? operands[count - 1] : 0;
    const bool function = op == OP_EXT_INST && count > 3;
    int max = 0;
    module->function |= op == OP_FUNCTION;
    /* spirv-opt leaves it, no driver does. */
    if (!module->function || (op == OP_VECTOR_TIMES_SCALAR && last == module->one))
        return true;
    if (op == OP_LOOP_MERGE)
        return message_set(message, "operations: cannot unroll a loop");
    for (int i = function ? 4 : 2; i < count; i++)
        if (operands[i] < module->bound && module->components[operands[i]] > max)
            max = module->components[operands[i]];
    const int number = function ? GLSL + (int)operands[3] : op;
    const Rule *rule = find_rule(number);
    if (!rule)
        return message_set(message, "operations: cannot count SPIR-V's %s %d",
                           function ? "function" : "instruction", number % GLSL);
    if (rule->uncounted)
        return message_set(message, "operations: cannot count %s", rule->name);
    cost->arithmetic += each * rule->each + max * rule->operand + rule->once;
    cost->special += each * rule->special_each + rule->special;
    cost->branches += op == OP_BRANCH_CONDITIONAL;
    return true;
}

/* A module is a header of five words, the fourth of which is the bound of all ids, and
 * instructions: a word of their length in words and their number, and the operands. (section 2.3)
 */
static bool count_module(FILE *file, ShaderCost *cost, Message *message)
{
    enum { LONGEST = 65535 };
    static const uint32_t MAGIC = 0x07230203, IDS = 1 << 22;
    uint32_t header[5], word;
    Module module = {.bound = 0};
    bool done = fread(header, sizeof header, 1, file) == 1 && header[0] == MAGIC && header[3] < IDS;
    if (done) {
        module.bound = header[3];
        module.components = memory_new(module.bound + 1, 1);
    }
    uint32_t *operands = memory_new(LONGEST, sizeof *operands);
    while (done && fread(&word, sizeof word, 1, file) == 1) {
        const size_t count = word >> 16 ? (word >> 16) - 1 : 0;
        done =
            fread(operands, sizeof *operands, count, file) == count &&
            count_instruction(&module, (int)(word & 0xFFFF), operands, (int)count, cost, message);
    }
    free(operands);
    free(module.components);
    return done && !module.function ? message_set(message, "operations: spirv-opt says nothing")
                                    : done;
}

/* What a tool that failed said first. glslangValidator reports errors on standard output, since 14
 * on standard error. */
static void first_words(FILE *output, FILE *errors, char said[static 200])
{
    rewind(errors);
    if (fscanf(errors, " %199[^\n]", said) != 1)
        (void)!fscanf(output, " %199[^\n]", said);
}

/* Runs a tool from `input`, which is closed, to the file that is returned; NULL on failure. */
static FILE *run_tool(const char *const *arguments, const char *package, FILE *input,
                      Message *message)
{
    FILE *output = input ? tmpfile() : NULL;
    FILE *errors = output ? tmpfile() : NULL;
    pid_t child;
    int status = 0, error = ENOMEM;
    if (errors) {
        rewind(input); /* and writes what is buffered */
        const int files[] = {fileno(input), fileno(output), fileno(errors), -1};
        error = process_start(&child, arguments, files);
    }
    if (!error)
        status = process_wait(child);
    if (input)
        fclose(input);
    if (output)
        rewind(output);
    char said[200] = "failed";
    if (error == ENOENT)
        snprintf(said, sizeof said, "not found; install the package %s", package);
    else if (error)
        snprintf(said, sizeof said, "%s", strerror(error));
    else if (status != 0)
        first_words(output, errors, said);
    if (errors)
        fclose(errors);
    if (!error && status == 0)
        return output;
    message_set(message, "operations: %s: %s", arguments[0], said);
    if (output)
        fclose(output);
    return NULL;
}

/* The text as GLSL ES 1.00 whose directives are carried out, so that nothing depends any more on
 * what a compiler defines; NULL on failure. */
static FILE *preprocess(const char *text, ShaderStage stage, Message *message)
{
    const char *const arguments[] = {
        "glslangValidator", "-E", "--stdin", "-S", stage == SHADER_VERTEX ? "vert" : "frag", NULL};
    FILE *file = tmpfile();
    if (!file) {
        message_set(message, "operations: no temporary file: %s", strerror(errno));
        return NULL;
    }
    fprintf(file, "%s%s\n", strncmp(text, "#version", 8) == 0 ? "" : "#version 100\n", text);
    return run_tool(arguments, "glslang-tools", file, message);
}

/* All of a file, which is closed. */
static char *read_text(FILE *file)
{
    char *text = NULL;
    size_t size = 0;
    if (file && getdelim(&text, &size, '\0', file) < 0) {
        free(text);
        text = NULL;
    }
    if (file)
        fclose(file);
    return text;
}

char *shader_preprocess(const char *text, ShaderStage stage, Message *message)
{
    FILE *file = preprocess(text, stage, message);
    char *done = read_text(file);
    if (file && !done)
        message_set(message, "operations: the preprocessor says nothing");
    return done;
}

/* Names that a shader of GLSL ES 1.00 may define, but that 3.10 keeps for itself. */
static const char LATER[] =
    "transpose inverse determinant outerProduct round roundEven trunc modf isnan isinf "
    "sinh cosh tanh asinh acosh atanh fma frexp ldexp bitCount texture textureSize "
    "textureLod textureGrad textureProj textureOffset texelFetch textureGather dFdx dFdy "
    "fwidth barrier memoryBarrier findLSB findMSB layout centroid smooth patch sample "
    "uint uvec2 uvec3 uvec4 mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 "
    "mat4x4 shared coherent restrict readonly writeonly buffer precise subroutine "
    "resource common partition active filter image1D image2D image3D imageCube "
    "isampler2D usampler2D sampler2DArray samplerCubeShadow atomic_uint uimage2D "
    "iimage2D imageBuffer samplerBuffer noise1 noise2 noise3 noise4 ";

static bool has_word(const char *text, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        if ((at == text || !text_is_word(at[-1])) && !text_is_word(at[length]))
            return true;
    return false;
}

/* The preprocessed shader as GLSL ES 3.10, the oldest that becomes SPIR-V; NULL on failure. */
static FILE *translate(const char *text, ShaderStage stage)
{
    FILE *file = tmpfile();
    if (!file)
        return NULL;
    if (strncmp(text, "#version", 8) == 0)
        text += strcspn(text, "\n");
    fputs("#version 310 es\n"
          "#extension GL_EXT_control_flow_attributes : enable\n"
          "#define for [[unroll]] for\n",
          file);
    if (stage == SHADER_FRAGMENT && strstr(text, "gl_FragData"))
        fputs("#define gl_FragData operations_FragData\n"
              "layout(location = 0) out highp vec4 operations_FragData[1];\n",
              file);
    for (const char *at = LATER; *at; at += strcspn(at, " ") + 1) {
        char word[32];
        snprintf(word, sizeof word, "%.*s", (int)strcspn(at, " "), at);
        if (has_word(text, word))
            fprintf(file, "#define %s operations_%s\n", word, word);
    }
    if (stage == SHADER_VERTEX)
        fputs("#define attribute in\n#define varying out\n", file);
    else if (strstr(text, "gl_FragData"))
        fputs("#define varying in\n", file);
    else
        fputs("#define varying in\n#define texture2D texture\n"
              "#define gl_FragColor operations_FragColor\n"
              "out highp vec4 operations_FragColor;\n",
              file);
    fprintf(file, "%s\n", text);
    return file;
}

static bool count(const char *text, ShaderStage stage, ShaderCost *cost, Message *message)
{
    const char *const compile[] = {"glslangValidator",
                                   "-G",
                                   "--aml",
                                   "--quiet",
                                   "--stdin",
                                   "-S",
                                   stage == SHADER_VERTEX ? "vert" : "frag",
                                   "-o",
                                   "/dev/stdout",
                                   NULL};
    static const char *const optimize[] = {"spirv-opt", "-O", "-", "-o", "-", NULL};
    char *plain = shader_preprocess(text, stage, message);
    FILE *file = plain ? translate(plain, stage) : NULL;
    *cost = (ShaderCost){0};
    if (!plain)
        return false;
    free(plain);
    if (!file)
        return message_set(message, "operations: no temporary file: %s", strerror(errno));
    file = run_tool(compile, "glslang-tools", file, message);
    file = file ? run_tool(optimize, "spirv-tools", file, message) : NULL;
    const bool done = file && count_module(file, cost, message);
    if (file)
        fclose(file);
    if (!done)
        *cost = (ShaderCost){0};
    return done;
}

/* Kept between runs: a count takes four processes, and a figure of all terms 16 counts. */
typedef struct Kept {
    CacheKey check; /* of key and cost, against damage */
    ShaderCost cost;
} Kept;

static CacheKey check_of(CacheKey key, const ShaderCost *cost)
{
    cache_key_add(&key, cost, sizeof *cost);
    return key;
}

static bool find_kept(const CacheKey *key, ShaderCost *cost)
{
    size_t size = 0;
    Kept *kept = cache_read("cost", key, &size);
    bool found = kept && size == sizeof *kept;
    if (found) {
        const CacheKey check = check_of(*key, &kept->cost);
        found = memcmp(&check, &kept->check, sizeof check) == 0;
    }
    if (found)
        *cost = kept->cost;
    free(kept);
    return found;
}

bool shader_cost(const char *text, ShaderStage stage, ShaderCost *cost, Message *message)
{
    CacheKey key = {{(uint64_t)stage, 0}};
    cache_key_add(&key, text, strlen(text));
    cache_key_add_program(&key);
    const bool keeps =
        cache_key_add_tool(&key, "glslangValidator") && cache_key_add_tool(&key, "spirv-opt");
    if (keeps && find_kept(&key, cost))
        return true;
    if (!count(text, stage, cost, message))
        return false;
    if (keeps) {
        Kept kept;
        memset(&kept, 0, sizeof kept); /* padding too is written */
        kept.check = check_of(key, cost);
        kept.cost = *cost;
        cache_write("cost", &key, &kept, sizeof kept);
    }
    return true;
}
