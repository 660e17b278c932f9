"""What every command raises when its user, not the harness, is at fault."""

from __future__ import annotations


class BadInput(Exception):
    """A wrong argument or file: one message that says what, where and what was expected.

    The command line prints it and exits 2; nothing partial is left behind.
    """


class Trouble(Exception):
    """The machine stands in the way: a full disk, a file that is damaged or cannot be written.

    The message says what is kept and how to go on. The command line prints it and exits 1.
    """
