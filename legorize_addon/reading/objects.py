"""Evaluated objects with their materials as one triangle mesh: the door from Blender into the core.

Taken are the triangles that Blender shows, as :mod:`.reading.shown` says: after
modifiers, parents and instancing, curves and texts as the meshes they make.
What has no surface or no size is left out, with a remark, as long as something
else is there. Nothing in the file is changed.

==========================  ==========================================================
colour of a material        becomes
==========================  ==========================================================
an image                    that image, by the UV map that its node uses
an image times a colour     a new image, multiplied in linear light
a plain colour              an image of one texel
a colour attribute          texels of an image, see :mod:`.colours`
anything else               an image baked by Cycles, see :mod:`.bake`
no material                 the active colour attribute, else a middle grey
==========================  ==========================================================

Beside the colour of a texel stands how much of it is seen, see
:mod:`.reading.opacity`. UDIM tiles are one image each. Colours are linear in
Blender and sRGB bytes in the mesh.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import NamedTuple

import bpy
import numpy as np

from ..core.mesh import TriangleMesh
from ..core.units import MM_PER_METRE
from .bake import Bakeable, baked
from .colours import Floats, colour_patches
from .images import Album
from .left_out import LeftOut
from .shown import Shown, shown, when_rendered
from .surface import Surface, read_surface, slot_materials, slot_paints
from .weights import Weights


class Piece(NamedTuple):
    """A mesh that is shown, apart from Blender's data.

    Attributes
    ----------
    surface : Surface or Bakeable
    weight : (n_v,) float64 array or None
        What its vertices have been painted with.
    """

    surface: Surface | Bakeable
    weight: Floats | None


class Painted(NamedTuple):
    """The same with its colours.

    Attributes
    ----------
    surface : Surface
    uvs : (n_f, 3, 2) float64 array
        Coordinates in the images of an album.
    image : (n_f,) int32 array
        Image of each face, -1 where it is coloured by its corners.
    weight : (n_v,) float64 array or None
    """

    surface: Surface
    uvs: Floats
    image: np.ndarray
    weight: Floats | None


def read_objects(
    objects: Iterable[bpy.types.Object], depsgraph: bpy.types.Depsgraph, *, weight: str = ""
) -> tuple[TriangleMesh, tuple[str, ...]]:
    """Read objects as one mesh, as the viewport shows them.

    Parameters
    ----------
    objects : iterable of bpy.types.Object
        Those that make no surface (lights, cameras, ...) are left out.
    depsgraph : bpy.types.Depsgraph
        Up to date.
    weight : str, optional
        Vertex group or attribute that says where likeness counts more; objects without it count as usual.

    Returns
    -------
    TriangleMesh
        In mm of the world, by the scene's unit scale.
    tuple of str
        Remarks: one sentence each on what could not be taken literally.

    Raises
    ------
    MeshError
        If there is nothing to read, an image does not fit in memory, or a colour cannot be baked.
    SettingsError
        No object has that weight, or it is not from 0 to 1.
    """
    album, left_out, weights = Album(), LeftOut(), Weights(weight)
    pieces = _pieces(depsgraph, list(objects), album, left_out, weights)
    return _read(pieces, depsgraph.scene, album, left_out, weights)


def read_rendered(
    objects: Iterable[bpy.types.Object], context: bpy.types.Context, *, weight: str = ""
) -> tuple[TriangleMesh, tuple[str, ...]]:
    """Read objects as one mesh, as renders of the context's view layer show them.

    Parameters
    ----------
    objects : iterable of bpy.types.Object
        As for :func:`read_objects`; those that renders do not show are left out too.
    context : bpy.types.Context
        Its scene has the objects.
    weight : str, optional
        As for :func:`read_objects`.

    Returns
    -------
    TriangleMesh
        In mm of the world, by the scene's unit scale.
    tuple of str
        Remarks.

    Raises
    ------
    MeshError, SettingsError
        As :func:`read_objects` does.
    """
    album, left_out, weights = Album(), LeftOut(), Weights(weight)
    read = partial(_pieces, objects=list(objects), album=album, left_out=left_out, weights=weights)
    return _read(when_rendered(context, read), context.scene, album, left_out, weights)


def _pieces(
    depsgraph: bpy.types.Depsgraph, objects: list[bpy.types.Object], album: Album, left_out: LeftOut, weights: Weights
) -> list[Piece]:
    """Return the surfaces that are shown, apart from Blender's data: baking adds to it, which ends all walks in it."""
    found = [_piece(each, album, left_out, weights) for each in shown(objects, depsgraph)]
    return [piece for piece in found if piece is not None]


