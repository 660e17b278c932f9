"""A class's work: which submissions there are, and the few files of each that are ever read."""

from .find import find_submissions, latest
from .submission import Submission, SubmittedFile

__all__ = ["Submission", "SubmittedFile", "find_submissions", "latest"]
