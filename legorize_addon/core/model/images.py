"""Mirror images of the parts that are laid for their shape: which part, in which turn, looks like one in a mirror."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from .parts import Part, outline
from .profiles import turned

_SLOPED: Final = ((2, 1, 0, 3), (0, 3, 2, 1))
"""Turns of the images of slopes by turn, mirrored along x and along y: all are symmetric across their width."""


@lru_cache
def part_images(parts: tuple[Part, ...], axis: int) -> NDArray[np.int64]:
    """Return what each part in each turn is in a mirror.

    Parameters
    ----------
    parts : tuple of Part
        With a wedge plate also the one that is its image.
    axis : int
        0 if x is mirrored, 1 if y is.

    Returns
    -------
    (n_parts, 4, 2) int64 array
        Row of the part and its turn; of a part that is not laid for its shape itself and the same turn.
    """
    found = np.stack(np.broadcast_arrays(np.arange(len(parts))[:, None], np.arange(4)), axis=-1).astype(np.int64)
    wedges = {
        _key(part, turned(part, turn, outline(part))): (row, turn)
        for row, part in enumerate(parts)
        if part.wedge
        for turn in reversed(range(4))
    }
    for row, part in enumerate(parts):
        for turn in range(4):
            if part.sloped:
                found[row, turn, 1] = _SLOPED[axis][turn]
            elif part.wedge:
                corners = turned(part, turn, outline(part))
                sides = (part.width, part.length) if turn % 2 else (part.length, part.width)
                corners[:, axis] = sides[axis] - corners[:, axis]
                found[row, turn] = wedges[_key(part, corners)]
    return found


def _key(part: Part, corners: Floats) -> tuple[object, ...]:
    """Return what two parts have in common that fill the same."""
    return (part.height, *sorted(map(tuple, np.round(corners, 6).tolist())))
