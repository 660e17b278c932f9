"""scenes/scene.schema.json states the format: it, the scenes and the loader agree."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from corpus import BASE, KEYS, LATER, NAMES, NUMBERS, TYPES, Case

SCENES = Path(__file__).resolve().parents[3] / "scenes"
SCENE_FILES = sorted(p for p in SCENES.rglob("*.json") if p.name != "scene.schema.json")
Schema = dict[str, Any]


@pytest.fixture(scope="module")
def schema() -> Schema:
    loaded: Schema = json.loads((SCENES / "scene.schema.json").read_text(encoding="utf-8"))
    return loaded


@pytest.fixture(scope="module")
def validator(schema: Schema) -> jsonschema.Draft202012Validator:
    return jsonschema.Draft202012Validator(schema)


def objects(schema: object) -> Iterator[Schema]:
    """Every schema of an object with keys of its own, at any depth."""
    if isinstance(schema, dict):
        if isinstance(schema.get("properties"), dict) and schema.get("type") == "object":
            yield schema
        for part in schema.values():
            yield from objects(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from objects(part)


def test_is_a_schema(schema: Schema) -> None:
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"


@pytest.mark.parametrize("path", SCENE_FILES, ids=lambda path: path.stem)
def test_scene_is_valid(validator: jsonschema.Draft202012Validator, path: Path) -> None:
    scene = json.loads(path.read_text(encoding="utf-8"))
    faults = [f"/{'/'.join(map(str, e.path))}: {e.message}" for e in validator.iter_errors(scene)]
    assert faults == []
    assert (path.parent / scene["$schema"]).resolve() == SCENES / "scene.schema.json"


def test_there_are_scenes() -> None:
    assert {"cornell-box", "knot"} <= {p.stem for p in SCENE_FILES}


def test_no_object_takes_unknown_keys(schema: Schema) -> None:
    for part in objects(schema):
        assert part["additionalProperties"] is False, part["description"]


def test_every_key_is_described(schema: Schema) -> None:
    for part in objects(schema):
        for name, value in part["properties"].items():
            assert value.get("description") or "$ref" in value, f"{part['description']}: {name}"


def test_every_default_is_valid(schema: Schema) -> None:
    for part in objects(schema):
        for value in part["properties"].values():
            if "default" in value:
                rule = {**value, "$defs": schema["$defs"]}
                jsonschema.validate(value["default"], rule)


def changed_scene(case: Case) -> object:
    data = case.files["scene.json"]
    assert isinstance(data, bytes)
    return json.loads(data)


def test_base_scene_is_valid(validator: jsonschema.Draft202012Validator) -> None:
    assert validator.is_valid(copy.deepcopy(BASE))


@pytest.mark.parametrize("case", LATER, ids=lambda case: case.name.replace(" ", "-"))
def test_whole_format_is_valid(validator: jsonschema.Draft202012Validator, case: Case) -> None:
    assert validator.is_valid(changed_scene(case))


# Faults that a schema cannot state: names that refer to others, keys given twice, numbers that
# do not fit a float, products.
BEYOND_A_SCHEMA = re.compile(
    r"twice|material far from all|unknown (material|texture)|no materials"
    r"|1e39|1e400|1e-60|too many|albedo above"
)


@pytest.mark.parametrize(
    "case",
    [c for c in (*KEYS, *NAMES, *TYPES, *NUMBERS) if not BEYOND_A_SCHEMA.search(c.name)],
    ids=lambda case: case.name.replace(" ", "-"),
)
def test_faults_are_invalid(validator: jsonschema.Draft202012Validator, case: Case) -> None:
    """What the loader refuses, an editor underlines."""
    assert not validator.is_valid(changed_scene(case))


def test_loader_knows_no_other_key(schema: Schema) -> None:
    """Each list of keys in the loader's source is that of an object in the schema."""
    stated = [set(part["properties"]) for part in objects(schema)]
    found = 0
    for source in sorted((SCENES.parent / "src" / "scene").glob("load*.c")):
        code = source.read_text(encoding="utf-8")
        for match in re.finditer(r"\bkeys\[\]\s*=\s*\{([^}]*)\}", code):
            keys = set(re.findall(r'"([^"]+)"', match[1]))
            assert any(keys <= names for names in stated), f"{source.name}: {sorted(keys)}"
            found += 1
    assert found >= 10, "the loader's lists of keys look different now: change this test"
