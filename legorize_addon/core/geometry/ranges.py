"""Many ranges of integers at once, one after the other."""

from __future__ import annotations

import numpy as np

from ..arrays import Ints


def ranges(first: Ints, count: Ints) -> tuple[Ints, Ints]:
    """List the integers of many ranges.

    Parameters
    ----------
    first : (n,) int64 array
        First integer of each range.
    count : (n,) int64 array
        Number of integers in each range, at least 0.

    Returns
    -------
    owner : (m,) int64 array
        Range of each integer, rising.
    value : (m,) int64 array
        The integers, rising within a range.

    Examples
    --------
    >>> ranges(np.array([5, 0, 7]), np.array([2, 0, 3]))
    (array([0, 0, 2, 2, 2]), array([5, 6, 7, 8, 9]))
    """
    owner = np.repeat(np.arange(len(count)), count)
    shift = first - (np.cumsum(count) - count)
    return owner, shift.take(owner) + np.arange(len(owner))
