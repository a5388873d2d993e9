#include "scene/shader_cost.h"

#include "base/cache.h"
#include "base/process.h"
#include "base/text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The cost of an instruction whose result has n components, and whose largest operand has m:
 * arithmetic n * each + m * operand + once, special n * special_each + special. */
typedef struct Rule {
    const char *name; /* as spirv-dis has it; of OpExtInst, that of the function */
    int each, operand, once, special_each, special;
} Rule;

/* What GLSL ES 1.00 can become. (SPIR-V specification, section 3.42; SPIR-V extended instructions
 * for GLSL, section 2) */
static const Rule RULES[] = {
    {.name = "OpFNegate", .each = 1},
    {.name = "OpFAdd", .each = 1},
    {.name = "OpFSub", .each = 1},
    {.name = "OpFMul", .each = 1},
    {.name = "OpFDiv", .special_each = 1},
    {.name = "OpFMod", .special_each = 1},
    {.name = "OpSNegate", .each = 1},
    {.name = "OpIAdd", .each = 1},
    {.name = "OpISub", .each = 1},
    {.name = "OpIMul", .each = 1},
    {.name = "OpSDiv", .special_each = 1},
    {.name = "OpVectorTimesScalar", .each = 1},
    {.name = "OpMatrixTimesScalar", .each = 1},
    {.name = "OpMatrixTimesVector", .each = -1, .operand = 2},
    {.name = "OpVectorTimesMatrix", .each = -1, .operand = 2},
    {.name = "OpDot", .operand = 2, .once = -1},
    {.name = "OpConvertFToS", .each = 1},
    {.name = "OpConvertSToF", .each = 1},
    {.name = "OpSelect", .each = 1},
    {.name = "OpAny", .operand = 1, .once = -1},
    {.name = "OpAll", .operand = 1, .once = -1},
    {.name = "OpLogicalNot", .each = 1},
    {.name = "OpLogicalAnd", .each = 1},
    {.name = "OpLogicalOr", .each = 1},
    {.name = "OpLogicalEqual", .each = 1},
    {.name = "OpLogicalNotEqual", .each = 1},
    {.name = "OpIEqual", .each = 1},
    {.name = "OpINotEqual", .each = 1},
    {.name = "OpSLessThan", .each = 1},
    {.name = "OpSLessThanEqual", .each = 1},
    {.name = "OpSGreaterThan", .each = 1},
    {.name = "OpSGreaterThanEqual", .each = 1},
    {.name = "OpFOrdEqual", .each = 1},
    {.name = "OpFOrdNotEqual", .each = 1},
    {.name = "OpFUnordNotEqual", .each = 1},
    {.name = "OpFOrdLessThan", .each = 1},
    {.name = "OpFOrdLessThanEqual", .each = 1},
    {.name = "OpFOrdGreaterThan", .each = 1},
    {.name = "OpFOrdGreaterThanEqual", .each = 1},
    {.name = "FAbs", .each = 1},
    {.name = "FSign", .each = 1},
    {.name = "Floor", .each = 1},
    {.name = "Ceil", .each = 1},
    {.name = "Fract", .each = 2},
    {.name = "FMin", .each = 1},
    {.name = "FMax", .each = 1},
    {.name = "FClamp", .each = 2},
    {.name = "FMix", .each = 3},
    {.name = "Fma", .each = 2},
    {.name = "Step", .each = 1},
    {.name = "SmoothStep", .each = 8, .special_each = 1},
    {.name = "Cross", .each = 3},
    {.name = "Length", .operand = 2, .once = -1, .special = 1},
    {.name = "Distance", .operand = 3, .once = -1, .special = 1},
    {.name = "Normalize", .each = 1, .operand = 2, .once = -1, .special = 1},
    {.name = "Reflect", .each = 2, .operand = 2},
    {.name = "FaceForward", .each = 1, .operand = 2},
    {.name = "Sqrt", .special_each = 1},
    {.name = "InverseSqrt", .special_each = 1},
    {.name = "Pow", .special_each = 1},
    {.name = "Exp", .special_each = 1},
    {.name = "Exp2", .special_each = 1},
    {.name = "Log", .special_each = 1},
    {.name = "Log2", .special_each = 1},
    {.name = "Sin", .special_each = 1},
    {.name = "Cos", .special_each = 1},
    {.name = "Tan", .special_each = 1},
    {.name = "Asin", .special_each = 1},
    {.name = "Acos", .special_each = 1},
    {.name = "Atan", .special_each = 1},
    {.name = "Atan2", .special_each = 1},
    {.name = "OpImageSampleImplicitLod", .special = 1},
    /* Moves and bookkeeping. */
    {.name = "OpLoad"},
    {.name = "OpStore"},
    {.name = "OpAccessChain"},
    {.name = "OpCompositeConstruct"},
    {.name = "OpCompositeExtract"},
    {.name = "OpCompositeInsert"},
    {.name = "OpVectorExtractDynamic"},
    {.name = "OpVectorInsertDynamic"},
    {.name = "OpVectorShuffle"},
    {.name = "OpCopyObject"},
    {.name = "OpUndef"},
    {.name = "OpVariable"},
    {.name = "OpPhi"},
    {.name = "OpFunction"},
    {.name = "OpFunctionEnd"},
    {.name = "OpLabel"},
    {.name = "OpSelectionMerge"},
    {.name = "OpBranch"},
    {.name = "OpBranchConditional"}, /* counted apart */
    {.name = "OpSwitch"},            /* spirv-opt's way of leaving a block; the language has none */
    {.name = "OpReturn"},
    {.name = "OpKill"},
    {.name = "OpUnreachable"},
};

