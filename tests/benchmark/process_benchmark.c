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
#include "benchmark/bench.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { ROUNDS = 41, SCENES = 9, MAX_WORDS = 16 };

/* The rows, in the order in which they run. */
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

/* A command's first word is the argument of that number; in others $P is its name without its
 * folder, and $F the folder for files. */
enum { PROGRAM, GALLERY, FLOOR_PROGRAM };
static const struct {
    const char *name;
    int program;
    const char *words;
} COMMANDS[COUNT] = {
    [DRAW] = {"picture, -o x.png", PROGRAM, "-o $F/x.png"},
    [DRAW_SMOOTH] = {"picture, --samples 4", PROGRAM, "--samples 4 -o $F/x.png"},
    [DRAW_NULL] = {"picture, -o /dev/null --compress 0", PROGRAM, "--compress 0 -o /dev/null"},
    [SMALLEST] = {"picture, --compress 9", PROGRAM, "--compress 9 -o $F/x.png"},
    [FLOOR] = {"floor: open, clear, read back", FLOOR_PROGRAM, ""},
    [FLOOR_AGAIN] = {"floor again (the noise)", FLOOR_PROGRAM, ""},
    [ONE] = {"gallery of one, --samples 0", GALLERY, "-o $F/one --samples 0 $P"},
    [ONE_SMOOTH] = {"gallery of one, --samples 4", GALLERY, "-o $F/one --samples 4 $P"},
#define NINE                                                                                       \
    "LightedCube LightedCube_animation LightedCube_ambient LightedTranslatedRotatedCube "          \
    "PointLightedCube PointLightedCube_animation PointLightedCube_perFragment "                    \
    "PointLightedSphere PointLightedSphere_perFragment"
    [ALL] = {"gallery of nine, --samples 0", GALLERY, "-o $F/all --samples 0 " NINE},
    [ALL_SMOOTH] = {"gallery of nine, --samples 4", GALLERY, "-o $F/all --samples 4 " NINE},
};

typedef struct Command {
    char text[1024], *words[MAX_WORDS];
} Command;

/* Runs a command and waits for it. */
static bool run_command(void *argument, Message *message)
{
    char **words = ((Command *)argument)->words;
    pid_t child;
    int status;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const bool started = posix_spawn(&child, words[0], &actions, NULL, words, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    return (started && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
            WEXITSTATUS(status) == 0) ||
           message_set(message, "%s: failed", words[0]);
}

static void put_row(Table *table, const BenchRun *runs, int row)
{
    const BenchColumn columns[] = {{BENCH_TIME(row, 1e3, 1)}, {BENCH_RATIO(row, FLOOR, 2)}};
    bench_row(table, runs, columns, 2, "%s", COMMANDS[row].name);
}

/* A gallery beside the picture alone, both with as many samples. */
static void put_gallery(Table *table, const BenchRun *runs, bool smooth)
{
    static const double MAX_GALLERY_OF_ONE = 1.5, MAX_FURTHER_MS[] = {6, 10};
    const int draw = smooth ? DRAW_SMOOTH : DRAW, one = smooth ? ONE_SMOOTH : ONE;
    const int all = smooth ? ALL_SMOOTH : ALL, samples = smooth ? 4 : 0;
    const BenchColumn ratio = {BENCH_RATIO(one, draw, 2)};
    const BenchColumn further = {1e3 / (SCENES - 1), 1, all, one, -1, -1, false};
    table_row(table, "gallery of one over the picture, --samples %d, at most %.1f||%s", samples,
              MAX_GALLERY_OF_ONE, bench_cell(runs, &ratio).text);
    table_row(table, "each further picture, --samples %d, page included, at most %.1f ms|%s|",
              samples, MAX_FURTHER_MS[smooth], bench_cell(runs, &further).text);
}

static bool run(Message *message)
{
    static Command commands[COUNT];
    BenchRun runs[COUNT];
    Table table;
    if (!bench_arguments[0] || !bench_arguments[1] || !bench_arguments[2])
        return message_set(message, "usage: process_benchmark PROGRAM GALLERY FLOOR");
    const char *folder = bench_folder(message);
    if (!folder)
        return false;
    for (int i = 0; i < COUNT; i++) {
        const char *slash = strrchr(bench_arguments[PROGRAM], '/');
        FILE *file = fmemopen(commands[i].text, sizeof commands[i].text, "w");
        for (const char *p = COMMANDS[i].words; file && *p; p++) {
            if (*p == '$')
                fputs(*++p == 'F' ? folder : slash ? slash + 1 : bench_arguments[PROGRAM], file);
            else
                fputc(*p, file);
        }
        if (file)
            fclose(file);
        int count = 0;
        commands[i].words[count++] = bench_arguments[COMMANDS[i].program];
        for (char *word = strtok(commands[i].text, " "); word; word = strtok(NULL, " "))
            commands[i].words[count++] = word;
        commands[i].words[count] = NULL;
        runs[i] = (BenchRun){COMMANDS[i].name, run_command, &commands[i], NULL, 0};
    }
    const bool done = bench_rounds(runs, COUNT, ROUNDS, message);
    if (done) {
        table_open(&table, "one process, 400x400|ms|over the floor");
        for (int i = 0; i < COUNT; i++)
            put_row(&table, runs, i);
        put_gallery(&table, runs, false);
        put_gallery(&table, runs, true);
        bench_print(NULL, &table);
    }
    bench_finish(runs, COUNT);
    return done;
}

const Bench BENCH = {.name = "process_benchmark", .run = run};
