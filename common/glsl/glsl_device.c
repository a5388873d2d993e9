/* Devices by name, or by what `precision` measured of one: text of each precision's significant
 * bits, least and largest exponent, and whether smaller numbers are kept. Functions beyond the four
 * operations and roots are taken as rounded correctly, except Mesa's, which are known. */
#include "glsl/glsl_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* clang-format off */
#define DOUBLE {53, -1022, 1023, true, false}
#define FLOAT {24, -126, 127, false, false}
#define KEPT {24, -126, 127, true, false}
#define HALF {11, -14, 15, true, false}
#define HALF_CUT {11, -14, 15, true, true}
#define ALL(highp, mediump) {DOUBLE, mediump, mediump, highp}
/* clang-format on */

const GlslArithmetic GLSL_EXACT = {.of = ALL(DOUBLE, DOUBLE)};
const GlslArithmetic GLSL_LLVMPIPE = {.of = ALL(FLOAT, HALF), .mesa = true, .fused = true};
static const GlslArithmetic NARROW = {.of = ALL(FLOAT, FLOAT), .mesa = true}; /* no F16C, no FMA */
static const GlslArithmetic SOFTPIPE = {.of = ALL(FLOAT, FLOAT)};
static const GlslArithmetic HALVED = {.of = ALL(FLOAT, HALF)};
static const GlslArithmetic WHOLE = {.of = ALL(KEPT, KEPT)};
static const GlslArithmetic NVIDIA = {.of = ALL(FLOAT, HALF_CUT), .color_bits = 12};

const GlslDevice GLSL_DEVICES[] = {
    {"llvmpipe", &GLSL_LLVMPIPE}, {"llvmpipe-128", &NARROW}, {"softpipe", &SOFTPIPE},
    {"nvidia", &NVIDIA},          {"half", &HALVED},         {"float", &WHOLE},
    {NULL, &GLSL_LLVMPIPE},
};

static const char BYTES[] = ";bytes=";

static const char KEPT_TOO[] = ",kept", CUT[] = ",cut";

/* "24,-126,127,kept,cut" after `name`. */
static bool read_numbers(const char *text, const char *name, GlslNumbers *numbers)
{
    const char *at = strstr(text, name);
    char *end;
    if (!at)
        return false;
    const long bits = strtol(at + strlen(name), &end, 10);
    const long least = *end == ',' ? strtol(end + 1, &end, 10) : 1;
    const long most = *end == ',' ? strtol(end + 1, &end, 10) : 0;
    const bool kept = strncmp(end, KEPT_TOO, strlen(KEPT_TOO)) == 0;
    end += kept ? strlen(KEPT_TOO) : 0;
    *numbers =
        (GlslNumbers){(int)bits, (int)least, (int)most, kept, strncmp(end, CUT, strlen(CUT)) == 0};
    return bits >= 2 && bits <= 53 && least >= -1022 && least < 0 && most > 0 && most <= 1023;
}

bool glsl_arithmetic_read(const char *text, GlslArithmetic *arithmetic)
{
    const GlslDevice *device = GLSL_DEVICES;
    while (device->name && strcmp(device->name, text) != 0)
        device++;
    *arithmetic = *device->arithmetic;
    if (device->name)
        return true;
    arithmetic->mesa = arithmetic->fused = strstr(text, "llvmpipe") != NULL;
    const bool read = read_numbers(text, "highp=", &arithmetic->of[GLSL_HIGHP]) &&
                      read_numbers(text, "mediump=", &arithmetic->of[GLSL_MEDIUMP]);
    arithmetic->of[GLSL_LOWP] = arithmetic->of[GLSL_MEDIUMP];
    const char *bytes = strstr(text, BYTES);
    arithmetic->color_bits = bytes ? atoi(bytes + strlen(BYTES)) : 0;
    return read && arithmetic->color_bits >= 0 && arithmetic->color_bits <= 24;
}

void glsl_arithmetic_print(const GlslArithmetic *arithmetic, char *text, size_t size)
{
    size_t used = 0;
    for (int i = GLSL_HIGHP; i >= GLSL_MEDIUMP; i--) {
        const GlslNumbers *numbers = &arithmetic->of[i];
        snprintf(text + used, size - used, "%s=%d,%d,%d%s%s",
                 i == GLSL_HIGHP ? "highp" : ";mediump", numbers->bits, numbers->least,
                 numbers->most, numbers->denormals ? KEPT_TOO : "", numbers->cut ? CUT : "");
        used = strlen(text);
    }
    if (arithmetic->color_bits)
        snprintf(text + used, size - used, "%s%d", BYTES, arithmetic->color_bits);
}
