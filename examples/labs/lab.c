#include "lab.h"

#include "module.h"
#include "parse.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* examples/run reads names and summaries here. */
const Lab LABS[LAB_COUNT] = {
    {
        .number = 1,
        .name = "lab01_diffuse",
        .file = "lab01",
        .summary = "lab 1: diffuse light on a cube",
        .light = LIGHT_DIRECTIONAL,
        .lights = 1,
        .flat = true,
        .rigid = true,
        .either = true,
    },
    {
        .number = 2,
        .name = "lab02_ambient",
        .file = "lab02",
        .summary = "lab 2: two lights, and ambient light once",
        .light = LIGHT_DIRECTIONAL,
        .lights = 2,
        .ambient = true,
        .flat = true,
        .rigid = true,
        .either = true,
    },
    {
        .number = 3,
        .name = "lab03_normal_matrix",
        .file = "lab03",
        .summary = "lab 3: a cube scaled, turned and moved, and the matrix for its normals (C)",
        .code = "matrices.c",
        .light = LIGHT_DIRECTIONAL,
        .lights = 1,
        .ambient = true,
        .flat = true,
        .given = true,
    },
    {
        .number = 4,
        .name = "lab04_point_light",
        .file = "lab04",
        .summary = "lab 4: two point lights",
        .light = LIGHT_POINT,
        .lights = 2,
        .ambient = true,
        .flat = true,
        .either = true,
    },
    {
        .number = 5,
        .name = "lab05_per_fragment",
        .file = "lab05",
        .summary = "lab 5: light at every fragment, with normals that are unit again",
        .light = LIGHT_POINT,
        .lights = 2,
        .ambient = true,
    },
    {
        .number = 6,
        .name = "lab06_phong",
        .file = "lab06",
        .summary = "lab 6: Phong's highlight, on the lit side only",
        .light = LIGHT_POINT,
        .lights = 2,
        .ambient = true,
        .specular = true,
        .reflection = REFLECTION_PHONG,
    },
    {
        .number = 7,
        .name = "lab07_blinn_phong",
        .file = "lab07",
        .summary = "lab 7: Blinn-Phong's highlight, fitted to Phong's",
        .light = LIGHT_POINT,
        .lights = 2,
        .ambient = true,
        .specular = true,
        .fitted = true,
        .reflection = REFLECTION_BLINN_PHONG,
    },
    {
        .number = 8,
        .name = "lab08_spot",
        .file = "lab08",
        .summary = "lab 8: a spot light with a soft edge, and attenuation",
        .light = LIGHT_SPOT,
        .lights = 1,
        .ambient = true,
        .specular = true,
        .reflection = REFLECTION_PHONG,
    },
    {
        .number = 9,
        .name = "lab09_two_sided",
        .file = "lab09",
        .summary = "lab 9: both sides of a surface, also in a mirror",
        .light = LIGHT_POINT,
        .lights = 1,
        .ambient = true,
        .flat = true,
        .two_sided = true,
    },
    {
        .number = 10,
        .name = "lab10_budget",
        .file = "lab10",
        .summary = "lab 10: at most one step wrong, and as cheap as possible (C)",
        .code = "budget.c",
        .light = LIGHT_POINT,
        .lights = 1,
        .ambient = true,
        .specular = true,
        .rigid = true,
        .budget = true,
        .reflection = REFLECTION_PHONG,
    },
};

/* The number that "5", "05", "lab5" or "lab05" says; 0 for none. */
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
    const char *nearest = parse_nearest(text, names);
    message_set(message, "%s: no such lab; %s%s%s", text, nearest ? "did you mean " : "they are ",
                nearest ? nearest : "lab01 to lab10", nearest ? "?" : "");
    return NULL;
}

bool lab_folder(const Lab *lab, char folder[PATH_MAX], Message *message)
{
    char self[4096];
    struct stat status;
    module_program_folder(self);
    const char *const places[] = {LABS_SOURCE, self[0] ? LABS_RELATIVE : NULL, LABS_INSTALLED};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        if (!places[i])
            continue;
        const bool relative = i == 1;
        if (snprintf(folder, PATH_MAX, "%s%s%s/%s", relative ? self : "", relative ? "/" : "",
                     places[i], lab->name) < PATH_MAX &&
            stat(folder, &status) == 0 && S_ISDIR(status.st_mode))
            return true;
    }
    return message_set(message, "%s: its folder is neither in %s nor in %s", lab->name, LABS_SOURCE,
                       LABS_INSTALLED);
}
