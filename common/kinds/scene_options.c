/* Options of scenes: terms and lights by number, how shadows are drawn, the error that is allowed.
 */
#include "kinds/scene_views.h"

#include "base/parse.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>

/* --terms */

const char *const SCENE_TERM_NAMES[4] = {"ambient", "diffuse", "specular", "emission"};

static bool unknown_term(const char *text, const char *word, Message *message)
{
    const char *names[5] = {NULL};
    for (int k = 0; k < 4; k++)
        names[k] = SCENE_TERM_NAMES[k];
    const char *nearest = text_nearest(word, names);
    message_set(message, "--terms %s: ", text);
    return nearest
               ? message_add(message, "%s: did you mean %s?", word, nearest)
               : message_add(message, "must be some of ambient, diffuse, specular and emission, "
                                      "and numbers of lights, 0 to 31, between commas");
}

/* The terms by name and the lights by number; all terms, or lights, if none is named. */
static bool read_terms(const Parameter *parameter, const char *text, Message *message)
{
    SceneTerms *terms = parameter->value;
    unsigned named = 0;
    uint32_t lights = 0;
    const char *word = text;
    for (size_t length = 1; length > 0; word += length + (word[length] == ',')) {
        char copy[16];
        int k = 0, light;
        length = strcspn(word, ",");
        snprintf(copy, sizeof copy, "%.*s", (int)length, word);
        while (k < 4 && strcmp(copy, SCENE_TERM_NAMES[k]) != 0)
            k++;
        const bool whole = length < sizeof copy;
        if (whole && k < 4)
            named |= 1U << k;
        else if (whole && parse_whole(copy, 0, 31, &light))
            lights |= (uint32_t)1 << light;
        else
            return unknown_term(text, whole && length ? copy : "", message);
        if (!word[length])
            break;
    }
    terms->left_out = named ? TERM_ALL & ~named : 0;
    terms->lights_left_out = lights ? ~lights : 0;
    return true;
}

static bool write_terms(const Parameter *parameter, char *text, size_t size)
{
    const SceneTerms *terms = parameter->value;
    size_t length = 0;
    for (int k = 0; k < 4 && length < size; k++)
        if (!(terms->left_out >> k & 1))
            length += (size_t)snprintf(text + length, size - length, "%s%s", length ? "," : "",
                                       SCENE_TERM_NAMES[k]);
    for (int k = 0; k < 32 && terms->lights_left_out && length < size; k++)
        if (!(terms->lights_left_out >> k & 1))
            length += (size_t)snprintf(text + length, size - length, ",%d", k);
    return length < size;
}

static const ParameterCodec TERMS = {"TERM,...", read_terms, write_terms};

/* Values of lights: LIGHT,NUMBER,NUMBER,NUMBER, or with three more numbers, between slashes. */

typedef struct LightValue {
    int light, count;
    double numbers[6];
} LightValue;

/* Reads the value before the next slash. */
static bool read_light(const char *text, double min, double max, LightValue *value)
{
    char copy[256], *place = NULL;
    const int length = (int)strcspn(text, "/");
    if (snprintf(copy, sizeof copy, "%.*s", length, text) >= (int)sizeof copy || copy[0] == ',' ||
        strstr(copy, ",,") || (length > 0 && copy[length - 1] == ','))
        return false;
    const char *word = strtok_r(copy, ",", &place);
    value->count = 0;
    if (!word || !parse_whole(word, 0, SCENE_MAX_PLACED - 1, &value->light))
        return false;
    while ((word = strtok_r(NULL, ",", &place)) && value->count < 6)
        if (!parse_number(word, min, max, &value->numbers[value->count++]))
            return false;
    return !word && (value->count == 3 || value->count == 6);
}

static const char *after_slash(const char *text)
{
    const char *slash = strchr(text, '/');
    return slash ? slash + 1 : NULL;
}

/* Appends one, with a slash before it unless it is the first. */
static bool put_light(char *text, size_t size, const LightValue *value)
{
    const size_t length = strlen(text);
    const int put =
        snprintf(text + length, size - length, "%s%d,", length ? "/" : "", value->light);
    return (size_t)put < size - length &&
           option_put_numbers(text, size, value->numbers, value->count);
}

static void put_vector(LightValue *value, Vec3 vector)
{
    double *numbers = &value->numbers[value->count];
    numbers[0] = vector.x;
    numbers[1] = vector.y;
    numbers[2] = vector.z;
    value->count += 3;
}

static Vec3 vector_of(const double *numbers)
{
    return (Vec3){numbers[0], numbers[1], numbers[2]};
}

