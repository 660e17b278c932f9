"""The demo and test scenes: valid, loadable, and neither black nor blown out.

Also: the defaults that scene.schema.json states are the ones that the loader takes.
"""

from __future__ import annotations

import copy
import functools
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from renderer_runs import ROOT, Json, Pixels, render, write_scene

SCENES = ROOT / "scenes"
SCHEMA: Json = json.loads((SCENES / "scene.schema.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
ALL = sorted({*SCENES.glob("*.json"), *SCENES.glob("test/*.json")} - {SCENES / "scene.schema.json"})
SMALL = ("--resolution", "32x32", "--spp", "4")


@functools.cache
def images() -> Path:
    """The generated textures and environment maps, up to date."""
    folder = ROOT / "build" / "images"
    subprocess.run([sys.executable, SCENES / "make_images.py", folder], check=True)
    return folder


def read_scene(path: Path) -> Json:
    scene: Json = json.loads(path.read_text(encoding="utf-8"))
    return scene


def small_picture(scene: Path, folder: Path, *arguments: str) -> Pixels:
    images()
    return render(scene, folder, *SMALL, *arguments)


def test_the_schema_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("scene", ALL, ids=lambda path: path.stem)
def test_scene_is_valid(scene: Path) -> None:
    faults = [f"{e.json_path}: {e.message}" for e in VALIDATOR.iter_errors(read_scene(scene))]
    assert not faults


@pytest.mark.parametrize("scene", ALL, ids=lambda path: path.stem)
def test_scene_renders(scene: Path, tmp_path: Path) -> None:
    pixels = small_picture(scene, tmp_path)
    assert np.isfinite(pixels).all() and (pixels >= 0.0).all()
    assert 0.01 < pixels.mean() < 2.0


def test_the_forest_is_what_its_script_writes() -> None:
    script = [sys.executable, "-B", str(SCENES / "forest.py")]
    done = subprocess.run(script, check=True, capture_output=True, text=True)
    assert done.stdout == (SCENES / "forest.json").read_text(encoding="utf-8")


def test_an_unknown_key_is_not_valid() -> None:
    scene = read_scene(SCENES / "knot.json")
    scene["camera"]["fieldofview"] = 40
    assert not VALIDATOR.is_valid(scene)


def test_nothing_can_be_told_from_its_surroundings_in_a_furnace(tmp_path: Path) -> None:
    """White surfaces and clear glass under an even sky of 0.5 send out 0.5."""
    pixels = small_picture(SCENES / "test/furnace.json", tmp_path, "--spp", "64")
    assert pixels.mean() == pytest.approx(0.5, rel=2e-3)
    assert abs(pixels - 0.5).max() < 0.1


def test_a_grey_ball_under_an_even_sky_sends_out_its_share(tmp_path: Path) -> None:
    pixels = small_picture(SCENES / "test/furnace-direct.json", tmp_path, "--spp", "64")
    assert pixels[0, 0] == pytest.approx([0.8] * 3, rel=1e-5)
    assert pixels[12:20, 12:20].mean() == pytest.approx(0.4, rel=1e-2)


def test_duplicate_and_empty_faces_change_nothing(tmp_path: Path) -> None:
    """A ball with such faces looks like the same ball without them, up to a few silhouettes."""
    scene = read_scene(SCENES / "test/degenerate-triangles.json")
    scene.pop("$schema")
    mesh = next(o for o in scene["objects"] if o["type"] == "mesh")
    flawed = ROOT / "build/meshes/flawed-ball.obj"
    small_picture(SCENES / "test/degenerate-triangles.json", tmp_path)  # brings the meshes
    sound = tmp_path / "ball.obj"
    lines = (ROOT / "build/meshes/ball.obj").read_text(encoding="ascii").splitlines()
    flat = [line for line in lines if not line.startswith("vn")]
    kept = [" ".join(w.split("//")[0] for w in line.split(" ")) for line in flat]
    sound.write_text("\n".join(kept) + "\n", encoding="ascii")
    pictures = []
    for path in (flawed, sound):
        mesh["path"] = str(path)
        pictures.append(render(write_scene(tmp_path, scene), tmp_path, "--resolution", "64x64"))
    different = np.abs(pictures[0] - pictures[1]).max(axis=-1) > 1e-3
    assert different.mean() < 0.002


# The schema's defaults --------------------------------------------------------------------------


def resolved(schema: Json) -> Json:
    """The schema with the definition that it refers to merged in."""
    name = schema.get("$ref", "")
    return {**SCHEMA["$defs"][name.removeprefix("#/$defs/")], **schema} if name else schema


def filled(schema: Json, value: Any) -> Any:
    """value with every default that the schema states written out."""
    schema = resolved(schema)
    for choice in schema.get("oneOf", []):
        checked = jsonschema.Draft202012Validator({**resolved(choice), "$defs": SCHEMA["$defs"]})
        if checked.is_valid(value):
            return filled(choice, value)
    if isinstance(value, list) and "items" in schema:
        return [filled(schema["items"], item) for item in value]
    if not isinstance(value, dict):
        return value
    known = schema.get("properties", {})
    out = {k: filled(known.get(k, schema.get("additionalProperties")), v) for k, v in value.items()}
    for key, rule in known.items():
        if key not in out and "default" in resolved(rule):
            out[key] = copy.deepcopy(resolved(rule)["default"])
    return out


def bare_scene(integrator: Json) -> Json:
    """A scene of everything that has defaults, with none of its optional keys."""
    objects: list[Json] = [
        {"type": "sphere", "center": [x, y, -2], "radius": 0.45, "material_name": name}
        for (x, y), name in zip(
            ((-1, 0.5), (0, 0.5), (1, 0.5), (-1, -0.6), (0, -0.6)),
            ("matt", "glass", "clear", "metal", "picture"),
            strict=True,
        )
    ]
    objects.append({"type": "rect", "material_name": "picture"})
    objects[-1]["translate"] = [1, -0.6, -2]
    objects.append({"type": "rect", "light": {"type": "area", "radiance": [3, 3, 3]}})
    objects[-1]["translate"] = [0, 0, -9]
    return {
        "integrator": integrator,
        "film": {"filter": {}},
        "camera": {},
        "sampler": {},
        "textures": {
            "squares": {"type": "checkerboard", "tex_coordinate_generator": {}},
            "photo": {"type": "image", "path": str(images() / "letter.png")},
            "sky": {"type": "constant", "color": [0.3, 0.4, 0.5]},
        },
        "materials": {
            "matt": {"type": "diffuse", "texture_name": "squares"},
            "picture": {"type": "diffuse", "texture_name": "photo"},
            "glass": {"type": "glass"},
            "clear": {"type": "refraction"},
            "metal": {"type": "roughconductor"},
        },
        "objects": objects,
        "lights": [
            {"type": "spot", "position": [0, 0, 2], "direction": [0, 0, -1], "intensity": [9, 8, 7]}
        ],
        "environment_map": {"texture_name": "sky"},
    }


@pytest.mark.parametrize("kind", ["intersection_test", "direct", "path", "normal", "mip_level"])
def test_the_schemas_defaults_are_the_loaders(kind: str, tmp_path: Path) -> None:
    bare = bare_scene({"type": kind})
    full = filled(SCHEMA, bare)
    assert len(json.dumps(full)) > len(json.dumps(bare)) + 300
    assert VALIDATOR.is_valid(full)
    size = ("--resolution", "32x32")
    without = render(write_scene(tmp_path, bare, "bare.json"), tmp_path, *size)
    written = render(write_scene(tmp_path, full, "full.json"), tmp_path, *size)
    assert np.array_equal(without, written)


@pytest.mark.parametrize(
    ("where", "other"),
    [
        (("textures", "photo", "filter"), "nearest"),
        (("integrator", "spp"), 5),
        (("integrator", "light_selection"), "all"),
        (("materials", "metal", "k"), [1, 1, 1]),
        (("film", "filter", "radius"), 1.5),
    ],
    ids=lambda value: value[-1] if isinstance(value, tuple) else "",
)
def test_another_default_would_be_noticed(
    where: tuple[str, ...], other: object, tmp_path: Path
) -> None:
    """The comparison above can fail: another value of these keys gives another picture."""
    bare = bare_scene({"type": "path"})
    full = filled(SCHEMA, bare)
    place = functools.reduce(lambda node, key: node[key], where[:-1], full)
    assert place[where[-1]] != other
    place[where[-1]] = other
    size = ("--resolution", "32x32")
    without = render(write_scene(tmp_path, bare, "bare.json"), tmp_path, *size)
    written = render(write_scene(tmp_path, full, "full.json"), tmp_path, *size)
    assert not np.array_equal(without, written)