static const Rule *find_rule(const char *name)
{
    for (size_t i = 0; i < sizeof RULES / sizeof RULES[0]; i++)
        if (strcmp(RULES[i].name, name) == 0)
            return &RULES[i];
    return NULL;
}

/* What is known of the disassembly so far. */
typedef struct Disassembly {
    unsigned bound;            /* ids of types and values are less */
    unsigned char *components; /* of each; 0 if not a number */
    unsigned real, one;        /* the type float, and its constant 1.0 */
    bool function;             /* the shader's only one has begun */
} Disassembly;

/* Adds what one line of disassembly costs: "%9 = OpDot %6 %7 %8". */
static bool count_line(Disassembly *known, const char *line, ShaderCost *cost, Message *message)
{
    unsigned result = 0, type = 0, last = 0;
    int parts = 1, max = 0;
    char name[64] = "", function[64] = "";
    if (sscanf(line, " %%%u = %63s %%%u", &result, name, &type) < 2)
        sscanf(line, " %63s", name);
    if (result >= known->bound || type >= known->bound)
        return message_set(message, "operations: spirv-dis says what is no SPIR-V: %s", line);
    unsigned char *components = known->components;
    if (strcmp(name, "OpTypeFloat") == 0 || strcmp(name, "OpTypeInt") == 0 ||
        strcmp(name, "OpTypeBool") == 0)
        components[result] = 1;
    else if (sscanf(line, " %%%*u = OpTypeVector %%%*u %d", &parts) == 1 ||
             sscanf(line, " %%%*u = OpTypeMatrix %%%*u %d", &parts) == 1)
        components[result] = (unsigned char)(components[type] * parts);
    else if (strncmp(name, "OpType", 6) != 0)
        components[result] = components[type];
    if (strcmp(name, "OpTypeFloat") == 0)
        known->real = result;
    if (strcmp(name, "OpConstant") == 0 && type == known->real && strstr(line, " 1\n"))
        known->one = result;
    known->function |= strcmp(name, "OpFunction") == 0;
    if (!known->function)
        return true;

    const char *operand = strchr(line, '=');
    while ((operand = operand ? strchr(operand + 1, '%') : NULL)) {
        last = (unsigned)strtoul(operand + 1, NULL, 10);
        if (last != type && last < known->bound && components[last] > max)
            max = components[last];
    }
    /* spirv-opt leaves it, no driver does. */
    if (strcmp(name, "OpVectorTimesScalar") == 0 && last == known->one)
        return true;
    if (strcmp(name, "OpLoopMerge") == 0)
        return message_set(message, "operations: cannot unroll a loop");
    sscanf(line, " %%%*u = OpExtInst %%%*u %%%*u %63s", function);
    const Rule *rule = find_rule(function[0] ? function : name);
    if (!rule)
        return message_set(message, "operations: cannot count %s", function[0] ? function : name);
    const int each = components[result];
    cost->arithmetic += each * rule->each + max * rule->operand + rule->once;
    cost->special += each * rule->special_each + rule->special;
    cost->branches += strcmp(name, "OpBranchConditional") == 0;
    return true;
}

