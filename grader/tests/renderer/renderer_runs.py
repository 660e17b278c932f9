"""Shared by the renderer's tests: builds it, runs it, reads what it writes."""

from __future__ import annotations

import functools
import json
import os
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import OpenEXR

from raybook_grader.files import locked

ROOT = Path(__file__).resolve().parents[3]
SOURCE = ROOT / "src"
CORNELL = ROOT / "scenes" / "cornell-box.json"
KNOT = ROOT / "scenes" / "knot.json"

Json = dict[str, Any]
Pixels = npt.NDArray[np.float32]

# What a make around the tests may have put into the environment would change the makes inside.
_OF_MAKE = {"MAKEFLAGS", "MFLAGS", "MAKELEVEL", "MAKEOVERRIDES", "CC", "CFLAGS", "LDFLAGS", "OPT"}
_OF_MAKE |= {"TODO", "VARIANT", "ARCH", "V"}


def make(*arguments: str) -> str:
    """Runs make at the top of the checkout; its standard output. A failure fails the test."""
    environment = {k: v for k, v in os.environ.items() if k not in _OF_MAKE}
    command = ["make", "-j2", *arguments]
    with locked(ROOT / "build" / ".make.lock"):
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}{done.stderr}"
    return done.stdout


@functools.cache
def program(
    opt: str = "release", cc: str = "gcc", todo: tuple[str, ...] = (), variant: str = ""
) -> Path:
    """The renderer in this configuration, up to date; the meshes of its scenes are there too."""
    make("build/meshes/done")
    settings = [f"OPT={opt}", f"CC={cc}", f"TODO={' '.join(todo)}", f"VARIANT={variant}"]
    return ROOT / make("build", *settings).splitlines()[-1]


def run(
    *arguments: str | Path,
    cwd: Path,
    binary: Path | None = None,
    wrapper: Sequence[str] = (),
    environment: Mapping[str, str] | None = None,
) -> subprocess.CompletedProcess[str]:
    """Runs the renderer in `cwd`, whatever its exit code."""
    command = [*wrapper, str(binary or program()), *map(str, arguments)]
    together = {**os.environ, **(environment or {})}
    return subprocess.run(
        command, cwd=cwd, env=together, capture_output=True, text=True, timeout=300
    )


@dataclass(frozen=True)
class Exr:
    """An image file: R, G, B of each pixel, the header, and each channel's type."""

    pixels: Pixels
    header: Mapping[str, Any]
    types: Mapping[str, str]


def read_exr(path: Path) -> Exr:
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = {name: channel.pixels for name, channel in file.channels().items()}
        pixels = np.stack([channels[name] for name in "RGB"], axis=-1)
        types = {name: str(values.dtype) for name, values in channels.items()}
        return Exr(pixels, dict(file.header()), types)


def render(scene: Path, folder: Path, *arguments: str | Path, binary: Path | None = None) -> Pixels:
    """The picture of a scene; the run must succeed."""
    output = folder / "picture.exr"
    done = run(scene, "-o", output, *arguments, cwd=folder, binary=binary)
    assert done.returncode == 0, done.stderr
    return read_exr(output).pixels


def write_scene(folder: Path, scene: Json, name: str = "scene.json") -> Path:
    path = folder / name
    path.write_text(json.dumps(scene), encoding="utf-8")
    return path


def write_mesh(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def diffuse(**colours: Sequence[float]) -> Json:
    """The `textures` and `materials` of a scene: a diffuse material for each colour."""
    return {
        "textures": {k: {"type": "constant", "color": list(v)} for k, v in colours.items()},
        "materials": {k: {"type": "diffuse", "texture_name": k} for k in colours},
    }


def sphere(center: Sequence[float], radius: float, material: str) -> Json:
    return {
        "type": "sphere",
        "center": list(center),
        "radius": radius,
        "material_name": material,
    }


def mesh(path: str, material: str, **more: Any) -> Json:
    return {"type": "mesh", "path": path, "material_name": material, **more}


def point_light(position: Sequence[float], flux: Sequence[float]) -> Json:
    return {"type": "point", "position": list(position), "flux": list(flux)}
