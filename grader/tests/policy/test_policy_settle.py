"""The arithmetic of what counts: late days, penalties, best or last, decisions."""

from __future__ import annotations

import random
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

import pytest

from raybook_grader.policy import Attempt, Counts, Late, Override, Policy, Settled, settle
from raybook_grader.policy.settle import late_days_used

DUE = {
    "01": datetime(2026, 10, 1, 12, tzinfo=UTC),
    "02": datetime(2026, 11, 1, 12, tzinfo=UTC),
    "03": datetime(2026, 12, 1, 12, tzinfo=UTC),
}
TEN = Late(days=0, percent_per_day=10, percent_at_most=50)


def late(number: str, days: float, score: float | None = 10) -> Attempt:
    """An attempt that comes so many days after its deadline; whole ones come just in time."""
    return Attempt(DUE[number] + timedelta(days=days), score)


def policy(rules: Late = TEN, counts: Counts = Counts.LAST) -> Policy:
    return Policy(late=rules, counts=counts, deadlines=DUE)


def one(attempts: Sequence[Attempt], rules: Policy) -> Settled:
    return settle(rules, "s1", {"01": attempts})["01"]


@pytest.mark.parametrize(
    ("days", "score", "percent"),
    [
        (-3, 10, None),
        (0, 10, None),
        (1 / 86400, 9, 10),
        (1, 9, 10),
        (1.5, 8, 20),
        (5, 5, 50),
        (6, 5, 50),
        (300, 5, 50),
    ],
)
def test_the_penalty_grows_to_its_maximum(days: float, score: float, percent: float | None) -> None:
    found = one([late("01", days)], policy())
    assert (found.raw_score, found.score) == (10, score)
    assert (found.penalty and found.penalty.percent) == percent
    assert found.penalty is None or found.penalty.points == 10 - score


def test_per_cent_of_what_was_earned_to_the_cent() -> None:
    found = one([late("01", 1, 3.33)], policy(Late(percent_per_day=15)))
    assert found.score == 2.83
    assert found.penalty is not None and found.penalty.points == 0.5


def test_no_time_and_no_deadline_are_on_time() -> None:
    assert one([Attempt(None, 7)], policy()).penalty is None
    found = settle(policy(), "s1", {"09": [Attempt(datetime(2099, 1, 1, tzinfo=UTC), 7)]})
    assert found["09"].score == 7 and found["09"].penalty is None


@pytest.mark.parametrize(
    ("budget", "spent", "scores"),
    [
        (0, (0, 0, 0), (8, 9, 7)),
        (1, (1, 0, 0), (9, 9, 7)),
        (3, (2, 1, 0), (10, 10, 7)),
        (5, (2, 1, 2), (10, 10, 9)),
        (9, (2, 1, 3), (10, 10, 10)),
    ],
)
def test_late_days_are_spent_in_the_order_of_deadlines(
    budget: int, spent: tuple[int, ...], scores: tuple[float, ...]
) -> None:
    attempts = {"03": [late("03", 3)], "01": [late("01", 2)], "02": [late("02", 1)]}
    found = settle(policy(Late(budget, 10)), "s1", attempts)
    penalties = [found[n].penalty for n in DUE]
    assert tuple(p.late_days for p in penalties if p) == spent
    assert tuple(found[n].score for n in DUE) == scores
    assert late_days_used(found) == sum(spent)
    assert list(found) == ["03", "01", "02"], "nothing else is put in order"


def test_required_modules_come_before_optional_ones() -> None:
    attempts = {"01": [late("01", 2)], "02": [late("02", 2)]}
    found = settle(policy(Late(2, 10)), "s1", attempts, optional={"01"})
    assert (found["01"].score, found["02"].score) == (8, 10)


def test_work_that_earned_nothing_spends_nothing() -> None:
    attempts = {"01": [late("01", 2, 0)], "02": [late("02", 2)]}
    found = settle(policy(Late(2, 10)), "s1", attempts)
    assert (found["01"].score, found["02"].score) == (0, 10)


