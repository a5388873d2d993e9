#include "efficient.h"

#include "module.h"
#include "output.h"
#include "parse.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *const SCENE_CLASS_NAMES[SCENE_CLASS_COUNT + 1] = {
    "spot", "shiny128", "shiny32", "shiny8", "curved", "flat", NULL,
};

SceneClass scene_class(const Scene *scene)
{
    bool curved = false, specular = false;
    double shininess = -1;
    for (int i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        if (!light->off && light->kind == LIGHT_SPOT)
            return SCENE_SPOT;
        specular |= !light->off && !color_is_black(light->specular);
    }
    for (int i = 0; i < scene->object_count; i++) {
        const Object *object = &scene->objects[i];
        curved |= !object->flat;
        if (specular && !color_is_black(object->front.specular) &&
            object->front.shininess > shininess)
            shininess = object->front.shininess;
        if (specular && object->two_sided && !color_is_black(object->back.specular) &&
            object->back.shininess > shininess)
            shininess = object->back.shininess;
    }
    if (shininess >= 0)
        return shininess > 32 ? SCENE_SHINY128 : shininess > 8 ? SCENE_SHINY32 : SCENE_SHINY8;
    return curved ? SCENE_CURVED : SCENE_FLAT;
}

bool efficient_allows(const Setting *setting)
{
    static const SettingAxis free_axes[] = {AXIS_INTERPOLATION, AXIS_DIVISIONS, AXIS_PRECISION,
                                            AXIS_NORMALS};
    Setting rest = *setting;
    const Setting usual = setting_usual();
    for (size_t i = 0; i < sizeof free_axes / sizeof free_axes[0]; i++)
        rest = setting_with(rest, free_axes[i], usual.choice[free_axes[i]]);
    return setting_equal(&rest, &usual);
}

/* The table. A line is CLASS,SETTING,MAXIMUM,RMS,MILLISECONDS; # begins a comment. */

static bool parse_row(EfficientRow *row, char *line, Message *message)
{
    char *fields[6] = {NULL}, *rest = line;
    int count = 0;
    while (count < 6 && (fields[count] = strsep(&rest, ",")) != NULL)
        count++;
    if (count != 5)
        return message_set(message, "must have 5 fields: class, setting, maximum, rms, "
                                    "milliseconds");
    int class = 0;
    while (SCENE_CLASS_NAMES[class] && strcmp(SCENE_CLASS_NAMES[class], fields[0]) != 0)
        class ++;
    if (!SCENE_CLASS_NAMES[class])
        return message_set(message, "%s: no such class of scenes", fields[0]);
    row->class = (SceneClass) class;
    if (!setting_parse(&row->setting, fields[1], message))
        return false;
    if (!efficient_allows(&row->setting))
        return message_set(message,
                           "%s: only interpolation, divisions, precision and normals may differ "
                           "from the usual",
                           fields[1]);
    if (!parse_number(fields[2], 0, 255, &row->maximum) ||
        !parse_number(fields[3], 0, 255, &row->rms) ||
        !parse_number(fields[4], 0, 1e6, &row->milliseconds))
        return message_set(message, "errors must be 0 to 255, milliseconds 0 to 1e6");
    return true;
}

bool efficient_parse(Efficient *table, const char *path, const char *text, size_t size,
                     Message *message)
{
    const char *end = text + size;
    table->count = 0;
    snprintf(table->path, sizeof table->path, "%s", path);
    for (int number = 1; text < end; number++) {
        const char *newline = memchr(text, '\n', (size_t)(end - text));
        const size_t length = (size_t)((newline ? newline : end) - text);
        char line[512];
        Message why = {0};
        if (length >= sizeof line || memchr(text, '\0', length))
            return message_set(message, "%s:%d: no line of a table of settings", path, number);
        memcpy(line, text, length);
        line[length] = '\0';
        text += length + 1;
        if (length == 0 || line[0] == '#')
            continue;
        if (table->count == EFFICIENT_MOST_ROWS)
            return message_set(message, "%s:%d: more than %d rows", path, number,
                               EFFICIENT_MOST_ROWS);
        if (!parse_row(&table->rows[table->count], line, &why))
            return message_set(message, "%s:%d: %s; `accuracy --calibrate` makes a table anew",
                               path, number, why.text);
        table->count++;
    }
    return true;
}

/* Below XDG_CONFIG_HOME, or ~/.config. False where neither is known. */
static bool own_path(char path[PATH_MAX], char folder[PATH_MAX])
{
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    int length;
    if (config && config[0] == '/')
        length = snprintf(folder, PATH_MAX, "%s/lighting", config);
    else if (home && home[0] == '/')
        length = snprintf(folder, PATH_MAX, "%s/.config/lighting", home);
    else
        return false;
    return length < PATH_MAX - 32 && snprintf(path, PATH_MAX, "%s/efficient.csv", folder) > 0;
}

