"""The standard way of laying a sheet: a linear programme, made whole by dives.

Placements with a share of one half or more are laid, then the programme of
what is left is solved anew, until everything is covered. Wide areas of one
colour, in which such a programme is slow, get a running bond in the middle, and
what is left of them is laid block after block.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from ...arrays import Floats, Mask
from ...model import NOBODY
from ..problem import Candidates, Index, Problem, blocks, dominated
from . import greedy
from .bond import running_bond
from .covering_lp import WHOLE, shares
from .exchange import fewer_small
from .pricing import promising

_NOISE: Final = 1e-5
"""Greatest random cost, in bricks: with it the best shares are hardly ever a tie, which the solver would decide."""

_SURE: Final = 0.7
"""Share from which a placement is laid."""

_ALIKE: Final = 1e-4
"""Shares that differ by less count as equal."""

_WIDE: Final = 5_000
_LARGE: Final = 20_000
"""Placements above which wide areas get a running bond, and above which what is left is laid block after block."""


def cover(problem: Problem, rng: np.random.Generator) -> Index:
    """Cover sheets by nearly as few placements as can be.

    Parameters
    ----------
    problem : Problem
        The sheets.
    rng : numpy.random.Generator
        Decides between equals.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements to lay. They share no cell; required cells remain
        only where no layout could cover them together.
    """
    found = problem.placements
    kept = ~dominated(found, problem.shapes, problem.required, problem.cost)
    if problem.price is not None:
        kept &= promising(problem, problem.price)
    candidates = Candidates.of(found).only(kept)
    cost = problem.cost + _NOISE * rng.random(len(found))
    if len(candidates.rows) <= _WIDE:
        return dive(candidates, problem.required, cost).rows
    pieces = _piecewise(problem, candidates, cost)
    quick = fewer_small(problem, greedy.cover(problem, rng), rng)
    return min(pieces, quick, key=lambda rows: (_bare(problem, rows), cost[rows].sum()))


def _bare(problem: Problem, chosen: Index) -> int:
    """Count the required cells that are left over: between blocks some may, where no brick of one cell is made."""
    return int(np.count_nonzero(problem.required & (problem.owner(chosen) == NOBODY)))


def _piecewise(problem: Problem, candidates: Candidates, cost: Floats) -> Index:
    """Cover wide sheets: first the middle of wide areas, then block after block."""
    bond = running_bond(problem)
    covered = problem.owner(bond) != NOBODY
    candidates = candidates.clear_of(covered)
    chosen = [bond]
    if len(candidates.rows) <= _LARGE:
        return np.append(bond, dive(candidates, problem.required & ~covered, cost).rows)
    for window, core in blocks(problem.corner):
        part = candidates.clear_of(covered | ~window)
        laid = dive(part, problem.required & window & ~covered, cost)
        laid = laid.only(laid.totals(core[laid.cells]) > 0)
        covered[laid.cells] = True
        chosen.append(laid.rows)
    return np.concatenate(chosen)


def dive(candidates: Candidates, required: Mask, cost: Floats) -> Candidates:
    """Lay placements by their shares, solving anew for what is left.

    Parameters
    ----------
    candidates : Candidates
        Placements to choose among.
    required : (n_cells,) bool array
        Cells that have to be covered.
    cost : (n,) float64 array
        Cost of every placement of the problem.

    Returns
    -------
    Candidates
        Those that are laid.
    """
    laid = np.zeros(len(cost), dtype=bool)
    everything, covered = candidates, np.zeros_like(required)
    while (required[candidates.cells] & ~covered[candidates.cells]).any():
        won = _sure(candidates, shares(candidates, required & ~covered, cost[candidates.rows]), len(required))
        if not won.any():
            break
        laid[candidates.rows[won]] = True
        covered[candidates.only(won).cells] = True
        candidates = candidates.clear_of(covered)
    return everything.only(laid[everything.rows])


def _sure(candidates: Candidates, share: Floats, n_cells: int) -> Mask:
    """Choose the placements with a great share, and one where shares hang together without any."""
    won = share > _SURE
    open_ = np.flatnonzero(share > WHOLE)
    if won[open_].all():
        return won
    among = candidates.only(share > WHOLE)
    group = among.groups(n_cells)
    settled = np.zeros(group.max() + 1, dtype=bool)
    settled[group[won[open_]]] = True
    # a half fixed there mostly makes the rest whole
    order = np.lexsort((among.size, np.rint(share[open_] / _ALIKE)))
    best = np.zeros(len(settled), dtype=np.intp)
    best[group[order]] = open_[order]
    won[best[~settled]] = True
    return won
