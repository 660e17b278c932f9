"""Keeps a folder of generated files up to date.

A file is complete or absent (written aside, then renamed). A stamp in the folder holds the digest
of the scripts that the files were made with: while these are the same and all files are there,
nothing is written.
"""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

Maker = Callable[[], Iterable[bytes]]
"""Computes a file's bytes, in pieces. A function of a module: it may run in another process."""


def write_aside(path: Path, pieces: Iterable[bytes]) -> None:
    """Write path so that it is complete or absent."""
    aside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with aside.open("wb") as out:
            out.writelines(pieces)
        aside.replace(path)
    except BaseException:
        aside.unlink(missing_ok=True)
        raise


def make_one(folder: Path, makers: Mapping[str, Maker], name: str) -> None:
    """Make one of the files."""
    write_aside(folder / name, makers[name]())


def digest_of(sources: Iterable[Path]) -> str:
    """Of the scripts' texts."""
    digest = hashlib.sha256()
    for source in sorted(sources):
        digest.update(source.read_bytes())
    return digest.hexdigest()


def update(folder: Path, makers: Mapping[str, Maker], sources: Iterable[Path]) -> list[str]:
    """Make what is missing or out of date, several at a time; the names of what was made."""
    stamp, digest = folder / ".stamp", digest_of(sources)
    fresh = stamp.exists() and stamp.read_text(encoding="ascii") == digest
    missing = [name for name in makers if not (fresh and (folder / name).exists())]
    if missing:
        folder.mkdir(parents=True, exist_ok=True)
        with ProcessPoolExecutor(max_workers=min(len(missing), os.cpu_count() or 1)) as pool:
            list(pool.map(partial(make_one, folder, makers), missing))
        write_aside(stamp, [digest.encode("ascii")])
    return missing


def command(
    script: str, makers: Mapping[str, Maker], sources: Iterable[Path], arguments: Sequence[str]
) -> int:
    """The command line of a script that fills a folder: its one argument."""
    if len(arguments) != 1 or arguments[0].startswith("-"):
        print(f"usage: python3 {script} FOLDER", file=sys.stderr)
        return 2
    try:
        update(Path(arguments[0]), makers, sources)
    except OSError as fault:
        print(f"{script}: {fault}", file=sys.stderr)
        return 2
    return 0
