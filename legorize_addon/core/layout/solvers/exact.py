"""The exact way of laying a sheet: what a linear programme leaves open is settled by branch and bound."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..problem import Candidates, Index, Problem, dominated
from . import linear
from .covering_lp import shares, whole_shares
from .linear import dive

_NODES: Final = 200
"""Nodes of branch and bound for one component of a sheet. A limit in seconds would
give other bricks on another machine."""

_LEAST_GAIN: Final = 1e-6
"""Bricks by which another layout of a component must be cheaper."""

_SMALL: Final = 8_000
_LARGE: Final = 14_000
"""Placements above which a component is not tried, and above which a sheet is
left to :mod:`.linear`: they would take minutes."""


def cover(problem: Problem, rng: np.random.Generator) -> Index:
    """Cover sheets at the least cost that can be found in reasonable time.

    Parameters
    ----------
    problem : Problem
        The sheets.
    rng : numpy.random.Generator
        Decides between equals.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements to lay, never dearer than what :mod:`.linear` lays.
    """
    found, required, cost = problem.placements, problem.required, problem.cost
    candidates = Candidates.of(found).only(~dominated(found, problem.shapes, required, cost))
    laid = dive(candidates, required, cost).rows if len(candidates.rows) <= _LARGE else linear.cover(problem, rng)
    group = Candidates.of(found).groups(len(required))
    candidates = candidates.only(
        (np.bincount(group[candidates.rows], minlength=len(found)) <= _SMALL)[group[candidates.rows]]
    )
    if not len(candidates.rows):
        return laid
    share = shares(candidates, required, cost[candidates.rows])
    least = np.bincount(group[candidates.rows], weights=share * cost[candidates.rows], minlength=len(found))
    spent = np.bincount(group[laid], weights=cost[laid], minlength=len(found))
    tried = np.isin(np.arange(len(found)), group[candidates.rows])
    for number in np.flatnonzero(tried & (spent > least + _LEAST_GAIN)):
        part = candidates.only(group[candidates.rows] == number)
        whole = whole_shares(part, required, cost[part.rows], _NODES)
        if whole is not None and whole @ cost[part.rows] < spent[number] - _LEAST_GAIN:
            laid = np.concatenate([laid[group[laid] != number], part.rows[whole.astype(bool)]])
    return laid
