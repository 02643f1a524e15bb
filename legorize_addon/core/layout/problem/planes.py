"""Where shapes fit on sheets: what lies under a shape is found for all places at once.

The smallest and the greatest colour under a shape come from merging shifted
copies of the sheets, or of what was found for the smaller shapes inside it;
where they agree, with the free colour above and forbidden cells below all
others, the shape fits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Mask
from ...model import COLOUR_ANY, COLOUR_EMPTY
from .shapes import Index, Plane, Rows, Shapes
from .sheets import Sheets

_FREE: Final = np.iinfo(np.int16).max
"""Stands for a free colour where the smallest colour under a shape is looked for."""

Merged = tuple[Plane, Plane, Mask]
"""Least and greatest colour, and whether a required cell is there."""


@dataclass(frozen=True, slots=True, eq=False)
class Planes:
    """Sheets as flat, padded planes one after the other, so that a shift is a slice.

    Attributes
    ----------
    low : tuple of int
        First column and row, x and y: those that no shape reaches are left out.
    stride, extent : int
        Entries of a row and of a sheet; the padding is as wide as the longest shape.
    least, most : (n,) int16 arrays
        Column of the colour in ``Shapes.made``; free colours count as the
        greatest in `least` and as -1 in `most`, forbidden cells the other way.
    required : (n,) bool array
        Whether the cell has to be covered.
    number : (n,) intp array
        Number of the cell, of no meaning where it is forbidden.
    """

    low: tuple[int, int]
    stride: int
    extent: int
    least: Plane
    most: Plane
    required: Mask
    number: Index

    @classmethod
    def of(cls, sheets: Sheets, among: Shapes) -> Planes:
        """Cut out what shapes on required cells reach, and pad it on the far sides."""
        reach = int(among.extent.max()) - 1
        box = tuple(spread(sheets.required.any(axis=axes), reach) for axes in ((0, 2), (0, 1)))
        cut, padding = (slice(None), *box), ((0, 0), (0, reach + 1), (0, reach))
        number = np.cumsum(sheets.colour != COLOUR_EMPTY, dtype=np.intp).reshape(sheets.colour.shape) - 1
        colour = np.pad(sheets.colour[cut], padding, constant_values=COLOUR_EMPTY)
        empty, free = colour == COLOUR_EMPTY, colour == COLOUR_ANY
        column = np.searchsorted(among.codes, colour).astype(np.int16)
        return cls(
            low=(box[1].start, box[0].start),
            stride=colour.shape[2],
            extent=colour[0].size,
            least=np.where(empty, np.int16(-1), np.where(free, np.int16(_FREE), column)).reshape(-1),
            most=np.where(empty, np.int16(_FREE), np.where(free, np.int16(-1), column)).reshape(-1),
            required=np.pad(sheets.required[cut], padding).reshape(-1),
            number=np.pad(number[cut], padding).reshape(-1),
        )

    def fitting(self, among: Shapes) -> list[tuple[Index, Plane]]:
        """Return where each shape fits, and the column of the colour it takes there."""
        merged: list[Merged] = [(self.least, self.most, self.required)] * len(among.size)
        found = [(np.zeros(0, dtype=np.intp), self.most[:0])] * len(among.size)
        # what a shape is made of comes before it
        for row in np.argsort(among.size, kind="stable"):
            merged[row] = least, most, required = self._merged(row, merged, among)
            places = np.flatnonzero((least >= most) & required)
            # all colours under the shape agree: this is the one, or -1, the last column
            columns = most[places]
            made = among.made[row][columns]
            found[row] = places[made], columns[made]
        return found

    def _merged(self, row: int, merged: Sequence[Merged], among: Shapes) -> Merged:
        """Return least and greatest colour under a shape at each place, and whether a required cell is there."""
        pieces, cells = among.pieces[row], among.cells[row]
        parts = [(merged[inner], x + y * self.stride) for inner, x, y in pieces] or [
            ((self.least, self.most, self.required), x + y * self.stride) for x, y in cells
        ]
        length = len(self.least) - int(self.offsets(cells).max())
        least, most, required = (
            reduce(merge, (planes[kind][offset : offset + length] for planes, offset in parts))
            for kind, merge in enumerate((np.minimum, np.maximum, np.logical_or))
        )
        return least, most, required

    def offsets(self, covered: Rows) -> Index:
        """Return the cells of a shape as offsets in the flat planes, shape (k,)."""
        return covered[:, 0] + covered[:, 1] * np.intp(self.stride)

    def covered(self, shape: NDArray[np.uint8], place: Index, among: Shapes) -> Index:
        """List the numbers of the cells of each placement."""
        size = among.size
        offsets = self.offsets(np.concatenate(among.cells))
        first = np.cumsum(size) - size
        n_cells = size[shape]
        entry = np.arange(n_cells.sum()) + np.repeat(first[shape] - np.cumsum(n_cells) + n_cells, n_cells)
        number: Index = self.number[np.repeat(place, n_cells) + offsets[entry]]
        return number


def spread(marked: Mask, reach: int) -> slice:
    """Return the range of what is marked and of what lies near.

    Parameters
    ----------
    marked : (n,) bool array
    reach : int
        How far away is near.

    Returns
    -------
    slice
        Empty where nothing is marked.
    """
    where = np.flatnonzero(marked)
    return slice(max(where[0] - reach, 0), where[-1] + reach + 1) if len(where) else slice(0, 0)
