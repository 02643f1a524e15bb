"""Neighbouring cell columns become alike where that saves parts: iterated conditional modes.

Every cell column of a layer is laid as a brick or as plates, in colours. Each
changes, one after the other, to what costs least given its neighbours: its own
error, and what it adds to the number of parts. Alone in its sheet a plate is a
part of its own; beside a like one it is half a part.

References
----------
J. Besag, "On the Statistical Analysis of Dirty Pictures", Journal of the Royal
Statistical Society B 48 (1986): iterated conditional modes, and the updating of
sites that do not depend on each other at once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..model import COLOUR_ANY, COLOUR_EMPTY, agree
from .colour_votes import Codes

_PLATE: Final = (1.0, 0.5, 0.15, 0.1, 0.1)
_BRICK: Final = (1.0, 0.15, 0.1, 0.1, 0.1)
"""Parts that a plate and a brick of one cell count for, by how many of its four
neighbours one part may cover with it. Bricks also reach inwards, where nobody
looks, so that one neighbour is as good as two."""

_PRICE: Final = np.array([_BRICK, _PLATE, _PLATE, _PLATE])
_SLOT: Final = np.arange(4)
_TURNS: Final = 5
_REACH: Final = 2
"""Steps to the neighbours, and to those which they may be joined with."""

_SWEEPS: Final = 4
_DIGITS: Final = 6
"""Digits of a cost that count, so that equal ones are equal on every machine."""

Offers = Callable[[Ints, Codes, Codes], tuple[Codes, Floats]]
"""Given which columns (n,), what they are now (n, 3) and their neighbours (n, 4, 3):
what they may be (n, m, 3), first what they are now, and the error of each (n, m)."""


@dataclass(frozen=True, slots=True, eq=False)
class Columns:
    """Cell columns of a grid that are not empty.

    Attributes
    ----------
    layer, y, x : (n,) int64 arrays
    beside : (n + 1, 4) int64 array
        Row of each neighbour in the layer; n, which stands for an empty column
        and has only itself as neighbours, where there is none.
    """

    layer: Ints
    y: Ints
    x: Ints
    beside: Ints

    @classmethod
    def of(cls, there: Mask, active: Mask) -> Columns:
        """List columns that are there, (n_layers, n_y, n_x) bool: active ones, and all that their cost depends on."""
        around = active
        for _ in range(_REACH):
            around = grown_aside(around)
        layer, y, x = np.nonzero(there & around)
        row = np.full(np.add(there.shape, (0, 2, 2)), len(layer), dtype=np.int64)
        row[layer, y + 1, x + 1] = np.arange(len(layer))
        beside = [row[layer, y + 1 + up, x + 1 + right] for up, right in ((-1, 0), (1, 0), (0, -1), (0, 1))]
        none = np.full((1, len(beside)), len(layer), dtype=np.int64)
        return cls(layer, y, x, np.concatenate([np.stack(beside, axis=1), none]))

    def __len__(self) -> int:
        """Return the number of columns."""
        return len(self.layer)

    def plates(self, cells: NDArray[Any]) -> NDArray[Any]:
        """Return what holds of the three plates of each column, (n, 3), from (n_layers, 3, n_y, n_x)."""
        found: NDArray[Any] = cells[self.layer, :, self.y, self.x]
        return found

    def put(self, cells: NDArray[Any], plates: NDArray[Any]) -> NDArray[Any]:
        """Return a copy of cells, (n_layers, 3, n_y, n_x), with new plates, (n, 3), in the columns."""
        changed = cells.copy()
        changed[self.layer, :, self.y, self.x] = plates
        return changed

    @property
    def turn(self) -> Ints:
        """In which part of a sweep each column changes, (n,).

        No two of one turn are neighbours or have a neighbour in common, so that
        what one saves does not depend on the others.
        """
        turn: Ints = (self.x + 2 * self.y) % _TURNS
        return turn


def relax(codes: Codes, columns: Columns, active: Ints, offers: Offers, worth: float) -> Codes:
    """Change columns until no change gains anything, or a few times each.

    Parameters
    ----------
    codes : (n, 3) int16 array
        Colour of each plate of the columns, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    columns : Columns
    active : (k,) int64 array
        Rows of those that may change.
    offers : callable
        See :data:`Offers`; "which" are positions in `active`.
    worth : float
        What one part less is worth, in the unit of the errors.

    Returns
    -------
    (n, 3) int16 array
        The sum of errors and of what the parts are worth is not above that at the start.
    """
    state, turn = _with_none(codes), columns.turn
    joined = np.zeros((len(state), len(_SLOT)), dtype=np.int64)
    around = _around(active, columns)
    joined[around] = _joins(state, columns, around)
    ready = np.ones(len(active), dtype=bool)
    for _ in range(_SWEEPS):
        for each in range(_TURNS):
            which = np.flatnonzero(ready & (turn[active] == each))
            rows = active[which]
            offered, error = offers(which, state[rows], state[columns.beside[rows]])
            cost = np.round(error + worth * _parts_with(offered, state, joined, columns, rows), _DIGITS)
            best = cost.argmin(axis=1)
            moved = np.flatnonzero(cost[np.arange(len(rows)), best] < cost[:, 0])
            ready[which] = False
            if len(moved):
                state[rows[moved]] = offered[moved, best[moved]]
                changed = _around(rows[moved], columns)
                joined[changed] = _joins(state, columns, changed)
                # a column with one of these as a neighbour may gain now
                ready |= np.isin(active, _around(changed, columns))
        if not ready.any():
            break
    return state[:-1]


def _with_none(codes: Codes) -> Codes:
    """Put an empty column after the others."""
    return np.concatenate([codes, np.full((1, codes.shape[1]), COLOUR_EMPTY, dtype=np.int16)])


def _around(rows: Ints, columns: Columns) -> Ints:
    """Return columns and their neighbours, each once."""
    return np.unique(np.concatenate([rows, columns.beside[rows].ravel()]))


def _joins(state: Codes, columns: Columns, rows: Ints) -> Ints:
    """Count the neighbours that one part may cover as well, for each of four slots, (n, 4)."""
    joins: Ints = _joined(state[rows][:, None], state[columns.beside[rows]]).sum(axis=1)
    return joins


def _parts_with(offered: Codes, state: Codes, joined: Ints, columns: Columns, rows: Ints) -> Floats:
    """Return the parts that columns and their neighbours count for, but for a constant, by what they become, (n, m)."""
    near = columns.beside[rows]
    beside = state[near]
    here = _joined(offered[:, :, None], beside[:, None])
    own = _PRICE[_SLOT, here.sum(axis=2)] * _laid(offered)
    # the neighbours' other neighbours stay as they are
    others = joined[near] - _joined(beside, state[rows][:, None])
    counted = _PRICE[_SLOT, others[:, None] + here] * _laid(beside)[:, None]
    found: Floats = own.sum(axis=2) + counted.sum(axis=(2, 3))
    return found


def grown_aside(mask: Mask) -> Mask:
    """Return a mask, (n_layers, n_y, n_x), with the four neighbours of its columns."""
    grown = mask.copy()
    grown[:, 1:] |= mask[:, :-1]
    grown[:, :-1] |= mask[:, 1:]
    grown[:, :, 1:] |= mask[:, :, :-1]
    grown[:, :, :-1] |= mask[:, :, 1:]
    return grown


def is_brick(codes: Codes) -> Mask:
    """Return which columns, (..., 3), are laid as bricks: full ones of one colour."""
    top = codes.max(axis=-1)
    whole: Mask = ((codes == top[..., None]) | (codes == COLOUR_ANY)).all(axis=-1) & (top != COLOUR_EMPTY)
    return whole


def _laid(codes: Codes) -> Mask:
    """Return where columns, (..., 3), have something: as a brick, and as each of three plates, (..., 4)."""
    brick = is_brick(codes)[..., None]
    return np.concatenate([brick, (codes != COLOUR_EMPTY) & ~brick], axis=-1)


def _joined(first: Codes, second: Codes) -> Mask:
    """Return where one part may cover two columns: as bricks, and as each of three plates, (..., 4)."""
    one, two = is_brick(first), is_brick(second)
    bricks = one & two & agree(first.max(axis=-1), second.max(axis=-1))
    there = (first != COLOUR_EMPTY) & (second != COLOUR_EMPTY)
    plates = agree(first, second) & there & ~(one | two)[..., None]
    return np.concatenate([bricks[..., None], plates], axis=-1)
