/* A stream in memory, then one call of output_write. */
#include "labs/submission/text_file.h"

#include "base/output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

bool text_file_open(TextFile *file, const char *folder, const char *name, Message *message)
{
    *file = (TextFile){.text = NULL};
    if (snprintf(file->path, sizeof file->path, "%s%s%s", folder ? folder : "", folder ? "/" : "",
                 name) >= (int)sizeof file->path)
        return message_set(message, "%s: %s", folder ? folder : name, strerror(ENAMETOOLONG));
    file->file = open_memstream(&file->text, &file->size);
    return file->file || message_set(message, "%s: %s", file->path, strerror(errno));
}

bool text_file_close(TextFile *file, Message *message)
{
    const bool done = fclose(file->file) == 0
                          ? output_write(file->path, file->text, file->size, message)
                          : message_set(message, "%s: not enough memory", file->path);
    free(file->text);
    return done;
}
