"""Filtered textures against the truth: a bilinear picture of the base level with 4096 samples a
pixel; and how much a picture flickers while the camera moves.

A filtered lookup averages over its pixel, whatever the number of samples: so its picture is a
little softer than the truth for ever, and what converges is the mean of any part of it. `make test`
takes small pictures of a slanted plane; RAYBOOK_FULL=1 takes larger ones, of a second plane too.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mip_planes import Array, Plane
from renderer_runs import render, write_scene

from raybook_grader.judge.exr import write_exr

FULL = os.environ.get("RAYBOOK_FULL") == "1"
SIZE = (96, 96) if FULL else (42, 42)
TRUTH_SPP = 4096
FRAMES = 30
MOVING_SIZE = (48, 48) if FULL else (24, 24)
MOVING_TRUTH_SPP = 256 if FULL else 64

EYE = (0.2, 0.1, 3.0)
PLANES = {"slanted": Plane(68, 25, 40, SIZE, (128, 96), (70, 90), EYE)}
if FULL:
    PLANES["facing"] = Plane(20, 40, 40, SIZE, (128, 96), (90, 120), EYE)


def speckle(width: int, height: int) -> Array:
    """Random texels of three colours on a slow wave: detail down to the texel."""
    random = np.random.default_rng(5)
    noise = random.random((height, width, 3)) ** 2
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    wave = 0.5 + 0.3 * np.sin(2 * np.pi * x) * np.cos(4 * np.pi * y)
    return np.asarray(noise * wave[..., None])


def squares(width: int, height: int) -> Array:
    """Bright and dark squares of eight texels, the pattern that flickers most."""
    y, x = np.mgrid[0:height, 0:width]
    bright = (x // 8 + y // 8) % 2 == 0
    return np.where(bright[..., None], [0.9, 0.8, 0.7], [0.05, 0.1, 0.15])


TEXTURES = {"speckle": speckle, "squares": squares}


def picture(
    plane: Plane, texture: str, texture_filter: str, spp: int, folder: Path, radius: float = 0.5
) -> Array:
    """With max_anisotropy 16, enough for these planes."""
    write_exr(folder / "texture.exr", TEXTURES[texture](*plane.texels).astype(np.float32))
    scene = plane.scene("texture.exr", texture_filter, spp, radius, max_anisotropy=16)
    scene["sampler"] = {"type": "stratified"}
    return np.asarray(render(write_scene(folder, scene), folder), np.float64)


def thirds(values: Array) -> dict[str, Array]:
    """The whole picture, and its far, middle and near third."""
    far, middle, near = np.array_split(values, 3)
    return {"all": values, "far": far, "middle": middle, "near": near}


def root_mean_square(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def expect_mean(name: str, found: Array, truth: Array) -> None:
    """Within 1 % in the whole picture and in each third, of each colour."""
    softer = root_mean_square(found - truth) / truth.mean()
    print(f"{name}: pixels differ by {softer:.1%} of the mean (RMS); mean off by", end="")
    for region, values in thirds(found).items():
        error = np.max(np.abs(np.mean(values / np.mean(thirds(truth)[region], (0, 1)), (0, 1)) - 1))
        print(f" {error:.3%} {region}", end="")
        assert error < 0.01, f"{name}: the mean of {region} is off by {error:.2%}"
    print()


@pytest.mark.parametrize("texture", TEXTURES)
@pytest.mark.parametrize("name", PLANES)
def test_filters_converge_to_the_base_level(name: str, texture: str, tmp_path: Path) -> None:
    plane = PLANES[name]
    assert plane.footprint()[1].all()
    truth = picture(plane, texture, "bilinear", TRUTH_SPP, tmp_path)
    for texture_filter in ("trilinear", "ewa"):
        for spp in (16, 256):
            found = picture(plane, texture, texture_filter, spp, tmp_path)
            expect_mean(f"{name}, {texture}, {texture_filter}, {spp} spp", found, truth)


def flicker(frames: Array) -> float:
    """How much a pixel changes from one frame to the next."""
    return root_mean_square(np.diff(frames, axis=0))


def moved(plane: Plane, frame: int) -> Plane:
    """The camera goes forward and to the right: by about a third of a pixel a frame."""
    step = frame * 0.33 * EYE[2] * 2 * np.tan(np.radians(plane.fov) / 2) / plane.film[1]
    offset = np.array([0.8, 0.1, -0.5]) * step
    eye, target = np.array(plane.eye) + offset, np.array(plane.target) + offset
    return replace(plane, eye=(eye[0], eye[1], eye[2]), target=(target[0], target[1], target[2]))


def film(plane: Plane, texture: str, texture_filter: str, spp: int, folder: Path) -> Array:
    """All frames, one after another; of one sample a pixel in its middle, or of the whole pixel."""
    radius = 0.001 if spp == 1 else 0.5
    frames = []
    for frame in range(FRAMES):
        there = moved(plane, frame)
        assert there.footprint()[1].all()
        frames.append(picture(there, texture, texture_filter, spp, folder, radius))
    return np.stack(frames)


@pytest.mark.parametrize("texture", TEXTURES)
@pytest.mark.parametrize("name", PLANES)
def test_filtered_pictures_do_not_shimmer(name: str, texture: str, tmp_path: Path) -> None:
    """One filtered sample a pixel changes less between frames than the exact picture does, and
    the nearest texel several times as much. Being merely blurred would not do: each frame must
    also be much nearer to the exact one than the nearest texels are."""
    plane = replace(PLANES[name], film=MOVING_SIZE)
    truth = film(plane, texture, "bilinear", MOVING_TRUTH_SPP, tmp_path)
    nearest = film(plane, texture, "nearest", 1, tmp_path)
    print(f"{name}, {texture}, {FRAMES} frames: nearest flickers", end="")
    print(f" {flicker(nearest) / flicker(truth):.2f} times as much as the truth", end="")
    assert flicker(nearest) > 2.5 * flicker(truth)
    for kind in ("trilinear", "ewa"):
        found = film(plane, texture, kind, 1, tmp_path)
        nearer = root_mean_square(nearest - truth) / root_mean_square(found - truth)
        print(f", {kind} {flicker(found) / flicker(truth):.2f} times", end="")
        print(f" ({flicker(nearest) / flicker(found):.1f} times less than nearest,", end="")
        print(f" {nearer:.1f} times nearer to the truth)", end="")
        assert flicker(found) < flicker(truth)
        assert nearer > 2
    print()
