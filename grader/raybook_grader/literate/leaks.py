"""Searches what a student may be given for secrets."""

from __future__ import annotations

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

from .artefact import Document, documents
from .secrets import SOLUTION_LENGTH, SecretLine, Secrets, digest, squeeze


@dataclass(frozen=True)
class Leak:
    """A secret and where it can be seen; a whole file is seen at line 1."""

    secret: SecretLine
    artefact: str
    line: int

    def __str__(self) -> str:
        secret = self.secret
        place = f"{self.artefact}:{self.line}"
        return f"LEAK {secret.file}:{secret.line} in {place}: {secret.text}"


@dataclass(frozen=True)
class ScanReport:
    """`unread` are documents whose text could not be searched, each with the reason."""

    documents: int
    leaks: tuple[Leak, ...]
    unread: tuple[str, ...]

    @property
    def clean(self) -> bool:
        return not self.leaks and not self.unread


def scan(artefact: Path, secrets: Secrets) -> ScanReport:
    """Search a file or folder, and every archive in it, for every occurrence of a secret.

    Raises FileNotFoundError if it isn't there.
    """
    by_start = _by_start(secrets.lines)
    count = 0
    leaks: list[Leak] = []
    unread: list[str] = []
    for document in documents(artefact):
        count += 1
        leaks += _whole_file(document, secrets)
        leaks += sorted(_lines(document, by_start), key=lambda leak: (leak.line, str(leak)))
        if document.unread:
            unread.append(f"{document.name}: {document.unread}")
    return ScanReport(count, tuple(leaks), tuple(unread))


def _by_start(lines: Iterable[SecretLine]) -> dict[str, list[SecretLine]]:
    """The secrets by the first characters of their keys."""
    table: defaultdict[str, list[SecretLine]] = defaultdict(list)
    for line in lines:
        table[line.key[:SOLUTION_LENGTH]].append(line)
    return table


def _whole_file(document: Document, secrets: Secrets) -> list[Leak]:
    name = secrets.files.get(digest(document.data))
    return [Leak(SecretLine(name, 1, "the whole file", ""), document.name, 1)] if name else []


def _lines(document: Document, by_start: dict[str, list[SecretLine]]) -> set[Leak]:
    leaks: set[Leak] = set()
    for reading in document.readings():
        lines = [squeeze(line) for line in reading.split("\n")]
        starts = list(accumulate((len(line) for line in lines), initial=0))[:-1]
        text = "".join(lines)
        for secret in _candidates(text, by_start):
            for offset in _occurrences(text, secret.key):
                leaks.add(Leak(secret, document.name, bisect_right(starts, offset)))
    return leaks


def _candidates(text: str, by_start: dict[str, list[SecretLine]]) -> Iterator[SecretLine]:
    """The secrets whose first characters occur: one pass, however many secrets there are."""
    windows = (text[i : i + SOLUTION_LENGTH] for i in range(len(text) - SOLUTION_LENGTH + 1))
    for start in {window for window in windows if window in by_start}:
        yield from by_start[start]


def _occurrences(text: str, key: str) -> Iterator[int]:
    offset = text.find(key)
    while offset >= 0:
        yield offset
        offset = text.find(key, offset + 1)
