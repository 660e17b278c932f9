"""The museum's tables: which mistakes the public tests catch, and what else catches them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .visit import Visit


def lines_of(title: str, visits: Sequence[Visit]) -> Iterator[str]:
    """The table of one assignment as plain lines."""
    right = [v for v in visits if v.exhibit.is_right]
    wrong = [v for v in visits if not v.exhibit.is_right]
    yield f"{title}: {len(right)} right, {len(wrong)} mistakes"
    for v in right:
        yield f"  {'right':9}{v.exhibit.slug:34}{_points(v)}{_surprise(v)}"
    for v in wrong:
        seen = "public" if v.public else "hidden" if v.failed else "NOBODY"
        names = "; ".join(sorted(v.failed - v.public))
        yield f"  {seen:9}{v.exhibit.slug:34}{names}{_surprise(v)}"


def summary(visits: Sequence[Visit]) -> str:
    """One line for all."""
    right = [v for v in visits if v.exhibit.is_right]
    wrong = [v for v in visits if not v.exhibit.is_right]
    accepted = sum(not v.failed for v in right)
    rejected = sum(bool(v.failed) for v in wrong)
    public = sum(bool(v.public) for v in wrong)
    surprises = sum(not v.as_announced for v in visits)
    return (
        f"{accepted} of {len(right)} right modules accepted, {rejected} of {len(wrong)} mistakes "
        f"rejected ({public} of them by public tests already), {surprises} surprises"
    )


def _points(v: Visit) -> str:
    if v.result.score is None:
        return "no score"
    return f"{v.result.score:g} of {sum(c.max_score for c in v.result.checks):g} points"


def _surprise(v: Visit) -> str:
    if v.as_announced:
        return ""
    parts = []
    if v.result.verdict == "internal-error":
        parts.append("the grader failed")
    if more := v.failed - v.announced:
        parts.append("not announced: " + "; ".join(sorted(more)))
    if less := v.announced - v.failed:
        parts.append("announced, but passed: " + "; ".join(sorted(less)))
    return f"  << SURPRISE: {', '.join(parts)}"
