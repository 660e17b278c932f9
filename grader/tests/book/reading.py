"""Reading the book in headless Chromium, and noting what goes wrong behind the reader's back."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from playwright.sync_api import Browser, ConsoleMessage, Page, Route

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "reports"))
from looking import chromium

__all__ = ["chromium", "reading"]


@dataclass
class Reading:
    """An open page of a site; ``faults`` are errors, and requests that leave the site."""

    page: Page
    faults: list[str] = field(default_factory=list)

    def js(self, expression: str) -> Any:
        return self.page.evaluate(expression)


@contextmanager
def reading(
    browser: Browser, site: Path, page: str, *, width: int = 1200, dark: bool = False
) -> Iterator[Reading]:
    """A page as a reader opens it, from a file and without a network."""
    scheme: Literal["dark", "light"] = "dark" if dark else "light"
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    try:
        read = Reading(context.new_page())
        home = site.resolve().as_uri()

        def route(asked: Route) -> None:
            if asked.request.url.startswith(home):
                asked.continue_()
            else:
                read.faults.append(f"asks for {asked.request.url}")
                asked.abort()

        def console(said: ConsoleMessage) -> None:
            if said.type in ("error", "warning"):
                read.faults.append(said.text)

        context.route("**/*", route)
        read.page.on("requestfailed", lambda asked: read.faults.append(f"no {asked.url}"))
        read.page.on("pageerror", lambda error: read.faults.append(str(error)))
        read.page.on("console", console)
        read.page.goto(f"{home}/{page}")
        yield read
    finally:
        context.close()
