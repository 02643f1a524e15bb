"""The search for a proof in one balance: the cheapest ways first, each confirmed before it counts.

Projections come near to a balance in few turns, and to an exact one only where
there is room for it. What they leave open is decided by linear programmes of few
bodies: those at contacts that fail, and the rest of the model in lumps, which
turn and move as one body each. A motion of the lumps by which they collapse is one
by which the model does. If the lumps can be balanced, the bodies around what fails
are asked for other forces while all others keep theirs, which is a proof if there
are some. Else forces that balance the lumps are a better start for the projections;
where some still fail inside a lump, its bodies there are let loose, too: the
cutting plane method (Kelley 1960) with motions for cuts.

A model that was changed here and there has nearly the forces that it had. So it is
asked in this way first around what changed, before any projection.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np
from scipy.sparse import csr_array

from ..arrays import Floats, Ints, Mask
from ..model import ContactGraph
from ..progress import Progress, silent
from .collapse import CollapseProgram, is_collapse, least_imbalance
from .equilibrium import RESIDUAL, Aim, Balance, Plane, balance, is_equilibrium
from .forces import EQUATIONS, Statics
from .lumps import grown, lumps_around, stiff_lumps, touching
from .region import mended
from .tipping import toppling
from .upright import Upright, upright

WORST: Final = 30
"""Bodies at the contacts that fail most, which are let loose in each round, and those that touch them.

