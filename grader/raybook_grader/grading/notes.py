"""What a run says of the class's rules before it begins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from ..policy import Policy
from ..submissions import Submission


def policy_lines(
    source: tuple[Path, str] | None, policy: Policy, submissions: Sequence[Submission]
) -> Iterator[str]:
    """Where the rules come from, and what in them or in the class may be a slip."""
    if source is None:
        return
    file, _ = source
    yield f"{file}: deadlines: {len(policy.deadlines)}; the {policy.counts} hand-in counts"
    students = {submission.id for submission in submissions}
    for extension in policy.extensions:
        if extension.student not in students:
            yield f"{file}: an extension is for {extension.student!r}, who has handed in nothing"
    timeless = sum(submission.time is None for submission in submissions)
    if policy.deadlines and timeless:
        yield (f"submissions without a time in their names, which count as on time: {timeless}")
