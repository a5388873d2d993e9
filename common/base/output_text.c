/* Text that grows in memory, for output_write. */
#include "base/output_text.h"

#include "base/memory.h"
#include "base/output.h"
#include "base/text.h"

#include <stdlib.h>

void output_text_open(OutputText *text)
{
    *text = (OutputText){.text = NULL};
    text->file = open_memstream(&text->text, &text->size);
    if (!text->file)
        memory_end();
}

char *output_text_close(OutputText *text)
{
    const bool failed = ferror(text->file) != 0;
    if (fclose(text->file) != 0 || failed)
        memory_end();
    return text->text;
}

bool output_text_put(OutputText *text, const char *folder, const char *name, Message *message)
{
    char path[PATH_MAX];
    if (output_path(path, folder, name, message))
        return output_text_write(text, path, message);
    free(output_text_close(text));
    return false;
}

bool output_text_write(OutputText *text, const char *path, Message *message)
{
    char *bytes = output_text_close(text);
    const bool done = output_write(path, bytes, text->size, message);
    free(bytes);
    return done;
}

void output_text_wrap(OutputText *text, FILE *file, int indent, int width)
{
    char *line = output_text_close(text);
    text_wrap(file, line, 0, indent, width);
    free(line);
}
