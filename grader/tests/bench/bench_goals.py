"""The goals: what this renderer is to reach beside its peers.

A goal belongs to rows of a group, a name, perhaps a peer and a kind; one with an empty field
belongs to rows of any.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from bench_rows import Goal, Row


@dataclass(frozen=True)
class Target:
    """A goal and the rows that it is for."""

    goal: Goal
    group: str
    name: str
    peer: str = ""
    kind: str = ""

    def is_for(self, row: Row) -> bool:
        """Does it judge this row?"""
        return (
            (self.group, self.name) == (row.group, row.name)
            and self.peer in ("", row.peer)
            and self.kind in ("", row.kind)
        )


def _rays(name: str, peer: str, goals: Iterable[float], beyond: Iterable[float]) -> list[Target]:
    kinds = ("primary", "bounce", "shadow")
    return [
        Target(Goal(goal, more), "rays", name, peer, kind)
        for kind, goal, more in zip(kinds, goals, beyond, strict=True)
    ]


TARGETS = (
    *_rays("bvh", "embree", (0.55, 0.40, 0.42), (0.60, 0.45, 0.50)),
    *_rays("wide", "embree", (1.0, 0.93, 1.0), (1.1, 1.0, 1.1)),
    *_rays("wide-robust", "embree-robust", (1.1, 0.95, 1.1), (1.25, 1.0, 1.3)),
    Target(Goal(1.25, 1.0, at_least=False), "build", "wide", "embree"),
    Target(Goal(1.65, 1.8), "threads", "build"),
    Target(Goal(55, 40, at_least=False, of="figure"), "memory", "wide"),
    Target(Goal(1.8, 2.5), "images", "path", "mitsuba scalar_rgb"),
    Target(Goal(0.6, 0.85), "images", "path", "mitsuba llvm_ad_rgb"),
    Target(Goal(2, 4), "variance x time", "path", "mitsuba scalar_rgb"),
    Target(Goal(0.8, 1.5), "variance x time", "path", "mitsuba llvm_ad_rgb"),
    Target(Goal(1000), "work", "bvh", "linear"),
    Target(Goal(50, 200), "sampling", "sky by luminance"),
    Target(Goal(5, 2, at_least=False, of="figure"), "start", "first picture"),
    Target(Goal(10, 4, at_least=False, of="figure"), "start", "clean build"),
    Target(Goal(2, at_least=False, of="figure"), "loading", "obj"),
    Target(Goal(3, at_least=False, of="figure"), "large", "one mesh"),
    Target(Goal(300, at_least=False, of="figure"), "large", "instances"),
)


def with_goals(rows: Iterable[Row]) -> Iterator[Row]:
    """Each row with the goal that it has, if any."""
    for row in rows:
        goals = [target.goal for target in TARGETS if target.is_for(row)]
        yield replace(row, goal=goals[0] if goals else None)
