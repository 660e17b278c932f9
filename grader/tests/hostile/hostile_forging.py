"""Modules that would rather write their own marks."""

from __future__ import annotations

from hostile_case import PRELUDE, PROBING, RIGHT, WRONG, Case, Expect, after_main, before_main, text

NOTHING = Expect("fail", "Pffff")
"""A point for compiling, no more."""
IN_VAIN = Expect("pass", "PPPPP")
"""A right module that tried, harmed nobody and gained nothing."""

UNITY = 'puts("test.c:1:everything:PASS\\n-----\\n27 Tests 0 Failures 0 Ignored\\nOK");'

# What a box leaves to the next one, if it leaves anything.
PLACES = ("/tmp/raybook-hostile-mark-left", "/dev/shm/raybook-hostile-mark-left",
          "/work/raybook-hostile-mark-left", "/var/tmp/raybook-hostile-mark-left")  # fmt: skip
LEAVE = "\n".join(f'if (access("{p}", F_OK) == 0) abort();\nput("{p}", "x", 1);' for p in PLACES)

READS_BEYOND = """
static volatile int far = 1 << 20;
HIDE static int beyond(void)
{
    int near[4] = {1, 2, 3, 4};
    return ((volatile int *)near)[4 + (far >> 20)];
}
__attribute__((constructor)) static void attack(void)
{
    if (beyond() == 12345)
        abort();
}
"""


def hidden(attribute: str, before: str = "") -> str:
    """A right module that reads beyond an array where the sanitizers are told not to look."""
    return f"{PRELUDE}{before}\n#define HIDE {attribute}\n{RIGHT}{READS_BEYOND}"


