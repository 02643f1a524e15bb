"""The forces between the bricks as linear equations: what pushes and pulls where, and what has to be in balance.

The model of Liu et al., "StableLego: Stability Analysis of Block Stacking
Assembly" (2024), after Luo et al., "Legolization" (2015): every brick is a
rigid body that must be in balance under its weight and the forces at its
contacts. Their pair of forces at a contact point, a push and a friction that
never act together, is one number here, push less friction, which is the same
without products of unknowns. Their horizontal forces at the studs of one pair
of bricks are added up, which is the same again, because the torque about the
vertical is not in the model.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY, Assembly, Bricks, Catalogue, ContactGraph, Rows, middles, stud_columns
from ..units import PLATE, STUD

GRAVITY: Final = 9.81
"""N/kg."""

HOLD: Final = 0.98
"""Pull in N that the friction of one contact point bears; StableLego measured it."""

CAUTIOUS_HOLD: Final = 0.70
"""The same in N, as Luo et al. measured it on bricks that hold less."""

TABLE_FRICTION: Final = 0.2
"""Horizontal over vertical force that a table bears before a brick slides: low for ABS on wood or plastic."""

EQUATIONS: Final = 5
"""Of each brick: the sums of forces along x, y, z and of torques about x, y."""

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
        holds as well, minus infinity of what pushes and pulls.
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
    matrix : (5 n, k) sparse float64 array
        What each force adds to the sums of each brick: forces along x, y, z, and
        torques about x, y through its middle, those in N at the lever of a stud
        (8 mm).
    loads : (5 n,) float64 array
        The same of weights and loads, in N and N times 8 mm.
    contacts : NearContacts
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
) -> Statics:
    """Set up the balance of all bricks that hang together with the ground.

    Parameters
    ----------
    assembly : Assembly
        The model. Its lowest plate is the ground.
    graph : ContactGraph
        Cells and components of the bricks.
    clutch : float
        Pull in N that one contact point bears.
    ground : Ground
        What the lowest bricks stand on.
    loads : (n_bricks, 3) float64 array, optional
        More forces on the bricks, in N at their centres of mass, x, y and z up.

    Returns
    -------
    Statics
        The equations. Bricks that float are not in them.
    """
    squares = stud_columns(assembly.bricks, assembly.catalogue)
    middle, rows = _centres(assembly.bricks, assembly.catalogue), np.flatnonzero(assembly.graph.grounded)
    narrow = np.array([part.width < 2 for part in assembly.catalogue.parts])[assembly.bricks.part]
    standing = squares[1][:, 2] == squares[1][:, 2].min(initial=np.iinfo(np.int32).max)
    feet = squares[0][standing], squares[1][standing]
    contacts = _joined(
        *_studs(assembly.bricks, assembly.graph, *squares, narrow, clutch),
        *_sides(assembly.graph),
        *(_table(*feet) if ground is Ground.TABLE else _baseplate(*feet, narrow, clutch)),
    )
    contacts = _among(contacts, rows, len(assembly.bricks))
    weight = np.zeros((len(assembly.bricks), EQUATIONS))
    weight[:, 2] = -GRAVITY * assembly.catalogue.mass[assembly.bricks.part] / 1000
    if loads is not None:
        weight[:, :3] += loads
    return Statics(_matrix(contacts, middle[rows]), weight[rows].reshape(-1), contacts, rows, middle[rows], clutch)


def _centres(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the centre of mass of each brick in studs."""
    height = np.array([part.height for part in catalogue.parts])[bricks.part]
    return np.column_stack([middles(bricks, catalogue), (bricks.corner[:, 2] + height / 2) * (PLATE / STUD)])


def _grips(columns: Rows, narrow: Mask) -> tuple[Ints, Floats]:
    """List the contact points round studs under narrow and wide bricks: row in the columns, and place in studs."""
    rows, points = [], []
    for members, grips in ((narrow, GRIPS_NARROW), (~narrow, GRIPS_WIDE)):
        of = np.flatnonzero(members)
        rows.append(np.repeat(of, len(grips)))
        places = (columns[of, None, :2] + 0.5 + grips).reshape(-1, 2)
        points.append(np.column_stack([places, columns[rows[-1], 2] * (PLATE / STUD)]))
    return np.concatenate(rows), np.concatenate(points)


def _studs(
    bricks: Bricks, graph: ContactGraph, brick: Rows, columns: Rows, narrow: Mask, clutch: float
) -> tuple[ContactForces, ...]:
    """Return the contact points round all studs, and the horizontal forces of each pair of bricks."""
    x, y, z = (columns - graph.low).T
    # below the lowest plate the look-up would start again at the top
    lower = np.where(z > 0, graph.owner[z - 1, y, x], NOBODY)
    held = (lower != NOBODY) & (lower != brick)
    brick, columns, lower = brick[held], columns[held], lower[held]
    of, points = _grips(columns, narrow[brick])
    below, above = graph.pairs.T
    plane = np.zeros((len(below), 3))
    plane[:, 2] = bricks.corner[above, 2] * (PLATE / STUD)
    return (
        _along((0, 0, 1), brick[of], lower[of], points, -clutch),
        _along((1, 0, 0), above, below, plane, -np.inf),
        _along((0, 1, 0), above, below, plane, -np.inf),
    )


