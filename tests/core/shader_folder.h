/*
 * shader_folder: shaders in a temporary folder, for tests.
 */
#ifndef SHADER_FOLDER_H
#define SHADER_FOLDER_H

#include "core/shader_files.h"
#include "core/shader_source.h"
#include "support/testing.h"

extern ShaderLoader loader; /* at first of the folder */
extern ShaderSource source; /* the last that was read */
extern Message failure;

int enter_folder(void **state);
int leave_folder(void **state);
#define SHADER_TEST(name) TEST_WITH(0, name, enter_folder, leave_folder)
#define DRIVER_TEST(name) TEST_WITH(1, name, enter_folder, leave_folder)

#define make testing_put

/* Reads a vertex shader, which is there, from a path. */
bool load(const char *name);
void found(const char *name, const char *path);

/* Fails with a message that begins with `start` and contains `said`; nothing is left to close. */
void refused(const char *name, const char *start, const char *said);

/* The driver gets this text, which ends with a newline. */
void text_is(const char *expected);

/* A driver's location of a line: source string and line number. */
void driver_place(const char *line, int *file, int *number);

/* Files of random text, by rand, each including some later ones, with line ends of all kinds. Each
 * line states its location, except for an optional broken one. */
enum { FILES = 6, MAX_LINES = 12 };
void make_tree(int broken_file, int broken_line, const char *broken);

#endif
