"""The student's text of an `assignment.toml`: without tables that are hidden.

Hidden is everything under a table that is called `hidden` (`[hidden]`, `[x.hidden]`), and each
table with `hidden = true` (a `[[check]]`) with its sub-tables. The rest keeps its text and its
comments; comments right above a hidden table's header go with the table.
"""

from __future__ import annotations

import re
import tomllib
from typing import Any

_HEADER = re.compile(r"\s*(\[\[?)[^\[\],=]+\]\]?\s*(#.*)?")


def public_toml(name: str, text: str) -> str:
    """The text without its hidden tables.

    The result is parsed again and compared, so nothing hidden gets through. Raises ValueError if
    the text is no TOML, or hides something in another form than that of a table with a header.
    """
    expected = _without_hidden(_load(name, text))
    public = "\n".join(line for block in _public_blocks(text) for line in block)
    public = public.strip("\n") + "\n"
    if not _means(public, expected):
        raise ValueError(
            f"{name}: can't take the hidden part out; expected each hidden table under a "
            "[header] of its own, not inline"
        )
    return public


def _means(text: str, expected: dict[str, Any]) -> bool:
    try:
        return tomllib.loads(text) == expected
    except tomllib.TOMLDecodeError:
        return False


def _load(name: str, text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as fault:
        raise ValueError(f"{name}: {fault}") from None


# What the result must mean.


def _without_hidden(table: dict[str, Any]) -> dict[str, Any]:
    """The parsed text without hidden tables, and without what only held such tables."""
    kept = {key: _clean(value) for key, value in table.items() if not _is_hidden(key, value)}
    return {key: value for key, value in kept.items() if value not in ({}, []) or not table[key]}


def _clean(value: Any) -> Any:
    if isinstance(value, dict):
        return _without_hidden(value)
    if isinstance(value, list):
        return [_clean(item) for item in value if not _is_hidden("", item)]
    return value


def _is_hidden(key: str, value: Any) -> bool:
    if isinstance(value, dict) and value.get("hidden") is True:
        return True
    return key == "hidden" and isinstance(value, dict | list)


# What is cut from the text.


def _public_blocks(text: str) -> list[list[str]]:
    """The text's tables, each with its header and the comments above it, but the hidden ones."""
    public: list[list[str]] = []
    hidden: list[str] | None = None  # the path of the hidden table that we are in
    for block in _blocks(text):
        path, values = _header_path(block), _values(block)
        if hidden is not None and len(path) > len(hidden) and path[: len(hidden)] == hidden:
            continue
        hidden = path if "hidden" in path or values.get("hidden") is True else None
        if hidden is None:
            public.append(block)
    return public


def _blocks(text: str) -> list[list[str]]:
    blocks: list[list[str]] = [[]]
    for line in text.split("\n"):
        if _HEADER.fullmatch(line):
            blocks.append(_pop_comments(blocks[-1]))
        blocks[-1].append(line)
    return blocks


def _pop_comments(block: list[str]) -> list[str]:
    """Take the comments off the end of a block: they belong to the header that follows."""
    start = len(block)
    while start > 0 and block[start - 1].lstrip().startswith("#"):
        start -= 1
    comments = block[start:]
    del block[start:]
    return comments


def _header_path(block: list[str]) -> list[str]:
    header = next((line for line in block if _HEADER.fullmatch(line)), None)
    path: list[str] = []
    value: Any = _values([header]) if header else {}
    while value:
        (key, value), *_ = value.items()
        path.append(key)
        value = value[0] if isinstance(value, list) else value
    return path


def _values(block: list[str]) -> dict[str, Any]:
    """What the lines of a block say; nothing if they are no TOML of their own."""
    own = [line for line in block if not _HEADER.fullmatch(line)] if len(block) > 1 else block
    try:
        return tomllib.loads("\n".join(own))
    except tomllib.TOMLDecodeError:
        return {}
