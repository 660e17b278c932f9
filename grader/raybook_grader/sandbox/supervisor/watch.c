/* Watching the command until it ends or goes too far, and ending the rest. */
#define _GNU_SOURCE
#include "supervisor.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

enum { TICK_MS = 20 };

long long now_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000000LL + now.tv_nsec / 1000;
}

/* Reaps whatever has died; true once the command itself has. */
static bool reap_command(pid_t command, int *status)
{
    int any = 0;
    pid_t dead;
    while ((dead = waitpid(-1, &any, WNOHANG)) > 0) {
        if (dead == command) {
            *status = any;
            return true;
        }
    }
    return false;
}

/* Sleeps until a child dies, at most a tick; true if told to stop. */
static bool nap(int control_fd)
{
    const struct timespec tick = {0, TICK_MS * 1000000L};
    struct pollfd control = {control_fd, POLLIN, 0};
    sigset_t none;
    sigemptyset(&none);
    return ppoll(&control, 1, &tick, &none) > 0;
}

static struct outcome outcome_of(int status)
{
    if (WIFEXITED(status)) {
        return (struct outcome){EXITED, WEXITSTATUS(status), 0};
    }
    return (struct outcome){SIGNALED, WTERMSIG(status), 0};
}

static bool too_much(long long used, long long most)
{
    return most != 0 && used > most;
}

struct outcome watch_command(const struct order *order, pid_t command)
{
    const long long deadline = now_us() + order->wall_ms * 1000;
    int status = 0;
    while (!reap_command(command, &status)) {
        if (now_us() >= deadline) {
            return (struct outcome){TIMEOUT, 0, 0};
        }
        if (too_much(resident_bytes(), order->memory)) {
            return (struct outcome){MEMORY, 0, 0};
        }
        if (too_much(scratch_inodes(), order->scratch_files)) {
            return (struct outcome){FILES, 0, 0};
        }
        if (nap(order->control_fd)) {
            return (struct outcome){STOPPED, 0, 0};
        }
    }
    return outcome_of(status);
}

/*
 * kill(-1) reaches every process of the namespace but this one, and a fork
 * fails while a signal is pending, so none can slip through.
 */
void end_everything(void)
{
    kill(-1, SIGKILL);
    while (waitpid(-1, NULL, 0) > 0 || errno == EINTR) {
    }
}
