"""The mirrored halves of a model: which brick is the image of which."""

from __future__ import annotations

from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from ..arrays import Ints
from ..model import NOBODY, Bricks, Catalogue, footprint, part_images

SYMMETRIC: Final = 0.5
"""Share of the bricks that have an image from which on a model counts as symmetric."""

OFF: Final = 4
"""Half studs by which the plane of symmetry may lie off the middle of the outline."""


class MirrorPlane(NamedTuple):
    """A plane in which stud squares are mirrored.

    Attributes
    ----------
    axis : int
        0 if it is mirrored along x, 1 along y.
    total : int
        What the places of a square and of its image on that axis add up to.
    """

    axis: int
    total: int


def boxes(bricks: Bricks, catalogue: Catalogue) -> Ints:
    """Return the outlines of bricks, (n, 4): the first and the last stud square in x, and those in y."""
    size = _sizes(catalogue)[bricks.part, bricks.turn]
    low = bricks.corner[:, :2].astype(np.int64)
    high = low + size - 1
    return np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)


@lru_cache(maxsize=4)
def _sizes(catalogue: Catalogue) -> Ints:
    """Return the squares that each part covers in x and y in each turn, (n_parts, 4, 2)."""
    return np.array(
        [[footprint(part, turn).max(axis=0) + 1 for turn in range(4)] for part in catalogue.parts], dtype=np.int64
    )


def mirror_images(bricks: Bricks, catalogue: Catalogue) -> Ints:
    """Find the image of each brick in the plane of symmetry.

    Parameters
    ----------
    bricks : Bricks
        n rows that do not overlap.
    catalogue : Catalogue

    Returns
    -------
    (n,) int64 array
        Row of the brick of the same part, or its mirror image, at the mirrored place, the brick itself
        if it lies across the plane, ``NOBODY`` if there is none or the model is
        not symmetric.
    """
    found = _symmetry(bricks, catalogue)
    return np.full(len(bricks), NOBODY, dtype=np.int64) if found is None else found[1]


def mirror_plane(bricks: Bricks, catalogue: Catalogue) -> MirrorPlane | None:
    """Find the plane of symmetry of bricks that do not overlap; None if they are not symmetric."""
    found = _symmetry(bricks, catalogue)
    return None if found is None else found[0]


def _symmetry(bricks: Bricks, catalogue: Catalogue) -> tuple[MirrorPlane, Ints] | None:
    """Return the plane in which most bricks have an image, and the image of each."""
    best = None
    if not len(bricks):
        return best
    outline = boxes(bricks, catalogue)
    most = int(SYMMETRIC * len(bricks))
    for axis, (first, last, others) in enumerate(((0, 1, (2, 3)), (2, 3, (0, 1)))):
        low, high = outline[:, first], outline[:, last]
        part = np.minimum(bricks.part, part_images(catalogue.parts, axis)[bricks.part, 0, 0])
        kind = _kinds(np.column_stack([part, bricks.corner[:, 2], high - low, outline[:, others]]))
        # first and last square of each image add up to twice the middle
        for shift in sorted(range(-OFF, OFF + 1), key=abs):
            total = int(low.min() + high.max()) + shift
            found = _images(kind, low, total - high)
            count = int(np.count_nonzero(found != NOBODY))
            if count > most:
                best, most = (MirrorPlane(axis, total), found), count
    return best


def _kinds(columns: Ints) -> Ints:
    """Return a number of each row, the same of equal ones."""
    kind: Ints = np.unique(columns, axis=0, return_inverse=True)[1].reshape(-1).astype(np.int64)
    return kind


def _images(kind: Ints, place: Ints, mirrored: Ints) -> Ints:
    """Return which row of the same kind has its place where each is mirrored to."""
    low = min(int(place.min()), int(mirrored.min()))
    wide = max(int(place.max()), int(mirrored.max())) - low + 1
    own, image = kind * wide + place - low, kind * wide + mirrored - low
    order = np.argsort(own)
    found = order[np.minimum(np.searchsorted(own[order], image), len(own) - 1)]
    return np.where(own[found] == image, found, NOBODY)
