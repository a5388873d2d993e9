/*
 * The time of a picture as a process of its own relative to the minimum for such a process, and of
 * the gallery's pictures; their limits hold on an idle machine with two cores.
 *
 * The gallery draws with 4 samples unless told otherwise. With them llvmpipe compiles the average
 * of a pixel's samples once in each process, some 40 ms that Mesa 22.3 does not cache, and draws
 * four times the samples: a gallery is compared with pictures of as many samples, and each further
 * one has a limit of its own.
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
static const double MAX_GALLERY_OF_ONE = 1.5, MAX_FURTHER_MS = 6, MAX_FURTHER_SMOOTH_MS = 10;

enum {
    DRAW,
    DRAW_SMOOTH,
    DRAW_NULL,
    SMALLEST,
    FLOOR,
    FLOOR_AGAIN,
    ONE,
    ONE_SMOOTH,
    ALL,
    ALL_SMOOTH,
    COUNT
};

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

/* A gallery beside the picture alone, both with as many samples. */
static void add_gallery(Table *table, const Measured *measured, const char *samples, int draw,
                        int one, int all, double max_further)
{
    double further[ROUNDS];
    for (int i = 0; i < ROUNDS; i++)
        further[i] = 1e3 * (measured[all].seconds[i] - measured[one].seconds[i]) / (SCENES - 1);
    const Summary ratio = measure_ratio(&measured[one], &measured[draw], 1, ROUNDS);
    const Summary each = measure_summary(further, ROUNDS);
    table_row(table, "gallery of one over the picture, %s, at most %.1f||%s", samples,
              MAX_GALLERY_OF_ONE, measure_cell(ratio, 1, 2).text);
    table_row(table, "each further picture, %s, sheet and page included, at most %.1f ms|%s|",
              samples, max_further, measure_cell(each, 1, 1).text);
}

static void print_results(const Measured measured[COUNT])
{
    Table table;
    measure_print_machine(NULL, NULL);
    table_open(&table, "one process, 400x400|ms|over the floor");
    for (int i = 0; i < COUNT; i++) {
        const Summary time = measure_summary(measured[i].seconds, ROUNDS);
        const Summary ratio = measure_ratio(&measured[i], &measured[FLOOR], 1, ROUNDS);
        table_row(&table, "%s|%s|%s", measured[i].name, measure_cell(time, 1e3, 1).text,
                  measure_cell(ratio, 1, 2).text);
    }
    add_gallery(&table, measured, "--samples 0", DRAW, ONE, ALL, MAX_FURTHER_MS);
    add_gallery(&table, measured, "--samples 4", DRAW_SMOOTH, ONE_SMOOTH, ALL_SMOOTH,
                MAX_FURTHER_SMOOTH_MS);
    measure_print_table(NULL, &table);
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
    char *draw_smooth[] = {argv[1], "--samples", "4", "-o", picture, NULL};
    char *name = slash ? slash + 1 : argv[1];
    char *gallery_one[] = {argv[2], "-o", one, "--samples", "0", name, NULL};
    char *gallery_one_smooth[] = {argv[2], "-o", one, "--samples", "4", name, NULL};
    char *gallery_all[] = {argv[2],
                           "-o",
                           all,
                           "--samples",
                           "0",
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
    char *gallery_all_smooth[sizeof gallery_all / sizeof gallery_all[0]];
    memcpy(gallery_all_smooth, gallery_all, sizeof gallery_all);
    gallery_all_smooth[4] = "4";
    Measured measured[COUNT] = {
        [DRAW] = {"picture, -o x.png", run_command, draw, NULL},
        [DRAW_SMOOTH] = {"picture, --samples 4", run_command, draw_smooth, NULL},
        [DRAW_NULL] = {"picture, -o /dev/null --compress 0", run_command, draw_null, NULL},
        [SMALLEST] = {"picture, --compress 9", run_command, smallest, NULL},
        [FLOOR] = {"floor: open, clear, read back", run_command, floor_command, NULL},
        [FLOOR_AGAIN] = {"floor again (the noise)", run_command, floor_command, NULL},
        [ONE] = {"gallery of one, --samples 0", run_command, gallery_one, NULL},
        [ONE_SMOOTH] = {"gallery of one, --samples 4", run_command, gallery_one_smooth, NULL},
        [ALL] = {"gallery of nine, --samples 0", run_command, gallery_all, NULL},
        [ALL_SMOOTH] = {"gallery of nine, --samples 4", run_command, gallery_all_smooth, NULL},
    };
    const bool measured_all = measure_rounds(measured, COUNT, ROUNDS);
    if (measured_all)
        print_results(measured);
    measure_finish(measured, COUNT);
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    return measured_all ? 0 : 1;
}
