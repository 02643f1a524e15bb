"""Covers of a window at least cost that join all that is left below and above it.

Sets of components that a solution leaves apart are cut off by a constraint each,
as subtours are in the travelling salesman problem (Dantzig, Fulkerson and Johnson
1954).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csr_array

from ...arrays import Floats, Ints, Mask
from ..problem import Index, Placements, Problem, Rows
from ..solvers import WHOLE

_ALONE: Final = 3.5
"""What a brick costs that holds to nothing below or above, in bricks."""

_CUTS: Final = 12
"""Most times that a window is solved again because components were left apart."""


def touched(found: Placements, labels: Rows) -> tuple[Mask, Ints]:
    """Return which components are below or above each placement, (n_known, n), and their numbers, (n_known,)."""
    entry = np.tile(np.repeat(np.arange(len(found)), found.size), 2)
    label = labels[:, found.cells].ravel()
    known, row = np.unique(label[label >= 0], return_inverse=True)
    table = np.zeros((len(known), len(found)), dtype=bool)
    table[row, entry[label >= 0]] = True
    return table, known.astype(np.int64)


def joining_cover(problem: Problem, touches: Mask, home: Ints, loose: int) -> Index | None:
    """Return the placements of least cost that cover the cells and join what they must; None if none do.

    Pieces of one component must come together again, and the loose one must be joined to another.
    """
    found = problem.placements
    if len(found) == 0 or len(cuts_apart(touches, np.arange(len(found)), home, loose)):
        return None
    alone = ~touches.any(axis=0)
    constraints = [LinearConstraint(_covering(problem), problem.required.astype(np.float64), 1.0)]
    chosen = np.zeros(0, dtype=np.intp)
    for _ in range(_CUTS):
        cuts = cuts_apart(touches, chosen, home, loose)
        if len(cuts):
            constraints.append(LinearConstraint(cuts, 1.0))
        elif len(chosen):
            return chosen
        share = _cheapest(problem.cost + _ALONE * alone, constraints)
        if share is None:
            return None
        chosen = np.flatnonzero(np.rint(share))
    return None


def _cheapest(cost: Floats, constraints: Sequence[LinearConstraint]) -> Floats | None:
    """Return the cheapest shares that are 0 or 1; None if there are none."""
    # the linear programme costs a quarter, and mostly its shares are whole
    share = milp(cost, bounds=Bounds(0, 1), constraints=constraints, options={"presolve": False}).x
    if share is not None and (np.abs(share - np.rint(share)) > WHOLE).any():
        share = milp(cost, integrality=np.ones(len(cost)), bounds=Bounds(0, 1), constraints=constraints).x
    return None if share is None else np.asarray(share)


def _covering(problem: Problem) -> csr_array:
    """Return which cells each placement covers, (n_cells, n)."""
    found = problem.placements
    entry = np.repeat(np.arange(len(found)), found.size)
    return csr_array((np.ones(len(entry)), (found.cells, entry)), shape=(len(problem.required), len(found)))


def cuts_apart(touches: Mask, chosen: Index, home: Ints, loose: int) -> Floats:
    """Return, for each set of components wrongly left apart, which placements would join it to others."""
    member = first_joined(touches[:, chosen])
    inside = member == np.unique(member)[:, None]
    torn = np.array([np.isin(home[~each], home[each]).any() or (home[each] == loose).all() for each in inside], bool)
    reached = inside[torn].astype(np.intp) @ touches
    cuts: Floats = ((reached > 0) & (reached < touches.sum(axis=0))).astype(np.float64)
    return cuts


def first_joined(held: Mask) -> Index:
    """Return the first of the components that each is joined with, (k,), by bricks of which each holds some, (k, n)."""
    together = np.eye(len(held), dtype=bool)
    further = together | (held @ held.T)
    while not np.array_equal(together, further):
        together, further = further, further @ further
    # nothing has no first
    return together.argmax(axis=1) if len(held) else np.zeros(0, dtype=np.intp)
