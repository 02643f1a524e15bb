"""Which segment of a cut follows which: over shared edges, and over the gaps of open meshes.

References
----------
Paper, section "Colour trajectory" (linking of the segments).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from heapq import heapify, heappop, heappush
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints, Mask
from ..geometry import ranges
from .slices import Slices

_GAP: Final = 8.0
"""Open ends this near to each other, in mm, are joined before a chain is closed on itself."""

_SHRINK: Final = 8
"""A pass over all open ends pays if it joins at least one in this many."""

_ASKED: Final = 8
"""Number of nearest places to query first; doubled each time that all of them are used up."""

_DIGIT: Final = 16
"""Bits of a digit: numpy sorts numbers of 16 bits in linear time."""


def successors(faces: NDArray[np.int32], slices: Slices) -> Ints:
    """Return the segment after each segment, -1 where the mesh has no neighbour.

    Two triangles that share an edge are cut there by the same planes, and the
    segments of a triangle that cross one edge come plane after plane: so whole
    runs of segments follow whole runs, and no coordinates are compared. Where
    more than two triangles share an edge, those that pass it upwards and those
    that pass it downwards are paired in the order of their numbers.

    Parameters
    ----------
    faces : (n_f, 3) int32 array
        Faces of the mesh that was cut.
    slices : Slices

    Returns
    -------
    (n,) int64 array
    """
    if len(slices) == 0:
        return np.zeros(0, dtype=np.int64)
    half = 3 * slices.face.astype(np.int64)
    up, down = _run_starts(half + slices.exit), _run_starts(half + slices.enter)
    n = len(slices.mesh.vertices)
    # an edge is identified by its lower and its upper vertex
    rising, falling = (
        faces.take(lower).astype(np.int64) * n + faces.take(upper)
        for lower, upper in (slices.rises(up), slices.falls(down))
    )
    partner = _partners(rising, falling)
    size = np.diff(up, append=len(slices))
    following = np.arange(len(slices)) + (down[partner] - up).repeat(size)
    following[(partner < 0).repeat(size)] = -1
    return following


def _run_starts(values: Ints) -> Ints:
    """Return where a new value begins in a sequence."""
    return np.flatnonzero(np.diff(values, prepend=-1))


def _partners(left: Ints, right: Ints) -> Ints:
    """Return the index of the equal key in the other array, each taken once and in order, -1 for none."""
    left_order, right_order = _sorting(left), _sorting(right)
    left, right = left[left_order], right[right_order]
    partner = np.full(len(left), -1, dtype=np.int64)
    if np.array_equal(left, right):
        partner[left_order] = right_order
        return partner
    # the k-th of the equal keys on one side takes the k-th on the other
    rank = np.arange(len(left)) - np.searchsorted(left, left)
    place = np.searchsorted(right, left) + rank
    hit = np.flatnonzero(place < len(right))
    hit = hit[right[place[hit]] == left[hit]]
    partner[left_order[hit]] = right_order[place[hit]]
    return partner


def _sorting(key: Ints) -> Ints:
    """Return the stable order of numbers that are not negative, digit by digit."""
    n_bits = int(key.max(initial=1)).bit_length()
    return np.lexsort([(key >> shift).astype(np.uint16) for shift in range(0, n_bits, _DIGIT)])


def matched_ends(slices: Slices, following: Ints) -> tuple[Ints, Ints]:
    """Choose which open chain continues where another one ends.

    Within a slice the nearest pair is joined first, then the nearest of those that
    are left, and so on up to 8 mm; what is left closes on itself.

    Parameters
    ----------
    slices : Slices
    following : (n,) int64 array
        Segment after each, -1 for an open end.

    Returns
    -------
    tail, head : (k,) int64 arrays
        The last segment before a gap and the first one after it.
    """
    tail = np.flatnonzero(following < 0)
    if len(tail) == 0:
        return tail, tail
    head = np.flatnonzero(_unmatched(following))
    match = np.full(len(tail), -1, dtype=np.int64)
    # slices apart by more than a gap, so that nothing is near across them
    lift = 4 * _GAP * np.arange(len(slices.heights))
    ends = np.column_stack([slices.ends(tail), lift[slices.slice[tail]]])
    starts = np.column_stack([slices.starts(head), lift[slices.slice[head]]])
    _match_nearest(ends, starts, match)
    _close_on_itself(following, tail, head, match)
    return tail, head[match]


def _match_nearest(ends: Floats, starts: Floats, match: Ints) -> None:
    """Join ends and starts that are nearest to each other, again and again until all are too far apart."""
    places = _Places.of(ends), _Places.of(starts)
    while (pairs := _nearest_pairs(*places)) is not None:
        first, second, n_candidates = pairs
        n_joined = _join(*places, first, second, match)
        if n_joined * _SHRINK < n_candidates:
            # few pairs a pass, as where gaps grow one after the other: the rest is taken in the order of distance
            _match_one_by_one(*places, match)
            return


@dataclass(frozen=True, slots=True, eq=False)
class _Places:
    """Different points, and the members at each.

    Attributes
    ----------
    point : (k, d) float64 array
        In the order of the first of their members.
    member : (n,) int64 array
        Members, place by place, rising.
    first, left : (k,) int64 arrays
        Where the members that are free begin, and how many they are; both change while they are joined.
    """

    point: Floats
    member: Ints
    first: Ints
    left: Ints

    @classmethod
    def of(cls, points: Floats) -> _Places:
        """Group points that are the same."""
        _, row, place, size = np.unique(points, axis=0, return_index=True, return_inverse=True, return_counts=True)
        order = np.argsort(row)
        number = np.empty(len(order), dtype=np.int64)
        number[order] = np.arange(len(order))
        size = size[order].astype(np.int64)
        member = np.argsort(number[place.reshape(-1)], kind="stable")
        return cls(points[row[order]], member, np.cumsum(size) - size, size)

    def take(self, place: int, size: int) -> Ints:
        """Return some members of a place, and mark them as taken."""
        first = int(self.first[place])
        self.first[place] += size
        self.left[place] -= size
        return self.member[first : first + size]


def _nearest_pairs(ends: _Places, starts: _Places) -> tuple[Ints, Ints, int] | None:
    """Return pairs of places that are nearest to each other, and how many ends there are near a free start."""
    end, start = np.flatnonzero(ends.left), np.flatnonzero(starts.left)
    if len(end) == 0:
        return None
    forth, near = cKDTree(starts.point[start]).query(ends.point[end], distance_upper_bound=_GAP)
    back, _ = cKDTree(ends.point[end]).query(starts.point[start], distance_upper_bound=_GAP)
    mutual = np.flatnonzero(np.isfinite(forth))
    n_candidates = int(ends.left[end[mutual]].sum())
    # by distance, not by number: of several ends equally near to a start the first one takes it
    mutual = mutual[forth[mutual] == back[near[mutual]]]
    if len(mutual) == 0:
        return None
    second, chosen = np.unique(near[mutual], return_index=True)
    return end[mutual[chosen]], start[second], n_candidates


def _join(ends: _Places, starts: _Places, first: Ints, second: Ints, match: Ints) -> int:
    """Join the members of pairs of places one to one, as many as both have; return their number."""
    size = np.minimum(ends.left[first], starts.left[second])
    match[ends.member[ranges(ends.first[first], size)[1]]] = starts.member[ranges(starts.first[second], size)[1]]
    for places, rows in ((ends, first), (starts, second)):
        places.first[rows] += size
        places.left[rows] -= size
    return int(size.sum())


def _match_one_by_one(ends: _Places, starts: _Places, match: Ints) -> None:
    """Join places as :func:`_match_nearest`, the nearest pair of all first; each end knows the nearest free start."""
    end, row = np.flatnonzero(ends.left), np.flatnonzero(starts.left)
    tree = cKDTree(starts.point[row])
    first = tree.query(ends.point[end], k=np.arange(_ASKED) + 1, distance_upper_bound=_GAP)
    nearest = {
        number: _by_distance(tree, row, point, starts.left, *known)
        for number, point, *known in zip(end.tolist(), ends.point[end], *first, strict=True)
    }
    ahead = [(*found, number) for number in nearest if (found := next(nearest[number], None))]
    heapify(ahead)
    while ahead:
        _, start, number = heappop(ahead)
        if size := int(min(ends.left[number], starts.left[start])):
            match[ends.take(number, size)] = starts.take(start, size)
        if ends.left[number] and (found := next(nearest[number], None)):
            heappush(ahead, (*found, number))


def _by_distance(
    tree: cKDTree, row: Ints, point: Floats, left: Ints, distance: Floats, found: Ints
) -> Iterator[tuple[float, int]]:
    """Yield distance and number of the places within the gap that are not taken yet, the nearest first.

    Distance and row in the tree of the first of them are known.
    """
    n_known = 0
    while True:
        near = np.flatnonzero(np.isfinite(distance))
        free = near[left[row[found[near]]] > 0]
        yield from zip(distance[free].tolist(), row[found[free]].tolist(), strict=True)
        if len(near) < len(distance):
            return
        n_known += len(distance)
        distance, found = tree.query(point, k=np.arange(n_known) + n_known + 1, distance_upper_bound=_GAP)


def _unmatched(match: Ints) -> Mask:
    """Return the elements that are nobody's partner; -1 means no partner."""
    free = np.ones(len(match), dtype=bool)
    free[match[match >= 0]] = False
    return free


def _close_on_itself(following: Ints, tail: Ints, head: Ints, match: Ints) -> None:
    """Join the end of every chain that is still open to its own start."""
    last = following.copy()
    done = match >= 0
    last[tail[done]] = head[match[done]]
    last[tail[~done]] = tail[~done]
    # every step doubles how far a segment looks ahead, until it sees the end of its chain
    for _ in range(len(following).bit_length()):
        last = last.take(last)
    number = np.empty(len(following), dtype=np.int64)
    number[tail] = np.arange(len(tail))
    free = np.flatnonzero(_unmatched(match))
    match[number[last[head[free]]]] = free
