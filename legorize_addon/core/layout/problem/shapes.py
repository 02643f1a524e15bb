"""The parts in all their orientations, and the colours they are made in.

A *shape* is a part in one of its orientations: the 12 bricks give 24 shapes,
and so do the 12 plates.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats, Mask
from ...model import Catalogue, Part, Use, footprint

Plane = NDArray[np.int16]
Rows = NDArray[np.int32]
Index = NDArray[np.intp]
Whole = NDArray[np.integer[Any]]
"""Whole numbers of whatever type."""

Patterns = NDArray[Any]
"""Sets of cells as bits of whole numbers: uint64, or Python's where 64 bits are too few."""

_BITS: Final = 64
"""Cells that have a bit each in a uint64."""


@dataclass(frozen=True, slots=True, eq=False)
class Shapes:
    """The oriented parts of one height and the colours they are made in.

    Attributes
    ----------
    part : (n_shapes,) int16 array
        Row of the part in the catalogue.
    turn : (n_shapes,) uint8 array
        Quarter turns.
    cells : tuple of (k, 2) int32 arrays
        Cells (x, y) that each shape covers, from the corner of its bounding box.
    size : (n_shapes,) intp array
        Number of cells of each shape.
    extent : (n_shapes, 2) intp array
        Studs along x and y.
    inner : (2, n_cells_of_all_shapes) bool array
        For each of ``cells``, shape after shape: whether the next cell along x
        (row 0) and along y (row 1) belongs to the same shape.
    side : int
        Studs along the longest shape.
    pattern : (n_shapes,) uint64 or object array
        Cells of each shape as bits (see :func:`pattern_bits`).
    within : (n_most, 3, n_shapes) intp array
        The largest other shapes inside each shape: row, and where the corner
        lies, x and y; rows of -1 where a shape has fewer than others.
    pieces : tuple of (k, 3) intp arrays
        For each shape a few of these that cover it together: row, x and y.
        Empty where there are none.
    codes : (n_codes,) int16 array
        LDraw codes of the grid, ascending.
    made : (n_shapes, n_codes + 1) bool array
        Whether the part is made in each code; the last column, for bricks of
        any colour, tells whether it is made at all.
    hidden : (n_shapes,) int16 array
        LDraw code that the part gets where it is hidden.
    cost : (n_shapes, n_codes + 1) float64 array
        What the part costs in each code, in bricks; in the last column, where it is hidden.
    """

    part: NDArray[np.int16]
    turn: NDArray[np.uint8]
    cells: tuple[Rows, ...]
    size: Index
    extent: Index
    inner: Mask
    side: int
    pattern: Patterns
    within: Index
    pieces: tuple[Index, ...]
    codes: Plane
    made: Mask
    hidden: Plane
    cost: Floats

    def rows_of(self, part: Whole, turn: Whole) -> Index:
        """Return the rows of parts of this height in the given turns, shape (k,)."""
        known = self.part.astype(np.intp) * 4 + self.turn
        return np.searchsorted(known, part.astype(np.intp) * 4 + turn)


def shapes(catalogue: Catalogue, height: int, codes: Plane, filler: int, uses: tuple[Use, ...] = ("model",)) -> Shapes:
    """List the parts of one height in all their orientations.

    Parameters
    ----------
    catalogue : Catalogue
        Parts and colours.
    height : int
        Plates: 3 for bricks, 1 for plates.
    codes : int16 array
        LDraw codes that occur in the grid.
    filler : int
        LDraw code for hidden bricks; a part that is not made in it gets the first colour of the catalogue in which it
        is made. Where the catalogue says what parts cost, hidden ones get the cheapest colour.
    uses : tuple of {"model", "tiles", "plates", "base"}, optional
        What the parts are laid for.

    Returns
    -------
    Shapes
        In the order of the catalogue, then by quarter turn.
    """
    forms = _forms(catalogue.parts, height, uses)
    codes = np.unique(codes)
    made = np.column_stack([catalogue.exists_in(forms.part[:, None], codes), catalogue.exists[forms.part].any(axis=1)])
    cost = np.ones(catalogue.exists.shape) if catalogue.cost is None else catalogue.cost
    hidden = _hidden(cost[forms.part], catalogue.exists[forms.part], catalogue.codes == filler)
    column = np.append(np.searchsorted(catalogue.codes, codes), 0)
    column = np.minimum(np.tile(column, (len(forms.part), 1)), len(catalogue.colours) - 1)
    column[:, -1] = hidden
    return replace(
        forms, codes=codes, made=made, hidden=catalogue.codes[hidden], cost=cost[forms.part[:, None], column]
    )


