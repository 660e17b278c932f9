"""The kit: the reference renderer in pieces, made by `make kit`.

Students' modules are compiled against its headers and linked with its objects.
"""

from __future__ import annotations

import hashlib
import json
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from .errors import BadInput

_HINT = "expected what `make kit` writes"


@dataclass(frozen=True)
class KitModule:
    """A source file that a student may write: its reference object, and what it must define."""

    object: str
    symbols: tuple[str, ...]


@dataclass(frozen=True)
class Kit:
    """Paths of objects are relative to ``folder``; modules are keyed by their source file."""

    folder: Path
    version: str
    cc: str
    cflags: tuple[str, ...]
    ldflags: tuple[str, ...]
    ldlibs: tuple[str, ...]
    objcopy: str
    modules: Mapping[str, KitModule]

    @property
    def include(self) -> Path:
        return self.folder / "include"

    @property
    def objects(self) -> list[str]:
        """Every reference object, `main.o` included."""
        found = (self.folder / "objects").rglob("*.o")
        return sorted(str(path.relative_to(self.folder)) for path in found)

    @cached_property
    def fingerprint(self) -> str:
        """A hash of all that has a say in a build: every file, the flags and the compiler."""
        digest = hashlib.sha256(_compiler(self.cc).encode())
        for path in sorted(p for p in self.folder.rglob("*") if p.is_file()):
            content = hashlib.sha256(path.read_bytes()).hexdigest()
            digest.update(f"{path.relative_to(self.folder)}\0{content}\n".encode())
        return digest.hexdigest()


def load_kit(folder: Path) -> Kit:
    """The kit in ``folder``."""
    file = folder / "kit.json"
    try:
        values = json.loads(file.read_text(encoding="utf-8"))
        kit = Kit(
            folder=folder,
            version=str(values["version"]),
            cc=str(values["cc"]),
            cflags=_texts(values["cflags"]),
            ldflags=_texts(values["ldflags"]),
            ldlibs=_texts(values["ldlibs"]),
            objcopy=str(values["objcopy"]),
            modules={name: _module(module) for name, module in values["modules"].items()},
        )
    except FileNotFoundError as error:
        raise BadInput(f"{file}: does not exist, {_HINT}") from error
    except KeyError as error:
        raise BadInput(f"{file}: no key {error}, {_HINT}") from error
    except (ValueError, TypeError, AttributeError) as error:
        raise BadInput(f"{file}: {error}, {_HINT}") from error
    for module in kit.modules.values():
        if not (folder / module.object).is_file():
            raise BadInput(f"{folder / module.object}: does not exist, {_HINT}")
    return kit


def is_clang(cc: str) -> bool:
    """Whether a compiler understands clang's flags where they are not gcc's."""
    return Path(cc).name.startswith("clang")


def _texts(value: Any) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise ValueError(f"{value!r} is no list of texts")
    return tuple(value)


def _module(value: Any) -> KitModule:
    return KitModule(str(value["object"]), _texts(value["symbols"]))


def _compiler(cc: str) -> str:
    """The compiler's own words on what it is."""
    try:
        return subprocess.run([cc, "-v"], capture_output=True, text=True, check=True).stderr
    except (OSError, subprocess.CalledProcessError) as error:
        raise BadInput(f"the kit's compiler {cc!r} does not run ({error}); `make setup`") from error
