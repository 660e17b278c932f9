"""All the marked source of a checkout, and the rules that hold across its files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from .markers import parse
from .pieces import Piece, Region, Role, SourceFile, Violation

SOURCE_FOLDER = "src"
_SUFFIXES = (".h", ".c")  # headers first: a contract is read before its code


class UnsoundSourceError(Exception):
    """The source breaks rules, so nothing may be made of it; `violations` says which."""

    def __init__(self, violations: Sequence[Violation]) -> None:
        super().__init__("\n".join(map(str, violations)))
        self.violations = tuple(violations)


@dataclass(frozen=True, eq=False)
class Fragment:
    """All pieces of one slug; the first is the one that opened it and has the title."""

    slug: str
    pieces: tuple[Piece, ...]

    @property
    def title(self) -> str:
        return self.pieces[0].title


@dataclass(frozen=True, eq=False)
class Todo:
    """An exercise: the region where its stub stands, and the regions of its helpers."""

    place: Region
    helpers: tuple[Region, ...]

    @property
    def name(self) -> str:
        return self.place.name

    @property
    def file(self) -> str:
        return self.place.file

    @property
    def line(self) -> int:
        """The line of the `#ifndef` that has the stub."""
        return self.place.ifndef


@dataclass(frozen=True, eq=False)
class SourceTree:
    """Every .c and .h file under `root`/src, in reading order.

    With violations, `fragments` and `todos` hold the first of each name only.
    """

    root: Path
    files: Mapping[str, SourceFile]
    fragments: Mapping[str, Fragment]
    todos: Mapping[str, Todo]
    violations: tuple[Violation, ...]

    def pieces(self) -> Iterator[Piece]:
        """Every piece but the files' roots."""
        for source in self.files.values():
            yield from source.pieces()

    def title(self, piece: Piece) -> str:
        """The title of the piece's fragment; of a root piece, the file's name."""
        return piece.title or self.fragments[piece.slug].title

    def index(self, piece: Piece) -> int:
        """How many pieces of the same fragment come before this one; 0 for a root."""
        return 0 if piece.is_root else self.fragments[piece.slug].pieces.index(piece)

    def require_sound(self) -> SourceTree:
        """Itself; raises UnsoundSourceError if there is any violation."""
        if self.violations:
            raise UnsoundSourceError(self.violations)
        return self


def load_tree(root: Path) -> SourceTree:
    """Parse `root`/src. Faults of the source are in the tree's `violations`.

    Raises FileNotFoundError if there is no such folder.
    """
    folder = root / SOURCE_FOLDER
    if not folder.is_dir():
        raise FileNotFoundError(f"{folder}: no such folder; expected the renderer's source there")
    paths = sorted((p for p in folder.rglob("*") if p.suffix in _SUFFIXES), key=_reading_order)
    return build_tree(root, {p.relative_to(root).as_posix(): p.read_bytes() for p in paths})


def build_tree(root: Path, texts: Mapping[str, bytes]) -> SourceTree:
    """The tree of these files: name relative to `root` -> bytes, in reading order."""
    violations: list[Violation] = []
    files: dict[str, SourceFile] = {}
    for name, raw in texts.items():
        files[name] = parse(name, _decode(name, raw, violations))
        violations += files[name].violations
    fragments = _fragments(files.values(), violations)
    todos = _todos(files.values(), violations)
    return SourceTree(root, files, fragments, todos, tuple(violations))


def _reading_order(path: Path) -> tuple[Path, str, int]:
    return path.parent, path.stem, _SUFFIXES.index(path.suffix)


def _decode(name: str, raw: bytes, violations: list[Violation]) -> str:
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as fault:
        line = raw.count(b"\n", 0, fault.start) + 1
        violations.append(Violation(name, line, "not UTF-8 text"))
        return raw.decode("utf-8", "replace")


def _fragments(files: Iterable[SourceFile], violations: list[Violation]) -> dict[str, Fragment]:
    by_slug: defaultdict[str, list[Piece]] = defaultdict(list)
    for source in files:
        for piece in source.pieces():
            by_slug[piece.slug].append(piece)
    return {slug: _fragment(slug, pieces, violations) for slug, pieces in by_slug.items()}


def _fragment(slug: str, pieces: list[Piece], violations: list[Violation]) -> Fragment:
    """One fragment: its opening first, then its other pieces in reading order."""
    openings = [p for p in pieces if not p.continuation]
    continuations = [p for p in pieces if p.continuation]

    def fault(piece: Piece, message: str) -> None:
        violations.append(Violation(piece.file, piece.first, message))

    for piece in openings[1:]:
        first = openings[0]
        fault(piece, f"fragment {slug} is already opened at {first.file}:{first.first}")
    for piece in continuations:
        if not openings:
            fault(piece, f"//>+ {slug} continues a fragment that is opened nowhere")
        elif piece.file == openings[0].file and piece.first < openings[0].first:
            fault(piece, f"//>+ {slug} stands before //> {slug} (line {openings[0].first})")
        elif openings[0].role is Role.SOLUTION and piece.todo != openings[0].todo:
            fault(piece, f"//>+ {slug} continues a fragment that only a solution holds")
    return Fragment(slug, tuple(openings[:1] + continuations + openings[1:]))


def _todos(files: Iterable[SourceFile], violations: list[Violation]) -> dict[str, Todo]:
    by_name: defaultdict[str, list[Region]] = defaultdict(list)
    for source in files:
        for region in source.regions:
            by_name[region.name].append(region)
    return {name: _todo(name, regions, violations) for name, regions in by_name.items()}


def _todo(name: str, regions: list[Region], violations: list[Violation]) -> Todo:
    place = next((r for r in regions if r.middle), regions[0])
    for region in regions:
        if region.file != place.file:
            message = f"TODO_{name} already stands at {place.file}:{place.ifndef}"
            violations.append(Violation(region.file, region.ifndef, message))
    return Todo(place, tuple(r for r in regions if r is not place))
