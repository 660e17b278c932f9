"""Modules that look for what is not theirs, and print what they find."""

from __future__ import annotations

from hostile_case import PROBING, RENDERING, RIGHT, WRONG, Case, Expect, before_main

IN_VAIN = Expect("pass", "PPPPP")

# Prints every file that can be read from a folder down, but for the toolchain's.
SEARCH = r"""
static void tell(const char *path)
{
    static char bytes[1 << 16];
    const int file = open(path, O_RDONLY | O_NONBLOCK);
    const ssize_t size = file < 0 ? -1 : read(file, bytes, sizeof bytes);
    if (file >= 0)
        close(file);
    if (size > 0) {
        printf("%s: ", path);
        fwrite(bytes, 1, (size_t)(size < 500 ? size : 500), stdout);
        puts("");
    }
}
__attribute__((unused)) static void search(const char *folder, int depth)
{
    char path[4096];
    struct dirent *entry;
    DIR *open_folder = depth > 6 ? NULL : opendir(*folder ? folder : "/");
    while (open_folder != NULL && (entry = readdir(open_folder)) != NULL) {
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] == '.' && strlen(entry->d_name) < 3)
            continue;
        if (strcmp(path, "/usr") == 0 || strcmp(path, "/proc") == 0 || strcmp(path, "/dev") == 0)
            continue;
        if (entry->d_type == DT_DIR)
            search(path, depth + 1);
        else if (strcmp(path, "/program") != 0 && strcmp(path, "/supervisor") != 0)
            tell(path);
    }
    if (open_folder != NULL)
        closedir(open_folder);
}
"""

# Prints the texts in the program's own file that speak of a canary: the hidden driver has one.
OWN_TEXTS = r"""
static void tell_own_texts(void)
{
    static char bytes[1 << 25];
    const int file = open("/program", O_RDONLY);
    ssize_t left = read(file, bytes, sizeof bytes);
    char *at = bytes, *next;
    while (left > 0 && (next = memmem(at, (size_t)left, "canary", 6)) != NULL) {
        char *begin = next;
        while (begin > bytes && begin[-1] >= 32 && begin[-1] < 127)
            begin--;
        fprintf(stderr, "%.100s ", begin);
        left -= next + 6 - at;
        at = next + 6;
    }
}
"""

NETWORK = r"""
const int kinds[] = {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK};
for (int i = 0; i < 4; i++)
    if (socket(kinds[i], SOCK_STREAM, 0) >= 0 || socket(kinds[i], SOCK_DGRAM, 0) >= 0)
        abort();
"""

CASES = [
    Case(
        "search-in-tests",
        "prints every file that it can read, in the public tests",
        Expect("fail", "PfPPP", "the tests stopped half way"),
        write=before_main(f'if (!{PROBING} && !{RENDERING})\n    search("", 0);', RIGHT, SEARCH),
    ),
    Case(
        "search-in-probes",
        "prints every file in a hidden probe, then crashes to be quoted",
        Expect("crash", "PuccP", "crashed"),
        write=before_main(
            f'if ({PROBING}) {{\n    search("", 0);\n    fflush(stdout);\n    abort();\n}}',
            RIGHT,
            SEARCH,
        ),
        quick=True,
    ),
    Case(
        "search-in-renders",
        "prints the hidden scene, then crashes to be quoted",
        Expect("crash", "PPPPc", "crashed"),
        write=before_main(
            f'if ({RENDERING}) {{\n    search("", 0);\n    fflush(stdout);\n    abort();\n}}',
            RIGHT,
            SEARCH,
        ),
    ),
    Case(
        "driver-as-finding",
        "quotes a hidden driver as a sanitizer's report",
        Expect("fail", "PuffP"),
        write=before_main(
            f"if ({PROBING}) {{\n"
            '    fputs("src/shapes/triangle.c:1:1: runtime error: ", stderr);\n'
            "    tell_own_texts();\n    fputc(10, stderr);\n    _exit(1);\n}",
            RIGHT,
            OWN_TEXTS,
        ),
        quick=True,
    ),
    Case(
        "environment",
        "prints its environment and those of all processes",
        Expect("pass", "PPPPP"),
        write=before_main(
            'tell("/proc/self/environ");\ntell("/proc/1/environ");\n'
            "for (char **e = environ; *e != NULL; e++)\n    puts(*e);",
            RIGHT,
            SEARCH,
        ),
    ),
    Case(
        "beside",
        "reads the reference, HOME and other submissions where they may lie",
        IN_VAIN,
        write=before_main(
            'const char *const places[] = {"/root/canary", "/home", "/etc/passwd", '
            '"/etc/shadow",\n    "/kit/kit.json", "/kit/objects/shapes/triangle.o", '
            '"/proc/1/environ", "../../class"};\n'
            "for (size_t i = 0; i < sizeof places / sizeof *places; i++)\n"
            "    if (open(places[i], O_RDONLY) >= 0)\n        abort();",
            RIGHT,
        ),
    ),
    Case(
        "network",
        "opens sockets of every kind",
        IN_VAIN,
        write=before_main(NETWORK, RIGHT),
    ),
    Case(
        "reference-process",
        "looks for the judge among the processes",
        IN_VAIN,
        write=before_main(
            'DIR *all = opendir("/proc");\nint found = 0;\nstruct dirent *entry;\n'
            "while ((entry = readdir(all)) != NULL)\n"
            "    found += entry->d_name[0] >= '1' && entry->d_name[0] <= '9';\n"
            "closedir(all);\nif (found > 2)\n    abort();",
            RIGHT,
        ),
    ),
    Case(
        "descends",
        "goes up and out through folders",
        IN_VAIN,
        write=before_main(
            'if (chroot("/work") == 0 || chdir("/") != 0 || chdir("../../..") != 0 ||\n'
            '    access("/tmp/raybook-hostile-outside", F_OK) == 0)\n    abort();\n'
            'if (chdir("/work") != 0)\n    abort();',
            RIGHT,
        ),
    ),
    Case(
        "wrong-all-the-same",
        "prints the hidden cases from a wrong answer's message",
        Expect("fail", "Pffuf", "cases are wrong"),
        write=before_main('search("", 0);', WRONG, SEARCH),
    ),
]
