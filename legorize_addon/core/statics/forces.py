"""The forces between the bricks as linear equations: what pushes and pulls where, and what has to be in balance.

The model of Liu et al., "StableLego: Stability Analysis of Block Stacking
Assembly" (2024), after Luo et al., "Legolization" (2015): every brick is a
rigid body that must be in balance under its weight and the forces at its
contacts. Their pair of forces at a contact point, a push and a friction that
never act together, is one number here, push less friction, which is the same
without products of unknowns. Their horizontal forces at the studs of one pair
of bricks, which have no bound there, are bounded here: a contact point bears no
more along the wall that it touches and in pull together than its friction, and
what presses it adds to that. That is Coulomb's cone in the plane of the wall,
and its two edges are two forces that lean against each other at 45 degrees.
The torque about the vertical is in the model too.

Bricks side by side push each other only where that is asked for: what stands
without needs no neighbour to stand close.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from ..arrays import Floats, Ints, Mask
from ..model import (
    NOBODY,
    Assembly,
    Bricks,
    Catalogue,
    Rows,
    centres,
    clutches,
    column_facts,
    outline,
    stud_columns,
    turned,
)
from ..units import PLATE, STUD

GRAVITY: Final = 9.81
"""N/kg."""

HOLD: Final = 0.98
"""Pull in N that the friction of one contact point bears; StableLego measured it."""

CAUTIOUS_HOLD: Final = 0.70
"""The same in N, as Luo et al. measured it on bricks that hold less."""

TABLE_FRICTION: Final = 0.2
"""Horizontal over vertical force that a table bears before a brick slides: low for ABS on wood or plastic."""

EQUATIONS: Final = 6
"""Of each brick: the sums of forces along x, y, z and of torques about x, y, z."""

GRIPS_NARROW: Final = np.array([(0, -0.25), (-0.25, 0), (0, 0.25), (0.25, 0)])
"""Contact points (x, y) round a stud in a brick one stud wide, in studs from its middle; StableLego."""

GRIPS_WIDE: Final = np.array([(0.125, -0.125), (-0.25, 0), (0.125, 0.125)])
"""The same in a brick two studs wide: two walls and a tube."""


class Ground(Enum):
    """What the lowest bricks stand on."""

    TABLE = "table"
    """Pushes at the corners of a brick, holds it sideways by friction, never pulls."""

    BASEPLATE = "baseplate"
    """Studs, which hold a brick as another brick would; StableLego's ground."""


@dataclass(frozen=True, slots=True, eq=False)
class ContactForces:
    """Forces that bodies exert on each other, one row each: a line of action and the least that it may be.

    Forces at one contact point follow each other.

    Attributes
    ----------
    on, by : (k,) int64 array
        Row of the brick that the force acts on, and of the one that it reacts
        on; ``NOBODY`` for the ground.
    point : (k, 3) float64 array
        Point of action in studs.
    direction : (k, 3) float64 array
        Force on ``on`` for a value of 1.
    least : (k,) float64 array
        Least value in N: 0 of what only pushes, less than 0 of what friction
        holds as well.
    """

    on: Ints
    by: Ints
    point: Floats
    direction: Floats
    least: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Statics:
    """Balance of the bricks that stand: ``matrix @ forces + loads = 0`` with ``forces >= least``.

    Attributes
    ----------
    matrix : (6 n, k) sparse float64 array
        What each force adds to the sums of each brick: forces along x, y, z, and
        torques about x, y, z through its middle, those in N at the lever of a
        stud (8 mm).
    loads : (6 n,) float64 array
        The same of weights and loads, in N and N times 8 mm.
    contacts : ContactForces
        The forces; their bodies count the rows of ``rows``.
    rows : (n,) int64 array
        Row of each body in the table of bricks.
    middle : (n, 3) float64 array
        Centre of mass of each body in studs.
    clutch : float
        Pull in N that one contact point bears.
    """

    matrix: csc_array
    loads: Floats
    contacts: ContactForces
    rows: Ints
    middle: Floats
    clutch: float


