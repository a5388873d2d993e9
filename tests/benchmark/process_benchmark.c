/*
 * The time of a picture as a process of its own relative to the minimum for such a process, and of
 * the gallery's pictures; their limits hold on an idle machine with two cores.
 *
 * process_benchmark PROGRAM GALLERY FLOOR
 */
#include "benchmark/measure.h"

#include <fcntl.h>
#include <ftw.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { ROUNDS = 41, SCENES = 9 };
static const double MAX_GALLERY_OF_ONE = 1.5, MAX_FURTHER_MS = 6;

/* Runs a command and waits for it. */
static bool run_command(void *argument)
{
    char **command = argument;
    pid_t child;
    int status;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const bool started = posix_spawn(&child, command[0], &actions, NULL, command, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    return started && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status, (void)type, (void)walk;
    return remove(path);
}

int main(int argc, char *argv[])
{
    measure_begin(&argc, argv);
    if (argc != 4) {
        fprintf(stderr, "usage: process_benchmark PROGRAM GALLERY FLOOR\n");
        return 2;
    }
    char folder[] = "/tmp/lighting-benchmark-XXXXXX", picture[64], one[64], all[64];
    if (!mkdtemp(folder)) {
        perror(folder);
        return 1;
    }
    snprintf(picture, sizeof picture, "%s/x.png", folder);
    snprintf(one, sizeof one, "%s/one", folder);
    snprintf(all, sizeof all, "%s/all", folder);
    char *draw[] = {argv[1], "-o", picture, NULL};
    char *draw_null[] = {argv[1], "--compress", "0", "-o", "/dev/null", NULL};
    char *smallest[] = {argv[1], "--compress", "9", "-o", picture, NULL};
    char *floor_command[] = {argv[3], NULL};
    char *slash = strrchr(argv[1], '/');
    char *gallery_one[] = {argv[2], "-o", one, slash ? slash + 1 : argv[1], NULL};
    char *gallery_all[] = {argv[2],
                           "-o",
                           all,
                           "LightedCube",
                           "LightedCube_animation",
                           "LightedCube_ambient",
                           "LightedTranslatedRotatedCube",
                           "PointLightedCube",
                           "PointLightedCube_animation",
                           "PointLightedCube_perFragment",
                           "PointLightedSphere",
                           "PointLightedSphere_perFragment",
                           NULL};
    enum { DRAW, DRAW_NULL, SMALLEST, FLOOR, FLOOR_AGAIN, ONE, ALL, COUNT };
    Measured measured[COUNT] = {
        [DRAW] = {"picture, -o x.png", run_command, draw, NULL},
        [DRAW_NULL] = {"picture, -o /dev/null --compress 0", run_command, draw_null, NULL},
        [SMALLEST] = {"picture, --compress 9", run_command, smallest, NULL},
        [FLOOR] = {"floor: open, clear, read back", run_command, floor_command, NULL},
        [FLOOR_AGAIN] = {"floor again (the noise)", run_command, floor_command, NULL},
        [ONE] = {"gallery of one", run_command, gallery_one, NULL},
        [ALL] = {"gallery of nine", run_command, gallery_all, NULL},
    };
    const bool measured_all = measure_rounds(measured, COUNT, ROUNDS);
    if (measured_all) {
        Table table;
        measure_print_machine(NULL, NULL);
        table_open(&table, "one process, 400x400|ms|over the floor");
        for (int i = 0; i < COUNT; i++) {
            const Summary time = measure_summary(measured[i].seconds, ROUNDS);
            const Summary ratio = measure_ratio(&measured[i], &measured[FLOOR], 1, ROUNDS);
            table_row(&table, "%s|%s|%s", measured[i].name, measure_cell(time, 1e3, 1).text,
                      measure_cell(ratio, 1, 2).text);
        }
        double further[ROUNDS];
        for (int i = 0; i < ROUNDS; i++)
            further[i] = 1e3 * (measured[ALL].seconds[i] - measured[ONE].seconds[i]) / (SCENES - 1);
        const Summary ratio = measure_ratio(&measured[ONE], &measured[DRAW], 1, ROUNDS);
        const Summary each = measure_summary(further, ROUNDS);
        table_row(&table, "gallery of one over the picture, at most %.1f||%s", MAX_GALLERY_OF_ONE,
                  measure_cell(ratio, 1, 2).text);
        table_row(&table, "each further picture, sheet and page included, at most %.1f ms|%s|",
                  MAX_FURTHER_MS, measure_cell(each, 1, 1).text);
        measure_print_table(NULL, &table);
    }
    measure_finish(measured, COUNT);
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    return measured_all ? 0 : 1;
}
