"""Whether bricks that are taken along together would fall over, set on a table by themselves."""

from __future__ import annotations

from collections.abc import Sequence

from ..arrays import Ints
from ..model import Bricks, Catalogue, middles
from .items import SMALL


class Leaning:
    """Asks of some bricks, before anything is planned, whether they lean.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, n rows.
    catalogue : Catalogue
    box : (n, 4) int64 array
        Their outlines, see :func:`.mirror.boxes`.
    """

    def __init__(self, bricks: Bricks, catalogue: Catalogue, box: Ints) -> None:
        self.level, self.mass = bricks.corner[:, 2], catalogue.mass[bricks.part]
        self.low, self.high = box[:, ::2], box[:, 1::2] + 1
        self.moment = middles(bricks, catalogue)[:, :2] * self.mass[:, None]

    def __call__(self, first: Ints, nodes: Sequence[int]) -> bool:
        """Tell whether the weight of some bricks is not above the outline of their lowest ones.

        Those that are built between two fingers never lean. Inside of the outline
        they may still fall over, which :func:`.towers.unbalanced` tells of what is planned.

        Parameters
        ----------
        first : (m,) int64 array
            Row of the first brick of each node.
        nodes : sequence of int
            Which of them.
        """
        rows = first[list(nodes)]
        if len(rows) <= SMALL:
            return False
        feet = rows[self.level[rows] == self.level[rows].min()]
        middle = self.moment[rows].sum(axis=0) / self.mass[rows].sum()
        low, high = self.low[feet].min(axis=0), self.high[feet].max(axis=0)
        return bool((middle < low).any() or (middle > high).any())