def statics(
    assembly: Assembly,
    *,
    clutch: float = HOLD,
    ground: Ground = Ground.TABLE,
    loads: Floats | None = None,
    neighbours: bool = False,
) -> Statics:
    """Set up the balance of all bricks that hang together with the ground.

    Parameters
    ----------
    assembly : Assembly
        The model. Its lowest plate is the ground.
    clutch : float
        Pull in N that one contact point bears.
    ground : Ground
        What the lowest bricks stand on.
    loads : (n_bricks, 3) float64 array, optional
        More forces on the bricks, in N at their centres of mass, x, y and z up.
    neighbours : bool
        Whether bricks side by side may push each other.

    Returns
    -------
    Statics
        The equations. Bricks that float are not in them.
    """
    squares = stud_columns(assembly.bricks, assembly.catalogue)
    middle, rows = _centres(assembly.bricks, assembly.catalogue), np.flatnonzero(assembly.graph.grounded)
    narrow = np.array([part.width < 2 for part in assembly.catalogue.parts])[assembly.bricks.part]
    contacts = _joined(
        _studs(assembly, *squares, narrow, clutch),
        *(_sides(assembly) if neighbours else ()),
        (_table(assembly, *squares) if ground is Ground.TABLE else _baseplate(assembly, *squares, narrow, clutch)),
    )
    contacts = _among(contacts, rows, len(assembly.bricks))
    weight = np.zeros((len(assembly.bricks), EQUATIONS))
    weight[:, 2] = -GRAVITY * assembly.catalogue.mass[assembly.bricks.part] / 1000
    if loads is not None:
        weight[:, :3] += loads
    return Statics(matrix_of(contacts, middle[rows]), weight[rows].reshape(-1), contacts, rows, middle[rows], clutch)