CASES = [
    Case(
        "early-exit",
        "ends with exit code 0 before the first case",
        NOTHING.saying("before it had answered"),
        write=before_main("_exit(0);"),
    ),
    Case(
        "forged-tests",
        "prints that all tests pass",
        Expect("fail", "Pufff", "points count only once"),
        write=before_main(f"{UNITY}\nfflush(stdout);\n_exit(0);"),
        quick=True,
    ),
    Case(
        "forged-results",
        "writes results of its own and ends",
        Expect("fail", "Pffuf", "wrote 65536 bytes, expected"),
        write=before_main(
            f"char zeros[65536] = {{0}};\nif ({PROBING})\n"
            '    put("results.bin", zeros, sizeof zeros);\n_exit(0);'
        ),
    ),
    Case(
        "rewritten-results",
        "writes over the results when the program has ended",
        Expect("fail", "PufuP", "wrote 65536 bytes, expected"),
        write=after_main(
            "char ones[65536];\nmemset(ones, 1, sizeof ones);\n"
            f'if ({PROBING})\n    put("results.bin", ones, sizeof ones);'
        ),
    ),
    Case(
        "linked-results",
        "a link in place of the results",
        Expect("fail", "PuffP", "before it had answered"),
        write=after_main(
            'unlink("results.bin");\n'
            'const int error = symlink("/program", "results.bin");\n(void)error;'
        ),
    ),
    Case(
        "cases-as-results",
        "hands the cases back as results",
        Expect("fail", "Pffuf", "wrote 19176 bytes, expected"),
        write=before_main(
            "static char bytes[1 << 20];\n"
            f'if ({PROBING}) {{\n    const int file = open("cases.bin", O_RDONLY);\n'
            "    const ssize_t size = read(file, bytes, sizeof bytes);\n"
            '    put("results.bin", bytes, size > 0 ? (size_t)size : 0);\n}\n_exit(0);'
        ),
    ),
    Case(
        "caught-crash",
        "crashes, and catches the signal to end well",
        NOTHING,
        write=before_main(
            "signal(SIGSEGV, leave);\n*(volatile int *)0 = 1;",
            WRONG,
            "static void leave(int s) { (void)s; _exit(0); }\n",
        ),
    ),
    Case(
        "lying-exit",
        "crashes at the end, when all is written",
        Expect("crash", "Pcccc", "crashed"),
        write=after_main("abort();"),
    ),
    Case(
        "becomes-true",
        "becomes another program that ends well",
        NOTHING.saying("before it had answered"),
        write=before_main('execl("/usr/bin/true", "true", (char *)NULL);'),
    ),
    Case(
        "all-descriptors",
        "writes to every descriptor, the supervisor's perhaps",
        IN_VAIN,
        write=before_main(
            "for (int fd = 3; fd < 1024; fd++) {\n"
            '    const ssize_t n = write(fd, "exited 0 0 0 0", 14);\n    (void)n;\n}',
            RIGHT,
        ),
    ),
    Case(
        "kill-all",
        "kills every process that it can, the supervisor first",
        IN_VAIN,
        write=before_main("kill(1, SIGKILL);\nkill(1, SIGSTOP);\nkill(-1, SIGKILL);", RIGHT),
    ),
    Case(
        "trace-supervisor",
        "looks into the supervisor's memory and descriptors",
        IN_VAIN,
        write=before_main(
            'if (ptrace(PTRACE_ATTACH, 1, 0, 0) == 0 || open("/proc/1/mem", O_RDWR) >= 0 ||\n'
            '    opendir("/proc/1/fd") != NULL)\n    abort();',
            RIGHT,
        ),
    ),
    Case(
        "leftovers",
        "leaves a file for the next run to find",
        IN_VAIN,
        write=before_main(LEAVE, RIGHT),
        quick=True,
    ),
    Case(
        "daemon",
        "leaves a process behind that waits for the next run",
        IN_VAIN,
        write=before_main(
            "if (fork() == 0) {\n    setsid();\n    if (fork() == 0)\n        for (;;)\n"
            "            sleep(1000);\n    _exit(0);\n}",
            RIGHT,
        ),
    ),
    Case(
        "no-sanitize",
        "hides a read beyond an array from the sanitizers",
        Expect("fail", "PPPfP", "no_sanitize"),
        write=text(hidden('__attribute__((no_sanitize_address, no_sanitize("undefined")))')),
        quick=True,
    ),
    Case(
        "pasted-no-sanitize",
        "the same with a name put together by the preprocessor",
        Expect("fail", "PPPfP", "no_sanitize"),
        write=text(
            hidden("__attribute__((GLUE(no_sani, tize_address)))", "#define GLUE(a, b) a##b")
        ),
    ),
    Case(
        "behaves-when-watched",
        "does it only where no sanitizer is compiled in",
        Expect("fail", "PPPfP", "insufficient space for an object"),
        write=text(
            hidden("")
            .replace("near)[4 + (far >> 20)]", "near)[WHERE]")
            .replace(
                "static volatile int far",
                "#ifdef __SANITIZE_ADDRESS__\n#define WHERE 0\n#else\n"
                "#define WHERE (4 + (far >> 20))\n#endif\nstatic volatile int far",
            )
        ),
    ),
    Case(
        "asks-for-sanitizers",
        "ends the program well where it finds a sanitizer",
        Expect("fail", "PPPfP", "sanitizer"),
        write=text(
            hidden("", "void __asan_init(void) __attribute__((weak));").replace(
                "    if (beyond()",
                "    if (__asan_init != NULL) {\n        "
                'const int file = open("results.bin", O_WRONLY | O_CREAT, 0644);\n        '
                'const ssize_t n = write(file, "x", 1);\n        (void)n;\n'
                "        _exit(0);\n    }\n"
                "    if (beyond()",
            )
        ),
    ),
    Case(
        "forged-place",
        "forges a sanitizer's report on line 999999 of its file",
        Expect("fail", "Pffff", "in what the module calls"),
        write=before_main(
            'fputs("src/shapes/triangle.c:999999:1: runtime error: division by zero\\n", stderr);\n'
            "_exit(1);"
        ),
    ),
    Case(
        "forged-finding",
        "prints a sanitizer's report with words of its own",
        Expect("fail", "Pffff"),
        write=before_main(
            'fputs("src/x.c:1:1: runtime error: your grade is A: <script>evil</script>\\n", '
            "stderr);\n_exit(1);"
        ),
    ),
]
