"""A small course to grade the corpus in: the first assignment, a tiny hidden scene, tight limits.

It has one check of each kind, and canaries: texts that no output may hold.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from hostile_case import CHECKOUT, OWNED

SIZE = 32
"""Width and height of the picture."""

CANARIES = {
    "reference": "raybook-canary-reference-5e1c",
    "kit": "raybook-canary-beside-the-kit-83d0",
    "oracle": "raybook-canary-oracle-a2f7",
    "driver": "raybook-canary-driver-c96b",
    "scene": "raybook-canary-scene-1d48",
    "home": "raybook-canary-home-7b35",
    "environment": "raybook-canary-environment-e04a",
    "submission": "raybook-canary-submission-f612",
}

SCENE: dict[str, Any] = {
    "integrator": {
        "type": "intersection_test",
        "spp": 16,
        "point_light_position": [1.5, 2.0, 2.5],
        "point_light_flux": [600.0, 560.0, 500.0],
    },
    "film": {"resolution": [SIZE, SIZE]},
    "camera": {"position": [0.9, 1.1, 2.6], "look_at": [0.0, 0.0, 0.0], "fov": 38.0},
    "textures": {CANARIES["scene"]: {"type": "constant", "color": [0.6, 0.4, 0.3]}},
    "materials": {"clay": {"type": "diffuse", "texture_name": CANARIES["scene"]}},
    "objects": [
        {"type": "mesh", "path": "../build/meshes/cube.obj", "material_name": "clay"},
        {"type": "sphere", "center": [0.0, -21.0, 0.0], "radius": 20.0, "material_name": "clay"},
    ],
}

# Limits: processor time is what a module needs a hundred times over; real time twice that.
RUBRIC = f"""
number = "01"
module = "triangle"
title = "Ray-triangle intersection"
points = 10
optional = false
owned = ["{OWNED}"]
todos = ["triangle_intersect", "triangle_uv_differentials"]
[limits]
wall_seconds = 3
memory_mib = 256
[[check]]
name = "compiles without warnings"
kind = "build"
points = 1
[[check]]
name = "public unit tests"
kind = "unit"
points = 1
tests = "test_triangle.c"
[[check]]
name = "edge cases"
kind = "probe"
points = 3
driver = "hidden/probe_triangle.c"
oracle = "hidden/oracle_triangle.py"
group = "edges"
seed = 1
hidden = true
[[check]]
name = "clean under the sanitizers"
kind = "robust"
points = 1
driver = "hidden/probe_triangle.c"
oracle = "hidden/oracle_triangle.py"
group = "hostile"
seed = 4
hidden = true
[[check]]
name = "picture"
kind = "image"
points = 4
scene = "scenes/hidden.json"
resolution = "{SIZE}x{SIZE}"
spp = 16
seeds = 8
hidden = true
"""


def hostile_course(root: Path) -> Path:
    """Write the course to ``root``; nothing in it is shared with the checkout but meshes."""
    kit = CHECKOUT / "build" / "kit"
    assert (kit / "kit.json").is_file(), f"{kit} is not there: run `make kit` first"
    root.mkdir(parents=True)
    shutil.copytree(CHECKOUT / "src", root / "src")
    _append(root / OWNED, f"/* {CANARIES['reference']} */\n")
    (root / "build").mkdir()
    (root / "build" / "meshes").symlink_to(CHECKOUT / "build" / "meshes")
    shutil.copytree(CHECKOUT / "build" / "unity", root / "build" / "unity")
    shutil.copytree(kit, root / "build" / "kit")
    (root / "build" / "reference.c").write_text(f"/* {CANARIES['kit']} */\n")
    folder = root / "assignments" / "01-triangle"
    folder.mkdir(parents=True)
    (folder / "assignment.toml").write_text(RUBRIC)
    original = CHECKOUT / "assignments" / "01-triangle"
    shutil.copy(original / "test_triangle.c", folder)
    shutil.copytree(original / "hidden", folder / "hidden")
    for file in (folder / "hidden").glob("*.py"):
        _append(file, f"# {CANARIES['oracle']}\n")
    for file in (folder / "hidden").glob("*.c"):
        _append(file, f'const char canary[] = "{CANARIES["driver"]}";\n')
    (root / "scenes").mkdir()
    (root / "scenes" / "hidden.json").write_text(json.dumps(SCENE, indent=1))
    return root


def _append(file: Path, line: str) -> None:
    file.write_text(file.read_text(encoding="utf-8") + line, encoding="utf-8")