def _sides(graph: ContactGraph) -> tuple[ContactForces, ...]:
    """Return a push for each pair of bricks side by side, at the bottom of where they touch as in StableLego."""
    owner, (low_x, low_y, low_z) = graph.owner, graph.low
    made = []
    for axis, direction in ((2, (1, 0, 0)), (1, (0, 1, 0))):
        stride = owner.strides[axis] // owner.itemsize
        cells = np.flatnonzero(owner.take(np.arange(owner.shape[axis] - 1), axis) != NOBODY)
        shape = list(owner.shape)
        shape[axis] -= 1
        z, y, x = np.unravel_index(cells, shape)
        cells = np.ravel_multi_index((z, y, x), owner.shape)
        first, second = owner.reshape(-1)[cells], owner.reshape(-1)[cells + stride]
        touching = (second != NOBODY) & (first != second)
        # cells run upwards, so the first of a pair is its lowest
        pairs = first[touching].astype(np.int64) * (owner.max(initial=0) + 1) + second[touching]
        _, lowest = np.unique(pairs, return_index=True)
        at = np.column_stack([x, y, z])[touching][lowest] + (low_x, low_y, low_z)
        points = at * (1, 1, PLATE / STUD)
        made.append(_along(direction, second[touching][lowest], first[touching][lowest], points, 0.0))
    return tuple(made)


def _table(brick: Rows, columns: Rows) -> tuple[ContactForces, ...]:
    """Return the pushes at the corners of the lowest bricks, each leaning four ways as far as friction goes."""
    around = np.array([(0, 0), (0, 1), (1, 0), (1, 1)])
    corners = np.column_stack([np.repeat(brick, 4), (columns[:, None, :2] + around).reshape(-1, 2)])
    corners, cells = np.unique(corners, axis=0, return_counts=True)
    # the outline turns outwards where a corner belongs to one cell alone; no force needs another corner
    corners = corners[cells == 1]
    points = np.column_stack([corners[:, 1:], np.full(len(corners), columns[:, 2].min(initial=0) * PLATE / STUD)])
    leaning = ((TABLE_FRICTION, 0, 1), (-TABLE_FRICTION, 0, 1), (0, TABLE_FRICTION, 1), (0, -TABLE_FRICTION, 1))
    nobody = np.full(len(corners), NOBODY)
    return tuple(_along(way, corners[:, 0], nobody, points, 0.0) for way in leaning)


def _baseplate(brick: Rows, columns: Rows, narrow: Mask, clutch: float) -> tuple[ContactForces, ...]:
    """Return the forces between the lowest bricks and the studs of a plate that never moves."""
    of, points = _grips(columns, narrow[brick])
    standing, first = np.unique(brick, return_index=True)
    nobody, plane = np.full(len(brick), NOBODY), columns[first] * np.array([1, 1, PLATE / STUD])
    return (
        _along((0, 0, 1), brick[of], nobody[of], points, -clutch),
        _along((1, 0, 0), standing, nobody[first], plane, -np.inf),
        _along((0, 1, 0), standing, nobody[first], plane, -np.inf),
    )


def _along(
    direction: tuple[float, float, float],
    on: NDArray[np.integer],
    by: NDArray[np.integer],
    point: Floats,
    least: float,
) -> ContactForces:
    return ContactForces(
        on.astype(np.int64),
        by.astype(np.int64),
        point.astype(np.float64),
        np.broadcast_to(np.array(direction, dtype=np.float64), (len(on), 3)),
        np.full(len(on), least),
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


def _matrix(contacts: ContactForces, middle: Floats) -> csc_array:
    """Return the equations: each force adds to one body and takes from another."""
    n, shape = len(contacts.on), (EQUATIONS * len(middle), len(contacts.on))
    bodies = np.stack([contacts.on, contacts.by], axis=1)
    levers = contacts.point[:, None] - middle[bodies]
    x, y, z = np.moveaxis(levers, 2, 0)
    force_x, force_y, force_z = contacts.direction.T[:, :, None]
    values = np.empty((n, 2, EQUATIONS))
    values[:, :, :3] = contacts.direction[:, None]
    values[:, :, 3] = y * force_z - z * force_y
    values[:, :, 4] = z * force_x - x * force_z
    values[:, 1] *= -1
    entries = (values != 0) & (bodies != NOBODY)[:, :, None]
    index = bodies[:, :, None] * EQUATIONS + np.arange(EQUATIONS)
    start = np.concatenate([[0], np.cumsum(np.count_nonzero(entries, axis=(1, 2)))])
    return csc_array((values[entries], index[entries], start), shape=shape)
