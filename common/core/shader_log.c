/*
 * From the driver's log back to files: each driver writes places in a form of its own, of which the
 * source string and the line are those of our #line directives. To show a line, the source is read
 * from its beginning, following them. Linear in the source.
 */
#include "core/shader_source.h"

#include "base/text.h"

#include <stdlib.h>
#include <string.h>

bool shader_line_directive(const char *text, int *file, int *line)
{
    char *end;
    if (strncmp(text, "#line ", 6) != 0)
        return false;
    *line = (int)(strtol(text + 6, &end, 10) % SHADER_LINES_OF_FILE);
    *file = (int)strtol(end, &end, 10);
    return true;
}

/* By following our own #line directives. */
const char *shader_find_line(const char *text, int file, int line, int *length)
{
    int at_file = -1, at_line = 0;
    for (const char *p = text; p && *p;) {
        const char *newline = strchr(p, '\n');
        const int n = newline ? (int)(newline - p) : (int)strlen(p);
        if (!shader_line_directive(p, &at_file, &at_line)) {
            if (at_file == file && at_line == line) {
                *length = n;
                return p;
            }
            at_line++;
        }
        p = newline ? newline + 1 : NULL;
    }
    return NULL;
}

/* Reads "0:12(3): rest" (Mesa), "ERROR: 0:12: rest" (ANGLE) or "0(12) : rest" (NVIDIA). */
static const char *parse_position(const char *log, int *file, int *line)
{
    int places[3] = {0}, used;
    if (strncmp(log, "ERROR: ", 7) == 0)
        log += 7;
    else if (strncmp(log, "WARNING: ", 9) == 0)
        log += 9;
    if (!(used = text_numbers(log, "#:#(#):", places)) &&
        !(used = text_numbers(log, "#:#:", places)))
        used = text_numbers(log, "#(#) :", places);
    *file = places[0];
    *line = places[1];
    if (used && *line > SHADER_LINES_OF_FILE) {
        *file = *line / SHADER_LINES_OF_FILE;
        *line %= SHADER_LINES_OF_FILE;
    }
    return used ? log + used : NULL;
}

static void show_line(const ShaderSource *source, int file, int line, Message *message)
{
    int length;
    const char *text = shader_find_line(source->text, file, line, &length);
    if (text)
        message_add(message, "\n  %d | %.*s", line, length < 200 ? length : 200, text);
}

/* ANGLE's place of what is missing. */
static const char NOWHERE[] = "ERROR: -1:-1: ";

bool shader_explain_log(const ShaderSource *source, const char *log, Message *message)
{
    if (!message || message->text[0])
        return false;
    bool shown = false;
    while (*log) {
        const char *newline = strchr(log, '\n');
        const int length = newline ? (int)(newline - log) : (int)strlen(log);
        int file, line;
        const char *rest = parse_position(log, &file, &line);
        const char *separator = message->text[0] ? "\n" : "";
        if (rest && rest <= log + length && file >= 0 && file < source->file_count) {
            while (*rest == ' ')
                rest++;
            if (!message->text[0])
                message->located = true;
            message_add(message, "%s%s:%d: %.*s", separator, source->files[file], line,
                        (int)(log + length - rest), rest);
            if (!shown)
                show_line(source, file, line, message);
            shown = true;
        } else if (strncmp(log, NOWHERE, strlen(NOWHERE)) == 0) {
            message_add(message, "%s%s: %.*s", separator, source->files[0],
                        length - (int)strlen(NOWHERE), log + strlen(NOWHERE));
        } else if (length > 0) {
            message_add(message, "%s%.*s", separator, length, log);
        }
        log += length + (newline ? 1 : 0);
    }
    return false;
}
