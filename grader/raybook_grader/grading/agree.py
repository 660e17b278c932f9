"""Whether a run may change published grades: only if somebody has seen the changes and agreed.

New grades, and those of students who handed in something else, need nobody's agreement. A grade
that another grader, kit, rubric, policy or a regrading would change does, and then all of the
run waits for it, so that the grades of one class are all of one grader.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from rich.console import Console

from ..jobs.progress import progress
from .changes import Change
from .plan import Order


def agree(found: Sequence[Change], order: Order, is_published: bool, console: Console) -> bool:
    """Say what changes; whether it is to be."""
    ours = [change for change in found if not change.is_theirs]
    lost = sum(change.is_lost for change in found)
    must_ask = is_published and bool(ours)
    may = not lost and order.apply
    word = "would change" if must_ask and not may else "changed"
    say = progress(console, "", 0).say
    for change in found:
        first, *rest = change.lines
        say(f"{word}: {first}")
        for line in rest:
            say(f"    {line}")
    if not must_ask:
        if order.regrade and not found:
            say("regraded: the grades stay as they are")
        return True
    students = len({change.student for change in ours})
    say(
        f"{len(ours)} published grades of {students} students {word} "
        "though nothing new was handed in for them"
    )
    if lost:
        say(
            f"nothing is applied: {lost} modules that have points are without them now, because "
            "the grader failed; mend the cause and give the same command again"
        )
        return False
    if may or _asked(console):
        return True
    say(
        "nothing is applied: grades.json and the reports stay as they are. The same command with "
        "--apply applies it; what was computed is kept"
    )
    return False


def _asked(console: Console) -> bool:
    """The answer of a person at a terminal; no when there is none."""
    if not (console.is_terminal and sys.stdin.isatty()):
        return False
    return console.input("Apply these changes? [y/N] ").strip().lower() in ("y", "yes")
