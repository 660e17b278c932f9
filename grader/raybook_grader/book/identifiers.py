"""Where the names of the source are defined, by universal-ctags, and in which pieces they are used.

Only what a reader may want to look up counts: functions, types, enumerators, macros and variables
of files, no members, parameters or local names.
"""

from __future__ import annotations

import json
import subprocess
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from pygments.lexer import Lexer
from pygments.lexers import get_lexer_by_name
from pygments.token import Token, _TokenType

from .editions import BookLine, Reader

# d macros, e enumerators, f functions, g enums, p prototypes, s structs, t typedefs, v variables.
_KINDS = "defgpstv"
_SHORTEST = 2


@dataclass(frozen=True)
class Definition:
    """A name where it is defined, for this reader. `key` is that of the piece that shows it."""

    name: str
    kind: str
    file: str
    line: int
    key: str
    of_file_only: bool

    @property
    def anchor(self) -> str:
        """Where a link to it goes."""
        if not self.of_file_only:
            return f"id-{self.name}"
        return f"id-{self.file.replace('/', '-').replace('.', '-')}-{self.name}"


class Identifiers:
    """All definitions that one reader sees, and the pieces that use each."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader
        self._by_name = _choose(_definitions(reader))
        self.at: dict[tuple[str, int], list[Definition]] = defaultdict(list)
        for definition in self.all():
            self.at[definition.file, definition.line].append(definition)
        self.used_in: Mapping[Definition, list[str]] = self._uses()

    def all(self) -> list[Definition]:
        """Every definition, by name."""
        everything = (d for own in self._by_name.values() for d in own)
        return sorted(everything, key=lambda d: (d.name.lower(), d.name, d.file, d.line))

    def find(self, name: str, file: str = "") -> Definition | None:
        """What a name means in a file: its own definition, else the one that all can see."""
        found = self._by_name.get(name, [])
        own = [d for d in found if d.file == file]
        shared = [d for d in found if not d.of_file_only]
        if file:
            return next(iter(own or shared), None)
        return next(iter(shared or found), None)

    def defined_in(self, key: str) -> list[Definition]:
        """The definitions that a piece shows, in the order of their lines."""
        return sorted((d for d in self.all() if d.key == key), key=lambda d: d.line)

    def _uses(self) -> Mapping[Definition, list[str]]:
        uses: defaultdict[Definition, list[str]] = defaultdict(list)
        for key, piece in self._reader.pieces.items():
            lines = [i.text for i in self._reader.items(piece) if isinstance(i, BookLine)]
            for name in dict.fromkeys(_names("\n".join(lines))):
                definition = self.find(name, piece.file)
                if definition and definition.key != key:
                    uses[definition].append(key)
        return uses


def c_tokens(text: str) -> Iterator[tuple[_TokenType, str]]:
    """The tokens of C code; together they are the text to the letter."""
    lexer: Lexer = get_lexer_by_name("c", stripnl=False, ensurenl=False)
    yield from lexer.get_tokens(text)


def is_name(token: _TokenType) -> bool:
    """Whether the lexer takes a token for a name that may have a definition."""
    return any(kind in (Token.Name, Token.Keyword.Type) for kind in token.split())


def _names(text: str) -> Iterator[str]:
    for token, value in c_tokens(text):
        if is_name(token):
            yield value


def _definitions(reader: Reader) -> Iterator[Definition]:
    """All of them, prototypes too; only those on lines that the reader sees."""
    for tag in _tags(reader.tree.root, list(reader.files)):
        name, file, line = str(tag["name"]), str(tag["path"]), int(str(tag["line"]))
        piece = reader.owner_of(file, line)
        if piece is None or len(name) < _SHORTEST or _is_made_up(name):
            continue
        kind = str(tag["kind"])
        hidden = bool(tag.get("file")) and not file.endswith(".h")
        yield Definition(name, kind, file, line, reader.key(piece), hidden)


def _is_made_up(name: str) -> bool:
    """ctags' own names, and include guards."""
    return name.startswith("__anon") or name.endswith(("_H", "_H_"))


def _tags(root: Path, files: list[str]) -> Iterator[dict[str, object]]:
    command = ["ctags", "--output-format=json", "--fields=+nf", f"--kinds-C={_KINDS}",
               "--languages=C", "--langmap=C:.c.h", "-f-", "-L-"]  # fmt: skip
    run = subprocess.run(
        command, cwd=root, input="\n".join(files), capture_output=True, text=True, check=True
    )
    for line in run.stdout.splitlines():
        tag = json.loads(line)
        if tag.get("_type") == "tag":
            yield tag


def _choose(definitions: Iterator[Definition]) -> dict[str, list[Definition]]:
    """One definition for a name in a file, and one that all files see: no prototype if there is
    a body, no `struct x` beside its typedef."""
    by_name: defaultdict[str, list[Definition]] = defaultdict(list)
    for definition in definitions:
        by_name[definition.name].append(definition)
    return {name: list(_without_echoes(own)) for name, own in by_name.items()}


def _without_echoes(own: list[Definition]) -> Iterator[Definition]:
    best: dict[str, Definition] = {}
    for definition in sorted(own, key=lambda d: (d.kind == "prototype", d.file, d.line)):
        best.setdefault(definition.file if definition.of_file_only else "", definition)
    yield from best.values()
