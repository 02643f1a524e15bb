"""Helpers on plain arrays, unaware of bricks: ranges, cuts at grid lines, support polygons, mirroring, neighbours."""

from __future__ import annotations

from .grid_lines import split_at_lattice
from .mirroring import SYMMETRIC, mirror_axis, mirrored_share
from .neighbourhoods import outer_air, visible
from .ranges import ranges
from .support_polygon import beyond, corners, hull, inside, inside_with

__all__ = [
    "SYMMETRIC",
    "beyond",
    "corners",
    "hull",
    "inside",
    "inside_with",
    "mirror_axis",
    "mirrored_share",
    "outer_air",
    "ranges",
    "split_at_lattice",
    "visible",
]
