"""From loops to the grid of unit bricks: which cells are filled, in which colour, and where plates pay."""

from __future__ import annotations

from .backing import add_backing
from .dithering import dithering_of, remarks_on_dithering
from .facing import Facing, facing_of
from .feet import add_feet, said_of_feet
from .generation import Raster, Rules, half_covered, unit_bricks
from .offset_bricks import add_offset_bricks
from .offset_rings import Offsets, OverhangKind, overhang_kinds
from .plates import Detail
from .wanted_colours import WantedColours, wanted_colours

__all__ = [
    "Detail",
    "Facing",
    "Offsets",
    "OverhangKind",
    "Raster",
    "Rules",
    "WantedColours",
    "add_backing",
    "add_feet",
    "add_offset_bricks",
    "dithering_of",
    "facing_of",
    "half_covered",
    "overhang_kinds",
    "remarks_on_dithering",
    "said_of_feet",
    "unit_bricks",
    "wanted_colours",
]
