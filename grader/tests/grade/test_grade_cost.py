"""The `cost` check: what a ratio earns, what it is told as, and what it never forgives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import pytest
from test_grade_course import RUBRIC, course

from raybook_grader.checks.cost import check_cost, share_of, weigh
from raybook_grader.checks.program import HarnessFault, ModuleObjects, Workshop
from raybook_grader.checks.result import CheckResult, Status, kind_of
from raybook_grader.checks.subject import Stopped, Subject
from raybook_grader.course import Assignment, CostCheck, Limits, load_course
from raybook_grader.errors import BadInput
from raybook_grader.sandbox import BoxResult

CHECK = CostCheck("walk", 4, "driver.c", "oracle.py", "all", 1, full=1.2, none=4.8)

# The output is the cost in words; an "x" in it is a wrong answer.
ORACLE = """
from raybook_grader.probes import Cases, Failure
COUNTED = "triangles tested a ray"
def make_cases(group, seed):
    return Cases(b"", 10, None)
def judge(cases, output):
    wrong = [Failure(3, "far", "missed", 1.0), Failure(7, "case 7: near", "missed", 2.0)]
    return wrong if b"x" in output else []
def cost(cases, output):
    return float(output)
"""


@pytest.mark.parametrize(
    ("ratio", "share"),
    [
        (0.5, 1.0),
        (1.2, 1.0),
        (2.4, 0.5),  # half way from 1.2 to 4.8 in the logarithm
        (1.2 * 2**0.5, 0.75),
        (4.8, 0.0),
        (1000.0, 0.0),
    ],
)
def test_points_fall_with_the_logarithm(ratio: float, share: float) -> None:
    assert share_of(ratio, 1.2, 4.8) == pytest.approx(share)


@pytest.mark.parametrize(
    ("cost", "status", "score"),
    [
        (12.0, Status.PASSED, 4.0),
        (24.0, Status.PARTIAL, 2.0),
        (48.0, Status.FAILED, 0.0),
    ],
)
def test_a_ratio_is_told_in_words(cost: float, status: Status, score: float) -> None:
    result = weigh(CHECK, cost, 10.0, "triangles tested a ray")
    assert (result.status, result.score, result.kind) == (status, score, "cost")
    assert result.message == (
        f"{cost / 10:g} times as many triangles tested a ray as the reference ({cost:g} against "
        "10; all points up to 1.2 times, none from 4.8 times)"
    )


@dataclass
class Box:
    """Answers each program with what it is given for it; counts the runs."""

    answers: dict[bytes, BoxResult]
    runs: list[bytes] = field(default_factory=list)

    def run(self, command: list[str], **given: Any) -> BoxResult:
        program: bytes = given["inputs"]["/program"]
        self.runs.append(program)
        assert command == ["/program", "cases.bin", "results.bin", "all"]
        return self.answers[program]


class Programs:
    """In place of a `Workshop`: the "programs" are names."""

    def __init__(self, student: BoxResult, reference: BoxResult) -> None:
        self.box = Box({b"student": student, b"reference": reference})

    def driver(self, module: object, source: Path) -> bytes:
        return b"student" if module else b"reference"


def answer(text: bytes) -> BoxResult:
    return BoxResult("exited", exit_code=0, files={"results.bin": text})


Judge = Callable[[BoxResult, BoxResult], CheckResult]


@pytest.fixture
def assignment(tmp_path: Path) -> Assignment:
    (tmp_path / "oracle.py").write_text(ORACLE)
    limits = Limits(1, 100)
    return Assignment(tmp_path, "09", "m", "M", 4, False, ("a.c",), (), limits, (CHECK,))


def subject(assignment: Assignment, programs: Programs) -> Subject:
    workshop = cast(Workshop, programs)
    return Subject(workshop, assignment, ModuleObjects({}, {}, ""), b"")


@pytest.fixture
def judge(assignment: Assignment) -> Judge:
    return lambda student, reference: check_cost(
        CHECK, subject(assignment, Programs(student, reference))
    )


def test_the_cost_is_weighed_against_the_reference(judge: Judge) -> None:
    assert judge(answer(b"30"), answer(b"30")).status is Status.PASSED
    result = judge(answer(b"60"), answer(b"25"))
    assert (result.status, result.score) == (Status.PARTIAL, 2.0)
    assert result.message.startswith("2.4 times as many triangles tested a ray")
    assert kind_of(CHECK) == "cost"


def test_the_reference_runs_once(assignment: Assignment) -> None:
    programs = Programs(answer(b"50"), answer(b"25"))
    for _ in range(3):
        check_cost(CHECK, subject(assignment, programs))
    assert programs.box.runs.count(b"reference") == 1
    assert programs.box.runs.count(b"student") == 3


def test_wrong_answers_cost_all_points_however_cheap(judge: Judge) -> None:
    result = judge(answer(b"1x"), answer(b"25"))
    assert (result.status, result.score, result.cases) == (Status.FAILED, 0.0, ("case 7: near",))
    assert "counts for nothing" in result.message


def test_an_early_end_is_told(judge: Judge) -> None:
    result = judge(BoxResult("exited", exit_code=3), answer(b"25"))
    assert (result.status, result.fingerprint) == (Status.FAILED, "ended too early")


def test_a_run_that_never_ends_is_a_timeout(judge: Judge) -> None:
    with pytest.raises(Stopped) as stop:
        judge(BoxResult("timeout", "no answer after 2 s"), answer(b"25"))
    assert stop.value.problem.status is Status.TIMEOUT


@pytest.mark.parametrize("reference", [b"2x", b"0", b"-1", b"nan", b"inf"])
def test_a_reference_that_cannot_be_counted_is_the_harness_s_fault(
    judge: Judge, reference: bytes
) -> None:
    with pytest.raises(HarnessFault):
        judge(answer(b"25"), answer(reference))


def test_a_reference_that_gives_no_answer_is_the_harness_s_fault(judge: Judge) -> None:
    with pytest.raises(HarnessFault, match="the reference"):
        judge(answer(b"25"), BoxResult("timeout", "no answer"))


def test_an_oracle_that_cannot_count_is_the_harness_s_fault(assignment: Assignment) -> None:
    (assignment.folder / "oracle.py").write_text(ORACLE.replace("COUNTED", "OTHER"))
    with pytest.raises(HarnessFault, match="expected a CostOracle"):
        check_cost(CHECK, subject(assignment, Programs(answer(b"1"), answer(b"1"))))


# --- The rubric ---------------------------------------------------------------------------------

COST = """kind = "cost"
driver = "driver.c"
oracle = "oracle.py"
group = "all"
seed = 1
full = 1.2
none = 4.8
"""
BEGIN, END = RUBRIC.index('kind = "image"'), RUBRIC.index("hidden = true")
HEAD = RUBRIC[:BEGIN]


def rubric_with(tmp_path: Path, old: str, new: str) -> Path:
    folder = tmp_path / "assignments" / "01-triangle"
    folder.mkdir(parents=True)
    (folder / "driver.c").write_text("")
    (folder / "oracle.py").write_text("")
    assert old in COST
    return course(tmp_path, HEAD + "points = 2\n" + COST.replace(old, new) + RUBRIC[END:])


def test_the_rubric_of_a_cost_is_read(tmp_path: Path) -> None:
    loaded = load_course(rubric_with(tmp_path, "seed", "seed"))
    assert loaded.assignment("01").checks[1] == CostCheck(
        "picture", 2.0, "driver.c", "oracle.py", "all", 1, 1.2, 4.8, True
    )


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("full = 1.2", "", "check 2, full: is missing"),
        ("none = 4.8", "none = 1.1", "full: is 1.2, with none = 1.1, expected 1 <= full < none"),
        ("none = 4.8", "none = 1.2", "expected 1 <= full < none"),
        ("full = 1.2", "full = 0.9", "expected 1 <= full < none"),
        ("seed = 1", "seeds = 1", "check 2, seed: is missing"),
    ],
)
def test_faults_of_the_rubric(tmp_path: Path, old: str, new: str, words: str) -> None:
    with pytest.raises(BadInput) as fault:
        load_course(rubric_with(tmp_path, old, new))
    assert words in str(fault.value)
