"""From the files of an assignment to whole modules that the grader can judge."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from ..course import Assignment
from ..errors import BadInput
from .label import Label, split_mistake, split_twin
from .patches import patched, target_of


@dataclass(frozen=True)
class Exhibit:
    """One module. ``files`` holds every owned file by its path below the checkout.

    ``label`` is None for the reference and the alternatives, which are right.
    """

    assignment: str
    slug: str
    files: Mapping[str, bytes]
    label: Label | None = None

    @property
    def is_right(self) -> bool:
        return self.label is None

    @property
    def name(self) -> str:
        """ "02/tin-before-tout"."""
        return f"{self.assignment}/{self.slug}"


@dataclass(frozen=True)
class Twin:
    """A mistake made again in other words, to test the diagnosis on; it learns nothing from it."""

    exhibit: Exhibit
    mistake: str


def reference_of(root: Path, assignment: Assignment) -> Exhibit:
    """The course's own solution."""
    files = {path: (root / path).read_bytes() for path in assignment.owned}
    return Exhibit(assignment.number, "reference", files)


def exhibits_of(root: Path, assignment: Assignment, *, strict: bool = True) -> list[Exhibit]:
    """The reference, the alternatives and the mistakes; raises `BadInput` for one that is broken.

    ``strict`` asks that each check that a label names is one of the assignment's.

    An alternative is `alternatives/slug.c` where the module owns one file, else a folder
    `alternatives/slug` with files of the owned names; those it lacks are the reference's.
    """
    reference = reference_of(root, assignment)
    alternatives = dict(_alternatives(reference, assignment))
    mistakes = [
        _mistake(root, reference, alternatives, assignment, patch)
        for patch in sorted((assignment.folder / "mistakes").glob("*.patch"))
    ]
    names = {check.name for check in assignment.checks}
    for mistake in mistakes if strict else ():
        if unknown := set(mistake.label.expect if mistake.label else ()) - names:
            raise BadInput(f"{mistake.name}: Expect names {', '.join(unknown)}: no such check")
    return [reference, *alternatives.values(), *mistakes]


def twins_of(root: Path, assignment: Assignment) -> list[Twin]:
    """The `twins/*.patch`; raises `BadInput` for one that is broken."""
    reference = reference_of(root, assignment)
    alternatives = dict(_alternatives(reference, assignment))
    known = {patch.stem for patch in (assignment.folder / "mistakes").glob("*.patch")}
    twins = []
    for patch in sorted((assignment.folder / "twins").glob("*.patch")):
        slug, diff = split_twin(patch)
        if slug not in known:
            raise BadInput(f"{patch}: is the twin of {slug!r}: no such mistake")
        files = _changed(root, reference, alternatives, assignment, patch, diff)
        twins.append(Twin(Exhibit(assignment.number, f"twins/{patch.stem}", files), slug))
    return twins


def _alternatives(reference: Exhibit, assignment: Assignment) -> Iterator[tuple[Path, Exhibit]]:
    owned = {PurePosixPath(path).name: path for path in assignment.owned}
    for entry in sorted((assignment.folder / "alternatives").iterdir()):
        files = dict(reference.files)
        if entry.is_dir():
            for file in sorted(entry.iterdir()):
                if file.name not in owned:
                    raise BadInput(f"{file}: expected a name of {', '.join(owned)}")
                files[owned[file.name]] = file.read_bytes()
        elif len(owned) == 1 and entry.suffix == ".c":
            files[assignment.owned[0]] = entry.read_bytes()
        else:
            raise BadInput(f"{entry}: expected slug.c or slug/NAME.c for {', '.join(owned)}")
        yield entry, Exhibit(assignment.number, entry.name.removesuffix(".c"), files)


def _mistake(
    root: Path,
    reference: Exhibit,
    alternatives: Mapping[Path, Exhibit],
    assignment: Assignment,
    patch: Path,
) -> Exhibit:
    """The module with the mistake in it."""
    label, diff = split_mistake(patch)
    files = _changed(root, reference, alternatives, assignment, patch, diff)
    return Exhibit(assignment.number, patch.stem, files, label)


def _changed(
    root: Path,
    reference: Exhibit,
    alternatives: Mapping[Path, Exhibit],
    assignment: Assignment,
    patch: Path,
    diff: str,
) -> Mapping[str, bytes]:
    """The module that a diff makes of the reference or of an alternative."""
    target = target_of(diff)
    if str(target) in reference.files:
        base, path = reference, str(target)
    else:
        base, path = _base(root, alternatives, assignment, patch, target)
    files = dict(base.files)
    files[path] = patched(patch, diff, target, files[path])
    return files


def _base(
    root: Path,
    alternatives: Mapping[Path, Exhibit],
    assignment: Assignment,
    patch: Path,
    target: PurePosixPath,
) -> tuple[Exhibit, str]:
    """The alternative that a patch changes, and which of its owned files."""
    file = root / target
    for entry, exhibit in alternatives.items():
        if file == entry:
            return exhibit, assignment.owned[0]
        if file.parent == entry:
            return exhibit, next(p for p in exhibit.files if PurePosixPath(p).name == file.name)
    raise BadInput(f"{patch}: changes {target}, expected an owned file or an alternative")
