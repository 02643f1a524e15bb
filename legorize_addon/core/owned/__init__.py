"""Building with the parts that a user owns: prices on scarce lots, an exact repair, and colours for what is left."""

from __future__ import annotations

from .assignment import assign, visible_cells
from .few_lots import SMALL, merge_lots
from .laying import lay_owned, usable
from .other_parts import exchange_small
from .repair import repair_parts

__all__ = [
    "SMALL",
    "assign",
    "exchange_small",
    "lay_owned",
    "merge_lots",
    "repair_parts",
    "usable",
    "visible_cells",
]
