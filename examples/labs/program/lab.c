/* How people write the names of the labs. */
#include "labs/program/lab.h"

#include "base/paths.h"
#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The number in "5", "05", "lab5" or "lab05"; 0: none. */
static int lab_number(const char *text)
{
    if (strncmp(text, "lab", 3) == 0)
        text += 3;
    const size_t length = strlen(text);
    if (length < 1 || length > 2 || strspn(text, "0123456789") != length)
        return 0;
    return atoi(text);
}

const Lab *lab_find(const char *text, Message *message)
{
    const char *names[LAB_COUNT + 1] = {NULL};
    const int number = lab_number(text);
    for (int i = 0; i < LAB_COUNT; i++) {
        names[i] = LABS[i].name;
        if (LABS[i].number == number || strcmp(text, names[i]) == 0)
            return &LABS[i];
    }
    const char *nearest = text_nearest(text, names);
    message_set(message, "%s: no such lab; %s%s%s", text, nearest ? "did you mean " : "there are ",
                nearest ? nearest : "lab01 to lab11", nearest ? "?" : "");
    return NULL;
}

int lab_files(const Lab *lab, char names[LAB_MAX_FILES][LAB_NAME_SIZE])
{
    int count = 0;
    if (!lab->given) {
        snprintf(names[count++], LAB_NAME_SIZE, "%s.vert", lab->file);
        snprintf(names[count++], LAB_NAME_SIZE, "%s.frag", lab->file);
    }
    if (lab->code)
        snprintf(names[count++], LAB_NAME_SIZE, "%s", lab->code);
    return count;
}

bool lab_folder(const Lab *lab, char folder[PATH_MAX], Message *message)
{
    char source[PATH_MAX];
    if (lab->folder) {
        snprintf(folder, PATH_MAX, "%s", lab->folder);
        return true;
    }
    snprintf(source, sizeof source, "examples/labs/%s", lab->name);
    return paths_find_data(source, source + strlen("examples/"), folder) ||
           message_set(message, "%s: the lab's folder %s does not exist", lab->name, folder);
}

bool lab_has_light(const Lab *lab, const char *part)
{
    return strcmp(part, "diffuse") == 0 || (lab->ambient && strcmp(part, "ambient") == 0) ||
           (lab->specular && strcmp(part, "highlight") == 0) ||
           (lab->lights == 2 && (strcmp(part, "light 1") == 0 || strcmp(part, "light 2") == 0));
}
