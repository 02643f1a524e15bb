"""Faces of the parts' meshes as arrays, and the measures that all bodies share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

Detail = Literal["low", "high"]
Floats = NDArray[np.float64]

WALL: Final = 1.5
ROOF: Final = 1.2
GAP: Final = 0.1
"""Play on every side of a body, which also tells neighbours apart in pictures."""

BEVEL: Final = 0.18


@dataclass(frozen=True, slots=True, eq=False)
class Loft:
    """Faces between rings of points; as a whole part also several lofts together.

    Attributes
    ----------
    vertices : (n_v, 3) float64 array
        Points in mm.
    corners : (n_c,) int32 array
        Rows in ``vertices`` of all face corners, face after face,
        counter-clockwise as seen from outside.
    starts : (n_f,) int32 array
        Row in ``corners`` where each face begins.
    smooth : (n_f,) bool array
        Whether the face is shaded as a part of a round surface.
    """

    vertices: Floats
    corners: NDArray[np.int32]
    starts: NDArray[np.int32]
    smooth: NDArray[np.bool_]


def welded(faces: Sequence[Floats]) -> Loft:
    """Return flat faces as one loft in which equal points are one.

    Parameters
    ----------
    faces : sequence of (k, 3) float64 array
        Corners of each, counter-clockwise as seen from outside; corners that repeat the one before are left out.

    Returns
    -------
    Loft
    """
    points = np.round(np.concatenate(faces), 6)
    vertices, row = np.unique(points, axis=0, return_inverse=True)
    corners, starts, begin = [], [], 0
    for face, end in zip(faces, np.cumsum([len(each) for each in faces]).tolist(), strict=True):
        loop = row.reshape(-1)[end - len(face) : end]
        loop = loop[loop != np.roll(loop, 1)]
        if len(loop) > 2:
            corners.append(loop)
            starts.append(begin)
            begin += len(loop)
    return Loft(
        vertices,
        np.concatenate(corners).astype(np.int32),
        np.array(starts, dtype=np.int32),
        np.zeros(len(starts), dtype=bool),
    )
