/* replace.c - see replace.h. */
#define _POSIX_C_SOURCE 200809L

#include "image/replace.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* mkstemp makes files that only the owner can read; give it the mode that any
 * other new file would have. */
static void use_default_mode(int descriptor)
{
    mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
}

/* The temporary file that is there now; empty when there is none. A program
 * that ends in between (out of memory) takes it away. */
static char pending[REPLACE_PATH_SIZE];

static void remove_pending(void)
{
    if (pending[0] != '\0')
        unlink(pending);
}

static void set_pending(const char *temporary)
{
    static bool registered;
    if (!registered)
        registered = atexit(remove_pending) == 0;
    strcpy(pending, temporary);
}

bool replace_begin(struct replacement *r, const char *path, struct error *err)
{
    int a = snprintf(r->path, sizeof r->path, "%s", path);
    int b = snprintf(r->temporary, sizeof r->temporary, "%s.XXXXXX", path);
    if (a >= REPLACE_PATH_SIZE || b >= REPLACE_PATH_SIZE)
        return error_set(err, "%.80s...: the path is too long", path);
    struct stat there; /* renaming would put a file in a device's place */
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return error_set(err, "%s: cannot write: it is a %s", path,
                         S_ISDIR(there.st_mode) ? "folder"
                                                : "device or pipe, not a file");
    int descriptor = mkstemp(r->temporary);
    if (descriptor < 0)
        return error_set(err, "%s: cannot write: %s", path, strerror(errno));
    use_default_mode(descriptor);
    close(descriptor);
    set_pending(r->temporary);
    return true;
}

bool replace_commit(struct replacement *r, struct error *err)
{
    if (rename(r->temporary, r->path) == 0) {
        set_pending("");
        return true;
    }
    int why = errno;
    replace_abandon(r);
    return error_set(err, "%s: cannot write: %s", r->path, strerror(why));
}

void replace_abandon(struct replacement *r)
{
    unlink(r->temporary);
    set_pending("");
}
