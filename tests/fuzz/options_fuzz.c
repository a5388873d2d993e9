/*
 * options_fuzz: no command line may do harm.
 *
 * The input's lines (or what zeros separate) are the arguments; each is also read as a size, a
 * number, a name and a pattern on its own.
 */
#include "app/options.h"
#include "base/output.h"
#include "base/parse.h"
#include "base/text.h"
#include "fuzz/fuzz.h"
#include "scene/scene_example.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const NAMES[] = {"LightedCube", "PointLightedCube", "output", NULL};

static void read_all(const Usage *usage, int count, char *arguments[])
{
    Options options;
    Message message = {0};
    const OptionsResult result = options_read(&options, usage, count, arguments, &message);
    require((result == OPTIONS_BAD) == (message.text[0] != '\0'));
    if (result == OPTIONS_RUN)
        require(options.output[0] && options.frames >= 1 && options.fps > 0 &&
                isfinite(options.seconds) && options.width >= 1);
}

FUZZ(data, size)
{
    enum { MAX = 16 };
    static const Usage program = {.name = "LightedCube", .summary = "Fuzzed.", .kind = &SCENE_KIND};
    static const Usage gallery = {.name = "gallery", .summary = "Fuzzed.", .gallery = true};
    static bool quiet;
    require(quiet || freopen("/dev/null", "w", stdout)); /* --help is printed often */
    quiet = true;

    char *text = malloc(size + 1);
    if (!text)
        return 0;
    for (size_t i = 0; i < size; i++)
        text[i] = data[i] == '\n' ? '\0' : (char)data[i];
    text[size] = '\0';
    char *arguments[MAX + 2] = {"program"}, *again[MAX + 2];
    int count = 1;
    for (char *p = text; p < text + size && count <= MAX; p += strlen(p) + 1) {
        int width = 0, height = 0;
        double number = 0;
        char path[64];
        Message message = {0};
        if (parse_size(p, &width, &height))
            require(width >= 1 && width <= PARSE_SIZE_MAX && height >= 1 &&
                    height <= PARSE_SIZE_MAX);
        if (parse_number(p, -1e9, 1e9, &number))
            require(fabs(number) <= 1e9);
        text_nearest(p, NAMES);
        require(output_numbered(p, 12345, path, sizeof path, &message) == !message.text[0]);
        arguments[count++] = p;
    }
    memcpy(again, arguments, sizeof again); /* reading moves what is no option to the end */
    read_all(&program, count, arguments);
    read_all(&gallery, count, again);
    free(text);
    return 0;
}
