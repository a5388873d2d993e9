/* A table of keys for each object: what a key's value has to be, and where it goes. What a table
 * lacks is refused, with the nearest key, so that a typing error does not become a default. */
#include "labs/submission/lab_json.h"

#include "base/text.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

/* What is read: the message begins with the file and the keys that lead here. */
typedef struct Reading {
    LabFolder *folder;
    char where[256];
    Message *message;
} Reading;

typedef bool Read(Reading *reading, const json_t *value);

typedef struct Key {
    const char *name;
    enum { KEY_FLAG, KEY_NUMBER, KEY_VECTOR, KEY_TEXT, KEY_CHOICE, KEY_READ } kind;
    bool needed;
    size_t offset; /* in Lab */
    double min, max;
    const char *const *choices;
    Read *read;
} Key;

#define AT(member) .offset = offsetof(Lab, member)

static bool fail(const Reading *reading, const char *key, const char *what)
{
    return message_set(reading->message, "%s/lab.json: %s\"%s\": %s", reading->folder->path,
                       reading->where, key, what);
}

static bool read_number(const Reading *reading, const Key *key, const json_t *value)
{
    char what[128];
    const double number = json_number_value(value);
    snprintf(what, sizeof what, "must be a number from %g to %g", key->min, key->max);
    if (!json_is_number(value) || !(number >= key->min && number <= key->max))
        return fail(reading, key->name, what);
    void *at = (char *)&reading->folder->lab + key->offset;
    if (key->offset == offsetof(Lab, number))
        *(int *)at = (int)number;
    else
        *(double *)at = number;
    return true;
}

/* `count` numbers; one may stand for a list of one. */
static bool read_numbers(const json_t *value, size_t count, double numbers[])
{
    if (count == 1 && json_is_number(value)) {
        numbers[0] = json_number_value(value);
        return isfinite(numbers[0]);
    }
    if (!json_is_array(value) || json_array_size(value) != count)
        return false;
    for (size_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(value, i);
        numbers[i] = json_number_value(number);
        if (!json_is_number(number) || fabs(numbers[i]) > 1e6)
            return false;
    }
    return true;
}

static bool read_vector(const Reading *reading, const char *name, const json_t *value, Vec3 *vector)
{
    double numbers[3];
    if (!read_numbers(value, 3, numbers))
        return fail(reading, name, "must be a list of three numbers, like [1, 0.5, 0.2]");
    *vector = (Vec3){numbers[0], numbers[1], numbers[2]};
    return true;
}

static bool read_choice(const Reading *reading, const Key *key, const json_t *value)
{
    char what[256] = "must be one of";
    const int found = text_among(json_string_value(value), key->choices);
    if (found >= 0)
        *(int *)((char *)&reading->folder->lab + key->offset) = found;
    for (int i = 0; key->choices[i] && found < 0; i++) {
        const size_t used = strlen(what);
        snprintf(what + used, sizeof what - used, "%s \"%s\"", i ? "," : "", key->choices[i]);
    }
    return found >= 0 || fail(reading, key->name, what);
}

static bool read_key(Reading *reading, const Key *key, const json_t *value)
{
    void *at = (char *)&reading->folder->lab + key->offset;
    switch (key->kind) {
    case KEY_FLAG:
        *(bool *)at = json_is_true(value);
        return json_is_boolean(value) || fail(reading, key->name, "must be true or false");
    case KEY_NUMBER:
        return read_number(reading, key, value);
    case KEY_VECTOR:
        return read_vector(reading, key->name, value, at);
    case KEY_TEXT:
        *(const char **)at = json_string_value(value);
        return (json_is_string(value) && json_string_length(value) > 0) ||
               fail(reading, key->name, "must be a text");
    case KEY_CHOICE:
        return read_choice(reading, key, value);
    default:
        return key->read(reading, value);
    }
}

