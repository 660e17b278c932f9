"""Textures and materials of a scene file as Mitsuba's.

Both programs look a bitmap up with v = 0 at its top row and texel centres at half integers. What
differs: Mitsuba has no wrap that gives black, so the image gets a black border there and is
clamped; and it has no filter over a footprint: `trilinear` is taken for `bilinear`, which is the
same only where a texel is wider than a pixel (the scenes see to that).
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from mitsuba_types import Plugin, load_mitsuba, rgb
from numpy.typing import NDArray

from raybook_grader.judge.exr import read_exr

Matrix = NDArray[np.float64]
WRAPS = {"repeat": "repeat", "clamp": "clamp", "mirror": "mirror", "black": "clamp"}
FILTERS = {"nearest": "nearest", "bilinear": "bilinear", "trilinear": "bilinear"}


class NoCounterpart(Exception):
    """Mitsuba has nothing that means the same; the text says what."""


def uv_matrix(scale: Any, delta: Any) -> Matrix:
    """uv' = uv * scale + delta, as the 4 x 4 matrix that Mitsuba wants."""
    matrix = np.eye(4)
    matrix[0, 0], matrix[1, 1] = scale
    matrix[:2, 3] = delta
    return matrix


FLIP_V = uv_matrix((1, -1), (0, 1))
"""Mitsuba's rectangle has v = 0 at y = -1, ours at y = +1/2."""


def read_image(folder: Path, texture: Plugin) -> NDArray[np.float32]:
    """Linear pixels (height, width, 3)."""
    path = folder / texture["path"]
    encoding = texture.get("encoding", "auto")
    if path.suffix == ".exr":
        if encoding == "srgb":
            raise NoCounterpart("an EXR file that holds sRGB codes")
        return read_exr(path).pixels
    mi = load_mitsuba()
    bitmap = mi.Bitmap(str(path))
    if encoding == "linear":
        bitmap.set_srgb_gamma(False)
    pixels = np.array(bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))
    return pixels.astype(np.float32)


def convert_texture(folder: Path, texture: Plugin, to_uv: Matrix) -> Plugin:
    """`to_uv`: from Mitsuba's texture coordinates of the shape to ours."""
    mi = load_mitsuba()
    if texture["type"] == "constant":
        return rgb(texture["color"])
    generator = texture.get("tex_coordinate_generator", {})
    to_uv = uv_matrix(generator.get("scale", (1, 1)), generator.get("delta", (0, 0))) @ to_uv
    if texture["type"] == "checkerboard":
        return {
            "type": "checkerboard",
            "color0": rgb(texture.get("color0", [0.4] * 3)),
            "color1": rgb(texture.get("color1", [0.2] * 3)),
            "to_uv": mi.ScalarTransform4f(to_uv),
        }
    pixels = read_image(folder, texture)
    wrap, filter_type = texture.get("wrap", "repeat"), texture.get("filter", "trilinear")
    if filter_type not in FILTERS:
        raise NoCounterpart(f"the texture filter {filter_type}")
    if wrap == "black":
        height, width = pixels.shape[:2]
        pixels = np.pad(pixels, ((1, 1), (1, 1), (0, 0)))
        inner = np.array([width / (width + 2), height / (height + 2)])
        to_uv = uv_matrix(inner, (1 - inner) / 2) @ to_uv
    return {
        "type": "bitmap",
        "bitmap": mi.Bitmap(np.ascontiguousarray(pixels)),
        "raw": True,  # linear already
        "filter_type": FILTERS[filter_type],
        "wrap_mode": WRAPS[wrap],
        "to_uv": mi.ScalarTransform4f(to_uv),
    }


def convert_material(material: Plugin, texture: Callable[[str], Plugin]) -> Plugin:
    """`texture` converts the texture of a name, for the shape that the material is on."""
    kind = material["type"]
    if kind == "diffuse":
        bsdf = {"type": "diffuse", "reflectance": texture(material["texture_name"])}
        return {"type": "twosided", "bsdf": bsdf} if material.get("twosided", False) else bsdf
    if kind == "glass":
        return {
            "type": "dielectric",
            "int_ior": float(material.get("eta", 1.5)),
            "ext_ior": 1.0,
            "specular_reflectance": rgb(material.get("R", [1] * 3)),
            "specular_transmittance": rgb(material.get("T", [1] * 3)),
        }
    if kind == "roughconductor":
        return _rough_conductor(material, texture)
    # `thindielectric` does not bend light, and `dielectric` reflects a part.
    raise NoCounterpart(f"the material {kind}")


def _rough_conductor(material: Plugin, texture: Callable[[str], Plugin]) -> Plugin:
    outside = np.array(material.get("etaI", [1] * 3))
    bsdf = {
        "type": "roughconductor",
        "distribution": "ggx",
        "sample_visible": True,
        "alpha_u": float(material.get("alpha_x", 0.1)),
        "alpha_v": float(material.get("alpha_y", 0.1)),
        # Both programs want the index relative to what is outside.
        "eta": rgb(np.array(material["etaT"]) / outside),
        "k": rgb(np.array(material["k"]) / outside),
    }
    if "texture_name" in material:
        bsdf["specular_reflectance"] = texture(material["texture_name"])
    return bsdf
