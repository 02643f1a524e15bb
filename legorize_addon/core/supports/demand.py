"""Which bricks need a support while the model is built, and where it touches them.

Only places over open ground are taken, from which supports can be pulled out
again; one contact often serves many bricks, because what stands on a carried
brick is carried as well, and may carry others from above.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..model import Assembly, Rows, column_facts, middles, stud_columns
from ..statics import GRAVITY
from .boxes import TALL
from .clearance import Clearance, clearance_around
from .hanging import NOT_HELD, Hanging

INSIDE: Final = 6
"""Plates by which bricks in closed hollows may hang deeper than others."""


@dataclass(frozen=True, slots=True, eq=False)
class Demand:
    """What has to be supported, and where.

    Attributes
    ----------
    room : Clearance
        Where supports may stand.
    bricks : (n_need,) int64 array
        Rows of the bricks that nothing of the model carries within the limit.
    undersides : (n_cells, 3) int32 array
        Cells (x, y, z) of the room at the undersides of all bricks that have open
        room down to the ground: z is the plate on which the brick lies.
    over : (n_cells,) int64 array
        Row of the brick over each of them.
    contacts : (n_contacts, 3) int32 array
        The cells that a support must reach, chosen from those.
    carried : (n_contacts,) int64 array
        Row of the brick on each contact.
    load : (n_contacts,) float64 array
        Weight in N of all bricks that each contact carries while building.
    enclosed : int64 array
        Rows of the bricks that no contact carries, and that look down into closed
        hollows alone, from which nothing comes out again.
    depth : (n,) int32 array
        Plates by which each brick hangs then, ``NOT_HELD`` where nothing holds it.
    """

    room: Clearance
    bricks: Ints
    undersides: Rows
    over: Ints
    contacts: Rows
    carried: Ints
    load: Floats
    enclosed: Ints
    depth: NDArray[np.int32]

    @property
    def cells(self) -> Rows:
        """Undersides of the bricks that need a support: all that it could stand under, (m, 3) int32."""
        return self.undersides[np.isin(self.over, self.bricks)]

    @property
    def left(self) -> Ints:
        """Rows of the bricks that no contact carries within the limit."""
        return np.flatnonzero(self.depth == NOT_HELD)


def support_demand(assembly: Assembly, *, deepest: int, room: Clearance | None = None) -> Demand:
    """Find the bricks that need a support, and contacts that carry them.

    Parameters
    ----------
    assembly : Assembly
        One piece, n rows, which stands on its lowest plate.
    deepest : int
        Plates that bricks may hang one under another while building; 0 if each
        brick must lie on another one.
    room : Clearance, optional
        Where supports may stand, of cells that include this piece; by default
        that around the piece alone.

    Returns
    -------
    Demand
    """
    height = assembly.catalogue.height[assembly.bricks.part]
    carrying = Hanging(assembly.graph, height, deepest=deepest)
    level = assembly.bricks.corner[:, 2]
    carrying.clutch(np.flatnonzero(level == level.min()).tolist())
    wanting = np.flatnonzero(carrying.depth == NOT_HELD)
    room = clearance_around(assembly.graph) if room is None else room
    brick, cells, enclosed = _undersides(assembly, room)
    chosen, load = _chosen(carrying, assembly, np.intersect1d(wanting, brick))
    # a stud in the middle tips a brick least
    middle = middles(assembly.bricks, assembly.catalogue) - room.low[:2]
    off = np.abs(cells[:, :2] + 0.5 - middle[brick]).sum(axis=1)
    order = np.lexsort((off, brick))
    first = order[np.searchsorted(brick[order], chosen)]
    depth = carrying.depth
    # inside, a pillar would stay for good: bricks may hang deeper before one is worth it
    carrying.deepen(deepest + INSIDE)
    return Demand(
        room=room,
        bricks=wanting,
        undersides=cells,
        over=brick,
        contacts=cells[first],
        carried=chosen,
        load=load,
        enclosed=enclosed[carrying.depth[enclosed] == NOT_HELD],
        depth=depth,
    )


def parts_of_supports(assembly: Assembly, *, deepest: int) -> float:
    """Estimate how many parts the supports of a model take: tall bricks under each contact.

    Parameters
    ----------
    assembly : Assembly
        One piece.
    deepest : int
        As for :func:`support_demand`.

    Returns
    -------
    float
    """
    return float(support_demand(assembly, deepest=deepest).contacts[:, 2].sum()) / TALL


def _chosen(carrying: Hanging, assembly: Assembly, candidates: Ints) -> tuple[Ints, Floats]:
    """Choose bricks to carry, from the lowest; of one level, those held best from above, which part cleanly."""
    studs_above = np.bincount(assembly.graph.pairs[:, 0], assembly.graph.studs, len(assembly.bricks))
    mass = assembly.catalogue.mass[assembly.bricks.part]
    order = candidates[
        np.lexsort((candidates, -mass[candidates], -studs_above[candidates], assembly.bricks.corner[candidates, 2]))
    ]
    chosen, load = [], []
    for brick in order.tolist():
        if not carrying.held(brick):
            chosen.append(brick)
            load.append(GRAVITY * float(mass[carrying.clutch([brick])].sum()) / 1000)
    return np.array(chosen, dtype=np.int64), np.array(load, dtype=np.float64)


def _undersides(assembly: Assembly, room: Clearance) -> tuple[Ints, Rows, Ints]:
    """List the cells over open room, with the rows of their bricks, and the bricks that look into closed hollows."""
    brick, columns = stud_columns(assembly.bricks, assembly.catalogue)
    cells = columns - room.low
    # a support holds nothing where there is no socket, as under an inverted slope
    raised = (cells[:, 2] > 0) & column_facts(assembly.bricks, assembly.catalogue).socket
    brick, cells = brick[raised].astype(np.int64), cells[raised]
    below = cells[:, 2] - 1, cells[:, 1], cells[:, 0]
    enclosed = np.setdiff1d(brick[~room.filled[below] & ~room.free[below]], brick[room.free[below]])
    return brick[room.open[below]], cells[room.open[below]], enclosed
