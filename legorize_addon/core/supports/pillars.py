"""Posts that stay in the model: thin columns from what nothing else carries down to what is below it.

In a closed hollow no support could be taken out again, and what touches nothing
else would fall without one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..building import STEADY
from ..geometry import corners, inside
from ..model import NOBODY, Bricks, Catalogue, Connection, Role, connect, joined, middles, stud_columns
from ..units import PLATES_PER_BRICK
from .boxes import INSIDE_COLOUR, Boxes, boxes_of, bricks_of_boxes, joined_upwards

GROUND: Final = 30
"""Plates that a post to a brick may be longer than one to the ground."""


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """Where posts can stand under some bricks: stud squares with free cells below, down to a brick or the ground.

    Attributes
    ----------
    brick : (k,) int64 array
        Row of the brick right above.
    x, y, top : (k,) int64 arrays
        Stud square and the plate at which the post ends, in cells of the connection.
    length : (k,) int64 array
        In plates.
    on_brick : (k,) bool array
        Whether the post stands on another brick, or on the ground.
    """

    brick: Ints
    x: Ints
    y: Ints
    top: Ints
    length: Ints
    on_brick: Mask

    def __len__(self) -> int:
        """Return the number of places."""
        return len(self.brick)

    def take(self, rows: Ints) -> Places:
        """Return some of the places."""
        return Places(*(getattr(self, name)[rows] for name in self.__slots__))


def with_floating_carried(bricks: Bricks, catalogue: Catalogue, connection: Connection) -> tuple[Bricks, Connection]:
    """Put a post under each component that floats, in the colour of the brick on it: 1 x 1 parts are made in each.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    connection : Connection
        Of these bricks.

    Returns
    -------
    bricks : Bricks
        All that came in, in their order, and then the posts, ``SUPPORT_KEPT``.
    connection : Connection
        Of those: nothing floats.
    """
    while connection.n_floating:
        floating = np.unique(connection.component[~connection.grounded])
        posts = []
        for number in floating.tolist():
            boxes, carried = _under(bricks, catalogue, connection, connection.component == number)
            posts.append(_bricks(boxes, catalogue, int(bricks.colour[carried]), Role.SUPPORT_KEPT))
        bricks = joined([bricks, *posts])
        connection = connect(bricks, catalogue)
    return bricks, connection


def with_inside_carried(
    bricks: Bricks, catalogue: Catalogue, connection: Connection, rows: Ints
) -> tuple[Bricks, Connection]:
    """Put a red post under each of the given bricks.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    connection : Connection
        Of these bricks.
    rows : (k,) int64 array
        Bricks to carry, with free cells below them.

    Returns
    -------
    bricks : Bricks
        All that came in, in their order, and then the posts, ``SUPPORT_INSIDE``.
    connection : Connection
        Of those.
    """
    posts = []
    for row in rows.tolist():
        boxes, _ = _under(bricks, catalogue, connection, np.arange(len(bricks)) == row)
        posts.append(_bricks(boxes, catalogue, INSIDE_COLOUR, Role.SUPPORT_INSIDE))
    if not posts:
        return bricks, connection
    bricks = joined([bricks, *posts])
    return bricks, connect(bricks, catalogue)


def _bricks(boxes: Boxes, catalogue: Catalogue, colour: int, role: Role) -> Bricks:
    return bricks_of_boxes(joined_upwards(boxes, catalogue, colour), catalogue, colour=colour, role=role)


def _under(bricks: Bricks, catalogue: Catalogue, connection: Connection, mine: Mask) -> tuple[Boxes, int]:
    """Return posts under some bricks that stand on another one or, upright, on the ground; and whom they carry.

    One post joins them to a brick below. On the ground they stand by themselves:
    posts are added there until the middle of their weight lies over the feet.
    """
    under = places_below(bricks, catalogue, connection, mine)
    # a post on the ground leaves its part beside the model, one on a brick joins the two
    first = int(np.lexsort((under.y, under.x, under.length + GROUND * ~under.on_brick))[0])
    chosen = [first]
    if not under.on_brick[first]:
        squares = np.column_stack([under.x, under.y])
        middle = middle_of_weight(bricks.take(mine), catalogue) - connection.low[:2]
        standing = np.flatnonzero(~under.on_brick)
        steady = [(_inside(squares[[*chosen, each]], middle), each) for each in standing.tolist()]
        while _inside(squares[chosen], middle) < STEADY and max(steady)[0] > _inside(squares[chosen], middle):
            chosen.append(max(steady)[1])
            steady = [(_inside(squares[[*chosen, each]], middle), each) for each in standing.tolist()]
    return np.concatenate([_post(connection, under, each) for each in chosen]), int(under.brick[first])


def places_below(bricks: Bricks, catalogue: Catalogue, connection: Connection, mine: Mask) -> Places:
    """List where posts can stand under some bricks, but not on them.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    connection : Connection
        Of these bricks.
    mine : (n,) bool array
        Which of them.

    Returns
    -------
    Places
        By brick.
    """
    brick, columns = stud_columns(bricks, catalogue)
    own = mine[brick]
    brick, cells = brick[own], columns[own] - connection.low
    owner, ground = connection.owner, int(bricks.corner[:, 2].min()) - connection.low[2]
    found = []
    for row, (x, y, z) in zip(brick.tolist(), cells.tolist(), strict=True):
        below = np.flatnonzero(owner[:z, y, x] != NOBODY)
        foot = int(below[-1]) + 1 if len(below) else ground
        if foot < z and not (len(below) and mine[owner[foot - 1, y, x]]):
            found.append((row, x, y, z, z - foot, len(below) > 0))
    row, x, y, top, length, on_brick = np.array(found, dtype=np.int64).reshape(-1, 6).T
    return Places(row, x, y, top, length, on_brick.astype(bool))


def middle_of_weight(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the middle of the weight of bricks, x and y in studs, (2,) float64."""
    mass = catalogue.mass[bricks.part]
    middle: Floats = mass @ middles(bricks, catalogue) / mass.sum()
    return middle


def kept_post(bricks: Bricks, connection: Connection, catalogue: Catalogue, places: Places, number: int) -> Bricks:
    """Return the post at one place, in the colour of the brick on it, ``SUPPORT_KEPT``."""
    colour = int(bricks.colour[places.brick[number]])
    return _bricks(_post(connection, places, number), catalogue, colour, Role.SUPPORT_KEPT)


def _inside(squares: Ints, middle: Floats) -> float:
    """Return how far the middle of a weight lies inside of feet, in studs."""
    return inside(corners([(int(x), int(y)) for x, y in squares]), middle)


def _post(connection: Connection, places: Places, number: int) -> Boxes:
    """Return a column of bricks with plates on top, whatever its length in plates."""
    x, y, top, length = (int(each[number]) for each in (places.x, places.y, places.top, places.length))
    heights = [PLATES_PER_BRICK] * (length // PLATES_PER_BRICK) + [1] * (length % PLATES_PER_BRICK)
    floors = top - length + np.concatenate([[0], np.cumsum(heights)])
    boxes = boxes_of((x, y, int(floor), 1, 1, height) for floor, height in zip(floors, heights, strict=False))
    return boxes + np.array([*connection.low, 0, 0, 0], dtype=np.int32)
