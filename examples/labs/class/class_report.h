/*
 * class_report: the results of a class, for other programs, as pages, and as a plot.
 *
 *   class.csv     one line per student (RFC 4180)
 *   class.json    everything
 *   junit.xml     for CI systems: one test case per student
 *   students/FOLDER/results.json   for Gradescope
 *     (https://gradescope-autograders.readthedocs.io/en/latest/specs/)
 *   index.html    the class's page, which opens from disk, without network or scripts
 *   students/FOLDER/index.html   one student's, which names no other student and has no links: its
 *     folder can be handed out
 *   moodle.csv, canvas.csv   grades as Moodle's grading worksheet and Canvas's gradebook take them,
 *     and feedback.zip, the students' pages as Moodle's "upload feedback files" takes them; only if
 *     names had a platform's numbers
 *   front.svg, front.png   lab 10's submissions by cost and error
 *
 * Names and driver messages, which students control, are always escaped: never a spreadsheet
 * formula, an element or a value. Each file is written whole or not at all.
 */
#ifndef CLASS_REPORT_H
#define CLASS_REPORT_H

#include "base/template.h"
#include "labs/class/class_store.h"

/* Adds a section "similar" for each pair of submissions that share what few others have, the most
 * unlikely first, with both texts: a hint to a person, which no other file repeats. */
void class_similar_set(TemplateValues *page, const ClassStore *store);

/* Each writes into the store's folder, whole or not at all. */
bool class_table_csv(const ClassStore *store, Message *message);
bool class_table_json(const ClassStore *store, Message *message);
bool class_table_junit(const ClassStore *store, Message *message);
bool class_table_gradescope(const ClassStore *store, Message *message);

bool class_platform_write(const ClassStore *store, Message *message);

/* Unpacks a class's .zip, as platforms hand it out, into a folder. False, with a message: it is
 * damaged, too large, or has links or paths out of the folder. */
bool class_unpack(const char *path, const char *folder, Message *message);

/* One quoted field; a ' precedes what a spreadsheet would take for a formula. For tests. */
void class_table_csv_field(FILE *file, const char *text);

/* The mistakes of a verdict, between semicolons. */
enum { CLASS_NAMES_SIZE = VERDICT_MAX_MISTAKES * (sizeof((VerdictMistake *)NULL)->name + 2) };
void class_mistake_names(const Verdict *verdict, char names[CLASS_NAMES_SIZE]);

/* A mistake and how many students make it. */
typedef struct ClassMistake {
    const char *name;
    int count;
} ClassMistake;

/* The mistakes of the class, the most frequent first; the caller frees the list, the store owns its
 * names. */
ClassMistake *class_mistakes(const ClassStore *store, int *count);

/* Efficient are lab 10's submissions that no other beats in both cost and error. */

/* Whether no other result has at most its error and cost, and less of one. False: the cost is
 * unknown. */
bool pareto_front_has(const ClassStore *store, const ClassResult *result);

/* Plots them to front.svg and front.png in the store's folder. *drawn: there was anything to plot.
 */
bool pareto_front_draw(const ClassStore *store, bool *drawn, Message *message);

/* `front`: pareto_front_draw has drawn its plot. Each file is written whole or not at all. */
bool class_html_write(const ClassStore *store, bool front, Message *message);

#endif
