/*
 * class_store: the results of a class, each written to its own folder as soon as it is known.
 *
 * OUT/students/FOLDER/result.json is the result; what was submitted (statements.txt, see
 * submission/statements.h), pictures and pages are beside it. A result is
 * replaced only by one that is not worse, or by that of a changed submission.
 */
#ifndef CLASS_STORE_H
#define CLASS_STORE_H

#include "base/json_writer.h"
#include "labs/class/class_find.h"
#include "labs/sandbox/bundle.h"
#include "labs/submission/verdict.h"

typedef struct ClassResult {
    char student[CLASS_STUDENT_SIZE];
    char id[CLASS_ID_SIZE];
    char folder[CLASS_FOLDER_SIZE]; /* in OUT/students */
    int attempt;                    /* from 1 */
    char lab[64];
    uint64_t hash;  /* of the submission */
    bool finished;  /* else judging timed out or failed */
    double limit;   /* seconds */
    long long when; /* it was judged, in seconds since 1970 */
    Verdict verdict;
} ClassResult;

typedef struct ClassStore {
    char folder[PATH_MAX];
    ClassResult *results; /* sorted by folder */
    int count;
    int lock;
} ClassStore;

/* Makes the folder if necessary, locks it against other runs until class_store_close, and reads its
 * results. Unreadable ones are skipped with a line in `notes`. */
bool class_store_open(ClassStore *store, const char *folder, Message *notes, Message *message);

/* Reads the results of another run's folder without locking it. */
bool class_store_read(ClassStore *store, const char *folder, Message *notes, Message *message);

/* The path of the students' folder in OUT, `store`; with `folder` of one student's; with `name` too
 * of a file there. False: too long. */
bool class_store_path(const char *store, const char *folder, const char *name, char path[PATH_MAX],
                      Message *message);

/* The result of a folder; NULL: none. Valid until the next class_store_put. */
ClassResult *class_store_find(const ClassStore *store, const char *folder);

/* Writes a result's members as JSON, without the braces. */
void class_result_put(JsonWriter *json, const ClassResult *result);

/* Whether a submission need not be judged again: its result is finished, or timed out after at
 * least `limit` seconds. */
bool class_result_stands(const ClassResult *result, const char *lab, uint64_t hash, double limit);

/* Whether `old` stays: both are of one submission and lab, and `next` is unfinished while `old` is
 * finished, or has fewer points. */
bool class_result_is_worse(const ClassResult *next, const ClassResult *old);

/* What a sandbox said beside a verdict; NULL: nothing. The picture is changed, see png_copy. */
typedef struct ClassFiles {
    char *picture, *statements;
    size_t picture_size, statements_size;
} ClassFiles;

/* Writes a result, after its files, unless it is worse than the existing one. *kept, if not NULL:
 * it was written. */
bool class_store_put(ClassStore *store, const ClassResult *result, ClassFiles files, bool *kept,
                     Message *message);

/* What was submitted, for free(); NULL: it is not known. */
char *class_store_statements(const ClassStore *store, const ClassResult *result);

/* Adds every result of `from`; of two different submissions of a student the one judged last
 * counts. False: the labs differ. */
bool class_store_merge(ClassStore *store, const ClassStore *from, Message *message);

/* NULL or zeroed is fine. */
void class_store_close(ClassStore *store);

#endif
