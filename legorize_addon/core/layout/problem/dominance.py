"""Placements that an optimal layout does not need.

A placement is dominated by a smaller one inside it that covers the same must
cells at no higher cost: wherever the larger one lies, the smaller one can.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Floats, Mask
from .placements import Placements
from .shapes import Shapes


def dominated(found: Placements, among: Shapes, required: Mask, cost: Floats) -> Mask:
    """Return which placements are dominated by another one.

    Parameters
    ----------
    found : Placements
        What may be laid.
    among : Shapes
        Its shapes.
    required : (n_cells,) bool array
        Cells that have to be covered.
    cost : (n,) float64 array
        Cost of each placement.

    Returns
    -------
    (n,) bool array
        Leaving these out changes neither what can be covered nor the least cost.
    """
    needed = found.totals(required)
    superfluous = np.zeros(len(found), dtype=bool)
    partial = np.flatnonzero(needed < found.size)
    for inner, x, y in among.within:
        # the shape inside must have room for the required cells
        room = np.where(inner >= 0, among.size[inner], -1)
        rows = partial[needed[partial] <= room[found.shape[partial]]]
        shape = found.shape[rows]
        corner = found.corner[rows]
        corner[:, 0] += x[shape]
        corner[:, 1] += y[shape]
        smaller = found.find(inner[shape], corner)
        rows, smaller = rows[smaller >= 0], smaller[smaller >= 0]
        superfluous[rows[(needed[smaller] == needed[rows]) & (cost[smaller] <= cost[rows])]] = True
    return superfluous
