"""What all of the grader's HTML pages share: escaping, the policy, the style, the colours."""

from .assets import Assets, assets
from .environment import environment
from .visible import shortened, visible

__all__ = ["Assets", "assets", "environment", "shortened", "visible"]
