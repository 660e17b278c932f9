"""Which known mistake a failing module looks like.

The same cases are given to every module, so two modules with the same mistake fail on the same
cases in the same way, however differently they are written.
"""

from .library import load_known, save_known
from .nearest import Diagnosis, Known, nearest

__all__ = ["Diagnosis", "Known", "load_known", "nearest", "save_known"]
