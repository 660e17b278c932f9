"""Which submissions wait for which work."""

from __future__ import annotations

from collections.abc import Mapping


class Waiting:
    """Tells, as each piece of work is done, whose last one it was."""

    def __init__(self, keys: Mapping[str, set[str]]) -> None:
        self._left = {name: set(own) for name, own in keys.items()}
        self._names: dict[str, list[str]] = {}
        for name, own in keys.items():
            for key in own:
                self._names.setdefault(key, []).append(name)

    def finish(self, key: str) -> list[str]:
        """The submissions that are finished with this piece of work."""
        finished = []
        for name in self._names.pop(key, []):
            self._left[name].discard(key)
            if not self._left[name]:
                finished.append(name)
        return finished
