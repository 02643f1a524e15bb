"""Whether the model stands: a verdict that can be checked, how much each brick has left, what is weak.

"Stable" comes with forces in balance that every contact bears, and that act at
studs and on the ground alone. "Wedged" comes with such forces too, but some of
them are pushes between bricks side by side: a weaker proof, since it takes
neighbours without a gap. "Collapses" comes with a motion that no forces can stop,
pushes of neighbours included. All are confirmed by checks apart from the search;
whatever gets none within bounded work is "undecided".
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY, Assembly
from ..model import UNSUPPORTED as UNSUPPORTED
from ..model import Verdict as Verdict
from ..native import one_thread
from ..progress import Progress, silent
from .collapse import is_collapse
from .equilibrium import AIMS, Aim, Balance, is_equilibrium, residual
from .forces import EQUATIONS, HOLD, Ground, Statics, statics
from .search import ROUNDS, Kind, Work, search
from .tipping import tipping
from .transfer import transferred

PROGRAMME: Final = 300
"""Bricks that a linear programme takes in a second; where projections leave it open, it decides smaller models."""

TORN: Final = 0.01
"""Share of the widest gap of a collapse from which on a contact counts as torn."""

MOVING: Final = 1e-3
"""Share of the fastest motion from which on a brick counts as moving."""

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
        model is stable or wedged.
    yielding : (n, 6) float64 array
        Velocity along x, y, z and turning about x, y, z of each brick in the
        motion that the contacts stop least, the greatest being 1: the proof of a
        collapse, or where the search left it undecided; of what is wedged the
        motion that studs alone stop least; 0 of what is stable.
    torn : (m, 2) int64 array
        Lower and upper brick of each contact that this motion tears open, widest
        first: where to strengthen. ``NOBODY`` is a baseplate. Empty if it is no
        proof that studs alone do not bear the model, or if it only tips over.
    residual : float
        Greatest sum of forces on a brick in N, or of torques in N times 8 mm.
    iterations : int
        Projections that the search took.
    upright : bool
        Whether the forces of the proof act along the vertical alone: in any
        other model of the forces at studs they hold as well.
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
    upright: bool
    tipping: Floats
    statics: Statics

    @property
    def verdict(self) -> Verdict:
        """Verdict on all bricks: what hangs in the air falls."""
        return Verdict.COLLAPSES if len(self.unsupported) else self.standing

    @property
    def stable(self) -> bool:
        """Whether the model is proven to stand by its studs alone."""
        return self.verdict is Verdict.STABLE

    @property
    def stands(self) -> bool:
        """Whether the model is proven to stand, be it while neighbours press on each other."""
        return self.verdict in (Verdict.STABLE, Verdict.WEDGED)

    @property
    def moves(self) -> Mask:
        """Which bricks move in the motion that studs alone stop least, (n,)."""
        moving: Mask = (np.abs(self.yielding) > MOVING).any(axis=1)
        return moving

    @property
    def margin_by_studs(self) -> Floats:
        """Margin of each brick, (n,), but 0 where nothing but its neighbours holds it."""
        if self.standing is not Verdict.WEDGED:
            return self.margin
        return np.where(self.moves, np.minimum(self.margin, 0.0), self.margin)

    @property
    def motion(self) -> Floats:
        """Motion of the bricks as the model collapses, (n, 6), as in ``yielding``; 0 unless that is proven."""
        return self.yielding if self.standing is Verdict.COLLAPSES else np.zeros_like(self.yielding)

    @property
    def enough_clutch(self) -> float:
        """Hold in N with which the proof still stands, without end if there is none."""
        if not self.stands:
            return float(np.inf)
        return (1.0 - float(self.margin.min(initial=1.0))) * self.statics.clutch

    def weakest(self, count: int) -> Ints:
        """Return the rows of the bricks with the least margin, the weakest first."""
        return np.argsort(self.margin, kind="stable")[:count]

    def check(self) -> bool:
        """Confirm the verdict on the bricks that stand by its proof alone."""
        if self.standing in (Verdict.STABLE, Verdict.WEDGED):
            return is_equilibrium(self.statics, self.forces)
        if self.standing is Verdict.COLLAPSES:
            return is_collapse(self.statics, self.motion[self.statics.rows].reshape(-1))
        return True


@dataclass(frozen=True, slots=True, eq=False)
class Effort:
    """How a proof is searched for.

    Attributes
    ----------
    aims : tuple of Aim
        What forces to search for, and for how long.
    near : Stability or None
        How a model stands that is the same or nearly so: the search starts from
        its forces.
    programme : int
        Bricks up to which a linear programme of all decides in the end; 0 if
        what is not decided soon may be left undecided.
    neighbours : bool
        Whether to see if pushes of neighbours help where studs do not bear the
        model; else it collapses or is undecided without them.
    rounds : int
        Linear programmes of few bodies that are tried: fewer if what is not
        proven soon is as good as what does not stand.
    worst_first : bool
        Whether a collapse at the worst contacts of ``near`` is enough to know.
    """

    aims: tuple[Aim, ...] = AIMS
    near: Stability | None = None
    programme: int = PROGRAMME
    neighbours: bool = True
    rounds: int = ROUNDS
    worst_first: bool = False


FULL: Final = Effort()
"""Whatever it takes to decide."""


@one_thread()
def stability(
    assembly: Assembly,
    *,
    clutch: float = HOLD,
    ground: Ground = Ground.TABLE,
    loads: Floats | None = None,
    effort: Effort = FULL,
    progress: Progress = silent,
) -> Stability:
    """Decide whether a model stands, first by its studs alone.

    Parameters
    ----------
    assembly : Assembly
        The model.
    clutch : float
        Pull in N that the friction of one contact point bears, above 0.
    ground : Ground
        What the lowest bricks stand on.
    loads : (n, 3) float64 array, optional
        Forces on the bricks besides their weight, in N at their centres of mass.
    effort : Effort
        How the proof is searched for.
    progress : Progress
        Told how far the search is; may cancel it.

    Returns
    -------
    Stability
        Verdict, proof and margins.
    """
    progress("stability", 0.0)
    among = partial(statics, assembly, clutch=clutch, ground=ground, loads=loads)
    work = Work(effort.aims, effort.programme, effort.rounds, effort.worst_first)
    look = partial(search, graph=assembly.graph, work=work, progress=progress)
    equations = alone = among()
    near = effort.near
    start = None if near is None else transferred(near.statics, near.forces, equations)
    found = weak = look(equations, start=start, kind=_kind(effort))
    verdict = _verdict(equations, found)
    if effort.neighbours and verdict is not Verdict.STABLE:
        equations = among(neighbours=True)
        found = look(equations, kind="all")
        verdict = _verdict(equations, found, Verdict.WEDGED)
    if verdict is not Verdict.WEDGED:
        alone, weak = equations, found
    yielding = _moving(alone, weak, len(assembly))
    return Stability(
        component=assembly.graph.component.astype(np.int64),
        margin=_margins(equations, found.forces, len(assembly)),
        standing=verdict,
        unsupported=np.flatnonzero(~assembly.graph.grounded),
        forces=found.forces,
        yielding=yielding,
        torn=torn_by(alone, yielding if weak.collapse else np.zeros_like(yielding)),
        residual=float(np.abs(residual(equations, found.forces)).max(initial=0)),
        iterations=found.turns,
        upright=found.found and found.upright,
        tipping=tipping(equations, assembly.graph),
        statics=equations,
    )


def _kind(effort: Effort) -> Kind:
    """Return among which forces to look: where nearly the same model stands by leaning ones alone, it takes those."""
    near = effort.near
    return "all" if near is not None and near.stable and not near.upright else "both"


def _verdict(equations: Statics, found: Balance, best: Verdict = Verdict.STABLE) -> Verdict:
    """Say no more than the checks confirm."""
    if found.found and is_equilibrium(equations, found.forces):
        return best
    if found.collapse and is_collapse(equations, found.motion):
        return Verdict.COLLAPSES
    return Verdict.UNDECIDED


def _moving(equations: Statics, found: Balance, n_bricks: int) -> Floats:
    """Return the motion of each brick, the greatest being 1, (n, 6)."""
    yielding = np.zeros((n_bricks, EQUATIONS))
    if found.motion.any():
        yielding[equations.rows] = found.motion.reshape(-1, EQUATIONS) / np.abs(found.motion).max()
    return yielding


def _margins(equations: Statics, forces: Floats, n_bricks: int) -> Floats:
    """Return what is left at the worst contact of each brick, as a share of the hold."""
    contacts = equations.contacts
    grips = contacts.least < 0
    # a force that only pushes uses no friction, but is missing as soon as it would have to pull
    left = np.minimum(forces, 0.0) / np.where(grips, -contacts.least, equations.clutch) + grips
    margin = np.ones(len(equations.rows))
    for bodies in (contacts.on, contacts.by):
        counted = (bodies != NOBODY) & (grips | (forces < 0))
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
    motion : (n, 6) float64 array
        Of all bricks.

    Returns
    -------
    (m, 2) int64 array
        Lower and upper brick, ``NOBODY`` for a baseplate; the widest gap first.
    """
    contacts = equations.contacts
    opening = equations.matrix.T @ motion[equations.rows].reshape(-1)
    opening[contacts.least == 0] = 0
    torn = np.flatnonzero(opening > max(TORN * opening.max(initial=0), ROUNDING))
    torn = torn[np.argsort(-opening[torn], kind="stable")]
    pairs = np.column_stack([contacts.by[torn], contacts.on[torn]])
    _, first = np.unique(pairs, axis=0, return_index=True)
    pairs = pairs[np.sort(first)]
    return np.where(pairs == NOBODY, NOBODY, equations.rows[pairs])
