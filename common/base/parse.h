/*
 * parse: values of the command line.
 */
#ifndef PARSE_H
#define PARSE_H

#include <stdbool.h>
#include <stdint.h>

enum { PARSE_SIZE_MAX = 16384 };

/* "WIDTHxHEIGHT", or one number for both, each 1 to PARSE_SIZE_MAX. Like all functions here, it
 * refuses trailing text. */
bool parse_size(const char *text, int *width, int *height);

/* A finite decimal number in [min, max]. */
bool parse_number(const char *text, double min, double max, double *number);

/* An integer in [min, max]. */
bool parse_whole(const char *text, int min, int max, int *number);

/* One to `most` numbers separated by commas, the i-th in [min[i], max[i]]. Returns their count; 0
 * on failure. */
int parse_numbers(const char *text, int most, const double *min, const double *max,
                  double *numbers);

/* The I-th of N parts of something that is made by several processes. Zeroed: all of it. */
typedef struct Part {
    int number, count;
} Part;

enum { PARTS_MAX = 10000 };

/* "I/N", as 2/3. */
bool parse_part(const char *text, Part *part);

/* Whether an item, counted from 0, is in the part: items that follow each other are in different
 * ones. */
bool part_has(Part part, uint64_t item);

/* Writes a finite number with the fewest digits, 15 to 17, that parse_number reads back exactly. */
void parse_number_text(double number, char text[32]);

#endif
