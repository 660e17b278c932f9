"""The rows of variance.py's table: what is compared, where, and what it must reach."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from renderer_runs import ROOT, Json


@dataclass(frozen=True)
class Way:
    """One way of sampling: the change of the scene file, or of the program, that asks for it."""

    name: str
    change: Json = field(default_factory=dict)
    plain_program: bool = False  # variants/plain-sampling


@dataclass(frozen=True)
class Row:
    """A better way against a plain one, on a scene."""

    better: Way
    plain: Way
    scene: str  # below scenes/
    must_beat: float
    because: str
    change: Json = field(default_factory=dict)  # for both
    spp: int = 16
    resolution: tuple[int, int] = (64, 64)
    at_equal_work: bool = False  # variance x rays is judged, not variance

    @property
    def path(self) -> Path:
        return ROOT / "scenes" / self.scene


def sampler(name: str) -> Way:
    return Way(name, {"sampler": {"type": name}})


def profile(code: str, name: str) -> Way:
    return Way(name, {"integrator": {"profile": code}})


def selection(name: str) -> Way:
    return Way(f"lights by {name}", {"integrator": {"light_selection": name}})


RW = profile("RW", "BSDF sampling")
NEE = profile("NEE", "light sampling")
MIS = profile("MIS", "both, weighted (MIS)")
INDEPENDENT, STRATIFIED, SOBOL = map(sampler, ("independent", "stratified", "sobol"))

BOX: Json = {"film": {"filter": {"type": "box", "radius": 0.5}}}

# Through the middles of the pixels, so that no edge's noise hides that of the light.
MIDDLES = {"film": {"filter": {"type": "box", "radius": 0.001}}}
RANDOM = {"sampler": {"type": "independent"}}
ONE_BOUNCE: Json = {
    **MIDDLES,
    **RANDOM,
    "integrator": {"type": "path", "max_depth": 1, "rr_threshold": 0, "light_selection": "all"},
}
CORNELL = "test/compare/cornell-roulette-nee.json"
RECTS = "test/compare/rect-lights.json"
SUN = "test/compare/environment-sun.json"
FURNACE = "test/furnace.json"
PLATES = "veach-mis.json"
TWO = "test/two-lights.json"
GLOSS = "test/asymmetric-environment.json"

UNLIKE_LIGHTS: Json = {
    **ONE_BOUNCE,
    "integrator": {
        **ONE_BOUNCE["integrator"],
        "profile": "NEE",
        "point_light_position": None,
        "point_light_flux": None,
    },
    "lights": [
        {"type": "point", "position": [-2, 4, 1], "flux": [800, 800, 800]},
        *(
            {"type": "point", "position": [-2 + 0.25 * i, 4 - 0.1 * i, 2], "flux": [50, 40, 60]}
            for i in range(16)
        ),
    ],
}
"""Half of the light comes from one light of 17."""

SILVER: Json = {
    "type": "roughconductor",
    "alpha_x": 0.02,
    "alpha_y": 0.02,
    "etaT": [0.155, 0.117, 0.138],
    "k": [4.828, 3.122, 2.147],
}
ALL_METAL: Json = {**ONE_BOUNCE, "materials": {"grey": {**SILVER, "texture_name": None}}}
METAL_BALL: Json = {
    **ONE_BOUNCE,
    "materials": {"metal": {**SILVER, "alpha_x": 0.2, "alpha_y": 0.3}},
    "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1.5, "material_name": "metal"}],
}

BOUNCES: Json = {**MIDDLES, **RANDOM}
ROULETTE = Way("Russian roulette", {"integrator": {"rr_threshold": 0.6}})
NO_ROULETTE = Way("no roulette", {"integrator": {"rr_threshold": 0}})
SKY = Way("sky by luminance", NEE.change)
EVEN_SKY = Way("sky evenly", NEE.change, plain_program=True)
VISIBLE = Way("visible normals", RW.change)
COSINE = Way("cosine", RW.change, plain_program=True)

EDGE = "an edge crosses at most 2 sqrt(n) of n cells: n / (2 sqrt(n)) = 4"
FEW_CELLS = "as for an edge: a penumbra is an edge across the lamp"
SMALL_LAMP = "the lamp is about 1/50 of what the floor sees, so chance finds it once in 50"
SMOOTH = "a mirror-like ball sees a spot of the sky; samples of the sky hardly ever fall in it"
EACH_FAILS = "each way alone fails on some plates; the weights keep the better one on each"
STRONG = "evenly: 17 (1/4 + 16/32^2) - 1 = 3.5 of the squared mean; by power below 1"
SUNNY = "the sun is a small part of the sky and most of its light"
LOBE = "the lobe is a small part of the hemisphere; visible normals lose only what G1 hides"
CHEAPER = "dark paths end early, and what they cost goes into others"

ROWS = (
    Row(STRATIFIED, INDEPENDENT, "test/edges.json", 4, EDGE, BOX, spp=64),
    Row(SOBOL, INDEPENDENT, "test/edges.json", 4, EDGE, BOX, spp=64),
    Row(STRATIFIED, INDEPENDENT, RECTS, 4, FEW_CELLS, ONE_BOUNCE, spp=64),
    Row(SOBOL, INDEPENDENT, RECTS, 4, FEW_CELLS, ONE_BOUNCE, spp=64),
    Row(NEE, RW, CORNELL, 50, SMALL_LAMP, ONE_BOUNCE),
    Row(RW, NEE, GLOSS, 10, SMOOTH, ALL_METAL),
    Row(MIS, RW, PLATES, 4, EACH_FAILS, ONE_BOUNCE),
    Row(MIS, NEE, PLATES, 4, EACH_FAILS, ONE_BOUNCE),
    Row(selection("power"), selection("uniform"), TWO, 3.5, STRONG, UNLIKE_LIGHTS),
    Row(SKY, EVEN_SKY, SUN, 5, SUNNY, ONE_BOUNCE),
    Row(VISIBLE, COSINE, FURNACE, 10, LOBE, METAL_BALL),
    Row(ROULETTE, NO_ROULETTE, CORNELL, 1, CHEAPER, BOUNCES, at_equal_work=True),
)
