"""Meshes drawn together: what lies half a stud off the rest is moved back, and the plate between both leans."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import TriangleMesh
from ..units import BRICK, PLATE, STUD
from .islands import Islands

_NEAR: Final = 0.5
"""Studs around what lies above, within which the plate below it leans."""


def draw_together(mesh: TriangleMesh, ground: float, islands: Islands, half: Ints) -> TriangleMesh:
    """Move islands back by their half studs.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm.
    ground : float
        Height of the first layer in mm.
    islands : Islands
        Of this mesh.
    half : (n, 2) int64 array
        Half studs of each island along x and y.

    Returns
    -------
    TriangleMesh
        As closed as it was: where an island lies over another one that is moved otherwise, the upmost plate of the
        lower one leans, and is cut at both ends.
    """
    lower, upper = islands.links.T
    across = np.unique(islands.layer[upper[(half[lower] != half[upper]).any(axis=1)]])
    for layer in across.tolist():
        for height in (ground + BRICK * layer - PLATE, ground + BRICK * layer):
            mesh = cut_at(mesh, height)
    vertices = mesh.vertices.copy()
    vertices[:, :2] -= STUD / 2 * _moved(vertices, ground, islands, half, across)
    features = mesh.features
    if features is not None:
        # what lies at a point now was half a stud or none further on
        points = features.points
        points[:, :2] += STUD / 2 * _moved(points, ground, islands, half, across)
        features = replace(features, values=features.at(points).reshape(features.values.shape).astype(np.float32))
    return replace(mesh, vertices=vertices, features=features)


def _moved(vertices: Floats, ground: float, islands: Islands, half: Ints, across: Ints) -> Floats:
    """Return by how many half studs points move back, (n, 2)."""
    near, far = islands.nearest
    y, x = islands.squares(vertices[:, :2])
    above = (vertices[:, 2] - ground) / BRICK
    # what is cut at a plane belongs to what is below it
    layer = np.clip(np.ceil(above - 1e-9).astype(np.int64) - 1, 0, len(near) - 1)
    own = half[near[layer, y, x]].astype(np.float64)
    top = np.minimum(layer + 1, len(near) - 1)
    lean = np.clip(1 - (layer + 1 - above) * BRICK / PLATE, 0, 1) * np.clip(1 - far[top, y, x] / _NEAR, 0, 1)
    lean = np.where(np.isin(layer + 1, across), lean, 0)
    moved: Floats = own + lean[:, None] * (half[near[top, y, x]] - own)
    return moved


def cut_at(mesh: TriangleMesh, height: float) -> TriangleMesh:
    """Cut the triangles of a mesh at a height, so that none reaches across it; the surface stays where it is."""
    side = np.sign(mesh.vertices[:, 2] - height).astype(np.int64)
    of_face = side[mesh.faces]
    across = (of_face.min(axis=1) < 0) & (of_face.max(axis=1) > 0)
    if not across.any():
        return mesh
    rows = np.flatnonzero(across)
    faces, uvs = _turned(mesh.faces[rows].astype(np.int64), mesh.uvs[rows], side)
    first, second, third = faces.T
    # the first corner is alone on its side; the second may lie at the height
    touching = side[second] == 0
    edges = np.concatenate([np.stack([first, third], axis=1), np.stack([first, second], axis=1)[~touching]])
    vertices, weight, middle = _between(mesh, edges, height)
    one, other = second.astype(np.int64), middle[: len(rows)]
    one[~touching] = middle[len(rows) :]
    uv_one = _blended(uvs, mesh.vertices[faces, 2], 1, height)
    uv_other = _blended(uvs, mesh.vertices[faces, 2], 2, height)
    alone = np.stack([first, one, other], axis=1), np.stack([uvs[:, 0], uv_one, uv_other], axis=1)
    rest = np.stack([one, third, other], axis=1), np.stack([uv_one, uvs[:, 2], uv_other], axis=1)
    more = np.stack([one, second, third], axis=1), np.stack([uv_one, uvs[:, 1], uvs[:, 2]], axis=1)
    new = [alone, rest, tuple(each[~touching] for each in more)]
    image = mesh.face_image
    return replace(
        mesh,
        vertices=vertices,
        weight=weight,
        faces=np.concatenate([mesh.faces[~across], *(each[0] for each in new)]).astype(np.int32),
        uvs=np.concatenate([mesh.uvs[~across], *(each[1] for each in new)]),
        face_image=np.concatenate([image[~across], image[rows], image[rows], image[rows][~touching]]),
    )


def _turned(faces: Ints, uvs: Floats, side: Ints) -> tuple[Ints, Floats]:
    """Turn triangles so that their first corner is alone on its side, and what lies at the height comes second."""
    of_face = side[faces]
    level = (of_face == 0).any(axis=1)
    # of three off the height, the one whose side the other two do not have; else the one before the one at it
    lone = np.where(
        level, (of_face == 0).argmax(axis=1) + 2, (of_face == -np.sign(of_face.sum(axis=1))[:, None]).argmax(axis=1)
    )
    order = (lone[:, None] + np.arange(3)) % 3
    return np.take_along_axis(faces, order, axis=1), np.take_along_axis(uvs, order[:, :, None], axis=1)


def _between(mesh: TriangleMesh, edges: Ints, height: float) -> tuple[Floats, Floats | None, Ints]:
    """Add a vertex, with its weight, where each edge, (n, 2), passes a height; those of one edge are the same."""
    vertices, weight = mesh.vertices, mesh.weight
    ends, which = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    low, high = vertices[ends[:, 0]], vertices[ends[:, 1]]
    share = ((height - low[:, 2]) / (high[:, 2] - low[:, 2]))[:, None]
    made = low + share * (high - low)
    made[:, 2] = height
    if weight is not None:
        weight = np.append(weight, weight[ends[:, 0]] + share[:, 0] * (weight[ends[:, 1]] - weight[ends[:, 0]]))
    return np.concatenate([vertices, made]), weight, len(vertices) + which.reshape(-1)


def _blended(uvs: Floats, z: Floats, corner: int, height: float) -> Floats:
    """Return image coordinates where the edge from the first corner of triangles to another one passes a height."""
    share = ((height - z[:, 0]) / (z[:, corner] - z[:, 0]))[:, None]
    found: Floats = uvs[:, 0] + share * (uvs[:, corner] - uvs[:, 0])
    return found
