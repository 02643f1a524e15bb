"""The search for a proof in one balance: the cheapest ways first, each confirmed before it counts."""

from __future__ import annotations

from dataclasses import replace
from typing import Final, Literal

import numpy as np

from ..arrays import Floats, Ints
from ..model import NOBODY, ContactGraph
from ..progress import Progress, silent
from .collapse import is_collapse, least_imbalance
from .equilibrium import Aim, Balance, Plane, balance, is_equilibrium
from .forces import EQUATIONS, Statics
from .tipping import toppling
from .upright import Upright, upright

LOCAL: Final = 200
"""Bricks that move most, which a linear programme takes in a fifth of a second; a collapse is mostly among them."""

FADING: Final = 0.9
STEPS: Final = 30
"""What is left from body to body of what is missing at contacts, and how far it is followed."""

Kind = Literal["both", "upright", "all"]

RESERVE: Final = 1e-6
"""How far in N the linear programme stays away from the bounds, against its own tolerance of 1e-7."""


def search(
    equations: Statics,
    graph: ContactGraph,
    *,
    aims: tuple[Aim, ...],
    start: Floats | None = None,
    programme: int,
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
    aims : tuple of Aim
        What forces to search for, and for how long.
    start : (k,) float64 array, optional
        Forces in N to start from; if they are a balance, they are the answer.
    programme : int
        Bricks that a linear programme takes at most, where projections leave it
        open: of a larger model those that would move most, with which it can
        prove no more than a collapse.
    kind : str
        Whether to look among ``"upright"`` forces, among ``"all"``, or among
        ``"both"``, one after the other.
    progress : Progress
        Told how far the search is; may cancel it.

    Returns
    -------
    Balance
        The forces, or the motion by which the model collapses, or neither.
    """
    if start is not None and is_equilibrium(equations, start):
        return Balance(start, True, np.zeros(len(equations.loads)), False, 0)
    motion = toppling(equations, graph)
    if is_collapse(equations, motion):
        # a model that tips over as a whole is the slowest to find by search, and the quickest to write down
        return replace(balance(equations, aims=(), progress=progress), motion=motion, collapse=True, found=False)
    if kind != "all" and (reduced := upright(equations)) is not None:
        near = _straight(equations, reduced, aims, start, progress)
        if programme and not near.found:
            near = _near_collapse(equations, near, min(LOCAL, programme))
        if near.found or near.collapse or kind == "upright":
            return near
    found = balance(equations, aims=aims, start=start, progress=progress)
    if programme and not found.found and not found.collapse:
        progress("stability", 1.0)
        found = _programmed(equations, found, programme)
    return found


def _straight(
    equations: Statics, reduced: Upright, aims: tuple[Aim, ...], start: Floats | None, progress: Progress
) -> Balance:
    """Look for upright forces that leave a margin; without them, return the motion that they stop least."""
    near = None if start is None else reduced.lowered(start)
    found = balance(reduced.statics, aims=aims[:-1] or aims, start=near, progress=progress)
    forces = reduced.raised(found.forces)
    # a collapse under upright forces is none yet
    enough = found.found and is_equilibrium(equations, forces)
    return Balance(forces, enough, reduced.spread(found.motion), False, found.turns, upright=True)


def _near_collapse(equations: Statics, found: Balance, few: int) -> Balance:
    """Ask linear programmes of few bodies that may collapse: they move, or move near to contacts that fail."""
    moved = _moved(equations, found)
    # neither finds all that the other does
    for rank in (moved * _near_to_failing(equations, found), moved):
        solved = least_imbalance(equations, _first(rank, few), reserve=RESERVE)
        if solved is not None and is_collapse(equations, solved.motion):
            return Balance(found.forces, False, solved.motion, True, found.turns)
    return found


def _programmed(equations: Statics, found: Balance, most: int) -> Balance:
    """Ask a linear programme of the bodies that would move most, or of all."""
    bodies = _first(_moved(equations, found), most)
    solved = least_imbalance(equations, bodies, reserve=RESERVE)
    if solved is None:
        return found
    if is_collapse(equations, solved.motion):
        return Balance(found.forces, False, solved.motion, True, found.turns)
    return _balanced(equations, solved.forces, found) if len(bodies) == len(equations.rows) else found


def _moved(equations: Statics, found: Balance) -> Floats:
    """Return how fast each body moves, (n,)."""
    moved: Floats = np.abs(found.motion).reshape(len(equations.rows), EQUATIONS).max(axis=1)
    return moved


def _first(rank: Floats, number: int) -> Ints:
    return np.sort(np.argsort(-rank, kind="stable")[:number])


def _near_to_failing(equations: Statics, found: Balance) -> Floats:
    """Return how much is missing at the contacts of each body, or how much of that reaches it from others, (n,)."""
    contacts, n = equations.contacts, len(equations.rows)
    inner = contacts.by != NOBODY
    failing = np.maximum(contacts.least - found.forces, 0)
    near = np.bincount(contacts.on, failing, n) + np.bincount(contacts.by[inner], failing[inner], n)
    one, other = np.unique(np.stack([contacts.on, contacts.by])[:, inner], axis=1)
    for _ in range(STEPS):
        further = near.copy()
        np.maximum.at(further, one, FADING * near[other])
        np.maximum.at(further, other, FADING * near[one])
        near = further
    return near


def _balanced(equations: Statics, forces: Floats, found: Balance) -> Balance:
    """Return forces of a linear programme as a balance, if rounding leaves them one."""
    plane = Plane(equations)
    forces = plane.project(forces / plane.weight) * plane.weight
    if not is_equilibrium(equations, forces):
        return found
    return Balance(forces, True, np.zeros_like(found.motion), False, found.turns)
