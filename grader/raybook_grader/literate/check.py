"""The rules between the source and the assignments, and all violations of a checkout."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from .pieces import Violation
from .tree import SOURCE_FOLDER, SourceTree, UnsoundSourceError, load_tree


@dataclass(frozen=True)
class Assignment:
    """What the source must know of `assignments/NN-name/assignment.toml`.

    `file` is the toml's name relative to the checkout; `text` is all of it.
    """

    number: str
    file: str
    text: str
    todos: tuple[str, ...]
    owned: tuple[str, ...]

    @property
    def folder(self) -> str:
        """The assignment's folder, relative to the checkout."""
        return self.file.rpartition("/")[0]

    def line_of(self, value: str) -> int:
        """The first line that quotes a value of a list; 1 if none does."""
        for number, line in enumerate(self.text.splitlines(), 1):
            if f'"{value}"' in line or f"'{value}'" in line:
                return number
        return 1


def check(root: Path) -> list[Violation]:
    """Every violation of the checkout at `root`; an empty list means that it is sound."""
    tree = load_tree(root)
    assignments, faults = load_assignments(root)
    return [*tree.violations, *faults, *check_exercises(tree, assignments)]


def load_sound(root: Path) -> tuple[SourceTree, list[Assignment]]:
    """The tree and the assignments; raises UnsoundSourceError if `check` finds anything."""
    tree = load_tree(root)
    assignments, faults = load_assignments(root)
    violations = [*tree.violations, *faults, *check_exercises(tree, assignments)]
    if violations:
        raise UnsoundSourceError(violations)
    return tree, assignments


def load_assignments(root: Path) -> tuple[list[Assignment], list[Violation]]:
    """The assignments in the order of their folders, and what is wrong with their files."""
    assignments: list[Assignment] = []
    violations: list[Violation] = []
    for path in sorted(root.glob("assignments/*/assignment.toml")):
        name = path.relative_to(root).as_posix()
        text = path.read_text(encoding="utf-8")
        try:
            table = tomllib.loads(text)
            todos, owned = _strings(table, "todos"), _strings(table, "owned")
        except ValueError as fault:  # TOMLDecodeError is one
            violations.append(Violation(name, 1, str(fault)))
            continue
        number = path.parent.name.partition("-")[0]
        assignments.append(Assignment(number, name, text, todos, owned))
    return assignments, violations


def check_exercises(tree: SourceTree, assignments: Sequence[Assignment]) -> list[Violation]:
    """Each exercise stands in one file that its one assignment owns, and none is left over."""
    violations: list[Violation] = []
    named: dict[str, Assignment] = {}
    for assignment in assignments:
        violations += _check_owned(tree, assignment)
        for name in assignment.todos:
            violations += _check_todo(tree, assignment, name, named)
            named.setdefault(name, assignment)
    for todo in tree.todos.values():
        if todo.name not in named:
            message = f"TODO_{todo.name} is in the todos of no assignment"
            violations.append(Violation(todo.file, todo.line, message))
    return violations


def _strings(table: Mapping[str, object], key: str) -> tuple[str, ...]:
    value = table.get(key, [])
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise ValueError(f"{key}: expected a list of strings")
    return tuple(value)


def _check_owned(tree: SourceTree, assignment: Assignment) -> list[Violation]:
    """An owned file of the source must exist; others (compile_commands.json) are made."""
    return [
        Violation(assignment.file, assignment.line_of(name), f"owned file {name} does not exist")
        for name in assignment.owned
        if name.startswith(f"{SOURCE_FOLDER}/") and not (tree.root / name).is_file()
    ]


def _check_todo(
    tree: SourceTree, assignment: Assignment, name: str, named: Mapping[str, Assignment]
) -> list[Violation]:
    line = assignment.line_of(name)
    if name in named:
        message = f"todo {name} is already in {named[name].file}"
        return [Violation(assignment.file, line, message)]
    todo = tree.todos.get(name)
    if todo is None:
        message = f"todo {name}: no #ifndef TODO_{name} in {SOURCE_FOLDER}/"
        return [Violation(assignment.file, line, message)]
    if todo.file not in assignment.owned:
        message = f"TODO_{name} is assignment {assignment.number}'s, which does not own this file"
        return [Violation(todo.file, todo.line, message)]
    return []
