"""A tilted plane with an image on it: its scene, and in closed form what each pixel sees of it.

Plane and film are related by a projective map, three by three. It is inverted and differentiated
here in double precision; the renderer follows ray differentials instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from renderer_runs import Json

Array = npt.NDArray[np.float64]

SIDE = 200.0  # of the plane, in metres


@dataclass(frozen=True)
class Plane:
    """Turned in itself by `spin`, then leant back by `tilt` (90: seen from its edge); degrees."""

    tilt: float
    spin: float
    fov: float
    film: tuple[int, int]
    texels: tuple[int, int]
    repeats: tuple[float, float]  # of the texture along the plane's sides
    eye: tuple[float, float, float] = (0.0, 0.0, 3.0)
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def sides(self) -> Array:
        """The plane's sides as columns: along its x and its y."""
        a, b = np.radians(self.spin), np.radians(self.tilt)
        spin = np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)], [0, 0]])
        lean = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
        lean[2] *= -1  # away from the eye at the top
        return SIDE * np.asarray(lean @ spin)

    def film_to_uv(self) -> Array:
        """(u, v, 1) of the plane, times a positive number, from (x, y, 1) of the film."""
        sides = self.sides()
        eye, target = np.array(self.eye), np.array(self.target)
        forward = (target - eye) / np.linalg.norm(target - eye)
        right = np.cross(forward, [0, 1, 0])
        right /= np.linalg.norm(right)
        axes = np.stack([right, np.cross(forward, right), forward])
        u_axis, v_axis = sides[:, 0], -sides[:, 1]
        corner = -(u_axis + v_axis) / 2 - eye
        to_axes = axes @ np.stack([u_axis, v_axis, corner], axis=1)
        width, height = self.film
        focal = height / 2 / np.tan(np.radians(self.fov) / 2)  # in pixels
        to_film = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
        return np.asarray(np.linalg.inv(to_film @ to_axes))

    def footprint(self) -> tuple[Array, npt.NDArray[np.bool_]]:
        """At each pixel's centre: how many texels one pixel to the right and one down are, as the
        columns of a matrix; and whether the pixel sees the plane at all."""
        width, height = self.film
        x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        inverse = self.film_to_uv()
        q = np.stack([x, y, np.ones_like(x)], axis=-1) @ inverse.T
        uv, depth = q[..., :2] / q[..., 2:], q[..., 2]
        seen = (depth > 0) & np.all((uv > 0) & (uv < 1), axis=-1)
        # The quotient rule, for both coordinates and both directions.
        steps = (inverse[:2, :2] - uv[..., :, None] * inverse[2, :2]) / depth[..., None, None]
        scale = np.array(self.texels) * np.array(self.repeats)
        return steps * scale[:, None], seen

    def level_count(self) -> int:
        return max(self.texels).bit_length()

    def trilinear_level(self) -> Array:
        steps, _ = self.footprint()
        longest = np.linalg.norm(steps, axis=-2).max(axis=-1)
        return np.asarray(np.clip(np.log2(longest), 0, self.level_count() - 1))

    def ewa_level(self, max_anisotropy: float) -> Array:
        """The half axes are the singular values; the shorter one is 1.5 texels of the level."""
        steps, _ = self.footprint()
        axes = np.linalg.svd(steps, compute_uv=False)
        shorter = np.maximum(axes[..., 1], axes[..., 0] / max_anisotropy)
        return np.asarray(np.clip(np.log2(shorter / 1.5), 0, self.level_count() - 1))

    def scene(self, path: str, texture_filter: str, spp: int, radius: float, **more: Any) -> Json:
        """Lit evenly, so that the radiance is the albedo: the light comes straight down on the
        plane with an irradiance of pi. `radius`: of the pixels' box filter; 0.5 is the pixel."""
        sides = self.sides() / SIDE
        normal = np.cross(sides[:, 0], sides[:, 1])
        matrix = np.eye(4)
        matrix[:3, :2], matrix[:3, 2] = SIDE * sides, normal
        texture = {
            "type": "image",
            "path": path,
            "filter": texture_filter,
            "encoding": "linear",
            "tex_coordinate_generator": {"scale": list(self.repeats)},
            **more,
        }
        return {
            "integrator": {"type": "direct", "spp": spp},
            "film": {"resolution": list(self.film), "filter": {"type": "box", "radius": radius}},
            "camera": {"position": list(self.eye), "look_at": list(self.target), "fov": self.fov},
            "textures": {"texture": texture},
            "materials": {"m": {"type": "diffuse", "texture_name": "texture", "twosided": True}},
            "objects": [
                {"type": "rect", "transform": matrix.ravel().tolist(), "material_name": "m"}
            ],
            "lights": [
                {
                    "type": "directional",
                    "direction": (-normal).tolist(),
                    "irradiance": [np.pi] * 3,
                }
            ],
        }
