"""Duplicates of a build's root, as Shift-D, Alt-D and Ctrl-C with Ctrl-V make them, become builds of their own.

Blender copies the objects that are selected, and leaves the copies in the
collections of the originals, or in the active one if they are pasted. So a
copied root stands in the build that it came from, or alone, often without
anything that hangs on it. It gets a collection with layers,
plane and points, copied where Blender has not, and the state of the build.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from uuid import uuid4

import bpy

from .brick_tree import SECTION
from .builds import LAYER_KEY, ROLE_KEY, all_builds, builds, damage, is_own, layers_of, line_objects, point_objects
from .instancing import bricks_modifier, set_input
from .placing import collection_around, layer_collections
from .root import MODEL_KEY, is_root
from .state import BUILD_KEY, state_of

Kind = tuple[str, int | None, int | None]
"""Type of an object of a build, its layer, and its role: what tells it from all others."""


def is_copied_root(thing: bpy.types.Object) -> bool:
    """Tell whether an object may be the root of a build, or a copy of one: a sign to look with :func:`adopt_copies`."""
    free = thing.parent is None or not is_own(thing.parent)
    return is_own(thing) and is_root(thing) and free


def is_bare_root(scene: bpy.types.Scene, thing: bpy.types.Object) -> bool:
    """Tell whether an object is the root of a model without the model: pasted, here or from another file."""
    return is_copied_root(thing) and not any(thing in build.all_objects[:] for build in builds(scene))


def copied_roots(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the copies of the root of a build that are no builds yet, by name: in it, or pasted into any scene."""
    root = state_of(build).root
    copies = {thing for thing in build.all_objects if thing != root and is_copied_root(thing)}
    word = root.get(MODEL_KEY) if root else None
    for scene in bpy.data.scenes if word else ():
        alike = [thing for thing in scene.objects if thing.get(MODEL_KEY) == word and thing != root]
        copies |= {thing for thing in alike if is_bare_root(scene, thing)}
    return sorted(copies, key=lambda thing: thing.name)


def adopt_copies(
    scene: bpy.types.Scene, left: Container[int] = ()
) -> list[tuple[bpy.types.Collection, bpy.types.Collection]]:
    """Make builds of the copies of roots in a scene.

    Parameters
    ----------
    scene : bpy.types.Scene
    left : container of int, optional
        Session identifiers of copies that are left as they are.

    Returns
    -------
    list of (bpy.types.Collection, bpy.types.Collection)
        Each new build, after the one that it is a copy of.
    """
    found = []
    here = builds(scene)
    # the models of a copied scene have the words of the others
    for build in (*here, *(each for each in all_builds() if each not in here)):
        copies = [root for root in copied_roots(build) if scene in root.users_scene and root.session_uid not in left]
        if copies and damage(build) is None:
            found += [(build, _adopted(scene, build, copy)) for copy in copies]
    return found


def _adopted(scene: bpy.types.Scene, build: bpy.types.Collection, root: bpy.types.Object) -> bpy.types.Collection:
    """Make a build of a copied root and what was copied with it."""
    state = state_of(build)
    layers = layers_of(build)
    new = bpy.data.collections.new(build.name)
    copies = {layer: _empty_copy(layer) for layer in layers}
    around = collection_around(scene, build) if build in builds(scene) else scene.collection
    around.children.link(new)
    for layer in layers:
        new.children.link(copies[layer])
    hanging = (thing for thing in build.all_objects if is_own(thing) and thing.parent == root)
    copied = {_kind(thing, layers): thing for thing in hanging if not is_root(thing)}
    for home in root.users_collection:
        home.objects.unlink(root)
    new.objects.link(root)
    root[MODEL_KEY] = uuid4().hex
    plane = _taken(copied, state.plane, layers)
    _place(plane, root, new, build)
    for points in (*point_objects(build), *line_objects(build)):
        copy = _taken(copied, points, layers)
        _place(copy, root, next((copies[layer] for layer in layers if points.name in layer.objects), new), build)
        modifier = bricks_modifier(copy)
        if modifier is not None:
            set_input(modifier, SECTION, plane)
    for key in build.keys():  # noqa: SIM118 - a collection is no mapping
        if key != BUILD_KEY:
            new[key] = build[key]
    new[BUILD_KEY] = {**build[BUILD_KEY].to_dict(), "root": root, "plane": plane}
    _look_alike(scene, [(build, new), *copies.items()])
    return new


def _empty_copy(layer: bpy.types.Collection) -> bpy.types.Collection:
    copy = bpy.data.collections.new(layer.name)
    copy[LAYER_KEY] = layer[LAYER_KEY]
    return copy


def _kind(thing: bpy.types.Object, layers: Sequence[bpy.types.Collection]) -> Kind:
    layer = next((each[LAYER_KEY] for each in layers if thing.name in each.objects), None)
    return thing.type, layer, thing.get(ROLE_KEY)


def _taken(
    copied: dict[Kind, bpy.types.Object], thing: bpy.types.Object, layers: Sequence[bpy.types.Collection]
) -> bpy.types.Object:
    """Return the copy of an object that Blender has made, else a new one."""
    copy = copied.pop(_kind(thing, layers), None)
    if copy is None:
        copy = thing.copy()
        if thing.data is not None:
            copy.data = thing.data.copy()
    return copy


def _place(
    thing: bpy.types.Object, root: bpy.types.Object, home: bpy.types.Collection, build: bpy.types.Collection
) -> None:
    """Hang an object on its new root, and put it into the new build."""
    # which a new parent unsets
    inverse = thing.matrix_parent_inverse.copy()
    thing.parent = root
    thing.matrix_parent_inverse = inverse
    _move([thing], home, build)


def _move(things: Sequence[bpy.types.Object], home: bpy.types.Collection, build: bpy.types.Collection) -> None:
    """Bring objects into a collection, and out of a build."""
    for thing in things:
        if thing.name not in home.objects:
            home.objects.link(thing)
        for collection in (build, *build.children_recursive):
            if collection.objects.get(thing.name) == thing:
                collection.objects.unlink(thing)


def _look_alike(scene: bpy.types.Scene, pairs: Sequence[tuple[bpy.types.Collection, bpy.types.Collection]]) -> None:
    """Hide copies of collections where these are hidden."""
    new = dict(pairs)
    for collection, copy in pairs:
        copy.hide_viewport, copy.hide_render = collection.hide_viewport, collection.hide_render
    for layer in scene.view_layers:
        entries = {entry.collection: entry for entry in layer_collections(layer.layer_collection)}
        for collection, copy in new.items():
            if collection in entries and copy in entries:
                entries[copy].exclude = entries[collection].exclude
                entries[copy].hide_viewport = entries[collection].hide_viewport
