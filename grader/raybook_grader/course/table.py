"""Reading a TOML table key by key, so that each fault names its file, its key and the cure."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from typing import Any, TypeVar

from ..errors import BadInput

T = TypeVar("T")


class Table:
    """One table of a TOML file. Every key is taken once; `finish` refuses what is left.

    ``place`` is "" for the file's top, else like "check 2". Every fault is a `BadInput`.
    """

    def __init__(self, file: Path, place: str, values: dict[str, Any]) -> None:
        self.file = file
        self.place = place
        self._values = dict(values)
        self._known: set[str] = set()

    def fault(self, key: str, found: object, expected: str) -> BadInput:
        """The one message of a wrong key."""
        where = f"{self.place}, {key}" if self.place else key
        return BadInput(f"{self.file}: {where}: {found}, expected {expected}")

    def take(
        self, key: str, kind: type[T] | tuple[type[T], ...], expected: str, default: T | None = None
    ) -> T:
        """The value of a key that has the given type; it is required if it has no default."""
        self._known.add(key)
        if key not in self._values:
            if default is None:
                raise self.fault(key, "is missing", expected)
            return default
        value = self._values.pop(key)
        kinds = kind if isinstance(kind, tuple) else (kind,)
        if not isinstance(value, kinds) or (isinstance(value, bool) and bool not in kinds):
            raise self.fault(key, f"is {value!r}", expected)
        return value

    def has(self, key: str) -> bool:
        """Whether a key that may be left out is there."""
        self._known.add(key)
        return key in self._values

    def keys(self) -> list[str]:
        """The keys that nobody has taken yet, where any name may be one."""
        return list(self._values)

    def text(self, key: str, default: str | None = None) -> str:
        value = self.take(key, str, "text that is not empty", default)
        if not value.strip():
            raise self.fault(key, "is empty", "text that is not empty")
        return value

    def flag(self, key: str) -> bool:
        return self.take(key, bool, "true or false", False)

    def number(self, key: str, default: float | None = None) -> float:
        """A number above zero."""
        value = self.take(key, (int, float), "a number above 0", default)
        if not 0 < value < float("inf"):
            raise self.fault(key, f"is {value}", "a number above 0")
        return float(value)

    def whole(self, key: str, least: int, default: int | None = None) -> int:
        expected = f"a whole number, at least {least}"
        value = self.take(key, int, expected, default)
        if value < least:
            raise self.fault(key, f"is {value}", expected)
        return value

    def path(self, key: str, base: Path) -> str:
        """A file below ``base``, which must exist."""
        return self.check_path(key, self.text(key), base)

    def check_path(self, key: str, value: str, base: Path) -> str:
        pure = PurePosixPath(value)
        if pure.is_absolute() or ".." in pure.parts or str(pure) != value:
            raise self.fault(key, f"is {value!r}", f"a plain path below {base}")
        if not (base / value).is_file():
            raise self.fault(key, f"is {value!r}", f"a file that exists below {base}")
        return value

    def texts(self, key: str, default: list[str] | None = None) -> tuple[str, ...]:
        """A list of different texts."""
        expected = "a list of different texts"
        value: list[Any] = self.take(key, list, expected, default)
        if not all(isinstance(item, str) and item for item in value):
            raise self.fault(key, f"is {value!r}", expected)
        if len(set(value)) != len(value):
            raise self.fault(key, f"is {value!r}", expected)
        return tuple(value)

    def tables(self, key: str, name: Callable[[int], str]) -> list[Table]:
        """An array of tables, none by default; ``name`` says how faults call the n-th."""
        expected = f"tables, each headed [[{key}]]"
        value: list[Any] = self.take(key, list, expected, [])
        if not all(isinstance(item, dict) for item in value):
            raise self.fault(key, "is no array of tables", expected)
        return [Table(self.file, name(i + 1), item) for i, item in enumerate(value)]

    def table(self, key: str) -> Table:
        """A table, empty by default."""
        return Table(self.file, key, self.take(key, dict, f"a table, headed [{key}]", {}))

    def finish(self) -> None:
        """Refuse the keys that nobody has taken."""
        for key in self._values:
            near = difflib.get_close_matches(key, self._known, n=1)
            hint = f"{near[0]!r}" if near else f"one of {', '.join(sorted(self._known))}"
            raise self.fault(key, "is no key of this table", hint)
