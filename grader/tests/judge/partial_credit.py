"""What half-right work earns: each line beside the rule of `assignment.toml` that says so.

Printed by `make judge-table`. A tree may be right and slow, and a picture a little wrong: neither
is worth nothing, and the points that are lost follow from a count or from a visible error.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from judge_table import CHECKOUT, Row, Scene, Table, image_check

from raybook_grader.checks.program import Workshop
from raybook_grader.checks.reference import References
from raybook_grader.checks.result import CheckResult
from raybook_grader.course import CostCheck, ProbeCheck, load_course
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.kit import load_kit
from raybook_grader.museum import exhibits_of
from raybook_grader.sandbox import Box
from raybook_grader.submissions import SubmittedFile

TREES = (
    ("sah-sweep", "SAH along all axes"),
    ("lbvh-morton", "splits along a Morton curve"),
    ("median-quickselect", "splits at the median"),
    ("first-child-first", "SAH, but the walk takes no order"),
)
"""Exhibits of assignment 03 that are right, and what they do."""

_LAMP = "scenes/test/lamp-near-floor.json"


@dataclass(frozen=True)
class Earned:
    """What one tree earns: all its checks but the tests', the sanitizers' and the picture."""

    what: str
    checks: Sequence[CheckResult]

    @property
    def costs(self) -> list[CheckResult]:
        return [check for check in self.checks if check.kind == "cost"]

    @property
    def right(self) -> list[CheckResult]:
        """What asks whether it is right, not how fast."""
        return [check for check in self.checks if check.kind != "cost"]


def trees(slugs: Sequence[str]) -> Iterator[Earned]:
    """The trees of these exhibits, judged."""
    course = load_course(CHECKOUT)
    workshop = Workshop(course, load_kit(CHECKOUT / "build" / "kit"), Box())
    grader = ModuleGrader(workshop, References(workshop))
    assignment = course.assignment("03")
    asked = tuple(c for c in assignment.checks if isinstance(c, (ProbeCheck, CostCheck)))
    exhibits = {exhibit.slug: exhibit for exhibit in exhibits_of(CHECKOUT, assignment)}
    for slug in slugs:
        files = {path: SubmittedFile(text) for path, text in exhibits[slug].files.items()}
        result = grader.grade(replace(assignment, checks=asked), files)
        yield Earned(dict(TREES)[slug], result.checks)


def rules() -> dict[str, CostCheck]:
    """The rules of the costs, by the checks' names."""
    checks = load_course(CHECKOUT).assignment("03").checks
    return {check.name: check for check in checks if isinstance(check, CostCheck)}


def brighter_lamps(share: float) -> Row:
    """A lamp that is brighter by this share than it should be."""

    def change(scene: Scene) -> Scene:
        lamps = [_brighter(thing, 1 + share) for thing in scene["objects"]]
        return {"objects": lamps}

    return Row(f"lamps {share:+.1%}", _LAMP, True, change)


def _brighter(thing: Scene, factor: float) -> Scene:
    if "light" not in thing:
        return thing
    light = thing["light"]
    return {**thing, "light": {**light, "radiance": [factor * x for x in light["radiance"]]}}


def print_table() -> None:
    """All of it; about a minute."""
    for earned in trees([slug for slug, _ in TREES]):
        full = all(check.score == check.max_score for check in earned.right)
        print(f"{earned.what}: {'all' if full else 'NOT all'} points for what is right")
        for check in earned.costs:
            print(f"    {check.score:g} of {check.max_score:g}, {check.name}: {check.message}")
    table = Table()
    points = image_check(load_course(CHECKOUT), _LAMP).points
    for share in (0.0, 0.005, 0.02, 0.05, 0.2):
        said = table.judge(brighter_lamps(share), look=0)
        print(
            f"lamps {share:+.1%}: {said.bias.status}, visible error scored {said.score:.0f} of "
            f"100: {points * said.score / 100:.2f} of {points:g} points"
        )


if __name__ == "__main__":
    print_table()
