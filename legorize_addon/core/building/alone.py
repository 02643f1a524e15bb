"""In which step each brick of the finished model can be shown, if no support is: when what is there holds it."""

from __future__ import annotations

import heapq

import numpy as np
from numpy.typing import NDArray

from ..arrays import Mask
from ..model import NOBODY, Rows


def steps_alone(arrival: NDArray[np.int32], pairs: Rows, *, ground: Mask) -> NDArray[np.int32]:
    """Return the first step in which each brick hangs together with the ground by bricks that have arrived.

    Parameters
    ----------
    arrival : (n,) int32 array
        Step in which each brick comes to the model, see :meth:`Steps.arrival`.
    pairs : (k, 2) int32 array
        Bricks that touch.
    ground : (n,) bool array
        Bricks that stand on the ground.

    Returns
    -------
    (n,) int32 array
        Of each brick the least that is possible: on a path of bricks from the
        ground the latest arrival. Of what never hangs together with the ground,
        its own arrival.

    References
    ----------
    Pollack, "The maximum capacity through a network" (1960): paths of which the
    worst link is the best.
    """
    near: list[list[int]] = [[] for _ in arrival]
    for one, other in pairs.tolist():
        near[one].append(other)
        near[other].append(one)
    came = arrival.tolist()
    found = [NOBODY] * len(came)
    agenda = [(came[brick], int(brick)) for brick in np.flatnonzero(ground)]
    heapq.heapify(agenda)
    while agenda:
        step, brick = heapq.heappop(agenda)
        if found[brick] == NOBODY:
            found[brick] = step
            for other in near[brick]:
                if found[other] == NOBODY:
                    heapq.heappush(agenda, (max(step, came[other]), other))
    steps = np.array(found, dtype=np.int32)
    return np.where(steps == NOBODY, arrival, steps).astype(np.int32)
