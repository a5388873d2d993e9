/* The streams and signals of a process. */
#include "app/options.h"

#include "base/output.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

/* Ends the process as the signal alone would, after removing half-written files. */
static void end_by_signal(int number)
{
    const struct sigaction standard = {.sa_handler = SIG_DFL};
    output_unlink_temporaries();
    sigaction(number, &standard, NULL);
    raise(number); /* delivered when this returns */
}

/* Ends quietly when the reader of standard output has left, as in `| head`. Writing to any other
 * pipe fails with EPIPE. */
static void end_without_reader(int number)
{
    struct pollfd output = {.fd = STDOUT_FILENO};
    const int error = errno;
    (void)number;
    if (poll(&output, 1, 0) == 1 && output.revents & (POLLERR | POLLHUP)) {
        output_unlink_temporaries();
        _exit(0);
    }
    errno = error;
}

void options_catch_signals(void (*handler)(int), int flags)
{
    static const int ending[] = {SIGINT, SIGTERM, SIGHUP};
    const struct sigaction action = {.sa_handler = handler, .sa_flags = flags};
    struct sigaction before;
    for (size_t i = 0; i < sizeof ending / sizeof ending[0]; i++)
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(ending[i], &action, NULL);
}

void options_prepare_process(void)
{
    for (int file = 0; file <= 2; file++) {
        /* Read-only also for the outputs, so that writing to a closed stream fails. */
        if (fcntl(file, F_GETFD) < 0 && errno == EBADF)
            (void)!open("/dev/null", O_RDONLY);
    }
    const struct sigaction on_pipe = {.sa_handler = end_without_reader, .sa_flags = SA_RESTART};
    sigaction(SIGPIPE, &on_pipe, NULL);
    signal(SIGXFSZ, SIG_IGN);
    options_catch_signals(end_by_signal, SA_RESTART);
}
