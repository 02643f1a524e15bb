"""Weights that a user has painted: vertex groups, and attributes of points with one number each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import bpy
import numpy as np

from ..core.errors import SettingsError
from ..core.units import count_of
from .colours import Floats

KINDS: Final = ("FLOAT", "INT", "INT8", "BOOLEAN")
"""Types of attributes with one number."""

_ROUNDING: Final = 1e-5
"""By how much modifiers that blend single-precision weights may leave 0 to 1."""

_NAMED: Final = 5
"""Names in a sentence."""


class Weights:
    """What some objects have been painted with, under one name, while they are read.

    Parameters
    ----------
    name : str
        Of vertex groups and attributes; empty to read none.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self._found, self._names = False, dict[str, None]()

    def of(self, obj: bpy.types.Object, mesh: bpy.types.Mesh) -> Floats | None:
        """Return the weights of the vertices of an evaluated object.

        Parameters
        ----------
        obj : bpy.types.Object
        mesh : bpy.types.Mesh
            Its mesh.

        Returns
        -------
        (n_v,) float64 array or None
            0 to 1; None where it has none of this name.

        Raises
        ------
        SettingsError
            They are no numbers from 0 to 1, or not of points.
        """
        if not self.name:
            return None
        self._names |= dict.fromkeys(_names(obj, mesh))
        values = self._values(obj, mesh)
        if values is None:
            return None
        self._found = True
        bad = int(np.count_nonzero(~np.isfinite(values)))
        if bad:
            raise SettingsError(
                f"weight is {self.name!r}, which is no finite number on {count_of(bad, 'vertex', 'vertices')} of "
                f"{obj.name!r}: paint it again."
            )
        low, high = values.min(initial=0.0), values.max(initial=0.0)
        if low < -_ROUNDING or high > 1 + _ROUNDING:
            raise SettingsError(
                f"weight is {self.name!r}, which goes from {low:g} to {high:g} on {obj.name!r}: use values from 0 to 1."
            )
        return np.clip(values, 0.0, 1.0)

    def check(self) -> None:
        """Refuse a name that no object has.

        Raises
        ------
        SettingsError
            With some of the names that there are.
        """
        if not self.name or self._found:
            return
        names = ", ".join(map(repr, list(self._names)[:_NAMED]))
        known = f"there are {names}" if names else "there is none"
        raise SettingsError(
            f"weight is {self.name!r}, but no vertex group or attribute of points has that name: {known}."
        )

    def _values(self, obj: bpy.types.Object, mesh: bpy.types.Mesh) -> Floats | None:
        group = obj.vertex_groups.get(self.name)
        if group is not None:
            return _group(mesh, group.index)
        attribute = mesh.attributes.get(self.name)
        if attribute is None:
            return None
        if attribute.domain != "POINT" or attribute.data_type not in KINDS:
            raise SettingsError(
                f"weight is {self.name!r}, but that attribute of {obj.name!r} does not have one number for each point: "
                "choose one that has, or a vertex group."
            )
        values = np.empty(len(mesh.vertices), np.float32 if attribute.data_type == "FLOAT" else np.int32)
        if attribute.data_type == "BOOLEAN":
            values = values.astype(bool)
        attribute.data.foreach_get("value", values)
        return values.astype(np.float64)


def weight_names(objects: Iterable[bpy.types.Object]) -> list[str]:
    """Return the names that a user can choose from for some objects, each once; of instances none are known.

    Parameters
    ----------
    objects : iterable of bpy.types.Object
        Those that make no mesh have none.

    Returns
    -------
    list of str
        By name.
    """
    meshes = [obj for obj in objects if obj.type == "MESH"]
    return sorted({name for obj in meshes for name in _names(obj, obj.data)})


def _names(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> Iterator[str]:
    """Yield the names of vertex groups and of attributes of points with one number, but for Blender's own."""
    yield from (group.name for group in obj.vertex_groups)
    for each in mesh.attributes:
        if each.domain == "POINT" and each.data_type in KINDS and not each.is_internal:
            yield each.name


def _group(mesh: bpy.types.Mesh, index: int) -> Floats:
    """Return the weights of a vertex group; 0 for vertices that are not in it."""
    values = np.zeros(len(mesh.vertices))
    # Blender offers them vertex by vertex only
    for row, vertex in enumerate(mesh.vertices):
        for entry in vertex.groups:
            if entry.group == index:
                values[row] = entry.weight
    return values
