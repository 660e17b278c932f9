/* Writing frames: a length and as many bytes. */
#define _POSIX_C_SOURCE 200809L
#include "supervisor.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const int folder_flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
static const int file_flags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

static bool write_all(int fd, const unsigned char *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t count = write(fd, bytes, size);
        if (count < 0 && errno != EINTR) {
            return false;
        }
        bytes += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return true;
}

static bool write_length(int fd, unsigned long long size)
{
    unsigned char bytes[8];
    for (int i = 0; i < 8; i++) {
        bytes[i] = (unsigned char)(size >> (8 * i));
    }
    return write_all(fd, bytes, sizeof bytes);
}

bool write_frame(int fd, const void *bytes, size_t size)
{
    return write_length(fd, size) && write_all(fd, bytes, size);
}

bool write_words(int fd, const char *words)
{
    return write_frame(fd, words, strlen(words));
}

/* Replaces the folder's descriptor by that of the folder named inside it. */
static int step_into(int folder, const char *name, size_t length)
{
    char step[NAME_MAX + 1];
    int next = -1;
    if (length < sizeof step) {
        memcpy(step, name, length);
        step[length] = '\0';
        next = openat(folder, step, folder_flags);
    } else {
        errno = ENAMETOOLONG;
    }
    const int error = errno;
    close(folder);
    errno = error;
    return next;
}

/*
 * Opens a file below /work, following no symbolic link at any step and never
 * waiting (a FIFO's other end may not exist). Returns -1 with errno set.
 */
static int open_below_work(const char *name)
{
    int folder = open("/work", folder_flags);
    const char *slash;
    while (folder >= 0 && (slash = strchr(name, '/')) != NULL) {
        folder = step_into(folder, name, (size_t)(slash - name));
        name = slash + 1;
    }
    if (folder < 0) {
        return -1;
    }
    const int file = openat(folder, name, file_flags);
    const int error = errno;
    close(folder);
    errno = error;
    return file;
}

static const char *refusal(int error)
{
    switch (error) {
    case ENOENT:
        return "missing";
    case ELOOP:
    case ENOTDIR:
    case ENXIO:
        return "not-a-file";
    default:
        return "unreadable";
    }
}

/* Every writer is dead, so the size cannot change under our hands. */
static bool copy_file(int fd, int file, long long left)
{
    unsigned char block[65536];
    if (!write_words(fd, "ok") || !write_length(fd, (unsigned long long)left)) {
        return false;
    }
    while (left > 0) {
        const ssize_t count = read(file, block, sizeof block);
        if (count <= 0 || count > left ||
            !write_all(fd, block, (size_t)count)) {
            return false;
        }
        left -= count;
    }
    return true;
}

static bool write_opened(int fd, int file, long long largest)
{
    struct stat about;
    if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
        return write_words(fd, "not-a-file");
    }
    if (largest != 0 && about.st_size > largest) {
        return write_words(fd, "too-large");
    }
    return copy_file(fd, file, about.st_size);
}

bool write_file(int fd, const char *name, long long largest)
{
    const int file = open_below_work(name);
    if (file < 0) {
        return write_words(fd, refusal(errno));
    }
    const bool written = write_opened(fd, file, largest);
    close(file);
    return written;
}
