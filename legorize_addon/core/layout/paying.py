"""Which slopes pay: what they gain against the parts that the layout itself takes more around them.

How many bricks a slope costs hardly shows in its own cells: it may end a long brick, or leave a plate that no other one
joins. So the model is laid with all slopes and without some that lie apart, and the parts around each of these are
counted both times.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import Bricks, Catalogue, columns
from ..units import PLATES_PER_BRICK

Lay = Callable[[Bricks], Bricks]
"""Lays all of a model around some slopes."""

_BATCHES: Final = 3
"""Times that a model is laid without some of its slopes: of eight models at 24 studs and four at 48, 95 % find a
place in three."""

_BESIDE: Final = 1
"""Studs around a slope in which parts are counted. With 2 or 3 what is left of three models has as many parts for as
much gain, but only twice as many batches ask for all slopes."""


def paying(slopes: Bricks, worth: Floats, pair: Ints, catalogue: Catalogue, lay: Lay, *, price: float) -> Mask:
    """Tell which slopes gain what the parts that they add cost.

    Parameters
    ----------
    slopes : Bricks
        Without collisions.
    worth : (n,) float64 array
        What each gains, in cells a plate high; infinite where it has to stay.
    pair : (n,) int64 array
        The same number for slopes that stay or go together.
    catalogue : Catalogue
    lay : callable
        Returns the same bricks for the same slopes.
    price : float
        What a part costs, in cells a plate high.

    Returns
    -------
    (n,) bool array
        Also those whose parts could not be counted, because too many others are near.
    """
    pays = np.ones(len(slopes), bool)
    if price <= 0 or not np.isfinite(worth).any():
        return pays
    low, high = _windows(slopes, catalogue)
    unit = np.unique(pair, return_inverse=True)[1]
    asked = _batches(low, high, unit, np.isfinite(worth))
    boxes = _boxes(lay(slopes), catalogue)
    for batch in range(asked.max() + 1):
        out = asked[unit] == batch
        fewer = _boxes(lay(slopes.take(~out)), catalogue)
        more = _parts_in(low[out], high[out], *boxes) - _parts_in(low[out], high[out], *fewer)
        gain = np.bincount(unit[out], worth[out] - price * more, minlength=len(asked))
        pays &= ~(out & (gain[unit] < 0))
    return pays


def _windows(slopes: Bricks, catalogue: Catalogue) -> tuple[Ints, Ints]:
    """Return the first and the last but one cells around slopes, (n, 3) each: whole layers of bricks."""
    low, high = _boxes(slopes, catalogue)
    low[:, :2] -= _BESIDE
    high[:, :2] += _BESIDE
    low[:, 2] -= low[:, 2] % PLATES_PER_BRICK
    high[:, 2] += -high[:, 2] % PLATES_PER_BRICK
    return low, high


def _boxes(bricks: Bricks, catalogue: Catalogue) -> tuple[Ints, Ints]:
    """Return the first and the last but one cells of bricks, (n, 3) each."""
    sizes = np.ones((len(catalogue.parts), 4, 3), np.int64)
    for part in np.unique(bricks.part).tolist():
        for turn in range(4):
            sizes[part, turn, :2] = columns(catalogue.parts[part], turn).xy.max(axis=0) + 1
        sizes[part, :, 2] = catalogue.height[part]
    low = bricks.corner.astype(np.int64)
    return low, low + sizes[bricks.part, bricks.turn]


def _batches(low: Ints, high: Ints, unit: Ints, asked: Mask) -> Ints:
    """Return in which batch each unit is left out, or -1: windows of a batch do not meet those of another unit of it.

    Parameters
    ----------
    low, high : (n, 3) int64 arrays
        Windows.
    unit : (n,) int64 array
        Which unit each belongs to.
    asked : (n,) bool array
        Those that may go.
    """
    n_units = int(unit.max()) + 1
    near: list[set[int]] = [set() for _ in range(n_units)]
    for each, met in zip(unit.tolist(), _meeting(low, high, low, high), strict=True):
        near[each].update(unit[met].tolist())
    may = np.ones(n_units, bool)
    may[unit[~asked]] = False
    batch = np.full(n_units, -1)
    for number in np.flatnonzero(may).tolist():
        full = np.bincount(batch[list(near[number])] + 1, minlength=_BATCHES + 1)[1:] > 0
        if not full.all():
            batch[number] = full.argmin()
    return batch


def _parts_in(low: Ints, high: Ints, first: Ints, last: Ints) -> Floats:
    """Return how many parts reach into windows."""
    return np.array([len(met) for met in _meeting(low, high, first, last)], dtype=np.float64)


def _meeting(low: Ints, high: Ints, first: Ints, last: Ints) -> Iterator[Ints]:
    """Yield of each window the rows of the boxes that reach into it, looked for among those near it along one axis."""
    if not len(first):
        yield from (np.zeros(0, np.int64) for _ in low)
        return
    axis = int((last.max(axis=0) - first.min(axis=0)).argmax())
    order = np.argsort(first[:, axis], kind="stable")
    first, last = first[order], last[order]
    longest = int((last - first)[:, axis].max())
    begin = np.searchsorted(first[:, axis], low[:, axis] - longest, side="right").tolist()
    end = np.searchsorted(first[:, axis], high[:, axis], side="left").tolist()
    for row, (one, other) in enumerate(zip(begin, end, strict=True)):
        met = ((first[one:other] < high[row]) & (last[one:other] > low[row])).all(axis=1)
        yield order[one:other][met]
