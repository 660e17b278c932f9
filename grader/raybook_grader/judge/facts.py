"""What the judge measured, as a reader of a report is told it."""

from collections.abc import Sequence

from .compare import PairNumbers
from .findings import BiasVerdict, percent
from .perceptual import PerceptualError
from .pixels import CHANNELS
from .thresholds import THRESHOLDS, Thresholds
from .viewer import Fact

_DELTA_E = "\N{GREEK CAPITAL LETTER DELTA}E ITP"


def facts_of_judgement(
    bias: BiasVerdict, visible: PerceptualError, limits: Thresholds = THRESHOLDS
) -> tuple[Fact, ...]:
    """The verdict and what it means, the noise, and how visible the error is."""
    facts = [_verdict(bias)]
    if bias.noise_ratio is not None:
        facts.append(_noise(bias.noise_ratio, limits))
    if bias.channel_bias is not None:
        facts.append(_channels(bias.channel_bias))
    facts += [_flip(visible.flip, visible.noise_flip), _colour(visible.colour.p95)]
    return tuple(facts)


def facts_of_pair(n: PairNumbers) -> tuple[Fact, ...]:
    """The numbers of `compare`."""
    return (
        _flip(n.flip, n.noise_flip),
        Fact(_DELTA_E, f"{n.colour.mean:.2f}", f"95 % of the pixels are below {n.colour.p95:.2f}"),
        _mean(n.overall_bias, n.channel_bias),
        Fact(
            "Tiles of 16 \N{MULTIPLICATION SIGN} 16 pixels",
            percent(n.rms_bias),
            "root mean square, noise taken out",
        ),
    )


def _verdict(bias: BiasVerdict) -> Fact:
    value, meaning = {
        "pass": ("no bias", "with more samples it becomes the reference; its noise costs nothing"),
        "fail": ("biased", "no number of samples would make it the reference"),
        "inconclusive": ("too noisy to tell", "it may be right: less noise would show it"),
    }[bias.status]
    if bias.unconfirmed and bias.status == "pass":
        meaning += "; a first doubt was not borne out by fresh seeds"
    return Fact("What the seeds say", value, meaning)


def _noise(ratio: float, limits: Thresholds) -> Fact:
    times = "\N{MULTIPLICATION SIGN}"
    value = f"{ratio:.2g} {times}" if ratio < 100 else f"{ratio:,.0f} {times}"
    meaning = (
        f"the reference's variance of one sample; up to {limits.noise_ratio:g} {times} is judged"
    )
    return Fact("Noise", value, meaning)


def _mean(overall: float, by_channel: Sequence[float]) -> Fact:
    pairs = zip(CHANNELS, by_channel, strict=True)
    parts = ", ".join(f"{name} {percent(value, signed=True)}" for name, value in pairs)
    return Fact("Mean of the picture", percent(overall, signed=True), parts)


def _channels(by_channel: Sequence[float]) -> Fact:
    value = ", ".join(percent(x, signed=True).removesuffix(" %") for x in by_channel) + " %"
    return Fact("Mean of the picture", value, "red, green and blue against the reference's")


def _flip(value: float, noise: float) -> Fact:
    return Fact(
        "Visible error (FLIP)",
        f"{value:.4f}",
        f"its noise alone makes {noise:.4f}; 0 is the same, 1 the most",
    )


def _colour(p95: float) -> Fact:
    return Fact(_DELTA_E, f"{p95:.2f}", "95 % of the pixels are below; 1 is just visible")
