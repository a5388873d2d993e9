/*
 * class_table: the results of a class for other programs.
 *
 *   class.csv     a line for each student (RFC 4180)
 *   class.json    everything
 *   junit.xml     as CI systems read it: a test case for each student
 *   students/FOLDER/results.json   as Gradescope reads it
 *     (https://gradescope-autograders.readthedocs.io/en/latest/specs/)
 *
 * What students chose, their names and what drivers say about their sources, is text in all of
 * them and nothing else: no formula for a spreadsheet, no element, no value.
 */
#ifndef CLASS_TABLE_H
#define CLASS_TABLE_H

#include "class_store.h"

/* Each writes into the store's folder, whole or not at all. */
bool class_table_csv(const ClassStore *store, Message *message);
bool class_table_json(const ClassStore *store, Message *message);
bool class_table_junit(const ClassStore *store, Message *message);
bool class_table_gradescope(const ClassStore *store, Message *message);

/* One field of a table, in quotes; what a spreadsheet would take for a formula gets a ' before it.
 * For tests. */
void class_table_csv_field(FILE *file, const char *text);

/* Text of an element or attribute of XML or HTML; line breaks stay. */
void class_table_markup(FILE *file, const char *text);

/* A mistake and how many of the class make it. */
typedef struct ClassMistake {
    const char *name;
    int count;
} ClassMistake;

/* The mistakes of the class, the most frequent first; the list is the caller's to free, its names
 * are the store's. NULL, with *count 0: none, or no memory. */
ClassMistake *class_mistakes(const ClassStore *store, int *count);

/* Opens text in memory for a file "FOLDER/NAME", and writes it there. */
typedef struct ClassFile {
    FILE *file;
    char *text;
    size_t size;
} ClassFile;
bool class_file_open(ClassFile *file, Message *message);
bool class_file_write(ClassFile *file, const char *folder, const char *name, Message *message);

#endif
