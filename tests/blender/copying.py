"""Copies of a build as Blender's own commands make them, for tests that have no outliner to click in."""

from __future__ import annotations

import bpy

from legorize_addon.scene.brick_tree import HEAT_PARTS, PARTS, SECTION
from legorize_addon.scene.instancing import bricks_modifier, get_input, set_input
from legorize_addon.scene.state import BUILD_KEY


def duplicate_collection(build: bpy.types.Collection, *, linked: bool = False) -> bpy.types.Collection:
    """Copy a build with its layers and objects, as "Duplicate Collection" does, "linked" without the meshes.

    What is copied refers to what is copied; everything else, such as the parts,
    is shared.
    """
    things = {thing: thing.copy() for thing in build.all_objects}
    copies = {each: bpy.data.collections.new(each.name) for each in (build, *build.children_recursive)}
    for each, copy in copies.items():
        for key, value in each.items():
            copy[key] = value.to_dict() if hasattr(value, "to_dict") else value
        for thing in each.objects:
            copy.objects.link(things[thing])
        for child in each.children:
            copy.children.link(copies[child])
    for thing, copy in things.items():
        copy.parent = things.get(thing.parent, thing.parent)
        copy.matrix_parent_inverse = thing.matrix_parent_inverse  # as Blender's own copies keep it
        if thing.data is not None and not linked:
            copy.data = thing.data.copy()
        for _ in copy.modifiers:
            for name in (PARTS, HEAT_PARTS, SECTION):
                value = get_input(bricks_modifier(thing), name)
                set_input(bricks_modifier(copy), name, things.get(value, value))
    new = copies[build]
    for name in ("root", "plane"):
        new[BUILD_KEY][name] = things[build[BUILD_KEY][name]]
    bpy.context.scene.collection.children.link(new)
    bpy.context.view_layer.update()
    return new
