"""The covering problem of one sheet: its cells, the shapes, the placements and what each costs."""

from __future__ import annotations

from .bars import Bar, without_barred
from .blocks import blocks
from .candidates import Amounts, Candidates
from .dominance import dominated
from .placements import Placements, placements, segment_sums
from .planes import spread
from .problem import BRIDGE, GROUND, Problem, owners, part_costs, pose, standing, with_margins
from .shapes import Index, Plane, Rows, Shapes, pattern_bits, shapes
from .sheets import Sheets, split
from .table import brick_table, gather

__all__ = [
    "BRIDGE",
    "GROUND",
    "Amounts",
    "Bar",
    "Candidates",
    "Index",
    "Placements",
    "Plane",
    "Problem",
    "Rows",
    "Shapes",
    "Sheets",
    "blocks",
    "brick_table",
    "dominated",
    "gather",
    "owners",
    "part_costs",
    "pattern_bits",
    "placements",
    "pose",
    "segment_sums",
    "shapes",
    "split",
    "spread",
    "standing",
    "with_margins",
    "without_barred",
]
