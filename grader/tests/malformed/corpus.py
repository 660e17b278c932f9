"""The table of malformed inputs: scenes, meshes and command lines that must be refused.

A case says what files to write and what the one message must hold: where (file, and line:column
for syntax or a JSON pointer for meaning), what was found, and what was expected. The patterns
check these and leave the wording free.
"""

from __future__ import annotations

import copy
import json
from dataclasses import dataclass
from typing import Any

TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

BASE: dict[str, Any] = {
    "integrator": {"type": "intersection_test", "spp": 1},
    "film": {"resolution": [8, 8]},
    "camera": {"position": [0, 0, 5], "look_at": [0, 0, 0]},
    "textures": {"grey": {"type": "constant", "color": [0.5, 0.5, 0.5]}},
    "materials": {"grey": {"type": "diffuse", "texture_name": "grey"}},
    "objects": [
        {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material_name": "grey"},
        {"type": "mesh", "path": "mesh.obj", "material_name": "grey"},
    ],
}
"""A scene without a fault; the cases spoil it."""


@dataclass(frozen=True)
class Folder:
    """In place of a file: an empty folder."""


@dataclass(frozen=True)
class Fifo:
    """In place of a file: a pipe that nobody writes to."""


@dataclass(frozen=True)
class Link:
    """In place of a file: a symbolic link."""

    target: str


Content = bytes | Folder | Fifo | Link


@dataclass(frozen=True)
class Case:
    """One malformed input.

    arguments follow the program's name, in a folder that holds files; says are patterns that must
    all be found in the message.
    """

    name: str
    says: tuple[str, ...]
    files: dict[str, Content]
    arguments: tuple[str, ...] = ("scene.json", "-o", "out.exr")


def changed(pointer: str, value: object) -> dict[str, Any]:
    """BASE with the value at a JSON pointer replaced or added."""
    scene = copy.deepcopy(BASE)
    *parents, last = pointer.strip("/").split("/")
    at: Any = scene
    for step in parents:
        at = at[int(step)] if isinstance(at, list) else at.setdefault(step, {})
    if isinstance(at, list):
        at[int(last)] = value
    else:
        at[last] = value
    return scene


def without(pointer: str) -> dict[str, Any]:
    """BASE without the member at a JSON pointer."""
    scene = copy.deepcopy(BASE)
    *parents, last = pointer.strip("/").split("/")
    at: Any = scene
    for step in parents:
        at = at[int(step)] if isinstance(at, list) else at[step]
    del at[last]
    return scene


def text(name: str, scene: str | bytes, *says: str) -> Case:
    """A scene file with the given text."""
    data = scene if isinstance(scene, bytes) else scene.encode()
    return Case(name, ("scene.json", *says), {"scene.json": data, "mesh.obj": TRIANGLE})


def value(name: str, pointer: str, found: object, *says: str) -> Case:
    """BASE with one bad value, which the message must place."""
    # json.dumps writes infinity as a token that is not JSON; 1e400 is.
    data = json.dumps(changed(pointer, found)).replace("Infinity", "1e400")
    return text(name, data, rf"{pointer}\b", *says)


def key(name: str, parent: str, bad: str, near: str) -> Case:
    """BASE with an unknown key beside the good ones; the message offers the nearest."""
    data = json.dumps(changed(f"{parent}/{bad}", 1))
    return text(name, data, parent, bad, f'"{near}"')


def missing(name: str, pointer: str) -> Case:
    """BASE without a key that must be there."""
    parent, _, last = pointer.rpartition("/")
    return text(name, json.dumps(without(pointer)), parent, f'"{last}"', "missing|expected")


def mesh(name: str, content: Content, *says: str) -> Case:
    """BASE with a bad mesh file."""
    files = {"scene.json": json.dumps(BASE).encode(), "mesh.obj": content}
    return Case(name, ("mesh.obj", *says), files)


def command(name: str, arguments: str | tuple[str, ...], *says: str) -> Case:
    """A bad command line over a good scene."""
    words = tuple(arguments.split()) if isinstance(arguments, str) else arguments
    files: dict[str, Content] = {"scene.json": json.dumps(BASE).encode(), "mesh.obj": TRIANGLE}
    return Case(name, says, files, words)


def files(name: str, content: dict[str, Content], *says: str) -> Case:
    """Files other than BASE and a triangle."""
    return Case(name, says, content)


GOOD_SCENE = json.dumps(BASE).encode()
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
V = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

SYNTAX = [
    text("empty file", "", "scene.json:1:1"),
    text("blanks only", " \n\n", r"scene.json:\d+:\d+"),
    text("comma missing", '{\n  "film": {}\n  "camera": {}\n}', "scene.json:3:3"),
    text("comma at the end", '{\n  "film": {},\n}', r"scene.json:[23]:\d+"),
    text("colon missing", '{\n  "film" {}\n}', "scene.json:2:10"),
    text("text after the scene", '{"film": {}} and more', "scene.json:1:14"),
    text("two scenes in a file", '{"film": {}}\n{"film": {}}', "scene.json:2:1"),
    text("string without an end", '{\n  "film": {"resolution": "\n}', r"scene.json:[23]:\d+"),
    text("object without an end", '{\n  "film": {', r"scene.json:2:\d+"),
    text("list without an end", '{\n  "objects": [\n', r"scene.json:[23]:\d+"),
    text("single quotes", "{'film': {}}", "scene.json:1:[23]"),
    text("a comment", '{\n  // nothing\n  "film": {}}', "scene.json:2:[34]"),
    text("token NaN", '{"camera":\n{"fov": NaN}}', "scene.json:2:9"),
    text("token Infinity", '{"camera":\n{"fov": Infinity}}', "scene.json:2:9"),
    text("token -Infinity", '{"camera":\n{"fov": -Infinity}}', "scene.json:2:(9|10)"),
    text("hexadecimal number", '{"camera":\n{"fov": 0x20}}', "scene.json:2:(9|10)"),
    text("unknown escape", '{\n  "fi\\qm": {}}', r"scene.json:2:\d+"),
    text("half a surrogate pair", '{\n  "fi\\ud800": {}}', r"scene.json:2:\d+"),
    text("nested 2000 deep", "[" * 2000 + "]" * 2000, r"scene.json:1:\d+"),
    text("nested 200000 deep", '{"a":' * 200000, r"scene.json:1:\d+"),
    text("binary", b"\x93\x02\x7f" * 100, "scene.json:1:[12]"),
    text("a zero byte", b'{"film": \0{}}', "scene.json:1:10", "byte", "0"),
    text("UTF-16", GOOD_SCENE.decode().encode("utf-16"), "scene.json:1:4", "text|UTF-8"),
    text("top is a list", "[1, 2]", "list", "object"),
    text("top is a number", "17", "17", "object"),
    text("top is null", "null", "null", "object"),
]

KEYS = [
    key("key objcts", "", "objcts", "objects"),
    key("key sppp", "/integrator", "sppp", "spp"),
    key("key resolutoin", "/film", "resolutoin", "resolution"),
    key("key lookat", "/camera", "lookat", "look_at"),
    key("key raduis", "/objects/0", "raduis", "radius"),
    key("key materal_name", "/objects/1", "materal_name", "material_name"),
    key("key colour", "/textures/grey", "colour", "color"),
    key("key two_sided", "/materials/grey", "two_sided", "twosided"),
    text("key far from all", json.dumps(changed("/zzqqxyzw", 1)), "zzqqxyzw", "camera", "film"),
    text("key twice at the top", '{"film": {}, "film": {}}', '"film"', "twice|duplicate"),
    text("key twice below", '{"film": {"filter": {}, "filter": {}}}', "/film", '"filter"'),
    text(
        "material twice",
        json.dumps(BASE).replace('"materials": {', '"materials": {"grey": {}, '),
        "/materials",
        '"grey"',
    ),
    missing("sphere without radius", "/objects/0/radius"),
    missing("sphere without centre", "/objects/0/center"),
    missing("mesh without path", "/objects/1/path"),
    missing("object without type", "/objects/1/type"),
    missing("object without material", "/objects/0/material_name"),
    missing("texture without colour", "/textures/grey/color"),
    missing("material without texture", "/materials/grey/texture_name"),
]

NAMES = [
    value("integrator misspelt", "/integrator/type", "intersection_tset", '"intersection_test"'),
    value("filter misspelt", "/film/filter", {"type": "gausian"}, "gausian", '"gaussian"'),
    value("object misspelt", "/objects/0/type", "spere", "spere", '"sphere"'),
    value("texture misspelt", "/textures/grey/type", "constnt", "constnt", '"constant"'),
    value("material misspelt", "/materials/grey/type", "difuse", "difuse", '"diffuse"'),
    value("material in capitals", "/materials/grey/type", "DIFFUSE", "DIFFUSE", '"diffuse"'),
    value("light misspelt", "/lights", [{"type": "piont"}], "/lights/0", "piont", '"point"'),
    value("sampler misspelt", "/sampler", {"type": "independant"}, '"independent"'),
    value("type far from all", "/materials/grey/type", "zzqqxyzw", "zzqqxyzw", "diffuse"),
    value("unknown material", "/objects/0/material_name", "gray", "gray", '"grey"'),
    value("material far from all", "/objects/0/material_name", "zzqqxyzw", "zzqqxyzw"),
    value("unknown texture", "/materials/grey/texture_name", "gery", "gery", '"grey"'),
    text("no materials", json.dumps(without("/materials")), "/objects/0/material_name", "grey"),
]

TYPES = [
    value("resolution a word", "/film/resolution", "big", "big", "list"),
    value("resolution a number", "/film/resolution", 512, "512", "list"),
    value("resolution of 3", "/film/resolution", [8, 8, 8], "3", "2"),
    value("spp a word", "/integrator/spp", "many", "many", "number"),
    value("max_depth a list", "/integrator/max_depth", [4], "list", "number"),
    value("film a list", "/film", [8, 8], "list", "object"),
    value("objects an object", "/objects", {}, "object", "list"),
    value("an object a number", "/objects/0", 3, "3", "object"),
    value("textures a list", "/textures", [], "list", "object"),
    value("a texture a word", "/textures/grey", "grey", "grey", "object"),
    value("material_name a number", "/objects/0/material_name", 3, "3", "string"),
    value("path a number", "/objects/1/path", 3, "3", "string"),
    value("twosided a word", "/materials/grey/twosided", "yes", "yes", "true"),
    value("position a number", "/camera/position", 3, "3", "list"),
    value("position of 2", "/camera/position", [0, 1], "2", "3"),
    value("a word in a position", "/camera/position/1", "up", "up", "number"),
    value("null in a position", "/camera/position/2", None, "null", "number"),
    value("colour of 4", "/textures/grey/color", [1, 1, 1, 1], "4", "3"),
    value("transform of 15", "/objects/1/transform", IDENTITY[:15], "15", "16"),
    value("transform of rows", "/objects/1/transform", [IDENTITY[:4]] * 4, "4", "16"),
    value("lights an object", "/lights", {"type": "point"}, "object", "list"),
]

NUMBERS = [
    value("resolution negative", "/film/resolution/0", -8, "-8", "whole number"),
    value("resolution zero", "/film/resolution/1", 0, "0", "whole number"),
    value("resolution a fraction", "/film/resolution/0", 8.5, "8.5", "whole number"),
    value("resolution giant", "/film/resolution/0", 1e12, r"1e\+?12|1000000000000"),
    value("too many pixels", "/film/resolution", [60000, 60000], "60000", "pixels"),
    value("spp zero", "/integrator/spp", 0, "0", "whole number"),
    value("spp negative", "/integrator/spp", -4, "-4", "whole number"),
    value("spp a fraction", "/integrator/spp", 1.5, "1.5", "whole number"),
    value("spp giant", "/integrator/spp", 1e12, r"1e\+?12|1000000000000"),
    value("max_depth zero", "/integrator/max_depth", 0, "0", "whole number"),
    value("flux negative", "/integrator/point_light_flux", [1, -2, 1], "-2", "0"),
    value("light of 1e400", "/integrator/point_light_position", [0, float("inf"), 0], "number"),
    value("radius zero", "/objects/0/radius", 0, "0", "above|positive|greater"),
    value("radius negative", "/objects/0/radius", -1, "-1", "above|positive|greater"),
    value("radius 1e400", "/objects/0/radius", float("inf"), "number"),
    value("radius 1e39", "/objects/0/radius", 1e39, r"1e\+?39", "number"),
    value("radius 1e-60", "/objects/0/radius", 1e-60, "1e-60", "number"),
    value("centre -1e39", "/objects/0/center/0", -1e39, r"-1e\+?39", "number"),
    value("colour negative", "/textures/grey/color/1", -0.5, "-0.5", "0"),
    value("colour 1e400", "/textures/grey/color/1", float("inf"), "number"),
    text(
        "albedo above one",
        json.dumps(changed("/textures/grey/color", [1.5, 0.5, 0.5])),
        "/materials/grey/texture_name|/textures/grey/color",
        "1",
    ),
    value("filter radius zero", "/film/filter", {"radius": 0}, "/film/filter/radius", "number"),
    value("seed negative", "/sampler", {"seed": -1}, "/sampler/seed", "-1", "whole number"),
    value("seed a fraction", "/sampler", {"seed": 0.5}, "/sampler/seed", "0.5", "whole number"),
]

CAMERA = [
    value("camera without a view", "/camera/look_at", [0, 0, 5]),
    value("up along the view", "/camera/ref_up", [0, 0, 2], "parallel"),
    value("up against the view", "/camera/ref_up", [0, 0, -2], "parallel"),
    value("up zero", "/camera/ref_up", [0, 0, 0], "zero"),
    value("fov zero", "/camera/fov", 0, "0", "degrees"),
    value("fov 180", "/camera/fov", 180, "180", "degrees"),
    value("fov negative", "/camera/fov", -5, "-5", "degrees"),
    value("eye of 1e39", "/camera/position/2", 1e39, r"1e\+?39", "number"),
    value("eye too far to see", "/camera/position", [3e38, 3e38, 3e38]),
    value("focal length zero", "/camera/focal_length", 0, "0", "number"),
]
# The faults of two keys together may be told at the camera as a whole.
CAMERA = [
    Case(c.name, ("scene.json", "/camera", *c.says[2:]), c.files, c.arguments) for c in CAMERA
]

TRANSFORMS = [
    value("transform zero", "/objects/1/transform", [0] * 16, "transform|matrix"),
    value(
        "transform flat",
        "/objects/1/transform",
        [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1],
        "invert|singular",
    ),
    value(
        "transform with equal rows",
        "/objects/1/transform",
        [1, 2, 3, 0, 1, 2, 3, 0, 0, 0, 1, 0, 0, 0, 0, 1],
        "invert|singular",
    ),
    value("transform in perspective", "/objects/1/transform", [*IDENTITY[:14], 1, 1], "last row"),
    value(
        "a word in a transform",
        "/objects/1/transform",
        [*IDENTITY[:5], "one", *IDENTITY[6:]],
        "/objects/1/transform/5",
        "one",
        "number",
    ),
    files(
        "transform out of range",
        {
            "scene.json": json.dumps(changed("/objects/1/translate", [3e38, 0, 0])).encode(),
            "mesh.obj": b"v 3e38 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        },
        "/objects/1",
        "transform",
    ),
]

FILES = [
    files("scene missing", {"mesh.obj": TRIANGLE}, "scene.json", "No such file"),
    files("scene a folder", {"scene.json": Folder()}, "scene.json", "folder|directory"),
    files("scene a pipe", {"scene.json": Fifo()}, "scene.json", "not a|regular"),
    files("scene a circle of links", {"scene.json": Link("scene.json")}, "scene.json", "link"),
    files("scene a broken link", {"scene.json": Link("gone")}, "scene.json", "No such file"),
    files("mesh missing", {"scene.json": GOOD_SCENE}, "/objects/1/path", "mesh.obj", "No such"),
    mesh("mesh a folder", Folder(), "/objects/1/path", "folder|directory"),
    mesh("mesh a pipe", Fifo(), "/objects/1/path", "not a|regular"),
    mesh("mesh an endless device", Link("/dev/zero"), "/objects/1/path", "not a|regular"),
    mesh("mesh a circle of links", Link("mesh.obj"), "/objects/1/path", "link"),
    value("mesh without a name", "/objects/1/path", ""),
    value("mesh with a long name", "/objects/1/path", "m" * 5000, "mmm"),
    value("scene as its own mesh", "/objects/1/path", "scene.json", r"scene.json:1:\d+", "keyword"),
]

MESHES = [
    mesh("obj empty", b"", "no face"),
    mesh("obj without faces", V.encode(), "no face"),
    mesh("obj index 0", f"{V}f 0 1 2\n".encode(), "mesh.obj:4:3", "0"),
    mesh("obj index 9 of 3", f"{V}f 1 2 9\n".encode(), "mesh.obj:4:7", "9", "3"),
    mesh("obj index before its vertex", b"f 1 2 3\n" + V.encode(), "mesh.obj:1:3", "so far"),
    mesh("obj index -9 of 3", f"{V}f -1 -2 -9\n".encode(), "mesh.obj:4:9", "-9", "3"),
    mesh("obj index giant", f"{V}f 1 2 {10**30}\n".encode(), "mesh.obj:4:7", "range"),
    mesh("obj index a fraction", f"{V}f 1 2 2.5\n".encode(), r"mesh.obj:4:[78]"),
    mesh("obj index a word", f"{V}f 1 b 3\n".encode(), "mesh.obj:4:5", '"b"'),
    mesh("obj vt out of range", f"{V}vt 0 0\nf 1/1 2/1 3/7\n".encode(), "mesh.obj:5:13", "7", "1"),
    mesh("obj vn out of range", f"{V}f 1//1 2//1 3//1\n".encode(), "mesh.obj:4:6", "normal", "0"),
    mesh("obj corner of four indices", f"{V}vt 0 0\nf 1/1//1 2 3\n".encode(), r"mesh.obj:5:\d"),
    mesh("obj face of two corners", f"{V}f 1 2\n".encode(), r"mesh.obj:4:\d", "3 corners", "2"),
    mesh("obj face of none", f"{V}f\n".encode(), r"mesh.obj:4:\d", "3 corners"),
    mesh("obj vertex of two numbers", b"v 0 0\n", "mesh.obj:1:6", "number"),
    mesh("obj number a word", b"v 0 zero 0\n", "mesh.obj:1:5", "zero", "number"),
    mesh("obj number with a comma", b"v 0,5 0 0\n", "mesh.obj:1:3", "0,5", "number"),
    mesh("obj number with two points", b"v 0 0 1.2.3\n", "mesh.obj:1:7", "1.2.3", "number"),
    mesh("obj number hexadecimal", b"v 0 0 0x10\n", "mesh.obj:1:7", "0x10", "number"),
    mesh("obj vertex nan", b"v 0 0 nan\n", "mesh.obj:1:7", "nan", "finite"),
    mesh("obj vertex -inf", b"v -inf 0 0\n", "mesh.obj:1:3", "-inf", "finite"),
    mesh("obj vertex 1e400", b"v 0 0 1e400\n", "mesh.obj:1:7", "1e400"),
    mesh("obj vertex 1e39", b"v 0 0 1e39\n", "mesh.obj:1:7", "1e39"),
    mesh("obj normal nan", f"{V}vn 0 nan 1\nf 1//1 2//1 3//1\n".encode(), "mesh.obj:4:6"),
    mesh("obj fault behind CR LF", f"{V}f 1 2 9\n".replace("\n", "\r\n").encode(), "mesh.obj:4:7"),
    mesh("obj fault in a continued line", f"{V}f 1 2 \\\n 9\n".encode(), "mesh.obj:5:2", "9"),
    mesh("obj cut off in a vertex", TRIANGLE + b"v 0.5 0.", "mesh.obj:5:9", "number"),
    mesh("obj cut off in a face", TRIANGLE + b"f 1 2", r"mesh.obj:5:\d", "3 corners"),
    mesh("obj binary", b"\x93\x02\x7f" * 100, r"mesh.obj:1:1"),
    mesh("obj with a zero byte", TRIANGLE + b"\0\0", "mesh.obj:5:1", "byte"),
    mesh("obj in UTF-16", TRIANGLE.decode().encode("utf-16"), "mesh.obj:1:4"),
    mesh("obj of numbers only", b"0 0 0\n1 0 0\n0 1 0\n", "mesh.obj:1:1", "keyword"),
]

COMMANDS = [
    command("no scene", "-o out.exr", "scene"),
    command("two scenes", "scene.json scene.json", "one scene"),
    command("an empty argument", ("", "-o", "out.exr"), "."),
    command("option misspelt", "scene.json --sppp 4", "--sppp", "--spp"),
    command("option far from all", "scene.json --zzqqxyzw", "--zzqqxyzw", "--help"),
    command("letter unknown", "scene.json -x", "-x"),
    command("value missing", "scene.json --spp", "--spp", "missing"),
    command("output missing", "scene.json -o", "-o", "missing"),
    command("value too many", "scene.json --quiet=1", "--quiet", "no value"),
    command("--spp abc", "scene.json --spp abc", "--spp", "abc", "whole number"),
    command("--spp 0", "scene.json --spp 0", "--spp", "0", "whole number"),
    command("--spp 4x", "scene.json --spp 4x", "--spp", "4x", "whole number"),
    command("--spp giant", f"scene.json --spp {10**20}", "--spp", "whole number"),
    command("--seed -1", "scene.json --seed -1", "--seed", "-1", "whole number"),
    command("--threads 0", "scene.json --threads 0", "--threads", "0", "whole number"),
    command("--max-depth 0", "scene.json --max-depth 0", "--max-depth", "0"),
    command("--time-limit -1", "scene.json --time-limit -1", "--time-limit", "-1", "seconds"),
    command("--time-limit nan", "scene.json --time-limit nan", "--time-limit", "nan"),
    command("--resolution 0x0", "scene.json --resolution 0x0", "--resolution", "0x0"),
    command("--resolution 8", "scene.json --resolution 8", "--resolution", "640x480|WxH|WIDTH"),
    command("--resolution 8x", "scene.json --resolution 8x", "--resolution", "8x"),
    command("--resolution giant", "scene.json --resolution 60000x60000", "--resolution", "pixels"),
    command("--crop reversed", "scene.json --crop 4,0,2,8", "--crop", "4,0,2,8", "X0"),
    command("--crop of three", "scene.json --crop 0,0,4", "--crop", "0,0,4", "X0"),
    command("--crop outside", "scene.json --crop 0,0,9,9", "crop", "8"),
    command("--accel misspelt", "scene.json --accel bhv", "--accel", "bhv", "bvh"),
    command(
        "--integrator misspelt",
        "scene.json --integrator intersection_tset",
        "--integrator",
        "intersection_test",
    ),
    command("--output without ending", "scene.json -o out", "out", ".exr"),
    command("--output a JPEG", "scene.json -o out.jpg", "out.jpg", ".exr"),
    command("--output nowhere", "scene.json -o no/out.exr", "no/out.exr", "No such"),
    command("--png a JPEG", "scene.json -o out.exr --png out.jpg", "out.jpg", ".png"),
    command("--png nowhere", "scene.json -o out.exr --png no/out.png", "no/out.png"),
    command(
        "--override not JSON",
        ("scene.json", "-o", "out.exr", "--override", '{"film": }'),
        r"--override:1:10",
    ),
    command(
        "--override a list",
        ("scene.json", "-o", "out.exr", "--override", "[1]"),
        "--override",
        "object",
    ),
    command(
        "--override with an unknown key",
        ("scene.json", "-o", "out.exr", "--override", '{"flim": {}}'),
        "flim",
        '"film"',
    ),
    command(
        "--override with a bad value",
        ("scene.json", "-o", "out.exr", "--override", '{"integrator": {"spp": 0}}'),
        "/integrator/spp",
        "whole number",
    ),
]


def later(name: str, pointer: str, found: object, *says: str) -> Case:
    """BASE with something that is in the format."""
    return text(f"later: {name}", json.dumps(changed(pointer, found)), *says, "not supported")


CHECKERS = {"type": "checkerboard", "tex_coordinate_generator": {"type": "uvmapping2d"}}
LAMP = {"type": "rect", "light": {"type": "area", "radiance": [1, 1, 1]}}
SUN = {"type": "directional", "direction": [0, 0, -1], "irradiance": [1, 1, 1]}

LATER = [
    later("path", "/integrator", {"type": "path", "spp": 1}, "/integrator", "path"),
    later("direct", "/integrator", {"type": "direct", "spp": 1}, "/integrator", "direct"),
    later("normal", "/integrator", {"type": "normal", "spp": 1}, "/integrator", "normal"),
    later("Mitchell's filter", "/film/filter", {"type": "mitchell"}, "/film/filter", "mitchell"),
    later("Sobol sampler", "/sampler", {"type": "sobol"}, "/sampler", "sobol"),
    later("checkerboard", "/textures/grey", CHECKERS, "/textures/grey", "checkerboard"),
    later("refraction", "/materials/glass", {"type": "refraction"}, "/materials", "refraction"),
    later("glass", "/materials/glass", {"type": "glass"}, "/materials/glass", "glass"),
    later("metal", "/materials/metal", {"type": "roughconductor"}, "/materials", "roughconductor"),
    later("rect that shines", "/objects/1", LAMP, "/objects/1", "rect|light"),
    later("sun", "/lights", [SUN], "/lights/0", "directional"),
    later("environment", "/environment_map", {"texture_name": "grey"}, "/environment_map"),
    command("later: --aov", "-q scene.json -o out.exr --aov albedo", "--aov", "not supported"),
    command("later: --pixel", "-q scene.json -o out.exr --pixel 4,4", "--pixel", "not supported"),
    command("later: --preview", "-q scene.json -o out.exr --preview", "--preview", "not supp"),
]
"""Parts of the format and of the command line that may not be there yet.

Each is correct: it must do its work or be refused by its name, never be passed over.
"""

CASES = [
    *SYNTAX,
    *KEYS,
    *NAMES,
    *TYPES,
    *NUMBERS,
    *CAMERA,
    *TRANSFORMS,
    *FILES,
    *MESHES,
    *COMMANDS,
]
