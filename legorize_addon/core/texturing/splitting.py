"""Triangles cut in smaller ones without tearing the surface between neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask

# corners of the parts by number: 0 to 2 the corners, 3 to 5 the middles of the edges 0-1, 1-2 and 2-0
_PARTS: Final = {
    (False, False, False): [(0, 1, 2)],
    (True, False, False): [(0, 3, 2), (3, 1, 2)],
    (False, True, False): [(0, 1, 4), (0, 4, 2)],
    (False, False, True): [(0, 1, 5), (5, 1, 2)],
    (True, True, False): [(3, 1, 4), (0, 3, 4), (0, 4, 2)],
    (False, True, True): [(4, 2, 5), (1, 4, 5), (1, 5, 0)],
    (True, False, True): [(5, 0, 3), (2, 5, 3), (2, 3, 1)],
    (True, True, True): [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
}


@dataclass(frozen=True, slots=True, eq=False)
class Triangles:
    """Triangles with image coordinates.

    Attributes
    ----------
    vertices : (n_v, 3) float64 array
    faces : (n_f, 3) int64 array
        Rows in ``vertices``.
    uvs : (n_f, 3, 2) float64 array
        Image coordinates of the corners.
    weight : (n_v,) float64 array or None
        Of the vertices, if they have any.
    """

    vertices: Floats
    faces: Ints
    uvs: Floats
    weight: Floats | None = None

    def sides(self) -> Floats:
        """Return the lengths of the edges 0-1, 1-2 and 2-0 of each face, shape (n_f, 3)."""
        corners = self.vertices[self.faces]
        lengths: Floats = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        return lengths


def split_edges(triangles: Triangles, marked: Mask) -> tuple[Triangles, Ints]:
    """Cut edges in halves, and with them all faces that share them.

    Parameters
    ----------
    triangles : Triangles
    marked : (n_f, 3) bool array
        Edges 0-1, 1-2 and 2-0 of each face to be cut.

    Returns
    -------
    Triangles
        The parts, wound as their faces; vertices that were there keep their numbers.
    (m,) int64 array
        Face that each part comes from, rising.
    """
    faces, n_vertices = triangles.faces, len(triangles.vertices)
    ends = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edge, number = np.unique(ends[:, 0] * n_vertices + ends[:, 1], return_inverse=True)
    number = number.reshape(faces.shape)
    cut = np.zeros(len(edge), dtype=bool)
    cut[number[marked]] = True
    middle = np.stack([edge[cut] // n_vertices, edge[cut] % n_vertices], axis=1)
    place = n_vertices + np.cumsum(cut) - 1
    six = np.concatenate([faces, place[number]], axis=1)
    uvs = np.concatenate([triangles.uvs, (triangles.uvs + np.roll(triangles.uvs, -1, axis=1)) / 2], axis=1)
    owner, corner = _parts(cut[number])
    weight = triangles.weight
    return Triangles(
        np.concatenate([triangles.vertices, triangles.vertices[middle].mean(axis=1)]),
        np.take_along_axis(six[owner], corner, axis=1),
        np.take_along_axis(uvs[owner], corner[:, :, None], axis=1),
        None if weight is None else np.concatenate([weight, weight[middle].mean(axis=1)]),
    ), owner


def _parts(cut: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Return the face of each part and its corners, 0 to 5, given the edges that are cut."""
    owners, corners = [], []
    for pattern, parts in _PARTS.items():
        rows = np.flatnonzero((cut == pattern).all(axis=1))
        owners.append(np.repeat(rows, len(parts)))
        corners.append(np.tile(np.array(parts, dtype=np.int64), (len(rows), 1)))
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return owner[order], np.concatenate(corners)[order]
