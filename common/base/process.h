/*
 * process: child processes: external programs, and forks that send back an answer.
 */
#ifndef PROCESS_H
#define PROCESS_H

#include "base/message.h"

#include <stddef.h>
#include <sys/resource.h>
#include <sys/types.h>

/* Starts arguments[0], looked up in PATH, with default signal handling and these open files as its
 * descriptors 0 to 3; -1 stands for /dev/null. `arguments` ends with NULL. Returns 0 or an errno:
 * ENOENT if there is no such program. */
int process_start(pid_t *process, const char *const *arguments, const int files[4]);

/* Whether the environment has exactly this "NAME=VALUE". */
bool process_has(const char *setting);

/* Runs this program again in place of this process, with these arguments and with `settings`,
 * "NAME=VALUE" that stay, ended by NULL, in the environment: for what is read before main. Returns
 * true if they are there already, and false if that fails. */
bool process_restart(char *const *arguments, const char *const *settings, Message *message);

/* Forks with a pipe for the child's answer. Returns 0 in the child, where *end is to be written,
 * and the child's id in the parent, where *end is to be read and closed; -1 on failure. */
pid_t process_fork(int *end, Message *message);

/* Reads until `size` bytes, end of file or the deadline, in seconds of clock_now (HUGE_VAL: none);
 * returns the number of bytes. */
size_t process_read(int file, void *bytes, size_t size, double deadline);

/* Waits for the end of a child; its status as in waitpid. 0 if the status is not known, which is so
 * if this process ignores SIGCHLD: check what the child has produced. */
int process_wait(pid_t process);

/* The last line of a file that collected a child's standard error, without control characters, cut
 * to the line's size; false: there is none. */
bool process_last_line(int file, char *line, size_t size);

/* For a forked child: limits processor time and address space (bytes; RLIM_INFINITY: no limit; none
 * with AddressSanitizer, which reserves terabytes), and forbids core dumps. */
void process_limit(rlim_t seconds, rlim_t memory);

/* For a forked child: makes the descriptors first to last /dev/null. */
void process_null(int first, int last);

#endif
