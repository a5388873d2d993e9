/*
 * class_table: the results of a class for other programs.
 *
 *   class.csv     one line per student (RFC 4180)
 *   class.json    everything
 *   junit.xml     for CI systems: one test case per student
 *   students/FOLDER/results.json   for Gradescope
 *     (https://gradescope-autograders.readthedocs.io/en/latest/specs/)
 *
 * Names and driver messages, which students control, are always escaped: never a spreadsheet
 * formula, an element or a value.
 */
#ifndef CLASS_TABLE_H
#define CLASS_TABLE_H

#include "labs/class/class_store.h"

/* Each writes into the store's folder, whole or not at all. */
bool class_table_csv(const ClassStore *store, Message *message);
bool class_table_json(const ClassStore *store, Message *message);
bool class_table_junit(const ClassStore *store, Message *message);
bool class_table_gradescope(const ClassStore *store, Message *message);

/* One quoted field; a ' precedes what a spreadsheet would take for a formula. For tests. */
void class_table_csv_field(FILE *file, const char *text);

/* The mistakes of a verdict, between semicolons. */
enum { CLASS_NAMES_SIZE = VERDICT_MAX_MISTAKES * 80 };
void class_mistake_names(const Verdict *verdict, char names[CLASS_NAMES_SIZE]);

/* A mistake and how many students make it. */
typedef struct ClassMistake {
    const char *name;
    int count;
} ClassMistake;

/* The mistakes of the class, the most frequent first; the caller frees the list, the store owns its
 * names. */
ClassMistake *class_mistakes(const ClassStore *store, int *count);

#endif
