"""What holds objects without being seen itself: armatures and empties, in the way once those are hidden."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import bpy


def holders(scene: bpy.types.Scene, objects: Iterable[bpy.types.Object]) -> list[bpy.types.Object]:
    """Return the armatures and empties of a scene that hold some objects, and nothing else that is seen.

    Parameters
    ----------
    scene : bpy.types.Scene
    objects : iterable of bpy.types.Object

    Returns
    -------
    list of bpy.types.Object
        By name: parents, their parents, and the armatures of modifiers.
    """
    held = set(objects)
    found = {holder for each in held for holder in _holders_of(each)} - held
    others = {thing for thing in scene.objects if thing.type not in ("EMPTY", "ARMATURE")} - held
    busy = {holder for thing in others for holder in _holders_of(thing)}
    return sorted((each for each in found - busy if each in set(scene.objects)), key=lambda each: each.name)


def _holders_of(thing: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Yield what an object hangs on, as far as it is nothing that is seen."""
    parent = thing.parent
    while parent is not None:
        if _is_unseen(parent):
            yield parent
        parent = parent.parent
    for modifier in thing.modifiers:
        if modifier.type == "ARMATURE" and modifier.object is not None:
            yield modifier.object
            yield from _holders_of(modifier.object)


def _is_unseen(thing: bpy.types.Object) -> bool:
    return thing.type == "ARMATURE" or (thing.type == "EMPTY" and thing.instance_collection is None)
