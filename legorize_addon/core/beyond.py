"""What a model made as in the paper has that the paper does not have: counted, so that it can be told.

Without these a model of the literal ways falls apart: thin legs vanish, bodies that
nearly touch stay apart, and plates that stick out from bricks hang on nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .build import Draft
from .model import Bricks, Role, UnitGrid
from .shell import count_additions
from .slicing import covered_area_shares, cut_at_grid
from .unit_bricks import half_covered
from .units import BRICK, CELL_AREA


@dataclass(frozen=True, slots=True)
class Beyond:
    """Repairs that the paper does not have.

    Attributes
    ----------
    thin : int
        Unit bricks in no slice of which half of the cell is covered.
    between : int
        Unit bricks between bodies that nearly touch.
    under_roofs : int
        Unit bricks under roofs of one layer.
    in_plates : int
        Unit bricks that are laid in plates, so that parts beside them are joined.
    ties : int
        Parts more than before parts were joined by plates across their seams.
    pillars : int
        Bricks of pillars that stay under what would fall without them.
    """

    thin: int
    between: int
    under_roofs: int
    in_plates: int
    ties: int
    pillars: int

    def sentence(self) -> str:
        """Return one sentence on all of them."""
        counts = (
            (self.thin, "unit bricks of thin parts"),
            (self.between, "between bodies that nearly touch"),
            (self.under_roofs, "under thin roofs"),
            (self.in_plates, "laid in plates at seams"),
            (self.ties, "more parts by ties"),
            (self.pillars, "bricks of pillars that stay"),
        )
        listed = ", ".join(f"{count} {what}" for count, what in counts if count)
        return f"Beyond the paper, so that the model holds: {listed or 'nothing'}."


def beyond_paper(made: Draft, hollowed: UnitGrid, final: Bricks, *, plates: bool, ties: int) -> Beyond:
    """Count the repairs.

    Parameters
    ----------
    made : Draft
    hollowed : UnitGrid
        Its cells before anything was added so that they hold together.
    final : Bricks
        The finished model.
    plates : bool
        Whether plates may be used.
    ties : int
        Parts more than before parts were joined by ties.

    Returns
    -------
    Beyond
    """
    added = count_additions(hollowed, plates=plates)
    pillars = int(np.count_nonzero(final.role == Role.SUPPORT_KEPT))
    return Beyond(_thin(made), added.between, added.under_roofs, added.in_plates, ties, pillars)


def _thin(made: Draft) -> int:
    """Count the unit bricks in no slice of which half of the cell is covered."""
    solid, loops, corner = made.grid.solid.any(axis=1), made.trajectories, made.grid.origin
    n_slices, layer = len(made.cut.slices.heights), np.floor((made.cut.slices.heights - corner[2]) / BRICK).astype(int)
    pieces = cut_at_grid(loops.points, loops.ends, corner[:2])
    of_piece = loops.loop_slice[loops.edge_loop].astype(np.int64)[pieces.edge]
    half = half_covered(covered_area_shares(pieces, of_piece, n_slices, *solid.shape[1:]) / CELL_AREA)
    covered = np.zeros_like(solid)
    there = (layer >= 0) & (layer < len(solid))
    np.logical_or.at(covered, layer[there], half[there])
    return int(np.count_nonzero(solid & ~covered))
