"""`{fragment}`, `{source}`, `{exercise}`, `{solution}`, `{instructor}` and the two indices."""

from __future__ import annotations

import tomllib
from typing import ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective

from ..literate.pieces import Piece
from .book_nodes import (
    Woven,
    code_box,
    code_link,
    fragment_index,
    identifier_index,
    search_text,
    woven_of,
)
from .editions import BookLine
from .places import Place, Places, places_of


class BookDirective(SphinxDirective):
    """What every directive of the book knows."""

    @property
    def woven(self) -> Woven:
        return woven_of(self.env.app)

    @property
    def places(self) -> Places:
        return places_of(self.env)

    @property
    def place(self) -> Place:
        return Place(self.env.docname, self.get_source_info()[1])

    def fault(self, message: str) -> list[nodes.Node]:
        """A warning here, which fails the build."""
        return [self.state.document.reporter.warning(message, line=self.lineno)]

    def parsed(self, parent: nodes.Element) -> nodes.Element:
        """`parent` with the directive's content in it."""
        self.state.nested_parse(self.content, self.content_offset, parent)
        return parent

    def box(self, piece: Piece) -> list[nodes.Node]:
        """The piece, with the content as its caption."""
        key = self.woven.reader.key(piece)
        self.places.pieces[key].append(self.place)
        self.env.note_dependency(str(self.woven.reader.tree.root / piece.file))
        box = code_box("", key=key)
        lines = (i.text for i in self.woven.reader.items(piece) if isinstance(i, BookLine))
        box += search_text("", f"{self.woven.title(piece)}\n" + "\n".join(lines))
        return [self.parsed(box)]


class FragmentDirective(BookDirective):
    """`:::{fragment} slug`: all pieces of a fragment, or `:piece: 2`, its second."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar = {"piece": directives.positive_int}

    def run(self) -> list[nodes.Node]:
        slug = self.arguments[0]
        fragment = self.woven.reader.tree.fragments.get(slug)
        if fragment is None:
            return self.fault(f"fragment {slug}: no '//> {slug}: Title' in src/")
        wanted = self.options.get("piece")
        if wanted is not None and wanted > len(fragment.pieces):
            return self.fault(f"fragment {slug} has {len(fragment.pieces)} pieces")
        pieces = fragment.pieces[wanted - 1 : wanted] if wanted else fragment.pieces
        seen = [piece for piece in pieces if self.woven.reader.sees(piece)]
        if not seen:
            return [] if not self.woven.for_students else self._yours(pieces[0])
        return [node for piece in seen for node in self.box(piece)]

    def _yours(self, piece: Piece) -> list[nodes.Node]:
        """In place of a part of a solution: its title, for whoever is to write it."""
        line = nodes.paragraph(classes=["rb-yours"], ids=[self.woven.reader.key(piece)])
        line += nodes.inline("", f"⟨{self.woven.title(piece)}⟩", classes=["rb-title"])
        line += nodes.inline("", "yours to write", classes=["rb-place"])
        self.places.pieces[self.woven.reader.key(piece)].append(self.place)
        return [line]


class SourceDirective(BookDirective):
    """`:::{source} src/file.h`: what of a file is outside of its top-level fragments."""

    required_arguments = 1
    has_content = True

    def run(self) -> list[nodes.Node]:
        file = self.woven.reader.files.get(self.arguments[0])
        if file is None:
            return self.fault(f"source {self.arguments[0]}: no such module in the checkout")
        return self.box(file.root)


class ExerciseDirective(BookDirective):
    """`:::{exercise} todo_name Title`: a task of an assignment, and where it is to be done."""

    required_arguments = 1
    optional_arguments = 1
    final_argument_whitespace = True
    has_content = True

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        title = self.arguments[1] if len(self.arguments) > 1 else name
        if name not in self.woven.reader.tree.todos:
            return self.fault(f"exercise {name}: no TODO_{name} in src/")
        self.places.exercises[name].append(self.place)
        box = nodes.admonition(classes=["rb-exercise"], ids=[f"exercise-{name.replace('_', '-')}"])
        box += nodes.title("", f"Exercise: {title}")
        self.parsed(box)
        box += self._where(name)
        return [box]

    def _where(self, name: str) -> nodes.paragraph:
        """Where the code goes, what it is worth, how it is checked."""
        todo = self.woven.reader.tree.todos[name]
        line = self.woven.reader.line_number(todo.file, (todo.place.middle or todo.line) + 1)
        where = nodes.paragraph(classes=["rb-where"])
        key = self.woven.reader.key(todo.place.piece)
        link = code_link("", "", nodes.literal("", f"{todo.file}:{line}"), key=key)
        where += [nodes.Text("Your code goes to "), link]
        for assignment in self.woven.assignments:
            if name in assignment.todos:
                points = tomllib.loads(assignment.text).get("points", 0)
                worth = f"{points} points in all; " if points else ""
                where += nodes.Text(f". Assignment {assignment.number}: {worth}check it with ")
                where += nodes.literal("", f"make check A={assignment.number}")
        where += nodes.Text(".")
        return where


class SolutionDirective(BookDirective):
    """`:::{solution} [Title]`: notes for instructors; in the students' book never even parsed."""

    optional_arguments = 1
    final_argument_whitespace = True
    has_content = True

    def run(self) -> list[nodes.Node]:
        if self.woven.for_students:
            return []
        box = nodes.admonition(classes=["rb-solution"])
        box += nodes.title("", self.arguments[0] if self.arguments else "For instructors")
        return [self.parsed(box)]


class InstructorDirective(BookDirective):
    """`:::{instructor}`: as `{solution}`, without a box; for tables of contents."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        return [] if self.woven.for_students else [self.parsed(nodes.container())]


class FragmentIndexDirective(BookDirective):
    """`:::{fragment-index}`"""

    def run(self) -> list[nodes.Node]:
        return [fragment_index()]


class IdentifierIndexDirective(BookDirective):
    """`:::{identifier-index}`"""

    def run(self) -> list[nodes.Node]:
        return [identifier_index()]
