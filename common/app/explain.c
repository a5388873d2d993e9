#include "app/explain.h"

#include "scene/reality.h"
#include "scene/shader_cost.h"

#include <stdlib.h>
#include <string.h>

/* The objects written so far; `text` is what effects_explain says of one. */
typedef struct Explained {
    struct {
        char *text;
        int view, object;
    } * all;
    int count;
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
static void print_operations(const Lighting *lighting, const Scene *scene, const Object *object)
{
    static const char *const names[] = {"operations", "in the full program"};
    Message message = {0};
    for (int full = 0; full < 2 && !message.text[0]; full++) {
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

static bool explain_view(Stage *stage, const Options *options, int number, Explained *explained,
                         Message *message)
{
    StageView view;
    bool done = stage_view_open(&view, stage, options, options->seconds, number, message);
    for (int i = 0; i < view.scene.object_count && done; i++) {
        int place = i;
        const Scene *scene = stage_view_part(&view, &place);
        const Object *object = &scene->objects[place];
        const bool written = write_effects(stage, number, &view, i, explained, stdout);
        done = lighting_program(stage->lighting, scene, object, options->full, message) != 0;
        if (done && written)
            print_operations(stage->lighting, scene, object);
        printf("\n");
    }
    if (done && number == 0 && view.scene.object_count > 0) {
        printf("# what the model leaves out\n");
        done = reality_explain(&view.scene, stdout, message);
        printf("\n");
    }
    stage_view_close(&view);
    return done;
}

bool explain_programs(Stage *stage, const Options *options, Message *message)
{
    if (!stage->example->scene)
        return message_set(message, "--explain: this program's shaders are written by hand");
    Explained explained = {0};
    bool done = true;
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
