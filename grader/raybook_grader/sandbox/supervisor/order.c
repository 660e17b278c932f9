/*
 * The command line:
 *   supervisor REPORT_FD CONTROL_FD WALL_MS CPU_SECONDS ADDRESS_SIZE MEMORY
 *              FILE_SIZE PROCESSES SCRATCH_FILES COUNT NAME... COMMAND...
 * Numbers are decimal and not negative; COUNT names follow it.
 */
#include "supervisor.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>

enum { NUMBERS = 10 };

static bool read_number(const char *text, long long *number)
{
    char *end = NULL;
    errno = 0;
    *number = strtoll(text, &end, 10);
    return errno == 0 && end != text && *end == '\0' && *number >= 0;
}

static void fill_limits(const long long *number, struct order *order)
{
    order->report_fd = (int)number[0];
    order->control_fd = (int)number[1];
    order->wall_ms = number[2];
    order->cpu_seconds = number[3];
    order->address_size = number[4];
    order->memory = number[5];
    order->file_size = number[6];
    order->processes = number[7];
    order->scratch_files = number[8];
    order->collect_count = (int)number[9];
}

bool read_order(int argc, char **argv, struct order *order)
{
    long long number[NUMBERS];
    if (argc < NUMBERS + 2) {
        return false;
    }
    for (int i = 0; i < NUMBERS; i++) {
        if (!read_number(argv[i + 1], &number[i])) {
            return false;
        }
    }
    fill_limits(number, order);
    order->collect = argv + NUMBERS + 1;
    order->command = order->collect + order->collect_count;
    return number[NUMBERS - 1] < argc - NUMBERS - 1;
}
