"""Imported objects, stood upright as the file's axis or their shape asks for."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType
from typing import Final

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ..core.mesh import TURNS, stands_better

AXES: Final = MappingProxyType({".obj": "y", ".ply": "z", ".stl": "z", ".glb": "y", ".gltf": "y", ".fbx": "z"})
"""Axis of a file's coordinates that Blender's importer takes for up; of .fbx, which name theirs, that of Blender."""


def stand(objects: Sequence[bpy.types.Object], name: str, *, usual: str, up: str, by_shape: bool) -> list[str]:
    """Turn imported objects upright where their importer could not know.

    Parameters
    ----------
    objects : sequence of bpy.types.Object
        Just imported.
    name : str
        Of the file, for the remark.
    usual : {"x", "y", "z"}
        Axis of the file that its importer let point up.
    up : {"auto", "x", "y", "z"}
        Axis that points up.
    by_shape : bool
        Whether the shape decides about the first of these; else the importer is right.

    Returns
    -------
    list of str
        A remark if the shape decided to turn them.
    """
    decided = _by_shape(objects, usual) if up == "auto" and by_shape else usual
    wanted = decided if up == "auto" else up
    if wanted != usual:
        _turn(np.array(TURNS[wanted]) @ np.array(TURNS[usual]).T)
    if decided == usual:
        return []
    return [f"{name} was turned to stand on its base, with its {decided} axis up: --up {usual} leaves it as it was."]


def _by_shape(objects: Sequence[bpy.types.Object], usual: str) -> str:
    """Return the axis along which the meshes of objects stand, the usual one in doubt."""
    other = {"y": "z", "z": "y"}[usual]
    vertices, faces = _triangles(objects)
    if not len(faces) or not np.isfinite(vertices).all():
        return usual
    # back from the importer's axes to those of the file
    return other if stands_better(vertices @ np.array(TURNS[usual]), faces, usual, other) else usual


def _triangles(objects: Sequence[bpy.types.Object]) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the vertices of objects in the world, and their triangles."""
    bpy.context.view_layer.update()
    places, rows, first = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int32)], 0
    for obj in objects:
        if obj.type != "MESH":
            continue
        obj.data.calc_loop_triangles()
        own = np.empty(len(obj.data.vertices) * 3, dtype=np.float32)
        obj.data.vertices.foreach_get("co", own)
        matrix = np.array(obj.matrix_world)
        places.append(own.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])
        triangles = np.empty(len(obj.data.loop_triangles) * 3, dtype=np.int32)
        obj.data.loop_triangles.foreach_get("vertices", triangles)
        rows.append(triangles.reshape(-1, 3) + first)
        first += len(places[-1])
    return np.concatenate(places), np.concatenate(rows)


def _turn(turn: NDArray[np.floating]) -> None:
    """Turn all of the scene about its origin, by a parent, since animation may rule what the objects say themselves."""
    scene = bpy.context.scene
    above = bpy.data.objects.new("Upright", None)
    above.matrix_world = Matrix(turn.tolist()).to_4x4()
    for root in [obj for obj in scene.objects if obj.parent is None]:
        root.parent = above
    scene.collection.objects.link(above)
    bpy.context.view_layer.update()
