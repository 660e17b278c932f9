/* Runs one command and reports how it went: see supervisor.h. */
#define _GNU_SOURCE
#include "supervisor.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

static const char *const ending_words[] = {"exited",     "signaled", "timeout",
                                           "memory",     "files",    "stopped",
                                           "not-started"};

/* SIGCHLD has to interrupt ppoll(), which an ignored signal does not. */
static void on_child(int signal_number)
{
    (void)signal_number;
}

static bool catch_children(void)
{
    sigset_t children;
    struct sigaction action = {0};
    action.sa_handler = on_child;
    sigemptyset(&children);
    sigaddset(&children, SIGCHLD);
    return sigaction(SIGCHLD, &action, NULL) == 0 &&
           sigprocmask(SIG_BLOCK, &children, NULL) == 0;
}

/* Nobody inside may reach this process's descriptors or memory. */
static bool lock_up(const struct order *order)
{
    return prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) == 0 &&
           fcntl(order->report_fd, F_SETFD, FD_CLOEXEC) == 0 &&
           fcntl(order->control_fd, F_SETFD, FD_CLOEXEC) == 0 &&
           catch_children();
}

static struct outcome run_command(const struct order *order)
{
    const long long start = now_us();
    const pid_t command = start_command(order);
    struct outcome outcome = {NOT_STARTED, errno, 0};
    if (command > 0) {
        outcome = watch_command(order, command);
    }
    outcome.wall_us = now_us() - start;
    end_everything();
    return outcome;
}

static long long microseconds(struct timeval time)
{
    return time.tv_sec * 1000000LL + time.tv_usec;
}

/* Everything is reaped by now, so "children" means the whole box. */
static bool write_status(int fd, struct outcome outcome)
{
    char words[160];
    struct rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    snprintf(words, sizeof words, "%s %d %lld %lld %lld",
             ending_words[outcome.ending], outcome.code,
             microseconds(usage.ru_utime) + microseconds(usage.ru_stime),
             outcome.wall_us, usage.ru_maxrss * 1024LL);
    return write_words(fd, words);
}

static bool write_report(const struct order *order, struct outcome outcome)
{
    bool written = write_status(order->report_fd, outcome);
    for (int i = 0; written && i < order->collect_count; i++) {
        written =
            write_file(order->report_fd, order->collect[i], order->file_size);
    }
    return written && write_words(order->report_fd, "end");
}

int main(int argc, char **argv)
{
    struct order order;
    if (getpid() != 1) {
        /* It ends by killing every process that it can see. */
        fputs("supervisor: runs only as process 1 of a box\n", stderr);
        return 2;
    }
    if (!read_order(argc, argv, &order) || !lock_up(&order)) {
        fputs("supervisor: bad order\n", stderr);
        return 2;
    }
    return write_report(&order, run_command(&order)) ? 0 : 1;
}
