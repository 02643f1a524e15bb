"""Bodies of parts with slanted sides: their outline drawn up, hollow from below.

Sides of a convex outline may vanish as it is moved inwards: the corners at both of its ends become one.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ..core.model import Part, outline, sides
from ..core.units import PLATE, STUD
from .lofts import BEVEL, GAP, ROOF, WALL, Detail, Floats, Loft, welded


def wedge_body(part: Part, detail: Detail) -> Loft:
    """Return the faces of the body of a part with slanted sides.

    Parameters
    ----------
    part : Part
    detail : {"low", "high"}
        Low: a closed prism. High: bevelled above and below, hollow from below.

    Returns
    -------
    Loft
        In mm from the corner of the part's box, without studs and tubes.
    """
    height = part.height * PLATE
    steps = [(GAP, 0.0), (GAP, height - GAP)]
    if detail == "high":
        steps = [
            (WALL, height - ROOF), (WALL, 0.0), (GAP + BEVEL, 0.0), (GAP, BEVEL), (GAP, height - GAP - BEVEL),
            (GAP + BEVEL, height - GAP),
        ]  # fmt: skip
    corners = outline(part) * STUD
    rings = [np.insert(inset(corners, by), 2, z, axis=1) for by, z in steps]
    faces = [rings[0][::-1], rings[-1]]
    for low, high in pairwise(rings):
        after = [np.roll(ring, -1, axis=0) for ring in (low, high)]
        faces += list(np.stack([low, after[0], after[1], high], axis=1))
    return welded(faces)


def inset(outline: Floats, by: float) -> Floats:
    """Move the sides of a convex outline inwards.

    Parameters
    ----------
    outline : (n, 2) float64 array
        Counter-clockwise.
    by : float

    Returns
    -------
    (n, 2) float64 array
        The corners, those at both ends of a side that vanishes at the same place.
    """
    along, inwards = sides(outline)
    beyond = (inwards * outline).sum(axis=1) + by
    left = list(range(len(outline)))
    while True:
        before = [left[-1], *left[:-1]]
        met = np.stack([np.linalg.solve(inwards[[one, two]], beyond[[one, two]])
                        for one, two in zip(before, left, strict=True)])  # fmt: skip
        long = ((np.roll(met, -1, axis=0) - met) * along[left]).sum(axis=1)
        if (long >= 0).all():
            break
        del left[int(long.argmin())]
    # a corner is where the first side left from it on begins
    row = np.searchsorted(left, np.arange(len(outline))) % len(left)
    found: Floats = met[row]
    return found
