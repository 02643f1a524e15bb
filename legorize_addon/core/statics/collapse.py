"""Proof that a model falls: a motion in which the weight wins more than every contact can take.

A motion gives each brick a velocity along x, y, z and a turning about x, y, z. If
no contact point is pressed in, and the loads do more work than friction can take
at the contacts that open, then no forces can be in balance: the principle of virtual work, or Farkas' lemma on the
equations of ``statics``. Such a motion is found by the search of
``equilibrium`` or by a linear programme, and confirmed here whoever found it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csc_array, csr_array, eye_array, hstack

from ..arrays import Floats, Ints
from ..model import NOBODY
from .forces import Statics

TOLERANCE: Final = 1e-6
"""N. Distance of a linear programme from the bounds, against its own tolerance of 1e-7."""

GREATEST_FORCE: Final = 1000.0
"""N. A proof rules out all forces up to this one, which no brick would survive; rounding allows for no more."""


def is_collapse(statics: Statics, motion: Floats) -> bool:
    """Confirm that a motion rules out every balance of forces up to ``GREATEST_FORCE``.

    Parameters
    ----------
    statics : Statics
        The equations.
    motion : (6 n,) float64 array
        Velocity along x, y, z and turning about x, y, z of each body.

    Returns
    -------
    bool
        Whether the loads do more work than forces at the contacts can take,
        each at its least where it opens and at the greatest where it closes.
    """
    # work of each force per newton
    opening = statics.matrix.T @ motion
    against = np.where(opening > 0, np.maximum(statics.contacts.least, -GREATEST_FORCE), GREATEST_FORCE)
    return bool(statics.loads @ motion + opening @ against > 0)


@dataclass(frozen=True, slots=True, eq=False)
class CollapseProgram:
    """What a linear programme came to.

    Attributes
    ----------
    across : (m,) int64 array
        Forces between lumps, or on them from the ground.
    forces : (k,) float64 array
        Those of them in N that leave the least out of balance; 0 of all others.
    motion : (6 n,) float64 array
        Dual of the balance of each body: a collapse where balance is impossible.
    imbalance : float
        Sum of what is out of balance, in N.
    """

    across: Ints
    forces: Floats
    motion: Floats
    imbalance: float


def least_imbalance(statics: Statics, lump: Ints, *, reserve: float = 0.0) -> CollapseProgram | None:
    """Minimise what is out of balance on lumps of bodies, each as stiff as one body, by HiGHS.

    Lumps can move in fewer ways than their bodies, but a motion of them is one of
    the bodies: what proves that the lumps fall proves that the model falls.

    Parameters
    ----------
    statics : Statics
        The equations.
    lump : (n,) int64 array
        Number of the lump that each body belongs to, without gaps from 0.
    reserve : float
        Share of the least of each force, of which the sign is less than 0, to stay away from it.

    Returns
    -------
    CollapseProgram or None
        Forces and motion, or ``None`` if HiGHS gave up.
    """
    contacts = statics.contacts
    across = np.flatnonzero((contacts.by == NOBODY) | (lump[contacts.on] != lump[contacts.by]))
    together = _lumped(statics, lump)
    matrix = csc_array(together @ statics.matrix[:, across])
    slack = eye_array(matrix.shape[0], format="csc")
    least = np.concatenate([contacts.least[across] * (1 - reserve) + TOLERANCE, np.zeros(2 * matrix.shape[0])])
    solved = linprog(
        np.repeat([0.0, 1.0], [len(across), 2 * matrix.shape[0]]),
        A_eq=hstack([matrix, slack, -slack], format="csc"),
        b_eq=-(together @ statics.loads),
        bounds=np.column_stack([least, np.full(len(least), np.inf)]),
        method="highs-ds",
        # takes longer here than it saves
        options={"presolve": False},
    )
    if solved.status != 0:
        return None
    forces = np.zeros(len(contacts.least))
    forces[across] = solved.x[: len(across)]
    return CollapseProgram(across, forces, -(together.T @ solved.eqlin.marginals), float(solved.fun))


def _lumped(statics: Statics, lump: Ints) -> csr_array:
    """Return what adds up the sums of bodies to those of lumps, each about the middle of its bodies."""
    n, size = len(lump), len(statics.loads) // max(len(lump), 1)
    members = np.bincount(lump)
    centre = np.stack([np.bincount(lump, of) / members for of in statics.middle.T], axis=1)
    x, y, z = (statics.middle - centre[lump]).T
    # torque of which force about which axis, as in the equations of a body
    levers = {3: ((1, 0, y), (2, 0, -x)), 6: ((3, 2, y), (3, 1, -z), (4, 0, z), (4, 2, -x), (5, 1, x), (5, 0, -y))}
    entries = [*((row, row, np.ones(n)) for row in range(size)), *levers[size]]
    rows = np.concatenate([lump * size + row for row, _, _ in entries])
    columns = np.concatenate([np.arange(n) * size + column for _, column, _ in entries])
    shape = len(members) * size, n * size
    return csr_array((np.concatenate([values for *_, values in entries]), (rows, columns)), shape=shape)


def least_clutch(statics: Statics) -> float:
    """Return the least hold of a contact point with which the model would stand, by HiGHS.

    Parameters
    ----------
    statics : Statics
        The equations; their own hold does not matter. Some hundred bricks take
        seconds, more take minutes.

    Returns
    -------
    float
        N; infinity if no hold suffices, because the model tips over.
    """
    least = statics.contacts.least
    # every grip is a push less its share of the clutch, which is one more unknown
    clutch = csc_array((statics.matrix @ (least / statics.clutch))[:, None])
    bounds = np.full((len(least) + 1, 2), (0.0, np.inf))
    solved = linprog(
        np.repeat([0.0, 1.0], [len(least), 1]),
        A_eq=hstack([statics.matrix, clutch], format="csc"),
        b_eq=-statics.loads,
        bounds=bounds,
        method="highs",
    )
    return float(solved.x[-1]) if solved.status == 0 else float(np.inf)
