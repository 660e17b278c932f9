"""Right and slow is not wrong, and half-right earns what `assignment.toml` says."""

from __future__ import annotations

import math
import re

import pytest
from judge_table import Row, Table
from partial_credit import Earned, brighter_lamps, rules, trees


@pytest.fixture(scope="module")
def median() -> Earned:
    [earned] = trees(["median-quickselect"])
    return earned


def test_a_slow_tree_loses_nothing_for_being_right(median: Earned) -> None:
    assert len(median.right) >= 4
    assert [check.score for check in median.right] == [check.max_score for check in median.right]


def test_a_median_split_earns_what_the_rule_says(median: Earned) -> None:
    tree, walk = median.costs
    assert walk.score == walk.max_score
    [ratio] = re.findall(r"^([\d.]+) times as many", tree.message)
    rule = rules()[tree.name]
    share = math.log(rule.none / float(ratio)) / math.log(rule.none / rule.full)
    assert tree.score == pytest.approx(rule.points * share, abs=0.02)
    assert 0.4 < share < 0.65, "the rule says about half"


def test_a_small_bias_fails_and_earns_a_share() -> None:
    table = Table()
    small, large = (table.judge(brighter_lamps(share), look=0) for share in (0.02, 0.2))
    assert small.bias.status == large.bias.status == "fail"
    assert 70 >= small.score > 50 > 25 > large.score > 0


def test_nothing_wrong_costs_nothing() -> None:
    same: Row = brighter_lamps(0.0)
    judgement = Table().judge(same, look=0)
    assert (judgement.bias.status, judgement.score) == ("pass", 100)
