"""A textured triangle mesh, and its check and repair at the entry to the core.

Every stage reads a :class:`TriangleMesh`. :func:`repair` checks the user's mesh, repairs what it can, turns every body
outwards and counts what it did.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..errors import MeshError
from .orientation import consistent_winding, inside_out
from .repair import WELD, redundant, small_holes, useless_slivers, weld
from .topology import Edges, areas_and_longest_sides, edges_of, n_bodies, open_rim
from .vertex_weights import repaired_weight
from .weight_field import WeightField

FEWEST_TRIANGLES: Final = 2
"""Triangles of the simplest body, a tetrahedron."""

SMALLEST: Final = 1e-6
LARGEST: Final = 1e12
"""Diagonals in mm within which areas and volumes neither overflow nor underflow."""

FARTHEST: Final = 1e9
"""Distance from the origin in diagonals up to which float64 tells coordinates ``WELD`` apart."""


@dataclass(frozen=True, slots=True, eq=False)
class TriangleMesh:
    """A textured triangle mesh in mm, z up.

    Attributes
    ----------
    vertices : (n_v, 3) float64 array
        World coordinates in mm.
    faces : (n_f, 3) int32 array
        Rows in ``vertices``, counter-clockwise as seen from outside.
    uvs : (n_f, 3, 2) float64 array
        Image coordinates of every face corner: u to the right, v up, the whole
        image is [0, 1] x [0, 1]; values may leave it, see ``image_clamp``.
    face_image : (n_f,) int32 array
        Row in ``images`` of every face.
    images : tuple of (h, w, 3) uint8 arrays
        sRGB bytes; row 0 is the bottom (v = 0). A plain colour is a 1 x 1 image.
    image_clamp : (n_images,) bool array
        True where coordinates outside the image take its edge texel, False
        where the image repeats.
    opacities : tuple of ((h, w) uint8 array or None)
        Alpha of the texels of each image, 255 for opaque; None where all are.
        Empty where no image has any.
    weight : (n_v,) float64 array or None
        How many times more than other surface the one at each vertex counts
        wherever likeness is weighed against something else: 0 for as much. As
        read 0 to 1; None where a user has weighted nothing.
    features : WeightField or None
        How many times more surface counts as it is a feature, besides that.
    """

    vertices: Floats
    faces: NDArray[np.int32]
    uvs: Floats
    face_image: NDArray[np.int32]
    images: tuple[NDArray[np.uint8], ...]
    image_clamp: NDArray[np.bool_]
    opacities: tuple[NDArray[np.uint8] | None, ...] = ()
    weight: Floats | None = None
    features: WeightField | None = None

    @property
    def normals(self) -> Floats:
        """Outward normal of each face, twice its area long, shape (n_f, 3)."""
        corners = self.vertices[self.faces]
        normals: Floats = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return normals


@dataclass(frozen=True, slots=True)
class Repairs:
    """What :func:`repair` did to a mesh and what it left.

    A *patch* is a surface connected through edges of two faces; a body is all
    that is connected through edges.

    Attributes
    ----------
    welded : int
        Vertices merged with another one at the same place.
    degenerate, duplicate : int
        Triangles left out because they have no area, or because another one lies on the same three vertices.
    flipped, turned : int
        Single triangles, and whole patches, turned to face outwards.
    filled : int
        Small holes filled.
    open_edges, non_manifold_edges : int
        Edges left with one face, and with more than two.
    one_sided : int
        Patches that have no inside, such as a Moebius strip.
    patches, bodies : int
        Of the repaired mesh.
    watertight : bool
        Whether every edge has as many faces one way as the other.
    """

    welded: int
    degenerate: int
    duplicate: int
    flipped: int
    turned: int
    filled: int
    open_edges: int
    non_manifold_edges: int
    one_sided: int
    patches: int
    bodies: int
    watertight: bool

    def sentences(self) -> tuple[str, ...]:
        """Return what a user should know, one sentence each."""
        whole = self.turned > 0 and self.turned == self.patches
        told = (
            (whole, "Turned the whole mesh, which was inside out."),
            (self.turned and not whole, f"Turned {self.turned} of {self.patches} surfaces, which faced inwards."),
            (self.flipped, f"Turned {_number(self.flipped, 'triangle')} that faced the wrong way."),
            (self.duplicate, f"Removed {_number(self.duplicate, 'triangle')} on top of others."),
            (self.filled, f"Filled {_number(self.filled, 'small hole')}."),
            (self.open_edges, f"The mesh is open along {_number(self.open_edges, 'edge')}: slices are closed there."),
            (self.one_sided, f"Kept {_number(self.one_sided, 'surface')} without an inside, like a Moebius strip."),
        )
        return tuple(sentence for count, sentence in told if count)


def repair(mesh: TriangleMesh, *, fill: bool = True) -> tuple[TriangleMesh, Repairs]:
    """Check a mesh, repair it, and turn every body outwards.

    Vertices at one place become one; faces without area, repeated faces and backs
    of double-sided surfaces are removed; small holes are filled in the colours
    around them; every patch is wound one way, outwards (cavities inwards). Larger
    openings stay open. What stays keeps its order, and a mesh that needs nothing
    comes back as it was. Triangles without area stay where the surface would be
    torn without them, so do not divide by an area.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, of any quality.
    fill : bool, optional
        Whether small holes are filled.

    Returns
    -------
    mesh : TriangleMesh
        The repaired mesh, with the same images.
    repairs : Repairs
        What was done, and what is left.

    Raises
    ------
    MeshError
        The mesh has no faces, too few triangles, no size, coordinates that are
        no finite numbers or too great, or weights that are not from 0 to 1.
    """
    vertices, number = _referenced(mesh)
    centre, diagonal = _frame(vertices)
    points = (vertices - centre) / diagonal
    first = weld(points, WELD)
    surface, n_duplicate = _sound(points, first.astype(np.int32)[number][mesh.faces], mesh)
    n_sound = len(surface.faces)

    winding = consistent_winding(surface.edges, surface.area)
    mended = np.bincount(winding.patch, weights=winding.flip) > 0
    surface, patch, n_holes = surface.turned(winding.flip), winding.patch, 0
    if fill:
        surface, patch, n_holes = _filled(surface, patch)
    inwards = inside_out(surface.points, surface.faces, surface.edges, patch, mended, winding.one_sided)
    surface = surface.turned(inwards[patch])

    new = surface.points[len(points) :] * diagonal + centre
    flipped = (winding.flip != inwards[winding.patch]) & mended[winding.patch]
    rim, _ = open_rim(surface.faces, surface.edges, np.zeros_like(patch))
    repairs = Repairs(
        welded=int((first != np.arange(len(first))).sum()),
        degenerate=len(mesh.faces) - n_sound - n_duplicate,
        duplicate=n_duplicate,
        flipped=int(flipped.sum()),
        turned=int((inwards & ~mended).sum()),
        filled=n_holes,
        open_edges=int((surface.edges.count == 1).sum()),
        non_manifold_edges=int((surface.edges.count > 2).sum()),
        one_sided=int(winding.one_sided.sum()),
        patches=len(mended),
        bodies=n_bodies(surface.edges, patch),
        watertight=not len(rim) and not winding.one_sided.any(),
    )
    weight = repaired_weight(mesh.weight, number, mesh.faces, first, surface.faces)
    return _assembled(np.concatenate([vertices, new]), weight, surface, mesh), repairs


def checked_vertices(mesh: TriangleMesh) -> Floats:
    """Return the vertices that faces use, or refuse a mesh that :func:`repair` refuses at first sight.

    Parameters
    ----------
    mesh : TriangleMesh
        As read.

    Returns
    -------
    (n, 3) float64 array
        In mm.

    Raises
    ------
    MeshError
        The mesh has no faces, too few triangles, no size, or coordinates that
        are no finite numbers or too great.
    """
    vertices, _ = _referenced(mesh)
    _frame(vertices)
    return vertices


@dataclass(frozen=True, slots=True, eq=False)
class _Surface:
    """A mesh under repair; its points are measured from its centre, in its diagonals."""

    points: Floats
    faces: NDArray[np.int32]
    uvs: Floats
    image: NDArray[np.int32]
    area: Floats
    edges: Edges

    def turned(self, flip: Mask) -> _Surface:
        """Return the surface with some faces turned."""
        if not flip.any():
            return self
        faces, uvs = self.faces.copy(), self.uvs.copy()
        faces[flip], uvs[flip] = faces[flip][:, [0, 2, 1]], uvs[flip][:, [0, 2, 1]]
        return replace(self, faces=faces, uvs=uvs, edges=self.edges.turned(flip))


def _referenced(mesh: TriangleMesh) -> tuple[Floats, Ints]:
    """Return the vertices that faces use and the new number of every vertex, or refuse the mesh."""
    n_vertices, n_faces = len(mesh.vertices), len(mesh.faces)
    if n_faces == 0:
        raise MeshError(f"The mesh has {_number(n_vertices, 'vertex')} and no faces: choose an object with a surface.")
    if n_faces < FEWEST_TRIANGLES:
        raise MeshError(
            f"The mesh has only {_number(n_faces, 'triangle')}: choose an object with at least {FEWEST_TRIANGLES}."
        )
    worst = int(mesh.faces.min()) if mesh.faces.min() < 0 else int(mesh.faces.max())
    if not 0 <= worst < n_vertices:
        raise MeshError(f"A face has the vertex {worst}, but there are {n_vertices}: export the mesh again.")
    used = np.zeros(n_vertices, bool)
    used[mesh.faces] = True
    vertices = mesh.vertices[used]
    bad = int((~np.isfinite(vertices)).any(axis=1).sum())
    if bad:
        raise MeshError(f"The coordinates of {_number(bad, 'vertex')} are not finite numbers: delete these vertices.")
    bad = int((~np.isfinite(mesh.uvs)).sum())
    if bad:
        raise MeshError(f"{_number(bad, 'image coordinate')} of the UV map not finite: unwrap the mesh again.")
    return vertices, np.cumsum(used) - 1


def _frame(vertices: Floats) -> tuple[Floats, float]:
    """Return centre and diagonal of the box around the vertices, or refuse sizes that cannot be computed with."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    # halves, because the difference of two great numbers may overflow
    diagonal = 2 * math.hypot(*(high / 2 - low / 2))
    if diagonal == 0:
        raise MeshError("The mesh is 0 mm in size: give the object a scale other than zero.")
    if not SMALLEST <= diagonal <= LARGEST:
        raise MeshError(f"The mesh is {diagonal:.3g} mm in size: scale it to {SMALLEST:g} to {LARGEST:g} mm.")
    away = float(np.abs(low / 2 + high / 2).max())
    if away > FARTHEST * diagonal:
        raise MeshError(f"The mesh of {diagonal:.3g} mm lies {away:.3g} mm from the origin: move it closer.")
    return (low + high) / 2, diagonal


