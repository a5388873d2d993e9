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

/* Writes text escaped for XML and HTML; line breaks stay. */
void class_table_markup(FILE *file, const char *text);

/* Writes pieces, every second one escaped: MARKUP(file, "<b>", name, "</b>"). */
#define MARKUP(file, ...) class_table_pieces(file, (const char *const[]){__VA_ARGS__, NULL})
void class_table_pieces(FILE *file, const char *const pieces[]);

/* A mistake and how many students make it. */
typedef struct ClassMistake {
    const char *name;
    int count;
} ClassMistake;

/* The mistakes of the class, the most frequent first; the caller frees the list, the store owns its
 * names. NULL, with *count 0: out of memory. */
ClassMistake *class_mistakes(const ClassStore *store, int *count);

/* A text in memory that becomes the file FOLDER/NAME. */
typedef struct ClassFile {
    FILE *file;
    char *text;
    size_t size;
} ClassFile;
bool class_file_open(ClassFile *file, Message *message);
bool class_file_write(ClassFile *file, const char *folder, const char *name, Message *message);

#endif
