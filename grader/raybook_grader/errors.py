"""What every command raises when its user, not the harness, is at fault."""

from __future__ import annotations


class BadInput(Exception):
    """A wrong argument or file: one message that says what, where and what was expected.

    The command line prints it and exits 2; nothing partial is left behind.
    """
