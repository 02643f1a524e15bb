"""Where a build stands: a new one stands as the one that it replaces was moved, turned and scaled."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..core.units import STUD
from .builds import builds, damage, sources_of
from .root import Outline
from .state import BuildState, state_of

ROUNDING: Final = 1e-5
"""What 32 bits may lose of the place of an object that nobody moved, as a share."""


GAP: Final = 4 * STUD
"""Between builds side by side, in mm."""


class Place(NamedTuple):
    """Where a build stands: in which collection, moved how, as a child of what."""

    collection: bpy.types.Collection
    moved: Matrix
    parent: tuple[bpy.types.Object, Matrix] | None

    @classmethod
    def after(cls, scene: bpy.types.Scene, earlier: Sequence[bpy.types.Collection]) -> Place:
        """Return the place of the first whole one of some builds, else the scene's own."""
        for build in earlier:
            if damage(build) is None:
                state = state_of(build)
                moved = _moved(state)
                inverse = state.root.matrix_parent_inverse.copy()
                parent = (state.root.parent, inverse) if state.root.parent else None
                around = collection_around(scene, build)
                return cls(scene.collection if _unticked(scene, around) else around, moved, parent)
        return cls(scene.collection, Matrix(), None)

    def put(self, root: bpy.types.Object, first: Matrix) -> None:
        """Let a new root stand there, which would stand at its first place had nobody moved the build."""
        if self.parent is not None:
            root.parent, root.matrix_parent_inverse = self.parent
        root.matrix_basis = self.moved @ first


def collection_around(scene: bpy.types.Scene, build: bpy.types.Collection) -> bpy.types.Collection:
    """Return the collection in which a build lies."""
    around = (collection for collection in scene.collection.children_recursive if build.name in collection.children)
    return scene.collection if build.name in scene.collection.children else next(around)


def _unticked(scene: bpy.types.Scene, collection: bpy.types.Collection) -> bool:
    """Tell whether no view layer of a scene has a collection."""
    entries = (entry for layer in scene.view_layers for entry in layer_collections(layer.layer_collection))
    return all(entry.exclude for entry in entries if entry.collection == collection)


def layer_collections(entry: bpy.types.LayerCollection) -> Iterator[bpy.types.LayerCollection]:
    """Yield an entry of a view layer and all inside it."""
    yield entry
    for child in entry.children:
        yield from layer_collections(child)


def middle_of(outline: Outline) -> tuple[float, float, float]:
    """Return where the root of a new build is: below the middle of its bricks, on the ground, in mm."""
    low, high = outline["low"], outline["high"]
    return (low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]


def hang(thing: bpy.types.Object, root: bpy.types.Object, middle: Sequence[float]) -> None:
    """Make an object whose coordinates are the model's, in mm, a child of the root."""
    thing.parent = root
    thing.matrix_parent_inverse = Matrix.Translation(-Vector(middle))


def world_from_mm(build: bpy.types.Collection) -> Matrix:
    """Return the matrix from the model's coordinates, in mm, to the world."""
    state = state_of(build)
    return state.root.matrix_world @ Matrix.Translation(-Vector(state.middle))


def upright(origin: Sequence[float], unit_per_mm: float) -> Matrix:
    """Return where a root stands that nobody moved, if its place in the model is at an origin in mm of the object."""
    return Matrix.LocRotScale(Vector(origin) * unit_per_mm, None, Vector([unit_per_mm] * 3))


def stand_beside(scene: bpy.types.Scene, build: bpy.types.Collection, other: bpy.types.Collection) -> None:
    """Let a build stand beside another one and all that stand beside that already, moved and turned as it is.

    Parameters
    ----------
    scene : bpy.types.Scene
        Of both.
    build : bpy.types.Collection
        A new one of the same objects.
    other : bpy.types.Collection
        The one beside which it shall stand.
    """
    root, beside = state_of(build).root, state_of(other).root
    place, own = Place.after(scene, [other]), root.matrix_basis.copy()
    if place.parent is not None:
        root.parent, root.matrix_parent_inverse = place.parent
    # as it would stand in the other one's place
    there = place.moved @ own
    there.translation = beside.matrix_basis.translation
    family = [each for each in builds(scene) if each != build and set(sources_of(each)) & set(sources_of(build))]
    unit = there.to_scale().x
    axis = there.to_3x3().normalized().col[0]
    ends = [
        (state_of(each).root.matrix_basis.translation - there.translation).dot(axis) + _half(each) * unit
        for each in {*family, other}
        if damage(each) is None
    ]
    there.translation += axis * (max(ends) + (_half(build) + GAP) * unit)
    root.matrix_basis = there


def _half(build: bpy.types.Collection) -> float:
    """Return how far a build reaches from its root in mm, supports included."""
    (low, high), middle = state_of(build).extent, state_of(build).middle
    return max(high[0] - middle[0], middle[0] - low[0])


def _moved(state: BuildState) -> Matrix:
    """Return what was done to a root since it was made."""
    first = upright(np.add(state.origin, state.middle).tolist(), state.unit_per_mm)
    now = state.root.matrix_basis
    same = np.allclose(np.array(first), np.array(now), rtol=ROUNDING, atol=ROUNDING * state.unit_per_mm)
    return Matrix() if same else now @ first.inverted()
