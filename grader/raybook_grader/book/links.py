"""The links of the finished pages: none is dead, and nothing is fetched from elsewhere.

A link that a reader may follow to another site (a paper's address) is fine; a picture, a script,
a style or a font from there is not.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from html.parser import HTMLParser
from os.path import normpath
from pathlib import Path
from urllib.parse import unquote, urldefrag

_REMOTE = re.compile(r"(?:[a-z]+:)?//", re.IGNORECASE)
_ELSEWHERE = ("http:", "https:", "mailto:", "data:", "doi:")
_CSS_URL = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")
_FOLLOWED = {"a", "area"}


@dataclass(frozen=True)
class _Reference:
    tag: str
    address: str
    line: int


@dataclass
class _Page(HTMLParser):
    """The ids of a page and what it refers to."""

    references: list[_Reference] = field(default_factory=list)
    ids: set[str] = field(default_factory=set)
    doubled: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value for name, value in attrs if value}
        if tag == "link" and values.get("rel") in ("index", "search", "next", "prev", "author"):
            tag = "a"
        if identity := values.get("id"):
            self.doubled += [identity] if identity in self.ids else []
            self.ids.add(identity)
        for key in ("href", "src", "srcset", "poster", "data"):
            if key in values and (key != "data" or tag == "object"):
                self.references.append(_Reference(tag, values[key], self.getpos()[0]))
        if "style" in values:
            self.references += [_Reference("style", u, 0) for u in css_addresses(values["style"])]


def link_faults(site: Path) -> list[str]:
    """What is wrong with the links of the site in a folder; none if all is well."""
    site = site.resolve()
    pages = {file: _read(file) for file in sorted(site.rglob("*.html"))}
    faults = []
    for file, page in pages.items():
        name = file.relative_to(site)
        faults += [f"{name}: the id {identity} stands twice" for identity in page.doubled]
        for reference in page.references:
            if fault := _fault(file, reference, pages):
                faults.append(f"{name}:{reference.line}: {fault}")
    for file in sorted(site.rglob("*.css")):
        faults += [f"{file.relative_to(site)}: {fault}" for fault in _css_faults(file)]
    return list(dict.fromkeys(faults))


def css_addresses(text: str) -> list[str]:
    """What a style sheet fetches."""
    return [first or second for first, second in _CSS_URL.findall(text)]


def _read(file: Path) -> _Page:
    page = _Page()
    page.feed(file.read_text(encoding="utf-8"))
    return page


def _fault(file: Path, reference: _Reference, pages: Mapping[Path, _Page]) -> str | None:
    address = reference.address
    if address.startswith("data:"):
        return None
    if _REMOTE.match(address) or address.startswith(_ELSEWHERE):
        followed = reference.tag in _FOLLOWED
        return None if followed else f"<{reference.tag}> fetches {address}"
    path, anchor = urldefrag(address)
    path = path.partition("?")[0]
    # A book has 20,000 links: Path.resolve would ask the file system for each part of each.
    target = Path(normpath(file.parent / unquote(path))) if path else file
    if not target.is_file():
        return f"dead link {address}"
    page = pages.get(target) if anchor else None
    if page is not None and unquote(anchor) not in page.ids:
        return f"dead link {address}: no such place on that page"
    return None


def _css_faults(file: Path) -> list[str]:
    faults = []
    for address in css_addresses(file.read_text(encoding="utf-8")):
        if address.startswith(("data:", "#")):
            continue
        if _REMOTE.match(address):
            faults.append(f"fetches {address}")
        elif not (file.parent / urldefrag(address)[0].partition("?")[0]).is_file():
            faults.append(f"dead url {address}")
    return faults
