"""The way back: C files from the pages of the book, and nothing else."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

from ..errors import BadInput


@dataclass
class _Row:
    """A line as the page shows it; `nested` is the key of the fragment that it stands for."""

    text: str = ""
    nested: str = ""
    is_comment: bool = False


@dataclass
class _Box:
    """A code box of a page."""

    page: str
    file: str
    indent: int
    is_root: bool
    rows: list[_Row] = field(default_factory=list)


@dataclass
class _Reader(HTMLParser):
    """Gathers the code boxes of a page; stubs beside a solution are no part of them."""

    page: str
    boxes: dict[str, _Box]
    box: _Box | None = None
    in_pre: bool = False
    in_stub: bool = False

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        names = values.get("class", "").split()
        if tag == "figure" and "rb-code" in names:
            self._begin(values)
        elif tag == "details" and "rb-stub" in names:
            self.in_stub = True
        elif tag == "pre":
            self.in_pre = self.box is not None and not self.in_stub
        elif self.in_pre and self.box and "rb-line" in names:
            comment = "data-comment" in values
            self.box.rows.append(_Row("", values.get("data-nested", ""), comment))

    def handle_endtag(self, tag: str) -> None:
        if tag == "figure":
            self.box = None
        elif tag == "details":
            self.in_stub = False
        elif tag == "pre":
            self.in_pre = False

    def handle_data(self, data: str) -> None:
        if self.in_pre and self.box and self.box.rows:
            self.box.rows[-1].text += data

    def _begin(self, values: Mapping[str, str]) -> None:
        key, file = values["id"], values["data-file"]
        if key in self.boxes:
            raise BadInput(f"{self.page}: {key} is also on {self.boxes[key].page}")
        self.box = _Box(self.page, file, int(values["data-indent"]), "data-root" in values)
        self.boxes[key] = self.box


def untangle(site: Path) -> dict[str, str]:
    """Every file that the pages of a folder show, by its name; raises BadInput for what doesn't
    come together."""
    boxes: dict[str, _Box] = {}
    for page in sorted(site.rglob("*.html")):
        _Reader(page.relative_to(site).as_posix(), boxes).feed(page.read_text(encoding="utf-8"))
    used: set[str] = set()
    files = {
        box.file: "".join(f"{line}\n" for line in _expand(boxes, key, used))
        for key, box in boxes.items()
        if box.is_root
    }
    if left := boxes.keys() - used:
        raise BadInput(f"in no file of the book: {', '.join(sorted(left))}")
    return files


def _expand(boxes: Mapping[str, _Box], key: str, used: set[str]) -> Iterator[str]:
    if key not in boxes:
        raise BadInput(f"{key} is used, but no page shows it")
    used.add(key)
    box = boxes[key]
    for row in box.rows:
        text = row.text.removesuffix("\n")
        line = " " * box.indent + text if text.strip() else text
        if not row.nested:
            yield line
            continue
        if row.is_comment:
            yield _comment(line)
        yield from _expand(boxes, row.nested, used)


def _comment(line: str) -> str:
    """The comment with a fragment's title, as the student's file has it."""
    indent, _, rest = line.partition("⟨")
    title = rest.rpartition("⟩")[0]
    return f"{indent}/* {title}{'' if title.endswith(('.', '?', '!')) else '.'} */"
