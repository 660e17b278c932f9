/* Starting the command: limits, a clean set of descriptors, exec. */
#define _GNU_SOURCE
#include "supervisor.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

/* core(5): a limit of 1, unlike 0, also keeps a host's crash handler away. */
enum { ERROR_FD = 3, OPEN_FILES = 256, STACK_BYTES = 8 << 20, CORE_BYTES = 1 };

static rlim_t at_most(long long wanted, rlim_t most)
{
    return (rlim_t)wanted < most ? (rlim_t)wanted : most;
}

/* The harness may be under stricter limits itself, which cannot be raised. */
static bool limit(int resource, long long soft, long long hard)
{
    struct rlimit bounds;
    if (getrlimit(resource, &bounds) != 0) {
        return false;
    }
    bounds.rlim_cur = at_most(soft, bounds.rlim_max);
    bounds.rlim_max = at_most(hard, bounds.rlim_max);
    return setrlimit(resource, &bounds) == 0;
}

static bool limit_if(int resource, long long most)
{
    return most == 0 || limit(resource, most, most);
}

/* The supervisor is of the same user, so it counts as one process more. */
static bool set_limits(const struct order *order)
{
    const long long cpu = order->cpu_seconds;
    return limit_if(RLIMIT_AS, order->address_size) &&
           (cpu == 0 || limit(RLIMIT_CPU, cpu, cpu + 1)) &&
           limit_if(RLIMIT_FSIZE, order->file_size) &&
           limit(RLIMIT_NOFILE, OPEN_FILES, OPEN_FILES) &&
           limit(RLIMIT_NPROC, order->processes + 1, order->processes + 1) &&
           limit(RLIMIT_STACK, STACK_BYTES, STACK_BYTES) &&
           limit(RLIMIT_CORE, CORE_BYTES, CORE_BYTES);
}

/* If memory runs out all the same, the box goes first, not the harness. */
static void offer_to_oom_killer(void)
{
    const int fd = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (fd >= 0) {
        const ssize_t written = write(fd, "1000", 4);
        (void)written; /* a courtesy: the limits do not depend on it */
        close(fd);
    }
}

static void reset_signals(void)
{
    sigset_t none;
    for (int number = 1; number < NSIG; number++) {
        signal(number, SIG_DFL);
    }
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
}

static void close_from(unsigned first)
{
#ifdef SYS_close_range
    if (syscall(SYS_close_range, first, ~0U, 0U) == 0) {
        return;
    }
#endif
    const long most = sysconf(_SC_OPEN_MAX);
    for (long fd = (long)first; fd < most; fd++) {
        close((int)fd);
    }
}

/* Keeps 0, 1, 2 and, until the exec succeeds, the error pipe as 3. */
static bool keep_standard_descriptors(int error_fd)
{
    const bool moved =
        error_fd == ERROR_FD || dup3(error_fd, ERROR_FD, O_CLOEXEC) == ERROR_FD;
    close_from(ERROR_FD + 1);
    return moved;
}

static void become_command(const struct order *order, int error_fd)
{
    reset_signals();
    setsid();
    offer_to_oom_killer();
    if (keep_standard_descriptors(error_fd) && set_limits(order) && wall_in()) {
        execvp(order->command[0], order->command);
    }
    const int error = errno;
    const ssize_t written = write(ERROR_FD, &error, sizeof error);
    _exit(written == (ssize_t)sizeof error ? 127 : 126);
}

/* 0 once the exec has closed the pipe, else the child's errno. */
static int read_error(int fd)
{
    int error = 0;
    ssize_t count;
    do {
        count = read(fd, &error, sizeof error);
    } while (count < 0 && errno == EINTR);
    close(fd);
    return count == (ssize_t)sizeof error ? error : 0;
}

pid_t start_command(const struct order *order)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        return -1;
    }
    const pid_t child = fork();
    if (child == 0) {
        become_command(order, ends[1]);
    }
    const int fork_error = child < 0 ? errno : 0;
    close(ends[1]);
    const int error = read_error(ends[0]);
    errno = fork_error != 0 ? fork_error : error;
    return errno == 0 ? child : -1;
}
