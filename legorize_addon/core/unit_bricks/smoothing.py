"""Fewer parts: cell columns take the plates and colours of their neighbours where that costs little.

A single plate between bricks, or a cell in a shade of its own, is a part of its
own that holds little. What a column may become instead is weighed against the
error, in volume or in colour, that it costs.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import COLOUR_ANY, COLOUR_EMPTY
from ..units import PLATES_PER_BRICK
from .colour_votes import CLEAR, Ballot, Codes, cost_in
from .icm import Columns, is_brick, relax

_SHAPES: Final = np.array(list(product((False, True), repeat=PLATES_PER_BRICK)))
_LIKELIEST: Final = 4
"""Colours of its own surface that a column is tried in."""

_CONTRAST: Final = 1.5
"""Exponent on colour differences: small ones may be traded away."""


def smooth_shapes(solid: Mask, share: Floats, factor: Floats | float = 1.0, *, least_gain: float, worth: float) -> Mask:
    """Fill up cell columns of one or two plates where that saves parts.

    Nothing is removed, so that nothing thin is lost, and no hole or gap opens.

    Parameters
    ----------
    solid : (n_plates, n_y, n_x) bool array
    share : (n_plates, n_y, n_x) float64 array
        Share of each cell inside the mesh.
    factor : (n_plates, n_y, n_x) float64 array or float, optional
        How many times as much as usual the error of each cell counts.
    least_gain : float
        Error, as a share of a brick's volume, that a column of plates must save.
    worth : float
        Error that one part less is worth.

    Returns
    -------
    (n_plates, n_y, n_x) bool array
        Some columns of one or two plates have more of them.
    """
    plates = solid.reshape(-1, PLATES_PER_BRICK, *solid.shape[1:])
    filled = plates.any(axis=1)
    columns = Columns.of(filled, filled & ~plates.all(axis=1))
    there = columns.plates(plates)
    active = np.flatnonzero(~there.all(axis=1))
    counts = np.broadcast_to(factor, solid.shape)
    inside, counts = (columns.plates(each.reshape(plates.shape))[active] for each in (share, counts))
    allowed = (_SHAPES | ~there[active][:, None]).all(axis=2)
    error = (counts[:, None] * np.abs(inside[:, None] - _SHAPES)).mean(axis=2)
    error += least_gain * ~_SHAPES.all(axis=1)
    offers = _Shapes(np.where(allowed, error, np.inf))
    # neighbours never close a slit between them one by one, as it takes both: it begins closed where it hardly pays
    start = there.copy()
    closed = (there | columns.plates(_slits(solid).reshape(plates.shape)))[active].all(axis=1)
    start[active[closed & (offers.error.argmin(axis=1) == len(_SHAPES) - 1)]] = True
    found = relax(_codes(start), columns, active, offers, worth) != COLOUR_EMPTY
    return columns.put(plates, found).reshape(solid.shape)


def _slits(solid: Mask) -> Mask:
    """Return the empty plates right between two solid ones, (n_plates, n_y, n_x)."""
    slits = ~solid
    slits[1:] &= solid[:-1]
    slits[:-1] &= solid[1:]
    slits[[0, -1]] = False
    return slits


@dataclass(frozen=True, slots=True, eq=False)
class _Shapes:
    """What columns may become: any shape that does not err infinitely, (n, 8), in the order of binary numbers."""

    error: Floats

    def __call__(self, which: Ints, now: Codes, _beside: Codes) -> tuple[Codes, Floats]:
        """Offer every shape."""
        number = (now != COLOUR_EMPTY) @ (1 << np.arange(PLATES_PER_BRICK)[::-1])
        error = self.error[which]
        every = np.broadcast_to(_codes(_SHAPES), (len(which), *_SHAPES.shape))
        own = np.take_along_axis(error, number[:, None], axis=1)
        return np.concatenate([now[:, None], every], axis=1), np.concatenate([own, error], axis=1)


def _codes(solid: Mask) -> Codes:
    return np.where(solid, COLOUR_ANY, COLOUR_EMPTY).astype(np.int16)


def smooth_colours(
    colour: Codes, seen: Mask, ballot: Ballot, marked: Mask, *, least_gain: float, worth: float
) -> Codes:
    """Give visible cell columns colours of their neighbours, or one of their own for all plates, to save parts.

    Parameters
    ----------
    colour : (n_plates, n_y, n_x) int16 array
        LDraw codes, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    seen : (n_plates, n_y, n_x) bool array
        Visible cells; others stay as they are.
    ballot : Ballot
        What the surface of each visible cell asks for.
    marked : (n_layers,) bool array
        Layers in which full columns may have several colours.
    least_gain : float
        Error that several colours of a full column must save; 1 is a clear
        difference on all faces of a brick.
    worth : float
        Error that one part less is worth.

    Returns
    -------
    (n_plates, n_y, n_x) int16 array
    """
    cells = colour.reshape(-1, PLATES_PER_BRICK, *colour.shape[1:])
    columns = Columns.of((cells != COLOUR_EMPTY).any(axis=1), seen.reshape(cells.shape).any(axis=1))
    codes = columns.plates(cells)
    active = _undecided(codes, columns)
    if len(active) == 0 or len(ballot.codes) == 0:
        return colour
    shown = columns.plates(seen.reshape(cells.shape))[active]
    number = columns.plates((np.cumsum(seen.ravel()) - 1).reshape(cells.shape))[active]
    error = ballot.factor[:, None] * (ballot.cost / CLEAR) ** _CONTRAST
    cost = np.where(shown[:, :, None], error[number], 0.0) / PLATES_PER_BRICK
    voted = ((ballot.votes[number] > 0) & shown[:, :, None]).any(axis=1)
    price = np.where(marked[columns.layer[active]], least_gain, np.inf)
    offers = _Colours(ballot.codes, cost, shown, _likeliest(cost, voted, ballot.codes), price)
    return columns.put(cells, relax(codes, columns, active, offers, worth)).reshape(colour.shape)


@dataclass(frozen=True, slots=True, eq=False)
class _Colours:
    """What colours columns may take: some of their own surface, and those of their neighbours.

    Attributes
    ----------
    codes : (k,) int16 array
    cost : (n, 3, k) float64 array
        Error of each plate in each colour, as a share of a clear difference on a brick.
    shown : (n, 3) bool array
        Plates that have a colour.
    likeliest : (n, m) int16 array
        Colours of their own, ``COLOUR_ANY`` for none.
    price : (n,) float64 array
        Extra cost of several colours in a full column.
    """

    codes: Codes
    cost: Floats
    shown: Mask
    likeliest: Codes
    price: Floats

    def __call__(self, which: Ints, now: Codes, beside: Codes) -> tuple[Codes, Floats]:
        """Offer one colour for all plates, or the neighbours' plate by plate."""
        one = np.concatenate([self.likeliest[which], beside.max(axis=2)], axis=1)
        every = np.concatenate([np.repeat(one[:, :, None], PLATES_PER_BRICK, axis=2), beside], axis=1)
        taken = np.where(self.shown[which][:, None] & (every >= 0), every, now[:, None])
        offered = np.concatenate([now[:, None], taken], axis=1)
        error = cost_in(self.cost[which], self.shown[which], self.codes, offered).sum(axis=2)
        several = (offered != COLOUR_EMPTY).all(axis=2) & ~is_brick(offered)
        return offered, error + np.where(several, self.price[which, None], 0.0)


