/*
 * class_find: finds the submissions in a folder, under the names that people and learning platforms
 * give them.
 *
 *   surname_name/, 123456/                      folders by name or number
 *   Name_123456_assignsubmission_file_/         Moodle, "download submissions in folders"
 *   Name_123456_assignsubmission_file_lab05.frag   Moodle, without folders
 *   name_123_456_lab05.frag, name_LATE_123_456_lab05-1.frag   Canvas
 *   name_lab05.frag                             single files
 *   any of these as an archive, or a folder with one archive in it
 *
 * Hidden files and leftovers of macOS and Windows are ignored. Anything else is found, if only as
 * something that is not read.
 */
#ifndef CLASS_FIND_H
#define CLASS_FIND_H

#include "labs/program/lab.h"
#include "labs/sandbox/bundle.h"

#include <limits.h>

enum { CLASS_STUDENT_SIZE = 128, CLASS_ID_SIZE = 32, CLASS_FOLDER_SIZE = 160 };

/* The parts of an entry's name. */
typedef struct ClassName {
    char student[CLASS_STUDENT_SIZE];
    char id[CLASS_ID_SIZE];      /* the platform's number; empty: none */
    char file[BUNDLE_NAME_SIZE]; /* the student's name for it; empty: a whole submission */
    int attempt;                 /* Canvas's number in the file's name; 0: the first */
    bool of_platform, late;      /* it is a platform's; Canvas says that it is late */
} ClassName;

/* False: not the name of a submission. */
bool class_name_read(const char *entry, bool is_folder, ClassName *name);

/* A file name for a student: only letters, digits, ".", "_" and "-", unique for each student and
 * number. */
void class_name_folder(const ClassName *name, char folder[CLASS_FOLDER_SIZE]);

/* Of two submissions of one student that changed last counts; at the same time the later kind here.
 */
typedef enum FoundKind {
    FOUND_UNREAD,
    FOUND_FILES,
    FOUND_ARCHIVE,
    FOUND_FOLDER,
    FOUND_OTHER
} FoundKind;

/* One student's submission. */
typedef struct Found {
    ClassName name;
    char folder[CLASS_FOLDER_SIZE];
    FoundKind kind;      /* FOUND_OTHER: a link or device; FOUND_UNREAD: of an unknown ending */
    long long changed;   /* in seconds since 1970 */
    char path[PATH_MAX]; /* of the folder or archive */
    struct FoundFile {
        char path[PATH_MAX];
        char name[BUNDLE_NAME_SIZE];
        int attempt;
    } * files; /* of FOUND_FILES */
    int count;
    int attempt;   /* how many attempts there are: the latest is judged */
    int days_late; /* begun ones: class_late_find */
} Found;

typedef struct FoundList {
    Found *items; /* sorted by folder */
    int count;
} FoundList;

/* Finds the submissions in a folder, except the entry `skipped` (NULL: none). If a student has
 * several, one counts (see FoundKind), and `notes`, if not NULL, gets a line. False: none found, or
 * the folder cannot be read. */
bool class_find(const char *folder, const char *skipped, FoundList *list, Message *notes,
                Message *message);

/* Finds who is late by the rule of a lab that has one: by what platforms' names say, since the
 * times in their archives are those of the download; by the newest file of others; and by `table`
 * (NULL: none), a file with lines like "Li,2" or "4711,2026-11-21 08:00". `notes`, if not NULL,
 * gets what is not known. False: the table cannot be read, or names somebody else. */
bool class_late_find(FoundList *list, const Lab *lab, const char *table, Message *notes,
                     Message *message);

/* Reads the source files of a folder, or single files. For FOUND_ARCHIVE, or a folder that has only
 * an archive, `archive` becomes its path instead; otherwise it is empty. */
bool class_read(const Found *found, Bundle *bundle, char archive[PATH_MAX], Message *message);

void class_found_close(FoundList *list);

#endif
