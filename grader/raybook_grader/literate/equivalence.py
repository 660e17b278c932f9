"""The student export against two tools that know nothing of the markers.

The exporter's words are checked against `unifdef` (which lines are kept) and against gcc's
preprocessor (what a compiler sees). Both must be installed: FileNotFoundError otherwise.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections.abc import Iterable
from itertools import zip_longest
from pathlib import Path

from .export import ExportedFile, export
from .pieces import SourceFile
from .tree import SOURCE_FOLDER, SourceTree

_MARKER = re.compile(r"\s*//[<>]")
_INCLUDE = re.compile(r'^\s*#\s*include\s+([<"].*)$', re.MULTILINE)
_PREPROCESS = ("gcc", "-std=c99", "-E", "-P", "-x", "c", "-Wno-builtin-macro-redefined")
# An assertion names its line, and the lines of the two editions differ.
_PLACE = ("-D__LINE__=0", '-D__FILE__="file.c"')


def unifdef_difference(source: SourceFile, exported: ExportedFile) -> str | None:
    """The first line where the export is not what `unifdef -DTODO_...` keeps; None if none.

    Blank lines, markers and the comments made of markers don't count.
    """
    defines = [f"-DTODO_{name}" for name in sorted({r.name for r in source.regions})]
    text = "\n".join(source.text) + "\n"
    run = subprocess.run(["unifdef", *defines], input=text.encode(), capture_output=True)
    if run.returncode not in (0, 1):  # 1: some lines went
        return f"{source.name}: unifdef: {run.stderr.decode().strip()}"
    kept = [line for line in run.stdout.decode().split("\n") if not _MARKER.match(line)]
    ours = [line.text for line in exported.lines if not line.is_title]
    return _first_difference(source.name, "unifdef", _solid(kept), _solid(ours))


def preprocessor_differences(tree: SourceTree) -> list[str]:
    """One message for each file of which gcc -E -DTODO_... (all) gives another text than of
    the export, white space aside.

    The project's own headers are included for real, each edition's in its edition; other
    headers are not read, so that none needs to be installed.
    """
    defines = [f"-DTODO_{name}" for name in tree.todos]
    exported = {name: export(source).text for name, source in tree.files.items()}
    original = {name: "\n".join(source.text) + "\n" for name, source in tree.files.items()}
    messages: list[str] = []
    with tempfile.TemporaryDirectory() as scratch:
        ours, theirs = Path(scratch, "student"), Path(scratch, "original")
        for folder, texts in ((ours, exported), (theirs, original)):
            for name, text in texts.items():
                _write(folder / name, _own_includes_only(name, text, texts))
        for name in tree.files:
            expected = _preprocess(theirs, name, defines)
            found = _preprocess(ours, name, [])
            difference = _first_difference(name, "gcc -E", expected, found)
            messages += [difference] if difference else []
    return messages


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _own_includes_only(name: str, text: str, names: Iterable[str]) -> str:
    """The text with the includes of foreign headers turned into words that stay."""
    folder = name.rpartition("/")[0]
    known = set(names)

    def replace(match: re.Match[str]) -> str:
        header = match[1].strip().strip('"')
        if f"{folder}/{header}" in known or f"{SOURCE_FOLDER}/{header}" in known:
            return match[0]
        return f"include {match[1]}"

    return _INCLUDE.sub(replace, text)


def _preprocess(folder: Path, name: str, defines: list[str]) -> list[str]:
    command = [*_PREPROCESS, *_PLACE, *defines, f"-I{SOURCE_FOLDER}", name]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if run.returncode != 0:
        return ["gcc failed:", *run.stderr.splitlines()]
    return run.stdout.split()


def _solid(lines: Iterable[str]) -> list[str]:
    return [line for line in lines if line.strip()]


def _first_difference(name: str, tool: str, expected: list[str], found: list[str]) -> str | None:
    for want, have in zip_longest(expected, found):
        if want != have:
            return f"{name}: {tool} gives {want!r} where the export has {have!r}"
    return None
