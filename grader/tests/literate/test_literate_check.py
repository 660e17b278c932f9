"""The rules across files, and between the source and the assignments."""

from __future__ import annotations

from pathlib import Path

import pytest
from literate_project import MEAN_C, write_project

from raybook_grader.literate.check import check, load_sound
from raybook_grader.literate.tree import UnsoundSourceError, build_tree, load_tree


def violations(texts: dict[str, str]) -> list[str]:
    tree = build_tree(Path("."), {name: text.encode() for name, text in texts.items()})
    return [str(violation) for violation in tree.violations]


def test_miniature_checkout_is_sound(tmp_path: Path) -> None:
    assert check(write_project(tmp_path)) == []


def test_duplicate_slug() -> None:
    fragment = "\n//> x: X\na\n//< x\n"
    assert violations({"src/a.c": fragment, "src/b.c": fragment}) == [
        "src/b.c:2: fragment x is already opened at src/a.c:2"
    ]


def test_continuation_before_its_opening() -> None:
    assert violations({"src/a.c": "//>+ x\n//< x\n//> x: X\n//< x\n"}) == [
        "src/a.c:1: //>+ x stands before //> x (line 3)"
    ]


def test_continuation_without_an_opening() -> None:
    assert violations({"src/a.c": "a\n//>+ x\n//< x\n"}) == [
        "src/a.c:2: //>+ x continues a fragment that is opened nowhere"
    ]


def test_continuation_of_a_fragment_in_a_solution() -> None:
    text = "#ifndef TODO_a\n//> x: X\ns();\n//< x\n#else\nt();\n#endif\n//>+ x\nb\n//< x\n"
    assert violations({"src/a.c": text}) == [
        "src/a.c:8: //>+ x continues a fragment that only a solution holds"
    ]


def test_todo_in_two_files() -> None:
    text = "#ifndef TODO_a\ns();\n#else\nt();\n#endif\n"
    assert violations({"src/a.c": text, "src/b.c": "\n" + text}) == [
        "src/b.c:2: TODO_a already stands at src/a.c:1"
    ]


def test_text_that_is_not_utf8() -> None:
    tree = build_tree(Path("."), {"src/a.c": b"a\nb\xff\n"})
    assert [str(v) for v in tree.violations] == ["src/a.c:2: not UTF-8 text"]


def test_all_violations_of_all_files_are_reported() -> None:
    assert len(violations({"src/a.c": "\ta\n//> x: X\n", "src/b.c": "//< y\n\tb\n"})) == 4


def test_index_and_title_of_a_continuation(tmp_path: Path) -> None:
    tree = load_tree(write_project(tmp_path))
    first, second = tree.fragments["disc.types"].pieces
    assert (tree.index(first), tree.index(second)) == (0, 1)
    assert second.continuation and tree.title(second) == "What a disc is"
    assert second.parent is not None and second.parent.slug == "disc.contract"


def test_headers_are_read_first(tmp_path: Path) -> None:
    tree = load_tree(write_project(tmp_path))
    assert list(tree.files) == ["src/shapes/disc.h", "src/shapes/disc.c", "src/shapes/mean.c"]


def test_todo_has_its_place_and_helpers(tmp_path: Path) -> None:
    todo = load_tree(write_project(tmp_path)).todos["disc_hit"]
    assert todo.file == "src/shapes/disc.c" and len(todo.helpers) == 1
    assert todo.place.middle is not None and todo.line > todo.helpers[0].ifndef


TOML_02 = "assignments/02-mean/assignment.toml"
BROKEN = {
    "exercise of no assignment": (
        {TOML_02: 'owned = ["src/shapes/mean.c"]\n'},
        ["src/shapes/mean.c:4: TODO_mean_pair is in the todos of no assignment"],
    ),
    "exercise without a TODO": (
        {TOML_02: 'owned = ["src/shapes/mean.c"]\n\ntodos = [\n  "mean_pair",\n  "median",\n]\n'},
        [f"{TOML_02}:5: todo median: no #ifndef TODO_median in src/"],
    ),
    "exercise in a file of another": (
        {TOML_02: 'owned = []\ntodos = ["mean_pair"]\n'},
        ["src/shapes/mean.c:4: TODO_mean_pair is assignment 02's, which does not own this file"],
    ),
    "exercise of two assignments": (
        {"assignments/03-more/assignment.toml": 'todos = ["mean_pair"]\n'},
        [
            "assignments/03-more/assignment.toml:1: todo mean_pair is already in "
            "assignments/02-mean/assignment.toml"
        ],
    ),
    "owned file that is not there": (
        {TOML_02: 'owned = ["src/shapes/mean.c", "src/no.c"]\ntodos = ["mean_pair"]\n'},
        [f"{TOML_02}:1: owned file src/no.c does not exist"],
    ),
    "todos of the wrong type": (
        {TOML_02: "todos = 3\n"},
        [
            f"{TOML_02}:1: todos: expected a list of strings",
            "src/shapes/mean.c:4: TODO_mean_pair is in the todos of no assignment",
        ],
    ),
    "no toml": (
        {TOML_02: "todos = [\n"},
        [
            f"{TOML_02}:1: Invalid value (at end of document)",
            "src/shapes/mean.c:4: TODO_mean_pair is in the todos of no assignment",
        ],
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_exercises_and_assignments_agree(tmp_path: Path, case: str) -> None:
    changes, expected = BROKEN[case]
    root = write_project(tmp_path, changes)
    assert [str(violation) for violation in check(root)] == expected
    with pytest.raises(UnsoundSourceError):
        load_sound(root)


def test_generated_files_may_be_owned(tmp_path: Path) -> None:
    toml = 'owned = ["compile_commands.json"]\n'
    assert check(write_project(tmp_path, {"assignments/00-build/assignment.toml": toml})) == []


def test_missing_source_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="src: no such folder"):
        load_tree(tmp_path)


def test_unsound_source_gives_no_tree(tmp_path: Path) -> None:
    root = write_project(tmp_path, {"src/shapes/mean.c": "\t" + MEAN_C})
    with pytest.raises(UnsoundSourceError, match=r"mean\.c:1: tab"):
        load_tree(root).require_sound()
