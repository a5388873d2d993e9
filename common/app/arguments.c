/* Words of the command line against a table. They are read several times: first, once for each, the
 * options from which others follow, so that the order in which options are given does not matter.
 */
#include "app/arguments.h"

#include "base/text.h"

#include <stdio.h>
#include <string.h>

enum { NAMES_MAX = 127 };

/* The option of "--NAME" or "--NAME=VALUE": the exact name, or the only one that begins so. */
static const Parameter *find_long(const Parameter *table, const char *word, Message *message)
{
    const char *start = word + 2, *names[NAMES_MAX + 1] = {NULL};
    const size_t length = strcspn(start, "=");
    const Parameter *first = NULL, *second = NULL;
    for (int i = 0; table[i].name && i < NAMES_MAX; i++) {
        names[i] = table[i].name;
        if (length == 0 || strncmp(names[i], start, length) != 0)
            continue;
        if (names[i][length] == '\0')
            return &table[i];
        if (first && !second)
            second = &table[i];
        first = first ? first : &table[i];
    }
    if (first && !second)
        return first;
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)length, start);
    const char *nearest = length > 1 ? text_nearest(name, names) : NULL;
    if (second)
        message_set(message, "%s: could be --%s or --%s", word, first->name, second->name);
    else
        message_set(message, "%s: no such option; %s%s%s", word, nearest ? "did you mean --" : "",
                    nearest ? nearest : "--help lists them", nearest ? "?" : "");
    return NULL;
}

static const Parameter *find_letter(const Parameter *table, char letter, Message *message)
{
    for (; table->name; table++)
        if (table->letter == letter)
            return table;
    message_set(message, "-%c: no such option; --help lists them", letter);
    return NULL;
}

/* Reads one word, a long option or letters, and from *next the value if that is a separate word.
 * Sets the option `only`; if that is NULL, those that change no other option. */
static bool read_word(const Parameter *table, const char *word, char ***next, const Parameter *only,
                      const Parameter **answer, Message *message)
{
    const bool is_long = word[1] == '-';
    for (const char *letter = word + 1; *letter; letter++) {
        const Parameter *option =
            is_long ? find_long(table, word, message) : find_letter(table, *letter, message);
        if (!option)
            return false;
        const bool flag = option->kind == PARAMETER_FLAG;
        const char shown[] = {'-', *letter, '\0'}, *equals = is_long ? strchr(word, '=') : NULL;
        const char *value = equals ? equals + 1 : !is_long && letter[1] ? letter + 1 : NULL;
        if (flag && equals && !option->choices)
            return message_set(message, "%s: takes no value", word);
        if (!flag && !value && !(value = *(*next)++))
            return message_set(message, "%s: needs a value; see --help", is_long ? word : shown);
        if (!option->value) {
            *answer = option;
            return true;
        }
        const bool now = only ? option == only : !option->changed;
        if (now && !parameter_read(option, value, message))
            return false;
        if (is_long || !flag)
            return true;
    }
    return true;
}

/* Reads the words once; moves those that are not options to the front if `only` is NULL. */
static bool read_words(const Parameter *table, int argc, char *argv[], const Parameter *only,
                       const Parameter **answer, Message *message)
{
    char **next = argv + (argc > 0), **names = next;
    *answer = NULL;
    while (*next && !*answer) {
        char *word = *next++;
        if (strcmp(word, "--") == 0)
            break;
        const bool name = word[0] != '-' || !word[1];
        if (name && !only)
            *names++ = word;
        else if (!name && !read_word(table, word, &next, only, answer, message))
            return false;
    }
    while (*next && !only)
        *names++ = *next++;
    if (!only)
        *names = NULL;
    return true;
}

bool arguments_read(const Parameter *table, int argc, char *argv[], const Parameter **answer,
                    Message *message)
{
    for (const Parameter *option = table; option->name; option++)
        if (option->changed && !read_words(table, argc, argv, option, answer, message))
            return false;
    return read_words(table, argc, argv, NULL, answer, message);
}
