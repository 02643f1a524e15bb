"""What goes on together in one half of a symmetric model goes on together in the other half, too.

What hangs is taken along by what it hangs from. Supports need not be symmetric, so
bricks may hang in one half whose images stand on supports in the other: there they
would be put on one by one, and the halves would be built in different ways.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY, Rows, components
from .blocking import knots, of_nodes
from .units import LARGEST, Units


def match_halves(units: Units, image: Ints, pairs: Rows) -> Units:
    """Join units, so that the images of what goes on together go on together as well.

    Parameters
    ----------
    units : Units
        Of n bricks.
    image : (n,) int64 array
        The mirrored brick of each, ``NOBODY`` if there is none.
    pairs : (k, 2) int32 array
        Lower and upper brick of each contact.

    Returns
    -------
    Units
        The same, or with fewer units: none of them waits for itself, each one that
        is new hangs together and is no larger than a sub-assembly may be.
    """
    whole = _whole(units.unit, image)
    kept = _allowed(units, whole, image, pairs)
    while True:
        joined = _relabelled(units, whole, kept)
        knot = knots(joined.before, int(joined.unit.max(initial=NOBODY)) + 1)
        tied = (np.bincount(knot, minlength=1)[knot] > 1)[joined.unit] & kept[whole]
        if not tied.any():
            return joined
        kept &= ~_with_images(whole[tied], whole, image)


def _relabelled(units: Units, whole: Ints, kept: Mask) -> Units:
    """Return units of which those of one number are joined, where that number is kept."""
    # the numbers of what is not joined lie beyond the others
    _, label = np.unique(np.where(kept[whole], whole, len(whole) + units.unit), return_inverse=True)
    label = label.reshape(-1).astype(np.int64)
    of_unit = np.zeros(int(units.unit.max(initial=NOBODY)) + 1, dtype=np.int64)
    of_unit[units.unit] = label
    return replace(units, unit=label, before=of_nodes(units.before, of_unit, int(label.max(initial=NOBODY)) + 1))


def _whole(unit: Ints, image: Ints) -> Ints:
    """Return a number of each brick, the same for all that would have to go on together."""
    paired = np.flatnonzero(image != NOBODY)
    order = paired[np.argsort(unit[paired], kind="stable")]
    same = unit[order[1:]] == unit[order[:-1]]
    images = np.stack([image[order[:-1]][same], image[order[1:]][same]], axis=1)
    first = np.unique(unit, return_index=True)[1]
    own = np.stack([np.arange(len(unit)), first[unit]], axis=1)
    found: Ints = components(np.concatenate([own, images]).astype(np.int32), len(unit)).astype(np.int64)
    return found


def _allowed(units: Units, whole: Ints, image: Ints, pairs: Rows) -> Mask:
    """Return which of the numbers may be units."""
    n = len(whole)
    count = np.bincount(whole, minlength=n)
    changed = np.bincount(whole[np.unique(units.unit, return_index=True)[1]], minlength=n) > 1
    wrong = changed & (count > LARGEST * n)
    wrong[whole[units.pressed | units.loose]] = True
    part = components(pairs[whole[pairs[:, 0]] == whole[pairs[:, 1]]], n)
    wrong |= np.bincount(whole[np.unique(part, return_index=True)[1]], minlength=n) > 1
    return changed & ~_with_images(np.flatnonzero(wrong), whole, image)


def _with_images(numbers: Ints, whole: Ints, image: Ints) -> Mask:
    """Return a mask of some numbers and those of their images."""
    found = np.zeros(len(whole), dtype=bool)
    found[numbers] = True
    other = image[found[whole] & (image != NOBODY)]
    found[whole[other]] = True
    return found
