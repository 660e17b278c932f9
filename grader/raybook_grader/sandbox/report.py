"""Reading the supervisor's report (the format is in supervisor/supervisor.h)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

_FILE_ERRORS = {
    b"missing": "missing",
    b"not-a-file": "not a regular file",
    b"too-large": "too large",
    b"unreadable": "unreadable",
}


@dataclass(frozen=True)
class Report:
    """A complete report: `ending` is one of the words of supervisor/main.c."""

    ending: str
    code: int
    cpu_seconds: float
    wall_seconds: float
    max_rss_bytes: int
    files: dict[str, bytes]
    file_errors: dict[str, str]


def parse_report(data: bytes, collect: Sequence[str]) -> Report | None:
    """The report, or None when it is not whole (the supervisor died)."""
    frames = _frames(data)
    try:
        ending, code, cpu_us, wall_us, rss = next(frames).decode("ascii").split()
        files: dict[str, bytes] = {}
        errors: dict[str, str] = {}
        for name in collect:
            word = next(frames)
            if word == b"ok":
                files[name] = next(frames)
            else:
                errors[name] = _FILE_ERRORS[word]
        if next(frames) != b"end":
            return None
        return Report(
            ending, int(code), int(cpu_us) / 1e6, int(wall_us) / 1e6, int(rss), files, errors
        )
    except (StopIteration, ValueError, KeyError):
        return None


def _frames(data: bytes) -> Iterator[bytes]:
    at = 0
    while at + 8 <= len(data):
        size = int.from_bytes(data[at : at + 8], "little")
        at += 8
        if at + size > len(data):
            return
        yield data[at : at + size]
        at += size
