"""`make report`: the student's text with pictures and timings, as a page and as a PDF."""

from __future__ import annotations

import base64
import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from student_edition import RIGHT, run_make, stub, student_edition, write_module

from raybook_grader.student.report.page import page_html
from raybook_grader.student.report.renderings import NotDrawn, Renderer, Rendering

STATS = {
    "threads": 1,
    "primitives": 35,
    "samples": 4096,
    "samples_per_second": 2.5e6,
    "build_seconds": 0.002,
    "render_seconds": 0.25,
    "boxes_tested": 40_000,
    "primitives_tested": 10_000,
    "rays": {"camera": 4000, "shadow": 1000},
}


@dataclass(frozen=True)
class Fake(Renderer):
    """Draws scenes/a.json only, and that is four bytes."""

    def render(self, scene: str, options: str = "") -> Rendering:
        if scene != "scenes/a.json":
            raise NotDrawn(f"there is no file {scene}")
        return Rendering(b"PNG!", STATS)


def page(text: str) -> str:
    return page_html(text, Fake(Path("raybook"), Path()), lambda: [])


def test_a_scene_becomes_a_figure() -> None:
    html = page('![My <room>](scenes/a.json "--spp 4")')
    assert f"data:image/png;base64,{base64.b64encode(b'PNG!').decode()}" in html
    assert "My &lt;room&gt;" in html
    assert "scenes/a.json --spp 4: 4,096 samples in 0.25 s on 1 thread, 2.50 million" in html


def test_other_pictures_stay() -> None:
    assert '<img src="hole.png" alt="the hole"' in page("![the hole](hole.png)")


def test_timings_are_a_table() -> None:
    html = page("```timings\nscenes/a.json --spp 4\n\nscenes/none.json\n```")
    for cell in ("35", "2 ms", "0.25 s", "2.50 million", "8.0", "2.0"):
        assert f"<td>{cell}</td>" in html
    assert "there is no file scenes/none.json" in html
    heading, row = re.findall(r"<tr>(.*?)</tr>", html)[:2]
    assert heading.count("<th>") == row.count("<td>")


def test_what_is_not_drawn_is_said() -> None:
    assert "there is no file scenes/b.json" in page("![b](scenes/b.json)")


def test_markup_in_the_text_is_text() -> None:
    assert "<script>" not in page("<script>alert(1)</script>")
    assert "<code>int a;" in page("```c\nint a;\n```").replace(' class="language-c"', "")


@pytest.fixture
def folder() -> Iterator[Path]:
    edition = student_edition()
    write_module(edition, RIGHT.read_text(encoding="utf-8"))
    text = (edition / "report.md").read_text(encoding="utf-8")
    yield edition
    write_module(edition, stub())
    (edition / "report.md").write_text(text, encoding="utf-8")


REPORT = """# The report of A. Student

Some words of mine.

```assignments
```

![My room](scenes/cornell-box.json "--resolution 64x64 --spp 1")

```timings
scenes/cornell-box.json --resolution 64x64 --spp 1
```
"""


def test_a_report_of_the_students_own_build(folder: Path) -> None:
    (folder / "report.md").write_text(REPORT, encoding="utf-8")
    made = run_make(folder, "report")
    assert made.returncode == 0, made.stderr
    assert made.stdout.split()[-2:] == ["build/report/report.html", "build/report/report.pdf"]
    html = (folder / "build/report/report.html").read_text(encoding="utf-8")
    assert not re.search(r"(src|href)=\"(?!data:|#)", html), "one file, nothing to fetch"
    command = ["pdftotext", "-layout", str(folder / "build/report/report.pdf"), "-"]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    for words in ("The report of A. Student", "Some words of mine", "My room", "01 triangle"):
        assert words in text
    listed = ["pdfimages", "-list", str(folder / "build/report/report.pdf")]
    images = subprocess.run(listed, capture_output=True, text=True, check=True).stdout.splitlines()
    assert next(line.split()[3:5] for line in images[2:]) == ["64", "64"]


def test_the_template_asks_for_scenes_that_exist() -> None:
    edition = student_edition()
    text = (edition / "report.md").read_text(encoding="utf-8")
    scenes = re.findall(r"scenes/[\w./-]+\.json", text)
    assert len(scenes) > 5
    assert all((edition / scene).is_file() for scene in scenes)
