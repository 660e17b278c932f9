"""What of a checkout goes into the bundle: all that grades some assignments, and no more."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..course import Assignment
from ..errors import BadInput
from ..literate.listing import list_files

FOLDER = "raybook"
"""Where the checkout lies in the bundle."""

# The tests, the docs and the book stay at home, and so do all other assignments.
_WANTED = re.compile(
    r"Makefile|LICENSE|(src|scenes|\.setup)/.+|grader/(make_kit\.py|pyproject\.toml)"
    r"|grader/(raybook_grader|statistics)/.+"
)
_UNITY = ("unity.c", "unity.h", "unity_internals.h", "license.txt")

NOT_NEEDED = (
    "clang-format", "clangd", "valgrind", "git", "libembree-dev", "clang", "libclang-rt-dev",
    "libomp-dev", "libpangoft2-1.0-0", "libharfbuzz-subset0", "fonts-dejavu-core", "unifdef",
    "universal-ctags", "chromium", "poppler-utils",
)  # fmt: skip
"""Packages of `.setup/packages.txt` that only tests, the book and reports ask for."""

_PACKAGES = ".setup/packages.txt"


@dataclass(frozen=True)
class Packed:
    """One file of the bundle."""

    content: bytes
    executable: bool = False


@dataclass(frozen=True)
class Contents:
    """The files by their names in the zip, and those left out because git does not track them."""

    files: Mapping[str, Packed]
    left_out: tuple[str, ...]


def contents(root: Path, assignments: Collection[Assignment]) -> Contents:
    """Everything from the checkout, and Unity, which is fetched on the instructor's machine."""
    folders = [a.folder.relative_to(root).as_posix() + "/" for a in assignments]
    listing = list_files(root)
    files = {name: _packed(root / name) for name in listing.files if _is_wanted(name, folders)}
    if _PACKAGES in files:
        files[_PACKAGES] = Packed(_fewer_packages(files[_PACKAGES].content))
    files |= _unity(root)
    left_out = tuple(name for name in listing.left_out if _is_wanted(name, folders))
    return Contents({f"{FOLDER}/{name}": file for name, file in files.items()}, left_out)


def _is_wanted(name: str, folders: Collection[str]) -> bool:
    return bool(_WANTED.fullmatch(name)) or name.startswith(tuple(folders))


def _packed(file: Path) -> Packed:
    return Packed(file.read_bytes(), os.access(file, os.X_OK))


def _fewer_packages(text: bytes) -> bytes:
    lines = text.decode("utf-8").splitlines(keepends=True)
    return "".join(x for x in lines if x.split()[:1] not in [[p] for p in NOT_NEEDED]).encode()


def _unity(root: Path) -> dict[str, Packed]:
    folder = Path(os.environ.get("UNITY_ROOT") or root / "build" / "unity")
    found = {
        f"build/unity/{name}": _packed(folder / name)
        for name in _UNITY
        if (folder / name).is_file()
    }
    if len(found) < len(_UNITY) - 1:
        raise BadInput(f"{folder}: Unity is not there, expected what `make setup` fetches")
    return found
