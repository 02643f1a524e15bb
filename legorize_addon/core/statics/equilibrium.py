"""Forces in balance: found by projections, confirmed by a check that shares nothing with the search.

The search looks for a point in both the plane of all forces in balance and the
box of all forces that contacts bear. Douglas-Rachford splitting (ADMM of a
feasibility problem, over-relaxed) projects on one and the other by turns; the
plane needs one sparse factorisation for all turns. Where the two sets have no
point in common, the way from the box to the plane tends to the shortest one,
and this is the motion by which the model collapses (see ``collapse``).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Final, NamedTuple

import numpy as np
from scipy.sparse import csc_array, csr_array, eye_array

from ..arrays import Floats
from ..model import NOBODY
from ..progress import Progress, part, silent
from .cholesky import Cholesky
from .collapse import is_collapse
from .forces import EQUATIONS, Statics

RESIDUAL: Final = 1e-8
"""Greatest sum of forces on a brick in N, and of torques in N times 8 mm, that counts as balance."""


RELAXATION: Final = 1.8
"""Over-relaxation of the projections, between 1 and 2."""

LEAST_PUSH: Final = 0.02
"""N; a like share of it is aimed at where a contact only pushes, so that the end is reached and not only neared."""

WEIGHT_SIDE: Final = 0.5
"""How freely pushes between bricks side by side may grow, against 1 at a contact point; tried out on built models."""

WEIGHT_GROUND: Final = 0.25
"""The same of forces from the ground."""

TINY: Final = 1e-9
"""Added to the diagonal where forces leave a sum undetermined, against about 1 of the diagonal itself."""

PAUSE: Final = 10
"""Turns between two looks at progress and at whether the model collapses."""

STAGNATION: Final = 0.9
"""Share of the distance between box and plane that is left after so many looks when the search is given up."""

STAGNATION_LOOKS: Final = 5

FACTORS: Final = 0.3
"""Share of the work shown as done when the equations are factorised and the search begins: the half of bulky
models, next to nothing of thin ones."""


class Aim(NamedTuple):
    """What the search tries to reach.

    Attributes
    ----------
    share : float
        Share of the hold to leave unused: where the projections aim.
    enough : float
        Share with which the aim counts as reached, a little less, because
        projections near their aim without end.
    turns : int
        Turns to try it for.
    """

    share: float
    enough: float
    turns: int


SPARE: Final = 0.2
"""Share of the clutch that a model should leave unused."""

AIMS: Final = (Aim(0.5, 0.3, 12), Aim(0.25, SPARE, 40), Aim(0.01, 0.0, 300))
"""A margin that is easily reached, the one that a model should have, and then any balance."""


SOON: Final = (Aim(0.5, 0.3, 12), Aim(0.25, 0.0, 20), Aim(0.01, 0.0, 0))
"""The same where any balance will do, and what is weak is told soon instead."""


@dataclass(frozen=True, slots=True, eq=False)
class Balance:
    """What the search came to.

    Attributes
    ----------
    forces : (k,) float64 array
        Forces in balance in N; they keep every bound if ``found``.
    found : bool
        Whether they do, as the search sees it.
    motion : (6 n,) float64 array
        Way of least resistance: zero if ``found``.
    collapse : bool
        Whether the motion proves that the model collapses.
    turns : int
        Projections on the plane.
    upright : bool
        Whether the forces are known to act along the vertical alone.
    """

    forces: Floats
    found: bool
    motion: Floats
    collapse: bool
    turns: int
    upright: bool = False


class Plane:
    """All forces in balance, as an affine plane that one can project on.

    Parameters
    ----------
    statics : Statics
        The equations.
    progress : Progress
        Told how far they are factorised; may cancel it.
    """

    def __init__(self, statics: Statics, progress: Progress = silent) -> None:
        self.weight = _weights(statics)
        self._across = csr_array(statics.matrix.multiply(self.weight))
        self._along = csc_array(self._across.T).tocsr()
        self._loads = statics.loads
        n = len(self._loads)
        square = csc_array(self._across @ self._along + TINY * eye_array(n))
        self._factor = Cholesky(square, statics.middle, partial(progress, "stability"))

    def solve(self, sums: Floats) -> Floats:
        """Return the motion of the bricks that would balance sums of forces, shape (6 n,)."""
        return self._factor.solve(sums)

    def project(self, forces: Floats) -> Floats:
        """Return the nearest forces in balance, all divided by their weights."""
        nearest: Floats = forces - self._along @ self.solve(self._across @ forces + self._loads)
        return nearest

    def motion(self, forces: Floats) -> Floats:
        """Return the motion of which the ways at the contacts come nearest to given ones."""
        return self.solve(self._across @ forces)


def _weights(statics: Statics) -> Floats:
    """Return a weight for each force: cheap ones carry more of the load."""
    least, by = statics.contacts.least, statics.contacts.by
    weight = np.where(least == 0, WEIGHT_SIDE, 1.0)
    weight[by == NOBODY] = WEIGHT_GROUND
    return weight


def balance(
    statics: Statics,
    *,
    aims: tuple[Aim, ...] = AIMS,
    start: Floats | None = None,
    plane: Plane | None = None,
    progress: Progress = silent,
) -> Balance:
    """Search for forces in balance that every contact bears.

    Parameters
    ----------
    statics : Statics
        The equations.
    aims : tuple of Aim
        What to try, one after the other; the first that is reached ends the search.
    start : (k,) float64 array, optional
        Forces in N to start from, such as those of a model that is nearly the
        same; without them the lightest that are in balance.
    plane : Plane, optional
        Of the same equations, if it was made before.
    progress : Progress
        Told how far the search is; may cancel it.

    Returns
    -------
    Balance
        The forces, or the motion by which the model collapses, or neither.
    """
    progress("stability", 0.0)
    if plane is None:
        plane, progress = Plane(statics, part(progress, 0.0, FACTORS)), part(progress, FACTORS, 1.0)
        progress("stability", 0.0)
    near = plane.project(np.zeros(len(plane.weight)) if start is None else start / plane.weight)
    forces = near
    motion, turns, most = np.zeros(len(statics.loads)), 0, sum(aim.turns for aim in aims)
    found = collapse = False
    for aim in aims:
        target, enough = (_box(statics, share) / plane.weight for share in (aim.share, aim.enough))
        gaps: list[float] = []
        for _ in range(aim.turns):
            found = bool((forces >= enough).all())
            if found or collapse or _stagnates(gaps):
                break
            progress("stability", turns / most)
            inside = np.maximum(near, target)
            forces = plane.project(2 * inside - near)
            near = near + RELAXATION * (forces - inside)
            turns += 1
            if turns % PAUSE == 0:
                gaps.append(float(np.linalg.norm(forces - inside)))
                motion = plane.motion(inside - forces)
                collapse = is_collapse(statics, motion)
        if found or collapse:
            break
    return _settled(statics, plane, forces, motion, collapse, turns)


def _settled(statics: Statics, plane: Plane, forces: Floats, motion: Floats, collapse: bool, turns: int) -> Balance:
    """Take the rounding of many turns out, to be well within what counts as balance."""
    forces = plane.project(plane.project(forces)) * plane.weight
    found = bool((forces >= statics.contacts.least).all())
    return Balance(forces, found, np.zeros_like(motion) if found else motion, collapse, turns)


def _box(statics: Statics, share: float) -> Floats:
    """Return the least forces if a share of the hold is to be left; without a share just the bounds."""
    least = statics.contacts.least
    if share == 0:
        return least
    return np.where(least < 0, least * (1 - share), share * LEAST_PUSH)


def _stagnates(gaps: list[float]) -> bool:
    return len(gaps) > STAGNATION_LOOKS and gaps[-1] > STAGNATION * gaps[-1 - STAGNATION_LOOKS]


def residual(statics: Statics, forces: Floats) -> Floats:
    """Add up forces and torques on each body, without the matrix of the equations.

    Parameters
    ----------
    statics : Statics
        Contacts, loads and middles of the bodies.
    forces : (k,) float64 array
        Value of each force in N.

    Returns
    -------
    (n, 6) float64 array
        Sums of forces along x, y, z in N and of torques about x, y, z in N times
        8 mm; all zero in balance.
    """
    contacts, n = statics.contacts, len(statics.rows)
    sums = statics.loads.reshape(n, EQUATIONS).copy()
    vectors = contacts.direction * forces[:, None]
    for bodies, sign in ((contacts.on, 1.0), (contacts.by, -1.0)):
        real = bodies != NOBODY
        at, force = bodies[real], sign * vectors[real].T
        x, y, z = (contacts.point[real] - statics.middle[at]).T
        torques = (y * force[2] - z * force[1], z * force[0] - x * force[2], x * force[1] - y * force[0])
        for column, values in enumerate((*force, *torques)):
            sums[:, column] += np.bincount(at, values, n)
    return sums


def is_equilibrium(statics: Statics, forces: Floats) -> bool:
    """Confirm that forces are in balance and that every contact bears its own.

    Parameters
    ----------
    statics : Statics
        Contacts, loads and middles of the bodies.
    forces : (k,) float64 array
        Value of each force in N.

    Returns
    -------
    bool
        Whether all sums are within ``RESIDUAL`` and no force is less than its
        least, by whatever amount.
    """
    balanced = np.abs(residual(statics, forces)).max(initial=0) <= RESIDUAL
    return bool(balanced and (forces >= statics.contacts.least).all())
