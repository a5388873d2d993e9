/*
 * parse: values as one types them on a command line.
 */
#ifndef PARSE_H
#define PARSE_H

#include <stdbool.h>

enum { PARSE_SIZE_MOST = 16384 };

/* "WIDTHxHEIGHT", each 1 to PARSE_SIZE_MOST, and nothing else. */
bool parse_size(const char *text, int *width, int *height);

/* A finite decimal number within least..most, and nothing else. */
bool parse_number(const char *text, double least, double most, double *number);

/* A whole number within least..most, and nothing else. */
bool parse_whole(const char *text, int least, int most, int *number);

/* One to three numbers with commas between, the i-th within least[i]..most[i]; returns how many, 0
 * where it is anything else. */
int parse_numbers(const char *text, const double least[3], const double most[3], double numbers[3]);

/* Writes a finite number in the fewest digits, 15 to 17, from which parse_number makes the very
 * same one. */
void parse_number_text(double number, char text[32]);

/* The name most like `word`, or NULL where none is near; `names` is NULL-terminated. */
const char *parse_nearest(const char *word, const char *const *names);

#endif
