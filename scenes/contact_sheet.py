"""Pastes the pictures of several scenes into one, with captions.

    build/venv/bin/python scenes/contact_sheet.py build/out/contact-sheet.png scenes/knot.json ...

For each scene NAME.json the folder of the output must have NAME.png; the caption's time comes
from NAME.stats.json (raybook --stats), if that is there. Needs Pillow.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

WIDTH, MARGIN, GAP = 1640, 28, 16
ROW_HEIGHT = 380
"""What rows are about as high as; each is stretched so that it fills the width."""
CAPTION = 44
PAPER, INK, FADED = (22, 24, 28), (236, 234, 228), (148, 152, 160)
NAMES = {"intersection_test": "direct light, point lights", "direct": "direct light, MIS"}
NAMES["path"] = "path tracing"


@dataclass(frozen=True)
class Picture:
    """A rendered scene and the two parts of its caption."""

    title: str
    note: str
    image: Image.Image

    @property
    def aspect(self) -> float:
        """Width over height."""
        return self.image.width / self.image.height


def read_picture(scene: Path, folder: Path) -> Picture:
    """The scene's picture in the folder."""
    with Image.open(folder / f"{scene.stem}.png") as file:
        image = file.convert("RGB")
    kind = json.loads(scene.read_text(encoding="utf-8")).get("integrator", {}).get("type", "")
    notes = [NAMES.get(kind, kind)]
    stats = folder / f"{scene.stem}.stats.json"
    if stats.exists():
        measured = json.loads(stats.read_text(encoding="utf-8"))
        notes.append(f"{round(measured['samples'] / (image.width * image.height))} spp")
        notes.append(f"{measured['render_seconds']:.1f} s")
    return Picture(scene.stem.replace("-", " "), ", ".join(notes), image)


def rows_of(pictures: Sequence[Picture]) -> list[list[Picture]]:
    """Pictures in rows, in order: as many to a row as come nearest to ROW_HEIGHT."""
    total = sum(p.aspect for p in pictures)
    count = max(1, round(total * ROW_HEIGHT / (WIDTH - 2 * MARGIN)))
    rows: list[list[Picture]] = [[] for _ in range(count)]
    passed = 0.0
    for picture in pictures:
        middle = passed + picture.aspect / 2
        rows[min(int(middle * count / total), count - 1)].append(picture)
        passed += picture.aspect
    return [row for row in rows if row]


def height_of(row: Sequence[Picture]) -> int:
    """The height at which the row fills the sheet's width, within limits for short rows."""
    space = WIDTH - 2 * MARGIN - GAP * (len(row) - 1)
    return min(round(space / sum(p.aspect for p in row)), 2 * ROW_HEIGHT)


def contact_sheet(pictures: Sequence[Picture]) -> Image.Image:
    """The sheet."""
    rows = rows_of(pictures)
    height = 2 * MARGIN + sum(height_of(row) + CAPTION for row in rows) + GAP * (len(rows) - 1)
    sheet = Image.new("RGB", (WIDTH, height), PAPER)
    y = MARGIN
    for row in rows:
        draw_row(sheet, row, y)
        y += height_of(row) + CAPTION + GAP
    return sheet


def draw_row(sheet: Image.Image, row: Sequence[Picture], y: int) -> None:
    """Pictures side by side, each above its caption."""
    title_font, note_font = ImageFont.load_default(19), ImageFont.load_default(15)
    draw, height, x = ImageDraw.Draw(sheet), height_of(row), MARGIN
    for picture in row:
        width = round(height * picture.aspect)
        sheet.paste(picture.image.resize((width, height), Image.Resampling.LANCZOS), (x, y))
        base = y + height + 28
        draw.text((x, base), picture.title, INK, title_font, anchor="ls")
        draw.text((x + width, base), picture.note, FADED, note_font, anchor="rs")
        x += width + GAP


def main(arguments: Sequence[str]) -> int:
    """The command line: the output, then scenes."""
    if len(arguments) < 2 or arguments[0].startswith("-"):
        print("usage: contact_sheet.py OUTPUT.png SCENE.json ...", file=sys.stderr)
        return 2
    output = Path(arguments[0])
    aside = output.with_name(f".{output.stem}.{os.getpid()}.png")
    try:
        contact_sheet([read_picture(Path(s), output.parent) for s in arguments[1:]]).save(aside)
        aside.replace(output)
    except (OSError, ValueError) as fault:
        aside.unlink(missing_ok=True)
        print(f"contact_sheet.py: {fault}", file=sys.stderr)
        return 2
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
