/*
 * What the box holds in all. Resource limits are per process, so a program
 * that forks could multiply them; and a file system in memory has a size but
 * no useful limit on the number of its (free of charge) empty files.
 */
#define _POSIX_C_SOURCE 200809L
#include "supervisor.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/statvfs.h>

/*
 * Adds up what a process alone holds, in bytes, from the lines of its status
 * (proc(5)): private pages, in memory or swapped out, and page tables, which
 * a program can make large by touching little of a huge reservation.
 */
static long long sum_status(FILE *status)
{
    static const char *const held[] = {"RssAnon: %lld", "VmSwap: %lld",
                                       "VmPTE: %lld"};
    char line[256];
    long long sum = 0, kilobytes = 0;
    while (fgets(line, sizeof line, status) != NULL) {
        for (size_t i = 0; i < sizeof held / sizeof *held; i++) {
            if (sscanf(line, held[i], &kilobytes) == 1) {
                sum += kilobytes;
            }
        }
    }
    return sum * 1024;
}

static long long private_bytes(const char *process, const char *task)
{
    char path[600];
    snprintf(path, sizeof path, "/proc/%.250s/task/%.250s/status", process,
             task);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return 0;
    }
    const long long bytes = sum_status(file);
    fclose(file);
    return bytes;
}

static bool is_number(const char *name)
{
    return isdigit((unsigned char)name[0]) != 0;
}

/* Threads share their memory, but a dead main thread shows none of it. */
static long long process_bytes(const char *process)
{
    char path[300];
    long long most = 0;
    struct dirent *entry;
    snprintf(path, sizeof path, "/proc/%.250s/task", process);
    DIR *tasks = opendir(path);
    while (tasks != NULL && (entry = readdir(tasks)) != NULL) {
        const long long bytes = is_number(entry->d_name)
                                    ? private_bytes(process, entry->d_name)
                                    : 0;
        most = bytes > most ? bytes : most;
    }
    if (tasks != NULL) {
        closedir(tasks);
    }
    return most;
}

long long resident_bytes(void)
{
    long long sum = 0;
    struct dirent *entry;
    DIR *processes = opendir("/proc");
    while (processes != NULL && (entry = readdir(processes)) != NULL) {
        if (is_number(entry->d_name) && atol(entry->d_name) != 1) {
            sum += process_bytes(entry->d_name);
        }
    }
    if (processes != NULL) {
        closedir(processes);
    }
    return sum;
}

static long long inodes_of(const char *path)
{
    struct statvfs system;
    if (statvfs(path, &system) != 0) {
        return 0;
    }
    return (long long)(system.f_files - system.f_ffree);
}

long long scratch_inodes(void)
{
    return inodes_of("/work") + inodes_of("/tmp") + inodes_of("/dev/shm");
}
