/* Lines are found by the #line directives that assembling a shader writes. */
#include "probe/place.h"

#include "base/text.h"
#include "core/shader_source.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static void copy_line(const char *source, int file, int line, char text[PLACE_TEXT])
{
    int length = 0;
    const char *found = shader_find_line(source, file, line, &length);
    char whole[500];
    while (length > 0 && isspace((unsigned char)*found)) {
        found++;
        length--;
    }
    snprintf(whole, sizeof whole, "%.*s", length, found ? found : "");
    const bool fits = strlen(whole) < PLACE_TEXT;
    snprintf(text, PLACE_TEXT, "%.*s%s", fits ? PLACE_TEXT - 1 : PLACE_TEXT - 4, whole,
             fits ? "" : "...");
}

void place_line(const char *source, GlslPlace place, char text[PLACE_TEXT])
{
    copy_line(source, place.file, place.line % SHADER_LINES_OF_FILE, text);
    text_strip_comments(text);
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        text[--length] = '\0';
}

void place_name(const char *source, GlslPlace place, char name[PLACE_TEXT])
{
    const int line = place.line % SHADER_LINES_OF_FILE;
    char first[PLACE_TEXT];
    copy_line(source, place.file, 1, first);
    const size_t length = strcspn(first, ": ") == 2 ? strcspn(first + 3, ": (") : 0;
    if (!strstr(source, "\n#line 1000001 1\n")) /* one file */
        snprintf(name, PLACE_TEXT, "line %d", line);
    else if (length > 0 && memchr(first + 3, '.', length))
        snprintf(name, PLACE_TEXT, "%.*s:%d", (int)length, first + 3, line);
    else
        snprintf(name, PLACE_TEXT, "file %d, line %d", place.file, line);
}
