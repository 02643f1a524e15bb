"""What a brick costs in the end: the best fill of a window with it, less the best fill without this condition.

Both are found by branch and bound. Mirror images are priced about the axis about
which the layer has more of them at the time; a pair of variables that mirror each
other saves what the loneliness of both would cost.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import coo_array, csr_array, vstack

from ...arrays import Floats, Mask
from ..problem import Index
from .layer import LONELY, Layer
from .simulation import BITS, Bits, Windows

_GAP: Final = 1e-6
_NOTHING: Final = -2
"""Instead of a chosen column: none, and the mirror image of none."""


def regrets(layer: Layer, windows: Windows, laid: Mask, window: int, before: Index, candidates: Index) -> Floats:
    """Compute what each candidate costs in the end, above the best fill there is.

    Parameters
    ----------
    layer, windows, laid
        As for :func:`~.simulation.simulate`.
    window : int
        Number of one window.
    before : (n_before,) intp array
        Columns of what is decided already, -1 for none.
    candidates : (n_candidates,) intp array
        Columns.

    Returns
    -------
    (n_candidates,) float64 array
        Bricks, 0 where the best fill has the candidate.
    """
    rows, bits = windows.rows[window], windows.bits[window]
    decided = before[before >= 0]
    covered = np.bitwise_or.reduce(bits[decided], initial=~windows.free[window])
    cost, images = _priced(layer, rows, laid, decided)
    total = [
        cost[each] + _least(bits, covered | bits[each], windows.needed[window], cost, images, each)
        for each in candidates.tolist()
    ]
    free = _least(bits, covered, windows.needed[window], cost, images, _NOTHING)
    # what branch and bound leaves open may be on either side
    above: Floats = np.maximum(np.array(total) - free, 0)
    return above


def _priced(layer: Layer, rows: Index, laid: Mask, decided: Index) -> tuple[Floats, Index]:
    """Return the cost of each column alone, and the column of its mirror image, -1 where none matters."""
    nobody = len(layer.cost)
    lonely = [np.count_nonzero(~np.append(laid, False)[images[laid]]) for images in layer.mirror]
    image = np.append(layer.mirror[int(np.argmin(lonely))], nobody)[rows]
    there = np.append(laid, False)
    there[rows] = False
    there[rows[decided]] = True
    there[nobody] = False
    column = np.full(nobody + 1, -1, dtype=np.intp)
    column[rows] = np.arange(len(rows))
    column[nobody] = -1
    known = there[image] | (image == rows)
    cost = np.append(layer.cost, 0.0)[rows] + LONELY * ~known
    return cost, np.where(known, -1, column[image])


def _least(bits: Bits, covered: np.uint64, needed: np.uint64, cost: Floats, images: Index, chosen: int) -> float:
    """Return what the rest of a window costs at least, behind what is chosen."""
    columns = np.flatnonzero((bits & covered) == 0)
    open_ = needed & ~covered
    if not open_:
        return 0.0
    inside = (bits[columns][:, None] & BITS) != 0
    used = inside.any(axis=0)
    cells = csr_array(inside[:, used].T.astype(np.float64))
    wanted = ((open_ & BITS) != 0)[used].astype(np.float64)
    price = cost[columns].copy()
    # the chosen brick may get its mirror image only now
    price[images[columns] == chosen] -= 2 * LONELY
    first, second = _pairs(columns, images)
    n, k = len(columns), len(first)
    pairs = coo_array(
        (
            np.tile([-1.0, 1.0], 2 * k),
            (
                np.repeat(np.arange(2 * k), 2),
                np.column_stack([np.concatenate([first, second]), n + np.arange(2 * k) % max(k, 1)]).ravel(),
            ),
        ),
        shape=(2 * k, n + k),
    )
    matrix = vstack(
        [csr_array((cells.data, cells.indices, cells.indptr), shape=(cells.shape[0], n + k)), pairs]
    ).tocsr()
    found = milp(
        np.append(price, np.full(k, -2 * LONELY)),
        constraints=LinearConstraint(
            matrix, np.append(wanted, np.full(2 * k, -np.inf)), np.append(np.ones(len(wanted)), np.zeros(2 * k))
        ),
        bounds=Bounds(0, 1),
        integrality=np.append(np.ones(n), np.zeros(k)),
        options={"mip_rel_gap": _GAP},
    )
    return float(found.fun)


def _pairs(columns: Index, images: Index) -> tuple[Index, Index]:
    """Return positions in `columns` of those that mirror each other, each pair once."""
    place = np.full(len(images) + 1, -1, dtype=np.intp)
    place[columns] = np.arange(len(columns))
    image = place[images[columns]]
    first = np.flatnonzero(image > np.arange(len(columns)))
    return first, image[first]
