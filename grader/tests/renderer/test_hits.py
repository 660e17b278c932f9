"""All accelerators find the same hits, bit for bit, and a closed mesh leaks no ray.

Six meshes, four kinds of rays, half of them from inside where there is an inside; see hits.c.
`make test` casts 120,000 rays. RAYBOOK_FULL=1 casts 10,000,002: six minutes on one busy core.
Testing every triangle is slow, so only as many rays are checked against that as LINEAR_TESTS
allows: with the full number the cube's all, 200,000 of the slivers', 4,000 of the knot's.
The same for meshes that are shown many times, where all but the wide tree move copies of them.

Leaks alone are counted much faster (leaks.c): a million rays here, 200 million with RAYBOOK_FULL=1.
"""

from __future__ import annotations

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest
from hit_meshes import HitMesh, hit_meshes
from renderer_runs import CORNELL, ROOT, make, run

HERE = Path(__file__).resolve().parent

FULL = os.environ.get("RAYBOOK_FULL") == "1"
RAYS = 1_666_667 if FULL else 20_000
LINEAR_TESTS = 400_000_000 if FULL else 8_000_000
"""How many ray-triangle tests a mesh's check against testing everything may take."""

LESS_LEAK_RAYS = 500_000
LEAK_RAYS = 100_000_000 if FULL else LESS_LEAK_RAYS
PLACES = 40
"""How often a mesh is shown where it is shown more than once."""

NAMES = ("knot", "ball", "cube", "terrain", "slivers", "boulder")


