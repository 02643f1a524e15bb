"""The fast way of laying a sheet: the placement with the most expensive cells first.

Every cell has a price that rises when only small bricks or few placements are
left for it. A placement scores the prices of its cells and wins when no better
one shares a cell with it, so that many are laid at once; then the prices are
found anew, until everything is covered (Luby's way to a maximal independent
set, with the prices as weights).
"""

from __future__ import annotations

from typing import Final

import numpy as np

from ...arrays import Mask
from ..problem import Amounts, Candidates, Index, Problem

_ONE: Final = 1 << 20
"""One brick in the fixed-point numbers that prices are made of: sums of integers
are the same on every machine."""

_BEST: Final = 0.5
"""How fast a cell gets cheaper with the largest brick it can still be part of."""

_SCARCE: Final = 60
"""Covered cells, over all placements through a cell, at which its price has doubled."""

_PARTNERS: Final = ((1, _ONE // 2), (2, _ONE // 10))
"""What it is worth to take a cell together with a neighbour, by the number of
neighbours that are left for it (found by trial on six models)."""


def cover(problem: Problem, rng: np.random.Generator) -> Index:
    """Cover a sheet by placements that are good, not best.

    Parameters
    ----------
    problem : Problem
        The sheet.
    rng : numpy.random.Generator
        Decides where nothing else does.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements to lay. They share no cell, and no placement
        could be added; required cells remain only where nothing fits at all.

    References
    ----------
    M. Luby, "A simple parallel algorithm for the maximal independent set
    problem", SIAM J. Comput. 15(4), 1986.
    """
    placements = problem.placements
    # bricks of one cell only fill what is left over: their cost must not keep them waiting
    merit = np.where(placements.size == 1, 0, np.rint((1 - problem.cost) * _ONE)).astype(np.int64)
    tie = _ties(problem, rng)
    n_ties = int(tie.max(initial=0)) + 1
    price_of_best = _price_table(int(placements.size.max(initial=0)))
    covered = np.zeros_like(problem.required)
    candidates = Candidates.of(placements)
    chosen = [candidates.rows[:0]]
    while len(candidates.rows):
        score = (
            candidates.totals(_prices(candidates, problem.required, price_of_best)[candidates.cells])
            + merit[candidates.rows]
        )
        # the tie makes all keys different: on every cell there is one winner
        won = candidates.winners(score * n_ties + tie[candidates.rows], len(covered))
        chosen.append(candidates.rows[won])
        covered[candidates.only(won).cells] = True
        candidates = candidates.clear_of(covered)
    return np.concatenate(chosen)


def _ties(problem: Problem, rng: np.random.Generator) -> Amounts:
    """Give the placements numbers for the case that scores are equal.

    Those on a lattice of their own size get the greatest ones: in wide areas
    they fit together without gaps. The lattice of every other layer is shifted
    by half a brick. For the rest it is chance.
    """
    found, sheets = problem.placements, problem.sheets
    odd = (sheets.level // sheets.height % 2)[found.corner[:, 2]]
    extent = problem.shapes.extent[found.shape]
    remainder = (found.corner[:, :2] + odd[:, None] * (extent // 2)) % extent
    aligned = (remainder[:, 0] == 0).astype(np.int64) + (remainder[:, 1] == 0)
    ties: Amounts = aligned * len(found) + rng.permutation(len(found))
    return ties


def _price_table(largest: int) -> Amounts:
    """Return the price of a cell by the size of the largest brick through it."""
    sizes = np.arange(1, largest + 1)
    return np.append(0, np.rint(_ONE * sizes**-_BEST)).astype(np.int64)


def _prices(candidates: Candidates, required: Mask, price_of_best: Amounts) -> Amounts:
    """Return the prices of the cells, 0 where a cell need not be covered, but for its neighbours' sake."""
    size = np.repeat(candidates.size, candidates.size)
    best = np.zeros(len(required), dtype=np.int64)
    np.maximum.at(best, candidates.cells, size)
    offers = np.bincount(candidates.cells, weights=size, minlength=len(required)).astype(np.int64)
    price = np.where(required, price_of_best[best] * (offers + _SCARCE) // np.maximum(offers, 1), 0)
    return price + _neighbourly(candidates, required)


def _neighbourly(candidates: Candidates, required: Mask) -> Amounts:
    """Reward taking a cell together with its last neighbours, and punish taking these alone.

    The reward of the cell and the punishment of its neighbours cancel out in a
    placement that covers them all.
    """
    # two cells are neighbours if the brick of two cells still fits there
    pairs = candidates.cells[np.repeat(candidates.size == 2, candidates.size)].reshape(-1, 2)
    one, other = np.concatenate([pairs, pairs[:, ::-1]]).T
    n_neighbours = np.bincount(one, minlength=len(required))
    worth = np.zeros(len(required), dtype=np.int64)
    for count, amount in _PARTNERS:
        few = (n_neighbours == count) & required
        dependants = np.bincount(one[few[other]], minlength=len(required))
        worth += amount * (count * few - dependants)
    return worth