/* Reads an object by its keys, which end with a NULL name. */
static bool read_object(Reading *reading, const char *name, const json_t *object, const Key *keys)
{
    enum { KEYS_MAX = 24 };
    const char *names[KEYS_MAX + 1] = {NULL}, *found;
    char what[128];
    json_t *value;
    const size_t used = strlen(reading->where);
    if (!json_is_object(object))
        return fail(reading, name, "must be an object, in braces");
    if (name[0])
        snprintf(reading->where + used, sizeof reading->where - used, "\"%s\": ", name);
    for (int i = 0; keys[i].name; i++)
        names[i] = keys[i].name;
    json_object_foreach((json_t *)object, found, value)
    {
        const int i = text_among(found, names);
        const char *nearest = text_nearest(found, names);
        snprintf(what, sizeof what, "no such key; %s%s%s",
                 nearest ? "did you mean \"" : "TEACHING.md lists them", nearest ? nearest : "",
                 nearest ? "\"?" : "");
        if (i >= 0 ? !read_key(reading, &keys[i], value) : fail(reading, found, what))
            return false;
    }
    for (int i = 0; keys[i].name; i++)
        if (keys[i].needed && !json_object_get(object, keys[i].name))
            return fail(reading, keys[i].name, "is missing");
    reading->where[used] = '\0';
    return true;
}

static bool read_lights(Reading *reading, const json_t *list)
{
    Lab *lab = &reading->folder->lab;
    const size_t count = json_array_size(list);
    char what[64];
    snprintf(what, sizeof what, "must be a list of one to %d lights", LAB_MAX_LIGHTS);
    if (!json_is_array(list) || count < 1 || count > LAB_MAX_LIGHTS)
        return fail(reading, "lights", what);
    lab->lights = (int)count;
    for (size_t i = 0; i < count; i++) {
        const Key keys[] = {
            {"place", KEY_VECTOR, .needed = true, AT(scene.lights[i].place)},
            {"color", KEY_VECTOR, .needed = true, AT(scene.lights[i].color)},
            {.name = NULL},
        };
        if (!read_object(reading, "lights", json_array_get(list, i), keys))
            return false;
    }
    return true;
}

static bool read_spot(Reading *reading, const json_t *value)
{
    static const Key keys[] = {
        {"at", KEY_VECTOR, .needed = true, AT(scene.at)},
        {"cutoff", KEY_NUMBER, .needed = true, AT(scene.cutoff), .min = 1, .max = 90},
        {"exponent", KEY_NUMBER, .needed = true, AT(scene.exponent), .min = 0, .max = 128},
        {"attenuation", KEY_VECTOR, .needed = true, AT(scene.attenuation)},
        {.name = NULL},
    };
    return read_object(reading, "spot", value, keys);
}

static bool read_scene(Reading *reading, const json_t *value)
{
    static const char *const shapes[] = {
        "cube", "cube on corner", "icosahedron", "dodecahedron", "octahedron", "quad",
        "tube", "ball",           "coarse ball", "torus",        "sphere",     NULL};
    static const Key keys[] = {
        {"shape", KEY_CHOICE, .needed = true, AT(scene.shape), .choices = shapes},
        {"scale", KEY_NUMBER, AT(scene.scale), .min = 0.01, .max = 100},
        {"eye", KEY_VECTOR, .needed = true, AT(scene.eye)},
        {"center", KEY_VECTOR, AT(scene.center)},
        {"lights", KEY_READ, .needed = true, .read = read_lights},
        {"spot", KEY_READ, .read = read_spot},
        {"color", KEY_VECTOR, .needed = true, AT(scene.color)},
        {"shininess", KEY_NUMBER, AT(scene.shininess), .min = 0, .max = 1000},
        {.name = NULL},
    };
    return read_object(reading, "scene", value, keys);
}

static bool read_highlight(Reading *reading, const json_t *value)
{
    static const char *const names[] = {"Blinn-Phong", "Phong", NULL};
    const Key key = {"highlight", AT(reflection), .choices = names};
    reading->folder->lab.specular = true;
    return read_choice(reading, &key, value);
}

