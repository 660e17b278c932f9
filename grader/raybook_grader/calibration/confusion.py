"""The confusion table: what is right and what is wrong, against what the grader says."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..course import Assignment, ImageCheck, UnitCheck
from ..grading.result import ModuleResult
from ..museum import Exhibit
from ..museum.visit import faults
from ..scoring import Verdict


@dataclass(frozen=True)
class Row:
    """One exhibit. ``failed`` are the checks that saw something wrong in the first look;
    ``pictures`` says for each image check how many of ``looks`` it failed."""

    exhibit: Exhibit
    result: ModuleResult
    failed: tuple[str, ...]
    public: tuple[str, ...]
    pictures: Mapping[str, int]
    looks: int

    @property
    def accepted(self) -> bool:
        """Full points for correctness: only work done too slowly may cost some."""
        return self.result.verdict in (Verdict.PASS, Verdict.PARTIAL) and not any(
            check.kind != "cost" and check.score != check.max_score for check in self.result.checks
        )

    @property
    def rejected(self) -> bool:
        """Some check that students do not have sees the mistake."""
        return bool(set(self.failed) - set(self.public))

    @property
    def as_meant(self) -> bool:
        """Right and accepted in every look, or rejected by all that its label announces."""
        label = self.exhibit.label
        if label is None:
            return self.accepted and not any(self.pictures.values())
        announced = set(label.expect)
        seen = {name for name, count in self.pictures.items() if count == self.looks}
        return (
            self.rejected
            and announced == set(self.failed)
            and announced & set(self.pictures) == seen
        )

    @property
    def told(self) -> str:
        """What came out, and what was meant."""
        label = self.exhibit.label
        meant = "accepted" if label is None else "; ".join(label.expect)
        return (
            f"{self.exhibit.name}: {self.result.verdict}, failed: "
            f"{'; '.join(self.failed) or 'nothing'}; meant: {meant}; pictures failed: "
            f"{', '.join(f'{n} of {self.looks}' for n in self.pictures.values()) or 'none asked'}"
        )


def row_of(assignment: Assignment, exhibit: Exhibit, results: Sequence[ModuleResult]) -> Row:
    """The row of one exhibit from its looks, the first of which ran all checks."""
    first = results[0]
    pictures = [c.name for c in assignment.checks if isinstance(c, ImageCheck)]
    public = [c.name for c in assignment.checks if isinstance(c, UnitCheck)]
    failed = list(faults(exhibit, first.checks))
    seen = [set(faults(exhibit, result.checks)) for result in results]
    counts = {name: sum(name in found for found in seen) for name in pictures}
    return Row(
        exhibit,
        first,
        tuple(failed),
        tuple(name for name in failed if name in public),
        counts,
        len(results),
    )
