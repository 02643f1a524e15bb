"""Pillars that stay in the model: thin columns from what nothing else carries down to what is below it.

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
from ..model import NOBODY, Bricks, Catalogue, ContactGraph, Role, concatenate, contact_graph, middles, stud_columns
from ..units import PLATES_PER_BRICK
from .boxes import INSIDE_COLOUR, Boxes, boxes_of, bricks_of_boxes, merge_upwards

GROUND: Final = 30
"""Plates that a pillar to a brick may be longer than one to the ground."""


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """Where pillars can stand under some bricks: stud squares with free cells below, down to a brick or the ground.

    Attributes
    ----------
    brick : (k,) int64 array
        Row of the brick right above.
    x, y, top : (k,) int64 arrays
        Stud square and the plate at which the pillar ends, in cells of the connection.
    length : (k,) int64 array
        In plates.
    on_brick : (k,) bool array
        Whether the pillar stands on another brick, or on the ground.
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


def add_pillars(bricks: Bricks, catalogue: Catalogue, graph: ContactGraph) -> tuple[Bricks, ContactGraph]:
    """Put a pillar under each component that floats, in the colour of the brick on it: 1 x 1 parts are made in each.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    graph : ContactGraph
        Of these bricks.

    Returns
    -------
    bricks : Bricks
        All that came in, in their order, and then the pillars, ``SUPPORT_KEPT``.
    graph : ContactGraph
        Of those: nothing floats.
    """
    while graph.n_floating:
        floating = np.unique(graph.component[~graph.grounded])
        pillars = []
        for number in floating.tolist():
            boxes, carried = _under(bricks, catalogue, graph, graph.component == number)
            pillars.append(_bricks(boxes, catalogue, int(bricks.colour[carried]), Role.SUPPORT_KEPT))
        bricks = concatenate([bricks, *pillars])
        graph = contact_graph(bricks, catalogue)
    return bricks, graph


def add_inner_pillars(
    bricks: Bricks, catalogue: Catalogue, graph: ContactGraph, rows: Ints
) -> tuple[Bricks, ContactGraph]:
    """Put a red pillar under each of the given bricks.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    graph : ContactGraph
        Of these bricks.
    rows : (k,) int64 array
        Bricks to carry, with free cells below them.

    Returns
    -------
    bricks : Bricks
        All that came in, in their order, and then the pillars, ``SUPPORT_INSIDE``.
    graph : ContactGraph
        Of those.
    """
    pillars = []
    for row in rows.tolist():
        boxes, _ = _under(bricks, catalogue, graph, np.arange(len(bricks)) == row)
        pillars.append(_bricks(boxes, catalogue, INSIDE_COLOUR, Role.SUPPORT_INSIDE))
    if not pillars:
        return bricks, graph
    bricks = concatenate([bricks, *pillars])
    return bricks, contact_graph(bricks, catalogue)


def _bricks(boxes: Boxes, catalogue: Catalogue, colour: int, role: Role) -> Bricks:
    return bricks_of_boxes(merge_upwards(boxes, catalogue, colour), catalogue, colour=colour, role=role)


def _under(bricks: Bricks, catalogue: Catalogue, graph: ContactGraph, mine: Mask) -> tuple[Boxes, int]:
    """Return pillars under some bricks that stand on another one or, upright, on the ground; and whom they carry.

    One pillar joins them to a brick below. On the ground they stand by themselves:
    pillars are added there until the middle of their weight lies over the feet.
    """
    under = places_below(bricks, catalogue, graph, mine)
    # a pillar on the ground leaves its part beside the model, one on a brick joins the two
    first = int(np.lexsort((under.y, under.x, under.length + GROUND * ~under.on_brick))[0])
    chosen = [first]
    if not under.on_brick[first]:
        squares = np.column_stack([under.x, under.y])
        middle = centre_of_mass(bricks.take(mine), catalogue) - graph.low[:2]
        standing = np.flatnonzero(~under.on_brick)
        steady = [(_inside(squares[[*chosen, each]], middle), each) for each in standing.tolist()]
        while _inside(squares[chosen], middle) < STEADY and max(steady)[0] > _inside(squares[chosen], middle):
            chosen.append(max(steady)[1])
            steady = [(_inside(squares[[*chosen, each]], middle), each) for each in standing.tolist()]
    return np.concatenate([_pillar(graph, under, each) for each in chosen]), int(under.brick[first])


def places_below(bricks: Bricks, catalogue: Catalogue, graph: ContactGraph, mine: Mask) -> Places:
    """List where pillars can stand under some bricks, but not on them.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    graph : ContactGraph
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
    brick, cells = brick[own], columns[own] - graph.low
    owner, ground = graph.owner, int(bricks.corner[:, 2].min()) - graph.low[2]
    found = []
    for row, (x, y, z) in zip(brick.tolist(), cells.tolist(), strict=True):
        below = np.flatnonzero(owner[:z, y, x] != NOBODY)
        foot = int(below[-1]) + 1 if len(below) else ground
        if foot < z and not (len(below) and mine[owner[foot - 1, y, x]]):
            found.append((row, x, y, z, z - foot, len(below) > 0))
    row, x, y, top, length, on_brick = np.array(found, dtype=np.int64).reshape(-1, 6).T
    return Places(row, x, y, top, length, on_brick.astype(bool))


def centre_of_mass(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the middle of the weight of bricks, x and y in studs, (2,) float64."""
    mass = catalogue.mass[bricks.part]
    middle: Floats = mass @ middles(bricks, catalogue) / mass.sum()
    return middle


def kept_pillar(bricks: Bricks, graph: ContactGraph, catalogue: Catalogue, places: Places, number: int) -> Bricks:
    """Return the pillar at one place, in the colour of the brick on it, ``SUPPORT_KEPT``."""
    colour = int(bricks.colour[places.brick[number]])
    return _bricks(_pillar(graph, places, number), catalogue, colour, Role.SUPPORT_KEPT)


def _inside(squares: Ints, middle: Floats) -> float:
    """Return how far the middle of a weight lies inside of feet, in studs."""
    return inside(corners([(int(x), int(y)) for x, y in squares]), middle)


def _pillar(graph: ContactGraph, places: Places, number: int) -> Boxes:
    """Return a column of bricks with plates on top, whatever its length in plates."""
    x, y, top, length = (int(each[number]) for each in (places.x, places.y, places.top, places.length))
    heights = [PLATES_PER_BRICK] * (length // PLATES_PER_BRICK) + [1] * (length % PLATES_PER_BRICK)
    floors = top - length + np.concatenate([[0], np.cumsum(heights)])
    boxes = boxes_of((x, y, int(floor), 1, 1, height) for floor, height in zip(floors, heights, strict=False))
    return boxes + np.array([*graph.low, 0, 0, 0], dtype=np.int32)