static bool read_special(Reading *reading, const json_t *value)
{
    Lab *lab = &reading->folder->lab;
    const char *text = json_string_value(value);
    lab->given = text && strcmp(text, "matrices") == 0;
    lab->budget = text && strcmp(text, "budget") == 0;
    lab->shadow = text && strcmp(text, "shadow map") == 0;
    return lab->given || lab->budget || lab->shadow ||
           fail(reading, "special", "must be \"matrices\", \"budget\" or \"shadow map\"");
}

static bool read_attributes(Reading *reading, const json_t *value)
{
    static const Key keys[] = {
        {"position", KEY_TEXT, AT(attributes.position)},
        {"normal", KEY_TEXT, AT(attributes.normal)},
        {"color", KEY_TEXT, AT(attributes.color)},
        {.name = NULL},
    };
    return read_object(reading, "attributes", value, keys);
}

/* A uniform with the value of another: "u_MvpMatrix", or {"is": "u_LightPosition", "light": 0}. */
static bool read_other_name(const Reading *reading, LabUniform *uniform, const json_t *value)
{
    const json_t *light = json_object_get(value, "light");
    uniform->is = json_string_value(json_is_string(value) ? value : json_object_get(value, "is"));
    uniform->light = light ? (int)json_integer_value(light) : -1;
    return (!light ||
            (json_is_integer(light) && uniform->light >= 0 && uniform->light < LAB_MAX_LIGHTS)) ||
           fail(reading, uniform->name, "\"light\" must be 0 or 1");
}

/* Its own: {"value": 0.2, "min": 0.1, "max": 0.4}, or lists of two to four numbers. */
static bool read_uniform(const Reading *reading, LabUniform *uniform, const json_t *value)
{
    const json_t *own = json_object_get(value, "value");
    uniform->size = json_is_array(own) ? (int)json_array_size(own) : 1;
    if (json_is_string(value) || json_object_get(value, "is"))
        return read_other_name(reading, uniform, value);
    const size_t size = (size_t)uniform->size;
    if (size < 1 || size > 4 || !read_numbers(own, size, uniform->value) ||
        !read_numbers(json_object_get(value, "min"), size, uniform->min) ||
        !read_numbers(json_object_get(value, "max"), size, uniform->max))
        return fail(reading, uniform->name,
                    "must be a name like \"u_MvpMatrix\", or have \"value\", \"min\" and \"max\": "
                    "each a number, or two to four");
    for (int i = 0; i < uniform->size; i++)
        if (uniform->min[i] > uniform->max[i])
            return fail(reading, uniform->name, "\"min\" must not exceed \"max\"");
    return true;
}

static bool read_uniforms(Reading *reading, const json_t *object)
{
    Lab *lab = &reading->folder->lab;
    const char *name;
    json_t *value;
    if (!json_is_object(object) || json_object_size(object) > LAB_MAX_UNIFORMS)
        return fail(reading, "uniforms", "must be an object of at most 40 uniforms, by name");
    snprintf(reading->where, sizeof reading->where, "\"uniforms\": ");
    json_object_foreach((json_t *)object, name, value)
    {
        LabUniform *uniform = &reading->folder->uniforms[lab->uniform_count++];
        *uniform = (LabUniform){.name = name, .light = -1};
        if (!read_uniform(reading, uniform, value))
            return false;
    }
    reading->where[0] = '\0';
    return true;
}

static bool read_parts(Reading *reading, const json_t *value)
{
    LabPoints *points = &reading->folder->lab.points;
    const size_t count = json_object_size(value);
    const char *name;
    json_t *number;
    if (count < 1 || count > LAB_MAX_PARTS)
        return fail(reading, "parts", "must be an object of one to 12 parts, each with its points");
    json_object_foreach((json_t *)value, name, number)
    {
        const double part = json_number_value(number);
        if (!json_is_number(number) || !(part >= 0 && part <= 1000))
            return fail(reading, name, "must be a number from 0 to 1000");
        points->parts[points->part_count].name = name;
        points->parts[points->part_count++].points = part;
    }
    return true;
}

bool lab_time_read(const char *text, long long *seconds)
{
    struct tm at = {.tm_isdst = -1};
    const char *end = strptime(text, "%Y-%m-%d %H:%M", &at);
    *seconds = (long long)mktime(&at);
    return end && end[strspn(end, " \r")] == '\0';
}

