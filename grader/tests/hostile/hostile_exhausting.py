"""Modules that use up what there is."""

from __future__ import annotations

from hostile_case import RIGHT, WRONG, Case, Expect, after_main, before_main, text

OUT_OF_MEMORY = Expect("memory", "Pmmmm", "memory")
OUT_OF_TIME = Expect("timeout", "Ptt--")
FORBIDDEN = Expect("forbidden", "Pxxxx")
IN_VAIN = Expect("pass", "PPPPP")

EAT = """
for (;;)
    memset(malloc(1 << 20), 1, 1 << 20);
"""

CASES = [
    Case(
        "loop",
        "never ends",
        OUT_OF_TIME.saying("the program was stopped: it"),
        write=before_main('for (;;)\n    __asm__ volatile("");'),
    ),
    Case(
        "deaf-loop",
        "never ends and ignores every signal",
        OUT_OF_TIME.saying("the program was stopped: it"),
        write=before_main(
            "for (int s = 1; s < 65; s++)\n    signal(s, SIG_IGN);\n"
            'for (;;)\n    __asm__ volatile("");'
        ),
    ),
    Case(
        "sleep",
        "waits for ever",
        OUT_OF_TIME.saying("the program was stopped: it"),
        write=before_main("for (;;)\n    sleep(1000);"),
    ),
    Case(
        "sleep-at-the-end",
        "waits for ever when all is done",
        OUT_OF_TIME.saying("the program was stopped: it"),
        write=after_main("for (;;)\n    sleep(1000);"),
    ),
    Case(
        "deadlock",
        "threads that wait for each other",
        OUT_OF_TIME.saying("the program was stopped: it"),
        write=before_main(
            "static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;\n"
            "pthread_mutex_lock(&lock);\npthread_mutex_lock(&lock);"
        ),
    ),
    Case("memory", "takes memory without end", OUT_OF_MEMORY, write=before_main(EAT), quick=True),
    Case(
        "memory-by-forks",
        "takes memory in many processes, each within its limit",
        OUT_OF_MEMORY,
        write=before_main(
            "volatile char *food = malloc(100 << 20);\nfor (int i = 0; i < 8; i++)\n"
            "    fork();\nfor (int i = 0; i < 100 << 20; i += 4096)\n    food[i] = 1;\n"
            "for (;;)\n    sleep(1000);"
        ),
    ),
    Case(
        "fork-bomb",
        "forks without end",
        IN_VAIN,
        write=before_main(
            "for (int i = 0; i < 1000; i++)\n    if (fork() == 0)\n"
            "        for (;;)\n            sleep(1000);",
            RIGHT,
        ),
        quick=True,
    ),
    Case(
        "threads",
        "starts threads without end",
        IN_VAIN,
        write=before_main(
            "pthread_t thread;\nfor (int i = 0; i < 1000; i++)\n"
            "    pthread_create(&thread, NULL, wait_for_ever, NULL);",
            RIGHT,
            "static void *wait_for_ever(void *x)\n{\n    for (;;)\n"
            "        sleep(1000);\n    return x;\n}\n",
        ),
    ),
    Case(
        "flood",
        "prints without end",
        FORBIDDEN.saying("printed more than"),
        write=before_main('for (;;)\n    puts("flood");'),
        quick=True,
    ),
    Case(
        "flood-of-errors",
        "the same on the error stream",
        FORBIDDEN.saying("printed more than"),
        write=before_main('for (;;)\n    fputs("flood\\n", stderr);'),
    ),
    Case(
        "large-file",
        "writes a file without end",
        FORBIDDEN.saying("file larger than allowed"),
        write=before_main(
            "static char block[1 << 20];\n"
            'const int file = open("large", O_WRONLY | O_CREAT, 0644);\n'
            "if (lseek(file, 64 << 20, SEEK_SET) < 0 || "
            "write(file, block, sizeof block) < 0)\n    _exit(3);"
        ),
    ),
    Case(
        "sparse-file",
        "a sparse file of 1 TiB",
        FORBIDDEN.saying("file larger than allowed"),
        write=before_main(
            'const int file = open("sparse", O_WRONLY | O_CREAT, 0644);\n'
            "if (ftruncate(file, 1L << 40) != 0)\n    _exit(3);"
        ),
    ),
    Case(
        "many-files",
        "empty files without end",
        FORBIDDEN.saying("made more than"),
        write=before_main(
            "char name[64];\nfor (int i = 0;; i++) {\n"
            '    snprintf(name, sizeof name, "/tmp/%d", i);\n'
            "    close(open(name, O_WRONLY | O_CREAT, 0644));\n}"
        ),
    ),
    Case(
        "full-disk",
        "fills every place that it may write to",
        IN_VAIN,
        write=before_main(
            'static char block[1 << 20];\nconst char *const places[] = {"/tmp/full", '
            '"/dev/shm/full", "/full", "/dev/full-too"};\n'
            "for (int i = 0; i < 4; i++) {\n"
            "    const int file = open(places[i], O_WRONLY | O_CREAT, 0644);\n"
            "    for (int n = 0; n < 60 && write(file, block, sizeof block) > 0; n++)\n"
            "        ;\n    close(file);\n}",
            RIGHT,
        ),
    ),
    Case(
        "recursion",
        "recurses until the stack is full",
        Expect("crash", "Pccfc", "segmentation fault"),
        write=before_main(
            "depth = descend(1);",
            WRONG,
            "static volatile int depth;\nstatic int descend(int n)\n{\n"
            "    volatile char room[4096];\n    room[0] = (char)n;\n"
            "    return n + depth == -1 ? 0 : descend(n + 1) + room[0];\n}\n",
        ),
    ),
    Case(
        "priority",
        "raises its limits and its priority",
        IN_VAIN,
        write=text(
            "#define _GNU_SOURCE\n#include <stdlib.h>\n#include <sys/resource.h>\n"
            f"#include <unistd.h>\n{RIGHT}\n"
            "__attribute__((constructor)) static void attack(void)\n{\n"
            "    const struct rlimit none = {RLIM_INFINITY, RLIM_INFINITY};\n"
            "    if (setrlimit(RLIMIT_AS, &none) == 0 && "
            "setrlimit(RLIMIT_NOFILE, &none) == 0)\n        abort();\n"
            "    if (nice(-20) == -20)\n        abort();\n}\n"
        ),
    ),
]
