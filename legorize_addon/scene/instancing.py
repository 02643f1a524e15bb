"""Brick points shown as coloured instances: the modifier with its inputs, and a material a colour."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import bpy
from mathutils import Color

from ..core.model import Colour
from .abs_plastic import set_up_plastic, vary
from .brick_tree import PARTS, SECTION, TREE_KEY, brick_tree

MATERIAL_KEY: Final = "legorize_colour"
HEAT_KEY: Final = "legorize_heat"
PALE_KEY: Final = "legorize_pale"
GHOST_KEY: Final = "legorize_ghost"
LINE_KEY: Final = "legorize_line"
MODIFIER_NAME: Final = "Bricks"


def add_bricks_modifier(target: bpy.types.Object, parts: bpy.types.Collection, section: bpy.types.Object) -> None:
    """Let an object's points show as bricks.

    Parameters
    ----------
    target : bpy.types.Object
        Mesh object whose vertices carry ``variant``, ``turn`` and ``height``.
    parts : bpy.types.Collection
        Collection whose objects, by ascending name, are the variants.
    section : bpy.types.Object
        Empty on whose +z side bricks are hidden.
    """
    modifier = target.modifiers.new(MODIFIER_NAME, "NODES")
    modifier.node_group = brick_tree()
    set_input(modifier, PARTS, parts)
    set_input(modifier, SECTION, section)


def bricks_modifier(target: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """Return the modifier that :func:`add_bricks_modifier` added, whatever it is called by now; None without it."""
    modifiers = (modifier for modifier in target.modifiers if modifier.type == "NODES")
    return next((each for each in modifiers if each.node_group and TREE_KEY in each.node_group), None)


def set_input(modifier: bpy.types.NodesModifier, name: str, value: Any) -> None:
    """Set an input of a Geometry-Nodes modifier by the name that its tree shows.

    Blender 5.2 keeps the values behind ``properties.inputs``, earlier versions
    as custom properties of the modifier.
    """
    identifier = _identifier(modifier, name)
    if hasattr(modifier, "properties"):
        getattr(modifier.properties.inputs, identifier).value = value
    else:
        modifier[identifier] = value
    modifier.id_data.update_tag()


def get_input(modifier: bpy.types.NodesModifier, name: str) -> Any:
    """Return an input of a Geometry-Nodes modifier by the name that its tree shows."""
    identifier = _identifier(modifier, name)
    if hasattr(modifier, "properties"):
        return getattr(modifier.properties.inputs, identifier).value
    return modifier[identifier]


def is_brick_material(material: bpy.types.Material) -> bool:
    """Tell whether a material is one that :func:`plastic` made."""
    return any(isinstance(material.get(key), int) for key in (MATERIAL_KEY, HEAT_KEY, PALE_KEY, GHOST_KEY, LINE_KEY))


def colour_material(colour: Colour) -> bpy.types.Material:
    """Return the material of a brick colour, made at the first call in a file.

    Parameters
    ----------
    colour : Colour
        Colour of the catalogue.

    Returns
    -------
    bpy.types.Material
        Glossy plastic that differs a little from brick to brick; the viewport's solid mode shows the plain colour.
    """
    return plastic(f"Brick {colour.code} {colour.name}", colour.rgb, MATERIAL_KEY, colour.code)


def plastic(name: str, rgb: Sequence[int], key: str, value: int) -> bpy.types.Material:
    """Return the glossy material that is marked by a custom property, made at the first call in a file.

    Parameters
    ----------
    name : str
        Name of a new material.
    rgb : sequence of three int
        Colour in sRGB bytes, for the shader and for the viewport's solid mode.
    key, value : str, int
        Custom property by which the material is known; only bricks in their own colours differ a little.

    Returns
    -------
    bpy.types.Material
    """
    for material in bpy.data.materials:
        if material.get(key) == value:
            return material
    material = bpy.data.materials.new(name)
    material[key] = value
    set_up_plastic(material, Color([byte / 255 for byte in rgb]).from_srgb_to_scene_linear())
    if key == MATERIAL_KEY:
        vary(material)
    return material


def change_tree(modifier: bpy.types.NodesModifier, tree: bpy.types.NodeTree) -> None:
    """Give a modifier another tree; inputs of the same name keep their values."""
    kept = {name: get_input(modifier, name) for name in _inputs(modifier)}
    modifier.node_group = tree
    for name in kept.keys() & _inputs(modifier):
        set_input(modifier, name, kept[name])


def has_input(modifier: bpy.types.NodesModifier, name: str) -> bool:
    """Tell whether the tree of a modifier has an input of a name: those of earlier versions have fewer."""
    return any(socket.name == name and socket.in_out == "INPUT" for socket in modifier.node_group.interface.items_tree)


def _inputs(modifier: bpy.types.NodesModifier) -> set[str]:
    """Return the names of the inputs of a modifier that have a value of their own."""
    sockets = modifier.node_group.interface.items_tree
    return {socket.name for socket in sockets if socket.in_out == "INPUT" and socket.name != "Geometry"}


def _identifier(modifier: bpy.types.NodesModifier, name: str) -> str:
    sockets = modifier.node_group.interface.items_tree
    return str(next(socket.identifier for socket in sockets if socket.name == name and socket.in_out == "INPUT"))
