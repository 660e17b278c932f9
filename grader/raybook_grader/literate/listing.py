"""The files of a checkout, without what was built or left lying about."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

# A checkout without git: these folders, and their kind, hold nothing that a person wrote.
_JUNK_FOLDERS = {"build", "__pycache__"}
# Of the folders that begin with a dot: the set-up, and what the student edition has at its top.
_OURS = {".setup", ".ci", ".vscode", ".devcontainer", ".github"}
_JUNK_SUFFIXES = ("~", ".orig", ".rej", ".swp", ".pyc")


@dataclass(frozen=True)
class Listing:
    """Paths relative to the checkout, sorted. `left_out`: there, not ignored, but not in git."""

    files: tuple[str, ...]
    left_out: tuple[str, ...] = ()


def list_files(root: Path) -> Listing:
    """What git tracks, if `root` is the top of a checkout that tracks anything; else a walk."""
    if _is_git_top(root):
        tracked = _git_files(root, "--cached")
        if tracked:
            return Listing(tracked, _git_files(root, "--others", "--exclude-standard"))
    return Listing(_walk(root))


def _is_git_top(root: Path) -> bool:
    try:
        top = _git(root, "rev-parse", "--show-toplevel").decode().strip()
    except (OSError, subprocess.CalledProcessError):
        return False
    return Path(top).resolve() == root.resolve()


def _git_files(root: Path, *options: str) -> tuple[str, ...]:
    names = _git(root, "ls-files", "-z", *options).decode().split("\0")
    # git also lists what was deleted in the work tree and not yet in the index
    return tuple(sorted({name for name in names if name and (root / name).is_file()}))


def _git(root: Path, *arguments: str) -> bytes:
    # Inside a git hook these variables name another repository than root's.
    environment = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}
    command = ["git", "-C", str(root), *arguments]
    return subprocess.run(command, env=environment, capture_output=True, check=True).stdout


def _walk(root: Path) -> tuple[str, ...]:
    names: list[str] = []
    for folder, subfolders, files in os.walk(root):
        subfolders[:] = [s for s in subfolders if not _is_junk_folder(s)]
        names += [(Path(folder) / f).relative_to(root).as_posix() for f in files]
    return tuple(sorted(name for name in names if not name.endswith(_JUNK_SUFFIXES)))


def _is_junk_folder(name: str) -> bool:
    return name in _JUNK_FOLDERS or (name.startswith(".") and name not in _OURS)
