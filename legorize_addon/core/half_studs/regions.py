"""Where half studs pay: parts of a model that fit a grid half a stud further on better than that of the rest.

A region is what hangs together from some layer on upwards (a head, a horn) or from some layer on downwards (a tail, a
leg, a wheel). All regions of a model are tried in all phases, and the one that saves most is taken until none pays.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Final, NamedTuple

import numpy as np
from scipy.sparse import coo_array
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


Key = tuple[int, int, bool, int]
"""What tells a region from all others: its first and last layer, whether it reaches upwards, its lowest island."""

_Candidate = tuple[Key, Ints]


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
    candidates = [each for each in _candidates(islands) if each[0] not in barred]
    best: tuple[float, Choice] | None = None
    for base in PHASES if anywhere else PHASES[:1]:
        for forward in PHASES:
            cost, off, regions = _greedy(islands, candidates, base, forward, price)
            cost += _ASKEW * (base != PHASES[0]) * islands.error[:, 0].sum()
            if best is None or cost < best[0] - 1e-9:
                best = cost, Choice(base, forward, off, regions)
    assert best is not None
    return best[1]


def _candidates(islands: Islands) -> list[_Candidate]:
    """List all regions: the key of each, and its islands."""
    n, known = len(islands.layer), set()
    found: list[_Candidate] = []
    for upwards in (True, False):
        for layer in range(int(islands.layer.max(initial=0)) + 1):
            inside = islands.layer >= layer if upwards else islands.layer <= layer
            links = islands.links[inside[islands.links].all(axis=1)]
            graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(n, n))
            label = connected_components(graph, directed=False)[1]
            for each in np.unique(label[inside & (islands.layer == layer)]).tolist():
                rows = np.flatnonzero(inside & (label == each))
                key = rows.tobytes()
                if key not in known and len(rows) < n:
                    known.add(key)
                    low, high = islands.layer[rows[[0, -1]]].tolist()
                    found.append(((low, high, upwards, int(rows[0])), rows))
    return found


def _greedy(
    islands: Islands, candidates: list[_Candidate], base: tuple[int, int], forward: tuple[int, int], price: float
) -> tuple[float, Ints, tuple[Region, ...]]:
    """Take the region that saves most until none pays; return what is left to pay, the phases, and the regions."""
    n = len(islands.layer)
    error = islands.error[:, [PHASES.index((base[0] ^ x, base[1] ^ y)) for x, y in PHASES]]
    member = np.array([np.isin(np.arange(n), each[1]) for each in candidates]).reshape(-1, n)
    least = _GAIN * error[:, 0].sum()
    off, regions = np.zeros(n, np.int64), list[Region]()
    now = float(_cost(islands, error, off[None], price)[0])
    while len(regions) < _MOST:
        tried = np.stack([np.where(member, phase, off) for phase in range(len(PHASES))]).reshape(-1, n)
        cost = _cost(islands, error, tried, price)
        order = np.argsort(cost, kind="stable")
        pays = order[cost[order] < now - least].tolist()
        best = next((row for row in pays if _apart(islands, tried[row], base, forward)), None)
        if best is None:
            break
        off, now = tried[best], float(cost[best])
        phase, row = divmod(best, len(candidates))
        low, high, upwards, number = candidates[row][0]
        regions.append(Region(low, high, upwards, number, PHASES[phase]))
    return now, off, tuple(regions)


def _cost(islands: Islands, error: Floats, off: Ints, price: float) -> Floats:
    """Return what phases of islands cost, (k,) for (k, n): what they err, and the parts between them."""
    lower, upper = islands.links.T
    jumps = off[:, lower] != off[:, upper]
    parts: Floats = _PARTS * jumps @ np.maximum(islands.overlap, 1)
    return error[np.arange(off.shape[1]), off].sum(axis=1) + price * parts


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
