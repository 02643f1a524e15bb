"""The placements that can still be laid, while a sheet fills up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ...arrays import Mask
from .placements import Placements, segment_sums
from .shapes import Index

Amounts = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Candidates:
    """Some of the placements on some sheets.

    Attributes
    ----------
    rows : (n,) intp array
        Rows of the placements, ascending.
    size : (n,) intp array
        Number of cells of each.
    cells : (n_entries,) intp array
        The numbers of their cells, placement after placement.
    """

    rows: Index
    size: Index
    cells: Index

    @classmethod
    def of(cls, found: Placements) -> Candidates:
        """Return all placements."""
        return cls(np.arange(len(found)), found.size, found.cells)

    def totals(self, amounts: Amounts | Mask) -> Amounts:
        """Sum the amounts of the entries of each placement."""
        return segment_sums(amounts, np.cumsum(self.size))

    def winners(self, key: Amounts, n_cells: int) -> Mask:
        """Return which placements have the greatest key on each of their cells."""
        keys = np.repeat(key, self.size)
        greatest = np.full(n_cells, np.iinfo(np.int64).min)
        np.maximum.at(greatest, self.cells, keys)
        return np.equal(self.totals(keys == greatest[self.cells]), self.size)

    def only(self, kept: Mask) -> Candidates:
        """Drop the other placements."""
        return Candidates(self.rows[kept], self.size[kept], self.cells[np.repeat(kept, self.size)])

    def clear_of(self, covered: Mask) -> Candidates:
        """Drop the placements that lie on a covered cell."""
        return self.only(self.totals(covered[self.cells]) == 0)

    def within(self, inside: Mask) -> Candidates:
        """Leave out the cells outside, and the placements that have no others."""
        kept = inside[self.cells]
        size = self.totals(kept)
        return Candidates(self.rows[size > 0], size[size > 0], self.cells[kept])

    def groups(self, n_cells: int) -> Index:
        """Return the number of the set of placements that each hangs together with by shared cells, shape (n,)."""
        n = len(self.rows)
        of = np.repeat(np.arange(n), self.size)
        graph = coo_array((np.ones(len(of), dtype=bool), (of, n + self.cells)), shape=(n + n_cells, n + n_cells))
        group: Index = connected_components(graph, directed=False)[1][:n].astype(np.intp)
        return group
