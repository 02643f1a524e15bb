"""Which builds a scene has, of what each was made, and what of it is there.

A collection is a build by the form of its state alone, see :mod:`.build_state`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..core.errors import BuildError
from ..core.model import Bricks, load_catalogue
from .brick_points import read_points
from .instancing import bricks_modifier
from .root import is_root
from .state import VERSION, BuildState, is_build, state_of

LAYER_KEY: Final = "legorize_layer"
ROLE_KEY: Final = "legorize_role"
OWN_KEY: Final = "legorize_own"
LINES_KEY: Final = "legorize_lines"
"""Key, on curves, of the trajectories in a layer of a build."""

GHOSTS: Final = ("MESH", "CURVE", "SURFACE", "FONT", "META")
"""Kinds of originals that have a form to be seen: not what only holds them."""


def builds(scene: bpy.types.Scene) -> list[bpy.types.Collection]:
    """Return the builds of a scene."""
    return [collection for collection in scene.collection.children_recursive if is_build(collection)]


def all_builds() -> list[bpy.types.Collection]:
    """Return the builds of all scenes."""
    return [build for scene in bpy.data.scenes for build in builds(scene)]


def builds_of(scene: bpy.types.Scene, objects: Sequence[bpy.types.Object]) -> list[bpy.types.Collection]:
    """Return the builds that were made of one of the objects or that contain one of them."""
    wanted = set(objects)
    return [build for build in builds(scene) if wanted and wanted & {*sources_of(build), *build.all_objects}]


def sources_of(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the objects that a build was made of, without those deleted since."""
    # an object deleted by hand lives on without a scene while something names it, as a build does
    return [entry.source for entry in state_of(build).sources if entry.source.users_scene]


def hidden_by(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the objects that a build hides: its sources, and what holds them, without those deleted since."""
    return [entry.source for entry in state_of(build).hidden if entry.source.users_scene]


def damage(build: bpy.types.Collection) -> str | None:
    """Return what is wrong with a build, in a sentence with its cure; None for a whole one."""
    state = state_of(build)
    if state.version > VERSION:
        return f"{build.name!r} was built by a newer version of Legorize: update the extension, or remove the model."
    there = set(build.all_objects)
    whole = state.root in there and state.plane in there and state.parts is not None
    if not whole or not all(map(bricks_modifier, point_objects(build))):
        return (
            f"{build.name!r} is damaged, because some of its objects were deleted: undo that, or remove the model "
            "and build it again."
        )
    if not _hangs_as_built(state):
        return (
            f"{build.name!r} is damaged, because the location, rotation or scale of its root was applied, or its "
            "origin was set: undo that, or remove the model and build it again."
        )
    return None


def _hangs_as_built(state: BuildState) -> bool:
    """Tell whether things hang on the root of a build as when it was built.

    Commands that change the frame itself let what hangs on it stay in its place, so that the root no longer tells
    where the bricks are.
    """
    usual = Matrix.Translation(-Vector(state.middle))
    return np.allclose(np.array(state.plane.matrix_parent_inverse), np.array(usual), rtol=1e-5, atol=1e-4)


def n_deleted(build: bpy.types.Collection) -> int:
    """Return how many of the objects whose points are the bricks were deleted since."""
    return max(state_of(build).objects - len(point_objects(build)), 0)


def check_whole(build: bpy.types.Collection) -> None:
    """Refuse a damaged build.

    Raises
    ------
    BuildError
        With what is wrong.
    """
    sentence = damage(build)
    if sentence:
        raise BuildError(sentence)


def layers_of(build: bpy.types.Collection) -> list[bpy.types.Collection]:
    """Return the collections of the layers that have bricks, from the lowest."""
    found = [child for child in build.children if isinstance(child.get(LAYER_KEY), int)]
    return sorted(found, key=lambda child: (child[LAYER_KEY], child.name))


def point_objects(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the objects whose points are the bricks of a build, without copies that a user made of them."""
    layer = {thing: collection[LAYER_KEY] for collection in layers_of(build) for thing in collection.all_objects}
    root = state_of(build).root
    meshes = (thing for thing in build.all_objects if is_own(thing) and thing.type == "MESH")
    own = [thing for thing in meshes if thing.parent == root and not is_root(thing)]
    # a copy of an object has the same properties, and its name comes after: names of copies grow
    first: dict[tuple[int | None, int | None], bpy.types.Object] = {}
    for thing in sorted(own, key=lambda thing: thing.name):
        first.setdefault((layer.get(thing), thing.get(ROLE_KEY)), thing)
    kept = set(first.values())
    return [thing for thing in own if thing in kept]


def own_objects(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return all objects that a build brought and that are in it still: its root, its plane, its points, its lines."""
    state = state_of(build)
    there = set(build.all_objects)
    frame = [thing for thing in (state.root, state.plane) if thing in there and is_own(thing)]
    return [*frame, *point_objects(build), *line_objects(build)]


def line_objects(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the curves of a build, one a layer that has any."""
    own = (thing for thing in build.all_objects if is_own(thing) and thing.type == "CURVE")
    return [thing for thing in own if LINES_KEY in thing.data]


def is_own(thing: bpy.types.Object) -> bool:
    """Tell whether an object came with a build, or is a copy of one that did."""
    return thing.get(OWN_KEY) is True or thing.get(OWN_KEY) == 1


def show_sources(build: bpy.types.Collection, *, visible: bool, linked_only: bool = False) -> None:
    """Show or hide the source objects of a build, or only those of other files, in the viewport and in renders."""
    for source in hidden_by(build):
        if source.library is not None or not linked_only:
            source.hide_viewport = source.hide_render = not visible
    for entry in state_of(build).hidden:
        entry.draw_as_before()


def can_show_ghost(build: bpy.types.Collection) -> bool:
    """Tell whether a build has originals to be shown."""
    return any(entry.source.type in GHOSTS for entry in state_of(build).hidden)


def ghost_shown(build: bpy.types.Collection) -> bool:
    """Tell whether the originals of a build are shown as ghosts."""
    found = [entry.source for entry in state_of(build).hidden if entry.source.type in GHOSTS]
    seen = [source for source in found if source.hide_render and not source.hide_viewport]
    return any(source.show_in_front and source.display_type == "WIRE" for source in seen)


def show_ghost(build: bpy.types.Collection, *, visible: bool) -> None:
    """Show the originals of a build as wires over its bricks, in the viewport alone, or hide them again."""
    show_sources(build, visible=False)
    for entry in state_of(build).hidden if visible else ():
        if entry.source.type in GHOSTS and entry.source.library is None:
            entry.show_as_ghost()


def bricks_of(build: bpy.types.Collection, found: Sequence[bpy.types.Object]) -> Bricks:
    """Return the table of the bricks that some point objects of a build hold, as :func:`read_bricks` does."""
    if not found:
        raise BuildError(f"The collection {build.name!r} has no bricks to show: legorize the object again.")
    return read_points([points.data for points in found], state_of(build).part_numbers, load_catalogue())
