/* A verdict's points and its text for a terminal. */
#include "labs/submission/verdict.h"

#include "base/text.h"

#include <math.h>
#include <stdarg.h>

const char *const VERDICT_NAMES[] = {"error", "right", "wrong", "refused", "timeout", NULL};
const char *const PART_NAMES[] = {"not judged", "right", "wrong", "late", NULL};

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

VerdictMistake *verdict_add_mistake(Verdict *verdict, const char *name, const char *sentence,
                                    const char *look, double sure)
{
    if (verdict->mistake_count == VERDICT_MAX_MISTAKES)
        return NULL;
    VerdictMistake *mistake = &verdict->mistakes[verdict->mistake_count++];
    *mistake = (VerdictMistake){.sure = sure};
    enum { LONGEST = 90 };
    char whole[VERDICT_SENTENCE_SIZE];
    snprintf(whole, sizeof whole, "%s", name);
    text_shorten(whole, LONGEST);
    snprintf(mistake->name, sizeof mistake->name, "%.*s", LONGEST, whole);
    snprintf(mistake->sentence, sizeof mistake->sentence, "%s", sentence);
    snprintf(mistake->look, sizeof mistake->look, "%s", look);
    return mistake;
}

void verdict_begin(Verdict *verdict, const Lab *lab, uint64_t seed)
{
    *verdict = (Verdict){.seed = seed, .most = lab->points.most};
    for (int i = 0; i < lab->points.part_count; i++) {
        VerdictPart *part = &verdict->parts[verdict->part_count++];
        snprintf(part->name, sizeof part->name, "%s", lab->points.parts[i].name);
        part->most = lab->points.parts[i].points;
    }
}

void verdict_refuse(Verdict *verdict, const Lab *lab, uint64_t seed, const Message *why)
{
    verdict_begin(verdict, lab, seed);
    verdict->kind = VERDICT_REFUSED;
    snprintf(verdict->message, sizeof verdict->message, "%.500s", why->text);
}

static int passed(const Verdict *verdict)
{
    int count = 0;
    for (int i = 0; i < verdict->probe_count; i++)
        count += verdict->probes[i].passed;
    return count;
}

static double in_steps(const LabPoints *points, double sum)
{
    return floor(sum / points->step + 1e-9) * points->step;
}

void verdict_score(Verdict *verdict, const Lab *lab)
{
    const LabPoints *points = &lab->points;
    double sum = points->scenes * passed(verdict) / fmax(verdict->probe_count, 1);
    for (int i = 0; i < verdict->part_count; i++) {
        VerdictPart *part = &verdict->parts[i];
        part->state = verdict->kind == VERDICT_RIGHT ? PART_RIGHT : part->state;
        part->points = part->state == PART_RIGHT ? part->most : 0;
        sum += part->points;
    }
    const bool draws = verdict->kind == VERDICT_WRONG && verdict->probe_count > 0;
    verdict->points = verdict->kind == VERDICT_RIGHT ? points->most
                      : !draws                       ? 0
                      : verdict->undefined           ? points->drawn
                                                     : points->drawn + in_steps(points, sum);
}

void verdict_late(Verdict *verdict, const Lab *lab, int days)
{
    const LabPoints *points = &lab->points;
    if (days < 1 || points->day_count == 0)
        return;
    const int day = days < points->day_count ? days : points->day_count;
    const double left = verdict->points - points->most * points->percent[day - 1] / 100;
    VerdictPart *part = &verdict->parts[verdict->part_count++];
    *part = (VerdictPart){.points = in_steps(points, fmax(left, 0)) - verdict->points,
                          .most = verdict->points,
                          .state = PART_LATE};
    snprintf(part->name, sizeof part->name, "day %d after the deadline", days);
    verdict->points += part->points;
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

void verdict_parts(const Verdict *verdict, const char *before, const char *after, FILE *file)
{
    for (int i = 0; i < verdict->part_count; i++) {
        const VerdictPart *part = &verdict->parts[i];
        const char *state = part->state == PART_LATE ? "" : PART_NAMES[part->state];
        fprintf(file, "%s%s: %s%s%g of %g points%s", before, part->name, state,
                state[0] ? ", " : "", part->points, part->most, after);
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
            verdict->most, verdict->message);
    if (verdict->details[0])
        fprintf(file, "%s\n", verdict->details);
    print_mistakes(verdict, file);
    for (int i = 0; i < verdict->symptom_count; i++)
        fprintf(file, "  - %s\n", verdict->symptoms[i]);
    verdict_parts(verdict, "  ", "\n", file);
    print_probes(verdict, file);
    if (verdict->cost.known)
        fprintf(file, "cost: error %.2f steps, %.2f of the time of the chapter's own program\n",
                verdict->cost.error, verdict->cost.time_ratio);
    if (verdict->cost.known)
        fprintf(file, "operations per picture: %.0f, %.3f of those of the chapter's own program\n",
                verdict->cost.operations, verdict->cost.operations_ratio);
    if (verdict->picture[0] && pictures)
        fprintf(file, "%s/%s: submission, right, difference\n", pictures, verdict->picture);
    fprintf(file, "seed %llu; %.2f s\n", (unsigned long long)verdict->seed, verdict->seconds);
}
