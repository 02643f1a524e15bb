"""The parts that builds show: shared by copies of a build, its own where it changes them, gone when nothing uses them.

Blender copies a build's collection with its objects, but not the parts that they
instance, which lie outside of every scene. So parts have no owner: they stay
while something uses them, and unused ones are removed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import bpy

from .brick_tree import HEAT_PARTS, PARTS, SECTION, brick_trees
from .builds import LINES_KEY, is_own
from .instancing import bricks_modifier, get_input, is_brick_material, set_input
from .part_meshes import MESH_KEY, PART_KEY
from .root import POINTS_KEY
from .state import BuildState

Tree = list[bpy.types.Collection]
"""A collection of parts and, after it, all that lie inside it."""


def is_parts(collection: bpy.types.Collection) -> bool:
    """Tell whether a collection holds parts of ours and nothing else."""
    return len(collection.objects) > 0 and all(isinstance(each.get(PART_KEY), str) for each in collection.objects)


def sweep() -> None:
    """Remove the parts that nothing shows any more, with their meshes and materials, points and trees without users."""
    # a deleted collection's state held its root and plane until it went, so that Blender left them without users
    while unused := [thing for thing in bpy.data.objects if is_own(thing) and thing.users == 0]:
        bpy.data.batch_remove(unused)  # the plane is free once the points are gone
    doomed = [tree for tree in _trees() if not _used_from_outside(tree)]
    variants = {variant for tree in doomed for collection in tree for variant in collection.objects}
    bpy.data.batch_remove([*variants, *(collection for tree in doomed for collection in tree)])
    _remove_unused(mesh for mesh in bpy.data.meshes if MESH_KEY in mesh or POINTS_KEY in mesh)
    _remove_unused(curve for curve in bpy.data.curves if LINES_KEY in curve)
    _remove_unused(material for material in bpy.data.materials if is_brick_material(material))
    _remove_unused(brick_trees())


def own_parts(state: BuildState, points: Sequence[bpy.types.Object]) -> None:
    """Give a build parts and meshes of its own, where it shares them with a copy.

    Parameters
    ----------
    state : BuildState
        Of the build.
    points : sequence of bpy.types.Object
        Its objects whose points are bricks.
    """
    for each in points:
        if each.data.users > 1:
            each.data = each.data.copy()
    tree = [state.parts, *state.parts.children_recursive]
    if not _used_from_outside(tree, [*points, state.owner]):
        return
    new = _copied(tree)
    for each in points:
        modifier = bricks_modifier(each)
        for name in (PARTS, HEAT_PARTS):
            if get_input(modifier, name) in new:
                set_input(modifier, name, new[get_input(modifier, name)])
    state.parts = new[state.parts]
    if state.heat_parts is not None:
        state.heat_parts = new[state.heat_parts]


def leave_plane(scene: bpy.types.Scene, plane: bpy.types.Object, own: Iterable[bpy.types.Object]) -> None:
    """Give copies of a build's objects a plane of their own, before the one that they still read is removed.

    Parameters
    ----------
    scene : bpy.types.Scene
        With the copies.
    plane : bpy.types.Object
        Of the build.
    own : iterable of bpy.types.Object
        The build's own objects.
    """
    others = set(bpy.data.user_map(subset=[plane])[plane]) & set(scene.objects) - set(own)
    new: dict[bpy.types.Object | None, bpy.types.Object] = {}
    for points in sorted(others, key=lambda thing: thing.name):
        modifier = bricks_modifier(points)
        if modifier is None or get_input(modifier, SECTION) != plane:
            continue
        if points.parent not in new:
            new[points.parent] = plane.copy()
            new[points.parent].parent = points.parent
            # which a new parent unsets
            new[points.parent].matrix_parent_inverse = points.matrix_parent_inverse
            points.users_collection[0].objects.link(new[points.parent])
        set_input(modifier, SECTION, new[points.parent])


def _trees() -> Iterator[Tree]:
    """Yield each collection of parts that lies in no other one, with those inside it."""
    found = [collection for collection in bpy.data.collections if is_parts(collection)]
    inner = {child for collection in found for child in collection.children_recursive}
    for top in found:
        tree = [top, *top.children_recursive]
        if top not in inner and all(map(is_parts, tree)):
            yield tree


def _used_from_outside(tree: Tree, but: Iterable[bpy.types.ID] = ()) -> bool:
    """Tell whether anything uses a collection of a tree, other than the tree itself and what is named."""
    users = bpy.data.user_map(subset=tree)
    known = {*tree, *but}
    return any(collection.use_fake_user or users.get(collection, set()) - known for collection in tree)


def _copied(tree: Tree) -> dict[bpy.types.Collection, bpy.types.Collection]:
    """Return a copy of each collection of a tree, with objects of its own and the same meshes."""
    new = {collection: bpy.data.collections.new(collection.name) for collection in tree}
    variants = {variant: variant.copy() for variant in tree[0].all_objects}
    for collection, copy in new.items():
        for variant in collection.objects:
            copy.objects.link(variants[variant])
        for child in collection.children:
            copy.children.link(new[child])
    return new


def _remove_unused(datablocks: Iterable[bpy.types.ID]) -> None:
    bpy.data.batch_remove([datablock for datablock in datablocks if datablock.users == 0])
