"""Cut lines where a coordinate passes an integer: at grid lines, at texel borders."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints


def split_at_integers(first: Floats, last: Floats) -> tuple[Ints, Floats, Floats]:
    """Cut intervals at the integers strictly inside them.

    Parameters
    ----------
    first, last : (n,) float64 arrays
        Coordinate at the start and at the end of each interval; it may fall.

    Returns
    -------
    interval : (m,) int64 array
        Interval of each piece; pieces come in order.
    low, high : (m,) float64 arrays
        Start and end of each piece as shares of its interval.

    Examples
    --------
    >>> split_at_integers(np.array([0.5]), np.array([2.5]))
    (array([0, 0, 0]), array([0.  , 0.25, 0.75]), array([0.25, 0.75, 1.  ]))
    """
    below, above = np.minimum(first, last), np.maximum(first, last)
    lowest = np.floor(below) + 1
    inside = np.maximum(np.ceil(above) - lowest, 0).astype(np.int64)
    interval = np.repeat(np.arange(len(first)), inside + 1)
    low, high = np.zeros(len(interval)), np.ones(len(interval))
    cut = np.repeat(np.flatnonzero(inside), inside[inside > 0])
    if len(cut) == 0:
        return interval, low, high
    start = np.cumsum(inside + 1) - inside - 1
    number = np.arange(len(cut)) - np.repeat(np.cumsum(inside) - inside, inside)
    line = lowest[cut] + np.where(last[cut] > first[cut], number, inside[cut] - 1 - number)
    share = np.clip((line - first[cut]) / (last[cut] - first[cut]), 0, 1)
    piece = start[cut] + number
    high[piece] = share
    low[piece + 1] = share
    return interval, low, high


def split_at_lattice(first: Floats, last: Floats) -> tuple[Ints, Floats, Floats]:
    """Cut line segments at the lines of the unit lattice, so that each piece lies in one cell.

    Parameters
    ----------
    first, last : (n, 2) float64 arrays
        Start and end of each segment.

    Returns
    -------
    segment : (m,) int64 array
        Segment of each piece; pieces come in order.
    low, high : (m,) float64 arrays
        Start and end of each piece as shares of its segment.

    Examples
    --------
    >>> split_at_lattice(np.array([[0.5, 0.25]]), np.array([[1.5, 1.25]]))
    (array([0, 0, 0]), array([0.  , 0.5 , 0.75]), array([0.5 , 0.75, 1.  ]))
    """
    segment, low, high = split_at_integers(first[:, 0], last[:, 0])
    start, rise = first[:, 1].take(segment), (last[:, 1] - first[:, 1]).take(segment)
    piece, low_share, high_share = split_at_integers(start + low * rise, start + high * rise)
    segment, low, width = segment.take(piece), low.take(piece), (high - low).take(piece)
    return segment, low + low_share * width, low + high_share * width
