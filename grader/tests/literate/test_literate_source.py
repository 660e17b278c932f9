"""The renderer's own source keeps the rules, and its student export is what other tools make."""

from __future__ import annotations

from pathlib import Path

import pytest

from raybook_grader.literate.check import check
from raybook_grader.literate.equivalence import preprocessor_differences, unifdef_difference
from raybook_grader.literate.export import export
from raybook_grader.literate.tree import SourceTree, load_tree

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def tree() -> SourceTree:
    return load_tree(ROOT)


def test_no_violation() -> None:
    assert [str(violation) for violation in check(ROOT)] == []


def test_there_are_exercises(tree: SourceTree) -> None:
    assert tree.todos, "src/ has no TODO: the tests of its export would test nothing"


def test_unifdef_agrees(tree: SourceTree) -> None:
    exercises = [source for source in tree.files.values() if source.regions]
    differences = [unifdef_difference(source, export(source)) for source in exercises]
    assert [difference for difference in differences if difference] == []


def test_preprocessor_agrees(tree: SourceTree) -> None:
    assert preprocessor_differences(tree) == []


def test_no_conditional_of_an_exercise_is_left(tree: SourceTree) -> None:
    for source in tree.files.values():
        for line in export(source).lines:
            assert not line.text.lstrip().startswith(("//>", "//<")), (source.name, line)
            for name in tree.todos:
                assert f"TODO_{name}" not in line.text, (source.name, line)