static bool read_due(Reading *reading, const json_t *value)
{
    return (json_is_string(value) &&
            lab_time_read(json_string_value(value), &reading->folder->lab.points.due)) ||
           fail(reading, "due", "must be a time like \"2026-11-20 23:59\"");
}

static bool read_percent(Reading *reading, const json_t *value)
{
    LabPoints *points = &reading->folder->lab.points;
    const bool list = json_is_array(value);
    const size_t count = list ? json_array_size(value) : LAB_MAX_DAYS;
    bool right = count > 0 && count <= LAB_MAX_DAYS;
    for (size_t i = 0; i < count && right; i++) {
        const json_t *number = list ? json_array_get(value, i) : value;
        const double percent = json_number_value(number);
        right = json_is_number(number) && percent >= 0 && percent <= 100;
        points->percent[points->day_count++] =
            list ? percent : fmin(percent * (double)(i + 1), 100);
    }
    return right || fail(reading, "percent",
                         "must be a number from 0 to 100, for each day, or a list of at most 31");
}

static bool read_late(Reading *reading, const json_t *value)
{
    static const Key keys[] = {
        {"due", KEY_READ, .read = read_due},
        {"percent", KEY_READ, .needed = true, .read = read_percent},
        {.name = NULL},
    };
    return read_object(reading, "late", value, keys);
}

static bool read_points(Reading *reading, const json_t *value)
{
    static const Key keys[] = {
        {"most", KEY_NUMBER, .needed = true, AT(points.most), .min = 1, .max = 1000},
        {"drawn", KEY_NUMBER, .needed = true, AT(points.drawn), .min = 0, .max = 1000},
        {"scenes", KEY_NUMBER, AT(points.scenes), .min = 0, .max = 1000},
        {"parts", KEY_READ, .read = read_parts},
        {"step", KEY_NUMBER, AT(points.step), .min = 0.01, .max = 1000},
        {"late", KEY_READ, .read = read_late},
        {.name = NULL},
    };
    LabPoints *points = &reading->folder->lab.points;
    *points = (LabPoints){.step = 0.5};
    if (!read_object(reading, "points", value, keys))
        return false;
    double sum = points->drawn + points->scenes;
    for (int i = 0; i < points->part_count; i++)
        sum += points->parts[i].points;
    return (points->part_count || json_object_get(value, "scenes") ||
            fail(reading, "points", "\"scenes\" is missing, or \"parts\"")) &&
           (sum <= points->most ||
            fail(reading, "points",
                 "\"drawn\", \"scenes\" and \"parts\" together must not exceed \"most\""));
}

static bool read_solution(Reading *reading, const char *name)
{
    LabFolder *folder = reading->folder;
    char path[2 * PATH_MAX];
    Message why = {.text = ""};
    snprintf(path, sizeof path, "%s/%s", folder->path, name);
    if (!submission_files_open(&folder->solutions[folder->lab.solution_count], &folder->lab, path,
                               &why))
        return message_set(reading->message, "%s: %.500s", path, why.text);
    folder->lab.solution_count++;
    return true;
}

/* Read at the end, because other keys say what its files are called. */
static bool leave(Reading *reading, const json_t *value)
{
    (void)reading, (void)value;
    return true;
}

