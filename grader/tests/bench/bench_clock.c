/* bench_clock.c - see bench_clock.h. */
#define _POSIX_C_SOURCE 200809L

#include "bench_clock.h"

#include <time.h>

static double now(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double clock_wall(void)
{
    return now(CLOCK_MONOTONIC);
}

double clock_thread(void)
{
    return now(CLOCK_THREAD_CPUTIME_ID);
}

double clock_process(void)
{
    return now(CLOCK_PROCESS_CPUTIME_ID);
}
