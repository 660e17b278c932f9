/*
 * The supervisor: process 1 of a box.
 *
 * It starts one command with resource limits, watches it, kills whatever is
 * left of it, and only then writes a report to a descriptor that the command
 * has never held. Being process 1 of its own process namespace it cannot be
 * killed or stopped from inside, and it inherits every orphan; not being
 * dumpable, its descriptors and memory cannot be reached from inside either
 * (proc(5), ptrace(2): access mode checks).
 *
 * The report is a row of frames, each an unsigned 64-bit little-endian length
 * and as many bytes:
 *   1. "ENDING CODE CPU_US WALL_US RSS_BYTES" in ASCII (see `ending_words`);
 *   2. for every file asked for, in order: "ok", "missing", "not-a-file",
 *      "too-large" or "unreadable"; after "ok" one more frame, the contents;
 *   3. "end".
 * A report without its last frame is worth nothing.
 */
#ifndef RAYBOOK_SUPERVISOR_H
#define RAYBOOK_SUPERVISOR_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* What to run and how far it may go. Sizes in bytes; 0 = no such limit. */
struct order {
    int report_fd;           /* the report is written here */
    int control_fd;          /* readable or closed = "stop at once" */
    long long wall_ms;       /* from the start to the end of the command */
    long long cpu_seconds;   /* of any one process */
    long long address_size;  /* address space of any one process */
    long long memory;        /* private memory of all processes together */
    long long file_size;     /* largest file written or collected */
    long long processes;     /* processes and threads at once */
    long long scratch_files; /* inodes in /work, /tmp and /dev/shm */
    int collect_count;
    char **collect; /* names below /work, borrowed from argv */
    char **command; /* ends with NULL, borrowed from argv */
};

/* How the command ended; the order is that of `ending_words`. */
enum ending { EXITED, SIGNALED, TIMEOUT, MEMORY, FILES, STOPPED, NOT_STARTED };

struct outcome {
    enum ending ending;
    int code; /* exit code, signal, or errno for NOT_STARTED; else 0 */
    long long wall_us;
};

/* Reads the command line (main.c says how it looks); false if it is bad. */
bool read_order(int argc, char **argv, struct order *order);

/*
 * Starts the command in its own session with descriptors 0, 1 and 2 only.
 * SIGCHLD must be blocked. Returns its process id, or -1 with errno set.
 */
pid_t start_command(const struct order *order);

/*
 * Keeps this process and its children, for ever, from writing elsewhere than
 * in the scratch folders, by Landlock. True where the kernel has no Landlock.
 */
bool wall_in(void);

/* Waits until the command ends or goes too far. Kills nothing. */
struct outcome watch_command(const struct order *order, pid_t command);

/* Kills and reaps every other process of the box. */
void end_everything(void);

/* Monotonic clock in microseconds. */
long long now_us(void);

/* Private bytes of every process in /proc, this one excepted. */
long long resident_bytes(void);

/* Inodes in use on the box's writable file systems. */
long long scratch_inodes(void);

/* Writes one frame; false when the reader is gone. */
bool write_frame(int fd, const void *bytes, size_t size);
bool write_words(int fd, const char *words);

/* Writes the frames of one collected file; false when the reader is gone. */
bool write_file(int fd, const char *name, long long largest);

#endif