static bool read_lab(Reading *reading, const json_t *object)
{
    static const char *const lights[] = {"directional", "point", "spot", NULL};
    static const Key keys[] = {
        {"number", KEY_NUMBER, AT(number), .min = 0, .max = 99},
        {"summary", KEY_TEXT, .needed = true, AT(summary)},
        {"special", KEY_READ, .read = read_special},
        {"code", KEY_TEXT, AT(code)},
        {"light", KEY_CHOICE, .needed = true, AT(light), .choices = lights},
        {"ambient", KEY_FLAG, AT(ambient)},
        {"highlight", KEY_READ, .read = read_highlight},
        {"fitted", KEY_FLAG, AT(fitted)},
        {"flat", KEY_FLAG, AT(flat)},
        {"rigid", KEY_FLAG, AT(rigid)},
        {"either", KEY_FLAG, AT(either)},
        {"two_sided", KEY_FLAG, AT(two_sided)},
        {"tolerance", KEY_NUMBER, AT(tolerance), .min = 0.6, .max = 50},
        {"scene", KEY_READ, .needed = true, .read = read_scene},
        {"attributes", KEY_READ, .read = read_attributes},
        {"uniforms", KEY_READ, .read = read_uniforms},
        {"points", KEY_READ, .read = read_points},
        {"shaders", KEY_TEXT, AT(file)},
        {"solutions", KEY_READ, .read = leave},
        {.name = NULL},
    };
    return read_object(reading, "", object, keys);
}

/* What keys need of each other. */
static bool check_lab(const Reading *reading)
{
    const Lab *lab = &reading->folder->lab;
    Lab plain = *lab;
    plain.uniform_count = 0;
    if (lab->light == LIGHT_SPOT && lab->scene.cutoff == 0)
        return fail(reading, "spot", "is missing in \"scene\": \"light\" is \"spot\"");
    if (lab->light == LIGHT_SPOT && lab->lights > 1)
        return fail(reading, "lights", "must be one: \"light\" is \"spot\"");
    if (lab->specular && lab->scene.shininess == 0)
        return fail(reading, "shininess", "is missing in \"scene\": there is a \"highlight\"");
    if (strspn(lab->file, "abcdefghijklmnopqrstuvwxyz0123456789_-") != strlen(lab->file) ||
        strlen(lab->file) > LAB_NAME_SIZE - 8)
        return fail(reading, "shaders", "must be a file's name without .vert: a-z, 0-9, _ and -");
    if ((lab->given || lab->budget) && !lab->code)
        return fail(reading, "code", "is missing: the name of the C file");
    for (int i = 0; i < lab->uniform_count; i++) {
        const char *is = lab->uniforms[i].is;
        char what[128];
        snprintf(what, sizeof what, "\"%.40s\" is none of this lab's values", is ? is : "");
        if (is && !binding_has(&plain, is))
            return fail(reading, lab->uniforms[i].name, what);
    }
    return true;
}

/* A part is of the light, or a variable of the first solution. */
static bool check_parts(const Reading *reading)
{
    const Lab *lab = &reading->folder->lab;
    for (int i = 0; i < lab->points.part_count; i++) {
        const char *part = lab->points.parts[i].name;
        bool known = lab_has_light(lab, part);
        for (int k = 0; lab->solution_count && k < lab->solutions->count; k++)
            known |= part[0] && text_count_word(lab->solutions->texts[k].text, part) > 0;
        if (!known)
            return fail(reading, part,
                        "no part: must be \"diffuse\", \"ambient\", \"highlight\", "
                        "\"light 1\" or \"light 2\", as far as the lab has it, or "
                        "a variable of the solution");
    }
    return true;
}

/* One in the folder "solution" needs no key. */
static bool add_solutions(Reading *reading)
{
    const json_t *list = json_object_get(reading->folder->json, "solutions");
    const size_t count = json_array_size(list);
    char path[2 * PATH_MAX];
    struct stat status;
    snprintf(path, sizeof path, "%s/solution", reading->folder->path);
    if (!list)
        return stat(path, &status) != 0 || read_solution(reading, "solution");
    if (count < 1 || count > LAB_MAX_SOLUTIONS)
        return fail(reading, "solutions", "must be a list of one to four folders");
    for (size_t i = 0; i < count; i++) {
        const char *name = json_string_value(json_array_get(list, i));
        if (!name || strchr(name, '/') || name[0] == '.')
            return fail(reading, "solutions", "must name folders in the lab's own");
        if (!read_solution(reading, name))
            return false;
    }
    return true;
}

bool lab_json_read(LabFolder *folder, Message *message)
{
    Reading reading = {.folder = folder, .message = message};
    return read_lab(&reading, folder->json) && check_lab(&reading) && add_solutions(&reading) &&
           check_parts(&reading);
}