def _read(
    pieces: list[Piece], scene: bpy.types.Scene, album: Album, left_out: LeftOut, weights: Weights
) -> tuple[TriangleMesh, tuple[str, ...]]:
    left_out.check()
    weights.check()
    painted = [_painted(piece, album) for piece in pieces]
    mm = scene.unit_settings.scale_length * MM_PER_METRE
    return _joined(painted, mm, album), (*left_out.sentences(), *album.remarks)


def _piece(each: Shown, album: Album, left_out: LeftOut, weights: Weights) -> Piece | None:
    """Return the surface of a mesh that is shown; none if it has no size or no faces."""
    if left_out.by_matrix(each):
        return None
    # preserve_all_data_layers would evaluate anew, for which an instance stands for its object
    mesh = each.mesh.to_mesh()
    try:
        if left_out.by_mesh(each, mesh):
            return None
        paints, weight = slot_paints(each.mesh, mesh, each.values, album), weights.of(each.mesh, mesh)
        if None in paints:
            album.remark(f"The colours of {each.mesh.name!r} are made by nodes: they were baked to an image.")
            own = slot_materials(each.mesh, mesh)
            return Piece(Bakeable.of(each.mesh.name, mesh, each.matrix, paints, own, each.values), weight)
        return Piece(read_surface(mesh, each.matrix, paints), weight)
    finally:
        each.mesh.to_mesh_clear()


def _painted(piece: Piece, album: Album) -> Painted:
    """Return a surface with its colours; baking keeps the vertices as they are."""
    found = piece.surface
    if isinstance(found, Surface):
        return Painted(found, *found.images(album), piece.weight)
    with baked(found) as (mesh, paints):
        surface = read_surface(mesh, found.matrix, paints)
        return Painted(surface, *surface.images(album), piece.weight)


def _joined(painted: list[Painted], mm: float, album: Album) -> TriangleMesh:
    surfaces = [each.surface for each in painted]
    first = np.cumsum([0, *(len(surface.vertices) for surface in surfaces)])
    uvs = np.concatenate([each.uvs for each in painted])
    face_image = np.concatenate([each.image for each in painted])
    _paint_corners(np.concatenate([surface.corners for surface in surfaces]), uvs, face_image, album)
    return TriangleMesh(
        vertices=np.concatenate([surface.vertices for surface in surfaces]) * mm,
        faces=np.concatenate([surface.faces + start for surface, start in zip(surfaces, first, strict=False)]).astype(
            np.int32
        ),
        uvs=uvs,
        face_image=face_image,
        images=tuple(album.images),
        image_clamp=np.array(album.clamp, dtype=bool),
        opacities=tuple(album.opacities) if any(each is not None for each in album.opacities) else (),
        weight=_joined_weight(painted),
    )


def _joined_weight(painted: list[Painted]) -> Floats | None:
    """Return the weights of all vertices, 0 for objects without any; None if no object has any."""
    if all(each.weight is None for each in painted):
        return None
    return np.concatenate(
        [np.zeros(len(each.surface.vertices)) if each.weight is None else each.weight for each in painted]
    )


def _paint_corners(corners: Floats, uvs: Floats, face_image: np.ndarray, album: Album) -> None:
    """Give the faces that are coloured by their corners a place in two images of their own."""
    rows = np.flatnonzero(face_image < 0)
    if len(rows) == 0:
        return
    shared, patches, plain, uvs[rows] = colour_patches(corners)
    for faces, image in ((plain, shared), (~plain, patches)):
        if faces.any():
            face_image[rows[faces]] = album.add(image[..., :3], clamp=True, opacity=image[..., 3])
