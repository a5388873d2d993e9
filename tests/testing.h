/*
 * testing: what tests share: messages as failures, a folder of their own, and what a process holds.
 */
#ifndef TESTING_H
#define TESTING_H

#include "message.h"

/* What a test exits with where the machine lacks what it needs. */
enum { EXIT_SKIPPED = 77 };

/* Fails the test, with the message, where something was not done. */
void require(bool done, const Message *message);

/* For cmocka, before and after a test: a new folder, which is the current one, with its path; and
 * its end with all that is in it. */
extern char testing_folder[];
int testing_enter_folder(void **state);
int testing_leave_folder(void **state);

/* How many names a folder has, hidden ones too. */
int testing_entries(const char *folder);

/* To find what is not given back: the open files, with that by which they are counted, and the
 * memory that this process has, in units of 1024 bytes. */
int testing_open_files(void);
long testing_resident_kib(void);

#endif
