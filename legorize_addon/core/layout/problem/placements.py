"""The placements of parts on a sheet.

A *placement* is a shape at a place of a sheet where it covers no forbidden cell,
no two colours, at least one cell that must be covered, and is made in the
colour it gets.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Mask
from ...model import COLOUR_ANY
from .planes import Planes
from .shapes import Index, Plane, Rows, Shapes, Whole
from .sheets import Sheets

_ENTRIES: Final = 1 << 16
"""Entries of padded sheets that are processed at once: they fit into the processor's cache."""

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
        return self.start[1:] - self.start[:-1]

    def entries(self, rows: Index) -> Index:
        """Return where in ``cells`` the cells of the given placements stand, one after the other."""
        size = self.start[rows + 1] - self.start[rows]
        offset = self.start[rows] - np.cumsum(size) + size
        entries: Index = np.arange(size.sum()) + np.repeat(offset, size)
        return entries

    def in_shapes(self, among: Shapes) -> Index:
        """Return which of the cells of all shapes, one shape after the other, each entry of ``cells`` is."""
        first = np.cumsum(among.size) - among.size
        where: Index = np.arange(len(self.cells)) + np.repeat(first[self.shape] - self.start[:-1], self.size)
        return where

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
        first, end = np.searchsorted(self.key, np.stack([which, which + 1]) << _SHEET_BITS)
        of_sheets = [slice(*each) for each in zip(first, end, strict=True)]
        shape, corner, colour, size, key = (
            np.concatenate([array[part] for part in of_sheets])
            for array in (self.shape, self.corner, self.colour, self.size, self.key)
        )
        fewer = np.arange(len(which)) - which
        corner[:, 2] += np.repeat(fewer, end - first).astype(np.int32)
        # the cells of the sheets left out no longer count
        kept, before = n_cells[which], np.cumsum(n_cells) - n_cells
        gone = before[which] - (np.cumsum(kept) - kept)
        entries = zip(self.start[first], self.start[end], gone, strict=True)
        cells = np.concatenate([self.cells[low:high] - less for low, high, less in entries])
        key += np.repeat(fewer.astype(np.int64) << _SHEET_BITS, end - first)
        return Placements(shape, corner, colour, cells, np.append(0, np.cumsum(size)), key)

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
    """Sum whole numbers over segments that follow one another; faster than ``np.add.reduceat``.

    Parameters
    ----------
    values : (n,) integer or bool array
        What to sum.
    end : (n_segments,) intp array
        Where each segment ends; the first one starts at 0, and none is empty.

    Returns
    -------
    (n_segments,) int64 array
        The sums.
    """
    sums: NDArray[np.int64] = np.cumsum(values, dtype=np.int64)[end - 1]
    sums[1:] -= sums[:-1].copy()
    return sums


def _key(shape: Whole, corner: Whole) -> NDArray[np.int64]:
    """Pack sheet, shape, y and x into numbers that ascend in the order in which placements are listed."""
    x, y, sheet = corner.astype(np.int64).T
    key: NDArray[np.int64] = (sheet << _SHEET_BITS) | (shape.astype(np.int64) << 32) | (y << 16) | x
    return key


def placements(sheets: Sheets, among: Shapes) -> Placements:
    """Enumerate everything that may be laid on some sheets.

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
    at_once = max(_ENTRIES // max(sheets.colour[0].size, 1), 1)
    firsts = range(0, len(sheets), at_once)
    before = np.append(0, np.cumsum(sheets.n_cells))
    parts = [_listed(sheets.take(slice(first, first + at_once)), among, first, before[first]) for first in firsts]
    shape, corner, code, cells = (np.concatenate(each) for each in zip(*parts, strict=True))
    return Placements(shape, corner, code, cells, np.append(0, np.cumsum(among.size[shape])), _key(shape, corner))


def _listed(
    sheets: Sheets, among: Shapes, first_sheet: int, first_cell: int
) -> tuple[NDArray[np.uint8], Rows, Plane, Index]:
    """Return shape, corner, colour and cells of the placements on some sheets, given how many lie before them."""
    planes = Planes.of(sheets, among)
    found = planes.fitting(among)
    shape = np.repeat(np.arange(len(found), dtype=np.uint8), [len(places) for places, _ in found])
    place = np.concatenate([places for places, _ in found])
    column = np.concatenate([columns for _, columns in found])
    # sixteen bits: numpy then sorts by radix, in linear time
    order = np.argsort((place // planes.extent).astype(np.uint16), kind="stable")
    shape, place, column = shape[order], place[order], column[order]
    code = np.where(column < 0, among.hidden[shape], np.append(among.codes, np.int16(COLOUR_ANY))[column])
    # the padding lies on the far sides, so places count from the corner of the sheet
    sheet, within = np.divmod(place, planes.extent)
    y, x = np.divmod(within, planes.stride)
    low_x, low_y = planes.low
    corner = np.stack([x + low_x, y + low_y, sheet + first_sheet], axis=1).astype(np.int32)
    return shape, corner, code, planes.covered(shape, place, among) + first_cell