static bool read_file(Efficient *table, const char *path, Message *message)
{
    enum { MOST = 1 << 20 };
    struct stat status;
    /* Before it is opened, which waits where it is a pipe. */
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return message_set(message, "%s: is %s; the table of settings is a file", path,
                           S_ISDIR(status.st_mode) ? "a folder" : "no regular file");
    FILE *file = fopen(path, "rb");
    char *text = file ? malloc(MOST + 1) : NULL;
    if (!file || !text) {
        message_set(message, "%s: %s", path, strerror(errno));
        if (file)
            fclose(file);
        return false;
    }
    const size_t size = fread(text, 1, MOST + 1, file);
    bool done = !ferror(file);
    if (!done)
        message_set(message, "%s: %s", path, strerror(errno));
    else if (size > MOST)
        done = message_set(message, "%s: too large for a table of settings", path);
    else
        done = efficient_parse(table, path, text, size, message);
    fclose(file);
    free(text);
    return done;
}

/* The installation's, beside the program: PREFIX/bin, PREFIX/share. */
static bool installed_path(char path[PATH_MAX])
{
    char folder[4096];
    module_program_folder(folder);
    return folder[0] && snprintf(path, PATH_MAX, "%s/%s", folder, EFFICIENT_RELATIVE) < PATH_MAX;
}

bool efficient_read(Efficient *table, Message *message)
{
    char path[PATH_MAX], folder[PATH_MAX];
    const char *named = getenv("LIGHTING_EFFICIENT");
    if (named && named[0])
        return read_file(table, named, message);
    if (own_path(path, folder) && access(path, F_OK) == 0)
        return read_file(table, path, message);
    if (access(EFFICIENT_SOURCE, F_OK) == 0)
        return read_file(table, EFFICIENT_SOURCE, message);
    if (installed_path(path) && access(path, F_OK) == 0)
        return read_file(table, path, message);
    return read_file(table, EFFICIENT_INSTALLED, message);
}

bool efficient_path_to_write(char path[PATH_MAX], Message *message)
{
    char folder[PATH_MAX], *slash;
    const char *named = getenv("LIGHTING_EFFICIENT");
    if (named && named[0]) {
        if (snprintf(path, PATH_MAX, "%s", named) < PATH_MAX)
            return true;
        return message_set(message, "LIGHTING_EFFICIENT: %s", strerror(ENAMETOOLONG));
    }
    if (!own_path(path, folder))
        return message_set(message,
                           "nowhere to keep the table: neither HOME nor XDG_CONFIG_HOME is "
                           "set; name a file in LIGHTING_EFFICIENT");
    /* Its parent too, for ~/.config may be missing. */
    if ((slash = strrchr(folder, '/')) && slash > folder) {
        *slash = '\0';
        if (!output_folder(folder, message))
            return false;
        *slash = '/';
    }
    return output_folder(folder, message);
}

bool efficient_write(const Efficient *table, const char *path, const char *renderer,
                     Message *message)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return message_set(message, "%s: not enough memory", path);
    fprintf(file,
            "# Efficient settings, as measured with %s.\n"
            "# class,setting,maximum error,rms error (steps of 1/255),milliseconds\n",
            renderer);
    for (int i = 0; i < table->count; i++) {
        const EfficientRow *row = &table->rows[i];
        char setting[SETTING_TEXT_SIZE];
        setting_text(&row->setting, setting);
        fprintf(file, "%s,%s,%.3f,%.4f,%.3f\n", SCENE_CLASS_NAMES[row->class], setting,
                row->maximum, row->rms, row->milliseconds);
    }
    const bool whole = fclose(file) == 0;
    const bool done = whole ? output_write(path, text, size, message)
                            : message_set(message, "%s: not enough memory", path);
    free(text);
    return done;
}

const EfficientRow *efficient_choose(const Efficient *table, SceneClass class, double error,
                                     Message *message)
{
    const EfficientRow *best = NULL, *least = NULL;
    for (int i = 0; i < table->count; i++) {
        const EfficientRow *row = &table->rows[i];
        if (row->class != class)
            continue;
        if (!least || row->maximum < least->maximum)
            least = row;
        if (row->maximum <= error && (!best || row->milliseconds < best->milliseconds))
            best = row;
    }
    if (!best && least)
        message_set(message,
                    "--error %g: no setting is so exact for scenes of the class %s; the "
                    "least is %.2f",
                    error, SCENE_CLASS_NAMES[class], least->maximum);
    else if (!best)
        message_set(message,
                    "--error: %s has no row for scenes of the class %s; `accuracy "
                    "--calibrate` makes a table anew",
                    table->path, SCENE_CLASS_NAMES[class]);
    return best;
}
