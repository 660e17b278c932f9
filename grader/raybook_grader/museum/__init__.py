"""The museum: modules that are known to be right, and mistakes that are known to be wrong.

They stand in `assignments/NN-*/alternatives` and `mistakes`. The grader is tested on them, and
its diagnosis learns from them.
"""

from .exhibits import Exhibit, Twin, exhibits_of, reference_of, twins_of
from .label import Label

__all__ = ["Exhibit", "Label", "Twin", "exhibits_of", "reference_of", "twins_of"]
