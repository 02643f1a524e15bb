"""Output files: LDraw documents, the table of moves, and their folder."""

from __future__ import annotations

from .build_order_csv import build_order_csv
from .folder import new_folder
from .ldraw import MAIN_COLOUR, MATRICES, ldraw_matrix, part_origin, write_ldr
from .ldraw_mpd import write_mpd
from .paths import named
from .single import replacing, write_whole
from .tiles_csv import tiles_csv

__all__ = [
    "MAIN_COLOUR",
    "MATRICES",
    "build_order_csv",
    "ldraw_matrix",
    "named",
    "new_folder",
    "part_origin",
    "replacing",
    "tiles_csv",
    "write_ldr",
    "write_mpd",
    "write_whole",
]
