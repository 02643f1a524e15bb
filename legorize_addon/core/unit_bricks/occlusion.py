"""Which surface is hidden right behind another one: a body under its cloak, a wall under its paint.

The lattice of the outer air cannot separate two surfaces that are closer to each other than its cells are wide, so the
samples themselves are compared.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from .surface_samples import SurfaceSamples

_COLUMN: Final = 1.0
"""Width in studs of the columns in which samples that face the same way are compared."""

_NEXT: Final = 16
"""Samples in front that each is compared with."""

_NEAREST: Final = 0.1
"""Least distance in studs of a surface that hides a sample; a closer one is the same surface."""

_FARTHEST: Final = 0.8
"""Greatest distance in studs of it; the air lattice handles what is farther away."""

_ASIDE: Final = 0.3
"""Studs that the hiding sample may lie beside the line straight ahead."""

_SAME_WAY: Final = 0.3
"""Least cosine between two surfaces that face the same way."""


def occluded(samples: SurfaceSamples) -> Mask:
    """Return the samples right behind another surface that faces the same way.

    Parameters
    ----------
    samples : SurfaceSamples

    Returns
    -------
    (n,) bool array
        True where a sample that faces nearly the same way lies straight ahead, a tenth to eight tenths of a stud away.
    """
    place, normal = samples.place * samples.sides, samples.normal * samples.sides
    normal /= np.maximum(np.sqrt(np.einsum("ij,ij->i", normal, normal)), np.finfo(float).tiny)[:, None]
    order, column = _columns(place, normal)
    place, normal, first = place[order].T, normal[order].T, np.arange(len(order))
    under = np.zeros(len(order), dtype=bool)
    for step in range(1, _NEXT + 1):
        first = first[: np.searchsorted(first, len(order) - step)]
        first = first[column[first] == column[first + step]]
        under[first[_covers(place, normal, first, first + step)]] = True
    covered = np.empty_like(under)
    covered[order] = under
    return covered


def _columns(place: Floats, normal: Floats) -> tuple[Ints, Floats]:
    """Sort samples into columns along the axes that they mostly face, from behind to in front.

    Returns the order of the samples, (n,), and the column of each in that order, (n,).
    """
    axis = np.abs(normal).argmax(axis=1)
    rows = np.arange(len(axis))
    outwards = normal[rows, axis] > 0
    place = place - place.min(axis=0, initial=np.inf)
    lateral = np.floor(place / _COLUMN) + 1
    lateral[rows, axis] = 0
    size = lateral.max(axis=0, initial=0) + 1
    column = ((lateral[:, 0] * size[1] + lateral[:, 1]) * size[2] + lateral[:, 2]) * 2 + outwards
    depth = place[rows, axis] / (place.max(initial=0) + 1)
    order = np.argsort(column + np.where(outwards, depth, 1 - depth), kind="stable")
    return order, column[order]


def _covers(place: Floats, normal: Floats, behind: Ints, before: Ints) -> Mask:
    """Return whether samples, given by components, (3, n), lie straight ahead of others and face the same way."""
    gap = [along[before] - along[behind] for along in place]
    facing = [along[behind] for along in normal]
    ahead = gap[0] * facing[0] + gap[1] * facing[1] + gap[2] * facing[2]
    aside = gap[0] ** 2 + gap[1] ** 2 + gap[2] ** 2 - ahead**2
    cosine = sum(along[before] * face for along, face in zip(normal, facing, strict=True))
    covers: Mask = (ahead > _NEAREST) & (ahead < _FARTHEST) & (aside < _ASIDE**2) & (cosine > _SAME_WAY)
    return covers