def test_an_unknown_score_stays_unknown_and_keeps_its_late_days() -> None:
    attempts = {"01": [late("01", 1, None)], "02": [late("02", 1)]}
    found = settle(policy(Late(1, 10)), "s1", attempts)
    assert found["01"].score is None and found["02"].score == 9
    assert found["01"].penalty is not None and found["01"].penalty.points is None


@pytest.mark.parametrize(
    ("attempts", "counts", "place", "score"),
    [
        ([late("01", -1, 6), late("01", 1, 10)], Counts.LAST, 1, 9),
        ([late("01", -1, 6), late("01", 1, 10)], Counts.BEST, 1, 9),
        ([late("01", -1, 9), late("01", 5, 10)], Counts.LAST, 1, 5),
        ([late("01", -1, 9), late("01", 5, 10)], Counts.BEST, 0, 9),
        ([late("01", -1, 9), late("01", 1, 10)], Counts.BEST, 0, 9),
        ([late("01", -2, 8), late("01", -1, 3)], Counts.LAST, 1, 3),
        ([late("01", -2, 8), late("01", -1, 3)], Counts.BEST, 0, 8),
        ([late("01", -2, 8), late("01", -1, None)], Counts.BEST, 1, None),
        ([late("01", -2, None), late("01", -1, 8)], Counts.LAST, 1, 8),
        ([late("01", -2, None), late("01", -1, 8)], Counts.BEST, 0, None),
    ],
)
def test_best_or_last(
    attempts: Sequence[Attempt], counts: Counts, place: int, score: float | None
) -> None:
    found = one(attempts, policy(counts=counts))
    assert (found.attempt, found.score) == (place, score)


def test_late_days_help_the_best_and_are_spent_by_it_alone() -> None:
    rules = policy(Late(2, 50), Counts.BEST)
    attempts = {"01": [late("01", 0, 7), late("01", 1, 8)], "02": [late("02", 1, 10)]}
    found = settle(rules, "s1", attempts)
    assert (found["01"].attempt, found["01"].score, found["02"].score) == (1, 8, 10)
    attempts["01"] = [late("01", 0, 9), late("01", 1, 8)]
    attempts["02"] = [late("02", 2, 10)]
    found = settle(rules, "s1", attempts)
    assert (found["01"].attempt, found["02"].score) == (0, 10)


def test_a_decision_stands_above_everything() -> None:
    decision = Override(4.5, "copied", "prof", "2026-12-24")
    attempts = {"01": [late("01", 3)], "02": [late("02", 1)]}
    found = settle(policy(Late(3, 10)), "s1", attempts, overrides={"01": decision})
    assert (found["01"].raw_score, found["01"].score) == (10, 4.5)
    assert found["01"].override == decision
    assert found["02"].score == 9, "its late days are spent all the same"
    found = settle(policy(), "s1", {"01": [late("01", 0, None)]}, overrides={"01": decision})
    assert found["01"].score == 4.5


def test_random_classes_keep_the_rules() -> None:
    source = random.Random(6)
    for _ in range(500):
        rules = policy(
            Late(source.randrange(6), source.choice([0, 5, 30, 100]), source.choice([0, 40, 100])),
            source.choice(list(Counts)),
        )
        attempts = {
            number: [
                late(number, source.uniform(-3, 8), source.choice([0, 2.5, 7, 10]))
                for _ in range(source.randrange(1, 4))
            ]
            for number in DUE
        }
        found = settle(rules, "s1", attempts, optional={"02"})
        assert late_days_used(found) <= rules.late.days
        for number, settled in found.items():
            assert settled.raw_score == attempts[number][settled.attempt].score
            assert settled.score is not None and settled.raw_score is not None
            least = settled.raw_score * (1 - rules.late.percent_at_most / 100)
            assert least - 0.01 <= settled.score <= settled.raw_score
            penalty = settled.penalty
            assert penalty is None or penalty.late_days <= penalty.days_late
