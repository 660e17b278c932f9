"""Lights of a scene file as Mitsuba's emitters."""

from pathlib import Path

import numpy as np
from convert_textures import NoCounterpart, read_image
from mitsuba_types import Plugin, load_mitsuba, rgb
from numpy.typing import NDArray

TO_MITSUBA_SKY = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
"""From our environment's local directions to those of Mitsuba's, whose image is turned left to
right as well. Ours: pole +z, u = atan2(y, x) / 2 pi. Mitsuba's: pole +y, u' = atan2(x', -z') / 2
pi. With x' = -y, y' = z, z' = -x: u' = atan2(-y, x) / 2 pi = 1 - u. (Without turning the image it
would take a reflection.)"""


def convert_light(light: Plugin) -> Plugin:
    """One entry of `lights`."""
    if light["type"] == "point":
        return point(light["position"], light["flux"])
    if light["type"] == "directional":
        return {
            "type": "directional",
            "direction": [float(v) for v in light["direction"]],
            "irradiance": rgb(light["irradiance"]),
        }
    return spot(light)


def point(position: list[float], flux: list[float]) -> Plugin:
    """Intensity is flux / 4 pi."""
    intensity = np.array(flux) / (4 * np.pi)
    return {
        "type": "point",
        "position": [float(v) for v in position],
        "intensity": rgb(intensity),
    }


def spot(light: Plugin) -> Plugin:
    """Both fall off evenly with the angle between beam and cutoff."""
    mi = load_mitsuba()
    origin = np.array(light["position"], dtype=float)
    axis = np.array(light["direction"], dtype=float)
    side = np.eye(3)[np.argmin(np.abs(axis))]
    cutoff = float(light.get("cutoff_angle", 20))
    return {
        "type": "spot",
        "to_world": mi.ScalarTransform4f().look_at(
            origin.tolist(), (origin + axis).tolist(), side.tolist()
        ),
        "intensity": rgb(light["intensity"]),
        "cutoff_angle": cutoff,
        "beam_width": min(float(light.get("beam_angle", 0.75 * cutoff)), cutoff * (1 - 1e-5)),
    }


def convert_environment(folder: Path, environment: Plugin, texture: Plugin) -> Plugin:
    """The image's columns agree: texel centres at half integers. Its rows do not: Mitsuba's first
    and last row lie at the poles, ours half a texel away from them. 2 H + 1 rows hold the same
    piecewise linear function with Mitsuba's spacing, and its nodes include all of ours."""
    mi = load_mitsuba()
    scale = float(environment.get("scale", 1))
    if texture["type"] == "constant":
        return {"type": "constant", "radiance": rgb(scale * np.array(texture["color"]))}
    if texture["type"] != "image":
        raise NoCounterpart("an environment with a checkerboard")
    pixels = _rows_at_poles(read_image(folder, texture))[:, ::-1]
    to_world = np.array(environment.get("transform", np.eye(4).ravel()), dtype=float).reshape(4, 4)
    turn = np.eye(4)
    turn[:3, :3] = TO_MITSUBA_SKY.T
    return {
        "type": "envmap",
        "bitmap": mi.Bitmap(np.ascontiguousarray(pixels)),
        "scale": scale,
        "to_world": mi.ScalarTransform4f(to_world @ turn),
    }


def _rows_at_poles(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    height = len(pixels)
    y = np.clip(np.arange(2 * height + 1) / 2 - 0.5, 0, height - 1)
    above = np.minimum(y.astype(int), height - 2) if height > 1 else np.zeros(len(y), int)
    below = np.minimum(above + 1, height - 1)
    part = (y - above)[:, None, None]
    blend: NDArray[np.float32] = ((1 - part) * pixels[above] + part * pixels[below]).astype(
        np.float32
    )
    return blend
