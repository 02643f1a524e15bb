"""Whether the model stands: a verdict that can be checked, how much each brick has left, what is weak.

"Stable" comes with forces in balance that every contact bears, "collapses" with
a motion that no forces can stop; both are confirmed by checks apart from the
search. Whatever gets neither within bounded work is "undecided".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..model import NOBODY, Assembly, ContactGraph
from ..model import UNSUPPORTED as UNSUPPORTED
from ..model import Verdict as Verdict
from ..native import one_thread
from ..progress import Progress, silent
from .collapse import is_collapse, least_imbalance
from .equilibrium import AIMS, Aim, Balance, Plane, balance, is_equilibrium, residual
from .forces import EQUATIONS, HOLD, Ground, Statics, statics
from .tipping import tipping, toppling

PROGRAMME: Final = 600
"""Bricks that a linear programme takes in a second; where projections leave it open, it decides smaller models."""

RESERVE: Final = 1e-6
"""How far in N the linear programme stays away from the bounds, against its own tolerance of 1e-7."""

TORN: Final = 0.01
"""Share of the widest gap of a collapse from which on a contact counts as torn."""

ROUNDING: Final = 1e-6
"""Gap that is none, when the fastest brick moves by 1."""


@dataclass(frozen=True, slots=True, eq=False)
class Stability:
    """Whether a model stands, and the proof.

    Attributes
    ----------
    component : (n,) int64 array
        Component of each brick.
    margin : (n,) float64 array
        Share of the friction left at the worst contact of each brick, under the
        forces of the proof: at least so much, because other forces may share the
        load better. 1 where nothing pulls; less than 0 where a contact bears less
        than it would have to; ``UNSUPPORTED`` for what hangs in the air.
    standing : Verdict
        Of the bricks that hang together with the ground, by themselves.
    unsupported : (m,) int64 array
        Rows of the bricks that hang in the air, which fall in any case.
    forces : (k,) float64 array
        Forces of ``statics`` in N: in balance, and borne by every contact if the
        model is stable.
    yielding : (n, 5) float64 array
        Velocity along x, y, z and turning about x, y of each brick in the motion
        that the contacts stop least, the greatest being 1: the proof of a
        collapse, or where the search left it undecided; 0 of what is stable.
    torn : (m, 2) int64 array
        Lower and upper brick of each contact that the collapse tears open, widest
        first: where to strengthen. ``NOBODY`` is a baseplate. Empty if nothing
        is proven to collapse, or if it only tips over.
    residual : float
        Greatest sum of forces on a brick in N, or of torques in N times 8 mm.
    iterations : int
        Projections that the search took.
    tipping : (n_components,) float64 array
        Distance in mm from where the weight and the loads of each component meet
        the ground to the outline of its feet: less than 0 outside of it, and not
        a number for what hangs in the air.
    statics : Statics
        The equations, for whoever wants to check.
    """

    component: Ints
    margin: Floats
    standing: Verdict
    unsupported: Ints
    forces: Floats
    yielding: Floats
    torn: Ints
    residual: float
    iterations: int
    tipping: Floats
    statics: Statics

    @property
    def verdict(self) -> Verdict:
        """Verdict on all bricks: what hangs in the air falls."""
        return Verdict.COLLAPSES if len(self.unsupported) else self.standing

    @property
    def stable(self) -> bool:
        """Whether the model is proven to stand."""
        return self.verdict is Verdict.STABLE

    @property
    def motion(self) -> Floats:
        """Motion of the bricks as the model collapses, (n, 5), as in ``yielding``; 0 unless that is proven."""
        return self.yielding if self.standing is Verdict.COLLAPSES else np.zeros_like(self.yielding)

    @property
    def enough_clutch(self) -> float:
        """Hold in N with which the proof still stands, without end if there is none."""
        if not self.stable:
            return float(np.inf)
        return (1.0 - float(self.margin.min(initial=1.0))) * self.statics.clutch

    def weakest(self, count: int) -> Ints:
        """Return the rows of the bricks with the least margin, the weakest first."""
        return np.argsort(self.margin, kind="stable")[:count]

    def check(self) -> bool:
        """Confirm the verdict on the bricks that stand by its proof alone."""
        if self.standing is Verdict.STABLE:
            return is_equilibrium(self.statics, self.forces)
        if self.standing is Verdict.COLLAPSES:
            return is_collapse(self.statics, self.motion[self.statics.rows].reshape(-1))
        return True


@one_thread()
def stability(
    assembly: Assembly,
    *,
    clutch: float = HOLD,
    ground: Ground = Ground.TABLE,
    loads: Floats | None = None,
    aims: tuple[Aim, ...] = AIMS,
    start: Floats | None = None,
    programme: int = PROGRAMME,
    progress: Progress = silent,
) -> Stability:
    """Decide whether a model stands.

    Parameters
    ----------
    assembly : Assembly
        The model.
    graph : ContactGraph
        Cells and components of the bricks.
    clutch : float
        Pull in N that the friction of one contact point bears, above 0.
    ground : Ground
        What the lowest bricks stand on.
    loads : (n, 3) float64 array, optional
        Forces on the bricks besides their weight, in N at their centres of mass.
    aims : tuple of Aim
        What forces to search for, and for how long.
    start : (k,) float64 array, optional
        Forces of ``statics`` in N to start the search from.
    programme : int
        Bricks up to which a linear programme decides what projections do not.
        Of larger models it takes those that would move most, and can prove no
        more than their collapse.
    progress : Progress
        Told how far the search is; may cancel it.

    Returns
    -------
    Stability
        Verdict, proof and margins.
    """
    progress("stability", 0.0)
    equations = statics(assembly, clutch=clutch, ground=ground, loads=loads)
    found = balance(equations, aims=aims, start=start, progress=progress)
    if not found.found and not found.collapse:
        found = _toppled(equations, found, assembly.graph)
    if programme and not found.found and not found.collapse:
        progress("stability", 1.0)
        found = _programmed(equations, found, programme)
    yielding = np.zeros((len(assembly.bricks), EQUATIONS))
    if found.motion.any():
        yielding[equations.rows] = found.motion.reshape(-1, EQUATIONS) / np.abs(found.motion).max()
    return Stability(
        component=assembly.graph.component.astype(np.int64),
        margin=_margins(equations, found.forces, len(assembly.bricks)),
        standing=_verdict(equations, found),
        unsupported=np.flatnonzero(~assembly.graph.grounded),
        forces=found.forces,
        yielding=yielding,
        torn=torn_by(equations, yielding if found.collapse else np.zeros_like(yielding)),
        residual=float(np.abs(residual(equations, found.forces)).max(initial=0)),
        iterations=found.turns,
        tipping=tipping(equations, assembly.graph),
        statics=equations,
    )


def _verdict(equations: Statics, found: Balance) -> Verdict:
    """Say no more than the checks confirm."""
    if found.found and is_equilibrium(equations, found.forces):
        return Verdict.STABLE
    if found.collapse and is_collapse(equations, found.motion):
        return Verdict.COLLAPSES
    return Verdict.UNDECIDED


def _toppled(equations: Statics, found: Balance, graph: ContactGraph) -> Balance:
    """See whether it tips over as a whole: the slowest motion to find by search, and the quickest to write down."""
    motion = toppling(equations, graph)
    if not is_collapse(equations, motion):
        return found
    return Balance(found.forces, False, motion, True, found.turns)


def _programmed(equations: Statics, found: Balance, most: int) -> Balance:
    """Ask a linear programme: of all bodies if they are few, else of those that would move most."""
    n = len(equations.rows)
    moved = np.abs(found.motion).reshape(n, EQUATIONS).max(axis=1)
    bodies = np.sort(np.argsort(-moved, kind="stable")[:most])
    solved = least_imbalance(equations, bodies, reserve=RESERVE)
    if solved is None:
        return found
    if is_collapse(equations, solved.motion):
        return Balance(found.forces, False, solved.motion, True, found.turns)
    if n > most:
        return found
    plane = Plane(equations)
    forces = plane.project(solved.forces / plane.weight) * plane.weight
    if not is_equilibrium(equations, forces):
        return found
    return Balance(forces, True, np.zeros_like(found.motion), False, found.turns)


def _margins(equations: Statics, forces: Floats, n_bricks: int) -> Floats:
    """Return what is left at the worst contact of each brick, as a share of the hold."""
    contacts = equations.contacts
    bounded = np.isfinite(contacts.least)
    # a force that only pushes uses no friction, but is missing as soon as it would have to pull
    left = np.minimum(forces, 0.0) / equations.clutch + (contacts.least < 0)
    margin = np.ones(len(equations.rows))
    for bodies in (contacts.on, contacts.by):
        counted = bounded & (bodies != NOBODY) & ((contacts.least < 0) | (forces < 0))
        np.minimum.at(margin, bodies[counted], left[counted])
    all_margins = np.full(n_bricks, UNSUPPORTED)
    all_margins[equations.rows] = margin
    return all_margins


def torn_by(equations: Statics, motion: Floats) -> Ints:
    """List the pairs of bricks that a motion tears apart.

    Parameters
    ----------
    equations : Statics
        The balance of the bricks that stand.
    motion : (n, 5) float64 array
        Of all bricks.

    Returns
    -------
    (m, 2) int64 array
        Lower and upper brick, ``NOBODY`` for a baseplate; the widest gap first.
    """
    contacts = equations.contacts
    opening = equations.matrix.T @ motion[equations.rows].reshape(-1)
    opening[~np.isfinite(contacts.least) | (contacts.least == 0)] = 0
    torn = np.flatnonzero(opening > max(TORN * opening.max(initial=0), ROUNDING))
    torn = torn[np.argsort(-opening[torn], kind="stable")]
    pairs = np.column_stack([contacts.by[torn], contacts.on[torn]])
    _, first = np.unique(pairs, axis=0, return_index=True)
    pairs = pairs[np.sort(first)]
    return np.where(pairs == NOBODY, NOBODY, equations.rows[pairs])