def _centres(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the centre of mass of each brick in studs."""
    return centres(bricks, catalogue) * (1, 1, PLATE / STUD)


def _studs(assembly: Assembly, brick: Rows, columns: Rows, narrow: Mask, clutch: float) -> ContactForces:
    """Return the forces at the contact points round all studs."""
    graph = assembly.graph
    x, y, z = (columns - graph.low).T
    # below the lowest plate the look-up would start again at the top
    lower = np.where(z > 0, graph.owner[z - 1, y, x], NOBODY)
    held = (
        (lower != NOBODY)
        & (lower != brick)
        & clutches(assembly.bricks, assembly.catalogue, lower, brick, columns[:, :2])
    )
    return _grips(brick[held], lower[held], _moved(columns, assembly.bricks, brick)[held], narrow, clutch)


def _moved(columns: Rows, bricks: Bricks, brick: Rows) -> Rows | Floats:
    """Return where stud squares of bricks are that may lie half a stud beyond their corners."""
    return columns + bricks.shift[brick] if bricks.halved else columns


def _grips(brick: Rows, lower: Rows, columns: Rows | Floats, narrow: Mask, clutch: float) -> ContactForces:
    """Return the forces at the contact points round studs under narrow and wide bricks."""
    made = []
    for which, grips in ((narrow[brick], GRIPS_NARROW), (~narrow[brick], GRIPS_WIDE)):
        of = np.repeat(np.flatnonzero(which), len(grips))
        places = (columns[which, None, :2] + 0.5 + grips).reshape(-1, 2)
        points = np.column_stack([places, columns[of, 2] * (PLATE / STUD)])
        # the wall at a contact point runs across the line to the middle of the stud
        along = np.column_stack([-grips[:, 1], grips[:, 0]]) / np.hypot(*grips.T)[:, None]
        leaning = np.ones((len(grips), 2, 3))
        leaning[:, 0, :2], leaning[:, 1, :2] = along, -along
        directions = np.tile(leaning, (len(places) // len(grips), 1, 1))
        made.append(_forces(brick[of], lower[of], points, directions, -clutch / 2))
    return _joined(*made)


def _sides(assembly: Assembly) -> tuple[ContactForces, ...]:
    """Return two pushes for each pair of bricks side by side: where they touch, at the bottom as in StableLego.

    One is at each end of the face, so that together they push anywhere along it.
    """
    graph, shift, owner = assembly.graph, assembly.bricks.shift, _filled(assembly)
    made = []
    for axis, direction in ((2, (1, 0, 0)), (1, (0, 1, 0))):
        stride = owner.strides[axis] // owner.itemsize
        cells = np.flatnonzero(owner.take(np.arange(owner.shape[axis] - 1), axis) != NOBODY)
        shape = list(owner.shape)
        shape[axis] -= 1
        z, y, x = np.unravel_index(cells, shape)
        cells = np.ravel_multi_index((z, y, x), owner.shape)
        first, second = owner.reshape(-1)[cells], owner.reshape(-1)[cells + stride]
        touching = (second != NOBODY) & (first != second) & (shift[first] == shift[second]).all(axis=1)
        pairs = first[touching].astype(np.int64) * (owner.max(initial=0) + 1) + second[touching]
        # cells run upwards, so the first of a pair is its lowest
        _, lowest, pair = np.unique(pairs, return_index=True, return_inverse=True)
        ends = np.repeat((np.column_stack([x, y, z])[touching][lowest] + graph.low)[:, None], 2, axis=1)
        across, at = (y, 1) if axis == 2 else (x, 0)
        np.minimum.at(ends[:, 0, at], pair, across[touching] + graph.low[at])
        np.maximum.at(ends[:, 1, at], pair, across[touching] + graph.low[at] + 1)
        on, by = (np.repeat(each[touching][lowest], 2) for each in (second, first))
        directions = np.tile(np.array(direction, dtype=np.float64), (2 * len(lowest), 1, 1))
        made.append(_forces(on, by, (ends.reshape(-1, 3) + shift[on]) * (1, 1, PLATE / STUD), directions, 0.0))
    return tuple(made)


def _filled(assembly: Assembly) -> Rows:
    """Return the brick in each cell without the squares into which wedge plates only reach: beside these is a gap."""
    owner = assembly.graph.owner
    wedge = _wedges(assembly)
    if not wedge.any():
        return owner
    brick, columns = stud_columns(assembly.bricks, assembly.catalogue)
    some = wedge[brick] & ~column_facts(assembly.bricks, assembly.catalogue).foot
    x, y, z = (columns[some] - assembly.graph.low).T
    owner = owner.copy()
    owner[z, y, x] = NOBODY
    return owner


def _wedges(assembly: Assembly) -> Mask:
    """Return which bricks are wedge plates, (n,)."""
    return np.array([part.wedge for part in assembly.catalogue.parts])[assembly.bricks.part]


def _lowest(assembly: Assembly, columns: Rows, bears: Mask) -> Mask:
    """Return which stud squares that bear something are on the ground."""
    feet = columns[column_facts(assembly.bricks, assembly.catalogue).foot, 2]
    lowest: Mask = bears & (columns[:, 2] == feet.min(initial=np.iinfo(np.int32).max))
    return lowest


def _table(assembly: Assembly, brick: Rows, columns: Rows) -> ContactForces:
    """Return the pushes at the corners of the lowest bricks, each leaning four ways as far as friction goes."""
    standing = _lowest(assembly, columns, column_facts(assembly.bricks, assembly.catalogue).foot)
    wedge = _wedges(assembly)
    boxes = standing & ~wedge[brick]
    around = np.array([(0, 0), (0, 1), (1, 0), (1, 1)])
    places = _moved(columns, assembly.bricks, brick)[boxes, None, :2] + around
    corners = np.column_stack([np.repeat(brick[boxes], 4), places.reshape(-1, 2)])
    corners, cells = np.unique(corners, axis=0, return_counts=True)
    # the outline turns outwards where a corner belongs to one cell alone; no force needs another corner
    corners = np.concatenate([corners[cells == 1], *_outlines(assembly, np.unique(brick[standing & wedge[brick]]))])
    points = np.column_stack(
        [corners[:, 1:], np.full(len(corners), columns[standing, 2].min(initial=0) * PLATE / STUD)]
    )
    ways = ((TABLE_FRICTION, 0, 1), (-TABLE_FRICTION, 0, 1), (0, TABLE_FRICTION, 1), (0, -TABLE_FRICTION, 1))
    directions = np.tile(np.array(ways, dtype=np.float64), (len(corners), 1, 1))
    return _forces(corners[:, 0], np.full(len(corners), NOBODY), points, directions, 0.0)


def _outlines(assembly: Assembly, wedges: Rows) -> Iterator[Floats]:
    """Yield the rows of some wedge plates with the corners of their outlines in studs, (k, 3)."""
    bricks, parts = assembly.bricks, assembly.catalogue.parts
    for row in wedges.tolist():
        part = parts[bricks.part[row]]
        corners = turned(part, int(bricks.turn[row]), outline(part)) + (bricks.corner[row] + bricks.shift[row])[:2]
        yield np.insert(corners, 0, row, axis=1)


def _baseplate(assembly: Assembly, brick: Rows, columns: Rows, narrow: Mask, clutch: float) -> ContactForces:
    """Return the forces between the lowest bricks and the studs of a plate that never moves."""
    facts = column_facts(assembly.bricks, assembly.catalogue)
    held = _lowest(assembly, columns, facts.foot | facts.socket)
    places = _moved(columns, assembly.bricks, brick)[held]
    return _grips(brick[held], np.full(np.count_nonzero(held), NOBODY), places, narrow, clutch)


def _forces(
    on: NDArray[np.integer], by: NDArray[np.integer], point: Floats, directions: Floats, least: float
) -> ContactForces:
    """Return several forces at each of some points, given their directions, (n, n_forces, 3), one after the other."""
    n, n_forces, _ = directions.shape
    return ContactForces(
        np.repeat(on, n_forces).astype(np.int64),
        np.repeat(by, n_forces).astype(np.int64),
        np.repeat(point, n_forces, axis=0).astype(np.float64),
        directions.reshape(-1, 3),
        np.full(n * n_forces, least),
    )


def _joined(*parts: ContactForces) -> ContactForces:
    return ContactForces(*(np.concatenate([getattr(part, name) for part in parts]) for name in ContactForces.__slots__))


def _among(contacts: ContactForces, rows: Ints, n_bricks: int) -> ContactForces:
    """Keep the forces between bricks of which the rows are given, and count bodies by them."""
    # one more place, which NOBODY points at
    body = np.full(n_bricks + 1, NOBODY)
    body[rows] = np.arange(len(rows))
    on, by = body[contacts.on], body[contacts.by]
    kept = (on != NOBODY) & ((by != NOBODY) | (contacts.by == NOBODY))
    return ContactForces(on[kept], by[kept], contacts.point[kept], contacts.direction[kept], contacts.least[kept])


def matrix_of(contacts: ContactForces, middle: Floats) -> csc_array:
    """Return the equations of bodies, given their middles, (n, 3): each force adds to one body and takes from another.

    Returns
    -------
    (6 n, k) sparse float64 array
        As ``Statics.matrix``.
    """
    shape = EQUATIONS * len(middle), len(contacts.on)
    bodies = np.stack([contacts.on, contacts.by], axis=1)
    levers = contacts.point[:, None] - middle[bodies]
    force = np.repeat(contacts.direction[:, None], 2, axis=1)
    values = np.concatenate([force, np.cross(levers, force)], axis=2)
    values[:, 1] *= -1
    entries = (values != 0) & (bodies != NOBODY)[:, :, None]
    index = bodies[:, :, None] * EQUATIONS + np.arange(EQUATIONS)
    start = np.concatenate([[0], np.cumsum(np.count_nonzero(entries, axis=(1, 2)))])
    return csc_array((values[entries], index[entries], start), shape=shape)
