#include "labs/web/verdict_text.h"

#include "study/results/json.h"

#include <math.h>
#include <stdlib.h>

static void put_text(FILE *file, const char *name, const char *text)
{
    fprintf(file, "\"%s\": ", name);
    json_put_string(file, text);
    fputs(", ", file);
}

/* JSON has neither infinities nor NaN. */
static void put_number(FILE *file, const char *name, double number)
{
    if (isfinite(number))
        fprintf(file, "\"%s\": %.9g, ", name, number);
    else
        fprintf(file, "\"%s\": null, ", name);
}

static void put_mistakes(FILE *file, const Verdict *verdict)
{
    fputs("\"mistakes\": [", file);
    for (int i = 0; i < verdict->mistake_count; i++) {
        const VerdictMistake *mistake = &verdict->mistakes[i];
        fputs(i ? ", {" : "{", file);
        put_text(file, "name", mistake->name);
        put_text(file, "sentence", mistake->sentence);
        put_text(file, "look", mistake->look);
        fprintf(file, "\"sure\": %.9g}", mistake->sure);
    }
    fputs("], ", file);
}

static void put_probes(FILE *file, const Verdict *verdict)
{
    fputs("\"probes\": [", file);
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        fputs(i ? ", {" : "{", file);
        put_text(file, "name", probe->name);
        put_text(file, "set", probe->known ? "known" : "seed");
        put_number(file, "seconds", probe->seconds);
        put_number(file, "maximum", probe->maximum);
        put_number(file, "rms", probe->rms);
        fprintf(file, "\"width\": %d, \"height\": %d, \"passed\": %s}", probe->width, probe->height,
                probe->passed ? "true" : "false");
    }
    fputs("], ", file);
}

static void put_printed(FILE *file, const Verdict *verdict, const Lab *lab)
{
    char *text = NULL;
    size_t size;
    FILE *printed = open_memstream(&text, &size);
    if (printed) {
        verdict_print(verdict, lab, NULL, printed);
        fclose(printed);
    }
    fputs("\"text\": ", file);
    json_put_string(file, text ? text : "");
    free(text);
}

void verdict_put(FILE *file, const Verdict *verdict, const Lab *lab)
{
    fputc('{', file);
    put_text(file, "lab", lab->name);
    put_text(file, "verdict", VERDICT_NAMES[verdict->kind]);
    put_text(file, "message", verdict->message);
    put_text(file, "details", verdict->details);
    put_number(file, "points", verdict->points);
    put_number(file, "seed", (double)verdict->seed);
    fprintf(file, "\"one_of\": %s, \"symptoms\": [", verdict->one_of ? "true" : "false");
    for (int i = 0; i < verdict->symptom_count; i++) {
        fputs(i ? ", " : "", file);
        json_put_string(file, verdict->symptoms[i]);
    }
    fputs("], ", file);
    put_mistakes(file, verdict);
    put_probes(file, verdict);
    put_printed(file, verdict, lab);
    fputc('}', file);
}
