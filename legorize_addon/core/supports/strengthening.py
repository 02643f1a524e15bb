"""Plates across what the proof says is weak, until studs alone bear the model.

What would come apart does so in a motion that no forces at the studs can stop,
and this motion tells the parts that stay whole and the contacts that tear. So
each round lays a tie between every two parts that tear off each other, where the
motion would stretch it most, and looks for forces in balance again: the cutting
plane method (Kelley 1960) with ties for cuts.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..layout.joining import tie_across
from ..model import NOBODY, Assembly, Bricks, Catalogue, ContactGraph, UnitGrid, Verdict, components
from ..progress import Progress, part, silent
from ..statics import SOON, Effort, Stability, stability, torn_by
from ..units import PLATE, STUD

ROUNDS: Final = 12
"""Times that ties are laid before the rest is left to pillars."""

WORK: Final = 60_000
"""Bricks tested in all these rounds together: a large model takes fewer of them."""

WIDEST: Final = 40
"""Contacts that are tied where the search ends undecided: those that open most in its last motion, which is no proof.
With 40 a van of 48 studs stands after one or two such rounds, with 10 it stays undecided."""


def strengthen(
    bricks: Bricks,
    grid: UnitGrid,
    catalogue: Catalogue,
    *,
    clutch: float,
    plates: bool,
    most: int | None = None,
    progress: Progress = silent,
) -> tuple[Bricks, UnitGrid, Stability]:
    """Lay ties where studs alone would not bear the model.

    Parameters
    ----------
    bricks : Bricks
        A layout without collisions. What floats is left as it is.
    grid : UnitGrid
        The cells that it covers.
    catalogue : Catalogue
    clutch : float
        Pull in N that one contact point shall need at most.
    plates : bool
        Whether bricks may be cut into plates, and plates be added.
    most : int, optional
        Times that ties are laid at most, if that is less than usual.
    progress : Progress
        Told before each round; may cancel.

    Returns
    -------
    bricks : Bricks
        With the ties; the same object if none was laid.
    grid : UnitGrid
        With the cells that were added.
    found : Stability
        How these bricks stand by their studs at that clutch, as far as projections and small linear programmes tell.
    """
    near: Stability | None = None
    rounds = max(min(ROUNDS if most is None else most, WORK // max(len(bricks), 1)), 1)
    for number in range(rounds + 1):
        model = Assembly(bricks, catalogue)
        watched = _as_strength(part(progress, number / (rounds + 1), (number + 1) / (rounds + 1)))
        effort = Effort(aims=SOON, near=near, programme=0, neighbours=False, worst_first=True)
        near = found = stability(model, clutch=clutch, effort=effort, progress=watched)
        torn = _torn(found)
        if found.standing is Verdict.STABLE or number == rounds or not len(torn):
            break
        tied, grid = _tied(model, grid, found, torn, plates=plates)
        if tied is bricks:
            break
        bricks = tied
    return bricks, grid, found


def _as_strength(progress: Progress) -> Progress:
    return lambda _, share: progress("strengthening", share)


def _torn(found: Stability) -> Ints:
    """Return the contacts that tear, or may tear where it stays open whether the bricks stand, (m, 2)."""
    if found.standing is not Verdict.UNDECIDED:
        return found.torn
    return torn_by(found.statics, found.yielding)[:WIDEST]


def _tied(model: Assembly, grid: UnitGrid, found: Stability, torn: Ints, *, plates: bool) -> tuple[Bricks, UnitGrid]:
    """Lay a tie between every two parts that tear off each other at some contacts."""
    torn = torn[(torn != NOBODY).all(axis=1)]
    whole = rigid_parts(model.graph, torn)
    weak = whole[torn]

    def worth(between: Ints, cells: Ints) -> Floats:
        """Return how fast two bricks move apart at a place."""
        points = ((cells[:, ::-1] + 0.5) * (1, 1, PLATE / STUD)).astype(np.float64)
        speed = [velocity(found, between[:, side], points) for side in (0, 1)]
        return np.linalg.norm(speed[0] - speed[1], axis=1)

    return tie_across(model.bricks, grid, model.catalogue, whole, weak[weak[:, 0] != weak[:, 1]], worth, plates=plates)


def rigid_parts(graph: ContactGraph, torn: Ints) -> Ints:
    """Return what each brick stays together with as contacts tear: the components without them, (n,)."""
    n = len(graph.component)
    kept = ~np.isin(graph.pairs.astype(np.int64) @ (n, 1), torn @ (n, 1))
    return components(graph.pairs[kept], n).astype(np.int64)


def velocity(found: Stability, bricks: Ints, points: Floats) -> Floats:
    """Return the velocity of bricks at points in the motion that their studs stop least.

    Parameters
    ----------
    found : Stability
    bricks : (k,) int64 array
        Rows of the bricks.
    points : (k, 3) float64 array
        In studs.

    Returns
    -------
    (k, 3) float64 array
        0 of bricks that hang in the air.
    """
    middle = np.zeros((len(found.yielding), 3))
    middle[found.statics.rows] = found.statics.middle
    moving, turning = found.yielding[bricks, :3], found.yielding[bricks, 3:]
    speed: Floats = moving + np.cross(turning, points - middle[bricks])
    return speed
