"""What an estimate needs of objects: their triangles and the sizes of their images, without any colour."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import bpy
import numpy as np

from ..core.mesh import TriangleMesh
from ..core.units import MM_PER_METRE
from .shown import Shown, shown

MOST_CORNERS: Final = 3_000_000
"""Corners of faces above which objects are not read for an estimate: a million triangles take some tenths of a second,
in which the window stands still."""


def read_outline(objects: Iterable[bpy.types.Object], depsgraph: bpy.types.Depsgraph) -> TriangleMesh | None:
    """Read the triangles of objects, as the viewport shows them.

    Parameters
    ----------
    objects : iterable of bpy.types.Object
    depsgraph : bpy.types.Depsgraph
        Up to date.

    Returns
    -------
    TriangleMesh or None
        In mm of the world. Its images have the right sizes but no colours, and no memory behind them. None if nothing
        is shown, or too much.
    """
    found: list[tuple[np.ndarray, np.ndarray]] = []
    images: dict[str, bpy.types.Image] = {}
    corners = 0
    for each in shown(objects, depsgraph):
        corners += len(each.mesh.data.loops)
        if corners > MOST_CORNERS:
            return None
        found.append(_triangles(each))
        images |= {image.name_full: image for image in _images(each.mesh)}
    if not any(len(faces) for _, faces in found):
        return None
    first = np.cumsum([0, *(len(vertices) for vertices, _ in found)])
    faces = np.concatenate([faces + start for (_, faces), start in zip(found, first, strict=False)])
    mm = depsgraph.scene.unit_settings.scale_length * MM_PER_METRE
    return TriangleMesh(
        vertices=np.concatenate([vertices for vertices, _ in found]) * mm,
        faces=faces.astype(np.int32),
        uvs=np.broadcast_to(0.0, (len(faces), 3, 2)),
        face_image=np.broadcast_to(np.int32(0), len(faces)),
        images=tuple(np.broadcast_to(np.uint8(0), (image.size[1], image.size[0], 3)) for image in images.values()),
        image_clamp=np.zeros(len(images), dtype=bool),
    )


def _triangles(each: Shown) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices of a mesh in the world, in Blender units, and the triangles between them."""
    mesh = each.mesh.data
    vertices = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.vertices.foreach_get("co", vertices.ravel())
    mesh.calc_loop_triangles()
    faces = np.empty((len(mesh.loop_triangles), 3), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", faces.ravel())
    return vertices @ each.matrix[:3, :3].T + each.matrix[:3, 3], faces


def _images(obj: bpy.types.Object) -> Iterator[bpy.types.Image]:
    """Yield the images of an object's materials."""
    for slot in obj.material_slots:
        tree = slot.material and slot.material.node_tree
        for node in tree.nodes if tree else ():
            if node.type == "TEX_IMAGE" and node.image:
                yield node.image
