"""Checks of users' files before Blender opens them.

Blender's importers trust what a file says about itself: a wrong count crashes the whole program, a damaged structure
gives a traceback. So the structure is checked first, as far as that is simple and certain: no file that an importer can
read in full is refused. Remarks say what will be missing. Nothing here needs Blender.
"""

from __future__ import annotations

from .lost_places import is_lost, without_lost_places
from .pictures import PICTURES, PictureHead, check_picture
from .preflight import check_file, check_source, unchanged

__all__ = [
    "PICTURES",
    "PictureHead",
    "check_file",
    "check_picture",
    "check_source",
    "is_lost",
    "unchanged",
    "without_lost_places",
]
