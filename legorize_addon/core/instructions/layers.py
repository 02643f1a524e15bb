"""Which bricks are laid on which, layer by layer.

Layers are laid one on the other from the table up. Where plates lie between
bricks, the bricks that begin one or two plates above a layer have a map of their own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Ints
from ..model import Bricks, Catalogue
from ..units import PLATES_PER_BRICK


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """What one map shows.

    Attributes
    ----------
    title : str
    new, below, through : (k,) int64 array
        Rows of the bricks that are laid, of those on which they lie, and of taller ones between them.
    """

    title: str
    new: Ints
    below: Ints
    through: Ints


def layers_of(bricks: Bricks, catalogue: Catalogue) -> list[Layer]:
    """Return the layers of a model with its supports, piece by piece from below.

    Parameters
    ----------
    bricks : Bricks
        Model and supports. Pieces are built each by itself.
    catalogue : Catalogue

    Returns
    -------
    list of Layer
    """
    height = catalogue.height[bricks.part]
    low = bricks.corner[:, 2]
    high = low + height
    pieces = np.unique(bricks.piece).tolist()
    found = []
    for number, piece in enumerate(pieces):
        mine = bricks.piece == piece
        ground = int(low[mine].min())
        name = f"Piece {number + 1}, " if len(pieces) > 1 else ""
        for level in np.unique(low[mine]).tolist():
            rows = (mine & (low == level), mine & (high == level), mine & (low < level) & (high > level))
            found.append(Layer(name + _level(level - ground), *(np.flatnonzero(each) for each in rows)))
    return found


def _level(plates: int) -> str:
    layer, above = divmod(plates, PLATES_PER_BRICK)
    return f"Layer {layer + 1}" + (f", {above} plate{'s' * (above > 1)} up" if above else "")
