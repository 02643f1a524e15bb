"""Normals that round bevelled edges off: no face more, and the same in every shading mode.

A bevel is shaded from the normal of the one face to that of the other, as a
rounding is, while the faces themselves stay flat to their edges.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from .lofts import BEVEL, Floats, Loft

_NARROW: Final = 1.5 * BEVEL
"""Width in mm of the widest bevel; grooves and rims are wider."""

_NEAR: Final = 0.5
"""Cosine of the angle up to which two faces are one rounding: a bevel at a corner is 55 degrees from its faces."""


def corner_normals(loft: Loft) -> Floats:
    """Return the normals with which a part is shaded.

    Parameters
    ----------
    loft : Loft

    Returns
    -------
    (n_c, 3) float64 array
        Unit vector a face corner: on bevels that of the faces beside, on round surfaces that of the surface, else
        that of the face.
    """
    face = _faces(loft)
    normal, area, narrow = _measured(loft)
    here, there = _meeting(loft.corners)
    own, other = face[here], face[there]
    near = np.einsum("ij,ij->i", normal[own], normal[other]) > _NEAR
    round_ = loft.smooth[own] & loft.smooth[other]
    counts = near & ~narrow[other] & (narrow[own] | round_ | (own == other))
    total = np.zeros((len(face), 3))
    np.add.at(total, here[counts], area[other[counts], None] * normal[other[counts]])
    alone = ~total.any(axis=1)
    total[alone] = normal[face[alone]]
    return total / np.linalg.norm(total, axis=1, keepdims=True)


def _faces(loft: Loft) -> NDArray[np.intp]:
    """Return the face of each corner."""
    return np.repeat(np.arange(len(loft.starts)), np.diff(loft.starts, append=len(loft.corners)))


def _measured(loft: Loft) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Return each face's normal, its area, and whether it is as narrow as a bevel."""
    after = np.arange(1, len(loft.corners) + 1)
    after[np.append(loft.starts[1:], len(loft.corners)) - 1] = loft.starts
    # close to the origin, that large parts lose nothing
    points = loft.vertices[loft.corners] - loft.vertices[loft.corners[loft.starts]][_faces(loft)]
    doubled = np.add.reduceat(np.cross(points, points[after]), loft.starts)
    area = np.linalg.norm(doubled, axis=1) / 2
    longest = np.maximum.reduceat(np.linalg.norm(points[after] - points, axis=1), loft.starts)
    return doubled / (2 * area[:, None]), area, area < _NARROW * longest


def _meeting(corners: NDArray[np.int32]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return all pairs of face corners at the same vertex, each with itself too."""
    order = np.argsort(corners, kind="stable")
    count = np.bincount(corners)[corners]
    first = np.searchsorted(corners[order], corners)
    here = np.repeat(np.arange(len(corners)), count)
    step = np.arange(len(here)) - np.repeat(np.cumsum(count) - count, count)
    return here, order[np.repeat(first, count) + step]
