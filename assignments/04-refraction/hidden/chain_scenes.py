"""Scenes that try a chain of clear surfaces, and the rays to send through them.

In a *hall of mirrors* the clear surfaces are glass with an index of 10, seen from its inside: all
but straight on, light is mirrored totally, by a colour, and no refraction_direction has a say.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from chain_things import Array, Json

Vector = Any
"""Three numbers, in any form."""

GREY = [0.7, 0.7, 0.7]


@dataclass(frozen=True)
class Shot:
    """A scene, and n rays."""

    label: str
    scene: Json
    origin: Array
    direction: Array


@dataclass
class Stage:
    """A scene in the making.

    Every thing has a material of its own, or is a lamp. All is made ``scale`` times as large.
    """

    lamp: Vector = (0, 0, 0)
    flux: Vector = (300, 250, 200)
    max_depth: int = 16
    scale: float = 1.0
    objects: list[Json] = field(default_factory=list)
    materials: Json = field(default_factory=dict)
    textures: Json = field(default_factory=dict)
    lights: list[Json] = field(default_factory=list)
    sky: bool = False

    def rect(
        self, center: Vector, x: Vector, y: Vector, material: Json | None, **more: Any
    ) -> None:
        """A rect with sides x and y, at right angles; its normal is x cross y."""
        across = np.cross(x, y)
        columns = [x, y, across / np.linalg.norm(across), center]
        rows = np.vstack([np.column_stack([np.asarray(c, float) for c in columns]), [0, 0, 0, 1]])
        rows[:3, [0, 1, 3]] *= self.scale
        self._add({"type": "rect", "transform": rows.ravel().tolist()}, material, more)

    def sphere(self, center: Vector, radius: float, material: Json | None, **more: Any) -> None:
        place = (np.asarray(center, float) * self.scale).tolist()
        self._add(
            {"type": "sphere", "center": place, "radius": radius * self.scale}, material, more
        )

    def paint(self, color: Vector, twosided: bool = True) -> Json:
        """A diffuse material."""
        name = f"t{len(self.textures)}"
        self.textures[name] = {"type": "constant", "color": [float(c) for c in color]}
        return {"type": "diffuse", "texture_name": name, "twosided": twosided}

    def shine(self, position: Vector, flux: Vector) -> None:
        """One more point light."""
        place = (np.asarray(position, float) * self.scale).tolist()
        power = (np.asarray(flux, float) * self.scale**2).tolist()
        self.lights.append({"type": "point", "position": place, "flux": power})

    def shot(self, label: str, origin: Vector, direction: Vector) -> Shot:
        """The scene with its rays, all numbers rounded to single precision."""
        scene: Json = {
            "integrator": {
                "type": "intersection_test",
                "max_depth": self.max_depth,
                "point_light_position": (np.asarray(self.lamp, float) * self.scale).tolist(),
                "point_light_flux": (np.asarray(self.flux, float) * self.scale**2).tolist(),
            },
            "textures": self.textures,
            "materials": self.materials,
            "objects": self.objects,
            "lights": self.lights,
        }
        if self.sky:
            self.textures["sky"] = {"type": "constant", "color": [1.0, 2.0, 3.0]}
            scene["environment_map"] = {"texture_name": "sky"}
        o = np.atleast_2d(np.asarray(origin, float)) * self.scale
        d = np.atleast_2d(np.asarray(direction, float))
        d = d / np.linalg.norm(d, axis=1, keepdims=True)
        o, d = np.broadcast_arrays(o, d)
        single = [a.astype(np.float32).astype(np.float64) for a in (o, d)]
        return Shot(label, _rounded(scene), *single)

    def _add(self, entry: Json, material: Json | None, more: Json) -> None:
        if material:
            name = f"m{len(self.materials)}"
            self.materials[name] = material
            entry["material_name"] = name
        else:
            entry["light"] = lamp_of((5, 4, 3))
        self.objects.append({**entry, **more})


def mirror(color: Vector = (1, 1, 1)) -> Json:
    """Seen from the inside and not straight on, a mirror of that colour."""
    return {"type": "glass", "eta": 10.0, "R": [float(c) for c in color], "T": [1.0, 1.0, 1.0]}


def pane(color: Vector) -> Json:
    """Lets light straight through, times a colour."""
    return {"type": "glass", "eta": 1.0, "R": [1.0, 1.0, 1.0], "T": [float(c) for c in color]}


def clear(eta: float) -> Json:
    return {"type": "refraction", "eta": eta}


def lamp_of(radiance: Vector) -> Json:
    """What makes an object an area light."""
    return {"type": "area", "radiance": [float(c) for c in radiance]}


def box(stage: Stage, half: Vector, walls: list[Json | None], frame: Array, center: Vector) -> None:
    """Six rects whose normals point out of the box; a wall {} is left open."""
    half, center = np.asarray(half, float), np.asarray(center, float)
    for axis in range(3):
        for side in (1, -1):
            wall = walls[2 * axis + (side < 0)]
            n, x, y = (frame[:, (axis + i) % 3] for i in range(3))
            a, b = half[(axis + 1) % 3], half[(axis + 2) % 3]
            if wall != {}:
                stage.rect(center + side * half[axis] * n, 2 * a * x, 2 * b * side * y, wall)


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_rounded(item) for item in value]
    return float(np.float32(value)) if isinstance(value, float) else value
