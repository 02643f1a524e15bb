"""The filling simulation: a window is filled to its end behind each brick that could be laid next.

The free cells of a window are the bits of one number. So a placement is a number,
and so is what is covered; the windows of a layer are filled all at once, behind
all of their candidates, brick after brick, always by the first one in their order
that still fits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats, Mask
from ..problem import Index
from .layer import LONELY, Layer

Bits = NDArray[np.uint64]

MOST_CELLS: Final = 63
"""Cells of a window: one bit of the number is left, so that what fills up a table never fits."""

CANDIDATES: Final = 16
"""Bricks that are tried for a cell: the first ones in the window's order."""

NONE: Final = -1
ALL: Final = np.uint64(0xFFFF_FFFF_FFFF_FFFF)
NO_BIT: Final = np.uint64(0)
BITS: Final = np.left_shift(np.uint64(1), np.arange(MOST_CELLS, dtype=np.uint64))


@dataclass(frozen=True, slots=True, eq=False)
class Windows:
    """Free cells of a layer in groups, and what may be laid on each.

    Attributes
    ----------
    rows : (n_windows, n_most) intp array
        Rows of the placements inside, in the order in which simulations lay them; filled up with the number of
        placements of the layer.
    bits : (n_windows, n_most) uint64 array
        Their cells; all bits where there is none.
    inside : (n_windows, n_most, 63) float32 array
        The same, 1 for each cell.
    free : (n_windows,) uint64 array
        Bits that stand for a cell.
    needed : (n_windows,) uint64 array
        Bits of cells that have to be covered.
    diagonal : (n_windows, 63) uint64 array
        For each bit, those of the cells across its corners.
    """

    rows: Index
    bits: Bits
    inside: NDArray[np.float32]
    free: Bits
    needed: Bits
    diagonal: Bits

    def __len__(self) -> int:
        """Return the number of windows."""
        return len(self.rows)

    def covered(self, columns: Index) -> Bits:
        """Return the bits that placements cover, given by columns, (n_windows, ...), -1 for none."""
        return np.where(columns < 0, NO_BIT, _entries(self.bits, columns))

    def rows_of(self, columns: Index, nobody: int) -> Index:
        """Return the rows of placements, given by columns, (n_windows, ...), or a number where the column is -1."""
        return np.where(columns < 0, nobody, _entries(self.rows, columns))

    def candidates(self, covered: Bits) -> Index:
        """Find what may be laid on the cell of each window that has the fewest ways left.

        Parameters
        ----------
        covered : (n_windows,) uint64 array
            Bits that are covered, and those that stand for no cell.

        Returns
        -------
        (n_windows, n_candidates) intp array
            Columns of ``rows``, -1 where there are fewer; all -1 where nothing is left to cover.
        """
        fits = (self.bits & covered[:, None]) == 0
        left = np.matmul(fits[:, None].astype(np.float32), self.inside)[:, 0]
        open_ = ((self.needed & ~covered)[:, None] & BITS) != 0
        bit = np.where(open_ & (left > 0), left, np.inf).argmin(axis=1)
        ways = fits & ((self.bits & BITS[bit][:, None]) != 0) & open_.any(axis=1)[:, None]
        number = np.cumsum(ways, axis=1)
        found = np.full((len(self), CANDIDATES), NONE, dtype=np.intp)
        window, column = np.nonzero(ways & (number <= CANDIDATES))
        found[window, number[window, column] - 1] = column
        return found


def _entries(table: NDArray[np.generic], columns: Index) -> NDArray[np.generic]:
    """Look up columns of a table, row by row; whatever where the column is -1."""
    flat = np.maximum(columns, 0).reshape(len(columns), -1)
    return np.take_along_axis(table, flat, axis=1).reshape(columns.shape)


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """What windows have when they are filled.

    Attributes
    ----------
    energies : (n_windows, n_layouts, 4) float64 array
        Sums over the bricks of unit connection, stability, symmetry and efficiency.
    cost : (n_windows, n_layouts) float64 array
        What the bricks cost.
    """

    energies: Floats
    cost: Floats


def simulate(layer: Layer, windows: Windows, laid: Mask, before: Index, candidates: Index) -> Outcome:
    """Fill each window behind each of its candidates, and measure the whole window.

    Parameters
    ----------
    layer : Layer
    windows : Windows
    laid : (n,) bool array
        Placements that lie in the layer.
    before : (n_windows, n_before) intp array
        Columns of what is decided already, -1 where there is less.
    candidates : (n_windows, n_candidates) intp array
        Columns, as :meth:`Windows.candidates`.

    Returns
    -------
    Outcome
        Of a layout for each candidate.
    """
    start = np.bitwise_or.reduce(windows.covered(before), axis=1) | ~windows.free
    covered = np.where(candidates < 0, ALL, start[:, None] | windows.covered(candidates))
    width = candidates.shape[1]
    steps = [np.repeat(each[:, None], width, axis=1) for each in before.T] + [candidates]
    while True:
        fits = (windows.bits[:, None, :] & covered[:, :, None]) == 0
        pick = fits.argmax(axis=2)
        pick = np.where(np.take_along_axis(fits, pick[:, :, None], axis=2)[:, :, 0], pick, NONE)
        if (pick < 0).all():
            return measured(layer, windows, laid, np.stack(steps, axis=2))
        covered |= windows.covered(pick)
        steps.append(pick)


def measured(layer: Layer, windows: Windows, laid: Mask, columns: Index) -> Outcome:
    """Measure layouts of windows.

    Parameters
    ----------
    layer, windows, laid
        As for :func:`simulate`.
    columns : (n_windows, n_layouts, n_bricks) intp array
        -1 where a layout has fewer bricks.

    Returns
    -------
    Outcome
    """
    rows = windows.rows_of(columns, len(layer.cost))
    terms = np.zeros((len(layer.cost) + 1, 3))
    terms[:-1] = np.stack([layer.unstable, layer.small, layer.cost], axis=1)
    stability, efficiency, cost = np.moveaxis(terms[rows].sum(axis=2), 2, 0)
    lonely = _lonely(layer, rows, laid)
    energies = np.stack([_paired(layer, windows, rows, columns), stability, lonely, efficiency], axis=2)
    return Outcome(energies, cost + LONELY * lonely)


def _paired(layer: Layer, windows: Windows, rows: Index, columns: Index) -> Floats:
    """Count the 1 x 1 bricks with another one across a corner."""
    single = np.append(layer.single, False)[rows]
    found = np.zeros(rows.shape[:2])
    window, layout, brick = np.nonzero(single)
    if len(window):
        bits = np.where(single, windows.covered(columns), NO_BIT)
        every = bits.sum(axis=2, dtype=np.uint64)[window, layout]
        bit = np.searchsorted(BITS, bits[window, layout, brick])
        np.add.at(found, (window, layout), (windows.diagonal[window, bit] & every) != 0)
    return found


def _lonely(layer: Layer, rows: Index, laid: Mask) -> Floats:
    """Count the bricks without a mirror image, about the better axis."""
    nobody = len(layer.cost)
    elsewhere = np.append(laid, False)
    counts = []
    for images in layer.mirror:
        image = np.append(images, nobody)[rows]
        same = (image[..., :, None] == rows[..., None, :]).any(axis=3) & (image < nobody)
        counts.append(((rows < nobody) & ~same & ~elsewhere[image]).sum(axis=2))
    lonely: Floats = np.minimum(*counts).astype(np.float64)
    return lonely