def _undecided(codes: Codes, columns: Columns) -> Ints:
    """Return the columns of several colours, and those beside another colour."""
    around = np.concatenate([codes, np.full((1, PLATES_PER_BRICK), COLOUR_EMPTY, dtype=np.int16)])[columns.beside[:-1]]
    highest = codes.max(axis=1)
    several = ((codes >= 0) & (codes != highest[:, None])).any(axis=1)
    differs = (around >= 0) & (codes[:, None] >= 0) & (around != codes[:, None])
    return np.flatnonzero(several | differs.any(axis=(1, 2)))


def _likeliest(cost: Floats, voted: Mask, codes: Codes) -> Codes:
    """Return the colours of a column's surface that are closest to all of it, ``COLOUR_ANY`` where there are no more.

    Parameters
    ----------
    cost : (n, 3, k) float64 array
    voted : (n, k) bool array
    codes : (k,) int16 array

    Returns
    -------
    (n, 4 or k) int16 array
    """
    total = np.where(voted, np.round(cost.sum(axis=1), 6), np.inf)
    order = np.argsort(total, axis=1, kind="stable")[:, :_LIKELIEST]
    found: Codes = np.where(np.take_along_axis(voted, order, axis=1), codes[order], np.int16(COLOUR_ANY))
    return found
