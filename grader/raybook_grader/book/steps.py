"""What is being done, told while it is done, and at the end how long each step took."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock


class Steps:
    """The steps of one `make book`; editions are made side by side."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._start = time.monotonic()
        self._seconds: dict[str, dict[str, float]] = {}

    @contextmanager
    def step(self, edition: str, name: str) -> Iterator[None]:
        """Times what is done in it."""
        start = time.monotonic()
        try:
            yield
        finally:
            self._add(edition, name, time.monotonic() - start)

    def _add(self, edition: str, name: str, seconds: float) -> None:
        with self._lock:
            self._seconds.setdefault(name, {})[edition] = seconds
            so_far = time.monotonic() - self._start
            print(f"{so_far:6.0f} s  {edition}: {name} ({seconds:.1f} s)", flush=True)

    def table(self) -> str:
        """A line for each step, a column for each edition; seconds of the clock."""
        editions = list(dict.fromkeys(e for own in self._seconds.values() for e in own))
        rows = ["".join([f"{'seconds':36}", *(f"{e:>12}" for e in editions)])]
        for name, own in self._seconds.items():
            cells = (f"{own[e]:12.1f}" if e in own else " " * 12 for e in editions)
            rows.append("".join([f"{name:36}", *cells]).rstrip())
        return "\n".join(rows)
