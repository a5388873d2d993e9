/*
 * class_find: which submissions a folder has, under any of the names that people and learning
 * platforms give them.
 *
 *   surname_name/, 123456/                      folders by hand, by number
 *   Name_123456_assignsubmission_file_/         Moodle, "download submissions in folders"
 *   Name_123456_assignsubmission_file_lab05.frag   and without
 *   name_123_456_lab05.frag, name_LATE_123_456_lab05-1.frag   Canvas
 *   name_lab05.frag                             files by hand
 *   any of these as an archive, or a folder with one archive in it
 *
 * What is hidden, and what macOS and Windows leave behind, is passed over; so is everything else
 * that is neither folder, archive nor source file.
 */
#ifndef CLASS_FIND_H
#define CLASS_FIND_H

#include "bundle.h"

#include <limits.h>

enum { CLASS_STUDENT_SIZE = 128, CLASS_ID_SIZE = 32, CLASS_FOLDER_SIZE = 160 };

/* What a name in the folder tells. */
typedef struct ClassName {
    char student[CLASS_STUDENT_SIZE];
    char id[CLASS_ID_SIZE];      /* the platform's number; empty: none */
    char file[BUNDLE_NAME_SIZE]; /* as the student called it; empty: the name is that of a whole
                                    submission */
} ClassName;

/* False where the name is not that of a submission. */
bool class_name_read(const char *entry, bool is_folder, ClassName *name);

/* A name for files from a student's: letters, digits, ".", "_" and "-" alone, and another one for
 * each student and number. */
void class_name_folder(const ClassName *name, char folder[CLASS_FOLDER_SIZE]);

/* Of two of one student's, the later here counts. */
typedef enum FoundKind { FOUND_FILES, FOUND_ARCHIVE, FOUND_FOLDER, FOUND_OTHER } FoundKind;

/* One student's submission. */
typedef struct Found {
    ClassName name;
    char folder[CLASS_FOLDER_SIZE];
    FoundKind kind;      /* FOUND_OTHER: a link, or anything else that is not read */
    char path[PATH_MAX]; /* of the folder or archive */
    struct FoundFile {
        char path[PATH_MAX];
        char name[BUNDLE_NAME_SIZE];
    } * files; /* of FOUND_FILES */
    int count;
} Found;

typedef struct FoundList {
    Found *items; /* by the names of their folders */
    int count;
} FoundList;

/* Finds the submissions in a folder, without the entry `skipped` (NULL: none). Of a student's
 * link or device, folder, archive and files the first there is of these counts, and `notes`, if not
 * NULL, gets a line. False where there is none, or the folder cannot be read. */
bool class_find(const char *folder, const char *skipped, FoundList *list, Message *notes,
                Message *message);

/* Reads the source files of a folder or of single files. Where a folder has none, and one archive
 * in it, `archive` becomes its path, else empty; and so it does for FOUND_ARCHIVE. */
bool class_read(const Found *found, Bundle *bundle, char archive[PATH_MAX], Message *message);

void class_found_close(FoundList *list);

#endif
