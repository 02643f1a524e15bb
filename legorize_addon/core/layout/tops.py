"""Smooth tops: tiles where the studs of a finished layout can be seen and hold nothing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..geometry import outer_air
from ..model import (
    NOBODY,
    SUPPORTS,
    Bricks,
    Catalogue,
    ContactGraph,
    column_facts,
    concatenate,
    contact_graph,
    stud_columns,
)
from .top_pieces import HIDDEN, HOLDS, NONE, SEEN, Piece, Tops


@dataclass(frozen=True, slots=True, eq=False)
class Smoothed:
    """A layout with smooth tops.

    Attributes
    ----------
    bricks : Bricks
        What lies in the place of a brick stands in its place in the table.
    origin : (n,) int64 array
        Row that each had before.
    seen, left : int
        Studs in sight before and after.
    """

    bricks: Bricks
    origin: Ints
    seen: int
    left: int


def smooth_tops(
    bricks: Bricks, catalogue: Catalogue, *, price: float, may: Mask, at_most: Ints | None = None
) -> Smoothed:
    """Lay tiles where studs can be seen.

    Parameters
    ----------
    bricks : Bricks
        A finished layout.
    catalogue : Catalogue
        Parts that may be laid.
    price : float
        Studs that a part more has to take out of sight: a plate that is only partly free is cut, and a brick becomes
        two plates and a tile. Infinite where there may be no more parts: then only plates without anything on them
        become tiles, each the one of its size.
    may : (n,) bool array
        Bricks that may be exchanged.
    at_most : (n_parts,) int64 array, optional
        How many of each part there are; the highest places get them.

    Returns
    -------
    Smoothed
        It fills the same cells in the same colours, and hangs together as well as before: a plate that ties what is
        below it stays whole.
    """
    graph, state = contact_graph(bricks, catalogue), stud_states(bricks, catalogue)
    chosen = _exchanges(bricks, Tops(catalogue, price), state, may)
    if at_most is not None:
        # some may lie there already; what is exchanged gives none back, as nothing but plates is
        chosen = _within(chosen, bricks, np.maximum(at_most - np.bincount(bricks.part, minlength=len(at_most)), 0))
    made, origin = _exchanged(bricks, chosen)
    while len(torn := _torn(contact_graph(made, catalogue), graph, origin)):
        chosen = {row: pieces for row, pieces in chosen.items() if row not in torn}
        made, origin = _exchanged(bricks, chosen)
    left = stud_states(made, catalogue)
    return Smoothed(made, origin, *(int(np.count_nonzero(each.state == SEEN)) for each in (state, left)))


@dataclass(frozen=True, slots=True, eq=False)
class StudStates:
    """The stud squares of bricks, as :func:`~..model.stud_columns` lists them.

    Attributes
    ----------
    brick : (k,) int32 array
        Row of the brick.
    xy : (k, 2) int32 array
        From its corner.
    state : (k,) uint8 array
        ``NONE``, ``HOLDS``, ``HIDDEN`` or ``SEEN``.
    """

    brick: NDArray[np.int32]
    xy: NDArray[np.int32]
    state: NDArray[np.uint8]


def stud_states(bricks: Bricks, catalogue: Catalogue) -> StudStates:
    """Find out what the studs of bricks hold, and which of them can be seen from outside."""
    brick, columns = stud_columns(bricks, catalogue)
    facts, graph = column_facts(bricks, catalogue), contact_graph(bricks, catalogue)
    owner = np.pad(graph.owner, ((0, 1), (0, 0), (0, 0)), constant_values=NOBODY)
    air = outer_air(owner != NOBODY)
    x, y, z = (columns - graph.low).T
    above = (z + facts.high - facts.low, y, x)
    state = np.where(owner[above] != NOBODY, HOLDS, np.where(air[above], SEEN, HIDDEN))
    state = np.where(facts.stud, state, NONE).astype(np.uint8)
    return StudStates(brick, columns[:, :2] - bricks.corner[brick, :2], state)


Exchanges = dict[int, tuple[Piece, ...]]
"""What lies in the place of bricks, by row."""


def _exchanges(bricks: Bricks, tops: Tops, states: StudStates, may: Mask) -> Exchanges:
    """Return what every brick would be exchanged for by itself."""
    seen = np.bincount(states.brick, states.state == SEEN, len(bricks)) > 0
    free = np.isin(bricks.part, tops.rows) & ~np.isin(bricks.role, SUPPORTS)
    first = np.searchsorted(states.brick, np.arange(len(bricks) + 1))
    found: Exchanges = {}
    for row in np.flatnonzero(seen & free & may).tolist():
        own = slice(first[row], first[row + 1])
        box = np.full(states.xy[own].max(axis=0) + 1, NONE, np.uint8)
        box[tuple(states.xy[own].T)] = states.state[own]
        if pieces := tops.pieces(int(bricks.part[row]), int(bricks.turn[row]), int(bricks.colour[row]), box):
            found[row] = pieces
    return found


def _within(chosen: Exchanges, bricks: Bricks, at_most: Ints) -> Exchanges:
    """Return the highest exchanges for which there are enough parts."""
    left, kept = at_most.copy(), set[int]()
    for row in sorted(chosen, key=lambda row: (-int(bricks.corner[row, 2]), row)):
        parts = [piece.part for piece in chosen[row]]
        needed = np.bincount(parts, minlength=len(left))
        if (needed <= left).all():
            left -= needed
            kept.add(row)
    return {row: pieces for row, pieces in chosen.items() if row in kept}


def _exchanged(bricks: Bricks, chosen: Exchanges) -> tuple[Bricks, Ints]:
    """Put pieces in the place of bricks; return the rows that all had before as well."""
    rows = np.repeat(list(chosen), [len(pieces) for pieces in chosen.values()]).astype(np.int64)
    pieces = [piece for each in chosen.values() for piece in each]
    new = bricks.take(rows)
    new = replace(
        new,
        part=np.array([piece.part for piece in pieces], np.int16),
        corner=new.corner + np.array([piece.corner for piece in pieces], np.int32).reshape(-1, 3),
        turn=np.array([piece.turn for piece in pieces], np.uint8),
    )
    stay = np.setdiff1d(np.arange(len(bricks)), rows)
    origin = np.concatenate([stay, rows])
    order = np.argsort(origin, kind="stable")
    return concatenate([bricks.take(stay), new]).take(order), origin[order]


def _torn(now: ContactGraph, before: ContactGraph, origin: Ints) -> frozenset[int]:
    """Return the rows of the bricks whose pieces no longer hang together, if there are more components than before."""
    if now.n_components <= before.n_components:
        return frozenset()
    low, high = np.full((2, int(origin.max()) + 1), now.n_components)
    np.minimum.at(low, origin, now.component)
    high[:] = -1
    np.maximum.at(high, origin, now.component)
    return frozenset(np.flatnonzero(low < high).tolist())
