"""The public pictures of an assignment: what `make check` shows a student beside what is expected.

Read alike from the course's own `assignment.toml` and from the student edition's.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from .table import Table


@dataclass(frozen=True)
class PublicPicture:
    """A scene as it looks when the assignments ``needs`` and its own are right.

    ``scene`` is relative to the course's root, ``resolution`` (width, height); ``spp`` samples a
    pixel are taken for each of ``seeds`` seeds. ``varies_with`` are assignments whose stubs give
    another picture, also right: both are known. No other assignment may show in it.
    ``integrator`` is taken in place of the scene's own; "" for none.
    """

    scene: str
    resolution: tuple[int, int]
    spp: int
    seeds: int
    needs: tuple[str, ...] = ()
    varies_with: tuple[str, ...] = ()
    integrator: str = ""

    @property
    def name(self) -> str:
        """The scene's name: unique in its assignment."""
        return PurePosixPath(self.scene).stem

    @property
    def settings(self) -> list[str]:
        """The renderer's options, all but seed, samples and output."""
        width, height = self.resolution
        view = ["--integrator", self.integrator] if self.integrator else []
        return ["--resolution", f"{width}x{height}", *view]


def read_pictures(root: Path, table: Table) -> tuple[PublicPicture, ...]:
    """The `[[picture]]` tables of an assignment; none by default."""
    pictures = [_picture(root, t) for t in table.tables("picture", "picture {}".format)]
    for picture in pictures:
        if [other.name for other in pictures].count(picture.name) > 1:
            raise table.fault("picture", f"two of {picture.name!r}", "a scene of its own for each")
    return tuple(pictures)


def _picture(root: Path, table: Table) -> PublicPicture:
    picture = PublicPicture(
        scene=table.path("scene", root),
        resolution=read_resolution(table),
        spp=table.whole("spp", 1),
        # Fewer seeds can hardly prove anything wrong.
        seeds=table.whole("seeds", 4),
        needs=_numbers(table, "needs"),
        varies_with=_numbers(table, "varies_with"),
        integrator=table.text("integrator") if table.has("integrator") else "",
    )
    table.finish()
    return picture


def read_resolution(table: Table) -> tuple[int, int]:
    """The key `resolution`: width and height."""
    text = table.text("resolution")
    match = re.fullmatch(r"([1-9]\d{0,4})x([1-9]\d{0,4})", text)
    if not match:
        raise table.fault("resolution", f"is {text!r}", "width and height, like 128x128")
    return int(match[1]), int(match[2])


def _numbers(table: Table, key: str) -> tuple[str, ...]:
    numbers = table.texts(key, [])
    for number in numbers:
        if not re.fullmatch(r"\d\d", number):
            raise table.fault(key, f"has {number!r}", 'numbers of assignments, like "03"')
    return numbers
