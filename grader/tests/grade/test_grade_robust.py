"""The `robust` check, in the box: what the sanitizers find, and how it is told."""

from __future__ import annotations

from dataclasses import replace

import pytest
from make_class import CHECKOUT, OWNED, solution

from raybook_grader.checks.probe import check_probe
from raybook_grader.checks.result import Status, conclude, kind_of
from raybook_grader.checks.robust import check_robust, confirm
from raybook_grader.checks.sanitizers import finding
from raybook_grader.checks.subject import Stopped, Subject
from raybook_grader.course import Limits, ProbeCheck, RobustCheck, StatisticsCheck, load_course
from raybook_grader.grading.job import Worker

CASES = ("hidden/probe_triangle.c", "hidden/oracle_triangle.py", "edges", 1)
ROBUST = RobustCheck("robust", 1, *CASES)
PROBE = ProbeCheck("edges", 2, *CASES)
BEGIN = "    //> triangle.intersect.system"

# What each line does in the middle of a right module, and what is said of it.
FAULTS = {
    "heap-buffer-overflow": (
        "float *volatile a = malloc(12); a[3] = p[0].x; free(a);",
        "heap-buffer-overflow: goes beyond the end of memory from malloc, writing 4 bytes",
    ),
    "stack-buffer-overflow": (
        "float a[3] = {0}; float *volatile b = a; b[3] = p[0].x;",
        "stack-buffer-overflow: goes beyond the end of a local array, writing 4 bytes",
    ),
    "heap-use-after-free": (
        "float *a = malloc(12); free(a); *(volatile float *)a = p[0].x;",
        "heap-use-after-free: uses memory after it was freed, writing 4 bytes",
    ),
    "double-free": (
        "void *volatile a = malloc(4); free(a); free(a);",
        "double-free: frees the same memory twice",
    ),
    "division by zero": ("volatile int a = 1, b = 0; a /= b;", "division by zero"),
    "signed integer overflow": (
        "volatile int a = 2147483647; a = a + 1;",
        "signed integer overflow: 2147483647 + 1 cannot be represented in type 'int'",
    ),
    "index ... out of bounds": (
        "int a[2] = {0}; volatile int i = 2; a[0] = a[i];",
        "index 2 out of bounds for type 'int [2]'",
    ),
    "nan is outside the range of representable values": (
        "volatile float a = NAN; volatile int b = (int)a; (void)b;",
        "nan is outside the range of representable values of type 'int'",
    ),
    "load of null pointer": (
        "int *volatile a = 0; volatile int b = *a; (void)b;",
        "load of null pointer of type 'int'",
    ),
}


@pytest.fixture(scope="module")
def right() -> Subject:
    """The reference's module, built."""
    workshop = Worker(CHECKOUT, CHECKOUT / "build" / "kit").workshop()
    assignment = load_course(CHECKOUT).assignment("01")
    module = workshop.compile_module(assignment, {OWNED: solution().encode()})
    return Subject(workshop, assignment, module, b"")


def with_line(right: Subject, line: str) -> Subject:
    """A module that does something more before it does its work."""
    text = solution()
    assert text.count(BEGIN) == 1
    text = "#include <stdlib.h>\n" + text.replace(BEGIN, f"    {line}\n{BEGIN}")
    module = right.workshop.compile_module(right.assignment, {OWNED: text.encode()})
    return replace(right, module=module)


def test_a_right_module_passes(right: Subject) -> None:
    result = check_robust(ROBUST, right)
    assert (result.kind, result.status, result.score) == ("robust", Status.PASSED, 1)


@pytest.mark.parametrize("kind", FAULTS)
def test_what_the_sanitizers_find_is_told_in_words(right: Subject, kind: str) -> None:
    line, words = FAULTS[kind]
    subject = with_line(right, line)
    result = check_robust(ROBUST, subject)
    place = 1 + subject.module.files[OWNED].decode().split("\n").index(f"    {line}")
    assert (result.status, result.fingerprint) == (Status.FAILED, kind)
    assert result.cases == (f"{OWNED}, line {place}: {words}",)
    assert result.words == line


def test_undefined_behaviour_that_happens_to_work_fails_here_only(right: Subject) -> None:
    subject = with_line(right, FAULTS["signed integer overflow"][0])
    assert check_probe(PROBE, subject).status is Status.PASSED
    assert check_robust(ROBUST, subject).status is Status.FAILED


def test_leaks_and_infinities_are_no_errors(right: Subject) -> None:
    line = "volatile float a = 0.0f, b = 1.0f / a; (void)b; (void)malloc(8);"
    assert check_robust(ROBUST, with_line(right, line)).status is Status.PASSED


def test_an_end_before_the_last_case_is_no_pass(right: Subject) -> None:
    with pytest.raises(Stopped) as stop:
        check_robust(ROBUST, with_line(right, "abort();"))
    assert stop.value.problem.status is Status.CRASH
    result = check_robust(ROBUST, with_line(right, "_Exit(0);"))
    assert (result.status, result.fingerprint) == (Status.FAILED, "ended too early")


def test_memory_is_limited_all_the_same(right: Subject) -> None:
    small = replace(right.assignment, limits=Limits(10, 64))
    hungry = "for (;;) { char *a = malloc(4096); for (int i = 0; i < 4096; i++) a[i] = 1; }"
    with pytest.raises(Stopped) as stop:
        check_robust(ROBUST, replace(with_line(right, hungry), assignment=small))
    assert stop.value.problem.status is Status.MEMORY


def test_words_of_other_code_and_addresses_are_left_out() -> None:
    said = (
        b"/kit/include/base/vec.h:9:3: runtime error: member access within misaligned address "
        b"0x7ffd12 for type 'struct a'\n    #0 0x55d in f include/base/vec.h:9\n"
        b"    #1 0x55e in g src/accel/bvh.c:77\n    #2 0x55f in main probe.c:3\n"
    )
    found = finding(said, {"src/accel/bvh.c": b"\n" * 100})
    assert found is not None
    assert found.message == (
        "src/accel/bvh.c, line 77: member access within misaligned address ... for type 'struct a'"
    )
    elsewhere = finding(said, {"src/accel/aabb.c": b"\n" * 100})
    assert elsewhere is not None and elsewhere.path == ""
    assert finding(b"nothing to see", {"src/accel/bvh.c": b"\n" * 100}) is None


def test_a_module_that_does_nothing_is_not_paid_for_it() -> None:
    told = [conclude(ROBUST, Status.PASSED, ""), conclude(PROBE, Status.FAILED, "")]
    assert [r.status for r in confirm(told)] == [Status.UNCONFIRMED, Status.FAILED]
    passed = conclude(StatisticsCheck("chi-squared", 1, *CASES), Status.PASSED, "")
    assert confirm([*told, passed])[0].status is Status.PASSED


def test_kinds_have_their_words() -> None:
    assert kind_of(ROBUST) == "robust"
    assert kind_of(StatisticsCheck("chi-squared", 1, *CASES)) == "statistics"
