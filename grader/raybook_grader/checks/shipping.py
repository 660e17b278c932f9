"""The statistics of the references that are committed with the course."""

from __future__ import annotations

from collections.abc import Iterable

from ..course import Assignment, ImageCheck
from .reference import References
from .rendering import Picture, picture_of


def pictures_of(assignments: Iterable[Assignment]) -> list[Picture]:
    """What the image checks of these assignments render, each picture once."""
    checks = [check for assignment in assignments for check in assignment.checks]
    pictures = {picture_of(check) for check in checks if isinstance(check, ImageCheck)}
    return sorted(pictures, key=lambda picture: (picture.scene, picture.resolution, picture.spp))


def ship(references: References, picture: Picture) -> bool:
    """Write the statistics of a picture where they are committed; False if they are there."""
    file = references.shipped_file(picture)
    if file.is_file():
        return False
    file.parent.mkdir(exist_ok=True)
    references.rendered(picture).save(file)
    return True


def sweep(references: References, pictures: Iterable[Picture]) -> list[str]:
    """Remove the committed statistics that belong to none of the pictures; their names."""
    wanted = {references.shipped_file(picture) for picture in pictures}
    folders = {file.parent for file in wanted}
    stale = sorted(f for folder in folders for f in folder.glob("*.npz") if f not in wanted)
    for file in stale:
        file.unlink()
    return [file.name for file in stale]
