"""Windows of a layer: bricks that lie together are taken up, so that their cells can be filled anew."""

from __future__ import annotations

from typing import Final

import numpy as np

from ...arrays import Mask
from ..problem import Index
from .layer import Layer
from .simulation import ALL, BITS, MOST_CELLS, NO_BIT, Bits, Windows

_OUTSIDE: Final = MOST_CELLS + 1
_VALUES: Final = np.append(BITS, [NO_BIT, NO_BIT])
"""What the places of cells are worth: a bit each, then nothing for what fills up a table, and for cells outside."""

_REACH: Final = 3
"""Studs beyond the farthest brick of a window within which free cells belong to it."""


class Lists:
    """Looks up what may be laid inside groups of cells of a layer."""

    def __init__(self, layer: Layer) -> None:
        """Sort the placements by their first cell."""
        found = layer.problem.placements
        first = found.cells[found.start[:-1]]
        self._layer = layer
        self._order = np.argsort(first, kind="stable")
        self._start = np.searchsorted(first[self._order], np.arange(len(layer.colour) + 1))

    def windows(self, cells: Index, turn: int) -> Windows:
        """List what may be laid on groups of cells.

        Parameters
        ----------
        cells : (n_windows, 63) intp array
            Numbers of the cells of each group, ascending, filled up with the number of cells of the layer.
        turn : int
            Which of the orders of the layer the simulations follow, in turn.

        Returns
        -------
        Windows
        """
        layer = self._layer
        n_cells, n = len(layer.colour), len(layer.cost)
        window, row, place = self._inside(cells)
        order = np.lexsort((layer.ranks[turn % len(layer.ranks), row], window))
        window, row, place = window[order], row[order], place[order]
        count = np.bincount(window, minlength=len(cells))
        column = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        rows = np.full((len(cells), count.max(initial=1)), n, dtype=np.intp)
        bits, inside = np.full(rows.shape, ALL), np.zeros((*rows.shape, len(_VALUES)), dtype=np.float32)
        rows[window, column] = row
        bits[window, column] = _VALUES[place].sum(axis=1)
        inside[window[:, None], column[:, None], place] = 1
        there, known = cells < n_cells, np.minimum(cells, n_cells - 1)
        return Windows(
            rows=rows,
            bits=bits,
            inside=np.ascontiguousarray(inside[..., :MOST_CELLS]),
            free=_bits(there),
            needed=_bits(there & layer.problem.required[known]),
            diagonal=_diagonals(layer.problem.corner[known, :2], there),
        )

    def _inside(self, cells: Index) -> tuple[Index, Index, Index]:
        """Return the window, the row and the places of the cells of every placement inside a window."""
        layer = self._layer
        n_cells = len(layer.colour)
        window, bit = np.nonzero(cells < n_cells)
        cell = cells[window, bit]
        place = np.full((len(cells), n_cells + 1), _OUTSIDE, dtype=np.uint8)
        place[window, cell] = bit
        place[:, n_cells] = MOST_CELLS
        begin, end = self._start[cell], self._start[cell + 1]
        count = end - begin
        offset = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        of, row = np.repeat(window, count), self._order[np.repeat(begin, count) + offset]
        where = place[of[:, None], layer.cells[row]]
        fits = where.max(axis=1) < _OUTSIDE
        return of[fits], row[fits], where[fits].astype(np.intp)


def _bits(marked: Mask) -> Bits:
    total: Bits = np.where(marked, BITS, NO_BIT).sum(axis=-1, dtype=np.uint64)
    return total


def _diagonals(corner: Index, inside: Mask) -> Bits:
    """Return the bits across the corners of each bit's cell."""
    apart = np.abs(corner[:, :, None] - corner[:, None])
    return _bits((apart == 1).all(axis=3) & inside[:, :, None] & inside[:, None])


def grouped(layer: Layer, chosen: Index, order: Index) -> tuple[Index, Index]:
    """Group bricks of the same polygon that lie together, with the free cells around them.

    Parameters
    ----------
    layer : Layer
    chosen : (n_bricks,) intp array
        Rows of the placements that lie there.
    order : (n_bricks,) intp array
        In which order bricks begin a group.

    Returns
    -------
    cells : (n_windows, 63) intp array
        As :meth:`Lists.windows` takes them.
    window : (n_bricks,) intp array
        Of each brick.
    """
    problem, found = layer.problem, layer.problem.placements
    n_cells, size, polygon = len(problem.required), found.size[chosen], layer.polygon[layer.home[chosen]]
    # in half studs
    middle = 2 * found.corner[chosen, :2] + problem.shapes.extent[found.shape[chosen]]
    site = 2 * problem.corner[:, :2] + 1
    free = problem.owner(chosen) < 0
    window = np.full(len(chosen), -1, dtype=np.intp)
    groups: list[Index] = []
    for brick in order:
        if window[brick] >= 0:
            continue
        far = np.abs(middle - middle[brick]).max(axis=1)
        near = np.flatnonzero((window < 0) & (polygon == polygon[brick]))
        near = near[np.lexsort((near, far[near]))][:MOST_CELLS]
        near = near[np.cumsum(size[near]) <= MOST_CELLS]
        window[near] = len(groups)
        taken = found.cells[found.entries(chosen[near])]
        away = np.abs(site - middle[brick]).max(axis=1)
        gaps = np.flatnonzero(free & layer.may_join(layer.home[chosen[brick]]) & (away <= far[near[-1]] + 2 * _REACH))
        gaps = gaps[np.lexsort((gaps, away[gaps]))][: MOST_CELLS - len(taken)]
        free[gaps] = False
        rest = np.full(MOST_CELLS - len(taken) - len(gaps), n_cells)
        groups.append(np.sort(np.concatenate([taken, gaps, rest])))
    return np.array(groups, dtype=np.intp).reshape(-1, MOST_CELLS), window
