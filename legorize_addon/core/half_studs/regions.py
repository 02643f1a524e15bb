"""Where half studs pay: parts of a model that fit a grid half a stud further on better than that of the rest.

A region is what hangs together from some layer on upwards (a head, a horn) or from some layer on downwards (a tail, a
leg, a wheel). All regions of a model are tried in all phases, and the one that saves most is taken until none pays.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Final, NamedTuple, Self

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Floats, Ints
from .islands import PARTS, PHASES, Islands

_PARTS: Final = 0.35
"""Parts more for each stud that lies over another phase."""

_GAIN: Final = 0.02
"""Share of the error that a region has to save, all costs counted."""

_ASKEW: Final = 0.005
"""Share of the error that another grid for all has to save, as in the search for the grid."""

_MOST: Final = 8
"""Regions of a model."""

_DIGITS: Final = 9
"""Decimals of costs, in cells, that count."""


Key = tuple[int, int, bool, int]
"""What tells a region from all others: its first and last layer, whether it reaches upwards, its lowest island."""


class Region(NamedTuple):
    """A region that lies half a stud off the rest.

    Attributes
    ----------
    low, high : int
        Its first and last layer from below.
    upwards : bool
        Whether it is all that hangs together from its first layer on upwards, or from its last one downwards.
    number : int
        Its lowest island, which tells it from others.
    half : (int, int)
        Half studs along x and y by which it lies off the rest.
    """

    low: int
    high: int
    upwards: bool
    number: int
    half: tuple[int, int]

    @property
    def key(self) -> Key:
        """What tells it from all others, whatever its half studs."""
        return self[:4]


class Choice(NamedTuple):
    """What is chosen.

    Attributes
    ----------
    base : (int, int)
        Half studs by which the grid of all that is in no region lies further on.
    forward : (int, int)
        1 along the axes, x and y, along which regions are moved forward onto one grid with the rest, 0 for back.
    off : (n,) int64 array
        Row among the phases, beyond the base, for each island.
    regions : tuple of Region
    """

    base: tuple[int, int]
    forward: tuple[int, int]
    off: Ints
    regions: tuple[Region, ...]


class _Candidates(NamedTuple):
    """Regions that there may be, k of them: leaves have thousands, most of few islands.

    Attributes
    ----------
    keys : list of tuple
    islands : (k, n) sparse array
        1 where an island belongs to a region.
    lower, upper, both : (k, m) sparse arrays
        1 where the lower or the upper island of a link does, or both.
    """

    keys: list[Key]
    islands: csr_array
    lower: csr_array
    upper: csr_array
    both: csr_array

    @classmethod
    def of(cls, keys: list[Key], members: list[Ints], islands: Islands) -> Self:
        """Gather regions of which the islands are known."""
        first = np.cumsum([0, *map(len, members)])
        column = np.concatenate([np.zeros(0, np.int64), *members])
        of = csr_array((np.ones(len(column)), column, first), shape=(len(keys), len(islands.layer)))
        links, (low, high) = np.arange(len(islands.links)), islands.links.T
        ends = [
            csr_array((np.ones(len(links)), (end, links)), shape=(len(islands.layer), len(links)))
            for end in (low, high)
        ]
        lower, upper = (csr_array(of @ each) for each in ends)
        return cls(keys, of, lower, upper, csr_array(lower * upper))

    def changes(self, islands: Islands, error: Floats, off: Ints, price: float) -> Floats:
        """Return by how much what is to pay changes in (n,) phases if a region is moved to one, (4 k,), by phase.

        To pay are what islands err, (n, 4), and the parts between those of different phases.
        """
        low, high = islands.links.T
        parts = price * _PARTS * np.maximum(islands.overlap, 1)
        now = parts * (off[low] != off[high])
        found = []
        for phase in range(len(PHASES)):
            # what of a link is moved: its lower end, its upper one, or both
            alone = [parts * (off[other] != phase) - now for other in (high, low)]
            change = self.islands @ (error[:, phase] - error[np.arange(len(off)), off])
            change += self.lower @ alone[0] + self.upper @ alone[1] - self.both @ (alone[0] + alone[1] + now)
            found.append(change)
        # sums of other orders do not choose between regions that are alike
        return np.round(np.concatenate(found), _DIGITS)

    def moved(self, off: Ints, row: int, phase: int) -> Ints:
        """Return (n,) phases with a region moved to one."""
        tried = off.copy()
        tried[self.islands.indices[self.islands.indptr[row] : self.islands.indptr[row + 1]]] = phase
        return tried


def choose_regions(islands: Islands, *, price: float, anywhere: bool, barred: Collection[Key] = frozenset()) -> Choice:
    """Choose the regions of a model, and the grid of the rest.

    Parameters
    ----------
    islands : Islands
    price : float
        Volume that a part more has to save, in cells a plate high.
    anywhere : bool
        Whether the whole model may lie half a stud further on.
    barred : collection of tuple
        Keys of regions that there must not be.

    Returns
    -------
    Choice
    """
    candidates = _candidates(islands, barred)
    best: tuple[float, Choice] | None = None
    for base in PHASES if anywhere else PHASES[:1]:
        for forward in PHASES:
            cost, off, regions = _greedy(islands, candidates, base, forward, price)
            cost += _ASKEW * (base != PHASES[0]) * islands.error[:, 0].sum()
            if best is None or cost < best[0] - 1e-9:
                best = cost, Choice(base, forward, off, regions)
    assert best is not None
    return best[1]


def _candidates(islands: Islands, barred: Collection[Key] = frozenset()) -> _Candidates:
    """List all regions that there may be."""
    n, known = len(islands.layer), set()
    keys, members = list[Key](), list[Ints]()
    for upwards in (True, False):
        for layer in range(int(islands.layer.max(initial=0)) + 1):
            inside = islands.layer >= layer if upwards else islands.layer <= layer
            links = islands.links[inside[islands.links].all(axis=1)]
            graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(n, n))
            label = connected_components(graph, directed=False)[1]
            there = np.unique(label[inside & (islands.layer == layer)])
            mine = np.flatnonzero(inside & np.isin(label, there))
            mine = mine[np.argsort(label[mine], kind="stable")]
            for rows in np.split(mine, np.flatnonzero(np.diff(label[mine])) + 1) if len(mine) else ():
                low, high = islands.layer[rows[[0, -1]]].tolist()
                key = low, high, upwards, int(rows[0])
                if rows.tobytes() not in known and len(rows) < n:
                    known.add(rows.tobytes())
                    if key not in barred:
                        keys.append(key)
                        members.append(rows)
    return _Candidates.of(keys, members, islands)


def _greedy(
    islands: Islands, candidates: _Candidates, base: tuple[int, int], forward: tuple[int, int], price: float
) -> tuple[float, Ints, tuple[Region, ...]]:
    """Take the region that saves most until none pays; return what is left to pay, the phases, and the regions."""
    n = len(islands.layer)
    error = islands.error[:, [PHASES.index((base[0] ^ x, base[1] ^ y)) for x, y in PHASES]]
    now = float(error[:, 0].sum())
    least = _GAIN * now
    off, regions = np.zeros(n, np.int64), list[Region]()
    while len(regions) < _MOST:
        change = candidates.changes(islands, error, off, price)
        order = np.argsort(change, kind="stable")
        for best in order[change[order] < -least].tolist():
            phase, row = divmod(best, len(candidates.keys))
            tried = candidates.moved(off, row, phase)
            if _apart(islands, tried, base, forward):
                break
        else:
            break
        off, now = tried, now + float(change[best])
        low, high, upwards, number = candidates.keys[row]
        regions.append(Region(low, high, upwards, number, PHASES[phase]))
    return now, off, tuple(regions)


def _apart(islands: Islands, off: Ints, base: tuple[int, int], forward: tuple[int, int]) -> bool:
    """Tell whether, on one grid, cells of different phases lie beside none of each other."""
    phases = np.array(PHASES)
    for layer in np.unique(islands.layer[np.flatnonzero(off)]).tolist():
        mine = np.flatnonzero(islands.layer == layer)
        kinds = np.unique(off[mine])
        if len(kinds) < 2:
            continue
        size = np.array(islands.label.shape[:0:-1]) // PARTS + 4
        there = np.zeros((len(kinds), *size), bool)
        for island in mine.tolist():
            way = phases[off[island]]
            place = islands.cells[island][phases.tolist().index((way ^ base).tolist())]
            x, y = ((place - base - way * (1 - 2 * np.array(forward))) // 2 + 2).T
            there[np.searchsorted(kinds, off[island]), x, y] = True
        beside = there.copy()
        for axis in (1, 2):
            beside |= np.roll(there, 1, axis) | np.roll(there, -1, axis)
        if (beside.sum(axis=0)[there.any(axis=0)] > 1).any():
            return False
    return True
