"""The parser of the markers in a C file.

    //> slug: Title         opens a fragment
    //>+ slug               opens another piece of a fragment
    //< slug                closes the innermost piece
    #ifndef TODO_name       a solution follows, then #else, its stub, #endif

A solution may have helpers outside of its function: more regions of the same name in the same
file, without an #else. Each name has one region with a stub, which is the exercise's place.

Fragments and conditionals (a TODO's and all others) nest strictly, like brackets. `parse` does
not stop at a fault: it reports each one and goes on as if that one were mended.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from .pieces import Item, Line, Piece, Region, Role, SourceFile, Violation

_SLUG = r"[a-z][a-z0-9_-]*(?:\.[a-z0-9_-]+)*"
_OPEN = re.compile(rf"\s*//>\s+({_SLUG})(?::\s*(.*?))?\s*")
_CONTINUE = re.compile(rf"\s*//>\+\s+({_SLUG})\s*")
_CLOSE = re.compile(rf"\s*//<\s+({_SLUG})\s*")
_ALMOST_MARKER = re.compile(r"\s*//\s*[<>]")
_MARKER_AFTER_CODE = re.compile(r"//[<>]")
_DIRECTIVE = re.compile(r"\s*#\s*(\w+)")
_TODO = re.compile(r"\s*#\s*ifndef\s+TODO_([a-z][a-z0-9_]*)\s*")
# TODO_WARN and TODO_H are no exercises: the name of one is in lower case.
_TODO_NAME = re.compile(r"\bTODO_\w*[a-z]\w*")
_GRAMMAR = "expected '//> slug: Title', '//>+ slug' or '//< slug'"


def parse(name: str, text: str) -> SourceFile:
    """Parse the text of one file; `name` is how messages and pieces call the file."""
    parser = _Parser(name)
    # Not splitlines(): a form feed ends no line for a compiler.
    lines = text.removesuffix("\n").split("\n")
    for number, line in enumerate(lines, 1):
        parser.line(number, line)
    return parser.finish(lines)


@dataclass(eq=False)
class _Draft:
    """A piece while it is still open."""

    slug: str
    title: str
    first: int
    continuation: bool
    role: Role
    todo: str | None
    last: int = 0
    items: list[Line | _Draft] = field(default_factory=list)


@dataclass(eq=False)
class _Conditional:
    """An open #if; `todo` is the exercise's name, if it is one's `#ifndef`."""

    first: int
    todo: str | None
    draft: _Draft
    middle: int | None = None
    has_stub: bool = False
    endif: int = 0


