#include "app/explain.h"

#include "base/text.h"
#include "scene/reality.h"
#include "scene/shader_cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The objects written so far; `text` is what effects_explain says of one. */
typedef struct Explained {
    struct {
        char *text;
        int view, object;
    } * all;
    int count;
    /* Not printed yet: objects that are as number `same`, the first and the last by view and
     * object.
     */
    int same, same_count, same_from[2], same_to[2];
} Explained;

static void explained_close(Explained *explained)
{
    for (int i = 0; i < explained->count; i++)
        free(explained->all[i].text);
    free(explained->all);
    *explained = (Explained){0};
}

/* Writes an object's effects, or which earlier object has the same; false then. */
static bool write_effects(const Stage *stage, int number, const StageView *view, int object,
                          Explained *explained, FILE *file)
{
    char *text = NULL;
    size_t size = 0;
    int place = object;
    const Scene *scene = stage_view_part(view, &place);
    FILE *memory = open_memstream(&text, &size);
    void *larger = realloc(explained->all, (size_t)(explained->count + 1) * sizeof *explained->all);
    if (larger)
        explained->all = larger;
    if (memory) {
        effects_explain(scene, &scene->objects[place], memory);
        fclose(memory);
    }
    fprintf(file, "# %s, view %d, object %d\n", stage->example->name, number, object);
    for (int i = 0; text && i < explained->count; i++) {
        if (strcmp(explained->all[i].text, text) == 0) {
            fprintf(file, "as view %d, object %d\n", explained->all[i].view,
                    explained->all[i].object);
            free(text);
            return false;
        }
    }
    fputs(text ? text : "", file);
    if (!text || !larger) {
        free(text);
        return true;
    }
    explained->all[explained->count].text = text;
    explained->all[explained->count].view = number;
    explained->all[explained->count++].object = object;
    return true;
}

void explain_effects(Stage *stage, const Options *options, FILE *file)
{
    Explained explained = {0};
    for (int number = 0; number < stage_view_count(stage); number++) {
        StageView view;
        if (stage_view_open(&view, stage, options, options->seconds, number, NULL))
            for (int i = 0; i < view.scene.object_count; i++)
                write_effects(stage, number, &view, i, &explained, file);
        stage_view_close(&view);
    }
    explained_close(&explained);
}

/* The operations of an object's program and of the full one, or why they are not known. */
static void print_operations(const Lighting *lighting, const Scene *scene, const Object *object,
                             bool with_full)
{
    static const char *const names[] = {"operations", "in the full program"};
    Message message = {0};
    for (int full = 0; full <= with_full && !message.text[0]; full++) {
        ShaderSource sources[2];
        ShaderCost vertex, fragment;
        if (lighting_sources(lighting, scene, object, full, sources, &message) &&
            shader_cost(sources[SHADER_VERTEX].text, SHADER_VERTEX, &vertex, &message) &&
            shader_cost(sources[SHADER_FRAGMENT].text, SHADER_FRAGMENT, &fragment, &message))
            printf("%s: %d per vertex (%d special), %d per fragment (%d special)\n", names[full],
                   vertex.arithmetic + vertex.special, vertex.special,
                   fragment.arithmetic + fragment.special, fragment.special);
        shader_source_close(&sources[SHADER_VERTEX]);
        shader_source_close(&sources[SHADER_FRAGMENT]);
    }
    if (message.text[0])
        printf("%s\n", message.text);
}

/* --explain without --verbose: the first object in full, of the others what differs. */

/* "without X: not requested" as X; the next one after a comma. */
static bool fold_request(const char *text, bool another, FILE *file)
{
    static const char without[] = "without ", why[] = ": not requested\n";
    const char *name = text + strlen(without), *end = strchr(text, ':');
    if (strncmp(text, without, strlen(without)) != 0 || !end || strncmp(end, why, strlen(why)) != 0)
        return false;
    fprintf(file, "%s%.*s", another ? ", " : "not requested: ", (int)(end - name), name);
    return true;
}

/* An object's effects, in which lights that follow each other and have the same are one, and so are
 * effects that are not requested. */
static void fold_lines(const char *text, FILE *file)
{
    bool folded = false;
    while (*text) {
        const char *next = text + strcspn(text, "\n") + 1, *body = strchr(text, ':');
        int first, last, number;
        const bool request = fold_request(text, folded, file);
        if (folded && !request)
            fputc('\n', file);
        folded = request;
        if (request) {
            text = next;
            continue;
        }
        if (sscanf(text, "light %d:", &first) != 1 || !body) {
            fprintf(file, "%.*s", (int)(next - text), text);
            text = next;
            continue;
        }
        while (strncmp(next, "  ", 2) == 0)
            next += strcspn(next, "\n") + 1;
        const size_t size = (size_t)(next - body);
        for (last = first; sscanf(next, "light %d:", &number) == 1 && number == last + 1; last++) {
            const char *other = strchr(next, ':');
            const bool ends = other && strnlen(other, size) == size &&
                              memcmp(other, body, size) == 0 && strncmp(other + size, "  ", 2) != 0;
            if (!ends)
                break;
            next = other + size;
        }
        if (first == last)
            fprintf(file, "light %d", first);
        else
            fprintf(file, "lights %d to %d", first, last);
        fprintf(file, "%.*s", (int)size, body);
        text = next;
    }
    if (folded)
        fputc('\n', file);
}

