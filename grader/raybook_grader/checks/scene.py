"""What a scene consists of: its file and every file that it names.

A box gets these and nothing else, so that a student's program finds no other scene; and their
contents have a say in what a result was made from.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from ..errors import BadInput

BOX_ROOT = "/course"


@cache
def scene_files(root: Path, scene: str) -> tuple[str, ...]:
    """The scene and the existing files that its texts name, relative to the course's root."""
    file = root / scene
    try:
        values = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise BadInput(f"{file}: {error}, expected a scene in JSON") from error
    found = {scene}
    for text in _texts(values):
        named = os.path.normpath(Path(scene).parent / text)
        if not named.startswith("..") and len(text) < 4096 and (root / named).is_file():
            found.add(named)
    return tuple(sorted(found))


def scene_binds(root: Path, scene: str) -> dict[str, Path]:
    """The scene's files as they are bound in a box, below `BOX_ROOT`."""
    return {f"{BOX_ROOT}/{name}": (root / name).resolve() for name in scene_files(root, scene)}


@cache
def scene_fingerprint(root: Path, scene: str) -> str:
    """A hash of the contents of all the scene's files."""
    digest = hashlib.sha256()
    for name in scene_files(root, scene):
        content = hashlib.sha256((root / name).read_bytes()).hexdigest()
        digest.update(f"{name}\0{content}\n".encode())
    return digest.hexdigest()


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for inner in value.values():
            yield from _texts(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _texts(inner)
