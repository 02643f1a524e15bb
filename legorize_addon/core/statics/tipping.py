"""Whether a body tips over: where its weight meets the ground, and the motion with which it falls.

What stands on a table is only pushed by it. So a body whose weight meets the
ground outside of the outline of its feet turns about the nearest edge of that
outline, as one rigid piece, however well its bricks hold together.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import Floats, Ints
from ..geometry import beyond, hull, inside
from ..model import NOBODY, ContactGraph
from ..units import STUD
from .forces import EQUATIONS, Statics


def tipping(equations: Statics, graph: ContactGraph) -> Floats:
    """Return how far inside the feet of each component its weight and loads meet the ground.

    Parameters
    ----------
    equations : Statics
        The balance of the bricks that stand.
    graph : ContactGraph
        Their components.

    Returns
    -------
    (n_components,) float64 array
        Distance to the outline of the feet in mm, less than 0 outside of it; not
        a number for what hangs in the air, minus infinity for what is lifted.
    """
    found = np.full(graph.n_components, np.nan)
    for number, members, feet in _bodies(equations, graph):
        place = _resultant(equations, members, feet[0, 2])
        found[number] = -np.inf if place is None else inside(feet[:, :2], place) * STUD
    return found


def toppling(equations: Statics, graph: ContactGraph) -> Floats:
    """Return the motion of all bodies that tip over.

    Parameters
    ----------
    equations : Statics
        The balance of the bricks that stand.
    graph : ContactGraph
        Their components.

    Returns
    -------
    (6 n,) float64 array
        Velocity along x, y, z and turning about x, y, z of each brick: each body
        turns about the edge of its outline that its weight is farthest beyond.
        0 for those that do not.
    """
    motion = np.zeros((len(equations.rows), EQUATIONS))
    for _, members, feet in _bodies(equations, graph):
        place = _resultant(equations, members, feet[0, 2])
        if place is None:
            continue
        edges = hull(feet[:, :2])
        over = beyond(edges, place)
        if over.max() > 0:
            motion[members] = _turning(equations.middle[members], edges[over.argmax()], feet[0, 2])
    return motion.reshape(-1)


def _bodies(equations: Statics, graph: ContactGraph) -> Iterator[tuple[int, Ints, Floats]]:
    """Yield each component that stands: its number, its bodies, and where its feet touch the ground, (k, 3)."""
    contacts = equations.contacts
    feet = np.flatnonzero(contacts.by == NOBODY)
    component = graph.component[equations.rows]
    for number in np.unique(component):
        below = contacts.point[feet[component[contacts.on[feet]] == number]]
        yield int(number), np.flatnonzero(component == number), below


def _resultant(equations: Statics, members: Ints, ground: float) -> Floats | None:
    """Return where all loads of a body together meet the ground, x and y in studs; None if they do not press on it."""
    force = equations.loads.reshape(-1, EQUATIONS)[members, :3]
    down = -force[:, 2].sum()
    if down <= 0:
        return None
    middle = equations.middle[members] - (0, 0, ground)
    # no torque is left about this point
    lever = middle[:, :2] * -force[:, 2:] + middle[:, 2:] * force[:, :2]
    place: Floats = lever.sum(axis=0) / down
    return place


def _turning(middle: Floats, edge: Floats, ground: float) -> Floats:
    """Return the motion of bricks that turn outwards about an edge, given its outer normal and offset, (n, 6)."""
    x, y, offset = edge
    above = middle[:, 2] - ground
    out = middle[:, :2] @ edge[:2] + offset
    still = np.ones(len(middle))
    return np.column_stack([x * above, y * above, -out, -y * still, x * still, 0 * still])
