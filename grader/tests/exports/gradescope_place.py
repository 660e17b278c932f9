"""Gradescope's layout in a scratch root: /autograder/source, submission, results, run_autograder.

The scripts see the real paths: bubblewrap puts the scratch folder at /autograder.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Collection
from pathlib import Path

from raybook_grader.literate.listing import list_files

CHECKOUT = Path(__file__).resolve().parents[3]


def small_course(root: Path, folders: Collection[str]) -> Path:
    """The checkout with a few assignments only, without pictures and known mistakes: quick."""
    assignments = tuple(f"assignments/{folder}/" for folder in folders)
    for name in list_files(CHECKOUT).files:
        other = name.startswith("assignments/") and not name.startswith(assignments)
        if other or name.split("/")[2:3] in (["mistakes"], ["twins"]):
            continue
        target = root / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(CHECKOUT / name, target)
    for folder in assignments:
        _drop_pictures(root / folder / "assignment.toml")
    (root / "build").mkdir()
    (root / "build" / "unity").symlink_to(CHECKOUT / "build" / "unity")
    return root


def _drop_pictures(rubric: Path) -> None:
    head, *checks = rubric.read_text(encoding="utf-8").split("[[check]]")
    kept = [check for check in checks if 'kind = "image"' not in check]
    lines = [line for check in kept for line in check.splitlines()]
    points = sum(float(line.split("=")[1]) for line in lines if line.startswith("points"))
    top = [f"points = {points:g}" if x.startswith("points") else x for x in head.splitlines()]
    rubric.write_text("\n".join(top) + "\n" + "".join(f"[[check]]{check}" for check in kept))


def lay_out(bundle: Path, place: Path) -> Path:
    """What Gradescope makes of a bundle; nothing is set up yet."""
    for name in ("source", "submission", "results"):
        (place / name).mkdir(parents=True)
    with zipfile.ZipFile(bundle) as archive:
        for entry in archive.infolist():
            path = Path(archive.extract(entry, place / "source"))
            path.chmod(entry.external_attr >> 16 & 0o777)
    shutil.copy(place / "source" / "run_autograder", place / "run_autograder")
    return place


def borrow_kit(place: Path) -> None:
    """In place of setup.sh: the checkout's own kit."""
    kit = CHECKOUT / "build" / "kit"
    assert (kit / "kit.json").is_file(), f"{kit} is not there: run `make kit` first"
    shutil.copytree(kit, place / "source" / "raybook" / "build" / "kit")


def run_there(place: Path, *command: str, sandbox: bool = True) -> subprocess.CompletedProcess[str]:
    """Run a command with the folder at /autograder, which is also the current one.

    Without ``sandbox`` no box can be made there: its program is missing.
    """
    box = ["bwrap", "--tmpfs", "/"]
    for entry in sorted(os.scandir("/"), key=lambda entry: entry.name):
        if entry.is_symlink():
            box += ["--symlink", os.readlink(entry.path), entry.path]
        elif entry.is_dir():
            box += ["--dev-bind", entry.path, entry.path]
    box += ["--bind", str(place), "/autograder", "--chdir", "/autograder"]
    if not sandbox:
        box += ["--ro-bind", "/dev/null", os.path.realpath(str(shutil.which("bwrap")))]
    environment = {**os.environ, "RAYBOOK_VENV": sys.prefix}
    return subprocess.run(
        [*box, *command], env=environment, capture_output=True, text=True, check=False
    )
