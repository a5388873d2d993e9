/* In static memory, because options keep pointers to their words. */
#include "support/read_line.h"

#include "support/testing.h"

enum { MAX_ARGUMENTS = 24 };

OptionsResult read_line(Options *options, const Usage *usage, const char *line, Message *message)
{
    static char text[PARAMETER_TEXT_SIZE + 200];
    static char *arguments[MAX_ARGUMENTS + 2];
    int count = 0;
    snprintf(text, sizeof text, "%s %s", usage->name, line);
    for (char *word = strtok(text, " "); word; word = strtok(NULL, " ")) {
        assert_true(count <= MAX_ARGUMENTS);
        arguments[count++] = strcmp(word, "\"\"") == 0 ? word + 2 : word;
    }
    arguments[count] = NULL;
    return options_read(options, usage, count, arguments, message);
}
