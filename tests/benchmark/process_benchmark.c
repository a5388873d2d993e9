/*
 * What a picture costs as a process of its own, over the least that any such process can cost, and
 * what a further picture costs in a process that draws several.
 *
 *   process_benchmark PROGRAM GALLERY FLOOR
 */
#include "measure.h"

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
    char *gallery_one[] = {argv[2], "-o", one, "LightedCube", NULL};
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
        measure_print_machine();
        printf("%-38s %22s   %s\n", "one process, 400x400", "ms", "over the floor");
        for (int i = 0; i < COUNT; i++) {
            const Summary time = measure_summary(measured[i].seconds, ROUNDS);
            const Summary ratio = measure_ratio(&measured[i], &measured[FLOOR], 1, ROUNDS);
            printf("%-38s %6.1f [%5.1f, %6.1f]   %.2f [%.2f, %.2f]\n", measured[i].name,
                   1e3 * time.median, 1e3 * time.lower, 1e3 * time.upper, ratio.median, ratio.lower,
                   ratio.upper);
        }
        double further[ROUNDS];
        for (int i = 0; i < ROUNDS; i++)
            further[i] = 1e3 * (measured[ALL].seconds[i] - measured[ONE].seconds[i]) / (SCENES - 1);
        const Summary each = measure_summary(further, ROUNDS);
        printf(
            "each further picture of the gallery: %.1f ms [%.1f, %.1f], sheet and page included\n",
            each.median, each.lower, each.upper);
    }
    measure_finish(measured, COUNT);
    nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    return measured_all ? 0 : 1;
}
