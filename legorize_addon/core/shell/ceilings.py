"""Ceilings inside a hollowed model, and what carries them while the model is built from below.

A ceiling spans a hollow; a brick holds there if it lies on a cell that stands on
something. Where the hollow is wider than bricks reach, corbels lean out of the
walls, one stud a layer, or pillars rise from the floor. Both are cheapest paths
downwards: the price of a path is the number of its cells, and every path may end
at existing cells, so that corbels share their lower part.

References
----------
Paper, sections on hollowing and on overhangs: a step of one stud a layer carries
itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Ints, Mask
from ..progress import Progress, part, silent

Way = Literal["cheaper", "corbels", "pillars", "free"]

_REACH: Final = 2
"""Studs that bricks reach out from a cell that stands on something: a brick of
three lies with one stud on the support."""

_NOWHERE: Final = np.iinfo(np.int16).max // 2
"""Price of a path that cannot be built; twice that is still an int16."""

_PRECISION: Final = 4096
"""Cells carried per cell of a path are compared to this fraction."""

_AROUND: Final = tuple((y, x) for y in (-1, 0, 1) for x in (-1, 0, 1) if (y, x) != (0, 0))


@dataclass(frozen=True, slots=True, eq=False)
class Columns:
    """A hollowed model by columns, three plates each; all arrays (n_layers, n_y, n_x) bool.

    Attributes
    ----------
    bottom, top : Mask
        Whether the lowest and the highest plate of the column must be built.
    whole : Mask
        Columns of which all three plates must be built.
    hollow : Mask
        Columns that were solid and are left out; they may be filled again.
    """

    bottom: Mask
    top: Mask
    whole: Mask
    hollow: Mask

    def filled(self, more: Mask) -> Columns:
        """Return the model with more columns built."""
        return Columns(self.bottom | more, self.top | more, self.whole | more, self.hollow & ~more)

    @property
    def standing(self) -> Mask:
        """Columns that stand on a stud or on the ground."""
        return self.bottom & _raised(self.top, ground=True)

    @property
    def uncarried(self) -> Mask:
        """Ceiling cells over a hollow, out of reach from every cell that stands on something."""
        standing = self.standing
        near = _reached(standing & self.whole, self.whole)
        plates = self.bottom & ~self.whole
        if plates.any():
            # a brick and a plate beside it have no brick in common
            near |= _reached(standing & plates, plates)
        return self.bottom & ~near & _raised(self.hollow, ground=False)


def carriers(columns: Columns, way: Way, progress: Progress = silent) -> tuple[Mask, Mask]:
    """Choose cells that carry the ceilings over hollows.

    Parameters
    ----------
    columns : Columns
        The hollowed model. Hollows do not reach its sides.
    way : {"cheaper", "corbels", "pillars", "free"}
        Corbels lean out of the walls, pillars rise from the floor; "cheaper" is
        what takes fewer cells, hollow by hollow; "free" carries nothing.
    progress : Progress, optional
        Told before each search, and how far it is.

    Returns
    -------
    corbels, pillars : (n_layers, n_y, n_x) bool arrays
        Hollow cells to fill. Each lies in its layer beside or on a cell that
        stands on something.
    """
    none = np.zeros_like(columns.hollow)
    if way == "free":
        return none, none
    if way == "corbels":
        return _carried(columns, progress, leaning=True), none
    pillars = _carried(columns, part(progress, 0.0, 0.4), leaning=False)
    if way == "pillars":
        return none, pillars
    corbels = _carried(columns, part(progress, 0.4, 0.8), leaning=True)
    cavity, n_cavities = ndimage.label(columns.hollow, np.ones((3, 3, 3)))
    cells = [np.bincount(cavity[mask], minlength=n_cavities + 1) for mask in (pillars, corbels)]
    straight = (cells[0] < cells[1])[cavity]
    pillars &= straight
    corbels &= ~straight
    # a ceiling cell between two cavities may have lost what carried it
    return corbels | _carried(columns.filled(corbels | pillars), part(progress, 0.8, 1.0), leaning=True), pillars


def _carried(columns: Columns, progress: Progress, *, leaning: bool) -> Mask:
    """Return cells to fill so that every ceiling is carried wherever possible."""
    before, turns = columns.hollow, 0
    while (uncarried := columns.uncarried).any():
        # usually a few turns: each halves the share
        turns += 1
        progress("hollowing", 1 - 0.5**turns)
        n_layers = int(np.flatnonzero(uncarried.any(axis=(1, 2)))[-1])
        price = _prices(columns, n_layers, leaning=leaning)
        heads = _heads(columns, uncarried[: n_layers + 1], price)
        if len(heads) == 0:
            break
        columns = columns.filled(_paths(columns, heads, price, leaning=leaning))
    return before & ~columns.hollow


def _prices(columns: Columns, n_layers: int, *, leaning: bool) -> NDArray[np.int16]:
    """Return the number of cells that it takes to fill each hollow cell and everything that carries it, layer by layer.

    A filled cell is carried by the cell below itself, or leans on a neighbour in
    its layer that stands on something or is made to.
    """
    hollow = columns.hollow[:n_layers]
    step = np.where(columns.whole[:n_layers], 0, np.where(hollow, 1, _NOWHERE)).astype(np.int16)
    price = np.full_like(step, _NOWHERE)
    below = np.zeros_like(step[0])
    foot = np.pad(below, 1, constant_values=_NOWHERE)
    inner = foot[1:-1, 1:-1]
    for layer in range(n_layers):
        np.add(below, step[layer], out=inner)
        cell = np.where(below == 0, np.int16(1), _least_around(foot) + np.int16(1)) if leaning else inner
        np.copyto(price[layer], np.minimum(cell, np.int16(_NOWHERE)), where=hollow[layer])
        below = np.where(columns.top[layer], np.int16(0), price[layer])
    return price


def _least_around(wide: NDArray[np.int16]) -> NDArray[np.int16]:
    """Return the least of the eight neighbours of each cell of a layer that has a margin."""
    beside = np.minimum(wide[:, :-2], wide[:, 2:])
    rows = np.minimum(beside, wide[:, 1:-1])
    least: NDArray[np.int16] = np.minimum(np.minimum(rows[:-2], rows[2:]), beside[1:-1])
    return least


def _heads(columns: Columns, uncarried: Mask, price: NDArray[np.int16]) -> Ints:
    """Choose cells under ceilings at which paths begin, as flat indices.

    Around each no other cell carries more of the ceiling for its price.
    """
    layers = np.flatnonzero(uncarried.any(axis=(1, 2)))
    below = price[layers - 1].astype(np.int64)
    window = (1, 2 * _REACH + 1, 2 * _REACH + 1)
    near = ndimage.uniform_filter(uncarried[layers].astype(np.float64), window, mode="constant")
    gain = np.rint(near * np.prod(window)).astype(np.int64)
    worth = np.where(columns.bottom[layers] & (below < _NOWHERE), gain * _PRECISION // below, 0)
    order = np.arange(worth.size, 0, -1).reshape(worth.shape)
    # no two cells have the same rank, so that the choice is unique
    rank = np.where(worth > 0, worth * worth.size + order, 0)
    best = ndimage.maximum_filter(rank, (1, 2 * _REACH + 3, 2 * _REACH + 3), mode="constant")
    layer, y, x = np.nonzero((rank > 0) & (rank == best))
    heads: Ints = np.ravel_multi_index((layers[layer] - 1, y, x), columns.hollow.shape)
    return heads


def _paths(columns: Columns, heads: Ints, price: NDArray[np.int16], *, leaning: bool) -> Mask:
    """Return the cells of cheapest paths from the heads down to existing cells."""
    n_x = columns.hollow.shape[2]
    plane = columns.hollow.shape[1] * n_x
    around = np.array([y * n_x + x for y, x in _AROUND], dtype=np.int64)
    hollow, price = columns.hollow.reshape(-1), price.reshape(-1)
    whole, top = columns.whole.flatten(), columns.top.flatten()
    cell = heads
    while len(cell):
        whole[cell] = top[cell] = True
        foot = cell
        if leaning:
            side = cell[:, None] + around
            down = np.where(_held(side, top, plane), 0, price[np.maximum(side - plane, 0)])
            cost = down + np.where(whole[side], 0, np.where(hollow[side], 1, _NOWHERE))
            leant = side[np.arange(len(cell)), cost.argmin(axis=1)]
            foot = np.where(_held(cell, top, plane), cell, leant)
            whole[foot] = top[foot] = True
        foot = np.unique(foot)
        cell = foot[~_held(foot, top, plane)] - plane
    return whole.reshape(columns.hollow.shape) & columns.hollow


def _held(cell: Ints, top: Mask, plane: int) -> Mask:
    """Return which cells, given by flat indices, stand on a stud or on the ground."""
    held: Mask = (cell < plane) | top[cell - plane]
    return held


def _reached(start: Mask, through: Mask) -> Mask:
    """Spread over the reach of bricks within each layer, in all eight directions."""
    for _ in range(_REACH):
        wide = np.pad(start, ((0, 0), (1, 1), (1, 1)))
        rows = wide[:, :-2] | wide[:, 1:-1] | wide[:, 2:]
        start = (rows[..., :-2] | rows[..., 1:-1] | rows[..., 2:]) & through
    return start


def _raised(layers: Mask, *, ground: bool) -> Mask:
    """Return the layer below each layer, the ground below the lowest."""
    return np.concatenate([np.full_like(layers[:1], ground), layers[:-1]])
