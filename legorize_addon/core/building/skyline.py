"""How high each table is built up, stud square by stud square: what comes from above must come over it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np

from ..arrays import Ints
from ..model import Bricks, Catalogue, Rows, column_facts, stud_columns

_NOTHING: Final = np.iinfo(np.int32).min


class Skyline:
    """The height of what stands on each table."""

    def __init__(self, bricks: Bricks, catalogue: Catalogue, n_tables: int) -> None:
        """Begin with empty tables.

        Parameters
        ----------
        bricks : Bricks
            All that will stand on one of them.
        catalogue : Catalogue
        n_tables : int
        """
        brick, columns = stud_columns(bricks, catalogue)
        squares = columns[:, :2].astype(np.int64)
        facts = column_facts(bricks, catalogue)
        top = columns[:, 2] + facts.high - facts.low
        bottom = columns[:, 2]
        if bricks.halved:
            # half a stud further on, what comes from above must come over halves of squares
            squares, brick, bottom, top = (
                _quarters(squares, bricks, brick),
                *(np.repeat(each, 4) for each in (brick, bottom, top)),
            )
        low, high = (squares.min(axis=0), squares.max(axis=0)) if len(squares) else (np.zeros(2), np.zeros(2))
        wide = int(high[0] - low[0]) + 1
        self._n = wide * (int(high[1] - low[1]) + 1)
        flat = (squares[:, 0] - low[0]) + wide * (squares[:, 1] - low[1])
        ends = np.searchsorted(brick, np.arange(1, len(bricks)))
        self._squares = np.split(flat.astype(np.int64), ends)
        self._bottom, self._top = np.split(bottom, ends), np.split(top, ends)
        self._tops: list[np.ndarray | None] = [None] * n_tables

    def covers(self, brick: int, table: int) -> bool:
        """Whether something on a table lies over the place of a brick."""
        tops = self._tops[table]
        return tops is not None and bool((tops[self._squares[brick]] > self._bottom[brick]).any())

    def add(self, brick: int, table: int) -> None:
        """Put a brick onto a table."""
        tops = self._tops[table]
        if tops is None:
            tops = self._tops[table] = np.full(self._n, _NOTHING, dtype=np.int32)
        squares = self._squares[brick]
        tops[squares] = np.maximum(tops[squares], self._top[brick])

    def renew(self, table: int, bricks: Iterable[int]) -> None:
        """Let a table have some bricks alone."""
        self._tops[table] = None
        for brick in bricks:
            self.add(int(brick), table)


def _quarters(squares: Ints, bricks: Bricks, brick: Rows) -> Ints:
    """Return the quarters of stud squares, four each, of bricks that may lie half a stud beyond their corners."""
    moved = 2 * (squares + bricks.shift[brick, :2])
    quarters: Ints = (moved[:, None] + np.array([(0, 0), (1, 0), (0, 1), (1, 1)])).astype(np.int64).reshape(-1, 2)
    return quarters
