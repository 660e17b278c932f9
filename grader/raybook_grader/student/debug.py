"""One pixel's paths, and the first step at which they are not what they should be."""

from __future__ import annotations

import json
import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

from ..checks.words import clean
from ..course.pictures import PublicPicture
from ..errors import BadInput
from .make import Maker
from .path_log import FirstDifference, first_difference, log_options
from .project import Assignment, PathLog, Project
from .running import run_limited

Pixel = tuple[int, int]

_SECONDS = 60


@dataclass(frozen=True)
class Debugged:
    """``log`` is the student's, of ``pixel``. ``expected`` is None where nothing is known."""

    picture: PublicPicture
    pixel: Pixel
    log: str
    expected: PathLog | None
    difference: FirstDifference | None


def debug(project: Project, number: str, scene: str, pixel: str) -> Debugged:
    """The paths of ``pixel`` ("x,y") in a scene, or in the first public picture of an assignment.

    Where the paths of that pixel are not known, those of the nearest one that is are compared.
    """
    place = _pixel(pixel)
    assignment, picture = _choose(project, number, scene)
    width, height = picture.resolution
    if not (0 <= place[0] < width and 0 <= place[1] < height):
        raise BadInput(f"PIXEL={pixel}: the picture has {width} x {height} pixels")
    undone = project.undone(picture)
    expected = project.expected.path_log(assignment, picture, undone, place)
    renderer = Maker(project.root).programs([]).renderer
    log = _log(renderer, project.root, picture, expected.pixel if expected else place)
    difference = first_difference(log, expected.text) if expected else None
    return Debugged(picture, expected.pixel if expected else place, log, expected, difference)


def _pixel(text: str) -> Pixel:
    match = re.fullmatch(r"(\d{1,5}),(\d{1,5})", text.replace(" ", ""))
    if not match:
        raise BadInput(
            f"PIXEL={text}: expected a column and a row from the top left, like PIXEL=32,20"
        )
    return int(match[1]), int(match[2])


def _choose(project: Project, number: str, scene: str) -> tuple[Assignment | None, PublicPicture]:
    """The picture that is meant; its assignment, None for a scene of no assignment."""
    known = [(a, p) for a in project.chosen(number) for p in a.pictures]
    if not scene:
        if not number or not known:
            raise BadInput("say SCENE=file.json, or A=NN for the picture of an assignment")
        return known[0]
    file = project.root / scene
    if not file.is_file():
        raise BadInput(f"SCENE={scene}: no such file")
    name = (
        file.resolve().relative_to(project.root.resolve()).as_posix()
        if _inside(project, file)
        else scene
    )
    for assignment, picture in known:
        if picture.scene == name:
            return assignment, picture
    return None, PublicPicture(name, _resolution(file), 1, 4)


def _inside(project: Project, file: Path) -> bool:
    return file.resolve().is_relative_to(project.root.resolve())


def _resolution(file: Path) -> Pixel:
    """The scene's own; the renderer will say what is wrong with any other file."""
    try:
        width, height = json.loads(file.read_text(encoding="utf-8"))["film"]["resolution"]
        return int(width), int(height)
    except (ValueError, KeyError, TypeError):
        return (512, 512)


def _log(renderer: Path, root: Path, picture: PublicPicture, pixel: Pixel) -> str:
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        options = [*picture.settings, *log_options(pixel, Path(folder, "pixel.exr"))]
        command = [str(renderer), picture.scene, *options]
        done = run_limited(command, root, _SECONDS)
    if done.code is None:
        raise BadInput(f"the renderer was not done after {_SECONDS} s")
    words = clean(done.out, lines=100_000)
    if done.code != 0:
        said = clean(done.err, 10)
        raise BadInput(f"the renderer ended with {done.code}:\n{words}\n{said}")
    return words
