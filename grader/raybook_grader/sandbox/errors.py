"""The two ways in which a box can fail that are nobody's submission's fault."""

from __future__ import annotations


class SandboxUnavailable(Exception):
    """This machine cannot make a box; the message names what is missing and the remedy."""


class BoxError(ValueError):
    """The harness asked for a box that makes no sense; the message says what and where."""