/* Whether a text has a line; an indented one below the same light. */
static bool has_line(const char *text, const char *light, const char *line, size_t length)
{
    const char *own_light = "";
    for (; *text; text += strcspn(text, "\n") + 1) {
        if (*text != ' ')
            own_light = text;
        if (strncmp(text, line, length) == 0 && text[length] == '\n' &&
            (*line != ' ' || strncmp(own_light, light, strcspn(light, ":") + 1) == 0))
            return true;
    }
    return false;
}

/* How many lines of a text another has not; writes them, if there is a file. */
static int write_difference(const char *text, const char *other, FILE *file)
{
    const char *light = "", *said = "";
    int count = 0;
    for (; *text; text += strcspn(text, "\n") + 1) {
        const size_t length = strcspn(text, "\n"), blanks = strspn(text, " ");
        if (!blanks)
            light = text;
        if (has_line(other, light, text, length))
            continue;
        if (file && blanks && said != light)
            fprintf(file, "%s%.*s", count ? "; " : "", (int)strcspn(light, ":"), light);
        if (file)
            fprintf(file, "%s%.*s",
                    blanks && said != light ? " "
                    : count                 ? "; "
                                            : "",
                    (int)(length - blanks), text + blanks);
        said = light;
        count++;
    }
    return count;
}

/* Objects that follow each other and are as the same earlier one. */
static void print_same(Explained *explained)
{
    const int *from = explained->same_from, *to = explained->same_to;
    if (explained->same_count > 1)
        printf("view %d, object %d to view %d, object %d", from[0], from[1], to[0], to[1]);
    else if (explained->same_count == 1)
        printf("view %d, object %d", from[0], from[1]);
    if (explained->same_count)
        printf(": as view %d, object %d\n", explained->all[explained->same].view,
               explained->all[explained->same].object);
    explained->same_count = 0;
}

static void add_same(Explained *explained, int nearest, int view, int object)
{
    if (explained->same != nearest)
        print_same(explained);
    if (!explained->same_count++) {
        explained->same_from[0] = view;
        explained->same_from[1] = object;
    }
    explained->same = nearest;
    explained->same_to[0] = view;
    explained->same_to[1] = object;
}

static bool explain_object(const Stage *stage, const Scene *scene, const Object *object, int view,
                           int number, Explained *explained, Message *message)
{
    char *whole = NULL, *text = NULL, *line = NULL;
    size_t size = 0;
    int nearest = -1, least = 0;
    FILE *file = open_memstream(&whole, &size);
    void *larger = realloc(explained->all, (size_t)(explained->count + 1) * sizeof *explained->all);
    if (larger)
        explained->all = larger;
    if (file)
        effects_explain(scene, object, file);
    bool done = file && fclose(file) == 0 && larger;
    if (done && (file = open_memstream(&text, &size)) != NULL) {
        fold_lines(whole, file);
        done = fclose(file) == 0;
    }
    free(whole);
    if (!done || !text) {
        free(text);
        return message_set(message, "--explain: not enough memory");
    }
    for (int i = 0; i < explained->count; i++) {
        const int apart = write_difference(text, explained->all[i].text, NULL);
        if (nearest < 0 || apart < least) {
            nearest = i;
            least = apart;
        }
    }
    if (nearest >= 0 && least == 0) {
        add_same(explained, nearest, view, number);
        free(text);
        return true;
    }
    print_same(explained);
    if (nearest < 0) {
        printf("# %s, view %d, object %d\n%s", stage->example->name, view, number, text);
    } else if ((file = open_memstream(&line, &size)) != NULL) {
        fprintf(file, "view %d, object %d: as view %d, object %d, but ", view, number,
                explained->all[nearest].view, explained->all[nearest].object);
        write_difference(text, explained->all[nearest].text, file);
        fclose(file);
        text_wrap(stdout, line, 0, 2, 100);
        printf("\n");
        free(line);
    }
    explained->all[explained->count].text = text;
    explained->all[explained->count].view = view;
    explained->all[explained->count++].object = number;
    print_operations(stage->lighting, scene, object, nearest < 0);
    if (nearest < 0)
        printf("\n");
    return true;
}

