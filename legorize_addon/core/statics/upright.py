"""The balance by upright forces alone: half of the equations and half of the forces, and enough for most models.

Weight acts upright. Where pushes and pulls along the vertical keep everything in
balance, no contact has to bear anything sideways, and the proof is found in a
fraction of the time. Where they do not, nothing is known yet.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.sparse import csc_array

from ..arrays import Floats, Ints
from .forces import EQUATIONS, Statics, matrix_of

UPRIGHT_EQUATIONS: Final = np.array([2, 3, 4])
"""Those of the equations of a brick that upright forces take part in: forces along z, torques about x, y."""


@dataclass(frozen=True, slots=True, eq=False)
class Upright:
    """The balance by upright forces.

    Attributes
    ----------
    statics : Statics
        One force a contact point, and three equations a body.
    point : (k,) int64 array
        Contact point of each force of the whole balance.
    share : (k,) float64 array
        Share that each of those has in the upright force at its point.
    """

    statics: Statics
    point: Ints
    share: Floats

    def raised(self, forces: Floats) -> Floats:
        """Return upright forces as forces of the whole balance, (k,), in N."""
        return forces[self.point] * self.share

    def lowered(self, forces: Floats) -> Floats:
        """Return the upright part of forces of the whole balance, one a contact point, in N."""
        upward = forces * self.statics.contacts.direction[self.point, 2]
        return np.bincount(self.point, upward, len(self.statics.contacts.on))

    def spread(self, motion: Floats) -> Floats:
        """Return a motion of the bodies in this balance as one in the whole, (6 n,)."""
        whole = np.zeros((len(self.statics.rows), EQUATIONS))
        whole[:, UPRIGHT_EQUATIONS] = motion.reshape(-1, len(UPRIGHT_EQUATIONS))
        return whole.reshape(-1)


def upright(statics: Statics) -> Upright | None:
    """Leave all but upright forces out of a balance.

    Parameters
    ----------
    statics : Statics
        The whole balance, in which the forces at each contact point lean against
        each other evenly.

    Returns
    -------
    Upright or None
        ``None`` where upright forces can never be enough: a load acts sideways.
    """
    sideways = np.setdiff1d(np.arange(EQUATIONS), UPRIGHT_EQUATIONS)
    if statics.loads.reshape(-1, EQUATIONS)[:, sideways].any():
        return None
    contacts = statics.contacts
    where = np.column_stack([contacts.on, contacts.by, contacts.point])
    first = np.flatnonzero(np.append(True, (where[1:] != where[:-1]).any(axis=1))[: len(where)])
    point = np.zeros(len(where), dtype=np.int64)
    point[first[1:]] = 1
    point = np.cumsum(point)
    together = np.bincount(point, minlength=len(first)).astype(np.float64)
    straight = np.zeros((len(first), 3))
    straight[:, 2] = 1
    merged = replace(
        contacts,
        on=contacts.on[first],
        by=contacts.by[first],
        point=contacts.point[first],
        direction=straight,
        least=contacts.least[first] * together,
    )
    rows = (np.arange(len(statics.rows))[:, None] * EQUATIONS + UPRIGHT_EQUATIONS).reshape(-1)
    matrix = csc_array(matrix_of(merged, statics.middle).tocsr()[rows])
    reduced = replace(statics, matrix=matrix, loads=statics.loads[rows], contacts=merged)
    return Upright(reduced, point, 1 / together[point])
