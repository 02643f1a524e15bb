"""Specks go, features stay: bricks of one column whose colour stands alone.

An eye, a button, the dot of a letter and a speck on a flank are all one column of
a colour that none of its neighbours has. Two things tell them apart. A feature has
a surface of its own colour: at least half of what is seen in it. The grey between
a white and a black patch has not; it is a mixture, the colour least unlike to two
others. And a feature is missed: in the colour of its neighbours its surface would
look clearly different. What is a mixture, or would not be missed, takes the colour
around it. Where surface counts at least twice as much as usual, nothing is a speck.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Floats, Ints, Mask
from .colour_votes import CLEAR, Ballot, Codes

OWN: Final = 0.5
"""Share of a feature's surface that has its own colour, at least."""

MISSED: Final = CLEAR / 4
"""CIEDE2000 by which the mean difference of a feature's surface grows in another colour, at least. At
48 studs, lone bricks in a clear colour of their own grew by 5.7 to 23, shades beside the next shade by .1 to 2."""

_WAYS: Final = np.array([way for way in product((-1, 0, 1), repeat=3) if way > (0, 0, 0)])
"""From a cell to half of its 26 neighbours, the others being those that it is a neighbour of."""


def without_specks(colour: Codes, seen: Mask, ballot: Ballot, *, height: int) -> Codes:
    """Give specks the colours around them.

    Parameters
    ----------
    colour : (n_levels, n_y, n_x) int16 array
        LDraw codes, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    seen : (n_levels, n_y, n_x) bool array
        Visible cells; others stay as they are.
    ballot : Ballot
        What the surface of each visible cell asks for.
    height : int
        Levels of a column: those of a layer.

    Returns
    -------
    (n_levels, n_y, n_x) int16 array
        A speck has, of the colours of neighbours that are not alone themselves, the one most like its surface; the
        one that most of them have where it has no surface.
    """
    if len(ballot.codes) == 0:
        return colour
    # what becomes alone when a neighbour goes is looked at next; each round has fewer patches
    while ((after := _once(colour, seen, ballot, height)) != colour).any():
        colour = after
    return colour


def _once(colour: Codes, seen: Mask, ballot: Ballot, height: int) -> Codes:
    """Look at every lone patch once."""
    patches = _Patches.of(colour, seen, height)
    kept = np.bincount(patches.number, ballot.weighted) > 0
    alone = np.flatnonzero((patches.columns == 1) & ~kept)
    row = np.full(len(patches.columns), -1, dtype=np.int64)
    row[alone] = np.arange(len(alone))
    cells = np.flatnonzero((row[patches.number] >= 0) & np.isin(patches.code, ballot.codes))
    if len(cells) == 0:
        return colour
    of = row[patches.number[cells]]
    votes, own = np.zeros((len(alone), len(ballot.codes))), np.zeros(len(alone), dtype=np.int64)
    np.add.at(votes, of, ballot.votes[cells])
    own[of] = np.searchsorted(ballot.codes, patches.code[cells])
    code = patches.code.copy()
    code[cells] = ballot.codes[_settled(votes, _beside(patches, row, ballot.codes), own, ballot.difference)][of]
    changed = colour.copy()
    changed[seen] = code
    return changed


@dataclass(frozen=True, slots=True, eq=False)
class _Patches:
    """Visible cells of one colour that hang together, by faces, edges or corners.

    Attributes
    ----------
    pairs : (m, 2) int64 array
        Visible cells that are neighbours.
    code : (n_seen,) int16 array
        Colour of each visible cell.
    number : (n_seen,) int64 array
        Its patch.
    columns : (n,) int64 array
        Columns of each patch.
    """

    pairs: Ints
    code: Codes
    number: Ints
    columns: Ints

    @classmethod
    def of(cls, colour: Codes, seen: Mask, height: int) -> _Patches:
        """Find them."""
        pairs, code = _neighbours(seen), colour[seen]
        alike = pairs[code[pairs[:, 0]] == code[pairs[:, 1]]]
        graph = coo_array((np.ones(len(alike), dtype=bool), (alike[:, 0], alike[:, 1])), shape=(len(code), len(code)))
        n, number = connected_components(graph, directed=False)
        level, y, x = np.nonzero(seen)
        column = np.ravel_multi_index((level // height, y, x), seen.shape)
        each = np.unique(np.column_stack([number, column]), axis=0)
        return cls(pairs, code, number.astype(np.int64), np.bincount(each[:, 0], minlength=n))


def _neighbours(seen: Mask) -> Ints:
    """Return the pairs of visible cells that meet at a face, an edge or a corner, each once, (m, 2)."""
    number = np.full(np.add(seen.shape, 2), -1, dtype=np.int64)
    number[1:-1, 1:-1, 1:-1][seen] = np.arange(np.count_nonzero(seen))
    place = np.argwhere(seen) + 1
    pairs = [np.column_stack([np.arange(len(place)), number[tuple((place + way).T)]]) for way in _WAYS]
    every = np.concatenate(pairs)
    found: Ints = every[every[:, 1] >= 0]
    return found


def _beside(patches: _Patches, row: Ints, codes: Codes) -> Ints:
    """Count the neighbours of each lone patch by colour, (n_alone, k); neighbours that are alone do not count."""
    both = np.concatenate([patches.pairs, patches.pairs[:, ::-1]])
    here, there = row[patches.number[both]].T
    near = both[(here >= 0) & (there < 0), 1]
    place = np.searchsorted(codes, patches.code[near])
    counted = (place < len(codes)) & (codes[np.minimum(place, len(codes) - 1)] == patches.code[near])
    at = here[(here >= 0) & (there < 0)][counted] * len(codes) + place[counted]
    n_alone = int(row.max(initial=-1)) + 1
    return np.bincount(at, minlength=n_alone * len(codes)).reshape(n_alone, len(codes))


def _settled(votes: Floats, beside: Ints, own: Ints, difference: Floats) -> Ints:
    """Return the colour of each lone patch as a position among the codes, (n_alone,)."""
    each, total = np.arange(len(own)), votes.sum(axis=1)
    share = votes / np.where(total > 0, total, 1)[:, None]
    cost = np.where(beside > 0, share @ difference, np.inf)
    # among equal ones, as all are where nothing is seen of a surface, the one of most neighbours
    other = np.lexsort((-beside, np.round(cost, 6)), axis=1)[:, 0]
    extra = cost[each, other] - (share @ difference)[each, own]
    feature = (share[each, own] >= OWN) & (extra >= MISSED)
    return np.where(feature | (beside.sum(axis=1) == 0), own, other)
