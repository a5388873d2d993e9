/*
 * The time of a picture as a process of its own relative to the minimum for such a process, and of
 * the gallery's pictures, which are drawn without samples, as the picture is.
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
enum { DRAW, FLOOR, FLOOR_AGAIN, ONE, ALL, COUNT };

/* A command's first word is the argument of that number; in others $P is its name without its
 * folder, and $F the folder for files. */
enum { PROGRAM, GALLERY, FLOOR_PROGRAM };
static const struct {
    const char *name;
    int program;
    const char *words;
} COMMANDS[COUNT] = {
    [DRAW] = {"picture, -o x.png", PROGRAM, "-o $F/x.png"},
    [FLOOR] = {"floor: open, clear, read back", FLOOR_PROGRAM, ""},
    [FLOOR_AGAIN] = {"floor again (the noise)", FLOOR_PROGRAM, ""},
    [ONE] = {"gallery of one", GALLERY, "-o $F/one --samples 0 $P"},
    [ALL] = {"gallery of nine", GALLERY, "-o $F/all --samples 0 --lecture"},
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
        const BenchColumn further = {1e3 / (SCENES - 1), 1, ALL, ONE, -1, -1, false};
        table_open(&table, "one process, 400x400|ms|over the floor");
        for (int i = 0; i < COUNT; i++)
            bench_row(&table, runs,
                      (BenchColumn[]){{BENCH_TIME(i, 1e3, 1)}, {BENCH_RATIO(i, FLOOR, 2)}}, 2, "%s",
                      COMMANDS[i].name);
        table_row(&table, "each further picture, page included|%s|",
                  bench_cell(runs, &further).text);
        bench_print(NULL, &table);
    }
    bench_finish(runs, COUNT);
    return done;
}

const Bench BENCH = {.name = "process_benchmark", .run = run};
