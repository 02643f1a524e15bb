"""In which order bodies leave a system of equations, so that little of it fills up: nested dissection.

Where the bodies that touch both halves are taken out last, the halves have
nothing to do with each other, and each is halved again. Built models lie in
space, so a plane across the longer way is a good cut; of the bodies on both
sides of it, as few as possible are taken out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching

from ..arrays import Floats, Ints, Mask

Index = NDArray[np.intp]

_LEAF: Final = 40
"""Bodies that are not halved any more: their equations are few enough to be full (20 to 80 take the same time)."""


@dataclass(frozen=True, slots=True, eq=False)
class Front:
    """Bodies that leave together.

    Attributes
    ----------
    bodies : (m,) intp array
    parts : tuple of int
        Fronts that leave before and touch this one, by their place in the list.
    """

    bodies: Index
    parts: tuple[int, ...]


def dissect(pairs: Ints, place: Floats) -> list[Front]:
    """Order bodies by nested dissection.

    Parameters
    ----------
    pairs : (k, 2) int64 array
        Bodies that touch, each pair once or more often, in any order.
    place : (n, 3) float64 array
        Where they are.

    Returns
    -------
    list of Front
        Every body is in one front. A front comes after its parts, and a body
        touches bodies of its own front, of the parts of that and of their
        parts, and of the fronts that it is a part of.

    References
    ----------
    A. George, "Nested dissection of a regular finite element mesh", SIAM J.
    Numer. Anal. 10(2), 1973.
    """
    fronts: list[Front] = []
    _dissect(np.arange(len(place)), pairs, place, fronts)
    return fronts


def _dissect(bodies: Index, pairs: Ints, place: Floats, fronts: list[Front]) -> tuple[int, ...]:
    """Append the fronts of some bodies, with the pairs among them by their place in ``bodies``; return the last one."""
    n = len(bodies)
    if n <= _LEAF:
        parts: tuple[int, ...] = ()
        between = np.ones(n, dtype=bool)
    else:
        side, between = _cut(pairs, place[bodies])
        parts = tuple(
            front
            for half in (~side & ~between, side & ~between)
            for front in _dissect(bodies[half], _among(pairs, half), place, fronts)
        )
    if not between.any():
        return parts
    fronts.append(Front(bodies[between], parts))
    return (len(fronts) - 1,)


def _among(pairs: Ints, members: Mask) -> Ints:
    """Keep the pairs of members, and count these alone."""
    kept: Ints = (np.cumsum(members) - 1)[pairs[members[pairs].all(axis=1)]]
    return kept


def _cut(pairs: Ints, place: Floats) -> tuple[Mask, Mask]:
    """Halve bodies; return which are in the second half, and which touch both halves and are to be taken out."""
    halves = [_upper_half(place[:, axis]) for axis in range(place.shape[1])]
    across = [np.count_nonzero(side[pairs[:, 0]] != side[pairs[:, 1]]) for side in halves]
    side = halves[int(np.argmin(across))]
    return side, _touching_both(pairs, side)


def _upper_half(values: Floats) -> Mask:
    side = np.zeros(len(values), dtype=bool)
    side[np.argsort(values, kind="stable")[len(values) // 2 :]] = True
    return side


def _touching_both(pairs: Ints, side: Mask) -> Mask:
    """Return the fewest bodies without which no pair lies on both sides: Koenig's theorem on the pairs that do."""
    between = np.zeros(len(side), dtype=bool)
    crossing = pairs[side[pairs[:, 0]] != side[pairs[:, 1]]]
    if not len(crossing):
        return between
    crossing = np.where(side[crossing[:, :1]], crossing[:, ::-1], crossing)
    (lower, row), (upper, column) = (np.unique(ends, return_inverse=True) for ends in crossing.T)
    graph = csr_array((np.ones(len(row), dtype=bool), (row, column)), shape=(len(lower), len(upper)))
    from_lower, from_upper = _fewest(graph)
    between[lower[from_lower]] = True
    between[upper[from_upper]] = True
    return between


def _fewest(graph: csr_array) -> tuple[Mask, Mask]:
    """Return rows and columns, as few as possible, that hold all entries."""
    partner = maximum_bipartite_matching(graph, perm_type="column")
    matched = partner >= 0
    partner_of = np.full(graph.shape[1], -1)
    partner_of[partner[matched]] = np.flatnonzero(matched)
    # from the rows without a partner, along any entry to columns and back along partners
    rows, columns = ~matched, np.zeros(graph.shape[1], dtype=bool)
    front = np.flatnonzero(rows)
    while len(front):
        reached = np.unique(graph[front].indices)
        reached = reached[~columns[reached]]
        columns[reached] = True
        # a reached column has a partner, or the matching would not be the greatest
        front = partner_of[reached]
        rows[front] = True
    return ~rows, columns
