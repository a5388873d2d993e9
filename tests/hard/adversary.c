/*
 * adversary: searches for scenes that are drawn wrongly, until stopped:
 * adversary [--seed N] [--seconds S] [--least LEVELS] [--size PIXELS] [--tame] [--mediump]
 *
 * Each scene with an error of more than LEVELS steps of 1/255 is shrunk and printed as C.
 */
#include "base/clock.h"
#include "hard/search.h"

#include <stdlib.h>
#include <string.h>

typedef struct Choice {
    const char *name;
    double value;
} Choice;

static bool read_choices(int count, char *arguments[], Choice choices[], int choice_count)
{
    for (int i = 1; i < count; i++) {
        int k = 0;
        while (k < choice_count && strcmp(arguments[i], choices[k].name) != 0)
            k++;
        if (k == choice_count)
            return false;
        const bool flag = k >= 4;
        char *end = NULL;
        if (!flag && ++i >= count)
            return false;
        choices[k].value = flag ? 1 : strtod(arguments[i], &end);
        if (!flag && (end == arguments[i] || *end))
            return false;
    }
    return true;
}

static void report(Search *search, int number)
{
    char name[32];
    RandomScene worst = search->current;
    const double error = search->error;
    search_shrink(search, &worst, 0.75 * error);
    snprintf(name, sizeof name, "FOUND_%d", number);
    printf("\n/* %.4g levels; as found %.4g */\n", search_error(search, &worst, 0), error);
    random_scene_print(&worst, name, stdout);
    fflush(stdout);
}

int main(int count, char *arguments[])
{
    Choice choices[] = {{"--seed", 1},  {"--seconds", 60}, {"--least", 0.25},
                        {"--size", 32}, {"--tame", 0},     {"--mediump", 0}};
    const int choice_count = sizeof choices / sizeof choices[0];
    if (!read_choices(count, arguments, choices, choice_count)) {
        fprintf(stderr, "usage: adversary [--seed N] [--seconds S] [--least LEVELS] "
                        "[--size PIXELS] [--tame] [--mediump]\n");
        return 2;
    }
    Search search;
    double worst = 0, sum = 0;
    int found = 0;
    const double start = clock_now();
    search_open(&search, (int)choices[3].value, (unsigned long long)choices[0].value);
    search.tame = choices[4].value != 0;
    search.precision = choices[5].value != 0 ? HARD_MEDIUMP : HARD_HIGHP;
    while (clock_now() - start < choices[1].value) {
        if (!search_step(&search))
            continue;
        worst = search.error > worst ? search.error : worst;
        sum += search.error;
        if (search.error >= choices[2].value)
            report(&search, found++);
        search.error = -1;
    }
    printf("\n/* seed %.0f: %lld steps, %lld scenes drawn, %lld climbs, %d found, worst %.4g, mean "
           "%.4g */\n",
           choices[0].value, search.steps, search.judged, search.climbs, found, worst,
           sum / (double)(search.climbs > 0 ? search.climbs : 1));
    search_close(&search);
    return 0;
}
