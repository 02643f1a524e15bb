"""Forces of a few bodies found anew, while those of all others stay as they are.

Where forces are in balance and borne by all contacts but some near each other,
only the bodies around those need other forces. A linear programme of them, with
the forces of their neighbours as loads, finds some or finds out that the region
is too small: then nothing is known of the model. Lumps (see ``search``) are the
other way round: what they cannot balance is a collapse, but what they can is no
proof yet.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from scipy.sparse import csc_array

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY
from .collapse import least_imbalance
from .equilibrium import Plane
from .forces import Statics

ROUNDING: Final = 1e-6
"""Imbalance in N, summed over all bodies, that is none."""


def region(statics: Statics, forces: Floats, bodies: Mask) -> tuple[Statics, Ints]:
    """Return the balance of some bodies under fixed forces of all others.

    Parameters
    ----------
    statics : Statics
        The balance of all bodies.
    forces : (k,) float64 array
        Forces in N; those between a body inside and one outside are loads.
    bodies : (n,) bool array
        Which bodies are inside.

    Returns
    -------
    statics : Statics
        The balance of these bodies.
    inner : (m,) int64 array
        Which of the forces are among them, or between them and the ground.
    """
    contacts, size = statics.contacts, len(statics.loads) // len(bodies)
    # NOBODY is the last one, and outside
    inside = np.append(bodies, False)
    on, by = inside[contacts.on], inside[contacts.by]
    among = on & (by | (contacts.by == NOBODY))
    equations = (np.flatnonzero(bodies)[:, None] * size + np.arange(size)).reshape(-1)
    columns, across = np.flatnonzero(among), np.flatnonzero((on | by) & ~among)
    loads = statics.loads[equations] + (statics.matrix[:, across] @ forces[across])[equations]
    number = np.append(np.cumsum(bodies) - 1, NOBODY)
    few = replace(
        contacts,
        on=number[contacts.on[columns]],
        by=number[contacts.by[columns]],
        point=contacts.point[columns],
        direction=contacts.direction[columns],
        least=contacts.least[columns],
    )
    matrix = csc_array(statics.matrix[:, columns].tocsr()[equations])
    rows, middle = statics.rows[bodies], statics.middle[bodies]
    return replace(statics, matrix=matrix, loads=loads, contacts=few, rows=rows, middle=middle), columns


def mended(statics: Statics, forces: Floats, bodies: Mask, *, reserve: float) -> Floats | None:
    """Find forces among some bodies that bring all into balance.

    Parameters
    ----------
    statics : Statics
        The balance of all bodies.
    forces : (k,) float64 array
        Forces in N, in balance and borne outside.
    bodies : (n,) bool array
        Where others are looked for.
    reserve : float
        Share of the least of each force to stay away from it.

    Returns
    -------
    (k,) float64 array or None
        In N, to be checked as a whole; ``None`` if there are none with which
        every contact inside bears its own.
    """
    part, inner = region(statics, forces, bodies)
    solved = least_imbalance(part, np.arange(len(part.rows)), reserve=reserve)
    if solved is None or solved.imbalance >= ROUNDING:
        return None
    plane = Plane(part)
    exact = plane.project(plane.project(solved.forces / plane.weight)) * plane.weight
    whole = forces.copy()
    whole[inner] = exact
    return whole