Strengthening and bracing the four weakest of eight models at 48 studs took 34 s of CPU with 30, and 48 s or more with
15 and with 20, because more verdicts stay open."""

LOOSE: Final = 250
"""Bodies that are let loose at most, and lumps of a motion that are asked: a linear programme of so many takes some
seconds."""

ROUNDS: Final = 3
"""Linear programmes that are tried: of the proofs of eight models at 48 studs none took more."""

UPRIGHT_ROUNDS: Final = 1
"""The same among upright forces, where others may be easier to find."""

REGION: Final = 900
"""Equations of a region in which other forces are looked for: a linear programme of so many takes half a second."""

RESERVE: Final = 0.05
"""Share of the clutch that those leave unused where it can be, so that projections have room to end in."""

POLISH: Final = (Aim(0.03, 0.0, 12),)
"""What projections aim at from there."""

POLISHED: Final = 4
"""Times that they begin anew where they ended, among forces that may lean: what a programme finds lies in a corner of
what contacts bear, and from what comes of that a balance is often a few turns away. With 1, 106 pillar bricks stood
under a dragon of 48 studs, with 4 there are 78; a van of 48 studs needs none with 4."""

ROUNDING: Final = 1e-6
"""Imbalance in N, summed over all lumps, that is none."""

Kind = Literal["both", "all"]


@dataclass(frozen=True, slots=True)
class Work:
    """How much is tried.

    Attributes
    ----------
    aims : tuple of Aim
        What forces to search for by projections, and for how long.
    programme : int
        Bricks up to which a linear programme of all decides in the end; 0 if
        what is left open then is not worth more projections.
    rounds : int
        Linear programmes of few bodies that are tried among forces that may lean.
    worst_first : bool
        Whether the worst contacts of the start are asked before all else. A
        collapse of which they tell is soon found, but it is one of few places.
    """

    aims: tuple[Aim, ...]
    programme: int
    rounds: int = ROUNDS
    worst_first: bool = False


def search(
    equations: Statics,
    graph: ContactGraph,
    work: Work,
    *,
    start: Floats | None = None,
    kind: Kind = "both",
    progress: Progress = silent,
) -> Balance:
    """Look for forces in balance, or for a motion that rules them out.

    Parameters
    ----------
    equations : Statics
        The balance.
    graph : ContactGraph
        Components of the bricks.
    work : Work
        How much is tried.
    start : (k,) float64 array, optional
        Forces in N to start from; if they are a balance, they are the answer.
    kind : str
        Whether to look among ``"all"`` forces at once, or among upright ones first.
    progress : Progress
        Told how far the search is; may cancel it.

    Returns
    -------
    Balance
        The forces, or the motion by which the model collapses, or neither.
    """
    reduced = upright(equations) if kind != "all" else None
    if start is not None and is_equilibrium(equations, start):
        straight = reduced is not None and np.allclose(
            reduced.raised(reduced.lowered(start)), start, rtol=0, atol=RESIDUAL
        )
        return Balance(start, True, np.zeros(len(equations.loads)), False, 0, upright=straight)
    motion = toppling(equations, graph)
    if is_collapse(equations, motion):
        # a model that tips over as a whole is the slowest to find by search, and the quickest to write down
        return replace(_lightest(equations, reduced, progress), motion=motion, collapse=True, found=False)
    if work.worst_first and reduced is not None and start is not None:
        soon = _failing(equations, reduced, start, progress)
        if soon is not None:
            return soon
    near = stiff = None
    if reduced is not None:
        near, stiff = _straight(equations, reduced, work.aims, start, progress)
        if near.found:
            return near
        start = near.forces
    if kind == "all" and start is not None:
        found = _decided(equations, _given(equations, start), None, work.rounds, progress)
        if not (found.found or found.collapse):
            found = _projected(equations, work.aims, found.forces, work.rounds, progress)
    elif near is None or stiff is None:
        found = _projected(equations, work.aims, start, work.rounds, progress)
    else:
        found = _torn(equations, near, stiff, work.rounds, progress)
    if work.programme and not (found.found or found.collapse):
        found = balance(equations, aims=work.aims, progress=progress)
        if not (found.found or found.collapse) and len(equations.rows) <= work.programme:
            progress("stability", 1.0)
            found = _programmed(equations, found)
    return found


def _lightest(equations: Statics, reduced: Upright | None, progress: Progress) -> Balance:
    """Return the lightest forces in balance, of the upright ones if there may be any."""
    found = balance(equations if reduced is None else reduced.statics, aims=(), progress=progress)
    return found if reduced is None else replace(found, forces=reduced.raised(found.forces))


def _straight(
    equations: Statics, reduced: Upright, aims: tuple[Aim, ...], start: Floats | None, progress: Progress
) -> tuple[Balance, Ints | None]:
    """Look for upright forces; if there are none, return the lumps of a motion that they do not stop, too."""
    near = None if start is None else reduced.lowered(start)
    found = _projected(reduced.statics, aims, near, UPRIGHT_ROUNDS, progress)
    forces, motion = reduced.raised(found.forces), reduced.spread(found.motion)
    enough = found.found and is_equilibrium(equations, forces)
    stiff = stiff_lumps(reduced.statics, found.motion) if found.collapse else None
    # a collapse under upright forces is none yet
    return Balance(forces, enough, motion, False, found.turns, upright=True), stiff


def _failing(equations: Statics, reduced: Upright, start: Floats, progress: Progress) -> Balance | None:
    """Return the collapse that the worst contacts of nearly the same model tell of, if they do.

    A model that was mended at one place mostly fails at another one as it did before.
    """
    progress("stability", 0.0)
    few, forces = reduced.statics, reduced.lowered(start)
    near = touching(few)
    loose = grown(near, _worst(few, forces) | _unbalanced(few, forces))
    solved = None if np.count_nonzero(loose) > _most(few) else _balanced(few, lumps_around(near, loose))
    if solved is None or not solved.motion.any():
        return None
    torn = least_imbalance(equations, stiff_lumps(few, solved.motion), reserve=RESERVE)
    if torn is None or not is_collapse(equations, torn.motion):
        return None
    return replace(_given(equations, start), motion=torn.motion, collapse=True)


def _torn(equations: Statics, near: Balance, stiff: Ints, rounds: int, progress: Progress) -> Balance:
    """Look for any forces where upright ones do not stop a motion: first between the lumps that it tears apart."""
    # of motions that tear nearly all apart, the linear programme would be one of all bodies
    solved = None if stiff.max(initial=0) >= LOOSE else least_imbalance(equations, stiff, reserve=RESERVE)
    if solved is not None and is_collapse(equations, solved.motion):
        return replace(near, motion=solved.motion, collapse=True, upright=False)
    return _decided(equations, replace(near, upright=False), None, rounds, progress)


def _projected(
    equations: Statics, aims: tuple[Aim, ...], start: Floats | None, rounds: int, progress: Progress
) -> Balance:
    """Decide around what changed, or else search by projections, but not for long, and decide what they leave open."""
    if start is not None and rounds:
        found = _changed(equations, start, progress)
        if found.found or found.collapse:
            return found
    plane = Plane(equations, progress)
    found = balance(equations, aims=aims[:-1] or aims, start=start, plane=plane, progress=progress)
    return _decided(equations, found, plane, rounds, progress)


def _changed(equations: Statics, start: Floats, progress: Progress) -> Balance:
    """Look for a proof around the bodies at which forces fail or are out of balance, if these are few."""
    found, near = _given(equations, start), touching(equations)
    wrong = _wrong(equations, start)
    if np.count_nonzero(loose := grown(near, wrong)) > _most(equations):
        return found
    progress("stability", 0.0)
    solved = _balanced(equations, lumps_around(near, loose))
    if solved is not None and solved.motion.any():
        return replace(found, motion=solved.motion, collapse=True)
    return _mended(equations, found, near)


def _given(equations: Statics, start: Floats) -> Balance:
    """Return forces of which nothing is known yet."""
    return Balance(start, False, np.zeros(len(equations.loads)), False, 0)


def _most(equations: Statics) -> int:
    """Return of how many bodies a region may be."""
    return REGION * len(equations.rows) // max(len(equations.loads), 1)


def _mended(equations: Statics, found: Balance, near: csr_array) -> Balance:
    """Look for other forces of the bodies around all that is wrong, of as many as a linear programme takes soon."""
    around = grown(near, _wrong(equations, found.forces))
    while (count := np.count_nonzero(around)) < np.count_nonzero(more := grown(near, around)) <= _most(equations):
        around = more
    if not 0 < count <= _most(equations):
        return found
    forces = mended(equations, found.forces, around, reserve=RESERVE)
    if forces is None or _wrong(equations, forces).any():
        return found
    return replace(found, forces=forces, found=True, motion=np.zeros_like(found.motion))


def _decided(equations: Statics, found: Balance, plane: Plane | None, rounds: int, progress: Progress) -> Balance:
    """Decide what projections left open by linear programmes, and more projections from their forces."""
    near, loose = touching(equations), np.zeros(len(equations.rows), dtype=bool)
    for turn in range(rounds):
        if found.found or found.collapse:
            break
        progress("stability", turn / rounds)
        more = loose | grown(near, _worst(equations, found.forces) | _unbalanced(equations, found.forces))
        loose = more if (more != loose).any() else grown(near, loose)
        solved = None if np.count_nonzero(loose) > LOOSE else _balanced(equations, lumps_around(near, loose))
        if solved is None:
            break
        if solved.motion.any():
            return replace(found, motion=solved.motion, collapse=True)
        found = _mended(equations, found, near)
        if found.found:
            break
        plane, turns = plane or Plane(equations, progress), found.turns
        forces = found.forces.copy()
        forces[solved.across] = solved.forces[solved.across]
        polished = _polished(equations, forces, plane, progress)
        # from forces that are no proof, fewer bodies were wrong before
        if polished.found or polished.collapse or turn + 1 < rounds:
            found = replace(polished, turns=polished.turns + turns)
    return found


def _polished(equations: Statics, forces: Floats, plane: Plane, progress: Progress) -> Balance:
    """Search by projections from nearly good forces, and if they may lean, again from those that come of it."""
    found, turns = _given(equations, forces), 0
    leaning = len(equations.loads) == EQUATIONS * len(equations.rows)
    for _ in range(POLISHED if leaning else 1):
        found = balance(equations, aims=POLISH, start=found.forces, plane=plane, progress=progress)
        turns += found.turns
        if found.found or found.collapse:
            break
    return replace(found, turns=turns)


def _balanced(equations: Statics, lump: Ints) -> CollapseProgram | None:
    """Return forces that balance lumps, or a motion by which they collapse; None if that is too near to tell."""
    for reserve in (RESERVE, 0.0):
        solved = least_imbalance(equations, lump, reserve=reserve)
        if solved is None or solved.imbalance < ROUNDING:
            return solved and replace(solved, motion=np.zeros_like(solved.motion))
        if is_collapse(equations, solved.motion):
            return solved
    return None


def _programmed(equations: Statics, found: Balance) -> Balance:
    """Ask a linear programme of all bodies."""
    solved = least_imbalance(equations, np.arange(len(equations.rows)))
    if solved is None:
        return found
    if is_collapse(equations, solved.motion):
        return replace(found, motion=solved.motion, collapse=True)
    plane = Plane(equations)
    forces = plane.project(solved.forces / plane.weight) * plane.weight
    if not is_equilibrium(equations, forces):
        return found
    return Balance(forces, True, np.zeros_like(found.motion), False, found.turns)


def _wrong(equations: Statics, forces: Floats) -> Mask:
    """Return the bodies that are out of balance, or have a contact that fails, (n,)."""
    wrong: Mask = _unbalanced(equations, forces) | (_missing(equations, forces) > 0)
    return wrong


def _unbalanced(equations: Statics, forces: Floats) -> Mask:
    """Return the bodies that are out of balance, (n,)."""
    sums = np.abs(equations.matrix @ forces + equations.loads).reshape(len(equations.rows), -1)
    return np.asarray((sums > RESIDUAL).any(axis=1))


def _missing(equations: Statics, forces: Floats) -> Floats:
    """Return how much is missing in N at the worst contact of each body, (n,)."""
    contacts, n = equations.contacts, len(equations.rows)
    missing = np.maximum(contacts.least - forces, 0)
    worst = np.zeros(n + 1)
    for bodies in (contacts.on, contacts.by):
        np.maximum.at(worst, bodies, missing)
    return worst[:n]


def _worst(equations: Statics, forces: Floats) -> Mask:
    """Return the bodies at the contacts that fail most, (n,)."""
    worst = _missing(equations, forces)
    order = np.argsort(-worst, kind="stable")[:WORST]
    chosen = np.zeros(len(worst), dtype=bool)
    chosen[order] = worst[order] > 0
    return chosen
