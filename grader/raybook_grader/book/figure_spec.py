"""What a rendered figure of the book shows: a scene, options, and which programs draw it."""

from __future__ import annotations

import hashlib
import json
import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from ..errors import BadInput

_NOT_CODE = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|/\*.*?\*/|//[^\n]*', re.DOTALL)
BOOK_MISTAKES = "docs/figures/mistakes"
_TEST = re.compile(r"test_.*\.[ch]")


@dataclass(frozen=True)
class Picture:
    """One picture: which program draws it (`kind` "solution", "stub" or "mistake") and the words
    beneath it."""

    kind: str
    label: str = ""
    stubs: frozenset[str] = frozenset()
    mistake: str = ""


@dataclass(frozen=True)
class FigureSpec:
    """A `{render}` directive. `scene` is relative to the checkout, `args` as typed."""

    name: str
    scene: str
    args: str
    stubs: frozenset[str] = frozenset()
    mistake: str = ""

    @property
    def options(self) -> list[str]:
        return shlex.split(self.args)

    @property
    def command(self) -> str:
        """What a reader types to get the picture."""
        if '"' in self.args:  # which would end ARGS="..."
            return f"build/raybook {self.args} {self.scene}"
        options = f' ARGS="{self.args}"' if self.args else ""
        return f"make render SCENE={self.scene}{options}"

    def pictures(self) -> list[Picture]:
        """In the order in which they stand beside each other."""
        if self.stubs:
            before = Picture("stub", "your renderer before", stubs=self.stubs)
            return [before, Picture("solution", "and after")]
        if self.mistake:
            wrong = Picture("mistake", "with the mistake", mistake=self.mistake)
            return [wrong, Picture("solution", "as it should be")]
        return [Picture("solution")]


def picture_key(root: Path, spec: FigureSpec, picture: Picture) -> str:
    """Changes with anything that could change the picture; not with comments in the source."""
    digest = hashlib.sha256()
    for part in (_code(root), *_inputs(root, spec.scene)):
        digest.update(hashlib.sha256(part).digest())
    words = [spec.scene, *spec.options, "/", *sorted(picture.stubs)]
    digest.update("\0".join(words).encode())
    if picture.mistake:
        digest.update(mistake_file(root, picture.mistake).read_bytes())
    return digest.hexdigest()[:20]


def code_key(root: Path) -> str:
    """Changes with the code of the renderer; not with its comments."""
    return _code(root).hex()


def mistake_file(root: Path, mistake: str) -> Path:
    """The patch of "03-bvh/forgets-max.patch", a mistake that students make, or of
    "flat-ray.patch", one in a module that none of them writes. Raises BadInput if there is none."""
    assignment, _, name = mistake.rpartition("/")
    folder = root / "assignments" / assignment / "mistakes" if assignment else root / BOOK_MISTAKES
    if not name or not (folder / name).is_file():
        raise BadInput(
            f"mistake {mistake}: expected NN-name/slug.patch, a file of assignments/,"
            f" or slug.patch, one of {BOOK_MISTAKES}/"
        )
    return folder / name


def _code(root: Path) -> bytes:
    """All that the renderer is compiled from, without its comments, as a hash."""
    files = sorted(p for p in (root / "src").rglob("*.[ch]") if not _TEST.fullmatch(p.name))
    stamps = ((file, file.stat()) for file in [*files, root / "src" / "build.mk"])
    return _code_of(tuple((file, stat.st_mtime_ns, stat.st_size) for file, stat in stamps))


@lru_cache(maxsize=2)
def _code_of(stamps: tuple[tuple[Path, int, int], ...]) -> bytes:
    """The same for files as they are now; the stamps say when to read them again."""
    digest = hashlib.sha256()
    for file, *_ in stamps:
        text = file.read_text(encoding="utf-8")
        if file.suffix != ".mk":
            text = " ".join([file.name, *_NOT_CODE.sub(_without_comment, text).split()])
        digest.update(hashlib.sha256(text.encode()).digest())
    return digest.digest()


def _without_comment(match: re.Match[str]) -> str:
    return " " if match[0].startswith("/") else match[0]


def _inputs(root: Path, scene: str) -> Iterator[bytes]:
    """The scene, what makes its meshes, and the files that it names."""
    file = root / scene
    if not file.is_file():
        raise BadInput(f"scene {scene}: no such file in the checkout")
    yield file.read_bytes()
    for script in sorted((root / "scenes").glob("*.py")):
        yield script.read_bytes()
    for name in _strings(json.loads(file.read_text(encoding="utf-8"))):
        named = file.parent / name
        if len(name) < 200 and "build" not in Path(name).parts and named.is_file():
            yield named.read_bytes()


def _strings(value: object) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for inner in value.values():
            yield from _strings(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _strings(inner)
