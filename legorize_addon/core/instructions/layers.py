"""Which bricks are laid on which, layer by layer.

Layers are laid one on the other from the table up, those of a mosaic tile by tile. Where plates lie between
bricks, the bricks that begin one or two plates above a layer have a map of their own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

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
        Rows of the bricks that are laid, of those on which they lie, and of taller or other ones between them.
    tile : (int, int) or None
        Row and column of the tile of a mosaic, from 0, if it shows one tile alone.
    box : ((int, int), (int, int)) or None
        Studs from which and to which it goes, if it does not show the whole.
    """

    title: str
    new: Ints
    below: Ints
    through: Ints
    tile: tuple[int, int] | None = None
    box: tuple[tuple[int, int], tuple[int, int]] | None = None


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
            masks = (mine & (low == level), mine & (high == level), mine & (low < level) & (high > level))
            new, below, through = (np.flatnonzero(each) for each in masks)
            found.append(Layer(name + _level(level - ground), new, below, through))
    return found


def by_tiles(layers: Sequence[Layer], tile: Ints) -> list[Layer]:
    """Divide layers of mosaics into their tiles, unless they have so few bricks that one map is enough.

    Parameters
    ----------
    layers : sequence of Layer
    tile : (n, 2) int64 array
        Of :func:`~legorize_addon.core.building.tile_places`.

    Returns
    -------
    list of Layer
        Bricks of the other tiles are among those between.
    """
    found = []
    for layer in layers:
        own = tile[layer.new]
        places: list[tuple[int, int]] = [(row, column) for row, column in np.unique(own, axis=0).tolist()]
        if len(layer.new) <= _FEW * len(places) or len(places) == 1:
            found.append(layer)
            continue
        for row, column in places:
            here = (own == (row, column)).all(axis=1)
            title = f"{layer.title}, tile {column + 1} of row {row + 1}"
            found.append(Layer(title, layer.new[here], layer.new[:0], layer.new[~here], (row, column)))
    return found


_FEW: Final = 4
"""Bricks to a tile up to which a layer is not divided: the large plates of a base."""


def _level(plates: int) -> str:
    layer, above = divmod(plates, PLATES_PER_BRICK)
    return f"Layer {layer + 1}" + (f", {above} plate{'s' * (above > 1)} up" if above else "")
