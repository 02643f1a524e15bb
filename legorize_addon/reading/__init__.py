"""From files and Blender's scene into the core."""

from __future__ import annotations

from .objects import read_objects
from .shown import has_surface

__all__ = [
    "has_surface",
    "read_objects",
]
