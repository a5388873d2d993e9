/* An example is a function of its parameters: where it hands over the same data without an option
 * that was given, the option changes nothing. What it hands over is compared by a key. */
#include "kinds/ineffective_options.h"

#include <stdio.h>
#include <string.h>

const double INEFFECTIVE_LATER[INEFFECTIVE_MOMENTS] = {0, 0.7, 1.9};

bool ineffective_unknown(const Example *example, const Options *options)
{
    const Parameter *table = example->parameters;
    for (int i = 0; table && table[i].name; i++)
        if (options->own_given[i] && table[i].kind == PARAMETER_TEXT)
            return true;
    return false;
}

static bool make_key(const Example *example, const Options *options, IneffectiveKey *add_all,
                     CacheKey *key)
{
    const Usage usage = options_usage(example);
    int size[2] = {options->width, options->height};
    *key = (CacheKey){{0, 0}};
    if (!options->size_given)
        options_size(&usage, &size[0], &size[1]);
    cache_key_add(key, size, sizeof size);
    return add_all(example, options, key);
}

/* Sets the parameters as if the options had been given without one: those from which others follow
 * first, as when they are read. */
static void set_without(const Parameter *table, const Options *options, int left_out,
                        const ParameterValue *defaults, const ParameterValue *values)
{
    for (int i = 0; table[i].name; i++)
        parameter_restore(&table[i], defaults[i]);
    for (int turn = 0; turn < 2; turn++)
        for (int i = 0; table[i].name; i++) {
            if (i == left_out || !options->own_given[i] ||
                (turn == 0) != (table[i].changed != NULL))
                continue;
            parameter_restore(&table[i], values[i]);
            if (table[i].changed)
                table[i].changed(&table[i]);
        }
}

void ineffective_options(const Example *example, const Options *options,
                         const ParameterValue *defaults, IneffectiveKey *add_all, char *text,
                         size_t size)
{
    const Parameter *table = example->parameters;
    ParameterValue values[OPTIONS_MAX_PARAMETERS];
    CacheKey all, without;
    bool given = false;
    for (int i = 0; table && table[i].name; i++) {
        values[i] = parameter_save(&table[i]);
        given |= options->own_given[i];
    }
    bool done = given && make_key(example, options, add_all, &all);
    for (int i = 0; done && table[i].name; i++) {
        if (!options->own_given[i] || parameter_equal(&table[i], &defaults[i]))
            continue;
        set_without(table, options, i, defaults, values);
        done = make_key(example, options, add_all, &without);
        const size_t length = strlen(text);
        if (done && memcmp(&all, &without, sizeof all) == 0)
            snprintf(text + length, size - length, "%s--%s", length ? ", " : "", table[i].name);
        for (int k = 0; table[k].name; k++)
            parameter_restore(&table[k], values[k]);
    }
}
