/* --explain. Effects are lists of lines; objects that have the same, or nearly, are told by what
 * differs from the nearest one before, so that a scene of many objects stays a screenful. */
#include "kinds/scene_views.h"

#include "base/memory.h"
#include "base/output_text.h"
#include "base/text.h"
#include "scene/shader_cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is said of an object, and which it is. */
typedef struct ExplainedObject {
    char *text;
    int view, object;
} ExplainedObject;

/* The objects written so far. */
typedef struct Explained {
    ExplainedObject *all;
    int count;
    bool receipts; /* below the effects, their lines */
    /* Not printed yet: objects as number `same`, the first and last by view and object. */
    int same, same_count, same_from[2], same_to[2];
} Explained;

static void explained_close(Explained *explained)
{
    for (int i = 0; i < explained->count; i++)
        free(explained->all[i].text);
    free(explained->all);
    *explained = (Explained){0};
}

/* Takes the text over. */
static void explained_add(Explained *explained, ExplainedObject object)
{
    explained->all = memory_grow(explained->all, (size_t)explained->count + 1, sizeof object);
    explained->all[explained->count++] = object;
}

/* What a plan says of an object. */
static char *effects_text(const LightingPlan *plan, int object)
{
    OutputText text;
    output_text_open(&text);
    lighting_plan_explain(plan, object, text.file);
    return output_text_close(&text);
}

/* Ends a heading. Writes an object's effects, or which earlier one has the same; returns that. */
static const ExplainedObject *write_effects(const LightingPlan *plan, int number, int object,
                                            Explained *explained, FILE *file)
{
    char *text = effects_text(plan, object);
    fputc('\n', file);
    for (int i = 0; i < explained->count; i++) {
        const ExplainedObject *earlier = &explained->all[i];
        if (strcmp(earlier->text, text) == 0) {
            fprintf(file, "as view %d, object %d\n", earlier->view, earlier->object);
            free(text);
            return earlier;
        }
    }
    if (explained->receipts)
        receipt_write(plan, object, text, file);
    else
        fputs(text, file);
    explained_add(explained, (ExplainedObject){text, number, object});
    return &explained->all[explained->count - 1];
}

static int by_effects(const void *a, const void *b)
{
    const PanelObject *one = a, *other = b;
    const int order = strcmp(one->same, other->same);
    return order ? order : one->number - other->number;
}

/* What is drawn of a view. */
static bool plan_view(LightingPlan *plan, Renderer *renderer, const DrawRequest *request,
                      const SceneView *view, Message *message)
{
    Lighting *lighting = scene_state(renderer)->lighting;
    const LightingFrame frame = {
        .scene = &view->scene, .parts = view->made.parts, .aspect = 1, .full = request->full};
    lighting_use_shadows(lighting, &request->shadows);
    return lighting_plan(plan, lighting, &frame, message);
}

void explain_effects(Renderer *renderer, const DrawRequest *request, FILE *file,
                     PanelObjects *objects)
{
    Explained explained = {0};
    for (int number = 0; number < scene_view_count(renderer); number++) {
        SceneView view;
        LightingPlan plan = {.lighting = NULL};
        int place[4];
        if (scene_view_open(&view, renderer, request, request->seconds, number, NULL) &&
            scene_view_place(renderer, number, place) &&
            plan_view(&plan, renderer, request, &view, NULL))
            for (int i = 0; i < view.scene.object_count; i++) {
                const char *known = view.scene.objects[i].name, *name = known ? known : "";
                fprintf(file, "# %s, view %d, object %d%s%s", renderer->example->name, number, i,
                        name[0] ? ", " : "", name);
                const ExplainedObject *as = write_effects(&plan, number, i, &explained, file);
                handles_ring(&view.scene.camera, place, plan.objects[i].place.sphere,
                             explain_list(&plan, i, name, as->text, objects)->ring);
            }
        lighting_plan_close(&plan);
        scene_view_close(&view);
    }
    if (objects->count)
        qsort(objects->all, (size_t)objects->count, sizeof *objects->all, by_effects);
    explained_close(&explained);
}

