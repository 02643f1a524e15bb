"""Which faces of bricks are seen from a corner: an integer depth buffer, exact to the last sliver.

Seen along the diagonal (1, 1, 3) of the cells, every corner of a cell falls on a
point of one plane lattice, and the outlines of all faces run along its lines: a
brick of one stud covers a regular hexagon, its three faces a third each. The
pieces of the plane between the lines, two to a square of the lattice, are each
covered by whole faces, so that the nearest face of every piece is found without
a rounding error, and the seen part of a face is a union of pieces.

With z upwards the viewer stands where x and y are greatest. A point (x, y, z)
lies at ``p = z - 3 y``, ``q = z - 3 x`` of the lattice, to which every point on
its line of sight belongs. Cells are stud squares, one plate high.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..model import NOBODY, Bricks, Catalogue, column_facts, stud_columns

SIDES: Final = 3
"""Faces of a cell that are seen: its top, its side towards +x, its side towards +y."""

TOP: Final = 0

PER_TOP: Final = 18
"""Pieces of the plane that the top of a cell covers; a side a plate high covers a third of them."""

_AHEAD: Final = ((0, 0, 1), (1, 0, 0), (0, 1, 0))
"""The cell in front of each face."""

_PIECES: Final = np.array(
    [
        *((m, n, half) for m in (1, 2, 3) for n in (1, 2, 3) for half in (0, 1)),
        *((0, 0, 1), (1, 0, 0), (1, 0, 1), (2, 0, 0), (2, 0, 1), (3, 0, 0)),
        *((0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 2, 0), (0, 2, 1), (0, 3, 1)),
    ]
)
"""Square and half of each piece of a face, from the square (z - 3 y - 3, z - 3 x - 3) of its cell."""

_FIRST: Final = np.array([0, 18, 24])
_COUNT: Final = np.array([18, 6, 6])
"""Where the pieces of each side begin, and how many they are."""


class View(NamedTuple):
    """Where the viewer stands.

    Attributes
    ----------
    turns : int
        Quarter turns of the model, counter-clockwise as seen from above: at 0
        the viewer looks from the corner of the greatest x and y.
    below : bool
        Whether the model is laid on its back, so that undersides are seen.
    """

    turns: int
    below: bool = False


FRONT: Final = View(1)
"""From the front right: the front of a model looks towards -y."""


class Seen(NamedTuple):
    """Whose cells some cells are, and from where they are seen."""

    bricks: Bricks
    catalogue: Catalogue
    view: View


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """The cells of bricks, turned as they are seen.

    Attributes
    ----------
    place : (n, 3) int64 array
        x, y and z of each cell.
    brick : (n,) int64 array
        Row of its brick.
    model : Seen, optional
        The bricks, for those who draw more than cells.
    """

    place: Ints
    brick: Ints
    model: Seen | None = None

    @classmethod
    def of(cls, bricks: Bricks, catalogue: Catalogue, view: View) -> Cells:
        """Return the cells of all bricks as they are seen from a place."""
        brick, columns = stud_columns(bricks, catalogue)
        facts = column_facts(bricks, catalogue)
        height = (facts.high - facts.low).astype(np.int64)
        place = np.repeat(columns.astype(np.int64), height, axis=0)
        place[:, 2] += np.arange(len(place)) - np.repeat(np.cumsum(height) - height, height)
        model = Seen(bricks, catalogue, view)
        return cls(turned(place, view), np.repeat(brick.astype(np.int64), height), model)

    def take(self, rows: Mask) -> Cells:
        """Return some of the cells."""
        return Cells(self.place[rows], self.brick[rows], self.model)


def turned(place: Ints, view: View) -> Ints:
    """Turn cells, (n, 3), to where a viewer sees them."""
    x, y, z = place.T
    for _ in range(view.turns % 4):
        x, y = -y - 1, x
    return np.stack([y, x, -z - 1] if view.below else [x, y, z], axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class Faces:
    """Faces that may be seen.

    Attributes
    ----------
    place : (n, 3) int64 array
        Their cells.
    brick : (n,) int64 array
        Their bricks.
    side : (n,) int64 array
        ``TOP``, 1 towards +x, 2 towards +y.
    """

    place: Ints
    brick: Ints
    side: Ints

    def __len__(self) -> int:
        """Return the number of faces."""
        return len(self.brick)


@dataclass(frozen=True, slots=True, eq=False)
class Sight:
    """What is seen of some cells.

    Attributes
    ----------
    faces : Faces
        Faces with no cell right in front of them.
    nearest : (n_p, n_q, 2) int64 array
        Row of the face that is seen in each piece of the plane, ``NOBODY`` where there
        is none: of each square of the lattice the half with p - q below, and
        above that of its lower corner.
    low : (2,) int64 array
        p and q of the lower corner of the first square.
    free : (n_bricks,) int64 array
        Pieces that each brick would cover if it were alone.
    cells : Cells, optional
        What was looked at.
    """

    faces: Faces
    nearest: Ints
    low: Ints
    free: Ints
    cells: Cells | None = None

    @property
    def per_face(self) -> Ints:
        """Pieces that are seen of each face, (n_faces,)."""
        seen = self.nearest[self.nearest != NOBODY]
        return np.bincount(seen, minlength=len(self.faces))

    @property
    def shares(self) -> NDArray[np.float64]:
        """Share of what could be seen of each brick that is seen, (n_bricks,); 0 for bricks without a cell."""
        seen = np.bincount(self.faces.brick, self.per_face, len(self.free))
        return np.asarray(seen / np.maximum(self.free, 1))

    @property
    def bricks(self) -> Ints:
        """Row of the brick that is seen in each piece of the plane, ``NOBODY`` where there is none; as `nearest`."""
        return np.append(self.faces.brick, NOBODY)[self.nearest]


def look(cells: Cells, n_bricks: int) -> Sight:
    """Find out what is seen of some cells.

    Parameters
    ----------
    cells : Cells
        As they are turned to the viewer.
    n_bricks : int
        Bricks in the table that the cells' rows count in.

    Returns
    -------
    Sight
    """
    faces, free = _faces(cells, n_bricks)
    base = faces.place[:, 2:] - 3 * faces.place[:, 1::-1] - 3
    if not len(base):
        return Sight(faces, np.full((2, 2, 2), NOBODY, dtype=np.int64), np.zeros(2, dtype=np.int64), free, cells)
    # a square more on every side, so that every piece that is seen has neighbours
    low = base.min(axis=0) - 1
    nearest = np.full((*(base.max(axis=0) - low + 5).tolist(), 2), NOBODY, dtype=np.int64)
    # all three grow towards the viewer, and of one cell no two faces are in each other's way
    order = np.argsort(faces.place.sum(axis=1), kind="stable")
    count = _COUNT[faces.side[order]]
    nth = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    face = np.repeat(order, count)
    piece = _PIECES[_FIRST[faces.side[face]] + nth]
    m, n = (base[face] - low + piece[:, :2]).T
    # the last one written stays
    nearest[m, n, piece[:, 2]] = face
    return Sight(faces, nearest, low, free, cells)


def _faces(cells: Cells, n_bricks: int) -> tuple[Faces, Ints]:
    """List the faces with nothing right in front of them; count the pieces of those that a brick alone would show."""
    if not len(cells.brick):
        none = np.zeros(0, dtype=np.int64)
        return Faces(none.reshape(0, 3), none, none), np.zeros(n_bricks, dtype=np.int64)
    origin = cells.place.min(axis=0)
    place = cells.place - origin
    owner = np.full(place.max(axis=0) + 2, NOBODY, dtype=np.int32)
    owner[tuple(place.T)] = cells.brick
    ahead = np.stack([owner[tuple((place + step).T)] for step in _AHEAD], axis=1)
    alone = ahead != cells.brick[:, None]
    row, side = np.nonzero(alone)
    free = np.bincount(cells.brick[row], _COUNT[side], n_bricks).astype(np.int64)
    row, side = np.nonzero(ahead == NOBODY)
    return Faces(cells.place[row], cells.brick[row], side), free
