"""Saying how far a long run is: a bar on a terminal, plain lines anywhere else."""

from __future__ import annotations

from types import TracebackType
from typing import Protocol, Self

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.text import Text

from ..visible import visible


class Progressing(Protocol):
    """What a run tells: a step is done, or something is worth a line."""

    def advance(self) -> None: ...

    def say(self, line: str, style: str = "") -> None: ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None: ...


def progress(console: Console, label: str, steps: int) -> Progressing:
    """The bar or the lines, as suits ``console``; to be used in a `with`."""
    return _Bar(console, label, steps) if console.is_terminal else _Lines(console)


def plain(line: str) -> str:
    """A line that no name in it can break, reorder or colour."""
    return visible(line, keep="")


class _Lines:
    def __init__(self, console: Console) -> None:
        self._console = console

    def advance(self) -> None:
        pass

    def say(self, line: str, style: str = "") -> None:
        print(plain(line), file=self._console.file, flush=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        pass


class _Bar:
    def __init__(self, console: Console, label: str, steps: int) -> None:
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            console=console,
        )
        self._task = self._progress.add_task(label, total=steps)

    def advance(self) -> None:
        self._progress.advance(self._task)

    def say(self, line: str, style: str = "") -> None:
        self._progress.console.print(Text(plain(line), style=style))

    def __enter__(self) -> Self:
        self._progress.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._progress.stop()
