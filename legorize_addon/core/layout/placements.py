"""Which parts may lie where.

A *placement* is a shape at a place of a sheet where it covers no forbidden cell,
no two colours, at least one cell that must be covered, and is made in the
colour it gets.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..model import COLOUR_ANY, COLOUR_EMPTY, Mask
from .shapes import Index, Plane, Rows, Shapes, Whole
from .sheets import Sheets

Merge = Callable[[Plane, Plane], Plane]

_FREE: Final = np.iinfo(np.int16).max
"""Stands for a free colour where the smallest colour under a shape is looked for."""

_SHEET_BITS: Final = 40
"""Bits below the number of the sheet in the keys: 8 of the shape, 16 each of y and x."""


@dataclass(frozen=True, slots=True, eq=False)
class Placements:
    """All placements on some sheets: sheet after sheet, in it shape after shape, then by y and x.

    Attributes
    ----------
    shape : (n,) uint8 array
        Row of the shape.
    corner : (n, 3) int32 array
        Lowest x and y of the bounding box, and number of the sheet.
    colour : (n,) int16 array
        LDraw code of the brick.
    cells : (n_entries,) intp array
        Numbers of the covered cells (see ``Sheets``), placement after
        placement, each in the order of ``Shapes.cells``.
    start : (n + 1,) intp array
        First entry of each placement in ``cells``, and the end of the last one.
    key : (n,) int64 array
        Shape and corner as one number, ascending.
    """

    shape: NDArray[np.uint8]
    corner: Rows
    colour: Plane
    cells: Index
    start: Index
    key: NDArray[np.int64]

    def __len__(self) -> int:
        """Return the number of placements."""
        return len(self.shape)

    @property
    def size(self) -> Index:
        """Number of cells of each placement, shape (n,)."""
        return np.diff(self.start)

    def entries(self, rows: Index) -> Index:
        """Return where in ``cells`` the cells of the given placements stand, one after the other."""
        size = self.start[rows + 1] - self.start[rows]
        offset = self.start[rows] - np.cumsum(size) + size
        entries: Index = np.arange(size.sum()) + np.repeat(offset, size)
        return entries

    def totals(self, amounts: Whole | Mask) -> NDArray[np.int64]:
        """Sum amounts given for each cell over the cells of each placement, shape (n,)."""
        return segment_sums(amounts[self.cells], self.start[1:])

    def through(self, marked: Mask) -> Index:
        """Return the rows of the placements that cover a marked cell, ascending."""
        rows = np.searchsorted(self.start, np.flatnonzero(marked[self.cells]), side="right") - 1
        return rows[np.diff(rows, prepend=-1) > 0]

    def take(self, rows: Index) -> Placements:
        """Return the placements of the given rows, ascending."""
        return Placements(
            shape=self.shape[rows],
            corner=self.corner[rows],
            colour=self.colour[rows],
            cells=self.cells[self.entries(rows)],
            start=np.append(0, np.cumsum(self.size[rows])),
            key=self.key[rows],
        )

    def on(self, which: Index, n_cells: Index) -> Placements:
        """Return the placements on some of the sheets, whose cells are numbered anew.

        Parameters
        ----------
        which : (k,) intp array
            Numbers of the sheets, ascending.
        n_cells : (n_sheets,) intp array
            Number of cells of each sheet.

        Returns
        -------
        Placements
            As if listed for these sheets alone.
        """
        number = np.full(len(n_cells), -1, dtype=np.int64)
        number[which] = np.arange(len(which))
        part = self.take(np.flatnonzero(number[self.corner[:, 2]] >= 0))
        sheet = part.corner[:, 2]
        gone = np.cumsum(np.where(number < 0, n_cells, 0))[sheet]
        corner = np.column_stack([part.corner[:, :2], number[sheet]]).astype(np.int32)
        key = part.key + ((number[sheet] - sheet) << _SHEET_BITS)
        return Placements(part.shape, corner, part.colour, part.cells - np.repeat(gone, part.size), part.start, key)

    def find(self, shape: Whole, corner: Whole) -> Index:
        """Look placements up.

        Parameters
        ----------
        shape : (k,) integer array
            Rows of shapes.
        corner : (k, 3) integer array
            As in ``corner``.

        Returns
        -------
        (k,) intp array
            Row of each placement, -1 where there is none.
        """
        wanted = _key(shape, corner)
        row = np.minimum(np.searchsorted(self.key, wanted), len(self.key) - 1)
        rows: Index = np.where(self.key[row] == wanted, row, -1)
        return rows


def segment_sums(values: Whole | Mask, end: Index) -> NDArray[np.int64]:
    """Sum whole numbers over segments that follow one another; twice as fast as ``np.add.reduceat``.

    Parameters
    ----------
    values : (n,) integer or bool array
        What to sum.
    end : (n_segments,) intp array
        Where each segment ends; the first one starts at 0.

    Returns
    -------
    (n_segments,) int64 array
        The sums.
    """
    return np.diff(np.append(0, np.cumsum(values, dtype=np.int64))[end], prepend=0)


def _key(shape: Whole, corner: Whole) -> NDArray[np.int64]:
    """Pack sheet, shape, y and x into numbers that ascend in the order in which placements are listed."""
    x, y, sheet = corner.astype(np.int64).T
    key: NDArray[np.int64] = (sheet << _SHEET_BITS) | (shape.astype(np.int64) << 32) | (y << 16) | x
    return key


def placements(sheets: Sheets, among: Shapes) -> Placements:
    """Enumerate everything that may be laid on some sheets.

    The smallest and the greatest colour under a shape are found for all places
    at once, by merging shifted copies of the sheets; where they agree, with the
    free colour above and forbidden cells below all others, the shape fits.

    Parameters
    ----------
    sheets : Sheets
        Where to lay. Many sheets at once cost little more than one.
    among : Shapes
        What to lay; ``codes`` must hold every colour of the sheets.

    Returns
    -------
    Placements
        On all of the sheets.
    """
    planes = _Planes.of(sheets, among)
    found = [planes.fitting(shape, among.made[row]) for row, shape in enumerate(among.cells)]
    shape = np.repeat(np.arange(len(found), dtype=np.uint8), [len(places) for places, _ in found])
    place = np.concatenate([places for places, _ in found])
    colour = np.concatenate([colours for _, colours in found])
    # sixteen bits: numpy then sorts by radix, in linear time
    order = np.argsort((place // planes.extent).astype(np.uint16), kind="stable")
    shape, place, colour = shape[order], place[order], colour[order]
    code = np.where(colour < 0, among.hidden[shape], np.append(among.codes, np.int16(COLOUR_ANY))[colour])
    cells, start = planes.covered(shape, place, among)
    # the padding lies on the far sides, so places count from the corner of the sheet
    sheet, within = np.divmod(place, planes.extent)
    y, x = np.divmod(within, planes.stride)
    corner = np.stack([x, y, sheet], axis=1).astype(np.int32)
    return Placements(shape, corner, code, cells, start, _key(shape, corner))


@dataclass(frozen=True, slots=True, eq=False)
class _Planes:
    """Sheets as flat, padded planes one after the other, so that a shift is a slice.

    Attributes
    ----------
    stride, extent : int
        Entries of a row and of a sheet; the padding is as wide as the longest shape.
    least, most : (n,) int16 arrays
        Column of the colour in ``Shapes.made``; free colours count as the
        greatest in `least` and as -1 in `most`, forbidden cells the other way.
    must : (n,) int16 array
        1 where the cell has to be covered.
    number : (n,) intp array
        Number of the cell, of no meaning where it is forbidden.
    """

    stride: int
    extent: int
    least: Plane
    most: Plane
    must: Plane
    number: Index

    @classmethod
    def of(cls, sheets: Sheets, among: Shapes) -> _Planes:
        """Pad the sheets on the far sides."""
        reach = int(among.extent.max()) - 1
        padding = ((0, 0), (0, reach + 1), (0, reach))
        colour = np.pad(sheets.colour, padding, constant_values=COLOUR_EMPTY)
        must = np.pad(sheets.must, padding).astype(np.int16)
        empty, free = colour == COLOUR_EMPTY, colour == COLOUR_ANY
        column = np.searchsorted(among.codes, colour).astype(np.int16)
        return cls(
            stride=colour.shape[2],
            extent=colour[0].size,
            least=np.where(empty, np.int16(-1), np.where(free, np.int16(_FREE), column)).reshape(-1),
            most=np.where(empty, np.int16(_FREE), np.where(free, np.int16(-1), column)).reshape(-1),
            must=must.reshape(-1),
            number=np.cumsum(~empty, dtype=np.intp) - 1,
        )

    def offsets(self, covered: Rows) -> Index:
        """Return the cells of a shape as offsets in the flat planes, shape (k,)."""
        return covered[:, 0] + covered[:, 1] * np.intp(self.stride)

    def fitting(self, covered: Rows, made: Mask) -> tuple[Index, Plane]:
        """Return where a shape fits, and the column of the colour it takes there."""
        offsets = self.offsets(covered)
        length = len(self.least) - int(offsets.max())
        least, most, must = (
            reduce(merge, (plane[offset : offset + length] for offset in offsets))
            for plane, merge in ((self.least, np.minimum), (self.most, np.maximum), (self.must, np.maximum))
        )
        places = np.flatnonzero((least >= most) & (must > 0))
        # all colours under the shape agree: this is the one, or -1, the last column
        colours = most[places]
        exists = made[colours]
        return places[exists], colours[exists]

    def covered(self, shape: NDArray[np.uint8], place: Index, among: Shapes) -> tuple[Index, Index]:
        """List the numbers of the cells of each placement, and where each one's list starts."""
        size = among.size
        start = np.append(0, np.cumsum(size[shape]))
        offsets = self.offsets(np.concatenate(among.cells))
        first = np.cumsum(size) - size
        entry = np.arange(start[-1]) + np.repeat(first[shape] - start[:-1], size[shape])
        return self.number[np.repeat(place, size[shape]) + offsets[entry]], start
