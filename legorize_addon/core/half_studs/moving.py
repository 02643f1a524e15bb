"""Meshes drawn together: what lies above a plane is moved back by half a stud, the plate below the plane leans."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats, Ints
from ..mesh import TriangleMesh
from ..units import PLATE, STUD
from .planes import Plane


def draw_together(mesh: TriangleMesh, ground: float, planes: tuple[Plane, ...]) -> TriangleMesh:
    """Move what is above planes back by their half studs.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm.
    ground : float
        Height of level 0 in mm.
    planes : tuple of Plane
        At least two plates apart.

    Returns
    -------
    TriangleMesh
        As closed as it was, of the same volume: cut at both ends of the plates that lean.
    """
    if not planes:
        return mesh
    height = ground + PLATE * np.array([plane.level - below for plane in planes for below in (1, 0)])
    for each in height.tolist():
        mesh = cut_at(mesh, each)
    half = np.array([(0, 0), *(plane.half for plane in planes)])
    half = np.stack([half[:-1], half[1:]], axis=1).reshape(-1, 2)
    vertices = mesh.vertices.copy()
    for axis in range(2):
        vertices[:, axis] -= STUD / 2 * np.interp(vertices[:, 2], height, half[:, axis])
    return replace(mesh, vertices=vertices)


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
