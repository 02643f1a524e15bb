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
from scipy.sparse import csc_array, eye_array, hstack

from ..arrays import Floats, Ints
from .forces import EQUATIONS, Statics

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
    forces : (k,) float64 array
        Forces in N that leave the least out of balance; 0 where no body of the
        programme takes part.
    motion : (6 n,) float64 array
        Dual of the balance of each body: a collapse where balance is impossible.
    """

    forces: Floats
    motion: Floats


def least_imbalance(statics: Statics, bodies: Ints, *, reserve: float = 0.0) -> CollapseProgram | None:
    """Minimise what is out of balance on some of the bodies, by HiGHS.

    The others may exert any force that the contacts bear: what proves that the
    chosen ones fall proves that the model falls.

    Parameters
    ----------
    statics : Statics
        The equations.
    bodies : (m,) int64 array
        Bodies to balance.
    reserve : float
        How far in N to stay away from the least of each force.

    Returns
    -------
    CollapseProgram or None
        Forces and motion, or ``None`` if HiGHS gave up.
    """
    rows = (bodies[:, None] * EQUATIONS + np.arange(EQUATIONS)).reshape(-1)
    matrix = statics.matrix.tocsr()[rows].tocsc()
    taking_part = np.flatnonzero(np.diff(matrix.indptr))
    slack = eye_array(len(rows), format="csc")
    least = np.concatenate([statics.contacts.least[taking_part] + reserve, np.zeros(2 * len(rows))])
    solved = linprog(
        np.repeat([0.0, 1.0], [len(taking_part), 2 * len(rows)]),
        A_eq=hstack([matrix[:, taking_part], slack, -slack], format="csc"),
        b_eq=-statics.loads[rows],
        bounds=np.column_stack([least, np.full(len(least), np.inf)]),
        method="highs",
    )
    if solved.status != 0:
        return None
    forces, motion = np.zeros(len(statics.contacts.least)), np.zeros(len(statics.loads))
    forces[taking_part] = solved.x[: len(taking_part)]
    motion[rows] = -solved.eqlin.marginals
    return CollapseProgram(forces, motion)


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
