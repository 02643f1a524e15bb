"""Output files: LDraw documents, lists for shops, and their folder."""

from __future__ import annotations

from .build_order_csv import build_order_csv
from .folder import new_folder
from .ldraw import ldraw_matrix, write_ldr
from .ldraw_mpd import write_mpd
from .paths import named
from .shopping import (
    PartsList,
    bricklink_xml,
    count_parts,
    masses,
    not_made,
    parts_csv,
    pick_a_brick_csv,
    rebrickable_csv,
)
from .single import replacing, write_whole

__all__ = [
    "PartsList",
    "bricklink_xml",
    "build_order_csv",
    "count_parts",
    "ldraw_matrix",
    "masses",
    "named",
    "new_folder",
    "not_made",
    "parts_csv",
    "pick_a_brick_csv",
    "rebrickable_csv",
    "replacing",
    "write_ldr",
    "write_mpd",
    "write_whole",
]
