"""Covering a sheet as a linear programme.

One variable a placement, its share; one row a cell: shares sum to 1 on every
required cell and to 1 at most on every other one. The cost of the best shares is
never above the cost of the best layout, and mostly the shares are whole.

References
----------
Q. Huangfu, J. A. J. Hall, "Parallelizing the dual revised simplex method",
Math. Prog. Comp. 10, 2018 (HiGHS, which solves them).
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, linprog, milp
from scipy.sparse import csc_array

from ...arrays import Floats, Mask
from ..problem import Candidates, Index

WHOLE: Final = 1e-6
"""Tolerance within which a share counts as a whole number."""

_BARE: Final = 100.0
"""What a required cell without a brick costs, in bricks, where no brick of one cell is made."""

_GAP: Final = 1e-4
"""Share of the cost by which a whole solution may miss the best."""

_MANY: Final = 8_000
"""Placements above which prices are found by the interior point method: where many
prices are as good as each other, as on wide areas, the simplex method goes in circles."""

# for shares the search for simplifications takes longer than it saves
_PLAIN: Final = (("presolve", False),)


def shares(candidates: Candidates, required: Mask, cost: Floats) -> Floats:
    """Find the cheapest shares.

    Parameters
    ----------
    candidates : Candidates
        Placements to choose among.
    required : (n_cells,) bool array
        Cells that have to be covered; those without a placement are left out.
    cost : (n,) float64 array
        Cost of each placement of `candidates`.

    Returns
    -------
    (n,) float64 array
        Share of each placement, 0 to 1.
    """
    found = _milp(candidates, required, cost, Bounds(0, np.inf), options=dict(_PLAIN))
    return np.asarray(found[: len(candidates.rows)])


def whole_shares(candidates: Candidates, required: Mask, cost: Floats, nodes: int) -> Floats | None:
    """Find the cheapest shares that are 0 or 1, by branch and bound.

    Parameters
    ----------
    live, must, cost
        As for :func:`shares`.
    nodes : int
        Most nodes to look at.

    Returns
    -------
    (n,) float64 array or None
        Share of each placement; None if so many nodes did not suffice to find any.
    """
    options = {"node_limit": nodes, "mip_rel_gap": _GAP}
    found = _milp(candidates, required, cost, Bounds(0, 1), integrality=1, options=options)
    return None if found is None else np.rint(found[: len(candidates.rows)])


def prices(candidates: Candidates, required: Mask, room: Floats) -> tuple[Index, Floats]:
    """Find the largest prices of the cells such that no placement is worth more than its room.

    This is the dual of the programme of :func:`shares`, with the rooms as costs.

    Parameters
    ----------
    candidates : Candidates
        Placements.
    required : (n_cells,) bool array
        Cells that have to be covered.
    room : (n,) float64 array
        What the cells of each placement may be worth together.

    Returns
    -------
    cell : (k,) intp array
        The cells that placements cover.
    price : (k,) float64 array
        Worth of each, not above 0 where the cell need not be covered; the
        greatest sum that there is, but for rounding errors.
    """
    used, matrix = _matrix(candidates, required)
    rows, needed = matrix.tocsr(), required[used]
    optional = {"A_ub": rows[~needed], "b_ub": np.ones(np.count_nonzero(~needed))} if not needed.all() else {}
    found = linprog(
        np.append(room, np.full(matrix.shape[1] - len(room), _BARE)),
        A_eq=rows[needed],
        b_eq=np.ones(np.count_nonzero(needed)),
        **optional,
        method="highs-ipm" if len(room) > _MANY else "highs-ds",
        options=dict(_PLAIN),
    )
    price = np.zeros(len(used))
    price[needed] = found.eqlin.marginals
    price[~needed] = np.minimum(found.ineqlin.marginals, 0)
    return used, price


def _milp(candidates: Candidates, required: Mask, cost: Floats, bounds: Bounds, **options: Any) -> Any:
    """Return the shares of the placements and of the bare cells, None if there are none."""
    used, matrix = _matrix(candidates, required)
    found = milp(
        np.append(cost, np.full(matrix.shape[1] - len(cost), _BARE)),
        constraints=LinearConstraint(matrix, required[used].astype(np.float64), np.ones(len(used))),
        bounds=bounds,
        **options,
    )
    return found.x


def _matrix(candidates: Candidates, required: Mask) -> tuple[Index, csc_array]:
    """Return the cells that placements cover, and which placement covers which.

    The columns after those of the placements belong to required cells that might
    stay bare, because they have no brick of their own.
    """
    there, single = np.zeros_like(required), np.zeros_like(required)
    there[candidates.cells] = True
    single[candidates.cells[np.repeat(candidates.size == 1, candidates.size)]] = True
    row = np.cumsum(there) - 1
    bare = np.flatnonzero(there & required & ~single)
    rows = row[np.concatenate([candidates.cells, bare])]
    start = np.append(0, np.cumsum(np.append(candidates.size, np.ones(len(bare), dtype=np.intp))))
    used = np.flatnonzero(there)
    return used, csc_array((np.ones(len(rows)), rows, start), shape=(len(used), len(start) - 1))