static bool count_disassembly(FILE *file, ShaderCost *cost, Message *message)
{
    Disassembly known = {.bound = 0};
    char *line = NULL;
    size_t size = 0;
    bool done = true;
    while (done && getline(&line, &size, file) > 0) {
        if (!known.components && sscanf(line, "; Bound: %u", &known.bound) == 1)
            known.components = calloc(known.bound, 1);
        if (known.components && line[0] != ';')
            done = count_line(&known, line, cost, message);
    }
    free(known.components);
    free(line);
    return done && !known.function ? message_set(message, "operations: spirv-dis says nothing")
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
static const char *const LATER[] = {
    "transpose",
    "inverse",
    "determinant",
    "outerProduct",
    "round",
    "roundEven",
    "trunc",
    "modf",
    "isnan",
    "isinf",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "atanh",
    "fma",
    "frexp",
    "ldexp",
    "bitCount",
    "texture",
    "textureSize",
    "textureLod",
    "textureGrad",
    "textureProj",
    "textureOffset",
    "texelFetch",
    "textureGather",
    "dFdx",
    "dFdy",
    "fwidth",
    "barrier",
    "memoryBarrier",
    "findLSB",
    "findMSB",
    "layout",
    "centroid",
    "smooth",
    "patch",
    "sample",
    "uint",
    "uvec2",
    "uvec3",
    "uvec4",
    "mat2x2",
    "mat2x3",
    "mat2x4",
    "mat3x2",
    "mat3x3",
    "mat3x4",
    "mat4x2",
    "mat4x3",
    "mat4x4",
    "shared",
    "coherent",
    "restrict",
    "readonly",
    "writeonly",
    "buffer",
    "precise",
    "subroutine",
    "resource",
    "common",
    "partition",
    "active",
    "filter",
    "image1D",
    "image2D",
    "image3D",
    "imageCube",
    "isampler2D",
    "usampler2D",
    "sampler2DArray",
    "samplerCubeShadow",
    "atomic_uint",
    "uimage2D",
    "iimage2D",
    "imageBuffer",
    "samplerBuffer",
    "noise1",
    "noise2",
    "noise3",
    "noise4",
};

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
    for (size_t i = 0; i < sizeof LATER / sizeof LATER[0]; i++)
        if (has_word(text, LATER[i]))
            fprintf(file, "#define %s operations_%s\n", LATER[i], LATER[i]);
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
    static const char *const disassemble[] = {"spirv-dis", "--raw-id", NULL};
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
    file = file ? run_tool(disassemble, "spirv-tools", file, message) : NULL;
    const bool done = file && count_disassembly(file, cost, message);
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
    const bool keeps = cache_key_add_tool(&key, "glslangValidator") &&
                       cache_key_add_tool(&key, "spirv-opt") &&
                       cache_key_add_tool(&key, "spirv-dis");
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
