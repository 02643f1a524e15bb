"""What is not yet joined: the grid under groups that stand apart, and how far bricks are lifted off what they hide.

Where several groups stand on the table, nothing between them tells how far apart they are. And a brick that is put on
a smaller one hides where that is, as in a small sub-assembly nothing else tells it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..model import NOBODY, Bricks, Catalogue, ContactGraph, components, contact_graph
from ..units import PLATES_PER_BRICK
from .canvas import Group, Item, Paint, Rgb, lines, rectangle
from .half_slabs import moved_by, slabs_of
from .lattice import Cells, Sight
from .picture import PLATE, at
from .sightlines import ENOUGH, Scene, Stage

_TABLE: Final = Paint(stroke=(205, 208, 214), width=2.0)

LIFTED: Final[Rgb] = (0, 104, 183)
"""Colour of the lines along which lifted bricks come down."""

_WAY: Final = Paint(stroke=LIFTED, width=3.4, dash=(9.0, 6.0))

LIFTS: Final = (PLATES_PER_BRICK, 2 * PLATES_PER_BRICK, 3 * PLATES_PER_BRICK)
"""Plates by which bricks are lifted, as few as show enough of what is below: a plate three studs from their rims."""


class Standing:
    """Which bricks of a model are next to each other.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    """

    def __init__(self, bricks: Bricks, catalogue: Catalogue) -> None:
        graph = contact_graph(bricks, catalogue)
        self._n = len(bricks)
        self._pairs = graph.pairs.astype(np.int64)
        self._near = np.concatenate([self._pairs, _beside(graph)])

    def groups(self, rows: Ints) -> Ints:
        """Return the number of the group of each of some bricks that touch, with studs or side by side."""
        there = np.zeros(self._n, dtype=bool)
        there[rows] = True
        found = components(self._near[there[self._near].all(axis=1)].astype(np.int32), self._n)
        return found[rows].astype(np.int64)

    def apart(self, rows: Ints) -> bool:
        """Tell whether some bricks are several groups that do not even touch each other's sides."""
        return len(np.unique(self.groups(rows))) > 1

    def joints(self, stays: Ints, new: Ints) -> tuple[Ints, Ints]:
        """Return which bricks new ones are pushed onto, of those that were there, and which of the new ones are."""
        low, high = self._pairs.T
        joint = np.isin(low, stays) & np.isin(high, new)
        return np.unique(low[joint]), np.unique(high[joint])

    def lifted(self, stage: Stage, scene: Scene, stays: Ints) -> tuple[Scene, int]:
        """Lift new bricks off those that they would hide.

        Parameters
        ----------
        stage : Stage
        scene : Scene
        stays : int64 array
            Rows of the bricks that were there before.

        Returns
        -------
        scene : Scene
            As it is seen then.
        plates : int
            How high they are lifted, 0 for not at all.
        """
        below, _ = self.joints(stays, scene.new)
        if scene.view.below or len(scene.left_out) or (scene.sight.shares[below] >= ENOUGH).all():
            return scene, 0
        rows = np.concatenate([stays, scene.new])
        found = []
        for plates in LIFTS:
            sight = stage.sight(rows, scene.view, (scene.new, plates))
            found.append((replace(scene, sight=sight, shares=sight.shares[scene.new]), plates))
            if (sight.shares[below] >= ENOUGH).all():
                return found[-1]
        return max(found, key=lambda each: float(each[0].sight.shares[below].min()))


def _beside(graph: ContactGraph) -> Ints:
    """Return the pairs of bricks in cells side by side, (n, 2)."""
    found = []
    for axis in range(3):
        one, other = (np.moveaxis(graph.owner, axis, 0)[part].ravel() for part in (np.s_[:-1], np.s_[1:]))
        meet = (one != other) & (one != NOBODY) & (other != NOBODY)
        found.append(np.stack([one[meet], other[meet]], axis=1))
    pairs: Ints = np.unique(np.concatenate(found).astype(np.int64), axis=0)
    return pairs


def table_grid(sight: Sight, low: Floats, high: Floats) -> Item:
    """Draw the squares of studs on the table below what is seen.

    Parameters
    ----------
    sight : Sight
        With its cells.
    low, high : (2,) float64 array
        Corners of the picture, in which the grid ends.
    """
    farthest = next(iter(slabs_of(sight)))
    place = _cells(farthest.sight).place
    ground = place[:, 2].min()
    (left, front), (right, back) = place[:, :2].min(axis=0).tolist(), (place[:, :2].max(axis=0) + 1).tolist()
    ends = [[(x, front), (x, back)] for x in range(left, right + 1)]
    ends += [[(left, y), (right, y)] for y in range(front, back + 1)]
    across = np.array(ends, dtype=np.int64).reshape(-1, 2)
    points = at(ground - 3 * across[:, ::-1]) + farthest.by
    return Group((lines(points.reshape(-1, 2, 2), _TABLE),), clip=rectangle(*low.tolist(), *(high - low).tolist()))


def ways_down(sight: Sight, rows: Ints, plates: int) -> Iterator[Item]:
    """Draw from the corners of lifted bricks where they come down.

    Parameters
    ----------
    sight : Sight
        In which they are lifted.
    rows : (k,) int64 array
    plates : int
        How high they are lifted.
    """
    cells = _cells(sight)
    ends = []
    for row in rows.tolist():
        place = cells.place[cells.brick == row]
        foot = place[place[:, 2] == place[:, 2].min()]
        corners = np.unique(
            (foot[:, None] + np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)])).reshape(-1, 3), axis=0
        )
        x, y, z = corners.T
        # the corners at the left, at the right and in front, nearer ones first
        chosen = [np.lexsort((-x - y, key))[0] for key in (y - x, x - y, -x - y)]
        points = at(z[chosen][:, None] - 3 * corners[chosen][:, 1::-1]).astype(np.float64)
        if cells.model is not None:
            points += moved_by(cells.model.bricks.shift[row, :2], cells.model.view)
        ends.append(np.stack([points, points + np.array([0, plates * PLATE])], axis=1))
    if ends:
        yield lines(np.concatenate(ends), _WAY)


def _cells(sight: Sight) -> Cells:
    if sight.cells is None:
        raise ValueError("a sight without its cells cannot be drawn on")
    return sight.cells
