"""From files and Blender's scene into the core."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..core.on_demand import on_demand
from .shown import has_surface, image_of

if TYPE_CHECKING:
    from .objects import read_objects
    from .outlines import read_outline
    from .pictures import load_picture, picture_from
    from .weights import weight_names
else:
    # the panel only asks what has a surface
    __getattr__ = on_demand(
        __name__,
        objects=("read_objects",),
        outlines=("read_outline",),
        pictures=("load_picture", "picture_from"),
        weights=("weight_names",),
    )

__all__ = [
    "has_surface",
    "image_of",
    "load_picture",
    "picture_from",
    "read_objects",
    "read_outline",
    "weight_names",
]
