"""Pillars that stay in the model: thin columns from what nothing else carries down to what is below it.

In a closed hollow no support could be taken out again, and what touches nothing
else would fall without one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..building import STEADY
from ..errors import BuildError
from ..geometry import corners, inside
from ..model import (
    NOBODY,
    Assembly,
    Bricks,
    Role,
    clutches,
    column_facts,
    stud_columns,
)
from ..units import PLATES_PER_BRICK
from .boxes import INSIDE_COLOUR, Boxes, boxes_of, bricks_of_boxes, merge_upwards, sizes_in
from .stacks import cells_in, widen


class LooseError(BuildError):
    """Bricks lie loose on tiles or slopes, which bear no pillar.

    Attributes
    ----------
    levels : (n,) int32 array
        The plates in which they lie.
    """

    def __init__(self, levels: Ints) -> None:
        super().__init__(
            f"A part of the model, in layer {levels.min() // PLATES_PER_BRICK + 1} from below, lies loose on tiles or "
            "slopes, which bear no pillar: choose another size, or surface 'studs'."
        )
        self.levels = levels


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


def add_pillars(assembly: Assembly) -> Assembly:
    """Put a pillar under each component that floats, in the colour of the brick on it: 1 x 1 parts are made in each.

    Parameters
    ----------
    assembly : Assembly

    Returns
    -------
    Assembly
        All that came in, in their order, and then the pillars, ``SUPPORT_KEPT``:
        nothing floats.

    Raises
    ------
    LooseError
        No pillar can stand under a component.
    """
    while assembly.graph.n_floating:
        graph = assembly.graph
        floating = np.unique(graph.component[~graph.grounded]).tolist()
        boxes, carried = zip(*(_under(assembly, graph.component == number) for number in floating), strict=True)
        colours = assembly.bricks.colour[list(carried)].tolist()
        assembly = assembly.with_more(_pillars(assembly, boxes, colours, Role.SUPPORT_KEPT))
    return assembly


def add_inner_pillars(assembly: Assembly, rows: Ints) -> Assembly:
    """Put a red pillar under each of the given bricks.

    Parameters
    ----------
    assembly : Assembly
    rows : (k,) int64 array
        Bricks to carry, with free cells below them.

    Returns
    -------
    Assembly
        All that came in, in their order, and then the pillars, ``SUPPORT_INSIDE``.
    """
    boxes = [_under(assembly, np.arange(len(assembly)) == row)[0] for row in rows.tolist()]
    return assembly.with_more(_pillars(assembly, boxes, [INSIDE_COLOUR] * len(boxes), Role.SUPPORT_INSIDE))


def _pillars(assembly: Assembly, slim: Sequence[Boxes], colours: Sequence[int], role: Role) -> list[Bricks]:
    """Return pillars as bricks, high ones wider where there is room beside all others."""
    catalogue, low = assembly.catalogue, np.array([*assembly.graph.low, 0, 0, 0], dtype=np.int32)
    free, taken, found = assembly.graph.owner == NOBODY, np.zeros(assembly.graph.owner.shape, np.int64), []
    for boxes in slim:
        _count(taken, boxes, 1)
    for boxes, colour in zip(slim, colours, strict=True):
        _count(taken, boxes, -1)
        wide = widen(boxes, free & (taken == 0), sizes_in(catalogue, colour))
        _count(taken, wide, 1)
        upright = merge_upwards(wide, catalogue, colour) + low
        found.append(bricks_of_boxes(upright, catalogue, colour=colour, role=role))
    return found


def _count(taken: Ints, boxes: Boxes, by: int) -> None:
    """Count boxes among those that take cells, in place."""
    for box in boxes.tolist():
        taken[cells_in(box)] += by


def _under(assembly: Assembly, mine: Mask) -> tuple[Boxes, int]:
    """Return pillars under some bricks that stand on another one or, upright, on the ground; and whom they carry.

    One pillar joins them to a brick below. On the ground they stand by themselves:
    pillars are added there until the middle of their weight lies over the feet.
    """
    under = places_below(assembly, mine)
    if not len(under):
        raise LooseError(assembly.bricks.corner[mine, 2])
    # a pillar on the ground leaves its part beside the model, one on a brick joins the two
    first = int(np.lexsort((under.y, under.x, under.length + GROUND * ~under.on_brick))[0])
    chosen = [first]
    if not under.on_brick[first]:
        squares = np.column_stack([under.x, under.y])
        middle = assembly.take(mine).centre_of_mass - assembly.graph.low[:2]
        standing = np.flatnonzero(~under.on_brick)
        steady = [(_inside(squares[[*chosen, each]], middle), each) for each in standing.tolist()]
        while _inside(squares[chosen], middle) < STEADY and max(steady)[0] > _inside(squares[chosen], middle):
            chosen.append(max(steady)[1])
            steady = [(_inside(squares[[*chosen, each]], middle), each) for each in standing.tolist()]
    return np.concatenate([_pillar(under, each) for each in chosen]), int(under.brick[first])


def places_below(assembly: Assembly, mine: Mask, *, between: bool = False) -> Places:
    """List where pillars can stand under some bricks, but not on them; sockets hold them, and studs bear them.

    Parameters
    ----------
    assembly : Assembly
    mine : (n,) bool array
        Which of them.
    between : bool, optional
        Whether they may stand on some of these bricks as well.

    Returns
    -------
    Places
        By brick.
    """
    brick, columns = stud_columns(assembly.bricks, assembly.catalogue)
    own = mine[brick] & column_facts(assembly.bricks, assembly.catalogue).socket
    brick, cells = brick[own], columns[own] - assembly.graph.low
    owner, ground = assembly.graph.owner, int(assembly.bricks.corner[:, 2].min()) - assembly.graph.low[2]
    found = []
    for row, (x, y, z) in zip(brick.tolist(), cells.tolist(), strict=True):
        below = np.flatnonzero(owner[:z, y, x] != NOBODY)
        foot = int(below[-1]) + 1 if len(below) else ground
        if foot < z and (between or not (len(below) and mine[owner[foot - 1, y, x]])):
            found.append((row, x, y, z, z - foot, len(below) > 0))
    row, x, y, top, length, on_brick = np.array(found, dtype=np.int64).reshape(-1, 6).T
    places = Places(row, x, y, top, length, on_brick.astype(bool))
    return places.take(np.flatnonzero(~places.on_brick | _bearing(assembly, places)))


def _bearing(assembly: Assembly, places: Places) -> Mask:
    """Return over which places that have a brick below it bears a pillar: slopes and tiles have no studs there."""
    graph = assembly.graph
    squares = np.stack([places.x, places.y], axis=1) + graph.low[:2]
    lower = graph.owner[places.top - places.length - 1, places.y, places.x]
    return clutches(assembly.bricks, assembly.catalogue, lower, places.brick.astype(np.int32), squares.astype(np.int32))


def kept_pillars(assembly: Assembly, places: Places) -> list[Bricks]:
    """Return the pillars at all places, each in the colour of the brick on it, ``SUPPORT_KEPT``."""
    boxes = [_pillar(places, number) for number in range(len(places))]
    return _pillars(assembly, boxes, assembly.bricks.colour[places.brick].tolist(), Role.SUPPORT_KEPT)


def _inside(squares: Ints, middle: Floats) -> float:
    """Return how far the middle of a weight lies inside of feet, in studs."""
    return inside(corners([(int(x), int(y)) for x, y in squares]), middle)


def _pillar(places: Places, number: int) -> Boxes:
    """Return a column of bricks with plates on top, whatever its length in plates, in cells of the connection."""
    x, y, top, length = (int(each[number]) for each in (places.x, places.y, places.top, places.length))
    heights = [PLATES_PER_BRICK] * (length // PLATES_PER_BRICK) + [1] * (length % PLATES_PER_BRICK)
    floors = top - length + np.concatenate([[0], np.cumsum(heights)])
    return boxes_of((x, y, int(floor), 1, 1, height) for floor, height in zip(floors, heights, strict=False))
