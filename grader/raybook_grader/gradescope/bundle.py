"""Writing the bundle: a zip whose bytes depend on its contents alone."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass
from importlib.resources import files
from pathlib import Path

from ..course import Assignment, Course
from ..errors import BadInput
from ..files import write_bytes
from .contents import Contents, Packed, contents

CONFIG = "bundle.json"
SCRIPTS = ("setup.sh", "run_autograder")
_EPOCH = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Config:
    """What the autograder is to do: the assignments, when hidden checks are shown, no sandbox."""

    assignments: tuple[str, ...]
    hidden: str
    unsafe: bool

    def text(self) -> str:
        return json.dumps(asdict(self), indent=1) + "\n"


def read_config(file: Path) -> Config:
    """The inverse of `Config.text`."""
    values = json.loads(file.read_text(encoding="utf-8"))
    return Config(tuple(values["assignments"]), str(values["hidden"]), bool(values["unsafe"]))


def chosen(course: Course, numbers: Collection[str] | None) -> list[Assignment]:
    """The assignments named, or all that are graded."""
    known = {a.number: a for a in course.assignments if a.is_graded}
    for number in numbers or ():
        if number not in known:
            raise BadInput(f"no assignment {number!r}, expected one of {', '.join(known)}")
    return [a for a in known.values() if numbers is None or a.number in numbers]


def write_bundle(out: Path, course: Course, config: Config) -> Contents:
    """Write the zip, complete or not at all; what is in it."""
    found = contents(course.root, chosen(course, config.assignments))
    ours = {
        name: Packed(files(__package__).joinpath("templates", name).read_bytes(), True)
        for name in SCRIPTS
    }
    ours[CONFIG] = Packed(config.text().encode())
    everything = {**found.files, **ours}
    try:
        write_bytes(out, _zip(everything))
    except OSError as error:
        raise BadInput(f"{out}: {error.strerror}, expected a file that can be written") from error
    return Contents(everything, found.left_out)


def _zip(packed: Mapping[str, Packed]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(packed):
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if packed[name].executable else 0o100644) << 16
            archive.writestr(entry, packed[name].content)
    return stream.getvalue()
