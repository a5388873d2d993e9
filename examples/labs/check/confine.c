/* A filter of system calls (seccomp(2)) that stays until the process ends: what is not listed fails
 * with EPERM. Loading a library needs to open files; afterwards a second filter takes that, too. */
#include "labs/check/code.h"

#include <errno.h>
#include <fcntl.h>
#include <seccomp.h>
#include <string.h>
#include <unistd.h>

/* Memory, reading, writing to open files, clocks, exit. */
static const int ALLOWED[] = {
    SCMP_SYS(brk),          SCMP_SYS(mmap),         SCMP_SYS(munmap),
    SCMP_SYS(mremap),       SCMP_SYS(mprotect),     SCMP_SYS(madvise),
    SCMP_SYS(read),         SCMP_SYS(readv),        SCMP_SYS(pread64),
    SCMP_SYS(write),        SCMP_SYS(writev),       SCMP_SYS(close),
    SCMP_SYS(lseek),        SCMP_SYS(fstat),        SCMP_SYS(newfstatat),
    SCMP_SYS(stat),         SCMP_SYS(statx),        SCMP_SYS(access),
    SCMP_SYS(faccessat),    SCMP_SYS(readlink),     SCMP_SYS(getcwd),
    SCMP_SYS(futex),        SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack),  SCMP_SYS(getpid),
    SCMP_SYS(gettid),       SCMP_SYS(getrandom),    SCMP_SYS(clock_gettime),
    SCMP_SYS(gettimeofday), SCMP_SYS(prctl), /* to confine it further */
    SCMP_SYS(seccomp),      SCMP_SYS(sched_yield),  SCMP_SYS(sched_getaffinity),
    SCMP_SYS(exit),         SCMP_SYS(exit_group),   SCMP_SYS(restart_syscall),
};

/* O_TRUNC empties a file even if it is opened for reading. */
enum { WRITES = O_ACCMODE | O_CREAT | O_TRUNC };

static int add_rules(scmp_filter_ctx filter, bool loading)
{
    int error = 0;
    for (size_t i = 0; i < sizeof ALLOWED / sizeof ALLOWED[0] && !error; i++)
        error = seccomp_rule_add(filter, SCMP_ACT_ALLOW, ALLOWED[i], 0);
    if (!error && loading)
        error = seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(openat), 1,
                                 SCMP_A2(SCMP_CMP_MASKED_EQ, WRITES, O_RDONLY));
    if (!error && loading)
        error = seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(open), 1,
                                 SCMP_A1(SCMP_CMP_MASKED_EQ, WRITES, O_RDONLY));
    /* abort() signals its own process. */
    const struct scmp_arg_cmp own = {
        .arg = 0, .op = SCMP_CMP_EQ, .datum_a = (scmp_datum_t)getpid()};
    if (!error)
        error = seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1, &own);
    return error;
}

bool confine_process(bool loading, Message *message)
{
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
    if (!filter)
        return message_set(message, "seccomp: not supported by this system");
    int error = add_rules(filter, loading);
    if (!error)
        error = seccomp_load(filter);
    seccomp_release(filter);
    return error ? message_set(message, "seccomp: %s; a submission's C code cannot be run safely",
                               strerror(-error))
                 : true;
}
