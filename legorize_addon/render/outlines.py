"""Lines along the edges of every brick, for pictures by Cycles.

Where the normal of a bevelled edge would turn away from the face, a material
takes the colour of the line. The lines are there for a render only: nodes put
into the bricks' materials, and taken out again.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Final

import bpy

SAMPLES: Final = 4
"""Rays that look for an edge; more would only be smoother."""

TURNED: Final = 0.95
"""Cosine of the angle by which the bevelled normal is turned away on a line: 18 degrees."""

DARKER: Final = 0.08
"""Light of a line, as a share of the brick's."""

DARK: Final = 0.05
LIGHT: Final = 0.16
"""Bricks with less light than the first have lines with that of the second: dark ones would not be seen."""


@contextmanager
def outlined(materials: Iterable[bpy.types.Material], width: float) -> Iterator[None]:
    """Draw lines along the edges of what has these materials, as long as the context lasts.

    Parameters
    ----------
    materials : iterable of bpy.types.Material
        Plastics, whose base colour is a value, varied or not.
    width : float
        How far from the edge a line may reach, in world units.
    """
    added = [(material.node_tree, *_add_lines(material.node_tree, width)) for material in materials]
    try:
        yield
    finally:
        for tree, nodes, colour in added:
            for node in nodes:
                tree.nodes.remove(node)
            if colour is not None:
                tree.links.new(colour, _base(tree))


def line_colour(colour: Sequence[float]) -> tuple[float, float, float]:
    """Return the colour of the lines on a brick, scene linear as its own: darker, but lighter on dark bricks."""
    red, green, blue = colour[:3]
    if max(red, green, blue) < DARK:
        return LIGHT, LIGHT, LIGHT
    return red * DARKER, green * DARKER, blue * DARKER


def _base(tree: bpy.types.NodeTree) -> bpy.types.NodeSocket:
    """Return where the shader takes its colour."""
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    return shader.inputs["Base Color"]


def _add_lines(tree: bpy.types.NodeTree, width: float) -> tuple[list[bpy.types.Node], bpy.types.NodeSocket | None]:
    """Put nodes between a material's colour and its shader; return them, and what the shader was linked to."""
    base = _base(tree)
    colour = base.links[0].from_socket if base.is_linked else None
    bevel, face, dot, edge, mix = nodes = [
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("Bevel", "NewGeometry", "VectorMath", "Math", "Mix")
    ]
    bevel.samples, bevel.inputs["Radius"].default_value = SAMPLES, width
    dot.operation = "DOT_PRODUCT"
    edge.operation, edge.inputs[1].default_value = "LESS_THAN", TURNED
    mix.data_type = "RGBA"
    _socket(mix.inputs, "A").default_value = base.default_value
    _socket(mix.inputs, "B").default_value = (*line_colour(base.default_value), 1.0)
    if colour is not None:
        tree.links.new(colour, _socket(mix.inputs, "A"))
    tree.links.new(bevel.outputs["Normal"], dot.inputs[0])
    tree.links.new(face.outputs["Normal"], dot.inputs[1])
    tree.links.new(dot.outputs["Value"], edge.inputs[0])
    tree.links.new(edge.outputs["Value"], _socket(mix.inputs, "Factor"))
    tree.links.new(_socket(mix.outputs, "Result"), base)
    return nodes, colour


def _socket(sockets: Any, name: str) -> bpy.types.NodeSocket:
    """Return the socket of the data type in use."""
    return next(socket for socket in sockets if socket.name == name and socket.enabled)
