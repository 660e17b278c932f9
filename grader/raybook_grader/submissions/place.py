"""Where in a submission the owned files lie: at its top, or inside one folder."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from .submission import Unusable


def split_place(name: str, owned: Collection[str]) -> tuple[str, str] | None:
    """(folder, owned path) of a member's name; None for a name that is none of our business.

    The folder is "" at the top. Absolute names and names with `..` are none of our business.
    """
    parts = [part for part in name.split("/") if part != "."]
    if not parts or "" in parts or ".." in parts:
        return None
    if (path := "/".join(parts)) in owned:
        return "", path
    if (path := "/".join(parts[1:])) in owned:
        return parts[0], path
    return None


def choose_folder(folders: Iterable[str]) -> str | None:
    """The top if anything lies there, else the one folder; None when there is nothing."""
    found = sorted(set(folders))
    if not found:
        return None
    if found[0] == "" or len(found) == 1:
        return found[0]
    raise Unusable(
        f"the folders {found[0]!r} and {found[1]!r} both hold files to grade; "
        "expected them at the top or inside one folder"
    )
