#include "study/results/json.h"

/* The bytes of the UTF-8 character (RFC 3629) that `text` begins with; 0 if it is none. */
static int character_size(const unsigned char *text)
{
    static const struct {
        unsigned char min, max, second_min, second_max;
        int size;
    } kinds[] = {
        {0x01, 0x7F, 0, 0, 1},       {0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
        {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3}, {0xEE, 0xEF, 0x80, 0xBF, 3},
        {0xF0, 0xF0, 0x90, 0xBF, 4}, {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4}};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (text[0] < kinds[i].min || text[0] > kinds[i].max)
            continue;
        if (kinds[i].size > 1 && (text[1] < kinds[i].second_min || text[1] > kinds[i].second_max))
            return 0;
        for (int j = 2; j < kinds[i].size; j++)
            if ((text[j] & 0xC0) != 0x80)
                return 0;
        return kinds[i].size;
    }
    return 0;
}

void json_put_string(FILE *file, const char *text)
{
    fputc('"', file);
    while (*text) {
        const int size = character_size((const unsigned char *)text);
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