/* The operations of an object's program and of the full one, or why they are not known. */
static void print_operations(const LightingPlan *plan, int object, bool with_full)
{
    static const char *const names[] = {"operations", "in the full program"};
    Message message = {0};
    for (int full = 0; full <= with_full && !message.text[0]; full++) {
        ShaderSource sources[2];
        ShaderCost vertex, fragment;
        if (lighting_plan_sources(plan, object, full, sources, &message) &&
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
        if (!text_numbers(text, "light #:", &first) || !body) {
            fprintf(file, "%.*s", (int)(next - text), text);
            text = next;
            continue;
        }
        while (strncmp(next, "  ", 2) == 0)
            next += strcspn(next, "\n") + 1;
        const size_t size = (size_t)(next - body);
        for (last = first; text_numbers(next, "light #:", &number) && number == last + 1; last++) {
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

/* Whose text differs in the fewest lines, and in how many; -1: there are none. */
static int find_nearest(const Explained *explained, const char *text, int *apart)
{
    int nearest = -1;
    for (int i = 0; i < explained->count; i++) {
        const int lines = write_difference(text, explained->all[i].text, NULL);
        if (nearest < 0 || lines < *apart) {
            nearest = i;
            *apart = lines;
        }
    }
    return nearest;
}

/* What an object has that an earlier one has not. */
static void print_difference(const ExplainedObject *object, const ExplainedObject *earlier)
{
    OutputText line;
    output_text_open(&line);
    fprintf(line.file, "view %d, object %d: as view %d, object %d, but ", object->view,
            object->object, earlier->view, earlier->object);
    write_difference(object->text, earlier->text, line.file);
    output_text_wrap(&line, stdout, 2, 100);
    printf("\n");
}

/* `object` is without its text. */
static void explain_object(const Renderer *renderer, const LightingPlan *plan,
                           ExplainedObject object, Explained *explained)
{
    int apart = 0;
    /* An object's effects with lines folded. */
    OutputText text;
    char *whole = effects_text(plan, object.object);
    output_text_open(&text);
    fold_lines(whole, text.file);
    free(whole);
    object.text = output_text_close(&text);
    const int nearest = find_nearest(explained, object.text, &apart);
    if (nearest >= 0 && apart == 0) {
        add_same(explained, nearest, object.view, object.object);
        free(object.text);
        return;
    }
    print_same(explained);
    if (nearest < 0)
        printf("# %s, view %d, object %d\n%s", renderer->example->name, object.view, object.object,
               object.text);
    else
        print_difference(&object, &explained->all[nearest]);
    explained_add(explained, object);
    print_operations(plan, object.object, nearest < 0);
    if (nearest < 0)
        printf("\n");
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

/* An entry of a matrix: rounding, relative to its largest entry, is 0. */
static double entry(const Mat4 *matrix, int row, int column)
{
    double largest = 0;
    for (int k = 0; k < 12; k++)
        largest = fmax(largest, fabs(matrix->m[k]));
    const double value = matrix->m[4 * column + row];
    return fabs(value) > 1e-12 * largest ? value : 0;
}

/* Of an object: how it is placed, and what keeps its normals perpendicular. */
static void print_matrices(const Object *object)
{
    static const char *const compared[] = {[ORTHONORMAL] = "M is orthogonal: N = M",
                                           [ORTHOGONAL] = "M scales evenly: N is a multiple of M",
                                           [EXTREME] = "M scales evenly: N is a multiple of M",
                                           [GENERAL] = "M scales unevenly or shears: N is not M"};
    Mat4 m = object->world_from_object, inverse;
    for (int k = 0; k < 3; k++)
        m.m[12 + k] = 0;
    const bool regular = mat4_inverse(m, &inverse);
    const Mat4 n = regular ? mat4_transpose(inverse) : mat4_normal(m);
    printf("# matrices of view 0, object 0: M to the world, less its translation; N for normals, "
           "%s\n",
           regular ? "M^-T" : "M's cofactors");
    for (int row = 0; row < 3; row++)
        printf("%s %9.4g %9.4g %9.4g    %s %9.4g %9.4g %9.4g\n",
               row ? "   " : "M =", entry(&m, row, 0), entry(&m, row, 1), entry(&m, row, 2),
               row ? "   " : "N =", entry(&n, row, 0), entry(&n, row, 1), entry(&n, row, 2));
    printf("%s%s\n\n", compared[effects_transform(object->world_from_object)],
           object->wrong_normals ? "; the scene has M for normals, too" : "");
}

static void explain_objects(const Renderer *renderer, const LightingPlan *plan, bool verbose,
                            int number, Explained *explained)
{
    bool *told = !verbose && plan->object_count > EXPLAIN_FEW ? explain_groups(plan) : NULL;
    for (int i = 0; i < plan->object_count; i++) {
        if (told && !told[i])
            continue;
        const ExplainedObject said = {.view = number, .object = i};
        if (!verbose) {
            explain_object(renderer, plan, said, explained);
            continue;
        }
        printf("# %s, view %d, object %d", renderer->example->name, number, i);
        const ExplainedObject *as = write_effects(plan, number, i, explained, stdout);
        if (as->view == number && as->object == i)
            print_operations(plan, i, true);
        printf("\n");
    }
    if (!verbose)
        print_same(explained);
    free(told);
}

static bool explain_view(Renderer *renderer, const DrawRequest *request, int number,
                         Explained *explained, Message *message)
{
    SceneView view;
    LightingPlan plan = {.lighting = NULL};
    bool done = scene_view_open(&view, renderer, request, request->seconds, number, message) &&
                plan_view(&plan, renderer, request, &view, message);
    if (done) {
        scene_explain_choice(renderer, request, &view, number, stdout);
        explain_objects(renderer, &plan, request->verbose, number, explained);
        explain_reach(&plan);
    }
    if (done && number == 0 && view.scene.object_count > 0) {
        fputs(explained->count > 1 ? "\n" : "", stdout);
        print_matrices(&view.scene.objects[0]);
        printf("# what the model leaves out\n");
        done = unmodelled_explain(&view.scene, stdout, message);
        if (example_scene(renderer->example)->explain)
            example_scene(renderer->example)->explain(stdout);
        printf("\n");
        print_depth(renderer->canvas, &view.scene.camera);
        lighting_plan_explain_shadows(&plan, &view.scene, stdout);
    }
    lighting_plan_close(&plan);
    scene_view_close(&view);
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

/* As --light-at and --light-color take them; of many the first, which --terms takes. */
static void print_lights(Renderer *renderer, const DrawRequest *request)
{
    Lights all = {.shown = {0}};
    int more = 0;
    const int count = scene_view_count(renderer);
    for (int number = 0; number < count; number++) {
        SceneView view;
        if (scene_view_open(&view, renderer, request, request->seconds, number, NULL))
            add_lights(&view.asked, number, &all);
        more = view.asked.light_count > more ? view.asked.light_count : more;
        scene_view_close(&view);
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
    if (more > EFFECTS_MAX_LIGHTS)
        printf("%d to %d: more, all of them number %d of --terms\n", EFFECTS_MAX_LIGHTS, more - 1,
               EFFECTS_MAX_LIGHTS - 1);
}

bool explain_programs(Renderer *renderer, const DrawRequest *request, Message *message)
{
    Explained explained = {.receipts = request->verbose};
    bool done = true;
    print_lights(renderer, request);
    for (int number = 0; number < scene_view_count(renderer) && done; number++)
        done = explain_view(renderer, request, number, &explained, message);
    explained_close(&explained);
    if (!done)
        return false;
    const LightingCounts counts = lighting_counts(scene_state(renderer)->lighting);
    printf("# programs: %d, compiled and linked in %.1f ms\n", counts.programs,
           1e3 * counts.compile_seconds);
    return true;
}