class _Parser:
    def __init__(self, name: str) -> None:
        self.name = name
        self.root = _Draft(f"file:{name}", name, 1, False, Role.CODE, None)
        self.frames: list[_Draft | _Conditional] = []
        self.regions: list[_Conditional] = []
        self.violations: list[Violation] = []
        self.continued = False  # the line before ended with a backslash

    def line(self, number: int, text: str) -> None:
        """Take the next line of the file."""
        if "\t" in text:
            self._fault(number, "tab character: indent with spaces")
        if text.endswith("\r"):
            self._fault(number, "carriage return: end lines with a newline only")
        if not self._marker(number, text) and not self._directive(number, text):
            self._keep(number, text)
        self.continued = text.endswith("\\")

    def finish(self, lines: list[str]) -> SourceFile:
        """Report what is still open and freeze the result."""
        for frame in self.frames:
            self._fault(frame.first, f"{_describe(frame)} is never closed")
        self.root.last = len(lines)
        contents: dict[Piece, tuple[Item, ...]] = {}
        frozen: dict[int, Piece] = {}
        root = self._freeze(self.root, None, contents, frozen)
        regions = tuple(
            Region(r.todo, self.name, r.first, r.middle, r.endif, frozen[id(r.draft)])
            for r in self.regions
            if r.todo is not None
        )
        self._check_stubs(regions)
        faults = tuple(sorted(self.violations, key=lambda fault: fault.line))
        return SourceFile(self.name, tuple(lines), root, regions, faults, contents)

    def _freeze(
        self,
        draft: _Draft,
        parent: Piece | None,
        contents: dict[Piece, tuple[Item, ...]],
        frozen: dict[int, Piece],
    ) -> Piece:
        piece = Piece(
            slug=draft.slug,
            title=draft.title,
            file=self.name,
            first=draft.first,
            last=draft.last,
            continuation=draft.continuation,
            role=draft.role,
            todo=draft.todo,
            parent=parent,
        )
        frozen[id(draft)] = piece
        contents[piece] = ()  # holds the place: pieces are listed in the order they open
        contents[piece] = tuple(
            item if isinstance(item, Line) else self._freeze(item, piece, contents, frozen)
            for item in draft.items
        )
        return piece

    def _fault(self, number: int, message: str) -> None:
        self.violations.append(Violation(self.name, number, message))

    # The place in the file.

    def _draft(self) -> _Draft:
        """The innermost open piece."""
        return next((f for f in reversed(self.frames) if isinstance(f, _Draft)), self.root)

    def _place(self) -> tuple[Role, str | None]:
        """The role of the next line, and whose exercise it is part of."""
        for frame in self.frames:
            if isinstance(frame, _Conditional) and frame.todo:
                return (Role.STUB if frame.middle else Role.SOLUTION), frame.todo
        return Role.CODE, None

    def _keep(self, number: int, text: str) -> None:
        self._draft().items.append(Line(number, text, *self._place()))
        for frame in self.frames:
            if isinstance(frame, _Conditional) and frame.middle and text.strip():
                frame.has_stub = True

    # Markers.

    def _marker(self, number: int, text: str) -> bool:
        """Whether the line was a marker, good or bad."""
        if match := _OPEN.fullmatch(text):
            self._open(number, match[1], match[2] or "", continuation=False)
        elif match := _CONTINUE.fullmatch(text):
            self._open(number, match[1], "", continuation=True)
        elif match := _CLOSE.fullmatch(text):
            self._close(number, match[1])
        elif _ALMOST_MARKER.match(text):
            self._fault(number, f"malformed marker: {_GRAMMAR}")
            return True
        elif _MARKER_AFTER_CODE.search(text):
            self._fault(number, "a marker must stand alone on its line")
            return False
        else:
            return False
        if self.continued:
            self._fault(number, "marker inside a line continued with a backslash")
        return True

    def _open(self, number: int, slug: str, title: str, continuation: bool) -> None:
        if not title and not continuation:
            self._fault(number, f"fragment {slug} has no title: {_GRAMMAR}")
        if "/*" in title or "*/" in title:
            self._fault(number, f"the title of {slug} holds a comment delimiter")
        if any(isinstance(f, _Draft) and f.slug == slug for f in self.frames):
            self._fault(number, f"fragment {slug} is nested in itself")
        draft = _Draft(slug, title, number, continuation, *self._place())
        self._draft().items.append(draft)
        self.frames.append(draft)

    def _close(self, number: int, slug: str) -> None:
        open_pieces = [f for f in self.frames if isinstance(f, _Draft) and f.slug == slug]
        if not open_pieces:
            self._fault(number, f"//< {slug} closes nothing: no such fragment is open")
            return
        draft = open_pieces[-1]
        innermost = self.frames[-1]
        if isinstance(innermost, _Draft) and innermost is not draft:
            self._fault(number, f"//< {slug} closes it while {_describe(innermost)} is open")
        elif isinstance(innermost, _Conditional):
            self._fault(number, f"fragment {slug} straddles {_describe(innermost)}")
        draft.last = number
        self.frames.remove(draft)

    # Conditionals.

    def _directive(self, number: int, text: str) -> bool:
        """Whether the line was a directive of a TODO, which the piece doesn't keep."""
        match = _DIRECTIVE.match(text)
        if not match or self.continued:
            return False
        todo = _TODO.fullmatch(text)
        if todo:
            self._begin_todo(number, todo[1])
            return True
        word = match[1]
        if word not in ("else", "endif") and (misused := _TODO_NAME.search(text)):
            message = f"{misused[0]} stands only alone in an '#ifndef {misused[0]}'"
            self._fault(number, message)
        if word in ("if", "ifdef", "ifndef"):
            self.frames.append(_Conditional(number, None, self._draft()))
        elif word in ("elif", "else", "endif"):
            return self._middle_or_end(number, word)
        return False

    def _begin_todo(self, number: int, name: str) -> None:
        outer = self._place()[1]
        if outer:
            self._fault(number, f"TODO_{name} is nested in TODO_{outer}")
        region = _Conditional(number, name, self._draft())
        self.regions.append(region)
        self.frames.append(region)

    def _middle_or_end(self, number: int, word: str) -> bool:
        region = next((f for f in reversed(self.frames) if isinstance(f, _Conditional)), None)
        if region is None:
            self._fault(number, f"#{word} without an #if")
            return False
        innermost = self.frames[-1]
        if innermost is not region:
            self._fault(number, f"{_describe(innermost)} straddles an #{word}")
        if word == "endif":
            self._end(number, region)
        elif word == "elif" and region.todo:
            self._fault(number, f"#elif in TODO_{region.todo}: it has #else and nothing more")
        elif word == "else":
            if region.middle:
                self._fault(number, f"second #else for {_describe(region)}")
            region.middle = number
        return region.todo is not None

    def _end(self, number: int, region: _Conditional) -> None:
        region.endif = number
        if region.todo and region.middle and not region.has_stub:
            self._fault(number, f"TODO_{region.todo} has an empty stub")
        self.frames.remove(region)

    def _check_stubs(self, regions: tuple[Region, ...]) -> None:
        """Each exercise has its stub in one place."""
        places: dict[str, Region] = {}
        for region in (r for r in regions if r.middle):
            first = places.setdefault(region.name, region)
            if first is not region:
                message = f"TODO_{region.name} already has its stub at line {first.middle}"
                self._fault(region.ifndef, message)
        for region in regions:
            if region.name not in places:
                self._fault(region.endif or region.ifndef, f"TODO_{region.name} has no stub")
                places[region.name] = region


def _describe(frame: _Draft | _Conditional) -> str:
    if isinstance(frame, _Draft):
        return f"fragment {frame.slug} (opened at line {frame.first})"
    kind = f"#ifndef TODO_{frame.todo}" if frame.todo else "#if"
    return f"{kind} (opened at line {frame.first})"
