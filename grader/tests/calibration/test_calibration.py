"""What a calibration makes of its results: rows, figures and trials of the diagnosis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from raybook_grader.calibration.confusion import Row, row_of
from raybook_grader.calibration.false_fails import POOL, Count, disjoint_gradings, shares_of
from raybook_grader.calibration.judging import Compiler, moved
from raybook_grader.calibration.naming import Naming, library_of, namings, spoken
from raybook_grader.calibration.table import ModuleTable, is_good, summary, to_json, to_markdown
from raybook_grader.checks.result import CheckResult, Status
from raybook_grader.course import Assignment, ImageCheck, ProbeCheck, UnitCheck
from raybook_grader.course.model import Limits
from raybook_grader.diagnosis.trace import trace_of_cases
from raybook_grader.grading.result import ModuleResult, from_checks
from raybook_grader.kit import load_kit
from raybook_grader.museum import Exhibit, Twin
from raybook_grader.museum.label import Label
from raybook_grader.probes import Failure
from raybook_grader.scoring import Verdict

ROOT = Path(__file__).resolve().parents[3]
CHECKS = (
    UnitCheck("tests", 1, "test.c"),
    ProbeCheck("rays", 2, "probe.c", "oracle.py", "rays", 1, hidden=True),
    ImageCheck("picture", 1, "scene.json", (8, 8), 4, 8, hidden=True),
)
ASSIGNMENT = Assignment(
    Path("/none"), "01", "triangle", "Triangles", 4, False, ("src/a.c",), (), Limits(), CHECKS
)


def exhibit(slug: str, *expect: str) -> Exhibit:
    label = Label("what", "seen", expect, f"hint of {slug}") if expect else None
    return Exhibit("01", slug, {"src/a.c": slug.encode()}, label)


def result(*failing: str, wrong: Sequence[int] = (), share: float = 1.0) -> ModuleResult:
    """All three checks, of which the named ones fail; ``share`` is what the picture earns."""
    trace = trace_of_cases(100, [Failure(case, "wrong", "missed") for case in wrong])
    kinds = {"tests": "unit", "rays": "probe", "picture": "image"}
    checks = []
    for check in CHECKS:
        failed = check.name in failing
        earned = 0.0 if failed else check.points * (share if check.name == "picture" else 1)
        status = Status.FAILED if failed else Status.PASSED
        if not failed and earned < check.points:
            status = Status.PARTIAL
        checks.append(
            CheckResult(
                check.name, kinds[check.name], earned, check.points, status, "",
                trace=trace if check.name == "rays" and failed else {},
            )
        )  # fmt: skip
    return from_checks(checks)


def row(shown: Exhibit, *results: ModuleResult) -> Row:
    return row_of(ASSIGNMENT, shown, results)


def test_a_right_module_is_accepted_with_all_points() -> None:
    right = row(exhibit("alternative"), result(), result())
    assert right.accepted and not right.rejected and right.as_meant


@pytest.mark.parametrize(
    "results",
    [
        [result("rays")],
        [result("tests")],
        [result(share=0.9)],
        [result(), result("picture")],
        [replace(result(), verdict=Verdict.INTERNAL_ERROR)],
    ],
    ids=["probe", "public test", "noisier", "later picture", "harness"],
)
def test_a_right_module_that_loses_anything_is_not_as_meant(results: list[ModuleResult]) -> None:
    assert not row(exhibit("alternative"), *results).as_meant


def test_work_done_too_slowly_is_no_fault() -> None:
    slow = CheckResult("work", "cost", 0.4, 1.0, Status.PARTIAL, "")
    accepted = from_checks([*result().checks, slow])
    assert row(exhibit("median-split"), accepted).accepted


def test_a_mistake_is_rejected_by_exactly_what_its_label_announces() -> None:
    wrong = exhibit("mistake", "rays", "picture")
    assert row(wrong, result("rays", "picture")).as_meant
    assert not row(wrong, result("rays")).as_meant
    assert not row(wrong, result("rays", "picture", "tests")).as_meant


def test_a_picture_must_see_its_mistake_in_every_look() -> None:
    wrong = exhibit("mistake", "rays", "picture")
    seen = [result("rays", "picture"), result("picture")]
    assert row(wrong, *seen, result("picture")).as_meant
    assert not row(wrong, *seen, result()).as_meant


def test_public_tests_alone_reject_nothing() -> None:
    seen = row(exhibit("mistake", "tests"), result("tests"))
    assert seen.public == ("tests",) and not seen.rejected and not seen.as_meant


def table(rows: Sequence[Row], chance: Count, said: Sequence[Naming] = ()) -> ModuleTable:
    return ModuleTable("01", "triangle", tuple(rows), {"picture": chance}, tuple(said), ())


GOOD = [
    row(exhibit("reference"), result()),
    row(exhibit("mistake", "rays"), result("rays")),
]


def test_the_figures_have_the_keys_that_others_read() -> None:
    missed = row(exhibit("overlooked", "rays"), result())
    said = [
        Naming("01", "twin", "mistake", ("mistake",)),
        Naming("01", "mistake", "mistake", ("other", "mistake")),
        Naming("01", "lost", "mistake", ()),
    ]
    tables = [table([*GOOD, missed], Count(10, 0, 90, 1, 160), said)]
    figures = to_json(tables)
    assert figures["mistakes"] == {"total": 2, "rejected": 1, "missed": ["01/overlooked"]}
    assert figures["alternatives"] == {"total": 1, "accepted": 1, "refused": []}
    assert figures["diagnosis"] == {"total": 3, "top1": 1, "top2": 2, "spoken_of_right": []}
    assert figures["false_fails"] == {
        "gradings": 100, "failed": 1, "disjoint": 10, "disjoint_failed": 0,
    }  # fmt: skip
    assert figures["surprises"] == ["01/overlooked"]
    assert figures["modules"]["triangle"] == {k: v for k, v in figures.items() if k != "modules"}
    assert not is_good(tables)
    assert "mistakes rejected 1 of 2" in summary(tables)
    assert "overlooked" in to_markdown(tables) and "**not as meant**" in to_markdown(tables)


def test_good_is_nothing_missed_refused_or_failed_by_chance() -> None:
    assert is_good([table(GOOD, Count(10, 0, 90, 0, 160))])
    assert not is_good([table(GOOD, Count(10, 0, 90, 1, 160))])
    assert not is_good([table(GOOD, Count(10, 1, 90, 0, 160))])
    named = replace(table(GOOD, Count(10, 0, 90, 0, 160)), spoken=("01/reference",))
    assert not is_good([named])


@pytest.mark.parametrize("modules", [1, 2, 6, 9])
def test_a_pool_is_shared_out_in_whole_gradings(modules: int) -> None:
    size = 16
    shares = shares_of(modules, size)
    assert len(shares) == modules and all(share % size == 0 and share > 0 for share in shares)
    assert POOL <= sum(shares) < POOL + modules * size
    assert len(set(shares[1:])) <= 1


def test_disjoint_gradings_share_no_seed() -> None:
    gradings = list(disjoint_gradings(range(1000, 1050), 16))
    assert [len(seeds) for seeds in gradings] == [16, 16, 16]
    seen = [seed for seeds in gradings for seed in seeds]
    assert len(set(seen)) == len(seen) and set(seen) <= set(range(1000, 1050))


def test_a_mistake_is_named_by_a_museum_that_has_not_seen_it() -> None:
    """The mistake by its twin, the twin by the mistake; and neither by itself."""
    mistakes = [exhibit("first-half", "rays"), exhibit("odd-ones", "rays")]
    twin = Twin(exhibit("twins/first-half-again", "rays"), "first-half")
    results = {
        "01/first-half": result("rays", wrong=range(50)),
        "01/odd-ones": result("rays", wrong=range(1, 100, 2)),
        "01/twins/first-half-again": result("rays", wrong=range(49)),
    }
    first, second = namings(mistakes, [twin], results)
    assert (first.module, second.module) == ("twins/first-half-again", "first-half")
    assert first.first and second.first and second.among_two
    unlike = {**results, "01/twins/first-half-again": result("tests")}
    assert not any(naming.first for naming in namings(mistakes, [twin], unlike))


def test_silence_on_right_modules_is_counted() -> None:
    right, wrong = exhibit("reference"), exhibit("first-half", "rays")
    seen = result("rays", wrong=range(50))
    known = library_of([wrong], {wrong.name: seen})
    assert spoken([right], {right.name: result()}, known) == ()
    assert spoken([right], {right.name: seen}, known) == (right.name,)


def test_later_looks_are_at_the_pictures_alone_and_on_other_seeds() -> None:
    assert moved(ASSIGNMENT, 0) is ASSIGNMENT
    firsts = [moved(ASSIGNMENT, look).checks for look in (1, 2)]
    assert all(len(checks) == 1 and isinstance(checks[0], ImageCheck) for checks in firsts)
    seeds = [check.first_seed for checks in firsts for check in checks]  # type: ignore[union-attr]
    assert len({1, *seeds}) == 3


def test_another_compiler_is_for_the_students_modules_only() -> None:
    kit = load_kit(ROOT / "build" / "kit")
    other = Compiler("clang", "-O0").apply(kit)
    assert other.cc == "clang" and other.objects == kit.objects
    assert [flag for flag in other.cflags if flag.startswith("-O")] == ["-O0"]
    assert Compiler().apply(kit) == kit
    names = [Compiler(cc, level).name for cc in (None, "clang") for level in (None, "-O0")]
    assert names == ["", "-O0", "clang", "clang-O0"]
