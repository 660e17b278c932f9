"""The diagnosis on what it has not learnt: mistakes made again by another hand.

`assignments/*/twins` are judged by the grader's own checks, without pictures. Then each twin is
given to a diagnosis that knows the mistakes, and each mistake to one that knows its twin in its
place. `make test` does so with one assignment, which takes half a minute of processor time;
RAYBOOK_FULL=1 with all, which takes a quarter of an hour of it. That every twin applies and
compiles is tested always.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from rich.console import Console

from raybook_grader.calibration.naming import Naming, library_of, namings, spoken
from raybook_grader.course import load_course
from raybook_grader.grading.result import ModuleResult
from raybook_grader.museum import Exhibit, exhibits_of, twins_of
from raybook_grader.museum.visit import Visitor, visit_all, with_museum

ROOT = Path(__file__).resolve().parents[3]
FULL = os.environ.get("RAYBOOK_FULL") == "1"
ASSIGNMENTS = {a.number: a for a in with_museum(load_course(ROOT))}
EXHIBITS = {a.number: exhibits_of(ROOT, a) for a in ASSIGNMENTS.values()}
TWINS = {a.number: twins_of(ROOT, a) for a in ASSIGNMENTS.values()}
NAMED = {t.exhibit.name: t for twins in TWINS.values() for t in twins}
JUDGED = tuple(ASSIGNMENTS) if FULL else ("01",)
ENOUGH = 0.85


@pytest.fixture(scope="module")
def results() -> dict[str, ModuleResult]:
    """What the checks said of all exhibits and twins that are judged here, by name."""
    visitor = Visitor(ROOT, ROOT / "build" / "kit", images=False)
    exhibits = [e for number in JUDGED for e in EXHIBITS[number]]
    exhibits += [twin.exhibit for number in JUDGED for twin in TWINS[number]]
    cores = len(os.sched_getaffinity(0))
    visits = visit_all(visitor, exhibits, cores, Console(stderr=True))
    return {name: visit.result for name, visit in visits.items()}


def mistakes_of(number: str) -> list[Exhibit]:
    return [e for e in EXHIBITS[number] if not e.is_right]


def trials(results: dict[str, ModuleResult]) -> Iterator[Naming]:
    for number in JUDGED:
        yield from namings(mistakes_of(number), TWINS[number], results)


def test_there_are_enough_twins() -> None:
    assert len(NAMED) >= 36
    assert all(len(twins) >= 4 for twins in TWINS.values() if twins)


@pytest.mark.parametrize("name", NAMED)
def test_a_twin_compiles_and_differs_from_its_mistake(name: str, tmp_path: Path) -> None:
    twin = NAMED[name]
    (mistake,) = (e for e in EXHIBITS[twin.exhibit.assignment] if e.slug == twin.mistake)
    assert dict(twin.exhibit.files) != dict(mistake.files)
    for path, content in twin.exhibit.files.items():
        file = tmp_path / Path(path).name
        file.write_bytes(content)
        command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"]
        done = subprocess.run(
            [*command, f"-I{ROOT / 'src'}", str(file)], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr


def test_a_twin_is_not_taken_for_right(results: dict[str, ModuleResult]) -> None:
    names = [t.exhibit.name for number in JUDGED for t in TWINS[number]]
    assert [name for name in names if results[name].verdict in ("pass", "internal-error")] == []


def test_the_right_mistake_is_among_the_first_two(results: dict[str, ModuleResult]) -> None:
    done = list(trials(results))
    missed = [f"{n.assignment}/{n.module} is {n.mistake}, said {n.said}" for n in done
              if not n.among_two]  # fmt: skip
    first = sum(n.first for n in done)
    print(f"\n{len(done)} trials: right first {first}, among two {len(done) - len(missed)}")
    print("\n".join(missed))
    assert len(done) - len(missed) >= ENOUGH * len(done), "\n".join(missed)


def test_nothing_is_said_of_what_is_right(results: dict[str, ModuleResult]) -> None:
    for number in JUDGED:
        right = [e for e in EXHIBITS[number] if e.is_right]
        assert spoken(right, results, library_of(mistakes_of(number), results)) == ()
