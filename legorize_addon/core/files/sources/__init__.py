"""Files that people bring, looked at before Blender opens them.

Blender's importers trust what a file says of itself: a count that the data do
not hold ends the whole program, a damaged structure a traceback. So the
structure is checked first, as far as that is simple and sure: no file that an
importer can read in full is refused. What will be missing is told in remarks.

Nothing here needs Blender.
"""

from __future__ import annotations

from .lost_places import is_lost, without_lost_places
from .preflight import check_source, unchanged

__all__ = [
    "check_source",
    "is_lost",
    "unchanged",
    "without_lost_places",
]
