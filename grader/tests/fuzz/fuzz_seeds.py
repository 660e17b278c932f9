"""Where the fuzzer starts: valid files of every kind, the malformed ones of the test suite, and
the keywords of the formats. Made anew each time, from the repository and from fixed numbers."""

from __future__ import annotations

import io
import json
import struct
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
from PIL import Image

CHECKOUT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(CHECKOUT / "grader" / "tests" / "malformed"))

from corpus import CASES  # noqa: E402

MESH = b"""v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nvn 0 1 0
f 1/1/1 2/2/1 3/3/1\nf 1/1/2 2/2/2 4/3/2\nf -4/-1/-1 -2/-2/-2 -1/-3/-1\n"""


def seeds(name: str) -> dict[str, bytes]:
    """The seeds of a harness, by file name."""
    return {"scene": scene_seeds, "obj": obj_seeds, "image": image_seeds}[name]()


def furniture() -> dict[str, bytes]:
    """The files that the seeds of the scene loader refer to."""
    images = image_seeds()
    return {
        "mesh.obj": MESH,
        "image.png": images["rgb.png"],
        "image.exr": images["zip-half.exr"],
        "image.hdr": images["runs.hdr"],
        "image.jpg": images["rgb.jpg"],
    }


def dictionary() -> str:
    """libFuzzer's dictionary: every word of the scene's schema, and OBJ's and JPEG's marks."""
    words: set[str] = set()
    schema = json.loads((CHECKOUT / "scenes" / "scene.schema.json").read_text())
    for key, value in _members(schema):
        words.add(key)
        words.update(text for text in _listed(value) if isinstance(text, str) and len(text) < 30)
    words.update(["v ", "vt ", "vn ", "f ", "1/1/1", "1//1", "-1", "1e38", "1e-45", "#?RADIANCE"])
    plain = sorted(word for word in words if word.isascii() and '"' not in word)
    marks = [f"\\xff\\x{code:02x}" for code in (0xC0, 0xC2, 0xC4, 0xD8, 0xD9, 0xDA, 0xDB, 0xDD)]
    lines = [word.replace("\\", "\\\\") for word in plain] + marks
    return "".join(f'"{line}"\n' for line in lines)


