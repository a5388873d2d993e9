/* A table, and how people write its names. */
#include "labs/program/lab.h"

#include "base/paths.h"
#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* examples/run reads names and summaries here. */
/* clang-format off */
const Lab LABS[LAB_COUNT] = {
    {.number = 1, .name = "lab01_diffuse", .file = "lab01",
     .summary = "lab 1: diffuse light on a cube",
     .light = LIGHT_DIRECTIONAL, .lights = 1, .flat = true, .rigid = true, .either = true},
    {.number = 2, .name = "lab02_ambient", .file = "lab02",
     .summary = "lab 2: two lights, and ambient light once",
     .light = LIGHT_DIRECTIONAL, .lights = 2, .ambient = true, .flat = true, .rigid = true,
     .either = true},
    {.number = 3, .name = "lab03_normal_matrix", .file = "lab03", .code = "matrices.c",
     .summary = "lab 3: the model matrix and the normal matrix of a cube (C)",
     .light = LIGHT_DIRECTIONAL, .lights = 1, .ambient = true, .flat = true, .given = true},
    {.number = 4, .name = "lab04_point_light", .file = "lab04",
     .summary = "lab 4: two point lights",
     .light = LIGHT_POINT, .lights = 2, .ambient = true, .flat = true, .either = true},
    {.number = 5, .name = "lab05_per_fragment", .file = "lab05",
     .summary = "lab 5: light at every fragment, with renormalized normals",
     .light = LIGHT_POINT, .lights = 2, .ambient = true},
    {.number = 6, .name = "lab06_phong", .file = "lab06",
     .summary = "lab 6: Phong's highlight, on the lit side only",
     .light = LIGHT_POINT, .lights = 2, .ambient = true, .specular = true,
     .reflection = REFLECTION_PHONG},
    {.number = 7, .name = "lab07_blinn_phong", .file = "lab07",
     .summary = "lab 7: Blinn-Phong's highlight, fitted to Phong's",
     .light = LIGHT_POINT, .lights = 2, .ambient = true, .specular = true, .fitted = true,
     .reflection = REFLECTION_BLINN_PHONG},
    {.number = 8, .name = "lab08_spot", .file = "lab08",
     .summary = "lab 8: a spot light with a soft edge, and attenuation",
     .light = LIGHT_SPOT, .lights = 1, .ambient = true, .specular = true,
     .reflection = REFLECTION_PHONG},
    {.number = 9, .name = "lab09_two_sided", .file = "lab09",
     .summary = "lab 9: both sides of a surface, also mirrored",
     .light = LIGHT_POINT, .lights = 1, .ambient = true, .flat = true, .two_sided = true},
    {.number = 10, .name = "lab10_budget", .file = "lab10", .code = "budget.c",
     .summary = "lab 10: at most one step of error, as cheap as possible (C)",
     .light = LIGHT_POINT, .lights = 1, .ambient = true, .specular = true, .rigid = true,
     .budget = true, .reflection = REFLECTION_PHONG},
    {.number = 11, .name = "lab11_shadow_map", .file = "lab11",
     .summary = "lab 11: shadows, by looking up a shadow map",
     .light = LIGHT_POINT, .lights = 1, .ambient = true, .flat = true, .shadow = true},
};
/* clang-format on */

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
    char source[64];
    snprintf(source, sizeof source, "examples/labs/%s", lab->name);
    if (paths_find_data(source, source + strlen("examples/"), folder))
        return true;
    return message_set(message, "%s: the lab's folder %s does not exist", lab->name, folder);
}
