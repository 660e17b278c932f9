"""What a case of the hostile corpus is, and the ways to write one as a submission.

To add a case, append it to the list of its class (`hostile_archives.py`, ...): a name, what
it tries, what the grader must make of it, and how it is written. Everything else is done for all
cases alike in `hostile_grading.py`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from raybook_grader.checks.stub import stub_text

CHECKOUT = Path(__file__).resolve().parents[3]
OWNED = "src/shapes/triangle.c"

STATUSES = {
    "P": "passed",
    "p": "partial",
    "f": "failed",
    "u": "unconfirmed",
    "b": "build-error",
    "c": "crash",
    "t": "timeout",
    "m": "memory",
    "x": "forbidden",
    "-": "not run",
}
"""The letters of `Case.checks`."""
KINDS = ("build", "unit", "probe", "robust", "image")
"""The checks of the course that the corpus is graded in, in order: one of each kind."""

Write = Callable[[Path, str], None]
"""Writes one submission into the class's folder, under a name."""


@dataclass(frozen=True)
class Expect:
    """``checks`` has one letter of `STATUSES` for each of `KINDS`; "" if no check is to run.

    ``says`` are words that the report must hold: the cause, not only the verdict.
    """

    verdict: str
    checks: str
    says: str = ""

    def saying(self, words: str) -> Expect:
        return replace(self, says=words)


@dataclass(frozen=True)
class Case:
    """One submission; its name is its id."""

    name: str
    tries: str
    expect: Expect
    write: Write
    group: str = ""
    quick: bool = False
    """Whether it is in the short selection of `make test`."""


RIGHT = (CHECKOUT / OWNED).read_text(encoding="utf-8")
"""The reference's module: all points, unless the code round it spoils them."""
WRONG = stub_text(CHECKOUT, OWNED)
"""Reports no hit, ever: no point but for compiling, unless the code round it gains some."""

PRELUDE = """
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
"""

_HELPERS = """
/* Does the command line hold this word? So code can tell which check it runs in. */
__attribute__((unused)) static int runs_with(const char *word)
{
    char line[4096];
    const int file = open("/proc/self/cmdline", O_RDONLY);
    const ssize_t size = read(file, line, sizeof line);
    close(file);
    return size > 0 && memmem(line, (size_t)size, word, strlen(word)) != NULL;
}
__attribute__((unused)) static void put(const char *path, const void *bytes, size_t size)
{
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const ssize_t written = write(file, bytes, size);
    (void)written;
    close(file);
}
"""

RENDERING = 'runs_with("--output")'
PROBING = 'runs_with("results.bin")'


def text(source: str, path: str = OWNED) -> Write:
    """A folder with one file."""
    return raw(source.encode(), path)


def raw(content: bytes, path: str = OWNED) -> Write:
    """The same from bytes."""

    def write(folder: Path, name: str) -> None:
        file = folder / name / path
        file.parent.mkdir(parents=True)
        file.write_bytes(content)

    return write


def before_main(body: str, module: str = WRONG, before: str = "") -> Write:
    """A module with code that runs before the program's own; ``before`` is C at file level."""
    attack = f"__attribute__((constructor)) static void attack(void)\n{{\n{body}\n}}\n"
    return text(f"{PRELUDE}{module}{_HELPERS}{before}{attack}")


def after_main(body: str, module: str = RIGHT, before: str = "") -> Write:
    """The same with code that runs when the program has ended."""
    attack = f"__attribute__((destructor)) static void attack(void)\n{{\n{body}\n}}\n"
    return text(f"{PRELUDE}{module}{_HELPERS}{before}{attack}")
