"""A course of pictures that are judged without compiling anything, so that a class takes no time.

Three assignments of ten points, the last one optional. A hand-in is a word an assignment, such as
"ab": which of its two pictures (4 and 6 points) are there and right.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pytest

from raybook_grader.cli import main
from raybook_grader.judge.exr import encode_exr

CHECKOUT = Path(__file__).resolve().parents[3]
J = TypeVar("J")
R = TypeVar("R")

NUMBERS = ("01", "02", "03")
POINTS = {"a": 4, "b": 6}


def tiny_course(root: Path) -> Path:
    """Write the course."""
    kit = CHECKOUT / "build" / "kit" / "kit.json"
    assert kit.is_file(), f"{kit} is not there: run `make kit` first"
    root.mkdir(parents=True)
    for shared in ("src", "build", "scenes"):
        (root / shared).symlink_to(CHECKOUT / shared)
    for number in NUMBERS:
        write_rubric(root, number)
    return root


def write_rubric(root: Path, number: str, points: Mapping[str, int] = POINTS) -> None:
    """One assignment; other points make another rubric, by which all is judged anew."""
    lines = [
        f'number = "{number}"',
        f'module = "pictures{number}"',
        f'title = "Pictures {number}"',
        f"points = {sum(points.values())}",
        f"optional = {str(number == NUMBERS[-1]).lower()}",
        "owned = [" + ", ".join(f'"{number}{name}.exr"' for name in points) + "]",
    ]
    for name, worth in points.items():
        lines += [
            "[[check]]",
            f'name = "picture {name}"',
            'kind = "artefact"',
            f"points = {worth}",
            f'file = "{number}{name}.exr"',
            'expects = "picture"',
            'resolution = "8x8"',
        ]
    file = root / "assignments" / number / "assignment.toml"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("\n".join(lines) + "\n")


def pixels(right: bool, seed: int = 0) -> Any:
    side = 8 if right else 4
    return np.random.default_rng(seed).random((side, side, 3), dtype=np.float32)


@cache
def picture(right: bool, seed: int = 0) -> bytes:
    return encode_exr(pixels(right, seed))


def decode_here(workshop: object, files: Sequence[bytes], max_pixels: int) -> list[Any]:
    """The pixels of such pictures without a process of their own, which takes longer."""
    right = {picture(True, ord(letter)) for letter in POINTS}
    return [pixels(file in right) for file in files]


def hand_in(folder: Path, name: str, work: Mapping[str, str]) -> None:
    """One submission; what it says takes the place of what is there."""
    place = folder / name
    if place.exists():
        shutil.rmtree(place)
    place.mkdir(parents=True)
    for number, right in work.items():
        for letter in POINTS:
            file = place / f"{number}{letter}.exr"
            file.write_bytes(picture(letter in right, seed=ord(letter)))


class Run:
    """What a command did."""

    def __init__(self, code: int, out: str, err: str) -> None:
        self.code, self.out, self.err = code, out, err


def run(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], *arguments: str | Path
) -> Run:
    """Run a command in this process, which is quicker than a new one."""
    monkeypatch.setattr("sys.argv", ["raybook-grader", *map(str, arguments)])
    capsys.readouterr()
    try:
        code = main()
    except SystemExit as ended:
        code = int(ended.code or 0)
    said = capsys.readouterr()
    return Run(code, said.out, said.err)


def grades(out: Path) -> dict[str, Any]:
    """What `grades.json` holds, by student."""
    values = json.loads((out / "grades.json").read_text(encoding="utf-8"))
    return {submission["id"]: submission for submission in values["submissions"]}


def modules(out: Path, student: str) -> dict[str, Any]:
    """A student's modules by number."""
    return {module["assignment"]: module for module in grades(out)[student]["modules"]}


def here(jobs: Iterable[J], make: Callable[[], Callable[[J], R]], workers: int) -> Iterator[Any]:
    """What `run_jobs` does, in this process: a worker takes longer to start than all the work."""
    work = make()
    for job in jobs:
        yield job, work(job)
