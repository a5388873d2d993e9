#include "study/results/json.h"

#include "base/text.h"

void json_put_string(FILE *file, const char *text)
{
    fputc('"', file);
    while (*text) {
        const int size = text_character(text);
        if (size == 0)
            fputs("\\ufffd", file);
        else if (*text == '"' || *text == '\\')
            fprintf(file, "\\%c", *text);
        else if ((unsigned char)*text < ' ')
            fprintf(file, "\\u%04x", (unsigned)*text);
        else
            fwrite(text, 1, (size_t)size, file);
        text += size ? size : 1;
    }
    fputc('"', file);
}
