"""From what Gradescope hands over to what `grade` reads: a folder that holds one submission.

Students drop single files on Gradescope's page, so that `triangle.c` arrives without its folder.
A file at the top with the name of an owned file goes to that file's usual place, if nothing is
there already.
"""

from __future__ import annotations

import os
import shutil
import stat
from collections.abc import Collection
from pathlib import Path, PurePosixPath

NAME = "submission"


def collect(submission: Path, owned: Collection[str], folder: Path) -> Path:
    """Copy the submission into ``folder``, which is then a class of one; links stay links."""
    target = folder / NAME
    shutil.copytree(submission, target, symlinks=True, ignore=_special)
    for path in owned:
        dropped = target / PurePosixPath(path).name
        place = target / path
        if _is_file(dropped) and not os.path.lexists(place):
            try:
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(dropped, place, follow_symlinks=False)
            except OSError:
                # Something that is no folder is in the way: the grader says what is missing.
                continue
    return folder


def _special(folder: str, names: list[str]) -> list[str]:
    """Pipes and the like, which a copy would wait for."""
    return [name for name in names if not _is_plain(os.lstat(os.path.join(folder, name)).st_mode)]


def _is_plain(mode: int) -> bool:
    return stat.S_ISREG(mode) or stat.S_ISDIR(mode) or stat.S_ISLNK(mode)


def _is_file(path: Path) -> bool:
    return not path.is_symlink() and path.is_file()