/* A depth d is kept as far (d - near) / (d (far - near)), whose derivative says how far apart in
 * depth neighbouring values are. */
static void print_depth(const Canvas *canvas, const Camera *camera)
{
    const double near = camera->near, far = camera->far;
    const double step = (far - near) / (far * near) / exp2(canvas->depth_bits);
    printf("# depth: %d bits from %.4g to %.4g, in steps of %.2g in front and %.2g at the back\n",
           canvas->depth_bits, near, far, near * near * step, far * far * step);
}

static bool explain_view(Stage *stage, const Options *options, int number, Explained *explained,
                         Message *message)
{
    StageView view;
    lighting_use_shadows(stage->lighting, &options->shadows);
    bool done = stage_view_open(&view, stage, options, options->seconds, number, message) &&
                lighting_find_maps(stage->lighting, &view.scene, options->full, message);
    for (int i = 0; i < view.scene.object_count && done; i++) {
        int place = i;
        const Scene *scene = stage_view_part(&view, &place);
        const Object *object = &scene->objects[place];
        done = lighting_program(stage->lighting, scene, object, options->full, message) != 0;
        if (!options->verbose) {
            done = done && explain_object(stage, scene, object, number, i, explained, message);
            continue;
        }
        if (write_effects(stage, number, &view, i, explained, stdout) && done)
            print_operations(stage->lighting, scene, object, true);
        printf("\n");
    }
    if (!options->verbose)
        print_same(explained);
    if (done && number == 0 && view.scene.object_count > 0) {
        printf("%s# what the model leaves out\n", explained->count > 1 ? "\n" : "");
        done = reality_explain(&view.scene, stdout, message);
        printf("\n");
        print_depth(stage->canvas, &view.scene.camera);
        done = done && lighting_explain_shadows(stage->lighting, &view.scene, stdout, message);
    }
    stage_view_close(&view);
    return done;
}

/* The lights of all views: each as in the first view that shows most of it. */
typedef struct Lights {
    Light lights[EFFECTS_MAX_LIGHTS];
    int views[EFFECTS_MAX_LIGHTS], shown[EFFECTS_MAX_LIGHTS];
} Lights;

static void add_lights(const Scene *scene, int view, Lights *all)
{
    for (int i = 0; i < scene->light_count && i < EFFECTS_MAX_LIGHTS; i++) {
        const Light *light = &scene->lights[i];
        const int shown = 1 + 4 * !light->off + 2 * !color_is_black(light->diffuse) +
                          !color_is_black(light->specular);
        if (shown <= all->shown[i])
            continue;
        all->lights[i] = *light;
        all->views[i] = view;
        all->shown[i] = shown;
    }
}

static void print_vector(const char *before, Vec3 vector)
{
    printf("%s%.4g,%.4g,%.4g", before, vector.x, vector.y, vector.z);
}

static void print_light(const Light *light)
{
    static const char *const kinds[] = {"directional, from ", "point, at ", "spot, at "};
    const bool directional = light->kind == LIGHT_DIRECTIONAL;
    print_vector(kinds[light->kind], directional ? light->direction : light->position);
    printf("%s", light->space == LIGHT_EYE ? " of the viewer" : "");
    print_vector("; colour ", light->diffuse);
    if (memcmp(&light->diffuse, &light->specular, sizeof light->diffuse) != 0)
        print_vector(", specular ", light->specular);
    printf("%s\n", light->off ? "; off" : "");
}

/* As --light-at and --light-color take them. */
static void print_lights(Stage *stage, const Options *options)
{
    Lights all = {.shown = {0}};
    const int count = stage_view_count(stage);
    for (int number = 0; number < count; number++) {
        StageView view;
        if (stage_view_open(&view, stage, options, options->seconds, number, NULL))
            add_lights(&view.asked, number, &all);
        stage_view_close(&view);
    }
    printf("# lights, by their numbers in --light-at, --light-color and --terms\n");
    for (int i = 0; i < EFFECTS_MAX_LIGHTS; i++) {
        if (!all.shown[i])
            continue;
        printf("%d: ", i);
        if (count > 1)
            printf("view %d, ", all.views[i]);
        print_light(&all.lights[i]);
    }
}

bool explain_programs(Stage *stage, const Options *options, Message *message)
{
    if (!stage->example->scene)
        return message_set(message, "--explain: this program's shaders are written by hand");
    Explained explained = {0};
    bool done = true;
    print_lights(stage, options);
    for (int number = 0; number < stage_view_count(stage) && done; number++)
        done = explain_view(stage, options, number, &explained, message);
    explained_close(&explained);
    if (!done)
        return false;
    const LightingCounts counts = lighting_counts(stage->lighting);
    printf("# programs: %d, compiled and linked in %.1f ms\n", counts.programs,
           1e3 * counts.compile_seconds);
    return true;
}
