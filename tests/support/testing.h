/*
 * testing: shared by tests: the standard headers that nearly all need, messages as failures, a
 * temporary folder, resources of the process.
 */
#ifndef TESTING_H
#define TESTING_H

#include "base/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* cmocka.h needs the headers before it. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

/* Defines a test and adds it to the program's list 0, or 1 for those that draw:
 *   TEST(a_zero_vector_has_no_direction)
 *   {
 *       assert_false(...);
 *   } */
#define TEST(name) TEST_WITH(0, name, NULL, NULL)
#define DRAWN_TEST(name) TEST_WITH(1, name, NULL, NULL)
#define TEST_WITH(list, name, setup, teardown)                                                     \
    static void name(void **state);                                                                \
    __attribute__((constructor)) static void add_##name(void)                                      \
    {                                                                                              \
        testing_add(list, (struct CMUnitTest){#name, name, setup, teardown, NULL});                \
    }                                                                                              \
    static void name(__attribute__((unused)) void **state)
void testing_add(int list, struct CMUnitTest test);

/* A test in a temporary folder of its own, which is the current one. */
#define FOLDER_TEST(name) TEST_WITH(0, name, testing_enter_folder, testing_leave_folder)

/* A variable that `close` closes when its scope ends, last declared first (not if a test fails):
 *   CLOSED(mesh_close) Mesh mesh; */
#define CLOSED(close) __attribute__((cleanup(close), unused))

/* Runs a list in the order of the file; returns how many tests failed. */
int testing_run(int list, const char *name, CMFixtureFunction setup, CMFixtureFunction teardown);

/* Defines a set-up or tear-down: FIXTURE(open_all) { ... } */
#define FIXTURE(name)                                                                              \
    static void name##_once(void);                                                                 \
    static int name(__attribute__((unused)) void **state)                                          \
    {                                                                                              \
        name##_once();                                                                             \
        return 0;                                                                                  \
    }                                                                                              \
    static void name##_once(void)

/* Defines main: runs list 0. */
#define TEST_MAIN(name, setup, teardown)                                                           \
    int main(void)                                                                                 \
    {                                                                                              \
        return testing_run(0, name, setup, teardown);                                              \
    }

static const double PI __attribute__((unused)) = 3.14159265358979323846;

/* Fails the test unless `value` is within `tolerance` of `expected`, relative to it. */
void testing_near(double value, double expected, double tolerance);

/* printf's text, valid until the 16th call after it. */
const char *formatted(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Exit code of a test that this machine cannot run. */
enum { EXIT_SKIPPED = 77 };

/* Of many similar cases the short form of the tests takes every `4 * step`-th; the long form every
 * LIGHTING_TEST_LONG-th at least, which tests/run sets: with --all to 1. */
int testing_step(int step);

/* Of `count` random cases as many as with a step, at least one. */
int testing_part(int count, int step);

/* Runs `body` in one process of the short form, and in as many as there are processors of the long
 * one, before anything is drawn; returns its worst exit code. testing_mine: whether a case is to be
 * tested in this process. */
int testing_in_parts(int (*body)(void));
bool testing_mine(int number);

/* LIGHTING_TEST_SEED of the environment, or `usual`; prints it. */
unsigned long long testing_seed(unsigned long long usual);

/* Fails the test with the message unless `done`. FAILURE is a message for calls that must succeed:
 * require(mesh_cube(&cube, 1, FAILURE), FAILURE). */
void require(bool done, const Message *message);
extern Message testing_failure;
#define FAILURE (&testing_failure)

/* The same for a call with a message of its own: SUCCEEDS(mesh_cube(&mesh, 1, message)); */
#define SUCCEEDS(call)                                                                             \
    do {                                                                                           \
        Message *const message = &(Message){0};                                                    \
        require(call, message);                                                                    \
    } while (0)

/* The call is refused with the message, or with one that has this part. */
#define FAILS(call, text_of_message)                                                               \
    do {                                                                                           \
        Message *const message = &(Message){0};                                                    \
        assert_false(call);                                                                        \
        assert_string_equal(message->text, text_of_message);                                       \
    } while (0)
#define FAILS_WITH(call, part)                                                                     \
    do {                                                                                           \
        Message *const message = &(Message){0};                                                    \
        assert_false(call);                                                                        \
        if (!strstr(message->text, part))                                                          \
            fail_msg("\"%s\" does not say \"%s\"", message->text, part);                           \
    } while (0)

/* Set-up and tear-down for cmocka: a temporary folder, made the current one, and its removal. */
extern char testing_folder[];
int testing_enter_folder(void **state);
int testing_leave_folder(void **state);

/* The same, with the cache (base/cache.h) in that folder, but not Mesa's: to compile the shaders
 * takes most of the time of a test that draws many scenes. */
int testing_enter_cache(void **state);
int testing_leave_cache(void **state);

/* Tear-down that fails if a test left a file. */
int testing_leave_empty_folder(void **state);

void testing_write(const char *path, const void *bytes, size_t size);
void testing_put(const char *path, const char *text);

/* All bytes of a file and a zero byte, to be freed. */
char *testing_read(const char *path, size_t *size);

/* A path below the source tree, which the test was built from; valid until the next call. */
const char *testing_source(const char *path);

/* Runs a shell command, which must succeed. */
void testing_shell(const char *command);

/* The exit code of a child process that runs `body`; fails the test if a signal ends it. */
int testing_in_child(int (*body)(void));

/* In a child process: gives up root, which permissions do not bind. */
bool testing_drop_root(void);

/* The same for erand48 and nrand48. */
void testing_seed48(unsigned short seed[3]);

/* The number of entries of a folder, hidden ones included. */
int testing_entries(const char *folder);

/* To find leaks: open descriptors (with the one that counts them), and resident memory in KiB. */
int testing_open_files(void);
long testing_resident_kib(void);

#endif
