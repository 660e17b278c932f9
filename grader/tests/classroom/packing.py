"""How students send their work: in archives and folders, some one folder deep, with junk."""

from __future__ import annotations

import io
import random
import tarfile
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

Files = Mapping[str, bytes]

_JUNK: Files = {
    ".DS_Store": b"\0\0\0\1Bud1",
    "README.md": b"# My ray tracer\n",
    "build/raybook": b"\x7fELF and so on",
    "src/base/vec3.h": b"#error changed where nothing may be changed\n",
    "src/shapes/triangle.c.orig": b"old\n",
}


def send(out: Path, name: str, files: Files, rng: random.Random) -> str:
    """Write one submission in some form; its form in words."""
    words, pack = rng.choice(_FORMS)
    junk = {path: content for path, content in _JUNK.items() if rng.random() < 0.5}
    pack(out, name, {**junk, **files})
    return words


def send_broken(out: Path, name: str, files: Files) -> str:
    """An archive whose upload broke off half way."""
    _zip(out, name, files)
    whole = (out / f"{name}.zip").read_bytes()
    (out / f"{name}.zip").write_bytes(whole[: len(whole) // 2])
    return "an archive cut in half"


def _folder(out: Path, name: str, files: Files) -> None:
    for path, content in files.items():
        file = out / name / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)


def _zip(out: Path, name: str, files: Files) -> None:
    with zipfile.ZipFile(out / f"{name}.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            archive.writestr(path, content)


def _tar(out: Path, name: str, files: Files) -> None:
    with tarfile.open(out / f"{name}.tar.gz", "w:gz", compresslevel=1) as archive:
        for path, content in files.items():
            member = tarfile.TarInfo(path)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))


def _inside(folder: str, files: Files) -> Files:
    return {f"{folder}/{path}": content for path, content in files.items()}


def _mac(out: Path, name: str, files: Files) -> None:
    """A Mac's archive: one folder, and beside it a shadow of every file."""
    shadows = {f"__MACOSX/raybook/{path}.shadow": b"\0\5\26\7" for path in files}
    _zip(out, name, {**_inside("raybook", files), **shadows})


_FORMS: list[tuple[str, Callable[[Path, str, Files], None]]] = [
    ("a folder", _folder),
    ("a folder in a folder", lambda out, name, f: _folder(out, name, _inside("raybook", f))),
    ("a .zip", _zip),
    ("a folder in a .zip", lambda out, name, f: _zip(out, name, _inside(f"{name}-work", f))),
    ("a Mac's .zip", _mac),
    ("a .tar.gz", _tar),
    ("a folder in a .tar.gz", lambda out, name, f: _tar(out, name, _inside("raybook-main", f))),
]
