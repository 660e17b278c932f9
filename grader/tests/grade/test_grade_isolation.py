"""One module's fault costs no other module a point: each is judged with the reference around it."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path

import pytest
from make_class import CHECKOUT, OWNED, solution
from small_course import grades, run

from raybook_grader.course import Assignment, load_course
from raybook_grader.grading.key import Keys
from raybook_grader.kit import load_kit
from raybook_grader.museum import exhibits_of, reference_of
from raybook_grader.submissions import Submission, find_submissions

COURSE = load_course(CHECKOUT)
GRADED = [assignment for assignment in COURSE.assignments if assignment.is_graded]
TRIANGLE, BVH = COURSE.assignment("01"), COURSE.assignment("03")
SLOW = ("image", "unit", "robust")

Files = Mapping[str, bytes]


def write(folder: Path, files: Files) -> None:
    for path, content in files.items():
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)


def everything_right() -> Files:
    """What the best student hands in."""
    modules = [a for a in GRADED if a.sources]
    files = {p: text for a in modules for p, text in reference_of(CHECKOUT, a).files.items()}
    [artefacts] = [a for a in GRADED if not a.sources]
    return {**files, **dict.fromkeys(artefacts.owned, b"made with the tools")}


def broken(assignment: Assignment) -> Files:
    """The assignment's files with a mistake in them."""
    if not assignment.sources:
        return dict.fromkeys(assignment.owned, b"made by hand")
    wrong = [e for e in exhibits_of(CHECKOUT, assignment) if not e.is_right]
    return wrong[0].files


@pytest.fixture(scope="module")
def submissions(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Submission]:
    """ "right", and by an assignment's number the one where only that is broken."""
    folder = tmp_path_factory.mktemp("isolation")
    right = everything_right()
    write(folder / "right", right)
    for assignment in GRADED:
        write(folder / assignment.number, {**right, **broken(assignment)})
    owned = [path for assignment in GRADED for path in assignment.owned]
    found, _ = find_submissions(folder, owned)
    return {submission.id: submission for submission in found}


def keys_of(submission: Submission, keys: Keys) -> dict[str, str]:
    """What each module's result is made from, as a hash, as `grade` plans it."""
    return {
        a.number: keys.key(a, {p: f for p, f in submission.files.items() if p in a.owned})
        for a in GRADED
    }


def test_no_file_belongs_to_two_assignments() -> None:
    owned = [path for assignment in GRADED for path in assignment.owned]
    assert len(owned) == len(set(owned))


def test_a_broken_module_is_no_part_of_any_other_result(
    submissions: dict[str, Submission],
) -> None:
    keys = Keys(COURSE, load_kit(CHECKOUT / "build" / "kit"))
    right = keys_of(submissions["right"], keys)
    for assignment in GRADED:
        found = keys_of(submissions[assignment.number], keys)
        other = {number for number, key in found.items() if key != right[number]}
        assert other == {assignment.number}


# --- The promise of the syllabus, with the real command ------------------------------------------


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Assignments 01 and 03 by what is quick to judge."""
    root = tmp_path_factory.mktemp("isolated") / "course"
    root.mkdir()
    for shared in ("src", "build", "scenes"):
        (root / shared).symlink_to(CHECKOUT / shared)
    for assignment in (TRIANGLE, BVH):
        copy = root / "assignments" / assignment.folder.name
        shutil.copytree(assignment.folder / "hidden", copy / "hidden")
        text = (assignment.folder / "assignment.toml").read_text(encoding="utf-8")
        (copy / "assignment.toml").write_text(without(text, SLOW), encoding="utf-8")
    return root


def without(rubric: str, kinds: Iterable[str]) -> str:
    """An assignment.toml without the checks of these kinds, and worth as much less."""
    head, *checks = rubric.split("[[check]]")
    kept = [check for check in checks if not any(f'kind = "{kind}"' in check for kind in kinds)]
    lines = [line for check in kept for line in check.splitlines()]
    points = sum(float(line.split("=")[1]) for line in lines if line.startswith("points"))
    old = next(line for line in head.splitlines() if line.startswith("points"))
    head = head.replace(old, f"points = {points:g}")
    return head + "".join(f"[[check]]{check}" for check in kept)


def test_a_right_bvh_has_its_points_beside_a_broken_triangle(course: Path, tmp_path: Path) -> None:
    bvh = reference_of(CHECKOUT, BVH).files
    triangles = {
        "right": solution(),
        "no hits": solution().replace("return true;", "return false;"),
        "crashes": solution().replace("{", "{ *(volatile int *)0 = 1;", 1),
        "does not compile": solution() + "static int half_a_line(\n",
    }
    assert len(set(triangles.values())) == 4
    for name, text in triangles.items():
        write(tmp_path / "class" / name, {**bvh, OWNED: text.encode()})
    out = tmp_path / "out"
    ended = run("grade", tmp_path / "class", "--out", out, "--course", course)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    scores = modules_of(out)
    full = load_course(course)
    for name in triangles:
        assert scores[name]["03"] == full.assignment("03").points, name
        right = scores[name]["01"] == full.assignment("01").points
        assert right == (name == "right"), name


def modules_of(out: Path) -> dict[str, dict[str, float]]:
    """Scores by submission and assignment."""
    return {
        name: {module["assignment"]: module["score"] for module in submission["modules"]}
        for name, submission in grades(out).items()
    }