def _hidden(cost: Floats, exists: Mask, filler: Mask) -> Index:
    """Return the column of the cheapest colour of each shape: the filler if none is cheaper, or else the first."""
    cost = np.where(exists, cost, np.inf)
    best = cost.argmin(axis=1)
    # argmax finds the only column that is the filler's, or the first if there is none
    usual = int(filler.argmax())
    as_usual = filler.any() & exists[:, usual] & (cost[:, usual] <= cost.min(axis=1))
    return np.where(as_usual, usual, best)


@lru_cache
def _forms(parts: tuple[Part, ...], height: int, uses: tuple[Use, ...]) -> Shapes:
    """Return the parts of one height and some uses in all their orientations, without any colour."""
    chosen = [row for row, part in enumerate(parts) if part.height == height and part.use in uses]
    oriented = [(row, turn) for row in chosen for turn in range(parts[row].turns)]
    cells = tuple(footprint(parts[row], turn) for row, turn in oriented)
    extent = np.array([covered.max(axis=0) + 1 for covered in cells], dtype=np.intp)
    side = int(extent.max())
    pattern = np.array([pattern_bits(covered[:, 0], covered[:, 1], side).sum() for covered in cells])
    within = _parts_within(extent, pattern, side)
    return Shapes(
        part=np.array([row for row, _ in oriented], dtype=np.int16),
        turn=np.array([turn for _, turn in oriented], dtype=np.uint8),
        cells=cells,
        size=np.array([len(covered) for covered in cells], dtype=np.intp),
        extent=extent,
        inner=np.concatenate([_inner_edges(covered) for covered in cells], axis=1),
        side=side,
        pattern=pattern,
        within=within,
        pieces=tuple(_pieces(within[:, :, row], pattern, whole, side) for row, whole in enumerate(pattern)),
        codes=np.zeros(0, dtype=np.int16),
        made=np.zeros((len(cells), 1), dtype=bool),
        hidden=np.zeros(len(cells), dtype=np.int16),
        cost=np.ones((len(cells), 1)),
    )


def _inner_edges(covered: Rows) -> Mask:
    """Return for each cell of a shape whether its next cells along x and y belong to it, shape (2, k)."""
    filled = np.zeros(covered.max(axis=0) + 2, dtype=bool)
    x, y = covered.T
    filled[x, y] = True
    return np.stack([filled[x + 1, y], filled[x, y + 1]])


def pattern_bits(x: Whole, y: Whole, side: int) -> Patterns:
    """Give every cell of a square field a bit of its own, so that a set of cells becomes one number.

    Parameters
    ----------
    x, y : integer arrays
        Cells, counted from the corner of the set's bounding box, below `side`.
    side : int
        Cells along each side of the field, as many as the longest part has studs.

    Returns
    -------
    uint64 or object array
        One bit each; whole numbers of Python where the field has more than 64 cells.
    """
    kind = np.uint64 if side * side <= _BITS else np.object_
    bits: Patterns = np.left_shift(np.ones(1, dtype=kind), (x + side * y).astype(kind))
    return bits


def _parts_within(extent: Index, pattern: Patterns, side: int) -> Index:
    """List the largest other shapes inside each shape (see ``Shapes.within``)."""
    shape, x, y = (each.ravel() for each in np.indices((len(extent), side, side)))
    fits = (extent[shape] + np.stack([x, y], axis=1) <= side).all(axis=1)
    shape, x, y = shape[fits], x[fits], y[fits]
    # a set of cells moves with its first cell
    moved = pattern[shape] * pattern_bits(x, y, side)
    largest = [_largest(moved, outer) for outer in pattern]
    table = np.full((max(map(len, largest)), 3, len(largest)), -1, dtype=np.intp)
    for row, each in enumerate(largest):
        table[: len(each), :, row] = np.stack([shape[each], x[each], y[each]], axis=1)
    return table


def _largest(patterns: Patterns, outer: Any) -> Index:
    """Return the patterns truly inside another one and inside no other such."""
    within = np.flatnonzero(((patterns & ~outer) == 0) & (patterns != outer))
    inner = patterns[within]
    covered = ((inner[:, None] & ~inner) == 0) & (inner[:, None] != inner)
    largest: Index = within[~covered.any(axis=1)]
    return largest


def _pieces(inner: Index, pattern: Patterns, whole: Any, side: int) -> Index:
    """Return rows of `inner` that cover a shape together, none if all of them do not."""
    taken, covered = [], whole ^ whole
    for row, x, y in inner[inner[:, 0] >= 0]:
        moved = pattern[row] * pattern_bits(x, y, side)[0]
        if moved & ~covered:
            taken.append((row, x, y))
            covered |= moved
    return np.array(taken if covered == whole else [], dtype=np.intp).reshape(-1, 3)
