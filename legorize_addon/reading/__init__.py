"""From files and Blender's scene into the core."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..core.on_demand import on_demand
from .shown import has_surface

if TYPE_CHECKING:
    from .objects import read_objects
else:
    # the panel only asks what has a surface
    __getattr__ = on_demand(__name__, objects=("read_objects",))

__all__ = [
    "has_surface",
    "read_objects",
]
