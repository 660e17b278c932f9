"""Looking at a page in headless Chromium, and at all that it does behind the reader's back."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from playwright.sync_api import Browser, ConsoleMessage, Dialog, Page, Route, sync_playwright


@contextmanager
def chromium() -> Iterator[Browser]:
    """One browser, for many pages; Debian's own, which packages.txt names."""
    program = shutil.which("chromium")
    assert program, "chromium is not there: run `make setup`"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield browser
        browser.close()


@dataclass
class Look:
    """An open page; ``requests``, ``errors`` and ``dialogs`` are what it did so far."""

    page: Page
    requests: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)
    dialogs: list[str] = field(default_factory=list)

    @property
    def is_clean(self) -> bool:
        return not (self.requests or self.errors or self.dialogs)

    def js(self, expression: str, argument: Any = None) -> Any:
        return self.page.evaluate(expression, argument)


@contextmanager
def looking(
    browser: Browser,
    file: Path,
    *,
    width: int = 1200,
    dark: bool = False,
    allowed: tuple[Path, ...] = (),
) -> Iterator[Look]:
    """The file as a reader opens it. Nothing but it, and ``allowed``, is answered."""
    scheme: Literal["dark", "light"] = "dark" if dark else "light"
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    try:
        look = Look(context.new_page())
        answered = {path.resolve().as_uri() for path in (file, *allowed)}

        def route(asked: Route) -> None:
            if asked.request.url.partition("#")[0] in answered:
                asked.continue_()
            else:
                look.requests.append(asked.request.url)
                asked.abort()

        def dialog(shown: Dialog) -> None:
            look.dialogs.append(shown.message)
            shown.dismiss()

        def console(said: ConsoleMessage) -> None:
            if said.type == "error":
                look.errors.append(said.text)

        context.route("**/*", route)
        look.page.on("dialog", dialog)
        look.page.on("pageerror", lambda error: look.errors.append(str(error)))
        look.page.on("console", console)
        look.page.goto(file.resolve().as_uri())
        yield look
    finally:
        context.close()
