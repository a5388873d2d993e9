/*
 * bubblewrap: the command line of bwrap(1), which shows a process few files and no network.
 */
#ifndef BUBBLEWRAP_H
#define BUBBLEWRAP_H

/* A command line under construction. Zeroed, it is empty; the list ends with NULL. */
typedef struct Words {
    char **words;
    int count;
} Words;

void words_add(Words *words, const char *const added[]); /* ends with NULL */
void words_close(Words *words);

/* Begins one: what comes before a program's own words. The process sees only the system's programs
 * and libraries, what drawing needs, and the paths of `seen`, which ends with NULL, all read-only,
 * and an empty folder in memory of so many bytes, /tmp. */
void bubblewrap_begin(Words *words, const char *const seen[], long bytes);

/* The process sees `path`, too, read-only, as `place`. */
void bubblewrap_bind(Words *words, const char *path, const char *place);

/* Ends what bubblewrap_begin began. */
void bubblewrap_end(Words *words);

#endif