def _members(node: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(node, dict):
        for key, value in node.items():
            yield key, value
            yield from _members(value)
    elif isinstance(node, list):
        for value in node:
            yield from _members(value)


def _listed(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


# Scenes and meshes -----------------------------------------------------------------------------


def scene_seeds() -> dict[str, bytes]:
    """The repository's scenes, with the furniture for what they refer to, and malformed ones."""
    files = {}
    for path in sorted((CHECKOUT / "scenes").rglob("*.json")):
        if path.name != "scene.schema.json":
            scene = _at_home(json.loads(path.read_text()))
            files[path.name] = json.dumps(scene, separators=(",", ":")).encode()
    for i, case in enumerate(CASES):
        content = case.files.get("scene.json")
        if isinstance(content, bytes) and len(content) < 5000:
            files[f"malformed-{i}.json"] = content
    return files


def _at_home(node: Any) -> Any:
    """The same with paths to the furniture."""
    if isinstance(node, list):
        return [_at_home(item) for item in node]
    if not isinstance(node, dict):
        return node
    changed = {key: _at_home(value) for key, value in node.items()}
    if isinstance(changed.get("path"), str):
        ending = changed["path"].rpartition(".")[2]
        changed["path"] = f"{'mesh' if ending == 'obj' else 'image'}.{ending}"
    return changed


def obj_seeds() -> dict[str, bytes]:
    """A small mesh with everything in it, odd notations, and malformed ones."""
    files = {
        "mesh.obj": MESH,
        "polygon.obj": b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1.0 0.5\nf 1 2 \\\r\n 3 4 # end\r\n",
        "groups.obj": b"o a\ng b\ns 1\nusemtl m\nv .5 -1.e2 +3E-2\nv 1 1 1\nv 2 2 2\nf 1// 2// 3//",
    }
    for i, case in enumerate(CASES):
        content = case.files.get("mesh.obj")
        if isinstance(content, bytes):
            files[f"malformed-{i}.obj"] = content
    return files


# Images ----------------------------------------------------------------------------------------

HEIGHT, WIDTH = 9, 12


def image_seeds() -> dict[str, bytes]:
    """A small picture in every kind of file that is read, and in some that are refused."""
    return {**_pillow_seeds(), **_hdr_seeds(), **_exr_seeds()}


def _pixels() -> np.ndarray[Any, np.dtype[np.uint8]]:
    y, x, c = np.mgrid[0:HEIGHT, 0:WIDTH, 0:3]
    return np.asarray((37 * x + 91 * y * (c + 1)) % 256, np.uint8)


def _pillow_seeds() -> dict[str, bytes]:
    picture = Image.fromarray(_pixels())
    files = {}
    for mode in ("1", "L", "LA", "P", "RGB", "RGBA"):
        files[f"{mode.lower()}.png"] = _saved(picture.convert(mode), "PNG")
    deep = _pixels()[:, :, 0].astype(np.uint16) * 257
    files["deep.png"] = _saved(Image.fromarray(deep), "PNG")
    for mode in ("L", "RGB", "CMYK"):
        files[f"{mode.lower()}.jpg"] = _saved(picture.convert(mode), "JPEG", quality=60)
    files["progressive.jpg"] = _saved(picture, "JPEG", progressive=True, quality=50)
    files["subsampled.jpg"] = _saved(picture, "JPEG", subsampling=2, quality=30)
    files["restarts.jpg"] = _saved(picture, "JPEG", restart_marker_blocks=1)
    return files


def _saved(picture: Image.Image, kind: str, **options: Any) -> bytes:
    out = io.BytesIO()
    picture.save(out, kind, **options)
    return out.getvalue()


def _hdr_seeds() -> dict[str, bytes]:
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n"
    flat = bytes(range(64, 128))
    row = struct.pack(">BBH", 2, 2, 8) + b"".join(
        bytes([128 + 5, 10 * c, 3, 1, 2, 3]) for c in range(1, 5)
    )
    return {"flat.hdr": head + flat, "runs.hdr": head + 2 * row, "cut.hdr": head + row[:-3]}


def _exr_seeds() -> dict[str, bytes]:
    compressions = {
        "none": OpenEXR.NO_COMPRESSION, "rle": OpenEXR.RLE_COMPRESSION,
        "zips": OpenEXR.ZIPS_COMPRESSION, "zip": OpenEXR.ZIP_COMPRESSION,
        "piz": OpenEXR.PIZ_COMPRESSION, "pxr24": OpenEXR.PXR24_COMPRESSION,
        "b44": OpenEXR.B44_COMPRESSION, "b44a": OpenEXR.B44A_COMPRESSION,
        "dwaa": OpenEXR.DWAA_COMPRESSION,
    }  # fmt: skip
    values = 1 + _pixels().astype(np.float32) / 64  # far enough from 0 for lossy compression
    files = {}
    for name, compression in compressions.items():
        for kind in (np.float16, np.float32, np.uint32):
            header = {"compression": compression, "type": OpenEXR.scanlineimage}
            label = {"float16": "half", "float32": "float", "uint32": "uint"}[kind.__name__]
            files[f"{name}-{label}.exr"] = _exr(header, {"RGB": values.astype(kind)})
    tiles = OpenEXR.TileDescription()
    tiles.xSize, tiles.ySize = 5, 4
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.tiledimage, "tiles": tiles}
    files["tiled.exr"] = _exr(header, {"RGB": values})
    plain = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    files["grey.exr"] = _exr(plain, {"Y": values[:, :, 0], "A": values[:, :, 1]})
    window = {"dataWindow": ((2, 1), (WIDTH + 1, HEIGHT)), "displayWindow": ((0, 0), (9, 9))}
    files["window.exr"] = _exr({**plain, **window}, {"RGB": values})
    return files


def _exr(header: dict[str, Any], channels: dict[str, Any]) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "seed.exr"
        OpenEXR.File(header, channels).write(str(path))
        return path.read_bytes()
