/* The first message set stays: it is nearest to the cause. */
#include "base/message.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool message_set(Message *message, const char *format, ...)
{
    if (!message || message->text[0])
        return false;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message->text, sizeof message->text, format, arguments);
    va_end(arguments);
    return false;
}

bool message_add(Message *message, const char *format, ...)
{
    if (!message)
        return false;
    size_t used = strlen(message->text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message->text + used, sizeof message->text - used, format, arguments);
    va_end(arguments);
    return false;
}

static bool message_in_color(int file)
{
    const char *none = getenv("NO_COLOR"), *terminal = getenv("TERM");
    return isatty(file) && !(none && none[0]) && terminal && strcmp(terminal, "dumb") != 0;
}

const char *message_color(int color, int file)
{
    if (!message_in_color(file))
        return "";
    return color == MESSAGE_RED      ? "\033[31m"
           : color == MESSAGE_GREEN  ? "\033[32m"
           : color == MESSAGE_YELLOW ? "\033[33m"
                                     : "\033[0m";
}
