"""Local high resolution: where plates replace bricks.

Layers are marked for three slices of 3.2 mm instead of one of 9.6 mm where the
trajectories of neighbouring layers differ, where the surface is flat, or where
its colour changes. In marked layers the three plates of a cell column stay where
a brick in their place would err too much, in volume or in colour; elsewhere they
are one brick again. Every column is decided by itself, or together with its
neighbours where fewer parts are worth an error.

References
----------
Paper, section on local high resolution: differences in the number of polygons,
and in the lengths and areas of corresponding polygons, of neighbouring layers;
three rules of superposition by which three plates become a brick. The criteria
of volume and of colour are our own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.ndimage import label

from ..arrays import Floats, Mask
from ..model import COLOUR_ANY, COLOUR_EMPTY
from ..units import PLATES_PER_BRICK
from .colour_votes import CLEAR, Ballot, Codes, cost_in
from .smoothing import smooth_colours, smooth_shapes

_ROW: Final = np.zeros((3, 3, 3), dtype=bool)
_ROW[1, 1] = True
"""What touches a cell along x."""


@dataclass(frozen=True, slots=True, eq=False)
class Detail:
    """Where plates may stay.

    Attributes
    ----------
    marked : (n_layers,) bool array
        Layers that were sliced plate by plate; in others every cell is a brick.
    least_gain : float
        Error that plates must save: in volume as a share of a brick, in colour
        as the share of its faces times the difference as a share of a clear one.
        0 keeps all plates that differ from a brick.
    worth : float
        Error, as above, to accept for one part less: neighbouring columns become alike where that costs less. 0 decides
        every column by itself.
    middle : bool
        Whether bricks end where their middle plate does if all three end at different places, and every column is
        decided by itself; else where their volume is best.
    """

    marked: Mask
    least_gain: float
    worth: float = 0.0
    middle: bool = False


def settle_plates(solid: Mask, share: Floats, detail: Detail, factor: Floats | float = 1.0) -> Mask:
    """Make bricks of cell columns in which plates do not pay.

    Three rules of superposition: three plates are a brick anyway. A column of
    one or two becomes a brick, or nothing, whichever is nearer to the volume of
    the mesh, unless the error of that exceeds the error of the plates by the
    least gain. What is thin, or rests on nothing, never becomes nothing. Where
    one part less is worth something, columns that gain nothing are settled so
    first; the others are only filled up, as their neighbours ask for it, and the
    least gain is what plates cost.

    Parameters
    ----------
    solid : (n_plates, n_y, n_x) bool array
    share : (n_plates, n_y, n_x) float64 array
        Share of each cell inside the mesh.
    detail : Detail
    factor : (n_plates, n_y, n_x) float64 array or float, optional
        How many times as much as usual the error of each cell counts.

    Returns
    -------
    (n_plates, n_y, n_x) bool array
    """
    factor = np.broadcast_to(factor, solid.shape)
    if detail.worth == 0 or detail.middle:
        return _settled_alone(solid, share, factor, detail)
    every = _settled_alone(solid, share, factor, replace(detail, least_gain=0.0))
    return smooth_shapes(every, share, factor, least_gain=detail.least_gain, worth=detail.worth)


def _settled_alone(solid: Mask, share: Floats, factor: Floats, detail: Detail) -> Mask:
    """Settle every column by itself."""
    plates = solid.reshape(-1, PLATES_PER_BRICK, *solid.shape[1:])
    layer, y, x = np.nonzero(plates.any(axis=1) & ~plates.all(axis=1))
    there = plates[layer, :, y, x]
    inside, counts = (each.reshape(plates.shape)[layer, :, y, x] for each in (share, factor))
    error, full, none = ((counts * np.abs(inside - what)).mean(axis=1) for what in (there, 1.0, 0.0))
    # cells that were added although less than half covered are thin; they and what carries them stay
    thin = (there & (inside < 0.5)).any(axis=1)
    resting = _resting(plates)[layer, y, x]
    drop = (~superposed(plates)[layer, y, x] if detail.middle else none < full) & resting & ~thin
    gain = np.where(drop, none, full) - error
    round_ = ~detail.marked[layer] | (gain < detail.least_gain)
    kept = plates.copy()
    kept[layer[round_], :, y[round_], x[round_]] = ~drop[round_, None]
    return kept.reshape(solid.shape)


def superposed(plates: Mask) -> Mask:
    """Make bricks of plates by the paper's three rules of superposition, along rows.

    Parameters
    ----------
    plates : (n_layers, 3, n_y, n_x) bool array

    Returns
    -------
    (n_layers, n_y, n_x) bool array
        Where all three plates end at one place, or two of them do, the brick ends there (first and second rule); where
        all end at different places, it ends where the middle plate does (third rule), and not where the median does.

    References
    ----------
    Paper, section on local high resolution: "the problem is solved along one direction only", here along x.
    """
    low, middle, top = np.moveaxis(plates, 1, 0)
    # the middle plate alone ends elsewhere; whether the two others end at one place shows beside these cells
    alone = (middle != low) & (middle != top)
    apart = np.pad(low != top, ((0, 0), (0, 0), (1, 1)))
    number, _ = label(alone, structure=_ROW)
    third = np.unique(number[alone & (apart[..., :-2] | apart[..., 2:])])
    chosen: Mask = np.where(alone & np.isin(number, third), middle, plates.sum(axis=1) >= 2)
    return chosen


def _resting(plates: Mask) -> Mask:
    """Return the columns with a solid plate right below or right above them, (n_layers, n_y, n_x)."""
    resting = np.zeros((len(plates), *plates.shape[2:]), dtype=bool)
    resting[1:] |= plates[:-1, -1]
    resting[:-1] |= plates[1:, 0]
    return resting


def settle_colours(colour: Codes, seen: Mask, ballot: Ballot, detail: Detail) -> Codes:
    """Give cell columns of three plates one colour where several colours do not pay.

    Where one part less is worth something, neighbours are taken into account.

    Parameters
    ----------
    colour : (n_plates, n_y, n_x) int16 array
        LDraw codes, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    seen : (n_plates, n_y, n_x) bool array
        Visible cells.
    ballot : Ballot
        What the surface of each visible cell asks for.
    detail : Detail

    Returns
    -------
    (n_plates, n_y, n_x) int16 array
    """
    if detail.worth == 0:
        return _coloured_alone(colour, seen, ballot, detail)
    whole = _coloured_alone(colour, seen, ballot, replace(detail, least_gain=0.0))
    return smooth_colours(whole, seen, ballot, detail.marked, least_gain=detail.least_gain, worth=detail.worth)


def _coloured_alone(colour: Codes, seen: Mask, ballot: Ballot, detail: Detail) -> Codes:
    """Settle the colours of every column by itself."""
    columns = colour.reshape(-1, PLATES_PER_BRICK, *colour.shape[1:])
    layer, y, x = np.nonzero(_of_several_colours(columns))
    if len(layer) == 0:
        return colour
    shown = seen.reshape(columns.shape)[layer, :, y, x]
    number = np.cumsum(seen.ravel()).reshape(columns.shape)[layer, :, y, x] - 1
    error = ballot.factor[:, None] * ballot.cost
    cost = np.where(shown[:, :, None], error[number], 0.0)
    voted = ((ballot.votes[number] > 0) & shown[:, :, None]).any(axis=1)
    several = cost_in(cost, shown, ballot.codes, columns[layer, None, :, y, x])[:, 0]
    total = np.where(voted, cost.mean(axis=1), np.inf)
    one = total.argmin(axis=1)
    gain = (total.min(axis=1) - several.mean(axis=1)) / CLEAR
    merge = np.flatnonzero((~detail.marked[layer] | (gain < detail.least_gain)) & voted.any(axis=1))
    merged = columns.copy()
    merged[layer[merge], :, y[merge], x[merge]] = ballot.codes[one[merge], None]
    return merged.reshape(colour.shape)


def _of_several_colours(columns: Codes) -> Mask:
    """Return the columns of three solid plates that do not agree on a colour, (n_layers, n_y, n_x)."""
    top = columns.max(axis=1)
    lowest = np.where(columns == COLOUR_ANY, np.iinfo(np.int16).max, columns).min(axis=1)
    several: Mask = (columns != COLOUR_EMPTY).all(axis=1) & (lowest < top)
    return several