static bool read_places(const Parameter *parameter, const char *text, Message *message)
{
    LightPlaces places = {.placed = 0};
    for (const char *word = text; word; word = after_slash(word)) {
        LightValue value;
        if (!read_light(word, -1e6, 1e6, &value) || value.count != 3)
            return message_set(message,
                               "--light-at %s: must be LIGHT,X,Y,Z, with LIGHT from 0 to %d and "
                               "coordinates from -1000000 to 1000000, as in 0,1,2,-3.5; a / begins "
                               "another light",
                               text, SCENE_MAX_PLACED - 1);
        places.placed |= 1U << value.light;
        places.at[value.light] = vector_of(value.numbers);
    }
    *(LightPlaces *)parameter->value = places;
    return true;
}

static bool write_places(const Parameter *parameter, char *text, size_t size)
{
    const LightPlaces *places = parameter->value;
    bool fits = true;
    text[0] = '\0';
    for (int i = 0; i < SCENE_MAX_PLACED; i++) {
        LightValue value = {.light = i};
        put_vector(&value, places->at[i]);
        fits = fits && (!(places->placed >> i & 1) || put_light(text, size, &value));
    }
    return places->placed && fits;
}

static const ParameterCodec PLACES = {"LIGHT,X,Y,Z", read_places, write_places};

static bool read_tints(const Parameter *parameter, const char *text, Message *message)
{
    LightTints tints = {.tinted = 0};
    for (const char *word = text; word; word = after_slash(word)) {
        LightValue value;
        if (!read_light(word, 0, 10, &value))
            return message_set(message,
                               "--light-color %s: must be LIGHT,R,G,B, with LIGHT from 0 to %d "
                               "and R, G and B from 0 to 10, as in 0,1,0.5,0; three more numbers "
                               "are the specular colour, and a / begins another light",
                               text, SCENE_MAX_PLACED - 1);
        tints.tinted |= 1U << value.light;
        tints.diffuse[value.light] = vector_of(value.numbers);
        tints.specular[value.light] = vector_of(value.numbers + value.count - 3);
    }
    *(LightTints *)parameter->value = tints;
    return true;
}

static bool write_tints(const Parameter *parameter, char *text, size_t size)
{
    const LightTints *tints = parameter->value;
    bool fits = true;
    text[0] = '\0';
    for (int i = 0; i < SCENE_MAX_PLACED; i++) {
        LightValue value = {.light = i};
        put_vector(&value, tints->diffuse[i]);
        if (memcmp(&tints->diffuse[i], &tints->specular[i], sizeof(Vec3)) != 0)
            put_vector(&value, tints->specular[i]);
        fits = fits && (!(tints->tinted >> i & 1) || put_light(text, size, &value));
    }
    return tints->tinted && fits;
}

static const ParameterCodec TINTS = {"LIGHT,R,G,B[,R,G,B]", read_tints, write_tints};

/* Shadows: a way, and the size of maps. */

static bool read_shadows(const Parameter *parameter, const char *text, Message *message)
{
    ShadowSettings *settings = parameter->value;
    Parameter way = *parameter;
    way.codec = NULL;
    if (strncmp(text, "map:", 4) != 0)
        return parameter_read(&way, text, message);
    settings->way = SHADOWS_MAP;
    return parse_whole(text + 4, SHADOW_MAP_MIN, SHADOW_MAP_MAX, &settings->map_size) ||
           message_set(message, "--shadows %s: a map has %d to %d texels each way, as in map:512",
                       text, SHADOW_MAP_MIN, SHADOW_MAP_MAX);
}

static bool write_shadows(const Parameter *parameter, char *text, size_t size)
{
    const ShadowSettings *settings = parameter->value;
    if (settings->way == SHADOWS_MAP && settings->map_size != SHADOWS_DEFAULT.map_size)
        return snprintf(text, size, "map:%d", settings->map_size) < (int)size;
    return snprintf(text, size, "%s", SHADOW_NAMES[settings->way]) < (int)size;
}

static const ParameterCodec SHADOWS = {NULL, read_shadows, write_shadows};

static bool read_bias(const Parameter *parameter, const char *text, Message *message)
{
    enum { MAX = 1000 };
    static const double min[] = {0, 0, 0}, max[] = {MAX, MAX, MAX};
    double values[3];
    if (parse_numbers(text, 3, min, max, values) != 3)
        return message_set(message,
                           "--shadow-bias %s: must be CONSTANT,SLOPE,NORMAL in texels of a map, "
                           "each 0 to %d",
                           text, MAX);
    *(Vec3 *)parameter->value = vector_of(values);
    return true;
}

static bool write_bias(const Parameter *parameter, char *text, size_t size)
{
    const Vec3 *bias = parameter->value;
    text[0] = '\0';
    return option_put_numbers(text, size, (const double[]){bias->x, bias->y, bias->z}, 3);
}

