"""How much more the weighted surface of a mesh counts: at points of it, and in the cells of a grid."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Floats, Ints
from ..units import PLATE, STUD
from .rays import vertical_hits
from .triangle_mesh import TriangleMesh

_PITCH: Final = STUD / 3
"""Distance of rays: less than the height of a plate, so that at least one meets what goes through a cell upright."""

_NEAR: Final = (5, 3, 3)
"""Plates and studs of the box around a cell without surface whose surface counts: errors lie beside the surface too."""


def emphasised(mesh: TriangleMesh, times: float) -> TriangleMesh:
    """Return a mesh whose weights, 0 to 1 as read, are multiplied; without weights if they are 0 everywhere."""
    if mesh.weight is None:
        return mesh
    weight = times * mesh.weight
    return replace(mesh, weight=weight if weight.any() else None)


def weight_at(mesh: TriangleMesh, face: Ints, points: Floats) -> Floats | None:
    """Return the weights of points on faces.

    Parameters
    ----------
    mesh : TriangleMesh
    face : (n,) int64 array
    points : (n, 3) float64 array
        In mm.

    Returns
    -------
    (n,) float64 array or None
        Between those of the corners, with those of features; None where the mesh has no weights.
    """
    if mesh.weight is None and mesh.features is None:
        return None
    found = np.zeros(len(points)) if mesh.weight is None else _painted(mesh, mesh.weight, face, points)
    if mesh.features is not None:
        found += mesh.features.at(points)
    return found


def _painted(mesh: TriangleMesh, weight: Floats, face: Ints, points: Floats) -> Floats:
    """Return what the weights of the corners of faces come to at points on these."""
    corners, own = mesh.vertices[mesh.faces[face]], weight[mesh.faces[face]]
    normal = mesh.normals[face]
    share = np.empty((len(points), 3))
    for i in range(3):
        one, other = corners[:, i - 2] - points, corners[:, i - 1] - points
        share[:, i] = (np.cross(one, other) * normal).sum(axis=1)
    # a point beside its face counts for the nearest part of it; where a face has no area, its corners count alike
    share = np.maximum(share, 0)
    total = share.sum(axis=1, keepdims=True)
    share = np.where(total > 0, share / np.where(total > 0, total, 1), 1 / 3)
    found: Floats = (share * own).sum(axis=1)
    return found


def cell_factors(mesh: TriangleMesh, corner: Floats, shape: tuple[int, int, int]) -> Floats:
    """Return how many times as much as elsewhere the shape in each cell of a grid of plates counts.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm.
    corner : (3,) float64 array
        Of the grid in mm.
    shape : tuple of int
        Plates, rows and columns.

    Returns
    -------
    (n_plates, n_y, n_x) float64 array
        1 plus the mean weight of the surface in a cell, or of that in the cells around it where it has none; 1
        elsewhere.
    """
    if mesh.weight is None and mesh.features is None:
        return np.broadcast_to(1.0, shape)
    area, weighted = np.zeros((2, *shape))
    for face, points, _, amount in surface_hits(mesh, corner):
        weight = weight_at(mesh, face, points)
        assert weight is not None
        cell = np.floor((points - corner) / [STUD, STUD, PLATE]).astype(np.int64)[:, ::-1]
        inside = ((cell >= 0) & (cell < shape)).all(axis=1)
        flat = np.ravel_multi_index(tuple(cell[inside].T), shape)
        for total, each in ((area, amount[inside]), (weighted, (amount * weight)[inside])):
            total += np.bincount(flat, each, total.size).reshape(shape)
    around, beside = (_boxes(each) for each in (area, weighted))
    own = area > 0
    near, total = np.where(own, weighted, beside), np.where(own, area, around)
    factors: Floats = 1 + np.where(total > 0, near / np.where(total > 0, total, 1), 0)
    return factors


def surface_hits(mesh: TriangleMesh, corner: Floats) -> Iterator[tuple[Ints, Floats, Floats, Floats]]:
    """Yield where rays along each axis, three a stud, meet the surface.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm.
    corner : (3,) float64 array
        Of the lattice of rays in mm.

    Yields
    ------
    face : (n,) int64 array
    points : (n, 3) float64 array
        In mm.
    uvs : (n, 2) float64 array
        Image coordinates.
    amount : (n,) float64 array
        Area in mm² that each hit stands for; those of all axes add up to the whole.
    """
    for axis in range(3):
        shift = 2 - axis
        turned = replace(mesh, vertices=np.roll(mesh.vertices, shift, axis=1))
        face, points, uvs = vertical_hits(turned, corner=np.roll(corner, shift)[:2], pitch=_PITCH)
        normal = turned.normals[face]
        length = np.linalg.norm(normal, axis=1)
        # of a face with shares s of its normal along the axes, rays see the share s; times s again they add up to it
        amount = _PITCH**2 * np.abs(normal[:, 2]) / np.maximum(length, np.finfo(float).tiny)
        yield face, np.roll(points, -shift, axis=1), uvs, amount


def _boxes(amount: Floats) -> Floats:
    """Return the sums over the box around each cell."""
    for axis, size in enumerate(_NEAR):
        amount = ndimage.correlate1d(amount, np.ones(size), axis=axis, mode="constant")
    return amount
