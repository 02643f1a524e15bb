"""Estimated prices of the cells, which show which placements a linear programme can do without.

The programme's dual is a price for each cell, and only placements that cost
little more than the prices of their cells are in a good layout. Prices that are
nearly right suffice to leave out about half of them. Shares that decrease
exponentially with the cost above the prices are scaled until they sum to one on
every cell, while the temperature falls; many sheets at once, before any of them
is laid, because seams hardly change the prices.

References
----------
J. N. Darroch, D. Ratcliff, "Generalized iterative scaling for log-linear
models", Ann. Math. Statist. 43(5), 1972.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy.sparse import csr_array

from ...arrays import Floats, Mask
from ..problem import Problem, dominated

_HEAT: Final = (0.3, 0.05)
"""Cost above the prices, in bricks, at which a share falls to 1/e: in the first round, and in the last one."""

_ROUNDS: Final = 14
_PACE: Final = 1.7
"""Over-relaxation of the scaling for a single size: prices settle sooner."""

_GREATEST: Final = 8.0
"""Exponent above which shares grow no more."""

_LEAST: Final = 1e-300
"""Stands for no share at all where a logarithm is taken."""

_MARGIN: Final = 0.5
"""Bricks above the prices of its cells that a placement may cost."""


def guessed_prices(problem: Problem) -> Floats:
    """Estimate the price of each cell.

    Parameters
    ----------
    problem : Problem
        The sheets, no matter which of them touch.

    Returns
    -------
    (n_cells,) float64 array
        In bricks; not above 0 where a cell need not be covered.
    """
    found, required = problem.placements, problem.required
    kept = np.flatnonzero(~dominated(found, problem.shapes, required, problem.cost))
    found, cost = found.take(kept), problem.cost[kept]
    covers = csr_array((np.ones(len(found.cells)), found.cells, found.start), shape=(len(found), len(required)))
    through, size = covers.T.tocsr(), found.size.astype(np.float64)
    price = np.zeros(len(required))
    for heat in np.geomspace(*_HEAT, _ROUNDS):
        share = np.exp(np.minimum((covers @ price - cost) / heat, _GREATEST))
        demand = np.maximum(through @ share, _LEAST)
        # a price counts as often as the placements have cells
        mean_size = np.maximum(through @ (share * size) / demand, 1)
        price -= _PACE * heat * np.log(demand) / mean_size
        np.minimum(price, 0, out=price, where=~required)
    return price


def promising(problem: Problem, price: Floats) -> Mask:
    """Return which placements a good layout may need.

    Parameters
    ----------
    problem : Problem
        The sheets.
    price : (n_cells,) float64 array
        Worth of each cell.

    Returns
    -------
    (n,) bool array
        With these, whatever can be covered still can.
    """
    found = problem.placements
    reduced = problem.cost - np.add.reduceat(price[found.cells], found.start[:-1])
    # required cells that no brick of one cell could cover in the end
    alone = problem.required.copy()
    alone[found.cells[found.start[:-1]][found.size == 1]] = False
    needed: Mask = (reduced < _MARGIN) | (found.size == 1) | (found.totals(alone) > 0)
    return needed
