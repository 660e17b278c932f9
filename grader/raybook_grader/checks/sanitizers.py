"""AddressSanitizer and UndefinedBehaviorSanitizer: how to call them, and what they said in words.

What a C program does after a read beyond an array, or an overflow of a signed integer, is
anybody's guess: it may well print the right answer, today. The sanitizers stop it there.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from ..kit import is_clang
from .sanitizer_words import known_words
from .words import clean

_FLAGS = ("-g", "-fsanitize=address,undefined,float-cast-overflow",
          "-fno-sanitize-recover=all", "-U__SANITIZE_ADDRESS__")  # fmt: skip
"""For the compiler, after its other flags; for the linker they do no harm.

`-fsanitize=undefined` leaves out the conversion of a NaN or of 1e30 to an int, which is as
undefined as the rest. A division of floats by zero is not: it is infinite. The macro would tell a
module when it is watched.
"""


def sanitizing(cc: str) -> tuple[str, ...]:
    """The flags for a compiler. clang drops a read whose value is not used before its sanitizers
    see it, at any level but the lowest."""
    return ("-O0" if is_clang(cc) else "-O1", *_FLAGS)


ENVIRONMENT = {
    # Looking for leaks needs ptrace, which the box refuses; malloc returns NULL as it does
    # elsewhere; what was freed is kept aside, but not in the default 256 MiB.
    "ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1:quarantine_size_mb=32:color=never",
    "UBSAN_OPTIONS": "print_stacktrace=1:color=never",
}
"""For the program."""

_ADDRESS_ERROR = re.compile(r"^==\d+==ERROR: AddressSanitizer: ([\w-]+)(.*)$", re.MULTILINE)
_ACCESS = re.compile(r"^(READ|WRITE) of size (\d{1,9})\b", re.MULTILINE)
_UNDEFINED = re.compile(r"^\S+?:\d+:(?:\d+:)? runtime error: (.*)$", re.MULTILINE)
_PLACE = re.compile(r"(?:^|[\s/])(src/[\w./-]+\.[ch]):(\d{1,7})\b")
_POINTER = re.compile(r"\b0x[0-9a-f]+")

_EVASION = re.compile(
    r"\b\w*(?:no_sanitize|no_address_safety|disable_sanitizer|address_sanitizer"
    r"|(?:asan|ubsan|lsan|sanitizer)_)\w*"
)
"""Names by which code hides from the sanitizers or finds out that they watch."""

_PLAIN = {
    "heap-buffer-overflow": "goes beyond the end of memory from malloc",
    "stack-buffer-overflow": "goes beyond the end of a local array",
    "stack-buffer-underflow": "goes before the beginning of a local array",
    "dynamic-stack-buffer-overflow": "goes beyond the end of a local array",
    "global-buffer-overflow": "goes beyond the end of a global array",
    "heap-use-after-free": "uses memory after it was freed",
    "stack-use-after-return": "uses a local variable after its function has returned",
    "stack-use-after-scope": "uses a local variable after the end of its block",
    "attempting": "frees what is not there to be freed",
    "alloc-dealloc-mismatch": "frees memory in another way than it was allocated",
    "SEGV": "follows a pointer that points nowhere",
    "FPE": "divides an integer by zero",
    "stack-overflow": "runs out of stack: a recursion is too deep, or a local array too large",
}
"""AddressSanitizer's names in words that need no manual."""

_OTHER_ERRORS = (
    "ABRT", "BUS", "ILL", "allocation-size-too-big", "bad-free", "calloc-overflow",
    "container-overflow", "memcpy-param-overlap", "negative-size-param", "out-of-memory",
    "stack-buffer-underflow", "strcpy-param-overlap", "unknown-crash", "use-after-poison",
)  # fmt: skip


@dataclass(frozen=True)
class Finding:
    """What a sanitizer stopped: ``kind`` in a few stable words, ``message`` in a sentence.

    ``line`` is in ``path``, a file of the module; 0 if no place in the module is known.
    """

    kind: str
    message: str
    path: str = ""
    line: int = 0


def evasions(text: bytes) -> list[str]:
    """The names in preprocessed C by which a module would escape the sanitizers' eyes."""
    return sorted({name[:60] for name in _EVASION.findall(text.decode("utf-8", "replace"))})


def finding(said: bytes, files: Mapping[str, bytes]) -> Finding | None:
    """The first report in what a program said, if there is one.

    ``files`` are the module's, as they are called in a submission: "src/accel/bvh.c". The program
    may have printed a report of its own making, in which it quotes what is none of its student's
    business: so only the sanitizers' own words, numbers and what stands in the files are kept.
    """
    text = clean(said, lines=400)
    address, undefined = _ADDRESS_ERROR.search(text), _UNDEFINED.search(text)
    if undefined and not (address and address.start() < undefined.start()):
        what = known_words(_POINTER.sub("...", undefined[1]).strip(), files.values())
        return _placed(_kind(what), what, text[undefined.start() :], files)
    if address:
        return _placed(*_address_error(address, text), text[address.start() :], files)
    return None


def _address_error(report: re.Match[str], text: str) -> tuple[str, str]:
    """The kind of an error with an address, and the words for it."""
    kind, rest = report[1], report[2]
    if kind not in _PLAIN and kind not in _OTHER_ERRORS:
        kind = "unknown-crash"
    if kind == "attempting" and "double-free" in rest:
        return "double-free", "double-free: frees the same memory twice"
    plain = _PLAIN.get(kind, "uses memory that is not its own")
    kind = "bad-free" if kind == "attempting" else kind
    access = _ACCESS.search(text, report.start())
    if not access:
        return kind, f"{kind}: {plain}"
    verb = "reading" if access[1] == "READ" else "writing"
    return kind, f"{kind}: {plain}, {verb} {access[2]} bytes"


def _kind(undefined: str) -> str:
    """A complaint without its numbers and types: "signed integer overflow"."""
    head = re.split(r": | of type | for type |, which | in the range", undefined)[0]
    return re.sub(r"\s+", " ", re.sub(r"-?\b\d[\w.+-]*", "...", head)).strip()


def _placed(kind: str, what: str, report: str, files: Mapping[str, bytes]) -> Finding:
    """The innermost place in the module: what it calls is inlined, or was given bad values."""
    for path, line in _PLACE.findall(report):
        if path in files and 0 < int(line) <= files[path].count(b"\n") + 1:
            return Finding(kind, f"{path}, line {line}: {what}", path, int(line))
    return Finding(kind, f"in what the module calls, or with what it returned: {what}")
