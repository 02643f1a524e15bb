"""Chosen objects without a surface that could be built, and the sentences about them."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from typing import Final

import bpy
import numpy as np

from ..core.errors import MeshError
from .shown import Shown

_FLAT: Final = 1e-6
"""Smallest of the three stretches of an object, as a share of the largest, that is not flat."""

_INFINITE: Final = 1e30
"""Numbers from here on stand for infinity, for which Blender sets the greatest float, 3.4e38."""

_NAMED: Final = 3
"""Names in a sentence; more objects are counted."""


class Why(Enum):
    """Why an object is left out: what it has, and what to do where nothing else is left."""

    FLAT = "a scale of zero", "choose another scale"
    NOWHERE = "a location, rotation or scale that is not finite", "clear the transform"
    NO_NUMBERS = "vertices whose coordinates are not finite numbers", "remove those vertices"
    NO_FACES = "no faces", "choose an object with a surface"


class LeftOut:
    """The objects that are left out while others are read."""

    def __init__(self) -> None:
        # dictionaries keep their order; that of sets differs in every run
        self._names: dict[Why, dict[str, None]] = {why: {} for why in Why}
        self._bare: dict[bpy.types.Object, str] = {}
        self._taken: set[bpy.types.Object] = set()

    def by_matrix(self, each: Shown) -> bool:
        """Return whether an object is left out for its place in the world, and note it."""
        if not _finite(each.matrix):
            return self._note(Why.NOWHERE, each.mesh.name)
        stretches = np.linalg.svd(each.matrix[:3, :3], compute_uv=False)
        return stretches[2] <= _FLAT * stretches[0] and self._note(Why.FLAT, each.mesh.name)

    def by_mesh(self, each: Shown, mesh: bpy.types.Mesh) -> bool:
        """Return whether an object is left out for its evaluated mesh, and note it."""
        if not len(mesh.polygons):
            self._bare.setdefault(each.owner, each.mesh.name)
            return True
        places = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
        mesh.vertices.foreach_get("co", places)
        if not _finite(places):
            return self._note(Why.NO_NUMBERS, each.mesh.name)
        self._taken.add(each.owner)
        return False

    def check(self) -> None:
        """Refuse to go on if nothing was taken.

        Raises
        ------
        MeshError
            With the first reason.
        """
        if self._taken:
            return
        for why, names in self._reasons():
            raise MeshError(f"{_have(names, why)}: {why.value[1]}.")
        raise MeshError("There is nothing to build from: select a mesh object that is visible.")

    def sentences(self) -> tuple[str, ...]:
        """Return a remark for each reason."""
        return tuple(
            f"{_have(names, why)}: {'it was' if len(names) == 1 else 'they were'} left out."
            for why, names in self._reasons()
        )

    def _note(self, why: Why, name: str) -> bool:
        self._names[why][name] = None
        return True

    def _reasons(self) -> Iterator[tuple[Why, list[str]]]:
        """Yield each reason with the objects' names; an object that only instances others has faces in them."""
        bare = [name for owner, name in self._bare.items() if owner not in self._taken]
        for why, names in {**self._names, Why.NO_FACES: bare}.items():
            if names:
                yield why, list(names)


def _finite(numbers: np.ndarray) -> bool:
    # a comparison with no number is false
    return bool((np.abs(numbers) < _INFINITE).all())


def _have(names: list[str], why: Why) -> str:
    if len(names) == 1:
        return f"The object {names[0]!r} has {why.value[0]}"
    named = ", ".join(repr(name) for name in names[:_NAMED])
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"The objects {named}{more} have {why.value[0]}"
