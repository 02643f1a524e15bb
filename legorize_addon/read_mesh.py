"""Evaluated objects with their materials as one triangle mesh: the door from Blender into the core.

Taken are the triangles that the viewport shows: after modifiers, parents and
instancing, curves and texts as the meshes they make. Nothing in the file is
changed.

==========================  ==========================================================
colour of a material        becomes
==========================  ==========================================================
an image                    that image, by the UV map that its node uses
an image times a colour     a new image, multiplied in linear light
a plain colour              an image of one texel
a colour attribute          texels of an image, see :mod:`.read_colours`
anything else               an image baked by Cycles, see :mod:`.bake`
no material                 the active colour attribute, else a middle grey
==========================  ==========================================================

Texels whose alpha is below a half take the average of the others where alpha
decides what is seen. UDIM tiles are one image each. Colours are linear in
Blender and sRGB bytes in the mesh.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import bpy
import numpy as np

from .bake import Bakeable, baked
from .core.errors import MeshError
from .core.mesh import TriangleMesh
from .core.units import MM_PER_METRE
from .read_colours import Floats, colour_patches
from .read_images import Album
from .read_surface import Surface, read_surface, slot_materials, slot_paints

_FLAT: Final = 1e-6
"""Smallest of the three stretches of an object, as a share of the largest, that is not flat."""


def read_objects(
    objects: Iterable[bpy.types.Object], depsgraph: bpy.types.Depsgraph
) -> tuple[TriangleMesh, tuple[str, ...]]:
    """Read objects as one mesh.

    Parameters
    ----------
    objects : iterable of bpy.types.Object
        Those that make no surface (lights, cameras, ...) are left out.
    depsgraph : bpy.types.Depsgraph
        Up to date.

    Returns
    -------
    TriangleMesh
        In mm of the world, by the scene's unit scale.
    tuple of str
        Remarks: one sentence each on what could not be taken literally.

    Raises
    ------
    MeshError
        If there is nothing to read, an image is missing, or a colour cannot be baked.
    """
    chosen = [obj.original for obj in objects]
    mm = depsgraph.scene.unit_settings.scale_length * MM_PER_METRE
    album = Album()
    # baking adds data, which must not happen while the instances are walked
    found = [_read(obj, matrix, album) for obj, matrix in _shown(chosen, depsgraph)]
    painted = [_painted(surface, album) for surface in found]
    if not painted:
        raise MeshError("There is nothing to build from: select a mesh object that is visible.")
    if not any(len(surface.faces) for surface, _, _ in painted):
        names = ", ".join(repr(obj.name) for obj in chosen)
        raise MeshError(f"There are no faces in {names}: choose an object with a surface.")
    return _joined(painted, mm, album), tuple(album.remarks)


def _shown(chosen: list[bpy.types.Object], depsgraph: bpy.types.Depsgraph) -> Iterator[tuple[bpy.types.Object, Floats]]:
    """Yield the evaluated meshes that the chosen objects show, themselves or by instancing, and their matrices.

    Curves, texts and metaballs come a second time here, as instances of the meshes they make.
    """
    for instance in depsgraph.object_instances:
        owner = instance.parent if instance.is_instance else instance.object
        if instance.object.type == "MESH" and instance.show_self and owner.original in chosen:
            yield instance.object, np.array(instance.matrix_world, dtype=float)


def _read(obj: bpy.types.Object, matrix: Floats, album: Album) -> Surface | Bakeable:
    stretches = np.linalg.svd(matrix[:3, :3], compute_uv=False)
    if stretches[2] <= _FLAT * stretches[0]:
        raise MeshError(f"The object {obj.name!r} has a scale of zero: give it another scale.")
    # preserve_all_data_layers would evaluate anew, for which an instance stands for its object
    mesh = obj.to_mesh()
    try:
        paints = slot_paints(obj, mesh, album)
        if None in paints:
            album.remark(f"The colours of {obj.name!r} are made by nodes: they were baked to an image.")
            return Bakeable.of(obj.name, mesh, matrix, paints, slot_materials(obj, mesh))
        return read_surface(mesh, matrix, paints)
    finally:
        obj.to_mesh_clear()


def _painted(found: Surface | Bakeable, album: Album) -> tuple[Surface, Floats, np.ndarray]:
    """Return a surface, its image coordinates and the image of each face (-1: coloured by its corners)."""
    if isinstance(found, Surface):
        return found, *found.images(album)
    with baked(found) as (mesh, paints):
        surface = read_surface(mesh, found.matrix, paints)
        return surface, *surface.images(album)


def _joined(painted: list[tuple[Surface, Floats, np.ndarray]], mm: float, album: Album) -> TriangleMesh:
    surfaces = [surface for surface, _, _ in painted]
    first = np.cumsum([0, *(len(surface.vertices) for surface in surfaces)])
    uvs = np.concatenate([own for _, own, _ in painted])
    face_image = np.concatenate([rows for _, _, rows in painted])
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
    )


def _paint_corners(corners: Floats, uvs: Floats, face_image: np.ndarray, album: Album) -> None:
    """Give the faces that are coloured by their corners a place in two images of their own."""
    rows = np.flatnonzero(face_image < 0)
    if len(rows) == 0:
        return
    shared, patches, plain, uvs[rows] = colour_patches(corners)
    for faces, image in ((plain, shared), (~plain, patches)):
        if faces.any():
            face_image[rows[faces]] = album.add(image, clamp=True)
