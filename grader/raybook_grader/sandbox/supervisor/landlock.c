/*
 * One more wall, where the kernel has it: Landlock (landlock(7)). Should the
 * mounts of the box ever have a hole, the command still writes nowhere but in
 * its scratch folders, binds and connects no port, and signals nobody outside.
 *
 * The numbers are those of linux/landlock.h, which may be older than the
 * kernel; each version of the interface (ABI) knows more rights.
 */
#define _GNU_SOURCE
#include "supervisor.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

/* The same on every machine: asm-generic/unistd.h. */
enum { CREATE_RULESET = 444, ADD_RULE = 445, RESTRICT_SELF = 446 };
enum { ASK_VERSION = 1, PATH_BENEATH = 1 };

/* Rights to files; those beyond an ABI's count of bits it does not know. */
static const uint64_t reading = 1U << 0 | 1U << 2 | 1U << 3;
static const uint64_t ports = 1U << 0 | 1U << 1;  /* bind, connect */
static const uint64_t scopes = 1U << 0 | 1U << 1; /* sockets, signals */

struct ruleset {
    uint64_t files, network, scoped;
};

struct __attribute__((packed)) beneath {
    uint64_t rights;
    int32_t folder;
};

static uint64_t file_rights(long abi)
{
    const int bits = abi >= 5 ? 16 : abi >= 3 ? 15 : abi >= 2 ? 14 : 13;
    return (UINT64_C(1) << bits) - 1;
}

static bool allow(int ruleset, const char *path, uint64_t rights)
{
    struct beneath rule = {rights, open(path, O_PATH | O_CLOEXEC)};
    if (rule.folder < 0) {
        return errno == ENOENT; /* no such place, nothing to allow */
    }
    const bool done = syscall(ADD_RULE, ruleset, PATH_BENEATH, &rule, 0) == 0;
    close(rule.folder);
    return done;
}

static bool allow_all(int ruleset, uint64_t everything)
{
    return allow(ruleset, "/", reading) &&
           allow(ruleset, "/work", everything) &&
           allow(ruleset, "/tmp", everything) &&
           allow(ruleset, "/dev", everything);
}

static bool enforce(int ruleset)
{
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           syscall(RESTRICT_SELF, ruleset, 0) == 0;
}

bool wall_in(void)
{
    const long abi = syscall(CREATE_RULESET, NULL, 0, ASK_VERSION);
    if (abi < 1) {
        return true; /* this kernel has none */
    }
    const uint64_t everything = file_rights(abi);
    const struct ruleset handled = {everything, abi >= 4 ? ports : 0,
                                    abi >= 6 ? scopes : 0};
    const size_t size = sizeof handled.files * (abi >= 6   ? 3
                                                : abi >= 4 ? 2
                                                           : 1);
    const int ruleset = (int)syscall(CREATE_RULESET, &handled, size, 0);
    const bool done =
        ruleset >= 0 && allow_all(ruleset, everything) && enforce(ruleset);
    if (ruleset >= 0) {
        close(ruleset);
    }
    return done;
}
