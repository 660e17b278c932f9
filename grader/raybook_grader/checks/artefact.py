"""The `artefact` check: a file that the student made with the tools, judged by what is in it."""

from __future__ import annotations

from ..course import ArtefactCheck
from .artefacts import compile_commands_faults, picture_faults
from .decode import Undecodable, decode
from .program import Workshop
from .result import CheckResult, Status, conclude

_SHOWN = 3


def check_artefact(check: ArtefactCheck, content: bytes | None, workshop: Workshop) -> CheckResult:
    """Passed if the file is there and right."""
    if content is None:
        message = f"{check.file} is not in the submission"
        return conclude(check, Status.FAILED, message, fingerprint="not there")
    faults = _faults(check, content, workshop)
    if not faults:
        return conclude(check, Status.PASSED, f"{check.file} is right")
    return conclude(
        check,
        Status.FAILED,
        f"{check.file} is not right",
        cases=tuple(faults[:_SHOWN]),
        fingerprint=f"wrong {check.expects}",
    )


def _faults(check: ArtefactCheck, content: bytes, workshop: Workshop) -> list[str]:
    if check.resolution is None:
        return compile_commands_faults(content, workshop.course.sources)
    width, height = check.resolution
    try:
        [pixels] = decode(workshop, [content], max_pixels=4 * width * height)
    except Undecodable as reason:
        return [f"it cannot be read: {reason}"]
    return picture_faults(pixels, check.resolution)
