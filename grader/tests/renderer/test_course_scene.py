"""Scenes as the course writes them, with its keys only, render as they stand.

Each scene in course_scenes/ has a twin, NAME.full.json, that says the same in this renderer's own
words: every default written out, the integrator's own light in `lights`, a `translate` inside the
`transform`, other names for the same profile. The two pictures are the same to the last bit.
"""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from renderer_runs import ROOT, Json, Pixels, read_exr, run

HERE = Path(__file__).resolve().parent / "course_scenes"
NAMES = sorted(p.stem for p in HERE.glob("*.json") if not p.name.endswith(".full.json"))
SCHEMA: Json = json.loads((ROOT / "scenes/scene.schema.json").read_text(encoding="utf-8"))

PATH = {"integrator.spp", "integrator.max_depth", "integrator.profile", "integrator.rr_threshold"}
TEST = {"integrator.point_light_position", "integrator.point_light_flux"}
FILM = {"film.resolution"} | {f"film.filter.{k}" for k in ("type", "radius", "alpha", "B", "C")}
CAMERA = {f"camera.{k}" for k in ("position", "look_at", "ref_up", "fov", "focal_length")}
UV = {f"textures.tex_coordinate_generator.{k}" for k in ("type", "scale", "delta")}
TEXTURES = UV | {f"textures.{k}" for k in ("type", "color", "color0", "color1", "path")}
METAL = {f"materials.{k}" for k in ("alpha_x", "alpha_y", "etaI", "etaT", "k")}
MATERIALS = METAL | {
    f"materials.{k}" for k in ("type", "texture_name", "twosided", "eta", "R", "T")
}
PLACED = {f"objects.{k}" for k in ("path", "transform", "translate", "center", "radius")}
OBJECTS = PLACED | {f"objects.{k}" for k in ("type", "material_name", "light.type")}
SKY = {f"environment_map.{k}" for k in ("texture_name", "scale", "transform")}
COURSE_KEYS = PATH | TEST | FILM | CAMERA | TEXTURES | MATERIALS | OBJECTS | SKY
COURSE_KEYS |= {"integrator.type", "objects.light.radiance"}
"""Every key of the course's format. Names that a scene gives (of textures, materials) are left
out, and so are the places in a list."""

COURSE_WORDS = {
    "integrator.type": {"intersection_test", "path", "bdpt", "photon"},
    "integrator.profile": {"MIS", "RW", "RandomWalk", "NEE", "NextEventEstimation"},
    "film.filter.type": {"box", "gaussian", "mitchell"},
    "textures.type": {"constant", "checkerboard", "image"},
    "textures.tex_coordinate_generator.type": {"uvmapping2d"},
    "materials.type": {"diffuse", "refraction", "glass", "roughconductor"},
    "objects.type": {"mesh", "sphere"},
    "objects.light.type": {"area"},
}

Words = set[tuple[str, object]]


def words(node: object, key: str = "") -> Words:
    """Every key of a scene below the top, as "objects.path", with its value if that is a word."""
    if isinstance(node, dict):
        parts = [words(v, k if not key else f"{key}.{k}") for k, v in node.items()]
        return set().union(*parts)
    if isinstance(node, list) and node and isinstance(node[0], dict):
        return set().union(*(words(item, key) for item in node))
    return {(key, node if isinstance(node, str) else None)}


def course_words(scene: Json) -> Words:
    """The same, without the names of textures and materials."""
    tables = {
        k: list(v.values()) if k in ("textures", "materials") else v for k, v in scene.items()
    }
    return words(tables)


def course_scenes() -> dict[str, Json]:
    return {name: json.loads((HERE / f"{name}.json").read_text("utf-8")) for name in NAMES}


def picture(name: str, folder: Path) -> tuple[Pixels, list[str]]:
    """The picture of the file as it stands, and the complaints."""
    output = folder / f"{name}.exr"
    done = run(HERE / f"{name}.json", "-o", output, cwd=folder)
    assert done.returncode == 0, done.stderr
    said = (done.stdout + done.stderr).splitlines()
    return read_exr(output).pixels, [line for line in said if not line.startswith(str(output))]


def warnings(name: str) -> list[str]:
    """What is to be said of a scene: which integrator stands in for one that is not there."""
    kind = course_scenes()[name].get("integrator", {}).get("type")
    place = f"{HERE / name}.json: /integrator/type"
    found = f'raybook: {place}: "{kind}" is rendered with path (MIS): same expected image'
    return [found] if kind in ("bdpt", "photon") else []


@pytest.mark.parametrize("name", NAMES)
def test_a_course_scene_renders_like_its_twin(name: str, tmp_path: Path) -> None:
    before = (HERE / f"{name}.json").read_bytes()
    ours, said = picture(f"{name}.full", tmp_path)
    theirs, warned = picture(name, tmp_path)
    assert said == []
    assert warned == warnings(name)
    assert np.isfinite(theirs).all() and theirs.max() > 0.0 and theirs.std() > 0.05 * theirs.mean()
    assert np.array_equal(theirs, ours)
    assert (HERE / f"{name}.json").read_bytes() == before


@pytest.mark.parametrize("name", [n for name in NAMES for n in (name, f"{name}.full")])
def test_a_course_scene_is_valid(name: str) -> None:
    scene = json.loads((HERE / f"{name}.json").read_text("utf-8"))
    jsonschema.Draft202012Validator(SCHEMA).validate(scene)


def test_the_scenes_use_the_courses_keys_all_and_only() -> None:
    used = set().union(*map(course_words, course_scenes().values()))
    assert {key for key, _ in used} == COURSE_KEYS
    for place, known in COURSE_WORDS.items():
        assert {word for key, word in used if key == place} == known


def test_the_twins_use_keys_that_the_course_has_not() -> None:
    for name in NAMES:
        twin = json.loads((HERE / f"{name}.full.json").read_text("utf-8"))
        assert {key for key, _ in course_words(twin)} - COURSE_KEYS


def test_another_default_is_another_picture(tmp_path: Path) -> None:
    """The comparison can fail: not even the light's height may differ."""
    out = tmp_path / "higher.exr"
    change = '{"lights": [{"type": "point", "position": [0, 5.001, 0], "flux": [1, 1, 1]}]}'
    run(HERE / "defaults.full.json", "--override", change, "-o", out, cwd=tmp_path)
    assert not np.array_equal(read_exr(out).pixels, picture("defaults", tmp_path)[0])
