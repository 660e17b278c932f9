"""The page: escaped, self-contained, every mark leads to its counterpart; and the command."""

from __future__ import annotations

import json
import random
from html.parser import HTMLParser
from pathlib import Path

import pytest
from course_text import CHECKOUT, COURSE, OWNED, copied, of_museum, submission

from raybook_grader.cli import parser
from raybook_grader.similarity import report
from raybook_grader.similarity.report import write_report
from raybook_grader.similarity.search import search
from raybook_grader.submissions import Submission

EVIL = "<script>alert('x')</script>\"&"
BVH = OWNED["03"][0]


class Page(HTMLParser):
    """What matters of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(tag)
        values = dict(attrs)
        if values.get("id"):
            self.ids.append(str(values["id"]))
        for name in ("href", "src", "action", "data", "srcset"):
            if values.get(name):
                self.links.append(str(values[name]))

    def handle_data(self, data: str) -> None:
        self.text += data


def the_class() -> list[Submission]:
    rng = random.Random(1)
    text = of_museum("03")["sah-sweep"][BVH]
    evil = f"/* {EVIL} */\n" + text
    return [
        submission("anna", {BVH: evil}),
        submission(EVIL, {BVH: "\n\n" + copied(text, rng)}),
        submission("carl", {BVH: of_museum("03")["lbvh-morton"][BVH]}),
    ]


@pytest.fixture
def written(tmp_path: Path) -> tuple[Page, dict[str, object]]:
    findings = search(COURSE, the_class(), {}, 0.5)
    page, values = write_report(tmp_path, "A course", findings, 0.5)
    return Page(page.read_text(encoding="utf-8")), json.loads(values.read_text())


def test_everything_is_escaped_and_in_the_page(written: tuple[Page, dict[str, object]]) -> None:
    page, _ = written
    assert not {"script", "img", "link", "iframe", "object", "form"} & set(page.elements)
    assert EVIL in page.text
    assert page.links and all(link.startswith("#") for link in page.links)


def test_each_mark_leads_to_its_counterpart(written: tuple[Page, dict[str, object]]) -> None:
    page, _ = written
    assert len(page.ids) == len(set(page.ids))
    assert {link.removeprefix("#") for link in page.links} <= set(page.ids)
    assert any("a0" in link for link in page.links) and any("b0" in link for link in page.links)


def test_the_texts_are_whole(written: tuple[Page, dict[str, object]]) -> None:
    for one in the_class()[:2]:
        assert one.files[BVH].content.decode() in written[0].text


def test_the_json_says_which_lines(written: tuple[Page, dict[str, object]]) -> None:
    _, values = written
    modules = values["modules"]
    assert isinstance(modules, list)
    (module,) = [m for m in modules if m["assignment"] == "03"]
    assert module["compared"] == 3 and module["pairs"] == 3
    (pair,) = module["alike"]
    assert {pair["a"]["id"], pair["b"]["id"]} == {"anna", EVIL}
    assert pair["similarity"] > 0.9 and pair["b"]["earlier"] is None
    first = pair["parts"][0]
    # Two lines stand before the copy, one before the other.
    assert abs(first["a"]["first"] - first["b"]["first"]) < 15
    assert first["a"]["file"] == first["b"]["file"] == BVH
    lines = sum(part["a"]["last"] - part["a"]["first"] + 1 for part in pair["parts"])
    assert lines > 0.7 * of_museum("03")["sah-sweep"][BVH].count("\n")


def test_too_many_pairs_come_with_their_numbers_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(report, "SHOWN", 1)
    text = of_museum("03")["sah-sweep"][BVH]
    ours = [submission(name, {BVH: text}) for name in "abc"]
    page, values = write_report(tmp_path, "A course", search(COURSE, ours, {}, 0.5), 0.5)
    assert Page(page.read_text(encoding="utf-8")).elements.count("details") == 1
    (module,) = [m for m in json.loads(values.read_text())["modules"] if m["alike"]]
    assert [pair["parts"] is None for pair in module["alike"]] == [False, True, True]


def test_the_command_names_the_pairs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for one in the_class():
        if "/" not in one.id:
            _write(tmp_path / "2026" / one.id / BVH, one.files[BVH].content)
    _write(tmp_path / "2025" / "old" / BVH, the_class()[1].files[BVH].content)
    arguments = ["similarity", tmp_path / "2026", "--out", tmp_path / "out"]
    arguments += ["--earlier", tmp_path / "2025", "--course", CHECKOUT]
    parsed = parser().parse_args([str(argument) for argument in arguments])
    assert parsed.handler(parsed) == 0
    said = capsys.readouterr().out
    assert "03 bvh: anna and 2025/old: " in said and "1 pairs of 3" in said
    assert (tmp_path / "out" / "index.html").is_file()


@pytest.mark.parametrize("share", ["0", "1.5", "half", "nan"])
def test_a_threshold_is_a_share(share: str) -> None:
    with pytest.raises(SystemExit):
        parser().parse_args(["similarity", "class", "--out", "out", "--threshold", share])


def _write(file: Path, content: bytes) -> None:
    file.parent.mkdir(parents=True)
    file.write_bytes(content)
