"""Where components of a layout come near to each other, and what it costs to join them there.

A plate that joins two components lies across a seam between two stud squares. In
each of them it takes the place of a part of a brick, or it is added in an empty
cell, where it holds to the brick above or below.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy import ndimage

from ...arrays import Floats, Ints, Mask
from ...geometry import outer_air
from ...model import NOBODY, agree, ground_of
from ...units import PLATES_PER_BRICK
from ..problem import Index, Plane, Rows

_PLACES: Final = 12
"""Most places for each two components."""

RECOLOURED: Final = 10.0
_OPEN_FACE: Final = 0.1
"""Price of a cell that is seen in the neighbour's colour, and of each face that it is seen from: a plate below an edge
shows less, one on top shows more."""

_HIDDEN: Final = 0.5
_SEEN: Final = 8.0
_ON_TOP: Final = 1.5
"""Price of an added cell if hidden and if visible, and the extra price on top of a brick."""

_SEAM: Final = 0.01
_LONGEST: Final = 30
"""Value of each cell of the seam between two bricks (a longer plate lies better), and how many count."""


@dataclass(frozen=True, slots=True, eq=False)
class NearContacts:
    """Places for plates that join two components.

    Attributes
    ----------
    bricks : (n, 2) int64 array
        Rows of the bricks that a plate there would hold to.
    place : (n, 3) int64 array
        The first cell of the seam: plane, y and x in the array of owners.
    axis : (n,) int64 array
        Axis on which the second cell follows, 1 or 2.
    added : (n,) int64 array
        How many of the two cells are empty.
    on_top : (n,) int64 array
        How many of these lie on what a plate there would hold to, not below it.
    price : (n,) float64 array
        Colour and looks that a plate there costs.
    """

    bricks: Ints
    place: Ints
    axis: Ints
    added: Ints
    on_top: Ints
    price: Floats

    def take(self, rows: Index) -> NearContacts:
        """Return some of the places."""
        return NearContacts(*(getattr(self, name)[rows] for name in self.__slots__))


@dataclass(frozen=True, slots=True, eq=False)
class _Reach:
    """What a plate in each cell would hold to: what is cut for it there, or what lies above or below."""

    brick: Rows
    price: Floats
    added: int
    on_top: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class _Grid:
    """What all seams have to do with: component of each brick, which are stacked, and colours of the cells in a row."""

    shape: tuple[int, ...]
    component: Rows
    stacked: Mask
    colour: Plane
    recoloured: Floats

    def stride(self, axis: int) -> int:
        """Return how many cells further the next one along an axis is."""
        return int(np.prod(self.shape[axis + 1 :]))

    def few(self, reach: _Reach) -> Ints:
        """Return the cells that reach what is not of the largest component, in order."""
        reached = self.component[reach.brick.reshape(-1)]
        largest = np.bincount(self.component[:-1], minlength=1).argmax()
        return np.flatnonzero((reached != largest) & (reached != NOBODY))

    def beside(self, axis: int, first: Ints, second: Ints) -> Ints:
        """Return the first cells of all pairs along an axis that have a given first or a given second one, in order."""
        stride, size = self.stride(axis), self.shape[axis]
        first = first[first // stride % size < size - 1]
        second = second[second // stride % size > 0]
        found: Ints = np.union1d(first, second - stride)
        return found


def near_contacts(
    owner: Rows,
    component: Rows,
    colour: Plane,
    *,
    plates: bool,
    places: int = _PLACES,
    fixed: Collection[int] = (),
) -> NearContacts:
    """Find where components could be joined, the cheapest places first.

    Parameters
    ----------
    owner : (n_plates + 2, n_y, n_x) int32 array
        Row of the brick in each cell, ``NOBODY`` where there is none.
    component : (n,) int32 array
        Component of each brick.
    colour : (n_plates + 2, n_y, n_x) int16 array
        LDraw code, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    plates : bool
        Whether plates may be added; else only what touches is found.
    places : int
        Most places for each two components.
    fixed : collection of int
        Bricks that nothing is joined to.

    Returns
    -------
    NearContacts
        Some for each two components that come near to each other.
    """
    reaches = list(_reaches(owner)) if plates else [_Reach(owner, np.zeros(owner.shape), 0)]
    if fixed:
        out = np.append(np.isin(np.arange(owner.max() + 1), list(fixed)), False)
        reaches = [replace(each, brick=np.where(out[each.brick], NOBODY, each.brick)) for each in reaches]
    recoloured: Floats = RECOLOURED + _OPEN_FACE * _open_faces(owner).astype(np.float64)
    stacked = _stacked(owner)
    if len(np.unique(colour[(owner != NOBODY) & (colour >= 0) & ~stacked[owner]])) <= 1:
        # a sheet of one colour is no picture
        stacked[:NOBODY] = True
    grid = _Grid(
        owner.shape, np.append(component, np.int32(NOBODY)), stacked, colour.reshape(-1), recoloured.reshape(-1)
    )
    few = [grid.few(reach) for reach in reaches]
    both = list(zip(reaches, few, strict=True))
    found = [
        _across(grid, axis, one, other, grid.beside(axis, first, second))
        for axis in (1, 2)
        for one, first in both
        for other, second in both
    ]
    every = NearContacts(*(np.concatenate([getattr(each, name) for each in found]) for name in NearContacts.__slots__))
    return _chosen(_seams(every, len(component)), component, places)


def _reaches(owner: Rows) -> Iterator[_Reach]:
    """Yield what plates would hold to in full cells, and in empty ones below and above bricks."""
    yield _Reach(owner, np.zeros(owner.shape), 0)
    empty = owner == NOBODY
    price = np.where(outer_air(~empty), _SEEN, _HIDDEN)
    for step, more in ((-1, 1.0), (1, _ON_TOP)):
        brick = np.roll(owner, step, axis=0)
        brick[~empty] = NOBODY
        # nothing is added below the ground or above the grid
        brick[: ground_of(~empty)] = brick[-1] = NOBODY
        yield _Reach(brick, price * more, 1, step == 1)


def _stacked(owner: Rows) -> Mask:
    """Return which bricks lie on or carry others, False for nobody, (n + 1,)."""
    below, above = owner[:-1], owner[1:]
    touch = (below != above) & (below != NOBODY) & (above != NOBODY)
    stacked = np.zeros(owner.max() + 2, dtype=bool)
    stacked[below[touch]] = stacked[above[touch]] = True
    return stacked


def _open_faces(owner: Rows) -> Ints:
    """Count the faces of each cell that nothing touches."""
    cross = ndimage.generate_binary_structure(3, 1).astype(np.int64)
    touched: Ints = ndimage.convolve((owner != NOBODY).astype(np.int64), cross, mode="constant") - 1
    return 2 * owner.ndim - touched


def _across(grid: _Grid, axis: int, one: _Reach, other: _Reach, cells: Ints) -> NearContacts:
    """Return the seams along an axis, of those at some cells, between what two cells reach, if that is two components.

    One of the two is not the largest component: all seams lie beside cells that reach such a one.
    """
    beyond = cells + grid.stride(axis)
    first, second = one.brick.reshape(-1)[cells], other.brick.reshape(-1)[beyond]
    near = (first != NOBODY) & (second != NOBODY) & (grid.component[first] != grid.component[second])
    if one.on_top or other.on_top:
        # a picture is flat on top
        near &= grid.stacked[first] | grid.stacked[second]
    cells, beyond, first, second = cells[near], beyond[near], first[near], second[near]
    differ = ~agree(grid.colour[cells], grid.colour[beyond]) & (one.added + other.added == 0)
    change = np.minimum(grid.recoloured[cells], grid.recoloured[beyond])
    price = one.price.reshape(-1)[cells] + other.price.reshape(-1)[beyond]
    return NearContacts(
        bricks=np.stack([first, second], axis=1).astype(np.int64),
        place=np.stack(np.unravel_index(cells, grid.shape), axis=1).astype(np.int64),
        axis=np.full(len(cells), axis),
        added=np.full(len(cells), one.added + other.added),
        on_top=np.full(len(cells), int(one.on_top) + int(other.on_top)),
        price=price + np.where(differ, change, 0.0),
    )


def _seams(found: NearContacts, n: int) -> NearContacts:
    """Keep the cheapest place of each seam between two of n bricks, in its middle plate if it has one.

    Below and on top of the same two bricks are different seams: what is cut for them may hold at one alone.
    """
    pair = np.sort(found.bricks, axis=1) @ [n, 1]
    plane, y, x = found.place.T
    off_middle = np.abs((plane - 1) % PLATES_PER_BRICK - 1)
    # two ends are added at most
    seam = (pair * 3 + found.added) * 3 + found.on_top
    order = np.lexsort((found.axis, x, y, plane, off_middle, found.price, seam))
    seam = seam[order]
    start = np.flatnonzero(np.diff(seam, prepend=-1))
    length = np.minimum(np.diff(start, append=len(seam)), _LONGEST)
    kept = found.take(order[start])
    return replace(kept, price=kept.price - _SEAM * length)


def _chosen(found: NearContacts, component: Rows, places: int) -> NearContacts:
    """Keep the cheapest places for each two components, the cheapest first."""
    pair = np.sort(component[found.bricks], axis=1) @ np.array([len(component), 1])
    order = np.lexsort((found.price, pair))
    start = np.flatnonzero(np.diff(pair[order], prepend=-1))
    rank = np.arange(len(order)) - np.repeat(start, np.diff(start, append=len(order)))
    order = np.sort(order[rank < places])
    return found.take(order[np.argsort(found.price[order], kind="stable")])