def _sound(points: Floats, faces: NDArray[np.int32], mesh: TriangleMesh) -> tuple[_Surface, int]:
    """Drop faces without area or that repeat others; return the rest and the number of repeats."""
    a, b, c = faces.T
    rows = np.flatnonzero((a != b) & (b != c) & (c != a))
    n_duplicate = 0
    while True:
        if len(rows) < FEWEST_TRIANGLES:
            raise MeshError(
                f"Only {len(rows)} of {len(faces)} triangles have an area: choose an object with a surface."
            )
        kept = faces[rows]
        edges = edges_of(kept)
        area, longest = areas_and_longest_sides(points[kept])
        drop = redundant(kept, edges)
        n_duplicate += int(drop.sum())
        if not drop.any():
            drop = useless_slivers(area <= WELD / 2 * longest, edges)
        # one removal may uncover the next
        if not drop.any():
            return _Surface(points, kept, mesh.uvs[rows], mesh.face_image[rows], area, edges), n_duplicate
        rows = rows[~drop]


def _filled(surface: _Surface, patch: Ints) -> tuple[_Surface, Ints, int]:
    """Fill small holes; return the surface, the patch of every face and the number of holes."""
    n_holes = 0
    while (filling := small_holes(surface.points, surface.faces, surface.edges, patch, surface.area)) is not None:
        face, corner = filling.rim // 3, filling.rim % 3
        start, end = surface.uvs[face, corner], surface.uvs[face, (corner + 1) % 3]
        # the colours of the rim run inwards
        uvs = np.stack([end, start, (start + end) / 2], axis=1)
        points = np.concatenate([surface.points, filling.centres])
        area, _ = areas_and_longest_sides(points[filling.faces])
        faces = np.concatenate([surface.faces, filling.faces])
        surface = _Surface(
            points,
            faces,
            np.concatenate([surface.uvs, uvs]),
            np.append(surface.image, surface.image[face]),
            np.append(surface.area, area),
            edges_of(faces),
        )
        patch = np.append(patch, patch[face])
        n_holes += filling.n_holes
    return surface, patch, n_holes


def _assembled(vertices: Floats, weight: Floats | None, surface: _Surface, mesh: TriangleMesh) -> TriangleMesh:
    """Return the repaired mesh without unused vertices."""
    used = np.zeros(len(vertices), bool)
    used[surface.faces] = True
    faces = (np.cumsum(used) - 1)[surface.faces].astype(np.int32)
    weight = None if weight is None else weight[used]
    return replace(mesh, vertices=vertices[used], faces=faces, uvs=surface.uvs, face_image=surface.image, weight=weight)


def _number(n: int, noun: str) -> str:
    """Return a count with its noun, such as "1 triangle", "2 triangles", "3 vertices"."""
    plural = {"vertex": "vertices"}.get(noun, noun + "s")
    return f"{n} {noun if n == 1 else plural}"