static const ParameterCodec BIAS = {"CONSTANT,SLOPE,NORMAL", read_bias, write_bias};

static const char *const CLAMPS[] = {"vertex", "end", NULL};
static const char *const CLAMP_DOTS[] = {"off", "on", NULL};
static const char *const LIGHTING[] = {"off", "on", NULL};

const Parameter SCENE_OPTIONS[] = {
    {"explain",
     "report the scene's lights and their numbers, required and omitted effects with reasons, and "
     "what they cost; draw nothing. Of several objects only what differs; with --verbose "
     "everything, and the shaders' lines that each effect brings in",
     PARAMETER_FLAG, AT(explain), .programs = PROGRAM_ONE | ASIDE},
    {"save-scene", "write the scene as a file of glTF 2.0, which Scene reads; draw nothing",
     PARAMETER_TEXT, .placeholder = "FILE", .min = 1, .standard = "", AT(save_scene),
     .programs = PROGRAM_ONE | ASIDE},
    {"full", "draw with the program that has every effect", PARAMETER_FLAG, AT(full),
     .programs = PROGRAM_ONE},
    {"error",
     "draw as cheaply as an error of E steps of 1/255 allows; explicit options win. The error "
     "is against the exact picture of the shapes (solids) or of the mesh as given (models), the "
     "largest over the pixels inside an object: wholly inside one surface, covered by what is "
     "drawn, and reached by the same lights; edges, also those of shadows, do not count: of these --explain and --verbose say how many "
     "pixels are off by more, and by how much",
     PARAMETER_NUMBER, .max = 255, .placeholder = "E", .standard = "", AT(error), GIVEN_AT(cheap),
     .programs = PROGRAM_ONE},
    {"clamp", "where colours are clamped: at each vertex, as in OpenGL 1.1, or at the end",
     PARAMETER_SWITCH, .choices = CLAMPS, AT(clamp_vertex), .programs = PROGRAM_ONE},
    {"clamp-dots",
     "off: N.L may be negative, so that a light takes light away from what faces away from it; "
     "highlights, and lights with shadows, stay clamped",
     PARAMETER_SWITCH, .choices = CLAMP_DOTS, AT(signed_dots), .programs = PROGRAM_ONE},
    {"linear-light", "compute in linear light; encode as sRGB at the end", PARAMETER_FLAG,
     AT(linear), .programs = PROGRAM_ONE},
    {"terms",
     "draw only these terms of the sum: ambient, diffuse, specular, emission; and only these "
     "lights, which --explain lists, as in diffuse,specular,0",
     PARAMETER_TEXT, .standard = "all", .codec = &TERMS, AT(terms), .programs = PROGRAM_ONE},
    {"light-at",
     "put a light there: a position, or the direction towards a directional light; --explain "
     "lists the lights; more of them after slashes, as in 0,1,2,0/1,-1,2,0",
     PARAMETER_TEXT, .standard = "", .codec = &PLACES, AT(places), .programs = PROGRAM_ONE},
    {"light-color",
     "another colour of a light, diffuse and specular; or a colour for each; --explain lists the "
     "lights; more of them after slashes, as in 0,1,0.5,0/1,0,0,1,1,1,1",
     PARAMETER_TEXT, .standard = "", .codec = &TINTS, AT(tints), .programs = PROGRAM_ONE},
    {"shadows",
     "cast shadows, and how: volumes are exact, to the pixel; map, or map:N, is a shadow map of "
     "NxN (1024); on: volumes",
     PARAMETER_CHOICE, .choices = SHADOW_NAMES, .codec = &SHADOWS, AT(shadows),
     .programs = PROGRAM_ONE},
    {"shadow-bias",
     "against acne in shadow maps, in texels: how far a place is moved towards the light; that "
     "times the slope; and along the normal",
     PARAMETER_TEXT, .codec = &BIAS, AT(shadows.bias), .programs = PROGRAM_ONE},
    {"shadow-filter", "compare a shadow map's nearest texel, or the four around, weighted",
     PARAMETER_CHOICE, .choices = SHADOW_FILTER_NAMES, AT(shadows.smooth), .programs = PROGRAM_ONE},
    {"lighting", "off: each surface in its own diffuse colour", PARAMETER_SWITCH,
     .choices = LIGHTING, AT(terms.unlit), .programs = PROGRAM_ONE},
    {"normals",
     "draw the normals as lines: of the vertices; with --interpolation flat of triangles",
     PARAMETER_SWITCH, AT(normals), .programs = PROGRAM_ONE},
    {"show-clipped", "paint over-exposed pixels magenta", PARAMETER_FLAG, AT(show_clipped),
     .programs = PROGRAM_ONE},
    {.name = NULL},
};
