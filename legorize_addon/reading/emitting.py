"""Changes to copies of node trees, so that a renderer can bake values that only it can compute."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import bpy

from .images import is_missing
from .node_links import SEE_THROUGH, Source
from .object_values import ObjectValues, constant

PASSED_ON: Final = ("ShaderNodeMixShader", "ShaderNodeAddShader", "ShaderNodeGroup", "NodeGroupInput", "NodeReroute")
"""Nodes that hand on shaders of other nodes."""

_GREY: Final = 0.8
"""Linear grey of Blender's new materials."""

_CLEAR: Final = "ShaderNodeBsdfTransparent"
_GLASS: Final = ("ShaderNodeBsdfGlass", "ShaderNodeBsdfRefraction")


def replace_by_emission(tree: bpy.types.NodeTree, value: Any, shown: Any) -> None:
    """Let an emission of a value take the place of a shader.

    Parameters
    ----------
    tree : bpy.types.NodeTree
        Is changed.
    value : 4 floats or bpy.types.NodeSocket
        The colour, or what puts it out.
    shown : bpy.types.NodeSocket
        Output of the shader.
    """
    emission = tree.nodes.new("ShaderNodeEmission")
    _feed(tree, value, emission.inputs["Color"])
    for link in list(shown.links):
        tree.links.new(emission.outputs[0], link.to_socket)


def fix_object_values(tree: bpy.types.NodeTree, values: ObjectValues) -> None:
    """Put plain values in the place of what an object or instance tells its materials.

    Parameters
    ----------
    tree : bpy.types.NodeTree
        Is changed.
    values : ObjectValues
        What the object tells, which the one that is baked could not.
    """
    for node in list(tree.nodes):
        for output in node.outputs:
            value = constant(Source(node, output, (), values)) if output.is_linked else None
            if value is not None:
                _put(tree, value, output)


def fix_missing_images(tree: bpy.types.NodeTree) -> None:
    """Put a plain grey, seen everywhere, in the place of images that are missing, which a renderer shows in pink.

    Parameters
    ----------
    tree : bpy.types.NodeTree
        Is changed.
    """
    for node in list(tree.nodes):
        if node.bl_idname == "ShaderNodeTexImage" and is_missing(node.image):
            for output in node.outputs:
                _put(tree, (_GREY, _GREY, _GREY, 1.0), output)


def keep_hidden_apart(tree: bpy.types.NodeTree) -> None:
    """Look images up texel by texel where their alpha counts: between texels the hidden would colour the seen.

    Parameters
    ----------
    tree : bpy.types.NodeTree
        Is changed.
    """
    for node in tree.nodes:
        if node.bl_idname == "ShaderNodeTexImage" and node.outputs["Alpha"].is_linked:
            node.interpolation = "Closest"


def _put(tree: bpy.types.NodeTree, value: Sequence[float], output: Any) -> None:
    """Let a plain value take the place of an output."""
    if output.type == "VALUE":
        node = tree.nodes.new("ShaderNodeValue")
        # the brightness of a colour here is its mean
        node.outputs[0].default_value = value[3] if output.name == "Alpha" else sum(value[:3]) / 3
    elif output.type == "VECTOR":
        node = tree.nodes.new("ShaderNodeCombineXYZ")
        for socket, number in zip(node.inputs, value[:3], strict=True):
            socket.default_value = number
    else:
        node = tree.nodes.new("ShaderNodeRGB")
        node.outputs[0].default_value = (*value[:3], 1.0)
    for link in list(output.links):
        tree.links.new(node.outputs[0], link.to_socket)


def emit_opacity(tree: bpy.types.NodeTree) -> None:
    """Put an emission of how much is seen of it in the place of every shader of a tree, see :mod:`.opacity`."""
    for node in list(tree.nodes):
        if node.bl_idname == "ShaderNodeOutputMaterial":
            for name in ("Volume", "Displacement"):
                for link in list(node.inputs[name].links):
                    tree.links.remove(link)
    for node in list(tree.nodes):
        shown = [output for output in node.outputs if output.type == "SHADER" and output.is_linked]
        if shown and node.bl_idname not in PASSED_ON:
            replace_by_emission(tree, _opacity(tree, node), shown[0])


def _opacity(tree: bpy.types.NodeTree, node: Any) -> Any:
    """Return what puts out how much of a shader is seen."""
    if node.bl_idname == _CLEAR:
        return _math(tree, "SUBTRACT", 1.0, _least(tree, node.inputs["Color"]))
    if node.bl_idname in SEE_THROUGH:
        return _grey(0.0)
    alpha = _value(node.inputs["Alpha"]) if "Alpha" in node.inputs else 1.0
    if node.bl_idname in _GLASS:
        through = _least(tree, node.inputs["Color"])
    elif "Transmission Weight" in node.inputs:
        through = _math(
            tree, "MULTIPLY", _value(node.inputs["Transmission Weight"]), _least(tree, node.inputs["Base Color"])
        )
    else:
        return _grey(alpha) if isinstance(alpha, float) else alpha
    return _math(tree, "MULTIPLY", alpha, _math(tree, "SUBTRACT", 1.0, through))


def _least(tree: bpy.types.NodeTree, socket: Any) -> Any:
    """Return what puts out the least channel of a colour."""
    parts = tree.nodes.new("ShaderNodeSeparateColor")
    _feed(tree, _value(socket), parts.inputs[0])
    red, green, blue = parts.outputs
    return _math(tree, "MINIMUM", _math(tree, "MINIMUM", red, green), blue)


def _math(tree: bpy.types.NodeTree, operation: str, first: Any, second: Any) -> Any:
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    _feed(tree, first, node.inputs[0])
    _feed(tree, second, node.inputs[1])
    return node.outputs[0]


def _value(socket: Any) -> Any:
    """Return what feeds a socket: an output, or its own value."""
    if socket.is_linked:
        return socket.links[0].from_socket
    value = socket.default_value
    return float(value) if isinstance(value, (int, float)) else tuple(value)


def _feed(tree: bpy.types.NodeTree, value: Any, socket: Any) -> None:
    if isinstance(value, bpy.types.NodeSocket):
        tree.links.new(value, socket)
    else:
        socket.default_value = value


def _grey(value: float) -> tuple[float, float, float, float]:
    return value, value, value, 1.0