@dataclass(frozen=True)
class Workshop:
    """Links hits.c with the renderer's objects, one of them perhaps made anew."""

    folder: Path

    def program(
        self,
        source: str = "",
        old: str = "",
        new: str = "",
        users: tuple[str, ...] = (),
    ) -> Path:
        """hits, with a text in one source (src/...) replaced; for a header, in its users only."""
        objects = _words("list-objects")
        changed: list[str] = []
        if source:
            text = (ROOT / source).read_text()
            assert text.count(old) == 1, f"{source} no longer says {old!r} once"
            mutant = self.folder / "src" / Path(source).relative_to("src")
            mutant.parent.mkdir(parents=True, exist_ok=True)
            mutant.write_text(text.replace(old, new))
            changed = [f"-I{self.folder / 'src'}", *users] if users else [str(mutant)]
            gone = {f"/{Path(path).stem}.o" for path in users or (source,)}
            objects = [path for path in objects if not any(path.endswith(o) for o in gone)]
        out = self.folder / f"hits{len(list(self.folder.glob('hits*')))}"
        mains = [str(HERE / f"{name}.c") for name in ("hits", "leaks", "hit_world")]
        compiler, *options = _words("list-compiler")
        command = [compiler, *changed, *options, *mains, *objects]
        subprocess.run([*command, *_words("list-libraries"), "-o", str(out)], cwd=ROOT, check=True)
        return out

    def hits(self, program: Path, mesh: HitMesh, rays: int, places: int = 0) -> dict[str, int]:
        """What hits says."""
        obj, inside = mesh.write(self.folder, "mesh")
        linear = min(rays, LINEAR_TESTS // (mesh.obj.count("\nf ") * max(places, 1)))
        command = [*map(str, (program, obj, inside, rays)), "1", str(linear), str(places)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        counts: dict[str, int] = json.loads(done.stdout)
        print(done.stdout, done.stderr)
        return counts

    def leaks(
        self, program: Path, mesh: HitMesh, places: int, accel: str, rays: int
    ) -> dict[str, int]:
        """What leaks says."""
        obj, inside = mesh.write(self.folder, "closed")
        command = [*map(str, (program, "leaks", obj, inside, rays)), "1", str(places), accel]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        counts: dict[str, int] = json.loads(done.stdout)
        print(done.stdout, done.stderr)
        return counts


def _words(target: str) -> list[str]:
    return make("-s", target).splitlines()[-1].split()


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    return Workshop(tmp_path_factory.mktemp("hits"))


@pytest.fixture(scope="module")
def program(workshop: Workshop) -> Path:
    return workshop.program()


@pytest.fixture(scope="module")
def meshes() -> dict[str, HitMesh]:
    made = hit_meshes()
    assert tuple(made) == NAMES
    return made


@pytest.mark.parametrize("name", NAMES)
def test_all_accelerators_agree_and_nothing_leaks(
    workshop: Workshop, program: Path, meshes: dict[str, HitMesh], name: str
) -> None:
    mesh = meshes[name]
    counts = workshop.hits(program, mesh, RAYS)
    assert counts["rays"] == RAYS
    assert counts["hits"] > RAYS / 2
    assert counts["linear_rays"] >= min(RAYS, 75)
    assert counts["wide_differs"] == 0
    assert counts["linear_differs"] == 0
    assert counts["embree_differs"] == 0
    assert counts["any_differs"] == 0
    assert counts["from_inside"] == (RAYS // 2 if mesh.inside else 0)
    assert counts["leaks"] == 0


@pytest.mark.parametrize("name", ["slivers", "boulder"])
def test_a_mesh_that_is_shown_many_times_is_hit_like_its_copies(
    workshop: Workshop, program: Path, meshes: dict[str, HitMesh], name: str
) -> None:
    counts = workshop.hits(program, meshes[name], RAYS, PLACES)
    assert counts["placed"] == PLACES
    assert counts["hits"] > RAYS / 2
    assert counts["linear_rays"] >= min(RAYS, 50)
    assert counts["wide_differs"] == 0
    assert counts["linear_differs"] == 0
    assert counts["embree_differs"] == 0
    assert counts["any_differs"] == 0
    assert counts["leaks"] == 0


def test_a_margin_that_is_too_thin_shows(workshop: Workshop, meshes: dict[str, HitMesh]) -> None:
    margin = "0x1p-20f * condition"
    program = workshop.program("src/accel/placement.c", margin, f"-{margin}".replace("20", "13"))
    assert workshop.hits(program, meshes["boulder"], 5_000, PLACES)["wide_differs"] > 0


@pytest.mark.parametrize(("name", "places"), [("knot", 0), ("boulder", PLACES)])
def test_a_closed_mesh_leaks_no_ray(
    workshop: Workshop, program: Path, meshes: dict[str, HitMesh], name: str, places: int
) -> None:
    counts = workshop.leaks(program, meshes[name], places, "wide", LEAK_RAYS)
    assert counts["rays"] == LEAK_RAYS
    assert counts["leaks"] == 0
    assert counts["unblocked"] == 0


def test_embree_is_compared_where_it_is_installed(
    workshop: Workshop, program: Path, meshes: dict[str, HitMesh]
) -> None:
    installed = Path("/usr/include/embree3/rtcore.h").is_file()
    assert workshop.hits(program, meshes["cube"], 10)["embree"] == installed


def test_seams_open_by_a_millionth_leak(workshop: Workshop, meshes: dict[str, HitMesh]) -> None:
    program = workshop.program("src/shapes/triangle.c", "0x1p-26", "-0x1p-20")
    assert workshop.hits(program, meshes["ball"], RAYS)["leaks"] > 0
    counts = workshop.leaks(program, meshes["ball"], 0, "wide", LESS_LEAK_RAYS)
    assert counts["leaks"] > 0
    assert counts["unblocked"] > 0


def test_a_box_that_is_too_small_shows(workshop: Workshop, meshes: dict[str, HitMesh]) -> None:
    program = workshop.program(
        "src/accel/aabb.c", "slack = 1.0f + 6.0f * 0x1p-24f", "slack = 0.99f"
    )
    counts = workshop.hits(program, meshes["boulder"], 20_000)
    assert counts["linear_differs"] > 0
    assert counts["leaks"] > 0


def test_the_first_of_equally_near_triangles_is_hit_whatever_the_order(
    workshop: Workshop, meshes: dict[str, HitMesh]
) -> None:
    users = ("src/scene/scene.c", "src/accel/wide.c")
    rule = "return a->primitive < b->primitive;"
    program = workshop.program("src/accel/nearest.h", rule, "return true;", users)
    counts = workshop.hits(program, meshes["cube"], 20_000)
    assert counts["linear_differs"] > 0
    assert counts["wide_differs"] > 0


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("boulder", "box_width = 0x1p-21f", "box_width = -0x1p-9f"),
        ("boulder", "triangle_width = 0x1p-20f", "triangle_width = -0x1p-12f"),
    ],
)
def test_a_beam_that_is_too_thin_shows(
    workshop: Workshop, meshes: dict[str, HitMesh], name: str, old: str, new: str
) -> None:
    program = workshop.program("src/accel/beam.c", old, new)
    assert workshop.hits(program, meshes[name], 20_000)["wide_differs"] > 0


def test_a_build_without_embree_refuses_it_by_name(tmp_path: Path) -> None:
    """accel.c compiled as build.mk does it where Embree is not installed."""
    objects = _words("list-objects")
    main = objects[0].replace("accel/aabb.o", "main.o")
    left = [path for path in objects if not path.endswith(("accel/accel.o", "accel/embree.o"))]
    compiler = [word for word in _words("list-compiler") if word != "-DRAYBOOK_EMBREE"]
    libraries = [word for word in _words("list-libraries") if word != "-lembree3"]
    program = tmp_path / "raybook"
    command = [*compiler, "src/accel/accel.c", main, *left, *libraries, "-o", str(program)]
    subprocess.run(command, cwd=ROOT, check=True)
    done = run(CORNELL, "--accel", "embree", cwd=tmp_path, binary=program)
    assert done.returncode == 2
    assert done.stderr == (
        "raybook: --accel embree: this build has no Embree: install libembree-dev and build again\n"
    )
