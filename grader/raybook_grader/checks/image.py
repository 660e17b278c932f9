"""The `image` check: the scene rendered with the student's module, judged by `judge`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..course import ImageCheck
from ..diagnosis.trace import Trace, trace_of_picture
from ..judge.facts import facts_of_judgement
from ..judge.image import ImageJudgement, judge_image
from ..judge.pixels import Image
from ..judge.reference import ReferenceStatistics
from ..judge.viewer import viewer_html
from .decode import Undecodable, decode
from .reference import References
from .rendering import PICTURE, Picture, picture_of
from .result import CheckResult, Status, conclude
from .scene import scene_binds
from .subject import Stopped, Subject
from .trouble import Trouble

_FRESH = 1000
"""The second look's seeds are the first look's plus this."""

_MOST_CPU_SECONDS = 12.0
"""For one render, where the assignment would allow more. The references take half a second at most,
right and slow modules two or three: this stops only what tests everything against everything."""

_KINDS = {
    "size": "picture of a wrong size",
    "nan": "NaN in the picture",
    "infinite": "infinite pixels",
    "negative": "negative pixels",
    "identical": "the seed has no effect",
    "G": "picture too bright, too dark or tinted",
    "R": "light in the wrong places",
    "L16": "parts of the picture too bright or too dark",
    "L32": "parts of the picture too bright or too dark",
    "D": "dead pixels",
    "noise": "too noisy",
}
"""The judge's codes in words."""


def check_image(check: ImageCheck, subject: Subject, references: References) -> CheckResult:
    """Passed if the picture is unbiased; points by how visible its error is.

    Raises `Stopped` if a run gives no picture to judge.
    """
    picture = picture_of(check)
    seeds = range(check.first_seed, check.first_seed + check.seeds)
    reference = references.statistics(picture)
    judgement = judge_image(
        lambda at: _render(subject, picture, at),
        reference,
        check.spp,
        seeds=seeds,
        fresh_seeds=[seed + _FRESH for seed in seeds],
        reference_renders=references.renders(picture),
    )
    return _tell(check, judgement, reference)


def _render(subject: Subject, picture: Picture, seeds: Sequence[int]) -> list[Image]:
    files = [_render_one(subject, picture, seed) for seed in seeds]
    try:
        return decode(subject.workshop, files, max_pixels=4 * picture.pixels)
    except Undecodable as reason:
        raise Stopped(_no(f"the picture cannot be read: {reason}", "unreadable picture")) from None


def _render_one(subject: Subject, picture: Picture, seed: int) -> bytes:
    usual = subject.limits
    result = subject.run(
        subject.renderer,
        picture.arguments(seed),
        binds=scene_binds(subject.workshop.course.root, picture.scene),
        collect=[PICTURE],
        limits=replace(usual, cpu_seconds=min(usual.cpu_seconds, _MOST_CPU_SECONDS)),
    )
    if result.ok and PICTURE in result.files:
        return result.files[PICTURE]
    raise Stopped(_no(f"the renderer {result.describe()} and left no picture", "no picture"))


def _no(message: str, fingerprint: str) -> Trouble:
    return Trouble(Status.FAILED, message, fingerprint)


def _tell(
    check: ImageCheck, judgement: ImageJudgement, reference: ReferenceStatistics
) -> CheckResult:
    status = {
        "pass": Status.PASSED,
        "fail": Status.FAILED,
        "inconclusive": Status.PARTIAL,
    }[judgement.bias.status]
    share = judgement.score / 100
    if status is Status.PASSED and share < 1:
        status = Status.PARTIAL
    reasons = judgement.bias.reasons
    said = {
        "pass": "the picture converges to the reference",
        "fail": "the picture differs from the reference",
        "inconclusive": "the picture cannot be judged",
    }[judgement.bias.status]
    return conclude(
        check,
        status,
        f"{said} (perceptual score {judgement.score:.0f} of 100)",
        share=share,
        cases=tuple(reason.sentence for reason in reasons),
        fingerprint=_KINDS[reasons[0].code] if reasons else "",
        picture=_viewer(check, judgement, reference),
        trace=_trace(judgement, reference) if status is Status.FAILED else None,
    )


def _trace(judgement: ImageJudgement, reference: ReferenceStatistics) -> Trace | None:
    if judgement.mean is None:
        return None
    codes = (reason.code for reason in judgement.bias.reasons)
    return trace_of_picture(codes, judgement.mean, reference.mean)


def _viewer(check: ImageCheck, judgement: ImageJudgement, reference: ReferenceStatistics) -> str:
    """Reference, the student's and the error maps; nothing for a picture of a wrong size."""
    visible, mean = judgement.visible, judgement.mean
    if visible is None or mean is None:
        return ""
    return viewer_html(
        reference.mean,
        mean,
        visible.flip_map,
        f"The mean of {judgement.pictures} pictures of {check.spp} samples a pixel, and the "
        f"reference at {reference.spp}",
        delta_e=visible.colour.map,
        facts=facts_of_judgement(judgement.bias, visible),
    )
