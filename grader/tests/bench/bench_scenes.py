"""The scenes whose pictures are compared, as files that both renderers read."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bench_programs import ROOT

Json = dict[str, Any]


@dataclass(frozen=True)
class BenchScene:
    """A scene file with changes. `best`: further changes where each renderer may do its best."""

    name: str
    path: str  # below scenes/
    change: Json = field(default_factory=dict)
    best: Json = field(default_factory=dict)

    def write(self, folder: Path, resolution: tuple[int, int], best: bool = False) -> Path:
        """The scene with its changes, its paths made absolute; a square pixel filter."""
        source = ROOT / "scenes" / self.path
        scene = json.loads(source.read_text(encoding="utf-8"))
        scene.pop("$schema", None)
        film: Json = {"resolution": list(resolution), "filter": {"type": "box", "radius": 0.5}}
        for change in (self.change, {"film": film}, self.best if best else {}):
            scene = merged(scene, change)
        make_absolute(scene, source.parent)
        out = folder / f"{self.name}-{'best' if best else 'equal'}.json"
        out.write_text(json.dumps(scene, indent=1), encoding="utf-8")
        return out


def merged(one: Json, other: Json) -> Json:
    """JSON Merge Patch (RFC 7396): objects by key, None removes, all else is replaced."""
    out = dict(one)
    for key, value in other.items():
        if value is None:
            out.pop(key, None)
        elif isinstance(value, dict) and isinstance(out.get(key), dict):
            out[key] = merged(out[key], value)
        else:
            out[key] = value
    return out


def make_absolute(scene: Json, folder: Path) -> None:
    """The paths of images and meshes, in place."""
    for item in [*scene.get("textures", {}).values(), *scene.get("objects", [])]:
        if "path" in item:
            item["path"] = str((folder / item["path"]).resolve())


INDEPENDENT: Json = {"sampler": {"type": "independent"}}
"""Equal samples: neither renderer spreads them, and no path ends by roulette."""

SOBOL: Json = {"sampler": {"type": "sobol"}}

NO_ROULETTE: Json = {"integrator": {"rr_threshold": 0}}
ROULETTE: Json = {"integrator": {"rr_threshold": 0.1}}

BILINEAR: Json = {
    "textures": {
        name: {"filter": "bilinear", "max_anisotropy": None}
        for name in ("checker", "planet", "marble", "ball", "stripes", "sky")
    }
}
"""Mitsuba has no texture filter that is wider."""

ONE_BOUNCE: Json = {
    "integrator": {
        "type": "path",
        "max_depth": 1,
        "profile": "MIS",
        "rr_threshold": 0,
        "light_selection": "uniform",
    }
}

BEST = merged(SOBOL, ROULETTE)
CORNELL = BenchScene("cornell", "test/compare/cornell-depth-6.json", INDEPENDENT, BEST)
ENVIRONMENT = BenchScene("environment", "sunny-sky.json", merged(INDEPENDENT, NO_ROULETTE), BEST)
TEXTURES = BenchScene(
    "textures",
    "textures.json",
    merged(merged(BILINEAR, ONE_BOUNCE), INDEPENDENT),
    merged(SOBOL, {"integrator": {"light_selection": "power"}}),
)
SCENES = (CORNELL, ENVIRONMENT, TEXTURES)
