/*
 * class_store: the results of a class, each in a folder of its own and kept as soon as it is known.
 *
 * OUT/students/FOLDER/result.json is the result; pictures and pages stand beside it. A result is
 * replaced only by one that is not worse, or by that of another submission.
 */
#ifndef CLASS_STORE_H
#define CLASS_STORE_H

#include "bundle.h"
#include "class_find.h"
#include "verdict.h"

typedef struct ClassResult {
    char student[CLASS_STUDENT_SIZE];
    char id[CLASS_ID_SIZE];
    char folder[CLASS_FOLDER_SIZE]; /* in OUT/students */
    char lab[64];
    uint64_t hash;  /* of what was handed in */
    bool finished;  /* it was judged; else the judging was cut off, or went wrong */
    double limit;   /* seconds that the judging was given */
    long long when; /* it was judged: seconds since 1970 */
    Verdict verdict;
} ClassResult;

typedef struct ClassStore {
    char folder[PATH_MAX];
    ClassResult *results; /* by their folders */
    int count;
    int lock;
} ClassStore;

/* Makes the folder if need be, keeps other runs out of it until class_store_close, and reads what
 * is there. A result that cannot be read is passed over with a line in `notes`. */
bool class_store_open(ClassStore *store, const char *folder, Message *notes, Message *message);

/* Reads the results of a folder that another run wrote, without keeping anybody out. */
bool class_store_read(ClassStore *store, const char *folder, Message *notes, Message *message);

/* The path of all students' results in OUT, `store`; of one's where `folder` is not NULL; of a file
 * among them where `name` is not, either. False where it is too long. */
bool class_store_path(const char *store, const char *folder, const char *name, char path[PATH_MAX],
                      Message *message);

/* The result of that name; NULL: none. Valid until the next is put. */
const ClassResult *class_store_find(const ClassStore *store, const char *folder);

/* Whether a submission need not be judged again: its result is finished, or it was given `limit`
 * seconds or more before. */
bool class_result_stands(const ClassResult *result, const char *lab, uint64_t hash, double limit);

/* Whether `old` is to stay: both are of one submission and lab, and `next` is unfinished where
 * `old` is finished, or gives fewer points. */
bool class_result_is_worse(const ClassResult *next, const ClassResult *old);

/* Writes a result, and its picture from `files` (may be NULL) first, unless it is worse than the
 * one there is. *kept, if not NULL: whether it was written. */
bool class_store_put(ClassStore *store, const ClassResult *result, const Bundle *files, bool *kept,
                     Message *message);

/* Puts in every result of `from`; of two submissions of a student the one judged last counts. False
 * where results are of several labs. */
bool class_store_merge(ClassStore *store, const ClassStore *from, Message *message);

/* NULL or zeroed is fine. */
void class_store_close(ClassStore *store);

#endif
