#include "base/message.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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
