"""What cannot be seen is not built: surface whose alpha is too low is left out.

A face that is partly visible is cut along its visible texels, as finely as matters for a stud: faces on the border are
halved until their sides are short enough, and each part is kept or removed as a whole. Faces far from the border stay
large.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..colours import texel_at
from ..mesh import Repairs, TriangleMesh, repair
from ..units import STUD
from .splitting import Triangles, split_edges

_MOST_PARTS: Final = 400_000
"""Faces that cutting may add; a forest of leaves is cut less finely."""

_POINTS: Final = 8
"""Points along a side of a small face at which texels are looked up."""

_FINEST_CUT: Final = 0.25
"""Length in studs of the sides of faces at the border: the border then moves by at most an eighth."""

_FINER: Final = 1.5
"""Factor by which a model may grow when hidden parts are left out before its faces are cut again."""

_HIDDEN, _SEEN, _BOTH = range(3)


@dataclass(frozen=True, slots=True, eq=False)
class _Texels:
    """Which texels of an image are visible.

    Attributes
    ----------
    seen : (h, w) bool array
    table : (h + 1, w + 1) int64 array
        Summed-area table of ``seen``.
    clamp : bool
        Whether coordinates outside the image take its edge texel.
    """

    seen: Mask
    table: Ints
    clamp: bool

    @staticmethod
    def of(opacity: NDArray[np.uint8], least: float, *, clamp: bool) -> _Texels:
        """Count the texels of an image that are seen."""
        seen = opacity >= least * 255
        table = np.zeros((seen.shape[0] + 1, seen.shape[1] + 1), dtype=np.int64)
        np.cumsum(np.cumsum(seen, axis=0, dtype=np.int64), axis=1, out=table[1:, 1:])
        return _Texels(seen, table, clamp)

    def kinds(self, uvs: Floats) -> NDArray[np.int8]:
        """Return whether the boxes around triangles are hidden, seen, or maybe both, (k,) int8."""
        total = int(self.table[-1, -1])
        if total in (0, self.seen.size):
            return np.full(len(uvs), _SEEN if total else _HIDDEN, dtype=np.int8)
        size = np.array(self.seen.shape[::-1])
        low, high = (np.floor(edge * size) for edge in (uvs.min(axis=1), uvs.max(axis=1)))
        shift = np.zeros_like(low) if self.clamp else np.floor(low / size) * size
        low, high = low - shift, high - shift
        # beyond the rim a box may hold any texel of an image that repeats; another image has its edge texels there
        known = (high < size).all(axis=1) | self.clamp
        (x0, y0), (x1, y1) = (np.clip(edge, 0, size - 1).astype(np.int64).T for edge in (low, high))
        count = self.table[y1 + 1, x1 + 1] - self.table[y0, x1 + 1] - self.table[y1 + 1, x0] + self.table[y0, x0]
        full = count == (x1 - x0 + 1) * (y1 - y0 + 1)
        kinds: NDArray[np.int8] = np.select([known & full, known & (count == 0)], [_SEEN, _HIDDEN], _BOTH)
        return kinds.astype(np.int8)

    def shares(self, uvs: Floats) -> Floats:
        """Return the share of each triangle that is seen, (k,)."""
        step = (np.arange(_POINTS) + 1 / 3) / _POINTS
        first, second = (axis.ravel() for axis in np.meshgrid(step, step))
        weights = np.stack([1 - first - second, first, second], axis=1)[first + second < 1]
        total = np.zeros(len(uvs))
        for weight in weights:
            column, row = texel_at(np.einsum("c,kcd->kd", weight, uvs), self.seen.shape, clamp=self.clamp)
            total += self.seen[row, column]
        share: Floats = total / len(weights)
        return share


def cut_unseen(mesh: TriangleMesh, *, least: float, finest: float) -> tuple[TriangleMesh, float]:
    """Leave out the surface whose alpha is too low.

    Parameters
    ----------
    mesh : TriangleMesh
        Repaired: neighbours share their vertices.
    least : float
        Alpha from which on surface is built, 0 to 1; 0 builds everything.
    finest : float
        Length in mm below which the sides of faces on the border are not cut.

    Returns
    -------
    TriangleMesh
        What is seen; the mesh itself where all of it is, or nothing.
    float
        Share of the area that is not seen: 1 where nothing is.
    """
    texels = _texels(mesh, least)
    if all(image is None or image.seen.all() for image in texels):
        return mesh, 0.0
    triangles, image = Triangles(mesh.vertices, mesh.faces.astype(np.int64), mesh.uvs, mesh.weight), mesh.face_image
    whole = _area(triangles).sum()
    kinds = _kinds(triangles.uvs, image, texels)
    while True:
        marked = (kinds == _BOTH)[:, None] & (triangles.sides() > finest)
        added = len(kinds) - len(mesh.faces) + 3 * np.count_nonzero(marked.any(axis=1))
        if not marked.any() or added > _MOST_PARTS:
            break
        triangles, owner = split_edges(triangles, marked)
        image, kinds = image[owner], kinds[owner]
        open_ = np.flatnonzero(kinds == _BOTH)
        kinds[open_] = _kinds(triangles.uvs[open_], image[open_], texels)
    kept = _seen_faces(triangles.uvs, image, kinds, texels)
    if kept.all() or not kept.any():
        return mesh, float(not kept.any())
    return _with_faces(mesh, triangles, image, kept), float(1 - _area(triangles)[kept].sum() / whole)


def seen_part(
    mesh: TriangleMesh, repairs: Repairs, *, least: float, scale: Callable[[TriangleMesh], float]
) -> tuple[TriangleMesh, Repairs, float]:
    """Cut off the parts of a model that cannot be seen, as finely as matters at its size.

    Parameters
    ----------
    mesh : TriangleMesh
        Repaired.
    repairs : Repairs
        What was done to it.
    least : float
        Alpha from which on surface is built, 0 to 1.
    scale : callable
        Returns the factor from the size of a mesh to that of its model.

    Returns
    -------
    TriangleMesh
        The visible part. A model that would vanish is used whole: some exporters write an alpha of 0 into materials
        that their own program shows as opaque.
    Repairs
        Of the given mesh, but with whether it is closed now.
    float
        Share of the area that is not seen: 1 where nothing is.
    """
    whole, share, finest = mesh, 0.0, np.inf
    # the visible part may be smaller than the whole, so that it becomes larger in the model
    while finest > _FINER * (finer := STUD * _FINEST_CUT / scale(mesh)):
        finest = finer
        mesh, share = cut_unseen(whole, least=least, finest=finest)
    if mesh is whole:
        return mesh, repairs, share
    mesh, again = repair(mesh, fill=False)
    kept = ("welded", "degenerate", "duplicate", "flipped", "turned", "filled", "open_edges", "patches")
    return mesh, replace(again, **{name: getattr(repairs, name) for name in kept}), share


def remarks_on_unseen(share: float, *, least: float) -> tuple[str, ...]:
    """Return a sentence on what was left out, or was built although transparent; none if all is visible.

    Parameters
    ----------
    share : float
        Of the area that is not seen.
    least : float
        Alpha from which on surface is built.

    Returns
    -------
    tuple of str
    """
    if share == 0:
        return ()
    if share == 1:
        return (f"The whole surface has an alpha below {least:g}: it is built as if it were opaque.",)
    percent = "Less than 1" if share < 0.01 else f"{100 * share:.0f}"
    return (
        f"{percent} % of the surface is not built, as its alpha is below {least:g}: the setting least_alpha changes "
        "that.",
    )


def _texels(mesh: TriangleMesh, least: float) -> list[_Texels | None]:
    """Return which texels of each image are seen, None where all are."""
    opacities = mesh.opacities or (None,) * len(mesh.images)
    return [
        None if opacity is None else _Texels.of(opacity, least, clamp=bool(clamp))
        for opacity, clamp in zip(opacities, mesh.image_clamp, strict=True)
    ]


def _kinds(uvs: Floats, image: NDArray[np.int32], texels: list[_Texels | None]) -> NDArray[np.int8]:
    kinds = np.full(len(uvs), _SEEN, dtype=np.int8)
    for row, own in enumerate(texels):
        faces = np.flatnonzero(image == row)
        if own is not None and len(faces):
            kinds[faces] = own.kinds(uvs[faces])
    return kinds


def _seen_faces(uvs: Floats, image: NDArray[np.int32], kinds: NDArray[np.int8], texels: list[_Texels | None]) -> Mask:
    """Return the faces of which at least a half is seen."""
    kept: Mask = kinds == _SEEN
    for row, own in enumerate(texels):
        faces = np.flatnonzero((image == row) & (kinds == _BOTH))
        if own is not None and len(faces):
            kept[faces] = own.shares(uvs[faces]) >= 0.5
    return kept


def _area(triangles: Triangles) -> Floats:
    a, b, c = np.moveaxis(triangles.vertices[triangles.faces], 1, 0)
    area: Floats = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return area


def _with_faces(mesh: TriangleMesh, triangles: Triangles, image: NDArray[np.int32], kept: Mask) -> TriangleMesh:
    used, faces = np.unique(triangles.faces[kept], return_inverse=True)
    return replace(
        mesh,
        vertices=triangles.vertices[used],
        faces=faces.reshape(-1, 3).astype(np.int32),
        uvs=triangles.uvs[kept],
        face_image=image[kept],
        weight=None if triangles.weight is None else triangles.weight[used],
    )
