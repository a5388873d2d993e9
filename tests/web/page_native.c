/*
 * page_native: what the pages' module answers, natively: the errors of each program that a line of
 * standard input names, with its arguments after it.
 */
#include "web/page.h"

#include <stdio.h>
#include <string.h>

int main(void)
{
    char line[1024];
    while (fgets(line, sizeof line, stdin)) {
        line[strcspn(line, "\n")] = '\0';
        for (char *space = line; (space = strchr(space, ' '));)
            *space = '\n';
        const int code = page_open(line);
        const char *error = code == 0 && page_draw(0, 0, 0, 1, 0) ? page_error(0) : "";
        printf("%s\n", error[0] ? error : page_message());
    }
    page_close();
    return 0;
}
