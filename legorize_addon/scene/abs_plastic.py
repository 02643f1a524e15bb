"""The shader of a brick: ABS, whose colour and gloss differ a little from brick to brick.

The nodes are those that Blender has under the same names from 4.2 on, and both
Cycles and EEVEE know all of them. Rounded edges are in the meshes, see
:mod:`.rounding`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import bpy

from .brick_points import ROW

IOR: Final = 1.54
"""Refractive index of ABS, as tables of plastics have it."""

ROUGHNESS: Final = 0.25
COAT: Final = 0.15
COAT_ROUGHNESS: Final = 0.06
"""The polished mould leaves a sharp, weak reflection over the dull one."""

TINT: Final = 0.06
"""Largest share by which the light of a brick differs from its colour: about one step of CIE lightness."""

DULLNESS: Final = 0.2
"""Largest share by which its roughness differs."""


def set_up_plastic(material: bpy.types.Material, linear: Sequence[float]) -> bpy.types.Node:
    """Give a material the plain shader of plastic, in a colour.

    Parameters
    ----------
    material : bpy.types.Material
        A new one.
    linear : sequence of three float
        Colour, scene linear, for the shader and for the viewport's solid mode.

    Returns
    -------
    bpy.types.Node
        The shader.
    """
    material.diffuse_color = (*linear, 1.0)
    material.roughness = ROUGHNESS
    if material.node_tree is None:
        material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    values = {
        "Base Color": (*linear, 1.0),
        "Roughness": ROUGHNESS,
        "IOR": IOR,
        "Coat Weight": COAT,
        "Coat Roughness": COAT_ROUGHNESS,
    }
    for name, value in values.items():
        shader.inputs[name].default_value = value
    return shader


def vary(material: bpy.types.Material) -> None:
    """Let the bricks of a material differ, by their rows in the table: the same in every frame and on every machine.

    Colour and roughness stay plain values, which are multiplied: so exporters of other formats find them.

    Parameters
    ----------
    material : bpy.types.Material
        Set up by :func:`set_up_plastic`.
    """
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    row, noise, parts = (
        _add(tree, kind, x) for kind, x in (("Attribute", -900), ("TexWhiteNoise", -700), ("SeparateColor", -500))
    )
    row.attribute_type, row.attribute_name = "INSTANCER", ROW
    noise.noise_dimensions = "1D"
    tree.links.new(row.outputs["Fac"], noise.inputs["W"])
    tree.links.new(noise.outputs["Color"], parts.inputs["Color"])
    colour, roughness = _add(tree, "Mix", -150), _add(tree, "Math", -150, -250)
    colour.data_type, colour.blend_type, roughness.operation = "RGBA", "MULTIPLY", "MULTIPLY"
    factor, first, second = (_socket(colour.inputs, name) for name in ("Factor", "A", "B"))
    factor.default_value, first.default_value = 1.0, shader.inputs["Base Color"].default_value
    roughness.inputs[0].default_value = shader.inputs["Roughness"].default_value
    for part, reach, y, target in (("Red", TINT, 0, second), ("Green", DULLNESS, -250, roughness.inputs[1])):
        share = _add(tree, "MapRange", -330, y)
        share.inputs["To Min"].default_value, share.inputs["To Max"].default_value = 1 - reach, 1 + reach
        tree.links.new(parts.outputs[part], share.inputs["Value"])
        tree.links.new(share.outputs["Result"], target)
    tree.links.new(_socket(colour.outputs, "Result"), shader.inputs["Base Color"])
    tree.links.new(roughness.outputs["Value"], shader.inputs["Roughness"])


def _add(tree: bpy.types.NodeTree, kind: str, x: int, y: int = 0) -> Any:
    node = tree.nodes.new(f"ShaderNode{kind}")
    node.location = x, y
    return node


def _socket(sockets: Any, name: str) -> bpy.types.NodeSocket:
    """Return the socket of the data type in use."""
    return next(socket for socket in sockets if socket.name == name and socket.enabled)
