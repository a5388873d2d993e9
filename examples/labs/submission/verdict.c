/* A verdict's points and its text for a terminal. */
#include "labs/submission/verdict.h"

#include <math.h>
#include <stdarg.h>

const char *const VERDICT_NAMES[] = {"error", "right", "wrong", "refused", "timeout", NULL};

void verdict_add_symptom(Verdict *verdict, const char *format, ...)
{
    va_list arguments;
    if (verdict->symptom_count == VERDICT_MAX_SYMPTOMS)
        return;
    va_start(arguments, format);
    vsnprintf(verdict->symptoms[verdict->symptom_count++], VERDICT_SENTENCE_SIZE, format,
              arguments);
    va_end(arguments);
}

void verdict_add_mistake(Verdict *verdict, const char *name, const char *sentence, const char *look,
                         double sure)
{
    if (verdict->mistake_count == VERDICT_MAX_MISTAKES)
        return;
    VerdictMistake *mistake = &verdict->mistakes[verdict->mistake_count++];
    snprintf(mistake->name, sizeof mistake->name, "%s", name);
    snprintf(mistake->sentence, sizeof mistake->sentence, "%s", sentence);
    snprintf(mistake->look, sizeof mistake->look, "%s", look);
    mistake->sure = sure;
}

void verdict_refuse(Verdict *verdict, uint64_t seed, const Message *why)
{
    *verdict = (Verdict){.kind = VERDICT_REFUSED, .seed = seed};
    snprintf(verdict->message, sizeof verdict->message, "%.500s", why->text);
}

static int passed(const Verdict *verdict)
{
    int count = 0;
    for (int i = 0; i < verdict->probe_count; i++)
        count += verdict->probes[i].passed;
    return count;
}

void verdict_score(Verdict *verdict, const Lab *lab)
{
    const LabPoints usual = {VERDICT_MAX_POINTS, 1, 8};
    const LabPoints *points = lab->points.most > 0 ? &lab->points : &usual;
    verdict->points = 0;
    verdict->most = points->most;
    if (verdict->kind == VERDICT_RIGHT)
        verdict->points = points->most;
    else if (verdict->kind == VERDICT_WRONG && verdict->probe_count > 0)
        verdict->points =
            points->drawn +
            (verdict->undefined
                 ? 0
                 : floor(2.0 * points->scenes * passed(verdict) / verdict->probe_count) / 2);
}

/* Text. */

static void print_mistakes(const Verdict *verdict, FILE *file)
{
    for (int i = 0; i < verdict->mistake_count; i++) {
        const VerdictMistake *mistake = &verdict->mistakes[i];
        /* The message has a single name already. */
        if (verdict->mistake_count > 1)
            fprintf(file, "  %s (%.0f%% sure)\n", mistake->name, 100 * mistake->sure);
        else
            fprintf(file, "  %.0f%% sure\n", 100 * mistake->sure);
        fprintf(file, "  %s\n  Look at %s.\n", mistake->sentence, mistake->look);
    }
}

static void print_probes(const Verdict *verdict, FILE *file)
{
    for (int i = 0; i < verdict->probe_count; i++) {
        const VerdictProbe *probe = &verdict->probes[i];
        fprintf(file, "  scene %s (%s) %3dx%-3d at %6.3f s: largest error %6.2f steps, %s\n",
                probe->name, probe->known ? "known" : "seed", probe->width, probe->height,
                probe->seconds, probe->maximum, probe->passed ? "right" : "wrong");
    }
}

void verdict_print(const Verdict *verdict, const Lab *lab, const char *pictures, FILE *file)
{
    const int color = verdict->kind == VERDICT_RIGHT ? MESSAGE_GREEN
                      : verdict->kind == VERDICT_WRONG || verdict->kind == VERDICT_ERROR
                          ? MESSAGE_RED
                          : MESSAGE_YELLOW;
    const int terminal = fileno(file); /* -1: a file in memory */
    fprintf(file, "%s: %s%s%s, %g of %g points\n%s\n", lab->name, message_color(color, terminal),
            VERDICT_NAMES[verdict->kind], message_color(MESSAGE_PLAIN, terminal), verdict->points,
            verdict_most(verdict), verdict->message);
    if (verdict->details[0])
        fprintf(file, "%s\n", verdict->details);
    print_mistakes(verdict, file);
    for (int i = 0; i < verdict->symptom_count; i++)
        fprintf(file, "  - %s\n", verdict->symptoms[i]);
    print_probes(verdict, file);
    if (verdict->cost.known)
        fprintf(file, "cost: error %.2f steps, %.2f of the time of the chapter's own program\n",
                verdict->cost.error, verdict->cost.time_ratio);
    if (verdict->cost.known && verdict->cost.operations >= 0)
        fprintf(file, "operations per picture: %ld, %.3f of those of the chapter's own program\n",
                verdict->cost.operations, verdict->cost.operations_ratio);
    if (verdict->picture[0] && pictures)
        fprintf(file, "%s/%s: submission, right, difference\n", pictures, verdict->picture);
    fprintf(file, "seed %llu; %.2f s\n", (unsigned long long)verdict->seed, verdict->seconds);
}
